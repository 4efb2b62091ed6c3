// SPDX-License-Identifier: MIT
// The 1-euro filter (Casiez, Roussel & Vogel 2012): smooths a slow hand much, a fast one little.

const SLOW = 3; // cutoff at rest [Hz]
const GAIN = 12; // of the cutoff with speed [Hz s/m]
const SPEED = 5; // cutoff of the speed [Hz]

const share = (cutoff, step) => 1 / (1 + 1 / (2 * Math.PI * cutoff * step));

export class OneEuro {
  constructor(place) {
    this.place = [...place];
    this.speed = place.map(() => 0);
  }

  /// `step` [s] after the place before.
  next(place, step) {
    const a = share(SPEED, step);
    this.speed = this.speed.map((v, i) => v + a * ((place[i] - this.place[i]) / step - v));
    const b = share(SLOW + GAIN * Math.hypot(...this.speed), step);
    this.place = this.place.map((x, i) => x + b * (place[i] - x));
    return this.place;
  }
}
