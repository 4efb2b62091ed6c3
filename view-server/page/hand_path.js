// SPDX-License-Identifier: MIT
// Where a hand was, by moments. Browsers tell of a pointer in bursts, once a picture or less; out of
// the path its place can be had at any moment, a little later.
import { quantile } from './playout.js';
import { between, mix } from './vector.js';

const KEEP = 0.5; // [s] of the path
const PAUSE = 0.1; // [s] without news after which the hand rested
const HOLD_MAX = 0.03; // [s]
const BURSTS = 40; // that the hold is made of

export class HandPath {
  constructor(place, turn, moment) {
    this.spots = [{ place, turn, moment }];
    this.waits = [];
    this.hold = 0; // places are known this much later [s]
  }

  /// `known`: when this came to be known, by the same clock as `moment` [s].
  add(place, turn, moment, known) {
    const last = this.spots.at(-1);
    const wait = known - last.moment;
    if (!(moment > last.moment)) {
      this.spots[this.spots.length - 1] = { ...last, place, turn };
      return;
    }
    // After a rest it was where it was until just now.
    if (wait > PAUSE) this.spots.push({ ...last, moment: Math.max(moment - 0.01, last.moment) });
    else this.waits.push(wait);
    if (this.waits.length > BURSTS) this.waits.shift();
    this.hold = Math.min(quantile(this.waits, 0.9), HOLD_MAX);
    this.spots.push({ place, turn, moment });
    while (this.spots.length > 2 && this.spots[1].moment < moment - KEEP) this.spots.shift();
  }

  /// {place, turn}, on straight ways between what is known, and at rest behind it.
  at(moment) {
    const next = this.spots.findIndex((spot) => spot.moment > moment);
    if (next < 0) return this.spots.at(-1);
    if (next === 0) return this.spots[0];
    const [a, b] = [this.spots[next - 1], this.spots[next]];
    const share = (moment - a.moment) / (b.moment - a.moment);
    return { place: mix(a.place, b.place, share), turn: between(a.turn, b.turn, share) };
  }
}
