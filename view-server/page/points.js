// SPDX-License-Identifier: MIT
// Where textures of floats cannot be drawn into: the water as shaded points, bodies as they are.
import { program, use } from './gl.js';
import { PARTICLE } from './particles.js';

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
const BODY_VERTEX = `
layout(location = 0) in vec3 own;
layout(location = 1) in vec3 normal;
uniform mat4 pose, both;
out vec3 n;
void main() {
  n = mat3(pose) * normal;
  gl_Position = both * pose * vec4(own, 1.0);
}`;
const BODY_FRAGMENT = `
in vec3 n;
uniform vec3 tint;
uniform float glow;
out vec4 colour;
void main() {
  colour = vec4(tint * (0.5 + 0.5 * abs(normalize(n).z)) + 0.3 * glow, 1.0);
}`;

export class Points {
  constructor(gl) {
    this.gl = gl;
    this.water = program(gl, VERTEX, FRAGMENT);
    this.body = program(gl, BODY_VERTEX, BODY_FRAGMENT);
  }

  draw({ width, height }, camera, world, particles, solids, drawMarks) {
    const gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.clearColor(0.04, 0.07, 0.10, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    for (const { pose, tint, glow, draw } of solids.bodies) {
      use(gl, this.body, { ...camera, pose, tint, glow });
      draw();
    }
    use(gl, this.water, { ...camera, ...particles.uniforms, radius: 0.5 * world.spacing, height });
    particles.drawWater();
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    drawMarks();
    gl.disable(gl.BLEND);
  }
}
