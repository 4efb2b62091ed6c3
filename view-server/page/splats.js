// SPDX-License-Identifier: MIT
// Draws points as shaded discs on the page's own processor. Where graphics are a processor, too, these
// take several times as long for it, which set up each point and ask its shader about each pixel.

import { mix } from './vector.js';

const FAR = 1e9; // where no point is [m]

export class Splats {
  constructor() {
    Object.assign(this, { width: 0, height: 0 });
    this.fit(1, 1);
  }

  fit(width, height) {
    if (width === this.width && height === this.height) return;
    Object.assign(this, { width, height });
    this.axial = new Float32Array(width * height); // distance along the camera's axis [m]
    this.tone = new Uint8Array(2 * width * height); // speed as states have it; how much it faces us
  }

  /// One in `stride` of the points between the two states. `radius` [m]; a point is a disc that faces
  /// the picture, and covers a pixel's middle at least. Rows from below.
  draw({ older, newer, share }, { both, projection }, radius, { width, height }, stride = 1) {
    this.fit(width, height);
    const { axial, tone } = this;
    axial.fill(FAR);
    const words = (state) => new Uint16Array(state.particles.buffer, state.particles.byteOffset);
    const [before, now, bytes] = [words(older), words(newer), newer.particles];
    const [from, to] = [(1 - share) * older.unit, share * newer.unit]; // [m] a count
    const [lowX, lowY, lowZ] = mix(older.lower, newer.lower, share);
    const [xx, yx, , wx, xy, yy, , wy, xz, yz, , wz, x0, y0, , w0] = both;
    const size = 0.5 * projection[5] * radius * height; // of a radius at 1 m [pixels]
    for (let i = 0; i < newer.count; i += stride) {
      const x = lowX + from * before[4 * i] + to * now[4 * i];
      const y = lowY + from * before[4 * i + 1] + to * now[4 * i + 1];
      const z = lowZ + from * before[4 * i + 2] + to * now[4 * i + 2];
      const w = wx * x + wy * y + wz * z + w0;
      if (!(w > 0)) continue;
      const r = Math.max(size / w, Math.SQRT1_2);
      const u = (0.5 + (0.5 * (xx * x + xy * y + xz * z + x0)) / w) * width - 0.5;
      const v = (0.5 + (0.5 * (yx * x + yy * y + yz * z + y0)) / w) * height - 0.5;
      const speed = bytes[8 * i + 6];
      const top = Math.min(Math.floor(v + r), height - 1);
      for (let row = Math.max(Math.ceil(v - r), 0); row <= top; ++row) {
        const off = (row - v) / r;
        const half = r * Math.sqrt(Math.max(1 - off * off, 0));
        const end = row * width + Math.min(Math.floor(u + half), width - 1);
        for (let at = row * width + Math.max(Math.ceil(u - half), 0); at <= end; ++at) {
          if (axial[at] <= w) continue;
          const across = (at - row * width - u) / r;
          axial[at] = w;
          tone[2 * at] = speed;
          tone[2 * at + 1] = 255 * Math.sqrt(Math.max(1 - off * off - across * across, 0));
        }
      }
    }
    return this;
  }
}
