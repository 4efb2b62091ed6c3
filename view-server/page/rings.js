// SPDX-License-Identifier: MIT
// Rings that spread on the water where bodies met it and where cavities closed; sparks at bubbles.
import { program, use } from './gl.js';

export const COLOURS = { '/impact': [1.0, 0.72, 0.28], '/bubble': [0.35, 0.85, 1.0],
  '/cavity': [0.85, 0.45, 1.0] };
const LIFE = { '/impact': 0.9, '/bubble': 0.35, '/cavity': 1.3 }; // [s]
const MOST = 64;

const VERTEX = `
uniform mat4 both;
uniform vec4 centre; // place and radius [m]
out vec2 q;
void main() {
  q = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  gl_Position = both * vec4(centre.xyz + vec3(q * centre.w, 0.0), 1.0);
}`;
const FRAGMENT = `
in vec2 q;
uniform vec3 tint;
uniform float age; // share of its life
out vec4 colour;
void main() {
  float r = length(q);
  float line = exp(-pow((r - 0.88) / 0.05, 2.0)) + 0.5 * exp(-pow((r - 0.62) / 0.07, 2.0));
  colour = vec4(tint * 1.6, line * (1.0 - age) * (1.0 - age) * 0.75);
}`;

export class Rings {
  constructor(gl) {
    this.gl = gl;
    this.shader = program(gl, VERTEX, FRAGMENT);
    this.all = [];
  }

  add(event) {
    this.all.push(event);
    if (this.all.length > MOST) this.all.shift();
  }

  draw(camera, now, size) {
    this.all = this.all.filter((e) => now - e.time < LIFE[e.kind]);
    for (const { kind, time, place, strength } of this.all) {
      if (now < time) continue;
      const age = (now - time) / LIFE[kind];
      const radius = size * (kind === '/bubble' ? 0.012 + 0.01 * age
        : (0.03 + 0.22 * Math.sqrt(age)) * (0.5 + 0.7 * strength));
      use(this.gl, this.shader, { both: camera.both, centre: [...place, radius], age,
        tint: COLOURS[kind] });
      this.gl.bindVertexArray(null);
      this.gl.drawArrays(this.gl.TRIANGLE_STRIP, 0, 4);
    }
  }
}
