// SPDX-License-Identifier: MIT
// The tank on a table before whoever wears a headset (WebXR): drawn for each eye, and bodies are
// held by a controller's trigger or by a hand that pinches.
import { add, conjugate, inverse, length, multiply, product, sub, turn } from './vector.js';

const TABLE = 0.75; // height of the tank's lower side [m]
const GAP = 0.35; // from the viewer to its front [m]
const REACH = 0.08; // a body is in the hand when it is so near [m]
/// From the scene's axes, z upwards, to WebXR's, y upwards.
const UPRIGHT = [-Math.SQRT1_2, 0, 0, Math.SQRT1_2];

export class Headset {
  /// `draw(size, camera)`: the scene as it is now; `pick(ray)`: {index} of the body along a ray.
  constructor({ gl, solids, grabs, pick, world, prepare, draw }) {
    Object.assign(this, { gl, solids, grabs, pick, world, prepare, draw, held: new Map() });
    this.session = null;
  }

  async isThere() {
    return Boolean(await navigator.xr?.isSessionSupported('immersive-vr').catch(() => false));
  }

  /// `ended` is called when the headset is taken off.
  async start(ended) {
    const session = await navigator.xr.requestSession('immersive-vr',
      { optionalFeatures: ['local-floor', 'hand-tracking'] });
    await this.gl.makeXRCompatible();
    session.updateRenderState({ baseLayer: new window.XRWebGLLayer(session, this.gl),
      depthNear: 0.05, depthFar: 60 });
    this.space = await session.requestReferenceSpace('local-floor')
      .catch(() => session.requestReferenceSpace('local'));
    session.addEventListener('selectstart', ({ inputSource, frame }) => this.take(inputSource, frame));
    session.addEventListener('selectend', ({ inputSource }) => this.letGo(inputSource));
    session.addEventListener('end', () => {
      for (const source of [...this.held.keys()]) this.letGo(source);
      this.session = null;
      ended();
    });
    this.session = session;
    session.requestAnimationFrame((_, frame) => this.picture(frame));
  }

  stop() {
    return this.session?.end();
  }

  /// What the tank's middle at its lower side is moved by, in WebXR's axes.
  get away() {
    const { lower, upper } = this.world().tank;
    return { middle: [(lower[0] + upper[0]) / 2, (lower[1] + upper[1]) / 2, lower[2]],
      place: [0, TABLE, -GAP - (upper[1] - lower[1]) / 2] };
  }

  /// A pose of WebXR's in the scene's axes.
  inScene({ position: p, orientation: q }) {
    const { middle, place } = this.away;
    const back = conjugate(UPRIGHT);
    return { place: add(turn(back, sub([p.x, p.y, p.z], place)), middle),
      turn: product(back, [q.x, q.y, q.z, q.w]) };
  }

  /// As camera.matrices(), of one eye.
  eye(view) {
    const { middle, place } = this.away;
    const shift = sub(place, turn(UPRIGHT, middle));
    const [x, y, z] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => turn(UPRIGHT, axis));
    const toXr = new Float32Array([...x, 0, ...y, 0, ...z, 0, ...shift, 1]);
    const seen = multiply(view.transform.inverse.matrix, toXr);
    const projection = view.projectionMatrix;
    const both = multiply(projection, seen);
    const viewBack = inverse(seen);
    const { depthNear: near, depthFar: far } = this.session.renderState;
    return { view: seen, projection, both, back: inverse(both), viewBack, near, far,
      eye: [viewBack[12], viewBack[13], viewBack[14]], focal: projection[5],
      aspect: projection[5] / projection[0], skew: [projection[8], projection[9]] };
  }

  picture(frame) {
    if (!this.session) return;
    this.session.requestAnimationFrame((_, next) => this.picture(next));
    for (const [source, hold] of this.held) this.move(source, hold, frame);
    const seen = frame.getViewerPose(this.space);
    if (!seen || !this.prepare()) return;
    const layer = this.session.renderState.baseLayer;
    for (const view of seen.views) {
      const { x, y, width, height } = layer.getViewport(view);
      this.draw({ width, height, share: 0.7, frame: layer.framebuffer, x, y }, this.eye(view));
    }
  }

  where(source, frame) {
    const pose = frame.getPose(source.gripSpace ?? source.targetRaySpace, this.space);
    return pose && this.inScene(pose.transform);
  }

  /// What lies in the hand, else what it points at.
  nearest(source, frame, hand) {
    let best = { index: -1, far: REACH };
    this.solids.bodies.forEach((body, index) => {
      const size = body.places.reduce((most, place) => Math.max(most, length(place)), 0);
      const far = length(sub(body.place, hand.place)) - size;
      if (!body.free && far < best.far) best = { index, far };
    });
    if (best.index >= 0) return best.index;
    const ray = frame.getPose(source.targetRaySpace, this.space);
    if (!ray) return -1;
    const { place, turn: towards } = this.inScene(ray.transform);
    return this.pick({ from: place, along: turn(towards, [0, 0, -1]) }).index;
  }

  take(source, frame) {
    const hand = this.where(source, frame);
    const index = hand ? this.nearest(source, frame, hand) : -1;
    if (index < 0) return;
    const { place, turn: held } = this.solids.bodies[index];
    if (!this.grabs.take(source, index, place, held)) return;
    const back = conjugate(hand.turn);
    this.held.set(source, { place: turn(back, sub(place, hand.place)), turn: product(back, held) });
  }

  move(source, hold, frame) {
    const hand = this.where(source, frame);
    if (!hand) return;
    this.grabs.move(source, add(hand.place, turn(hand.turn, hold.place)),
      product(hand.turn, hold.turn));
  }

  letGo(source) {
    if (this.held.delete(source)) this.grabs.letGo(source);
  }
}
