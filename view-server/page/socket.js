// SPDX-License-Identifier: MIT
// The WebSocket to view-server, in a thread of its own, which waits for no picture: sound goes
// straight to the audio thread, the next state is asked for while the page draws, and what comes is
// stamped when it comes. Opens it again when it ends.
import { readFrame } from './wire.js';

const AGAIN_AFTER = 700; // [ms]
const AHEAD = 4; // states that come before the page has taken the first of them

let socket = null;
let ear = null; // the audio thread's port; null: it does not play
let more = 0; // states that the page has room for, beyond the one that was asked for
let asked = false; // for a state that has not come

function ask() {
  if (asked || more === 0 || socket.readyState !== WebSocket.OPEN) return;
  socket.send(new Uint8Array(0));
  more -= 1;
  asked = true;
}

function take(data) {
  const came = (performance.timeOrigin + performance.now()) / 1000;
  if (typeof data === 'string') return postMessage({ data, came });
  const kind = String.fromCharCode(...new Uint8Array(data, 0, Math.min(4, data.byteLength)));
  if (kind === 'SPS1') {
    asked = false;
    ask();
  } else if (kind === 'SPA1' && ear) {
    const frame = readFrame(data);
    const samples = frame.samples.slice();
    ear.postMessage({ ...frame, samples }, [samples.buffer]);
  }
  return postMessage({ data, came }, [data]);
}

function connect(address) {
  socket = new WebSocket(address);
  socket.binaryType = 'arraybuffer';
  socket.onopen = () => {
    postMessage({ isOpen: true });
    more = AHEAD;
    asked = false;
    ask();
  };
  socket.onmessage = ({ data }) => take(data);
  socket.onclose = () => {
    postMessage({ isOpen: false });
    setTimeout(() => connect(address), AGAIN_AFTER);
  };
}

/// `address`: of the server; `data`: to be sent; `taken`: so many states; `hears`: where sound goes.
onmessage = ({ data: { address, data, taken, hears } }) => {
  if (address) connect(address);
  if (data && socket.readyState === WebSocket.OPEN) socket.send(data);
  if (hears !== undefined) ear = hears;
  if (!taken) return;
  more = Math.min(more + taken, AHEAD);
  ask();
};
