// SPDX-License-Identifier: MIT
// Water in screen space (van der Laan, Green & Sainz 2009): spheres' depth, smoothed by a
// narrow-range filter (Truong & Yuksel 2018), thickness, and both with the solids to one picture.
import { OVER_ALL, Target, overAll, program, use } from './gl.js';
import { LIGHT, LIT } from './light.js';
import { MIRRORED, PARTICLE } from './particles.js';
import { REACH } from './several.js';

const HIDDEN = 'vec4(2.0, 2.0, 2.0, 1.0)'; // outside the picture

const POINT = `${PARTICLE}
uniform mat4 view, both, projection;
uniform float radius, height; // [m], [pixels] of the target
out vec3 middle;              // in the eye's axes
out float fast;
flat out float own;           // radius of this one
void put(vec3 p, float r) {
  middle = (view * vec4(p, 1.0)).xyz;
  own = r;
  gl_Position = both * vec4(p, 1.0);
  gl_PointSize = clamp(projection[1][1] * r * height / max(-middle.z, 1e-3), 1.5, 256.0);
}
`;

const WATER_VERTEX = `${POINT}
void main() {
  put(place(), radius);
  fast = speed();
  if ((tag.y & SPRAY) != 0u) gl_Position = ${HIDDEN};
}`;

/// Water behind the walls.
const MIRROR_VERTEX = `${POINT}${MIRRORED}
void main() {
  vec3 p = place();
  bool there = mirrored(p);
  put(p, radius);
  fast = 0.0;
  if (!there) gl_Position = ${HIDDEN};
}`;

/// Drops: several for each particle that flies, within the water that it stands for.
const SPRAY_VERTEX = `${POINT}
float draw(int n) { return fract(sin(float(part) * 12.9898 + float(n) * 78.233) * 43758.5453); }
void main() {
  vec3 away = vec3(draw(1), draw(2), draw(3)) - 0.5;
  float r = radius * (0.10 + 0.22 * draw(4) * draw(5));
  put(place() + 1.5 * radius * away, r);
  fast = speed();
}`;

const BUBBLE_VERTEX = `${POINT}
void main() {
  put(place(), radius * (0.16 + 0.12 * fract(float(gl_VertexID) * 0.618)));
  fast = 0.0;
}`;

const SPHERE = `
in vec3 middle;
in float fast;
flat in float own;
uniform mat4 projection;
/// The sphere's front under this fragment, in the eye's axes; the normal too.
vec3 front(out vec3 n) {
  n.xy = gl_PointCoord * vec2(2.0, -2.0) + vec2(-1.0, 1.0);
  float rest = 1.0 - dot(n.xy, n.xy);
  if (rest < 0.0) discard;
  n.z = sqrt(rest);
  return middle + own * n;
}
float depthOf(float z) {
  return 0.5 + 0.5 * (projection[2][2] * z + projection[3][2]) / -z;
}
`;

const TANK = `
uniform mat4 viewBack;
uniform vec3 eye, tankLower, tankUpper;
/// Where a way out of the eye, its length 1, enters the tank's walls and leaves them.
vec2 within(vec3 p) {
  vec3 along = mat3(viewBack) * p;
  vec3 a = (tankLower - eye) / along, b = (tankUpper - eye) / along;
  vec3 first = min(a, b), last = max(a, b);
  return vec2(max(first.x, first.y), min(last.x, last.y));
}
`;

/// Water does not reach through the tank's walls: its front is cut at them, which is flat glass.
const DEPTH = `${SPHERE}${TANK}
out vec4 colour;
void main() {
  vec3 n;
  vec3 p = front(n);
  vec2 inside = within(p);
  if (inside.x >= inside.y) discard;
  p *= max(inside.x, 1.0);
  colour = vec4(-p.z, 0.0, 0.0, 1.0);
  gl_FragDepth = depthOf(p.z);
}`;

/// Chord of the sphere, such that what particles add up to is their volume; foam with it.
const THICKNESS = `${SPHERE}${TANK}
uniform sampler2D solidDepth;
uniform vec2 pixels;
uniform float share3; // a particle's volume over its sphere's
out vec4 colour;
void main() {
  vec3 n;
  vec3 p = front(n);
  if (texture(solidDepth, gl_FragCoord.xy / pixels).r < depthOf(middle.z)) discard;
  vec2 inside = within(p);
  if (inside.x >= inside.y) discard;
  float chord = 2.0 * own * n.z * share3;
  colour = vec4(chord, chord * smoothstep(0.9, 2.8, fast), 0.0, 1.0);
}`;

const SMOOTH = `
in vec2 uv;
uniform sampler2D source;
uniform vec2 along;   // one pixel
uniform float reach;  // of the filter at distance 1 [pixels m]
uniform float narrow; // [m]
out vec4 colour;
void main() {
  float z = texture(source, uv).r;
  colour = vec4(z, 0.0, 0.0, 1.0);
  if (z <= 0.0) return;
  float sigma = min(reach / z, 40.0);
  float stride = max(sigma / 4.0, 1.0);
  float sum = z, all = 1.0, low = narrow, high = narrow;
  for (int i = 1; i <= 10; ++i) {
    float d = float(i) * stride;
    float w = exp(-0.5 * d * d / (sigma * sigma));
    float a = texture(source, uv + d * along).r, b = texture(source, uv - d * along).r;
    bool far = a > z + high || a <= 0.0 || b > z + high || b <= 0.0;
    if (far) continue; // both sides or none: no pull at an edge
    sum += w * (max(a, z - low) + max(b, z - low));
    all += 2.0 * w;
  }
  colour.r = sum / all;
}`;

/// Normals in the eye's axes, of the side on which the depth changes less; a: covered.
const NORMAL = `
in vec2 uv;
uniform sampler2D source;
uniform vec2 pixels, slope; // slope: x and y over z at the picture's edge
uniform vec2 skew;          // of the view: where straight ahead is, 0: in the middle
out vec4 colour;
vec3 at(vec2 q) {
  float z = texture(source, q).r;
  return z > 0.0 ? vec3((q * 2.0 - 1.0 + skew) * slope * z, -z) : vec3(0.0);
}
void main() {
  vec3 p = at(uv);
  if (p.z == 0.0) { colour = vec4(0.0); return; }
  vec2 e = 1.0 / pixels;
  vec3 r = at(uv + vec2(e.x, 0.0)) - p, l = p - at(uv - vec2(e.x, 0.0));
  vec3 t = at(uv + vec2(0.0, e.y)) - p, d = p - at(uv - vec2(0.0, e.y));
  vec3 x = abs(r.z) < abs(l.z) ? r : l, y = abs(t.z) < abs(d.z) ? t : d;
  colour = vec4(normalize(cross(x, y)), 1.0);
}`;

const BLUR = `
in vec2 uv;
uniform sampler2D source;
uniform vec2 along;
out vec4 colour;
void main() {
  vec4 sum = vec4(0.0);
  float all = 0.0;
  for (int i = -5; i <= 5; ++i) {
    float w = exp(-float(i * i) / 9.0);
    sum += w * texture(source, uv + float(i) * along);
    all += w;
  }
  colour = sum / all;
}`;

const BUBBLE = `${SPHERE}${LIGHT}
uniform mat4 viewBack;
out vec4 colour;
void main() {
  vec3 n;
  vec3 p = front(n);
  float rim = pow(1.0 - n.z, 2.5);
  vec3 r = mat3(viewBack) * reflect(normalize(p), n);
  colour = vec4(vec3(0.75, 0.9, 1.0) * (0.18 + 0.9 * rim) + 0.35 * min(room(r), vec3(2.0)),
                0.30 + 0.6 * rim);
  gl_FragDepth = depthOf(p.z);
}`;

const COMPOSE = `${LIGHT}${LIT}
in vec2 uv;
uniform sampler2D solids, solidDepth, surface, depth, thickness;
uniform mat4 viewBack, projection, both;
uniform vec2 slope, skew;
uniform vec3 eye, absorbed; // [1/m] of red, green, blue
uniform vec3 tankLower, tankUpper;
uniform vec2 rise;          // of the floor: from this x on [m], by so much along x
uniform float foamLength;   // [m] of fast water that is white
out vec4 colour;

float solidDistance(vec2 at) {
  float d = texture(solidDepth, at).r * 2.0 - 1.0;
  return projection[3][2] / (projection[2][2] + d);
}

/// The depth is that of the middle of its pixel, which may be larger than the picture's: how far
/// water of that normal is along this way.
float onPlane(float z, vec3 n, vec3 way) {
  vec2 size = vec2(textureSize(depth, 0));
  vec2 middle = (floor(uv * size) + 0.5) / size;
  vec3 there = z * vec3((middle * 2.0 - 1.0 + skew) * slope, -1.0);
  float reach = 8.0 * z * slope.y / size.y;
  return clamp(dot(n, there) / min(dot(n, way), -0.05), z - reach, z + reach);
}

void main() {
  vec3 behind = texture(solids, uv).rgb;
  vec4 s = texture(surface, uv);
  colour = vec4(behind, 1.0);
  if (s.a < 0.02) return;
  float z = texture(depth, uv).r;
  if (z <= 0.0) z = texture(depth, uv + 0.6 * normalize(s.xy + 1e-4) / vec2(textureSize(depth, 0))).r;
  vec3 n = normalize(s.xyz);
  vec3 way = vec3((uv * 2.0 - 1.0 + skew) * slope, -1.0);
  if (z > 0.0) z = onPlane(z, n, way);
  if (z > 0.0 && solidDistance(uv) < z - 0.002) return;
  if (z <= 0.0) z = solidDistance(uv);
  vec3 p = way * z;
  vec3 world = (viewBack * vec4(p, 1.0)).xyz;
  vec3 view = normalize(p);
  // Behind the far walls there is none.
  vec2 far = mix(tankLower.xy - world.xy, world.xy - tankUpper.xy,
                 step(eye.xy, 0.5 * (tankLower.xy + tankUpper.xy)));
  float pixel = z * slope.y * 2.0 / float(textureSize(solids, 0).y);
  float shown = s.a * (1.0 - smoothstep(-pixel, pixel, max(far.x, far.y)));
  if (shown < 0.01) return;
  if (dot(n, view) > 0.0) n = normalize(n - 1.05 * dot(n, view) * view);
  vec2 thick = texture(thickness, uv).rg;

  // What the refracted ray meets, if that lies as deep as what is straight behind, and not below
  // the floor. Walls mirror what comes steeply through the surface.
  float straight = max(solidDistance(uv) - z, 0.0) / max(-view.z, 0.2);
  float path = min(mix(thick.r, straight, 0.5), 1.1 * straight);
  vec3 bent = mat3(viewBack) * refract(view, n, 0.75);
  float steep = world.x > rise.x ? rise.y : 0.0;
  float ground = tankLower.z + steep * (world.x - rise.x);
  path = min(path, max(world.z - ground, 0.0) / max(steep * bent.x - bent.z, 0.05));
  vec3 meets = world + path * bent;
  if (bent.z < -0.6) {
    meets.xy = tankLower.xy + abs(meets.xy - tankLower.xy);
    meets.xy = tankUpper.xy - abs(tankUpper.xy - meets.xy);
  }
  vec4 drawn = both * vec4(meets, 1.0);
  vec2 there = clamp(drawn.xy / drawn.w * 0.5 + 0.5, vec2(0.001), vec2(0.999));
  if (solidDistance(there) < z) there = uv;
  vec3 through = texture(solids, there).rgb;
  vec3 kept = exp(-absorbed * path);
  float lit = lampReaches(world);
  vec3 deep = vec3(0.012, 0.17, 0.25) * (0.30 + 0.75 * lit);
  vec3 body = through * kept + deep * (1.0 - kept);

  float foam = 1.0 - exp(-thick.g / foamLength);
  foam *= 0.75;
  vec3 up = mat3(viewBack) * n;
  body = mix(body, vec3(0.80, 0.90, 0.95) * (0.45 + 0.65 * lit * max(dot(up, lamp()), 0.2)), foam);

  vec3 r = mat3(viewBack) * reflect(view, n);
  float f = 0.02 + 0.98 * pow(1.0 - max(dot(n, -view), 0.0), 5.0);
  vec3 seen = mix(body, room(r), min(f, 0.85) * (1.0 - 0.6 * foam));
  colour = vec4(mix(behind, seen, shown), 1.0);
}`;

const DROP = `${SPHERE}${LIGHT}
uniform mat4 viewBack;
uniform sampler2D depth;
uniform vec2 pixels;
out vec4 colour;
void main() {
  vec3 n;
  vec3 p = front(n);
  float water = texture(depth, gl_FragCoord.xy / pixels).r;
  if (water > 0.0 && water < -p.z - own) discard;
  vec3 r = mat3(viewBack) * reflect(normalize(p), n);
  float rim = pow(1.0 - n.z, 2.0);
  colour = vec4(vec3(0.10, 0.20, 0.26) + (0.35 + 0.65 * rim) * min(room(r), vec3(3.0)), 1.0);
  colour.a = 0.55 + 0.4 * rim;
}`;

/// Filmic curve (Narkowicz 2015), edges smoothed along themselves, a little darker to the corners.
const FINISH = `
in vec2 uv;
uniform sampler2D source;
uniform vec2 pixels;
out vec4 colour;
vec3 curve(vec3 x) {
  return pow(clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0), vec3(0.4545));
}
vec3 at(vec2 d) { return texture(source, uv + d / pixels).rgb; }
/// A root is near enough to the curve to find edges.
float bright(vec3 c) { return sqrt(min(dot(c, vec3(0.299, 0.587, 0.114)), 1.0)); }
void main() {
  vec3 m = at(vec2(0.0));
  float a = bright(at(vec2(-1, -1))), b = bright(at(vec2(1, -1)));
  float c = bright(at(vec2(-1, 1))), d = bright(at(vec2(1, 1))), e = bright(m);
  float low = min(e, min(min(a, b), min(c, d))), high = max(e, max(max(a, b), max(c, d)));
  vec2 along = vec2(c + d - a - b, a + c - b - d);
  if (high - low > 0.06) {
    along *= 1.0 / (min(abs(along.x), abs(along.y)) + 0.03 * (a + b + c + d) + 0.01);
    along = clamp(along, -4.0, 4.0);
    m = 0.5 * (curve(at(along * (1.0 / 3.0 - 0.5))) + curve(at(along * (2.0 / 3.0 - 0.5))));
  } else {
    m = curve(m);
  }
  vec2 q = uv - 0.5;
  colour = vec4(m * (1.0 - 0.5 * dot(q, q)), 1.0);
}`;

export class Water {
  constructor(gl) {
    this.gl = gl;
    const make = (vertex, fragment) => program(gl, vertex, fragment);
    this.depthPass = make(WATER_VERTEX, DEPTH);
    this.mirrorPass = make(MIRROR_VERTEX, DEPTH);
    this.thickPass = make(WATER_VERTEX, THICKNESS);
    this.bubblePass = make(BUBBLE_VERTEX, BUBBLE);
    this.dropPass = make(SPRAY_VERTEX, DROP);
    this.smooth = make(OVER_ALL, SMOOTH);
    this.normals = make(OVER_ALL, NORMAL);
    this.blur = make(OVER_ALL, BLUR);
    this.compose = make(OVER_ALL, COMPOSE);
    this.finish = make(OVER_ALL, FINISH);
    this.solids = new Target(gl, gl.RGBA16F, gl.LINEAR, true);
    this.whole = new Target(gl, gl.RGBA16F, gl.LINEAR, true);
    this.depths = [0, 1].map(() => new Target(gl, gl.R32F, gl.NEAREST, true));
    this.surface = new Target(gl, gl.RGBA16F, gl.LINEAR);
    this.thick = [0, 1].map(() => new Target(gl, gl.RGBA16F, gl.LINEAR));
  }

  /// `solids`, `edges` and `marks` draw into what is bound; the picture goes to a part of `frame`, or
  /// to the canvas.
  draw({ width, height, share, frame = null, x = 0, y = 0 }, camera, world, particles, light, { solids, edges, marks }) {
    const gl = this.gl;
    const slope = [camera.aspect / camera.focal, 1 / camera.focal];
    const { upper } = world.tank;
    const lower = world.tank.lower.map((x, i) => (i === 0 ? x + world.paddle : x));
    const [w, h] = [Math.ceil(width * share), Math.ceil(height * share)];
    const pixels = [w, h];
    const shared = { ...camera, ...particles.uniforms, ...light, radius: 0.78 * world.spacing,
      height: h, pixels, tankLower: lower, tankUpper: upper, slope };

    this.solids.fit(width, height).bind([0.012, 0.02, 0.032, 1]);
    gl.enable(gl.DEPTH_TEST);
    gl.disable(gl.BLEND);
    solids();
    use(gl, this.bubblePass, { ...shared, height });
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    particles.drawBubbles();
    gl.disable(gl.BLEND);

    this.depths[0].fit(w, h).bind([0, 0, 0, 0]);
    use(gl, this.depthPass, shared);
    particles.drawWater();
    use(gl, this.mirrorPass, { ...shared, reach: REACH * world.spacing });
    particles.drawMirrored();

    const half = [Math.ceil(w / 2), Math.ceil(h / 2)];
    this.thick[0].fit(...half).bind([0, 0, 0, 0]);
    gl.disable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    const sphere = (4 / 3) * Math.PI * 0.78 ** 3;
    use(gl, this.thickPass, { ...shared, height: half[1], pixels: half, share3: 1 / sphere,
      solidDepth: this.solids.distance });
    particles.drawWater();
    gl.disable(gl.BLEND);
    for (const [from, to, along] of [[0, 1, [1.5 / half[0], 0]], [1, 0, [0, 1.5 / half[1]]]]) {
      this.thick[to].fit(...half).bind();
      overAll(gl, this.blur, { source: this.thick[from].colour, along });
    }

    const reach = 0.52 * world.spacing * 0.5 * camera.focal * h;
    this.depths[1].fit(w, h);
    for (const wide of [1, 0.55]) {
      for (const [from, to, along] of [[0, 1, [1 / w, 0]], [1, 0, [0, 1 / h]]]) {
        this.depths[to].bind();
        overAll(gl, this.smooth, { source: this.depths[from].colour, along, reach: wide * reach,
          narrow: 1.6 * world.spacing });
      }
    }
    this.surface.fit(w, h).bind();
    overAll(gl, this.normals, { source: this.depths[0].colour, pixels, slope, skew: camera.skew });

    this.whole.fit(width, height).bind([0, 0, 0, 1]);
    const wide = Math.min(upper[2] - lower[2], world.level - lower[2]);
    const strength = 0.5 / Math.max(wide, 0.05);
    overAll(gl, this.compose, { ...shared, solids: this.solids.colour,
      solidDepth: this.solids.distance, surface: this.surface.colour,
      depth: this.depths[0].colour, thickness: this.thick[0].colour,
      absorbed: [1.9 * strength, 0.55 * strength, 0.38 * strength],
      rise: world.slope ? [world.slope.foot, world.slope.gradient] : [0, 0],
      foamLength: 0.8 * world.spacing });

    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.solids.frame);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, this.whole.frame);
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.DEPTH_BUFFER_BIT, gl.NEAREST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.whole.frame);
    edges({ water: this.depths[0].colour, pixels: [width, height] });
    gl.depthMask(false);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    use(gl, this.dropPass, { ...shared, height, pixels: [width, height],
      depth: this.depths[0].colour });
    particles.drawDrops();
    marks();
    gl.disable(gl.BLEND);
    gl.depthMask(true);

    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.viewport(x, y, width, height);
    overAll(gl, this.finish, { source: this.whole.colour, pixels: [width, height] });
  }
}
