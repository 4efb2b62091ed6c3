// SPDX-License-Identifier: MIT
// A camera that goes around the tank: angles and distance, and the rays through its pixels.
import { add, clamp, inverse, length, lookAt, multiply, perspective, scale, sub, transform, normalised }
  from './vector.js';

const FOVY = 0.66; // [rad]
const NEAREST = 0.25; // eye from what it looks at, in lengths of the tank
const FARTHEST = 6;

export class Camera {
  constructor() {
    this.azimuth = -1.02; // of the eye, from +x towards +y [rad]
    this.elevation = 0.47; // [rad]
    this.distance = 3; // [m]
    this.target = [0, 0, 0];
    this.aspect = 1;
    this.size = 1;
  }

  /// Looks at the whole tank between two heights of the picture, -1 at the bottom and 1 at the top.
  frame({ lower, upper }, low, high) {
    this.size = length(sub(upper, lower));
    this.target = scale(add(lower, upper), 0.5);
    const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((bits) =>
      [0, 1, 2].map((i) => (bits & (1 << i) ? upper[i] : lower[i])));
    for (this.distance = this.size; this.distance < FARTHEST * this.size; this.distance *= 1.03) {
      const { both, focal } = this.matrices();
      const seen = corners.map((corner) => transform(both, corner));
      const [bottom, top] = [Math.min, Math.max].map((f) => f(...seen.map(([, y]) => y)));
      if (bottom > low && top < high && seen.every(([x]) => Math.abs(x) < 0.94)) break;
      const lift = (0.5 * (low + high - bottom - top) * this.distance) / focal; // [m]
      this.target = sub(this.target, scale(this.up, lift));
    }
  }

  orbit(right, up) {
    this.azimuth -= right;
    this.elevation = clamp(this.elevation + up, 0.03, 1.5);
  }

  zoom(factor) {
    this.distance = clamp(this.distance * factor, NEAREST * this.size, FARTHEST * this.size);
  }

  get eye() {
    const flat = Math.cos(this.elevation);
    return add(this.target, scale([
      flat * Math.cos(this.azimuth), flat * Math.sin(this.azimuth), Math.sin(this.elevation),
    ], this.distance));
  }

  /// Upwards in the picture.
  get up() {
    const over = Math.sin(this.elevation);
    return [-over * Math.cos(this.azimuth), -over * Math.sin(this.azimuth), Math.cos(this.elevation)];
  }

  /// Everything that shaders want to know.
  matrices() {
    const near = 0.02 * this.distance;
    const far = this.distance + 30 * this.size;
    const view = lookAt(this.eye, this.target, [0, 0, 1]);
    const projection = perspective(FOVY, this.aspect, near, far);
    const both = multiply(projection, view);
    return { view, projection, both, back: inverse(both), viewBack: inverse(view), eye: this.eye,
      near, far, focal: projection[5], aspect: this.aspect, skew: [0, 0] };
  }

  /// The ray through a place of the picture: x and y from -1 to 1, y upwards.
  ray(x, y) {
    const { back, eye } = this.matrices();
    return { from: eye, along: normalised(sub(transform(back, [x, y, 0.5]), eye)) };
  }

  /// Away from the eye: the normal of the view plane.
  get forward() {
    return normalised(sub(this.target, this.eye));
  }
}
