// SPDX-License-Identifier: MIT
// One lamp above the tank, seen from it: how high bodies and water stand, so that bodies throw
// shadows and the water's surface throws caustics on what lies below.
import { OVER_ALL, Target, overAll, program, use } from './gl.js';
import { MIRRORED, PARTICLE } from './particles.js';
import { REACH } from './several.js';

const SIDE = 256; // texels of the maps' edges
const COARSE = 128; // where the picture has half its pixels along each axis, or fewer
const LEAN = [0.22, -0.14]; // of the lamp's rays: x and y over z

/// GLSL: a room's light by direction, the lamp's rays, and what of them reaches a place.
export const LIGHT = `
const vec2 LEAN = vec2(${LEAN.join(', ')});
uniform vec4 mapBox;   // lower corner, size [m] of what the maps show at the floor's height
uniform vec4 walls;    // of the tank, lower and upper corner seen from above [m]
uniform float floorZ;
uniform float level;   // of the water at rest [m]: heights count from there, so that small ones are fine

/// Towards the lamp.
vec3 lamp() { return normalize(vec3(LEAN, 1.0)); }

/// Radiance of the room from a direction: dim walls, a bright window above, the lamp's disc.
vec3 room(vec3 d) {
  float up = d.z;
  vec3 wall = mix(vec3(0.055, 0.085, 0.12), vec3(0.16, 0.24, 0.33), smoothstep(-0.25, 0.75, up));
  wall += vec3(0.30, 0.36, 0.42) * exp(-14.0 * (up - 0.12) * (up - 0.12));
  vec2 w = d.xy / max(up, 0.05) - vec2(-0.55, 0.75);
  vec2 inside = smoothstep(vec2(0.62, 0.42), vec2(0.42, 0.26), abs(w));
  wall += vec3(1.7, 1.85, 2.0) * inside.x * inside.y * step(0.05, up);
  float sun = max(dot(d, lamp()), 0.0);
  return wall + vec3(9.0, 8.4, 7.4) * smoothstep(0.9965, 0.9985, sun)
       + vec3(0.5, 0.47, 0.4) * pow(sun, 60.0);
}

/// Where the maps hold what the lamp's ray through a place meets.
vec2 mapPlace(vec3 p) {
  return (p.xy - LEAN * (p.z - floorZ) - mapBox.xy) / mapBox.zw;
}
`;

/// GLSL for what is lit. heights: r: bodies [m]; waves: r: water [m], g: its light, b: covered.
export const LIT = `
uniform sampler2D heights, waves;

float lampReaches(vec3 p) {
  vec2 at = mapPlace(p), apart = 1.7 / vec2(textureSize(heights, 0));
  if (any(greaterThan(abs(at - 0.5), 0.5 + apart))) return 1.0;
  float lit = 0.0;
  for (int i = -1; i <= 1; ++i) for (int k = -1; k <= 1; ++k) {
    vec2 near = at + vec2(i, k) * apart;
    bool off = clamp(near, 0.0, 1.0) != near; // the map ends there
    lit += off || texture(heights, near).r < p.z + 0.012 * (1.0 + length(mapBox.zw)) ? 1.0 : 0.0;
  }
  return lit / 9.0;
}

/// Caustics below the surface, 1 above it.
float waterLight(vec3 p) {
  bool out_ = any(lessThan(p.xy, walls.xy - 0.002)) || any(greaterThan(p.xy, walls.zw + 0.002));
  if (out_) return 1.0;
  vec4 w = texture(waves, mapPlace(p));
  if (w.b < 0.01) return 1.0;
  return mix(1.0, w.g, w.b * smoothstep(0.0, 0.02, level + w.r / w.b - p.z));
}
`;

const FALL = `
/// The lamp's picture of a place; w orders by height.
vec4 fromLamp(vec3 p) {
  return vec4(mapPlace(p) * 2.0 - 1.0, -(p.z - floorZ) / (4.0 * (mapBox.z + mapBox.w)), 1.0);
}
`;

const WATER_VERTEX = `${PARTICLE}${LIGHT}${FALL}
uniform float radius, side; // side: the map's [texels]
out float height;
void main() {
  vec3 p = place();
  height = p.z;
  gl_Position = (tag.y & SPRAY) != 0u ? vec4(2.0, 2.0, 2.0, 1.0) : fromLamp(p);
  gl_PointSize = max(2.0 * radius / max(mapBox.z, mapBox.w) * side, 2.0);
}`;

const MIRROR_VERTEX = `${PARTICLE}${LIGHT}${FALL}${MIRRORED}
uniform float radius, side; // side: the map's [texels]
out float height;
void main() {
  vec3 p = place();
  bool there = mirrored(p);
  height = p.z;
  gl_Position = there ? fromLamp(p) : vec4(2.0, 2.0, 2.0, 1.0);
  gl_PointSize = max(2.0 * radius / max(mapBox.z, mapBox.w) * side, 2.0);
}`;

const WATER_FRAGMENT = `
uniform float radius, level;
in float height;
out vec4 colour;
void main() {
  vec2 q = gl_PointCoord * 2.0 - 1.0;
  float rest = 1.0 - dot(q, q);
  if (rest < 0.0) discard;
  colour = vec4(height - level + radius * (sqrt(rest) - 0.4), 0.0, 1.0, 1.0);
}`;

/// Gaussian along one axis of height (times coverage) and coverage.
const SMOOTH = `
in vec2 uv;
uniform sampler2D source;
uniform vec2 along;
out vec4 colour;
void main() {
  vec2 sum = vec2(0.0);
  float all = 0.0;
  for (int i = -7; i <= 7; ++i) {
    float w = exp(-float(i * i) / 18.0);
    vec4 s = texture(source, uv + float(i) * along);
    sum += w * vec2(s.b > 0.0 ? s.r : 0.0, s.b);
    all += w;
  }
  colour = vec4(sum.x / all, 0.0, sum.y / all, 1.0);
}`;

/// Rays that a surface h refracts meet a floor d below at x - c grad h, c = d (1 - 1/1.33): their
/// density is one over the determinant of that map.
const CAUSTICS = `${LIGHT}
in vec2 uv;
uniform sampler2D source;
out vec4 colour;
float h(vec2 at) { vec4 s = texture(source, at); return s.b > 0.05 ? s.r / s.b : floorZ - level; }
void main() {
  vec4 s = texture(source, uv);
  float covered = s.b;
  vec2 e = 2.0 / vec2(textureSize(source, 0)), m = e * mapBox.zw;
  float z = h(uv), c = 0.25 * max(z + level - floorZ, 0.0) + 0.02;
  float xx = (h(uv + vec2(e.x, 0.0)) - 2.0 * z + h(uv - vec2(e.x, 0.0))) / (m.x * m.x);
  float yy = (h(uv + vec2(0.0, e.y)) - 2.0 * z + h(uv - vec2(0.0, e.y))) / (m.y * m.y);
  float xy = (h(uv + e) - h(uv + vec2(e.x, -e.y)) - h(uv + vec2(-e.x, e.y)) + h(uv - e))
             / (4.0 * m.x * m.y);
  float spread = (1.0 - c * xx) * (1.0 - c * yy) - c * c * xy * xy;
  float light = clamp(1.0 / max(abs(spread), 0.25), 0.5, 2.4);
  colour = vec4(s.r, covered > 0.9 ? light : 1.0, covered, 1.0);
}`;

const BODY_VERTEX = `${LIGHT}${FALL}
layout(location = 0) in vec3 own;
uniform mat4 pose;
out float height;
void main() {
  vec3 p = (pose * vec4(own, 1.0)).xyz;
  height = p.z;
  gl_Position = fromLamp(p);
}`;
const BODY_FRAGMENT = `
in float height;
out vec4 colour;
void main() { colour = vec4(height, 0.0, 1.0, 1.0); }`;

export class LightMaps {
  constructor(gl) {
    this.gl = gl;
    // Caustics are made of second differences, which half floats leave in steps.
    const fine = gl.getExtension('OES_texture_float_linear') ? gl.RGBA32F : gl.RGBA16F;
    const near = () => new Target(gl, fine, gl.LINEAR);
    this.heights = new Target(gl, gl.RGBA16F, gl.NEAREST, true);
    this.raw = new Target(gl, fine, gl.LINEAR, true);
    this.other = near();
    this.waves = near();
    this.water = program(gl, WATER_VERTEX, WATER_FRAGMENT);
    this.mirror = program(gl, MIRROR_VERTEX, WATER_FRAGMENT);
    this.body = program(gl, BODY_VERTEX, BODY_FRAGMENT);
    this.smooth = program(gl, OVER_ALL, SMOOTH);
    this.caustics = program(gl, OVER_ALL, CAUSTICS);
  }

  /// `world`: tank, spacing; `bodies`: solids to draw; `sharp`: share of the pixels along each axis
  /// that the picture has.
  draw(world, particles, bodies, sharp) {
    const gl = this.gl;
    const side = sharp > 0.5 ? SIDE : COARSE;
    for (const map of [this.heights, this.raw, this.other, this.waves]) map.fit(side, side);
    const { lower, upper } = world.tank;
    const margin = 0.08 * Math.max(upper[0] - lower[0], upper[1] - lower[1]);
    this.uniforms = { floorZ: lower[2], level: world.level,
      walls: [lower[0], lower[1], upper[0], upper[1]], mapBox: [lower[0] - margin, lower[1] - margin,
      upper[0] - lower[0] + 2 * margin, upper[1] - lower[1] + 2 * margin] };
    gl.enable(gl.DEPTH_TEST);
    gl.disable(gl.BLEND);
    this.heights.bind([-1000, 0, 0, 0]);
    for (const body of bodies) {
      use(gl, this.body, { ...this.uniforms, pose: body.pose });
      body.draw();
    }
    this.raw.bind([0, 0, 0, 0]);
    const shared = { ...this.uniforms, ...particles.uniforms, side, radius: 0.75 * world.spacing,
      tankLower: lower, tankUpper: upper, reach: REACH * world.spacing };
    use(gl, this.water, shared);
    particles.drawWater();
    use(gl, this.mirror, shared);
    particles.drawMirrored();
    const step = (0.42 * world.spacing) / 3;
    const wide = this.uniforms.mapBox;
    this.other.bind();
    overAll(gl, this.smooth, { source: this.raw.colour, along: [step / wide[2], 0] });
    this.waves.bind();
    overAll(gl, this.smooth, { source: this.other.colour, along: [0, step / wide[3]] });
    this.other.bind();
    overAll(gl, this.smooth, { source: this.waves.colour, along: [2 * step / wide[2], 0] });
    this.raw.bind();
    overAll(gl, this.smooth, { source: this.other.colour, along: [0, 2 * step / wide[3]] });
    this.waves.bind();
    overAll(gl, this.caustics, { ...this.uniforms, source: this.raw.colour });
    Object.assign(this.uniforms, { heights: this.heights.colour, waves: this.waves.colour });
  }
}
