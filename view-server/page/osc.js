// SPDX-License-Identifier: MIT
// OSC 1.0 as the gate takes it: messages of i f s t, and bundles of them. protocol/README.md.

const EPOCH = 2208988800; // Unix's zero in NTP's seconds
const ERA = 2 ** 32; // [s]: from 2036 on the clear top bit means the next one

const padded = (bytes) => (bytes + 4) & ~3;

function textBytes(text) {
  const bytes = new Uint8Array(padded(text.length));
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i) & 127;
  return bytes;
}

/// An NTP time tag of Unix time [s].
function timeBytes(time) {
  const bytes = new Uint8Array(8);
  const view = new DataView(bytes.buffer);
  const whole = Math.floor(time);
  view.setUint32(0, (whole + EPOCH) % ERA);
  view.setUint32(4, Math.floor((time - whole) * ERA));
  return bytes;
}

/// `types` as in ",if"; a t is Unix time [s].
export function encode(address, types, ...values) {
  const parts = [textBytes(address), textBytes(types)];
  values.forEach((value, k) => {
    const type = types[k + 1];
    if (type === 's') return parts.push(textBytes(value));
    if (type === 't') return parts.push(timeBytes(value));
    const bytes = new Uint8Array(4);
    const view = new DataView(bytes.buffer);
    if (type === 'i') view.setInt32(0, value);
    else view.setFloat32(0, value);
    return parts.push(bytes);
  });
  const out = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  parts.reduce((at, part) => (out.set(part, at), at + part.length), 0);
  return out;
}

/// A bundle of one message, made at `time`, Unix time [s].
export function encodeAt(time, address, types, ...values) {
  const message = encode(address, types, ...values);
  const out = new Uint8Array(20 + message.length);
  out.set(textBytes('#bundle'));
  out.set(timeBytes(time), 8);
  new DataView(out.buffer).setInt32(16, message.length);
  out.set(message, 20);
  return out;
}

function timeAt(view, at) {
  const whole = view.getUint32(at);
  const era = whole < 2 ** 31 ? ERA : 0;
  return whole + era - EPOCH + view.getUint32(at + 4) / ERA;
}

function messageIn(bytes, time) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let at = 0;
  const text = () => {
    let end = at;
    while (bytes[end] !== 0) if (++end >= bytes.length) throw new Error('OSC: text without end');
    const value = String.fromCharCode(...bytes.subarray(at, end));
    at += padded(end - at);
    return value;
  };
  const address = text();
  const values = [];
  for (const type of text().slice(1)) {
    if (type === 's') values.push(text());
    else if (type === 'i') values.push(view.getInt32(at));
    else if (type === 'f') values.push(view.getFloat32(at));
    else if (type === 't') values.push(timeAt(view, at));
    else throw new Error(`OSC: type ${type}`);
    if (type !== 's') at += type === 't' ? 8 : 4;
  }
  return { address, values, time };
}

/// The messages of a packet; `time` is their bundle's, Unix time [s].
export function decode(bytes) {
  if (bytes[0] !== 35) return [messageIn(bytes, null)];
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const time = timeAt(view, 8);
  const messages = [];
  for (let at = 16; at + 4 <= bytes.length;) {
    const size = view.getInt32(at);
    messages.push(messageIn(bytes.subarray(at + 4, at + 4 + size), time));
    at += 4 + size;
  }
  return messages;
}
