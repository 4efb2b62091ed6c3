// SPDX-License-Identifier: MIT
// Vectors and quaternions as arrays, 4 x 4 matrices in columns as WebGL takes them.

export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const length = (a) => Math.hypot(a[0], a[1], a[2]);
export const normalised = (a) => scale(a, 1 / (length(a) || 1));
export const mix = (a, b, t) => a.map((x, i) => x + (b[i] - x) * t);
export const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

/// Turns a vector by the unit quaternion [x, y, z, w].
export function turn(q, v) {
  const t = scale(cross(q, v), 2);
  return add(add(v, scale(t, q[3])), cross(q, t));
}

export const conjugate = (q) => [-q[0], -q[1], -q[2], q[3]];

export const product = (a, b) => [
  a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
  a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
  a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
  a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
];

export function about(axis, angle) {
  return [...scale(normalised(axis), Math.sin(angle / 2)), Math.cos(angle / 2)];
}

/// Between two rotations along the shorter arc, normalised.
export function between(a, b, t) {
  const sign = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] < 0 ? -1 : 1;
  const q = a.map((x, i) => x + (sign * b[i] - x) * t);
  const size = Math.hypot(...q) || 1;
  return q.map((x) => x / size);
}

/// The matrix of a body's pose.
export function poseMatrix(p, q) {
  const x = turn(q, [1, 0, 0]);
  const y = turn(q, [0, 1, 0]);
  const z = turn(q, [0, 0, 1]);
  return new Float32Array([...x, 0, ...y, 0, ...z, 0, ...p, 1]);
}

export function multiply(a, b) {
  const m = new Float32Array(16);
  for (let column = 0; column < 4; ++column) {
    for (let row = 0; row < 4; ++row) {
      let sum = 0;
      for (let k = 0; k < 4; ++k) sum += a[4 * k + row] * b[4 * column + k];
      m[4 * column + row] = sum;
    }
  }
  return m;
}

/// fovy [rad].
export function perspective(fovy, aspect, near, far) {
  const f = 1 / Math.tan(fovy / 2);
  const m = new Float32Array(16);
  m[0] = f / aspect;
  m[5] = f;
  m[10] = (far + near) / (near - far);
  m[11] = -1;
  m[14] = (2 * far * near) / (near - far);
  return m;
}

export function lookAt(eye, target, up) {
  const back = normalised(sub(eye, target));
  const right = normalised(cross(up, back));
  const top = cross(back, right);
  return new Float32Array([
    right[0], top[0], back[0], 0,
    right[1], top[1], back[1], 0,
    right[2], top[2], back[2], 0,
    -dot(right, eye), -dot(top, eye), -dot(back, eye), 1,
  ]);
}

export function inverse(m) {
  const a = [];
  for (let row = 0; row < 4; ++row) {
    a.push([0, 1, 2, 3].map((k) => m[4 * k + row]).concat([0, 1, 2, 3].map((k) => +(k === row))));
  }
  for (let i = 0; i < 4; ++i) {
    let pivot = i;
    for (let k = i + 1; k < 4; ++k) if (Math.abs(a[k][i]) > Math.abs(a[pivot][i])) pivot = k;
    [a[i], a[pivot]] = [a[pivot], a[i]];
    const d = a[i][i];
    a[i] = a[i].map((x) => x / d);
    for (let k = 0; k < 4; ++k) {
      if (k === i) continue;
      const factor = a[k][i];
      for (let j = 0; j < 8; ++j) a[k][j] -= factor * a[i][j];
    }
  }
  const out = new Float32Array(16);
  for (let row = 0; row < 4; ++row) for (let k = 0; k < 4; ++k) out[4 * k + row] = a[row][4 + k];
  return out;
}

export function transform(m, p) {
  const w = m[3] * p[0] + m[7] * p[1] + m[11] * p[2] + m[15];
  return [0, 1, 2].map((i) => (m[i] * p[0] + m[4 + i] * p[1] + m[8 + i] * p[2] + m[12 + i]) / w);
}
