// SPDX-License-Identifier: MIT
// Which two states a picture lies between. States are shown by their moments, held back by what
// nine of ten of them came late after the one before them, so that motion is even, but no longer
// than leaves the time for drawing within the age that a picture may have.

const HOLD_MAX = 0.055; // [s]
const AGE_MAX = 0.055; // that pictures are meant to have when they are drawn [s]
const EVEN = 40; // pictures a second, below which there is no time to hold a state
export const KEEP = 90; // states, and pictures, that are looked at

export function quantile(values, share) {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted.length ? sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] : 0;
}

function mean(values) {
  return values.reduce((a, b) => a + b, 0) / Math.max(values.length, 1);
}

function note(values, value) {
  values.push(value);
  if (values.length > KEEP) values.shift();
}

export class Playout {
  constructor() {
    this.clear();
  }

  clear() {
    this.states = [];
    this.lateness = [];
    this.arrivals = []; // ages of states when they come [s]
    this.ages = []; // of finished pictures [s]
    this.drawn = []; // how long the graphics took for them [s]
    this.found = []; // ages of the newest state when a picture is begun [s]
    this.hold = 0;
  }

  push(state, now) {
    const last = this.states.at(-1);
    note(this.arrivals, now - state.moment);
    if (last && (state.moment <= last.moment || state.count !== last.count)) this.states = [];
    else if (last) note(this.lateness, now - last.moment);
    this.states.push(state);
    if (this.states.length > 8) this.states.shift();
  }

  /// {older, newer, share} at this moment, of `rate` pictures a second, `lag` [s] old in the mean at
  /// least when they are drawn; null before the first state.
  at(now, rate, lag = 0) {
    if (this.states.length === 0) return null;
    note(this.found, Math.max(now - this.states.at(-1).moment, 0));
    const late = rate < EVEN ? 0 : quantile(this.lateness, 0.9);
    const free = Math.max(AGE_MAX - this.drawing, 0);
    const wanted = Math.min(Math.max(Math.min(late, free), lag - mean(this.drawn), 0), HOLD_MAX);
    this.hold += 0.05 * (wanted - this.hold);
    const shown = now - this.hold;
    while (this.states.length > 2 && this.states[1].moment <= shown) this.states.shift();
    const [older, newer = older] = this.states;
    const span = newer.moment - older.moment;
    const share = span > 0 ? Math.min(Math.max((shown - older.moment) / span, 0), 1) : 1;
    return { older, newer, share, moment: older.moment + share * span };
  }

  /// The graphics have drawn a picture of this moment, which they were given at `begun`.
  finished(moment, begun, now) {
    note(this.ages, now - moment);
    note(this.drawn, now - begun);
  }

  /// How long 95 of 100 pictures took at most until they were drawn [s].
  get drawing() {
    return quantile(this.drawn, 0.95);
  }

  /// How old 95 of 100 pictures were at most when they were drawn [s].
  get age() {
    return quantile(this.ages, 0.95);
  }

  /// How old 95 of 100 pictures would be at most if none were held back [s].
  get leastAge() {
    return quantile(this.found, 0.95) + this.drawing;
  }

  /// How old 95 of 100 states were at most when they came [s].
  get arrival() {
    return quantile(this.arrivals, 0.95);
  }
}
