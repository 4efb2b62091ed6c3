// SPDX-License-Identifier: MIT
// How sharp pictures may be on a machine that draws as fast as this one does.
import { KEEP } from './playout.js';

/// Shares of the pixels along each axis: of the window's for the picture, of the picture's for the
/// water in it. Each draws half as many as the one before it, or more.
const LEVELS = [[1, 1], [1, 0.71], [0.71, 0.71], [0.71, 0.5], [0.5, 0.5], [0.35, 0.5]];
const SLOW = 40; // pictures a second, below which they get coarser
const FAST = 57; // above which they get sharper
const LONG = 0.035; // that drawing 95 of 100 pictures takes, above which they get coarser [s]
const SHORT = 0.015; // below which they may get sharper: twice the work, about [s]
const OLD = 0.060; // that 95 of 100 pictures are, above which they get coarser, too [s]
const THIN = 2; // levels beyond the coarsest, of points alone: each draws half as many
const TOO_SLOW = 24; // of the coarsest water, after which points are drawn
const SETTLE = 0.5; // after each change before the rate counts [s]
const SHARPER_AFTER = 5; // of a fast rate [s]
const AGAIN = 10; // of fast points, after which water is tried again; twice as long each time [s]
const AGAIN_MAX = 320; // [s]

export class Pace {
  /// `share` of the whole picture's pixels along each axis for the water; null: as the machine
  /// allows. `inSoftware`: graphics are a processor, so that points are drawn first.
  constructor(share, inSoftware = false) {
    this.fixed = share;
    this.level = 0; // in LEVELS
    this.isTooSlow = inSoftware && share === null; // for water
    this.pointsLevel = 0; // with which points begin
    this.again = AGAIN; // of fast points, the next time that water is too slow [s]
    this.left = AGAIN; // of fast points before water is tried again [s]
    this.took = 1 / 60; // a picture, a mean [s]
    this.begin();
  }

  /// Counts from here on, as after a time in which the browser took no pictures.
  begin() {
    this.before = performance.now() / 1000;
    this.pictures = 0; // since the last change
    this.since = 0; // that change [s]
  }

  get shares() {
    return LEVELS[Math.min(this.level, LEVELS.length - 1)];
  }

  /// Of the window's pixels along each axis, for the picture.
  get sharp() {
    return this.fixed === null ? this.shares[0] : 1;
  }

  /// Of the picture's pixels along each axis, for the water.
  get share() {
    return this.fixed ?? this.shares[1];
  }

  /// One in so many of the points is drawn.
  get stride() {
    return 2 ** Math.max(this.level - LEVELS.length + 1, 0);
  }

  /// One in so many of the browser's pictures is drawn. Graphics too slow for water are a processor,
  /// which the simulator may need, too.
  get every() {
    return this.isTooSlow ? 2 : 1;
  }

  /// Pictures a second, a mean.
  get rate() {
    return 1 / Math.max(this.took, 1e-3);
  }

  /// Once a picture. `drawing`: what 95 of 100 pictures took at most, `age`: how old they were at
  /// most without what was held back [s].
  step(drawing, age = drawing) {
    const now = performance.now() / 1000;
    const took = Math.min(now - this.before, 2);
    this.before = now;
    this.took += Math.min(3 * took, 0.3) * (took - this.took); // over about a third of a second
    this.since += took;
    this.pictures += 1;
    if (this.fixed !== null || this.since < SETTLE || this.pictures < 2) return;
    const meanRate = (this.every * this.pictures) / this.since; // that there could be
    const water = LEVELS.length - 1; // the coarsest
    const coarsest = water + (this.isTooSlow ? THIN : 0);
    if (this.isTooSlow && meanRate > SLOW && drawing < LONG) this.left -= took;
    if (this.isTooSlow && this.left < 0) {
      this.pointsLevel = this.level;
      this.go(water, false);
    } else if (meanRate < SLOW && this.level < coarsest) {
      this.go(Math.min(this.level + Math.ceil(Math.log2(SLOW / meanRate)), coarsest));
    } else if (meanRate < TOO_SLOW && !this.isTooSlow) {
      this.left = this.again;
      this.again = Math.min(2 * this.again, AGAIN_MAX);
      this.go(this.pointsLevel, true);
    } else if ((drawing > LONG || (age > OLD && drawing > SHORT)) && this.pictures > KEEP
               && this.level < coarsest) {
      this.go(this.level + 1);
    } else if (this.since > SHARPER_AFTER) {
      const spare = meanRate > FAST && drawing < SHORT && age + drawing < OLD;
      this.go(Math.max(this.level - (spare ? 1 : 0), 0));
    }
  }

  go(level, isTooSlow = this.isTooSlow) {
    Object.assign(this, { level, isTooSlow, since: 0, pictures: 0 });
  }
}
