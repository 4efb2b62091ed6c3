// SPDX-License-Identifier: MIT
// Finds which points are visible. Deep in the water most points are entirely hidden behind nearer
// ones; where graphics are slow, drawing these takes most of the time, and finding them here far less.

import { mix } from './vector.js';

const FINE = 4; // cells along a point's diameter, of the grid on which nearness is compared

export class Seen {
  constructor() {
    this.points = new Float32Array(0); // x, y [cells], distance [m]
    this.nearest = new Float32Array(0); // of what covers a cell whole [m]
    this.picked = new Uint32Array(0);
  }

  /// Numbers of those between the two states that are within the picture and not behind others.
  /// `radius` [m]; a point is a disc that faces the picture.
  pick({ older, newer, share }, { both, projection }, radius, { width, height }) {
    const { count } = newer;
    if (this.picked.length < count) {
      this.points = new Float32Array(3 * count);
      this.picked = new Uint32Array(count);
    }
    const far = this.place({ older, newer, share }, both, count);
    const size = 0.5 * projection[5] * radius; // of a point's radius, at 1 m: share of the height
    const cell = Math.max((2 * size * height) / far / FINE, 1); // [pixels]
    const [columns, rows] = [Math.ceil(width / cell), Math.ceil(height / cell)];
    if (this.nearest.length < columns * rows) this.nearest = new Float32Array(columns * rows);
    this.nearest.fill(Infinity);
    const { points, nearest, picked } = this;
    const [across, upwards] = [width / cell, height / cell];
    let found = 0;
    for (const hides of [true, false]) {
      for (let i = 0; i < count; ++i) {
        const w = points[3 * i + 2];
        if (!(w > 0)) continue;
        const r = (size * upwards) / w;
        const [x, y] = [points[3 * i] * across, points[3 * i + 1] * upwards];
        const inside = hides ? 1 : 0;
        const last = Math.min(Math.floor(y + r) - inside, rows - 1);
        let shows = false;
        for (let row = Math.max(Math.floor(y - r) + inside, 0); row <= last && !shows; ++row) {
          // The disc's half width over the whole row, or where it is widest.
          const off = hides ? Math.max(Math.abs(row - y), Math.abs(row + 1 - y))
            : Math.max(row - y, y - row - 1, 0);
          if (off >= r) continue;
          const half = Math.sqrt(r * r - off * off);
          const end = Math.min(Math.floor(x + half) - inside, columns - 1);
          for (let at = row * columns + Math.max(Math.floor(x - half) + inside, 0);
            at <= row * columns + end; ++at) {
            if (hides) nearest[at] = Math.min(nearest[at], w);
            else if (nearest[at] >= w) shows = true;
          }
        }
        if (shows) picked[found++] = i;
      }
    }
    return picked.subarray(0, found);
  }

  /// Where the points are in the picture, from 0 to 1; the farthest one's distance.
  place({ older, newer, share }, both, count) {
    const words = (state) => new Uint16Array(state.particles.buffer, state.particles.byteOffset);
    const [before, now] = [words(older), words(newer)];
    const { points } = this;
    const [from, to] = [(1 - share) * older.unit, share * newer.unit]; // [m] a count
    const [lowX, lowY, lowZ] = mix(older.lower, newer.lower, share);
    const [xx, yx, , wx, xy, yy, , wy, xz, yz, , wz, x0, y0, , w0] = both;
    let far = 0;
    for (let i = 0; i < count; ++i) {
      const x = lowX + from * before[4 * i] + to * now[4 * i];
      const y = lowY + from * before[4 * i + 1] + to * now[4 * i + 1];
      const z = lowZ + from * before[4 * i + 2] + to * now[4 * i + 2];
      const w = wx * x + wy * y + wz * z + w0;
      points[3 * i] = 0.5 + (0.5 * (xx * x + xy * y + xz * z + x0)) / w;
      points[3 * i + 1] = 0.5 + (0.5 * (yx * x + yy * y + yz * z + y0)) / w;
      points[3 * i + 2] = w;
      far = Math.max(far, w);
    }
    return far;
  }
}
