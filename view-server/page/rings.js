// SPDX-License-Identifier: MIT
// Rings that spread on the water where bodies met it and where cavities closed; sparks at bubbles.
import { program, use } from './gl.js';

export const COLOURS = { '/impact': [1.0, 0.72, 0.28], '/bubble': [0.35, 0.85, 1.0],
  '/cavity': [0.85, 0.45, 1.0] };
const LIFE = { '/impact': 0.9, '/bubble': 0.35, '/cavity': 1.3 }; // [s]
const MOST = 64;

const NUMBERS = 8; // of a ring, as the shader takes them
const VERTEX = `
layout(location = 0) in vec4 centre; // place and radius [m]
layout(location = 1) in vec4 look; // tint and age
uniform mat4 both;
out vec2 q;
flat out vec3 tint;
flat out float age; // share of its life
void main() {
  tint = look.rgb;
  age = look.a;
  q = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  gl_Position = both * vec4(centre.xyz + vec3(q * centre.w, 0.0), 1.0);
}`;
const FRAGMENT = `
in vec2 q;
flat in vec3 tint;
flat in float age;
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
    this.numbers = new Float32Array(NUMBERS * MOST);
    this.buffer = gl.createBuffer();
    this.handle = gl.createVertexArray();
    gl.bindVertexArray(this.handle);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    for (const location of [0, 1]) {
      gl.enableVertexAttribArray(location);
      gl.vertexAttribPointer(location, 4, gl.FLOAT, false, 4 * NUMBERS, 16 * location);
      gl.vertexAttribDivisor(location, 1);
    }
    gl.bindVertexArray(null);
  }

  add(event) {
    this.all.push(event);
    if (this.all.length > MOST) this.all.shift();
  }

  draw(camera, now, size) {
    this.all = this.all.filter((e) => now - e.time < LIFE[e.kind]);
    let count = 0;
    for (const { kind, time, place, strength } of this.all) {
      if (now < time) continue;
      const age = (now - time) / LIFE[kind];
      const radius = size * (kind === '/bubble' ? 0.012 + 0.01 * age
        : (0.03 + 0.22 * Math.sqrt(age)) * (0.5 + 0.7 * strength));
      this.numbers.set([...place, radius, ...COLOURS[kind], age], NUMBERS * count++);
    }
    if (count === 0) return;
    const { gl } = this;
    use(gl, this.shader, { both: camera.both });
    gl.bindVertexArray(this.handle);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, this.numbers.subarray(0, NUMBERS * count), gl.STREAM_DRAW);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count);
    gl.bindVertexArray(null);
  }
}
