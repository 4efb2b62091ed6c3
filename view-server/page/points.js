// SPDX-License-Identifier: MIT
// Where textures of floats cannot be drawn into, or graphics are too slow for water: the water as
// shaded points, the tank's edges, and the bodies as they are, dimmed behind the water.
import { program, use } from './gl.js';
import { PARTICLE } from './particles.js';
import { Seen } from './seen.js';
import { GROUND, SOLID_VERTEX, STILL } from './solids.js';

const VERTEX = `${PARTICLE}
uniform mat4 both, projection;
uniform float radius, height;
out vec3 tint;
void main() {
  gl_Position = both * vec4(place(), 1.0);
  gl_PointSize = max(projection[1][1] * radius * height / gl_Position.w, 1.0);
  tint = mix(vec3(0.10, 0.45, 0.62), vec3(0.9, 0.97, 1.0), smoothstep(0.2, 2.5, speed()));
}`;
const FRAGMENT = `
in vec3 tint;
out vec4 colour;
void main() {
  vec2 q = gl_PointCoord * 2.0 - 1.0;
  if (dot(q, q) > 1.0) discard;
  colour = vec4(tint * (0.55 + 0.45 * sqrt(1.0 - dot(q, q))), 1.0);
}`;
const SOLID_FRAGMENT = `
in vec3 facing;
uniform vec3 tint;
uniform float glow, cover;
out vec4 colour;
void main() {
  colour = vec4(tint * (0.5 + 0.5 * abs(normalize(facing).z)) + 0.3 * glow, cover);
}`;
const BEHIND = 0.4; // of a body's light comes through the water before it
const MOST = 0.4; // of the points
const REST = 100; // pictures

export class Points {
  constructor(gl) {
    this.gl = gl;
    this.water = program(gl, VERTEX, FRAGMENT);
    this.solid = program(gl, SOLID_VERTEX, SOLID_FRAGMENT);
    this.seen = new Seen();
    this.rest = 0; // pictures of which all points are drawn
  }

  /// The numbers of the points that are seen; null: all are drawn. Where most are seen, as in shallow
  /// water, looking for the others takes longer than drawing them: a while later is soon enough.
  pick(particles, camera, radius, size) {
    if (this.rest > 0) {
      this.rest -= 1;
      return null;
    }
    const picked = this.seen.pick(particles.view, camera, radius, size);
    if (picked.length > MOST * particles.count) this.rest = REST;
    return picked;
  }

  /// One in `stride` of the points, as large as to fill the same space.
  draw({ width, height }, camera, world, particles, solids, drawMarks, stride = 1) {
    const gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.clearColor(0.04, 0.07, 0.10, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    const drawSolids = (all, cover, bars = { halfThick: 0, halfPixel: 0 }) => {
      for (const { pose = STILL, tint, glow = 0, draw } of all) {
        use(gl, this.solid, { ...camera, ...bars, pose, tint, glow, cover });
        draw();
      }
    };
    drawSolids([...solids.bodies, ...solids.still.filter(({ material }) => material !== GROUND)], 1);
    drawSolids([solids.edges], 1, solids.bars(camera, height));
    const radius = 0.5 * world.spacing * Math.cbrt(stride);
    use(gl, this.water, { ...camera, ...particles.uniforms, radius, height });
    const picked = stride > 1 ? null : this.pick(particles, camera, radius, { width, height });
    particles.drawWater(picked, stride);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthFunc(gl.GREATER);
    drawSolids(solids.bodies, BEHIND);
    gl.depthFunc(gl.LESS);
    drawMarks();
    gl.disable(gl.BLEND);
  }
}
