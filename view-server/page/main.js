// SPDX-License-Identifier: MIT
// Puts the parts of the page together and draws a picture whenever the browser takes one.
import { Camera } from './camera.js';
import { Strip, drawMeters, drawScope } from './charts.js';
import { Fences } from './fences.js';
import { Gamepads } from './gamepad.js';
import { Grabs } from './grab.js';
import { LightMaps } from './light.js';
import { Link } from './link.js';
import { Pace } from './pace.js';
import { Panel } from './panel.js';
import { Particles } from './particles.js';
import { Playout } from './playout.js';
import { Points } from './points.js';
import { Pointers } from './pointer.js';
import { Film, savePicture } from './record.js';
import { Rings } from './rings.js';
import { Solids } from './solids.js';
import { Sound } from './sound.js';
import { between, mix } from './vector.js';
import { Water } from './water.js';
import { Words } from './words.js';
import { Headset } from './xr.js';

const at = (id) => document.getElementById(id);
const options = new URLSearchParams(location.search); // ?points, ?share=0.5
const canvas = at('water');
const gl = canvas.getContext('webgl2',
  { alpha: false, antialias: false, powerPreference: 'high-performance' });
if (!gl) {
  at('state').textContent = 'This browser has no WebGL 2, without which nothing can be drawn: '
    + 'turn on graphics acceleration in its settings, or take another browser.';
  throw new Error('no WebGL 2');
}
canvas.addEventListener('webglcontextlost', () => location.reload());
const smooth = gl.getExtension('EXT_color_buffer_float') && !options.has('points');
const named = gl.getExtension('WEBGL_debug_renderer_info')?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER;
const inSoftware = /SwiftShader|llvmpipe|softpipe|Basic Render/i.test(gl.getParameter(named));
const pace = new Pace(options.has('share') ? Number(options.get('share')) || 1 : null, inSoftware);

const camera = new Camera();
const particles = new Particles(gl);
const solids = new Solids(gl);
const rings = new Rings(gl);
const playout = new Playout();
const fences = new Fences(gl, finished);
const strip = new Strip(at('strip'));
const asPoints = () => !smooth || (pace.isTooSlow && !headset.session);
// Made when they are drawn for the first time.
let points = null;
let lights = null;
let water = null;

const IDLE = 1; // without a picture, after which no state is asked for [s]
const FALL = 0.8; // of a shown peak from one frame of levels to the next

let world = null; // the scene
let peaks = null; // of all channels
let tiles = [0, 0, 1, 0];
let tilesFirst = 0;
let muted = false;
let alive = { sim: false, synth: false };
let wantsPicture = false;
let middle = null; // of the scene, as the synth has it; null: no loudspeaker depends on it
let going = null; // the scene or rig that was chosen here and is not there yet
let centres = false; // the synth is told the middle of the scene that was chosen here
const words = new Words();
const shown = []; // lag of events to the finished picture [s]

const link = new Link({
  open: () => grabs.again(),
  closed: () => { alive = { sim: false, synth: false }; playout.clear(); },
  told: (said) => {
    alive = said;
    grabs.heldElsewhere(said.held).forEach(tellHeld);
    if (!said.sim || !said.synth) words.forget();
  },
  SPC1: (scene) => {
    world = scene;
    Object.assign(world, { level: null, paddle: 0 });
    grabs.letAllGo();
    grabs.bound(scene.tank);
    playout.clear();
    solids.build(scene);
    panel.buildScene(scene);
    settleRig();
    at('scene').textContent = scene.name;
    document.title = `${scene.name} - splash`;
    const names = scene.bodies.filter(({ motion }) => motion !== 'free').map(({ name }) => name);
    at('grabbable').textContent = names.slice(0, 3).join(' or ').replaceAll('_', ' ') || 'a body';
  },
  SPS1: (state) => {
    playout.push(state, link.now());
    // A page that draws no picture takes none.
    if (performance.now() - 1000 * IDLE < drawnLast) link.ask(1);
    else untaken += 1;
    if (world && world.level === null) setLevel(state);
  },
  SPR1: (rig) => {
    const floor = rig.outputs.find(({ kind }) => kind === 'tiles');
    tiles = floor ? [floor.place[0], floor.place[1], floor.tile_size, floor.tiles[0]] : [0, 0, 1, 0];
    tilesFirst = floor?.first ?? 0;
    middle = rig.middle;
    if (going?.what === 'rig') going = null;
    panel.build(rig);
  },
  SPL1: (levels) => {
    muted = levels.muted;
    pressed('mute', muted);
    const before = peaks?.length === levels.peaks.length ? peaks : levels.peaks;
    peaks = levels.peaks.map((peak, i) => Math.max(peak, FALL * before[i]));
    panel.levels(peaks);
  },
  SPA1: (frame) => sound.take(frame),
  osc: ({ address, values, time }) => {
    if (address === '/status.reply') words.note(values, performance.now() / 1000);
    else if (address === '/value') panel.value(values);
    else if (address === '/fail') refused(values);
    else if (address in EVENTS) happen(address, values, time);
  },
});
const sound = new Sound(link);
const grabs = new Grabs(link);
const panel = new Panel(at, link, (what, name) => {
  going = { what, name, since: performance.now() };
  if (what === 'scene') centres = true;
  tellState();
});
const pointers = new Pointers(canvas, camera, solids, grabs, tellHeld);
const gamepads = new Gamepads(camera, solids, grabs);
const film = new Film(canvas, sound);

/// Loudspeakers that name no place are heard around the middle of the scene that was chosen here.
function settleRig() {
  if (going?.what === 'scene') going = null;
  if (!centres) return;
  centres = false;
  const { lower, upper } = world.tank;
  const wanted = lower.map((x, i) => (x + upper[i]) / 2);
  if (!middle || wanted.every((x, i) => Math.abs(x - middle[i]) < 1e-3)) return;
  link.send('/rig', ',sfff', '', ...wanted);
}

/// Still water's height: that of nine tenths of the particles at the start.
function setLevel(state) {
  const places = new Uint16Array(state.particles.buffer, state.particles.byteOffset);
  const heights = new Uint16Array(state.count);
  for (let i = 0; i < state.count; ++i) heights[i] = places[4 * i + 2];
  heights.sort();
  world.level = state.lower[2] + state.unit * heights[Math.floor(0.9 * state.count)] + world.spacing / 2;
  camera.aspect = canvas.width / canvas.height;
  state.bodies.forEach(({ place, turn }, i) => solids.pose(i, place, turn));
  frameTank();
}

/// The tank, and the bodies above it, between the buttons and the charts; in upright windows, which
/// have the buttons below the water, between the hint and the buttons; anywhere in a tiny window.
function frameTank() {
  const height = canvas.clientHeight;
  const [hint, buttons, charts] = ['#hint', 'nav', 'footer'].map((name) =>
    document.querySelector(name).getBoundingClientRect());
  const above = buttons.bottom < height / 2;
  const [top, bottom] = above ? [buttons.bottom, charts.top] : [hint.bottom, buttons.top];
  const free = bottom - top > height / 3 ? [bottom, top] : [height, 0];
  const { lower, upper: [x, y, brim] } = world.tank;
  const tops = solids.bodies.map(({ place, reach }) => place[2] + reach);
  const highest = Math.min(Math.max(brim, ...tops), brim + 0.5 * (brim - lower[2]));
  camera.frame({ lower, upper: [x, y, highest] }, ...free.map((y) => 1 - (2 * y) / height));
}

/// Where the place and the moment after the bundle stand, and how strong it is drawn.
const EVENTS = {
  '/impact': (v) => ({ place: v.slice(4, 7), after: v[7], strength: Math.min(1, v[3] / 2) }),
  '/bubble': (v) => ({ place: v.slice(4, 7), after: v[7], strength: Math.min(1, v[2] / 0.012) }),
  '/cavity': (v) => ({ place: v.slice(4, 7), after: v[7], strength: Math.min(1, v[2] / 0.06) }),
};

function happen(kind, values, bundle) {
  const { place, after, strength } = EVENTS[kind](values);
  const event = { kind, place, strength, values, time: (bundle ?? link.now()) + after / 1000 };
  rings.add(event);
  strip.add(event);
  window.splash.events.push(event);
  if (window.splash.events.length > 1000) window.splash.events.shift();
}

function refused([command, reason]) {
  if (command === '/scene' || command === '/rig') {
    going = null;
    centres = false;
    panel.scenes.reset();
    panel.rigs.reset();
  }
  warn(`${command}: ${reason}${reason.includes(' yields to ') ? '; stop one of these senders' : ''}`);
}

function tellHeld(index) {
  warn(`Another visitor holds ${world.bodies[index].name}; it is free when they let go`);
}

let warned = -Infinity; // when [ms]
function warn(text) {
  at('state').textContent = text;
  at('state').className = 'warning';
  warned = performance.now();
}

/// Time goes on, and nothing moves in it.
function paused() {
  const [before, now] = playout.states.slice(-2);
  return Boolean(now) && now.simulated === before.simulated;
}

function tellState() {
  pressed('pause', paused());
  if (performance.now() - warned < 4000) return;
  const { text, bad } = words.say({ open: link.isOpen, ...alive, muted, paused: paused(),
    rests: !world || !playout.states.length, going, description: world?.description });
  if (at('state').textContent !== text) at('state').textContent = text;
  at('state').className = bad ? 'warning' : '';
}

/// [s]
function latency() {
  const picture = shown.length ? shown.reduce((a, b) => a + b) / shown.length : 0;
  return { arrival: playout.arrival, age: playout.age, picture, sound: sound.lag };
}

function tellFigures() {
  const ms = (x) => `${Math.round(1000 * x)} ms`;
  const sim = words.last('sim-server');
  const parts = [`${world.particles} particles, ${world.solver}`, `${pace.rate.toFixed(0)} pictures/s${smooth && asPoints() ? ' (points: the water is too much for these graphics)' : ''}`,
    paused() ? 'paused' : `95 % of states come within ${ms(playout.arrival)}, are drawn within ${ms(playout.age)}`];
  if (sound.lag !== null) {
    const { picture } = latency();
    parts.push(`event to picture ${ms(picture)}, to sound ${ms(sound.lag)}, apart ${
      ms(Math.abs(sound.lag - picture))}`);
  }
  if (sim) parts.push(`${sim[11].toFixed(2)} of real time`, `${sim[3]} impacts, ${sim[4]} bubbles, ${sim[5]} cavities`);
  at('figures').textContent = parts.join('  ·  ');
}

const headset = new Headset({ gl, solids, grabs, pick: (ray) => pointers.pick(ray),
  world: () => world, prepare, draw: drawAll });
if (smooth) headset.isThere().then((there) => { at('headset').hidden = !there; });

function poseBodies({ older, newer, share: t }) {
  newer.bodies.forEach((body, i) => {
    const from = older.bodies[i] ?? body;
    solids.pose(i, mix(from.place, body.place, t), between(from.turn, body.turn, t));
    solids.bodies[i].glow = grabs.holds(i) ? 1 : pointers.hovered === i && !grabs.isHeld(i) ? 0.45 : 0;
  });
}

let pictures = 0;
let drawnLast = -Infinity; // when a picture was begun [ms]
let untaken = 0; // states that came while no picture was drawn
let turns = 0; // of the browser's, since the last picture
function picture() {
  requestAnimationFrame(picture);
  gamepads.poll();
  fences.look();
  turns += 1;
  // No picture waits for another: it would show an older state.
  if (fences.pending.length > 0 || turns < pace.every) return;
  turns = 0;
  if (!headset.session) pace.step(playout.drawing, playout.leastAge);
  const dense = Math.min(window.devicePixelRatio, 2) * pace.sharp;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((x) => Math.round(x * dense));
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  camera.aspect = width / height;
  if (headset.session || !prepare()) return;
  drawAll({ width, height, share: pace.share }, camera.matrices());
  fences.add(moment, begun);
  if (wantsPicture) savePicture(canvas, world.name);
  wantsPicture = false;
}

function finished(seen, since) {
  if (paused()) return; // nothing gets older in it
  const now = link.now();
  playout.finished(seen, since, now);
  shown.push(now - seen);
  if (shown.length > 60) shown.shift();
}

let moment = 0; // that is shown
let begun = 0; // its picture [Unix s]
/// Everything as it is to be shown now; whether there is anything. Asks for the next state.
function prepare() {
  const now = link.now();
  const view = world && playout.at(now, pace.rate, sound.lag === null ? 0 : sound.lag - 0.025);
  drawnLast = performance.now();
  if (untaken > 0) link.ask(untaken);
  untaken = 0;
  if (!view) return false;
  moment = view.moment;
  begun = now;
  if (headset.session) finished(moment, begun);
  const { older, newer, share } = view;
  world.paddle = solids.drive(older.simulated + share * (newer.simulated - older.simulated));
  particles.show(view, asPoints() ? null : world);
  poseBodies(view);
  if (++pictures % 3 === 0) drawCharts(now);
  return true;
}

function drawAll(size, seen) {
  const marks = () => rings.draw(seen, moment, camera.size);
  if (asPoints()) {
    points ??= new Points(gl);
    return points.draw(size, seen, world, particles, solids, marks, pace.stride);
  }
  lights ??= new LightMaps(gl);
  water ??= new Water(gl);
  lights.draw(world, particles, solids.bodies, pace.sharp * pace.share);
  const levels = new Float32Array(64);
  if (peaks) levels.set(peaks.slice(tilesFirst, tilesFirst + 64));
  const rig = { tiles, levels };
  return water.draw(size, seen, world, particles, lights.uniforms, { marks,
    solids: () => solids.draw(seen, lights.uniforms, rig),
    edges: (hidden) => solids.drawEdges(seen, lights.uniforms, hidden) });
}

function drawCharts(now) {
  strip.draw(now);
  drawMeters(at('meters'), peaks);
  if (at('scope').clientWidth > 0) drawScope(at('scope'), sound);
}

const pressed = (id, on) => at(id).setAttribute('aria-pressed', on);
const ACTS = {
  sound: async () => {
    if (sound.isOn) await sound.stop();
    else await sound.start();
    pressed('sound', sound.isOn);
  },
  mute: () => link.send('/mute', ',i', muted ? 0 : 1),
  pause: () => link.send('/pause', ',i', paused() ? 0 : 1),
  reset: () => link.send('/reset', ','),
  headset: async () => {
    if (headset.session) return headset.stop();
    await headset.start(() => {
      pressed('headset', false);
      pace.begin();
    }).catch((error) => warn(error.message));
    return pressed('headset', headset.session !== null);
  },
  look: () => world && frameTank(),
  picture: () => { wantsPicture = true; },
  film: () => {
    if (film.isOn) return film.stop();
    film.start(world?.name ?? 'splash', () => pressed('film', false));
    return pressed('film', true);
  },
  more: () => {
    at('panel').hidden = !at('panel').hidden;
    at('more').setAttribute('aria-expanded', !at('panel').hidden);
  },
};
const KEYS = { ' ': 'pause', r: 'reset', s: 'sound', m: 'mute', v: 'look', p: 'picture', f: 'film', o: 'more' };
for (const [id, act] of Object.entries(ACTS)) at(id).addEventListener('click', act);
window.addEventListener('keydown', (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest('input, select')) return;
  if (event.key === ' ' && event.target.closest('button, summary')) return; // it is pressed by that
  if (KEYS[event.key]) ACTS[KEYS[event.key]]();
  const turn = { ArrowLeft: [0.06, 0], ArrowRight: [-0.06, 0], ArrowUp: [0, 0.06],
    ArrowDown: [0, -0.06] }[event.key];
  if (turn && document.activeElement === canvas) camera.orbit(...turn);
});
canvas.addEventListener('pointerdown', () => at('hint').classList.add('done'));
document.addEventListener('visibilitychange', () => {
  if (document.hidden) grabs.letAllGo();
  else pace.begin();
});
// What lies above the charts keeps clear of the figures, however many lines they take.
new ResizeObserver(([{ target }]) =>
  document.body.style.setProperty('--charts', `${target.offsetHeight}px`)).observe(document.querySelector('footer'));
window.addEventListener('pagehide', () => grabs.letAllGo());

setInterval(() => {
  tellState();
  if (world) tellFigures();
}, 250);

/// For tests and for whoever looks with the browser's tools.
window.splash = { camera, solids, playout, sound, link, grabs, headset, events: [], peaks: () => peaks, alive: () => alive,
  rig: () => ({ tiles, tilesFirst }), pictures: () => pictures, latency, share: () => pace.share, sharp: () => pace.sharp, world: () => world };
requestAnimationFrame(picture);
