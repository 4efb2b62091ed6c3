// SPDX-License-Identifier: MIT
// Which particles are drawn several times: those near the tank's walls, mirrored there, and those
// that fly, as drops. They are picked here, once a state: drawing every particle so often to hide
// most of it again would take the graphics far longer than all else.

export const REACH = 4; // of the mirrored water beyond a wall [spacings]
export const DROPS = 5; // for each particle that flies
const SPRAY = 4; // in a particle's flags

/// Words of one point: older and newer place with speed and flags, two each as states have them, and
/// which of the several it is.
export const WORDS = 5;

export class Several {
  constructor() {
    this.count = 0;
    this.words = new Uint32Array(WORDS * 1024);
  }

  add(older, newer, i, part) {
    const at = WORDS * this.count++;
    if (at + WORDS > this.words.length) {
      const more = new Uint32Array(2 * this.words.length);
      more.set(this.words);
      this.words = more;
    }
    const { words } = this;
    words[at] = older[2 * i];
    words[at + 1] = older[2 * i + 1];
    words[at + 2] = newer[2 * i];
    words[at + 3] = newer[2 * i + 1];
    words[at + 4] = part;
  }

  get used() {
    return this.words.subarray(0, WORDS * this.count);
  }
}

const wordsOf = ({ particles: bytes }) =>
  new Uint32Array(bytes.buffer, bytes.byteOffset, bytes.byteLength / 4);

/// {mirrored, drops} of the water between two states, by where and what it is in the newer one;
/// the tank's x wall is where its wave maker has gone.
/// Parts of what is mirrored: 0 at the x wall, 1 at the y wall, 2 at both.
export function several({ older, newer }, { tank: { lower, upper }, paddle, spacing }) {
  const [mirrored, drops] = [new Several(), new Several()];
  const [before, now] = [wordsOf(older), wordsOf(newer)];
  const near = [0, 1].map((axis) =>
    [lower[axis] + (axis === 0 ? paddle : 0) + REACH * spacing, upper[axis] - REACH * spacing]
      .map((end) => (end - newer.lower[axis]) / newer.unit));
  for (let i = 0; i < newer.count; ++i) {
    if ((now[2 * i + 1] >>> 24) & SPRAY) {
      for (let drop = 0; drop < DROPS; ++drop) drops.add(before, now, i, DROPS * i + drop);
      continue;
    }
    const [x, y] = [now[2 * i] & 0xffff, now[2 * i] >>> 16];
    const nearX = x < near[0][0] || x > near[0][1];
    const nearY = y < near[1][0] || y > near[1][1];
    if (nearX) mirrored.add(before, now, i, 0);
    if (nearY) mirrored.add(before, now, i, 1);
    if (nearX && nearY) mirrored.add(before, now, i, 2);
  }
  return { mirrored, drops };
}
