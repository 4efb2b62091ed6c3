// SPDX-License-Identifier: MIT
// The triangles of a body, in its own axes [m]: boxes with rounded edges and a curved sole, spheres,
// cylinders, meshes. Drawn and picked alike.
import { cross, normalised, sub, clamp } from './vector.js';

const GRID = 14; // quadrilaterals along an edge of the cube from which the forms are carried

/// How far a box's underside is above its flat middle [m], as sim-server/scene/shape.cpp has it.
export function rockerRise(shape, x) {
  if (!shape.rocker) return 0;
  const flat = shape.flat ?? 0;
  const share = Math.min((2 * Math.abs(x)) / shape.size[0], 1);
  const curved = Math.max(share - flat, 0) / (1 - flat);
  return shape.rocker * curved * curved;
}

function roundedBox(shape, cube) {
  const half = shape.size.map((edge) => edge / 2);
  const radius = 0.22 * Math.min(...half);
  const outer = cube.map((x, i) => x * half[i]);
  const inner = outer.map((x, i) => clamp(x, radius - half[i], half[i] - radius));
  const away = normalised(sub(outer, inner));
  const place = inner.map((x, i) => x + radius * away[i]);
  place[2] += (rockerRise(shape, place[0]) * (1 - place[2] / half[2])) / 2;
  return place;
}

function sphere(shape, cube) {
  return normalised(cube).map((x, i) => (x * shape.size[i]) / 2);
}

function cylinder(shape, cube) {
  const around = Math.hypot(cube[0], cube[1]);
  const reach = Math.max(Math.abs(cube[0]), Math.abs(cube[1]));
  const s = around > 0 ? reach / around : 1;
  return [cube[0] * s, cube[1] * s, cube[2]].map((x, i) => (x * shape.size[i]) / 2);
}

/// Corners of the cube's grid, denser near its edges, where a box is round.
function carriedCube(shape, carry) {
  const places = [];
  const at = (i) => {
    const t = (2 * i) / GRID - 1;
    return Math.sign(t) * (1 - (1 - Math.abs(t)) ** 2);
  };
  for (let axis = 0; axis < 3; ++axis) {
    for (const side of [-1, 1]) {
      const corner = (i, k) => {
        const cube = [0, 0, 0];
        cube[axis] = side;
        cube[(axis + 1) % 3] = at(i);
        cube[(axis + 2) % 3] = at(k);
        return carry(shape, cube);
      };
      for (let i = 0; i < GRID; ++i) {
        for (let k = 0; k < GRID; ++k) {
          const [a, b, c, d] = [corner(i, k), corner(i + 1, k), corner(i + 1, k + 1), corner(i, k + 1)];
          const both = side > 0 ? [a, b, c, a, c, d] : [a, c, b, a, d, c];
          places.push(...both);
        }
      }
    }
  }
  return places;
}

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

/// {places, normals}: three of each for a triangle.
export function trianglesOf(shape) {
  let places;
  if (shape.triangles) {
    places = shape.triangles.flat().map((index) => shape.vertices[index]);
  } else {
    const carry = { box: roundedBox, sphere, cylinder }[shape.kind];
    if (!carry) throw new Error(`a body of kind ${shape.kind} is not known`);
    places = carriedCube(shape, carry);
  }
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
