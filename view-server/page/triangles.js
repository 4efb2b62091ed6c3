// SPDX-License-Identifier: MIT
// Triangles of a mesh as they are drawn and picked, in its own axes [m].
import { cross, normalised, sub } from './vector.js';

/// Normals averaged over what meets at a place within 40 degrees: edges stay edges.
function normalsOf(places) {
  const flat = [];
  const meeting = new Map();
  for (let i = 0; i < places.length; i += 3) {
    const n = cross(sub(places[i + 1], places[i]), sub(places[i + 2], places[i]));
    for (let k = 0; k < 3; ++k) {
      flat.push(n);
      const key = places[i + k].map((x) => Math.round(x * 1e5)).join();
      if (!meeting.has(key)) meeting.set(key, []);
      meeting.get(key).push(n);
    }
  }
  return places.map((place, i) => {
    const own = normalised(flat[i]);
    const sum = [0, 0, 0];
    for (const n of meeting.get(place.map((x) => Math.round(x * 1e5)).join())) {
      const unit = normalised(n);
      if (unit[0] * own[0] + unit[1] * own[1] + unit[2] * own[2] < 0.77) continue;
      for (let k = 0; k < 3; ++k) sum[k] += n[k];
    }
    return normalised(sum.some((x) => x !== 0) ? sum : own);
  });
}

/// {places, normals}: three of each for a triangle of a mesh, which is {vertices, triangles}.
export function trianglesOf({ vertices, triangles }) {
  const places = triangles.flat().map((index) => vertices[index]);
  return { places, normals: normalsOf(places) };
}

/// Distance along a ray to the first triangle (Moeller & Trumbore 1997) [m], Infinity: none.
export function rayHits(places, from, along) {
  let nearest = Infinity;
  for (let i = 0; i < places.length; i += 3) {
    const e1 = sub(places[i + 1], places[i]);
    const e2 = sub(places[i + 2], places[i]);
    const p = cross(along, e2);
    const det = e1[0] * p[0] + e1[1] * p[1] + e1[2] * p[2];
    if (Math.abs(det) < 1e-14) continue;
    const s = sub(from, places[i]);
    const u = (s[0] * p[0] + s[1] * p[1] + s[2] * p[2]) / det;
    if (u < 0 || u > 1) continue;
    const q = cross(s, e1);
    const v = (along[0] * q[0] + along[1] * q[1] + along[2] * q[2]) / det;
    if (v < 0 || u + v > 1) continue;
    const t = (e2[0] * q[0] + e2[1] * q[1] + e2[2] * q[2]) / det;
    if (t > 0 && t < nearest) nearest = t;
  }
  return nearest;
}
