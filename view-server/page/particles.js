// SPDX-License-Identifier: MIT
// Two states' particles on the graphics card; shaders mix them. Locations 0: older place, 1: newer
// place, 2: speed and flags, 3: which it is of those that are drawn several times.
import { WORDS, several } from './several.js';

export const PARTICLE = `
layout(location = 0) in vec3 older;
layout(location = 1) in vec3 newer;
layout(location = 2) in uvec2 tag;
layout(location = 3) in uint part;
uniform vec4 frameOlder, frameNewer; // lower corner, metres per count
uniform float share;
const uint BUBBLE = 1u, SPRAY = 4u;

vec3 place() {
  vec3 a = frameOlder.xyz + frameOlder.w * older;
  vec3 b = frameNewer.xyz + frameNewer.w * newer;
  return mix(a, b, share);
}
float speed() { float s = float(tag.x) / 255.0; return 8.0 * s * s; }
`;

/// Water reaches up to the tank's walls, particles do not: mirrored at them it goes on, so that its
/// surface is as smooth there as anywhere. Parts: 0 at the x wall, 1 at the y wall, 2 at both.
export const MIRRORED = `
uniform vec3 tankLower, tankUpper;
uniform float reach; // of the mirrored water beyond a wall [m]
bool mirrored(inout vec3 p) {
  vec2 wall = mix(tankLower.xy, tankUpper.xy, step(0.5 * (tankLower.xy + tankUpper.xy), p.xy));
  bvec2 turned = bvec2(part != 1u, part != 0u);
  bvec2 near = lessThan(abs(p.xy - wall), vec2(reach));
  if (turned.x) p.x = 2.0 * wall.x - p.x;
  if (turned.y) p.y = 2.0 * wall.y - p.y;
  return (near.x || !turned.x) && (near.y || !turned.y);
}
`;
const PLACE = 8; // bytes, speed and flags among them

export class Particles {
  constructor(gl) {
    this.gl = gl;
    this.held = [null, null];
    this.buffers = [gl.createBuffer(), gl.createBuffer()];
    this.several = { mirrored: { buffer: gl.createBuffer() }, drops: { buffer: gl.createBuffer() } };
    this.picked = {}; // {older, newer}, of which those are
  }

  fill(buffer, data) {
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.STREAM_DRAW);
  }

  upload(index, state) {
    if (this.held[index] === state) return;
    if (index === 0 && this.held[1] === state) {
      this.buffers.reverse();
      this.held.reverse();
      return;
    }
    this.fill(this.buffers[index], state.particles);
    this.held[index] = state;
  }

  /// What follows is drawn between these two; `world`: tank, paddle, spacing; null: the page itself
  /// draws them, as points.
  show(view, world) {
    const { older, newer, share } = view;
    this.view = view;
    this.count = newer.count;
    this.bubbles = newer.bubbles;
    if (!world) return;
    if (this.picked.older !== older || this.picked.newer !== newer) {
      for (const [kind, { used, count }] of Object.entries(several({ older, newer }, world))) {
        this.fill(this.several[kind].buffer, used);
        this.several[kind].count = count;
      }
      this.picked = { older, newer };
    }
    this.upload(0, older);
    this.upload(1, newer);
    this.uniforms = { frameOlder: [...older.lower, older.unit],
      frameNewer: [...newer.lower, newer.unit], share };
  }

  /// Points out of buffers: where the older and the newer places lie in them, and how far apart; the
  /// parts follow the newer places where there are any.
  draw(count, [from, at], [to, then], stride, parts = false) {
    if (count === 0) return;
    const gl = this.gl;
    const handle = gl.createVertexArray();
    gl.bindVertexArray(handle);
    const take = (location, buffer, set) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.enableVertexAttribArray(location);
      set();
    };
    take(0, from, () => gl.vertexAttribPointer(0, 3, gl.UNSIGNED_SHORT, false, stride, at));
    take(1, to, () => gl.vertexAttribPointer(1, 3, gl.UNSIGNED_SHORT, false, stride, then));
    take(2, to, () => gl.vertexAttribIPointer(2, 2, gl.UNSIGNED_BYTE, stride, then + 6));
    if (parts) take(3, to, () => gl.vertexAttribIPointer(3, 1, gl.UNSIGNED_INT, stride, then + PLACE));
    else gl.vertexAttribI4ui(3, 0, 0, 0, 0);
    gl.drawArrays(gl.POINTS, 0, count);
    gl.bindVertexArray(null);
    gl.deleteVertexArray(handle);
  }

  drawWater() {
    this.draw(this.count, [this.buffers[0], 0], [this.buffers[1], 0], PLACE);
  }

  /// Bubbles have no fixed order: those of the newer state.
  drawBubbles() {
    const at = [this.buffers[1], PLACE * this.count];
    this.draw(this.bubbles, at, at, PLACE);
  }

  drawSeveral({ buffer, count }) {
    this.draw(count, [buffer, 0], [buffer, PLACE], 4 * WORDS, true);
  }

  drawMirrored() {
    this.drawSeveral(this.several.mirrored);
  }

  drawDrops() {
    this.drawSeveral(this.several.drops);
  }
}
