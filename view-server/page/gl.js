// SPDX-License-Identifier: MIT
// What every pass needs of WebGL2: programs with their uniforms by name, textures, targets.

function compiled(gl, type, text) {
  const shader = gl.createShader(type);
  gl.shaderSource(shader, '#version 300 es\nprecision highp float;\nprecision highp int;\n' + text);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) {
    throw new Error(`shader: ${gl.getShaderInfoLog(shader)}\n${text}`);
  }
  return shader;
}

/// A program; its uniforms are set by `use(gl, program, {name: value})`.
export function program(gl, vertex, fragment) {
  const handle = gl.createProgram();
  gl.attachShader(handle, compiled(gl, gl.VERTEX_SHADER, vertex));
  gl.attachShader(handle, compiled(gl, gl.FRAGMENT_SHADER, fragment));
  gl.linkProgram(handle);
  if (!gl.getProgramParameter(handle, gl.LINK_STATUS) && !gl.isContextLost()) {
    throw new Error(`program: ${gl.getProgramInfoLog(handle)}`);
  }
  const uniforms = {};
  const count = gl.getProgramParameter(handle, gl.ACTIVE_UNIFORMS) || 0;
  for (let i = 0; i < count; ++i) {
    const info = gl.getActiveUniform(handle, i);
    const name = info.name.replace('[0]', '');
    uniforms[name] = { at: gl.getUniformLocation(handle, info.name), type: info.type };
  }
  return { handle, uniforms };
}

/// Chooses the program and sets what of `values` it has; a texture takes the next free unit.
export function use(gl, shader, values) {
  gl.useProgram(shader.handle);
  let unit = 0;
  for (const [name, { at, type }] of Object.entries(shader.uniforms)) {
    const value = values[name];
    if (value === undefined) throw new Error(`uniform ${name} is not given`);
    if (type === gl.FLOAT_MAT4) gl.uniformMatrix4fv(at, false, value);
    else if (type === gl.FLOAT) value.length ? gl.uniform1fv(at, value) : gl.uniform1f(at, value);
    else if (type === gl.FLOAT_VEC2) gl.uniform2fv(at, value);
    else if (type === gl.FLOAT_VEC3) gl.uniform3fv(at, value);
    else if (type === gl.FLOAT_VEC4) gl.uniform4fv(at, value);
    else if (type === gl.INT || type === gl.BOOL) gl.uniform1i(at, value);
    else {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, value);
      gl.uniform1i(at, unit++);
    }
  }
}

/// `kind`: [internal format, format, type]; `filter` gl.LINEAR or gl.NEAREST.
export function texture(gl, width, height, kind, filter) {
  const handle = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, handle);
  gl.texStorage2D(gl.TEXTURE_2D, 1, kind, width, height);
  for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) {
    gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
  }
  for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
    gl.texParameteri(gl.TEXTURE_2D, side, filter);
  }
  return handle;
}

/// Something to draw into: a colour texture of the given format, with a depth texture if asked.
export class Target {
  constructor(gl, format, filter, depth = false) {
    Object.assign(this, { gl, format, filter, depth, width: 0, height: 0 });
  }

  /// Makes it this large; what it held is lost when the size changes.
  fit(width, height) {
    if (width === this.width && height === this.height) return this;
    const gl = this.gl;
    this.free();
    Object.assign(this, { width, height, frame: gl.createFramebuffer() });
    this.colour = texture(gl, width, height, this.format, this.filter);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
    const attach = (where, handle) =>
      gl.framebufferTexture2D(gl.FRAMEBUFFER, where, gl.TEXTURE_2D, handle, 0);
    attach(gl.COLOR_ATTACHMENT0, this.colour);
    if (this.depth) {
      this.distance = texture(gl, width, height, gl.DEPTH_COMPONENT24, gl.NEAREST);
      attach(gl.DEPTH_ATTACHMENT, this.distance);
    }
    return this;
  }

  free() {
    for (const handle of [this.colour, this.distance]) if (handle) this.gl.deleteTexture(handle);
    if (this.frame) this.gl.deleteFramebuffer(this.frame);
  }

  /// Draws go here from now on.
  bind(clear) {
    const gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
    gl.viewport(0, 0, this.width, this.height);
    if (!clear) return;
    gl.clearColor(...clear);
    gl.clear(gl.COLOR_BUFFER_BIT | (this.depth ? gl.DEPTH_BUFFER_BIT : 0));
  }
}

/// One triangle over everything; `uv` runs from 0 to 1.
export const OVER_ALL = `
out vec2 uv;
void main() {
  uv = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0;
  gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);
}`;

/// Runs a program of `OVER_ALL` once for each pixel of what is bound.
export function overAll(gl, shader, values) {
  gl.disable(gl.DEPTH_TEST);
  use(gl, shader, values);
  gl.bindVertexArray(null);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
}
