// SPDX-License-Identifier: MIT
// Where textures of floats cannot be drawn into, or graphics are too slow for water: the water as
// shaded points, the tank's edges, and the bodies as they are, dimmed behind the water.
import { OVER_ALL, program, texture, use } from './gl.js';
import { GROUND, SOLID_VERTEX, STILL } from './solids.js';
import { Splats } from './splats.js';

const FRAGMENT = `
in vec2 uv;
uniform highp sampler2D axial, tone;
uniform mat4 projection;
out vec4 colour;
void main() {
  float w = texture(axial, uv).x;
  float depth = 0.5 + 0.5 * (projection[3][2] / w - projection[2][2]);
  if (depth > 1.0) discard;
  gl_FragDepth = depth;
  vec2 coded = texture(tone, uv).xy; // root of the speed over 8 m/s; how much the disc faces us
  float speed = 8.0 * coded.x * coded.x; // [m/s]
  vec3 tint = mix(vec3(0.10, 0.45, 0.62), vec3(0.9, 0.97, 1.0), smoothstep(0.2, 2.5, speed));
  colour = vec4(tint * (0.55 + 0.45 * coded.y), 1.0);
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

export class Points {
  constructor(gl) {
    this.gl = gl;
    this.water = program(gl, OVER_ALL, FRAGMENT);
    this.solid = program(gl, SOLID_VERTEX, SOLID_FRAGMENT);
    this.splats = new Splats();
    this.size = {};
  }

  /// The splats as textures.
  upload({ width, height, axial, tone }) {
    const gl = this.gl;
    if (width !== this.size.width || height !== this.size.height) {
      for (const handle of [this.axial, this.tone]) if (handle) gl.deleteTexture(handle);
      this.size = { width, height };
      this.axial = texture(gl, width, height, gl.R32F, gl.NEAREST);
      this.tone = texture(gl, width, height, gl.RG8, gl.NEAREST);
    }
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1); // rows of two bytes a pixel
    for (const [handle, format, type, data] of [[this.axial, gl.RED, gl.FLOAT, axial],
      [this.tone, gl.RG, gl.UNSIGNED_BYTE, tone]]) {
      gl.bindTexture(gl.TEXTURE_2D, handle);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, format, type, data);
    }
    return { axial: this.axial, tone: this.tone };
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
    const splats = this.splats.draw(particles.view, camera, radius, { width, height }, stride);
    use(gl, this.water, { ...camera, ...this.upload(splats) });
    gl.bindVertexArray(null);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthFunc(gl.GREATER);
    drawSolids(solids.bodies, BEHIND);
    gl.depthFunc(gl.LESS);
    drawMarks();
    gl.disable(gl.BLEND);
  }
}
