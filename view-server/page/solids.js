// SPDX-License-Identifier: MIT
// What is not water: the ground, the tank with its floor, slope and tiles, and the bodies.
import { program, use } from './gl.js';
import { LIGHT, LIT } from './light.js';
import { trianglesOf } from './triangles.js';
import { normalised, poseMatrix } from './vector.js';

export const SOLID_VERTEX = `
layout(location = 0) in vec3 own;
layout(location = 1) in vec3 normal;
uniform mat4 pose, both;
uniform vec3 eye;
uniform float halfThick, halfPixel; // of a bar [m], of the picture at distance 1 [m]; 0: no bar
out vec3 world, facing;
void main() {
  vec4 p = pose * vec4(own, 1.0);
  facing = mat3(pose) * normal;
  // Bars are at least as thick as a pixel, else they are seen as dashes.
  p.xyz += facing * max(halfPixel * length(p.xyz - eye) - halfThick, 0.0);
  world = p.xyz;
  gl_Position = both * p;
}`;

/// material 0: ground, 1: the tank's floor, 2: body, 3: edge of the tank.
const FRAGMENT = `${LIGHT}${LIT}
in vec3 world, facing;
uniform vec3 eye, tint;
uniform int material;
uniform bool sand;          // a floor without seams
uniform float glow;
uniform vec4 tiles;         // corner [m], edge [m], columns; no columns: none
uniform float levels[64];
uniform vec4 tankBox;       // lower and upper corner, seen from above
uniform sampler2D water;    // how far it is [m], 0: none; hides the tank's edges behind it
uniform vec2 pixels;        // of the picture; 0: nothing is hidden
out vec4 colour;

float seam(vec2 p, float edge) {
  vec2 d = abs(fract(p / edge) - 0.5) * edge;
  vec2 w = fwidth(p) + 0.0035;
  vec2 s = smoothstep(vec2(0.5 * edge) - w, vec2(0.5 * edge) - 0.3 * w, d);
  return max(s.x, s.y);
}

float tileLevel(vec2 p) {
  vec2 t = floor((p - tiles.xy) / tiles.z);
  int index = int(t.x + tiles.w * t.y);
  bool on = t.x >= 0.0 && t.y >= 0.0 && t.x < tiles.w && index < 64;
  return on ? levels[index] : 0.0;
}

void main() {
  if (material == 3 && pixels.x > 0.0) {
    float w = texture(water, gl_FragCoord.xy / pixels).r;
    if (w > 0.0 && w < 1.0 / gl_FragCoord.w - 0.004) discard;
  }
  vec3 n = normalize(facing), view = normalize(eye - world);
  if (dot(n, view) < 0.0 && material == 2) n = -n;
  vec3 base = tint;
  vec3 own = vec3(0.0);
  float gloss = 0.04;
  if (material == 0) {
    vec2 middle = 0.5 * (tankBox.xy + tankBox.zw), wide = tankBox.zw - tankBox.xy;
    vec2 out_ = max(abs(world.xy - middle) - 0.5 * wide, 0.0) / max(wide.x, wide.y);
    float far = length(out_);
    base *= 0.35 + 0.65 * smoothstep(0.0, 0.10, far);
    gloss = 0.03;
  }
  if (material == 1) {
    float edge = tiles.w > 0.0 ? tiles.z : length(tankBox.zw - tankBox.xy) / 9.0;
    vec2 corner = tiles.w > 0.0 ? tiles.xy : 0.5 * (tankBox.xy + tankBox.zw);
    float s = sand ? 0.0 : seam(world.xy - corner, edge);
    vec2 cell = floor((world.xy - corner) / edge);
    float vary = sand ? 0.5 : fract(sin(dot(cell, vec2(12.98, 78.23))) * 43758.5);
    base = base * (0.93 + 0.10 * vary) * (1.0 - 0.45 * s);
    float level = tileLevel(world.xy);
    float drawn = level > 0.0 ? clamp(1.2 + log(level) / 5.76, 0.0, 1.0) : 0.0; // -60 to -10 dB
    vec2 q = abs(fract((world.xy - corner) / edge) - 0.5) * 2.0;
    float rim = pow(max(q.x, q.y), 6.0);
    own = vec3(8.0, 3.4, 0.5) * drawn * drawn * (0.5 + 1.0 * rim) * (1.0 - s);
  }
  float lit = lampReaches(world + 0.004 * n);
  float caustic = waterLight(world);
  vec3 light = vec3(0.30, 0.36, 0.42) * (0.65 + 0.35 * n.z)
             + vec3(1.45, 1.36, 1.2) * max(dot(n, lamp()), 0.0) * lit * caustic;
  vec3 seen = base * light + own;
  vec3 r = reflect(-view, n);
  float f = gloss + (1.0 - gloss) * pow(1.0 - max(dot(n, view), 0.0), 5.0);
  if (material >= 2) seen += f * min(room(r), vec3(2.0)) * (0.4 + 0.6 * lit);
  if (material == 2) seen += glow * (0.25 + pow(1.0 - max(dot(n, view), 0.0), 2.0))
                             * vec3(0.25, 0.85, 1.0);
  if (material == 0) {
    float far = length(world.xy - 0.5 * (tankBox.xy + tankBox.zw)) / length(tankBox.zw - tankBox.xy);
    seen = mix(seen, vec3(0.012, 0.02, 0.032), smoothstep(0.6, 3.2, far));
  }
  colour = vec4(seen, 1.0);
}`;

export const GROUND = 0;
const NONE = new Float32Array(64); // no tile is lit
export const STILL = new Float32Array([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
export const PALETTE = [[0.72, 0.20, 0.11], [0.78, 0.45, 0.07], [0.60, 0.12, 0.30],
  [0.28, 0.50, 0.12]];

function meshOn(gl, places, normals) {
  const handle = gl.createVertexArray();
  gl.bindVertexArray(handle);
  [places, normals].forEach((list, location) => {
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(list.flat()), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(location);
    gl.vertexAttribPointer(location, 3, gl.FLOAT, false, 0, 0);
  });
  gl.bindVertexArray(null);
  return () => {
    gl.bindVertexArray(handle);
    gl.drawArrays(gl.TRIANGLES, 0, places.length);
    gl.bindVertexArray(null);
  };
}

function quad(a, b, c, d, normal) {
  return { places: [a, b, c, a, c, d], normals: Array(6).fill(normal) };
}

const joined = (parts) => ({ places: parts.flatMap((p) => p.places),
  normals: parts.flatMap((p) => p.normals) });

/// The box from a to b, `thick` more along each axis. `round`: faces share the normals of their
/// corners, so that a box which the shader widens stays closed.
function bar(a, b, thick, round = false) {
  const parts = [];
  for (let axis = 0; axis < 3; ++axis) {
    for (const side of [-1, 1]) {
      const at = (p, q) => {
        const cube = [0, 0, 0];
        cube[axis] = side;
        cube[(axis + 1) % 3] = side * p;
        cube[(axis + 2) % 3] = q;
        return cube;
      };
      const corners = [at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)];
      const places = corners.map((cube) =>
        cube.map((x, i) => (a[i] + b[i] + x * (Math.abs(b[i] - a[i]) + thick)) / 2));
      const face = quad(...places, at(0, 0));
      if (round) face.normals = [0, 1, 2, 0, 2, 3].map((k) => normalised(corners[k]));
      parts.push(face);
    }
  }
  return joined(parts);
}

function floorOf({ tank: { lower: l, upper: u }, slope }) {
  const at = slope ? Math.max(slope.foot, l[0]) : u[0];
  const parts = [quad([l[0], l[1], l[2]], [at, l[1], l[2]], [at, u[1], l[2]], [l[0], u[1], l[2]],
    [0, 0, 1])];
  if (slope) {
    const z = l[2] + slope.gradient * (u[0] - at);
    const size = Math.hypot(1, slope.gradient);
    parts.push(quad([at, l[1], l[2]], [u[0], l[1], z], [u[0], u[1], z], [at, u[1], l[2]],
      [-slope.gradient / size, 0, 1 / size]));
    for (const [y, side] of [[l[1], -1], [u[1], 1]]) {
      const foot = [at, y, l[2]];
      parts.push(quad(foot, [u[0], y, l[2]], [u[0], y, z], foot, [0, side, 0]));
    }
    parts.push(quad([u[0], l[1], l[2]], [u[0], u[1], l[2]], [u[0], u[1], z], [u[0], l[1], z],
      [1, 0, 0]));
  }
  return joined(parts);
}

const thicknessOf = ({ tank: { lower: l, upper: u } }) => 0.004 * Math.hypot(u[0] - l[0], u[1] - l[1]);

function edgesOf(world) {
  const { lower: l, upper: u } = world.tank;
  const thick = thicknessOf(world);
  const bars = [];
  for (let axis = 0; axis < 3; ++axis) {
    for (const p of [0, 1]) {
      for (const q of [0, 1]) {
        const a = [...l];
        const b = [...l];
        const [i, k] = [(axis + 1) % 3, (axis + 2) % 3];
        a[i] = b[i] = p ? u[i] : l[i];
        a[k] = b[k] = q ? u[k] : l[k];
        b[axis] = u[axis];
        bars.push(bar(a, b, thick, true));
      }
    }
  }
  return joined(bars);
}

/// The wave maker's board, its face at x = 0.
function boardOf({ tank: { lower: l, upper: u } }) {
  const thick = 0.008 * Math.hypot(u[0] - l[0], u[1] - l[1]);
  return bar([-1.5 * thick, l[1] + thick / 2, l[2] + thick / 2],
    [-thick / 2, u[1] - thick / 2, l[2] + 0.7 * (u[2] - l[2])], thick);
}

export class Solids {
  constructor(gl) {
    this.gl = gl;
    this.shader = program(gl, SOLID_VERTEX, FRAGMENT);
    this.bodies = [];
  }

  build(world) {
    const gl = this.gl;
    const { lower: l, upper: u } = world.tank;
    this.world = world;
    const far = 12 * Math.hypot(u[0] - l[0], u[1] - l[1]);
    const z = l[2] - 0.012 * Math.hypot(u[0] - l[0], u[1] - l[1]);
    const ground = quad([l[0] - far, l[1] - far, z], [u[0] + far, l[1] - far, z],
      [u[0] + far, u[1] + far, z], [l[0] - far, u[1] + far, z], [0, 0, 1]);
    const draw = (mesh) => meshOn(gl, mesh.places, mesh.normals);
    const sand = world.slope ? [0.60, 0.49, 0.33] : [0.27, 0.34, 0.37];
    this.still = [
      { material: 1, tint: sand, draw: draw(floorOf(world)) },
      { material: GROUND, tint: [0.030, 0.043, 0.058], draw: draw(ground) },
    ];
    this.board = null;
    if (world.wave_maker) {
      this.board = { material: 2, tint: [0.16, 0.24, 0.30], pose: STILL, draw: draw(boardOf(world)) };
      this.still.push(this.board);
    }
    this.edges = { material: 3, tint: [0.55, 0.66, 0.72], draw: draw(edgesOf(world)) };
    this.bodies = world.bodies.map((body, index) => {
      const mesh = trianglesOf(body);
      return { ...mesh, draw: draw(mesh), free: body.motion === 'free', tint: PALETTE[index % PALETTE.length], glow: 0,
        pose: STILL, place: [0, 0, 0], turn: [0, 0, 0, 1],
        reach: mesh.places.reduce((far, place) => Math.max(far, Math.hypot(...place)), 0) }; // [m]
    });
  }

  pose(index, place, turn) {
    Object.assign(this.bodies[index], { place, turn, pose: poseMatrix(place, turn) });
  }

  /// Where the wave maker is after so many simulated seconds; what it has gone from its wall [m].
  drive(seconds) {
    if (!this.board) return 0;
    const { stroke, period } = this.world.wave_maker;
    const gone = 0.5 * stroke * (1 - Math.cos(2 * Math.PI * seconds / period));
    this.board.pose = poseMatrix([this.world.tank.lower[0] + gone, 0, 0], [0, 0, 0, 1]);
    return gone;
  }

  /// All but the tank's edges: thin bars would be seen torn by the water in front of them. The
  /// nearest first: what they hide costs little then.
  draw(camera, light, rig) {
    this.drawAll([...this.bodies.map((b) => ({ ...b, material: 2 })), ...this.still], camera, light,
      { tiles: rig.tiles, levels: rig.levels });
  }

  /// For the edges, in a picture of so many rows.
  bars(camera, height) {
    return { halfThick: 0.5 * thicknessOf(this.world), halfPixel: 1 / (camera.focal * height) };
  }

  /// Where no water is before them; `water`: how far it is, `pixels`: of the picture.
  drawEdges(camera, light, hidden) {
    this.drawAll([this.edges], camera, light, { tiles: [0, 0, 1, 0], ...hidden,
      ...this.bars(camera, hidden.pixels[1]) });
  }

  drawAll(solids, camera, light, more) {
    const gl = this.gl;
    const { lower: l, upper: u } = this.world.tank;
    const shared = { levels: NONE, water: light.waves, pixels: [0, 0], halfThick: 0, halfPixel: 0, ...light, ...more,
      both: camera.both, eye: camera.eye, tankBox: [l[0], l[1], u[0], u[1]],
      sand: Boolean(this.world.slope) && more.tiles[3] === 0 };
    gl.enable(gl.DEPTH_TEST);
    for (const solid of solids) {
      use(gl, this.shader, { ...shared, pose: solid.pose ?? STILL, material: solid.material,
        tint: solid.tint, glow: solid.glow ?? 0 });
      solid.draw();
    }
  }
}
