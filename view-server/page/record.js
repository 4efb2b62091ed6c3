// SPDX-License-Identifier: MIT
// A picture as PNG, a film as WebM with the sound that is heard.

const FILM = 30; // [s] at most

function save(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

const stamped = (scene, ending) =>
  `${scene}-${new Date().toISOString().slice(0, 19).replace(/[:T]/g, '-')}.${ending}`;

/// Right after a picture was drawn, before the browser takes it away.
export function savePicture(canvas, scene) {
  canvas.toBlob((blob) => blob && save(blob, stamped(scene, 'png')), 'image/png');
}

export class Film {
  constructor(canvas, sound) {
    Object.assign(this, { canvas, sound });
  }

  get isOn() {
    return this.recorder?.state === 'recording';
  }

  start(scene, ended) {
    const stream = this.canvas.captureStream(60);
    for (const track of this.sound.stream()?.getAudioTracks() ?? []) stream.addTrack(track);
    const kind = ['video/webm;codecs=vp9,opus', 'video/webm;codecs=vp8,opus', 'video/webm']
      .find((type) => MediaRecorder.isTypeSupported(type));
    this.recorder = new MediaRecorder(stream, { mimeType: kind, videoBitsPerSecond: 12e6 });
    const end = setTimeout(() => this.stop(), FILM * 1000);
    const parts = [];
    this.recorder.ondataavailable = ({ data }) => parts.push(data);
    this.recorder.onstop = () => {
      clearTimeout(end);
      save(new Blob(parts, { type: 'video/webm' }), stamped(scene, 'webm'));
      ended();
    };
    this.recorder.start(1000);
  }

  stop() {
    if (this.isOn) this.recorder.stop();
  }
}
