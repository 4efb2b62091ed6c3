// SPDX-License-Identifier: MIT
// The strip of events, the channels' levels, the monitor's waveform and spectrum.
import { COLOURS } from './rings.js';

const SPAN = 10; // [s] of the strip
const LOWEST = -70; // [dB] of levels and spectrum

const css = (tint, alpha = 1) =>
  `rgb(${tint.map((x) => Math.round(255 * x)).join(' ')} / ${alpha})`;

/// A canvas' context with its size in CSS pixels.
function clean(canvas) {
  const { clientWidth: w, clientHeight: h } = canvas;
  const share = Math.min(window.devicePixelRatio, 2);
  if (canvas.width !== Math.round(w * share)) canvas.width = Math.round(w * share);
  if (canvas.height !== Math.round(h * share)) canvas.height = Math.round(h * share);
  const pen = canvas.getContext('2d');
  pen.setTransform(share, 0, 0, share, 0, 0);
  pen.clearRect(0, 0, w, h);
  pen.font = '10px system-ui, sans-serif';
  return { pen, w, h };
}

export class Strip {
  constructor(canvas) {
    this.canvas = canvas;
    this.events = [];
  }

  add(event) {
    this.events.push(event);
  }

  draw(now) {
    this.events = this.events.filter((e) => now - e.time < SPAN);
    const { pen, w, h } = clean(this.canvas);
    Object.entries(COLOURS).forEach(([kind, tint], row) => {
      const y = ((row + 0.5) * h) / 3;
      pen.fillStyle = css(tint, 0.7);
      pen.fillText(kind.slice(1), 0, y + 3);
      pen.fillStyle = css(tint, 0.15);
      pen.fillRect(48, y, w - 48, 1);
      pen.fillStyle = css(tint, 0.85);
      for (const e of this.events) {
        if (e.kind !== kind || e.time > now) continue;
        const tall = Math.max(2, Math.min(h / 3 - 2, (h / 3) * e.strength));
        pen.fillRect(w - ((now - e.time) / SPAN) * (w - 48), y - tall / 2, 2, tall);
      }
    });
  }
}

const decibels = (x) => 20 * Math.log10(Math.max(x, 1e-9));
const tall = (db, h) => Math.max(0, Math.min(1, 1 - db / LOWEST)) * h;

export function drawMeters(canvas, peaks) {
  const { pen, w, h } = clean(canvas);
  pen.fillStyle = '#8fa9b3';
  if (!peaks) return pen.fillText('no levels yet', 0, h / 2);
  const wide = w / peaks.length;
  peaks.forEach((peak, i) => {
    const db = decibels(peak);
    const y = tall(db, h);
    pen.fillStyle = 'rgb(143 169 179 / 12%)';
    pen.fillRect(i * wide, 0, Math.max(wide - 1.5, 1), h);
    pen.fillStyle = db > -3 ? '#ff6b5a' : db > -20 ? '#ffb84d' : '#4fc4e0';
    pen.fillRect(i * wide, h - y, Math.max(wide - 1.5, 1), y);
  });
  return undefined;
}

/// In place, radix 2; `re` and `im` of equal length, a power of two.
export function fourier(re, im) {
  const n = re.length;
  for (let i = 1, j = 0; i < n; ++i) {
    let bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) {
      [re[i], re[j]] = [re[j], re[i]];
      [im[i], im[j]] = [im[j], im[i]];
    }
  }
  for (let size = 2; size <= n; size <<= 1) {
    for (let k = 0; k < size / 2; ++k) {
      const angle = (-2 * Math.PI * k) / size;
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      for (let i = k; i < n; i += size) {
        const j = i + size / 2;
        const [a, b] = [c * re[j] - s * im[j], c * im[j] + s * re[j]];
        [re[j], im[j]] = [re[i] - a, im[i] - b];
        re[i] += a;
        im[i] += b;
      }
    }
  }
}

export function drawScope(canvas, sound) {
  const { pen, w, h } = clean(canvas);
  const n = 2048;
  const half = w / 2 - 6;
  const sides = [sound.last(n, 0), sound.last(n, 1)];
  const most = Math.max(0.02, ...sides[0], ...sides[1]);
  sides.forEach((side, k) => {
    pen.strokeStyle = k ? 'rgb(255 184 77 / 70%)' : 'rgb(79 196 224 / 90%)';
    pen.beginPath();
    for (let x = 0; x < half; ++x) {
      const value = side[Math.floor((x / half) * n)];
      pen.lineTo(x, h / 2 - (value / most) * (h / 2 - 2));
    }
    pen.stroke();
  });
  const re = sides[0].map((x, i) => (0.5 - 0.5 * Math.cos((2 * Math.PI * i) / n)) * (x + sides[1][i]) / 2);
  const im = new Float32Array(n);
  fourier(re, im);
  pen.fillStyle = 'rgb(79 196 224 / 80%)';
  const low = 20;
  const top = Math.min(8000, sound.rate / 2);
  for (let x = 0; x < half; x += 2) {
    const hertz = (at) => low * (top / low) ** (at / half);
    const first = Math.max(1, Math.floor((hertz(x) * n) / sound.rate));
    const last = Math.max(first, Math.floor((hertz(x + 2) * n) / sound.rate));
    let peak = 0;
    for (let i = first; i <= last; ++i) peak = Math.max(peak, Math.hypot(re[i], im[i]));
    const y = tall(decibels((4 * peak) / n), h - 10);
    pen.fillRect(w / 2 + 6 + x, h - 10 - y, 1.5, y);
  }
  pen.fillStyle = '#8fa9b3';
  for (const [hertz, name] of [[50, '50'], [200, '200'], [1000, '1k'], [4000, '4k Hz']]) {
    const x = w / 2 + 6 + half * (Math.log(hertz / low) / Math.log(top / low));
    pen.fillText(name, Math.min(x, w - pen.measureText(name).width), h);
  }
}
