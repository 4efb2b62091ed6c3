// SPDX-License-Identifier: MIT
// Frames as view-server/README.md lays them out, into what the page shows. Little endian.

const LITTLE = new Uint8Array(new Uint16Array([1]).buffer)[0] === 1;
if (!LITTLE) throw new Error('this page needs a little-endian machine');

const json = (buffer) => JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 16)));

function inThrees(flat) {
  const all = [];
  for (let i = 0; i + 2 < flat.length; i += 3) all.push([flat[i], flat[i + 1], flat[i + 2]]);
  return all;
}

function scene(buffer) {
  const told = json(buffer);
  told.name = told.scene;
  for (const body of told.bodies) {
    body.vertices = inThrees(body.mesh.vertices);
    body.triangles = inThrees(body.mesh.triangles);
  }
  return told;
}

function state(buffer, view) {
  const count = view.getUint32(28, true);
  const bubbles = view.getUint32(32, true);
  const bodies = [];
  for (let k = 0; k < view.getUint32(36, true); ++k) {
    const pose = new Float32Array(buffer, 56 + 32 * k, 7);
    bodies.push({ place: [...pose.slice(0, 3)], turn: [...pose.slice(3)],
      flags: view.getUint32(56 + 32 * k + 28, true) });
  }
  const at = 56 + 32 * bodies.length;
  return { simulated: view.getFloat64(16, true), count, bubbles, bodies,
    lower: [...new Float32Array(buffer, 40, 3)], unit: view.getFloat32(52, true),
    particles: new Uint8Array(buffer, at, 8 * (count + bubbles)) };
}

const READERS = {
  SPC1: scene,
  SPR1: json,
  SPS1: state,
  SPL1: (buffer, view) => ({ muted: (view.getUint32(20, true) & 1) !== 0,
    peaks: new Float32Array(buffer, 24, view.getUint32(16, true)) }),
  SPA1: (buffer, view) => ({ rate: view.getUint32(16, true), first: view.getFloat64(24, true),
    samples: new Float32Array(buffer, 32, 2 * view.getUint32(20, true)) }),
};

/// {kind, moment, ...what the frame holds}, or null where the bytes are no frame.
export function readFrame(buffer) {
  if (buffer.byteLength < 16) return null;
  const view = new DataView(buffer);
  const kind = String.fromCharCode(...new Uint8Array(buffer, 0, 4));
  if (!READERS[kind] || view.getUint32(4, true) !== buffer.byteLength) return null;
  return { kind, moment: view.getFloat64(8, true), ...READERS[kind](buffer, view) };
}
