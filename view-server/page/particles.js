// SPDX-License-Identifier: MIT
// Two states' particles on the graphics card; shaders mix them. Locations 0: older place, 1: newer
// place, 2: speed and flags.

export const PARTICLE = `
layout(location = 0) in vec3 older;
layout(location = 1) in vec3 newer;
layout(location = 2) in uvec2 tag;
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
/// surface is as smooth there as anywhere. Three copies: at the x wall, the y wall, and both.
export const MIRRORED = `
uniform vec3 tankLower, tankUpper;
uniform float reach; // of the mirrored water beyond a wall [m]
bool mirrored(inout vec3 p, int copy) {
  vec2 wall = mix(tankLower.xy, tankUpper.xy, step(0.5 * (tankLower.xy + tankUpper.xy), p.xy));
  bvec2 turned = bvec2(copy != 1, copy != 0);
  bvec2 near = lessThan(abs(p.xy - wall), vec2(reach));
  if (turned.x) p.x = 2.0 * wall.x - p.x;
  if (turned.y) p.y = 2.0 * wall.y - p.y;
  return (near.x || !turned.x) && (near.y || !turned.y);
}
`;
export const REACH = 4; // spacings

export class Particles {
  constructor(gl) {
    this.gl = gl;
    this.held = [null, null];
    this.buffers = [gl.createBuffer(), gl.createBuffer()];
  }

  upload(index, state) {
    if (this.held[index] === state) return;
    if (index === 0 && this.held[1] === state) {
      this.buffers.reverse();
      this.held.reverse();
      return;
    }
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[index]);
    gl.bufferData(gl.ARRAY_BUFFER, state.particles, gl.STREAM_DRAW);
    this.held[index] = state;
  }

  /// What follows is drawn between these two.
  show({ older, newer, share }) {
    this.upload(0, older);
    this.upload(1, newer);
    this.uniforms = { frameOlder: [...older.lower, older.unit],
      frameNewer: [...newer.lower, newer.unit], share };
    this.count = newer.count;
    this.bubbles = newer.bubbles;
  }

  array(a, b, first, divisor) {
    const gl = this.gl;
    const handle = gl.createVertexArray();
    gl.bindVertexArray(handle);
    const from = (location, buffer) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[buffer]);
      gl.enableVertexAttribArray(location);
      gl.vertexAttribDivisor(location, divisor);
      if (location < 2) {
        gl.vertexAttribPointer(location, 3, gl.UNSIGNED_SHORT, false, 8, 8 * first);
      } else gl.vertexAttribIPointer(location, 2, gl.UNSIGNED_BYTE, 8, 8 * first + 6);
    };
    from(0, a);
    from(1, b);
    from(2, 1);
    return handle;
  }

  draw(first, count, a, copies) {
    if (count === 0) return;
    const gl = this.gl;
    const array = this.array(a, 1, first, copies ? 1 : 0);
    if (copies) gl.drawArraysInstanced(gl.POINTS, 0, copies, count);
    else gl.drawArrays(gl.POINTS, 0, count);
    gl.bindVertexArray(null);
    gl.deleteVertexArray(array);
  }

  /// The water: `copies` points for each particle if given (gl_VertexID tells them apart).
  drawWater(copies = 0) {
    this.draw(0, this.count, 0, copies);
  }

  /// Bubbles have no fixed order: those of the newer state.
  drawBubbles() {
    this.draw(this.count, this.bubbles, 1, 0);
  }
}
