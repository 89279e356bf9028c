// The drum of a dance as a sound file: 16 bits, one channel, every beat at its own sample.

import { InputError } from "./compute/errors.js";
import { SOUNDS, soundsBetween } from "./drum.js";
import { _ } from "./words.js";

/** @typedef {import("./compute/briefing.js").Briefing} Briefing */

// Samples a second: enough for the highest of the sounds.
const RATE = 11_025;
// The longest track, s.
const MOST_SECONDS = 2 * 3600;
// Sounds are so much louder than those of the page, which are heard beside others.
const LOUDER = 1.3;
// Of their loudness so much is left where they end: see `Drum`.
const LEFT = 1e-3;
const [HEAD, BYTES, LOUDEST] = [44, 2, 32_767];

/** The drum from the bar that counts in until the end of the dance, s, as a WAV file. @param {Briefing} briefing @returns {Blob} */
export function drumFile({ beats, end }) {
  const start = beats.runs[0]?.start ?? end;
  const seconds = end - start;
  if (seconds > MOST_SECONDS)
    throw new InputError(
      _("a track lasts at most {most} hours, not {seconds} s: choose a shorter dance", {
        most: MOST_SECONDS / 3600,
        seconds: seconds.toFixed(0),
      }),
    );
  const samples = new Float32Array(Math.ceil((seconds + 1) * RATE));
  for (const [time, name] of soundsBetween(beats, start, end)) {
    const [pitch, loudness, length] = SOUNDS[name];
    const first = Math.round((time - start) * RATE);
    for (let n = 0; n < length * RATE; n++) {
      const fading = LOUDER * loudness * LEFT ** (n / (length * RATE));
      samples[first + n] += fading * Math.cos((2 * Math.PI * pitch * n) / RATE);
    }
  }
  return new Blob([waveOf(samples)], { type: "audio/wav" });
}

/** Samples from -1 to 1 as the bytes of a WAV file. @param {Float32Array} samples */
function waveOf(samples) {
  const size = BYTES * samples.length;
  const view = new DataView(new ArrayBuffer(HEAD + size));
  const text = (/** @type {number} */ at, /** @type {string} */ said) =>
    Array.from(said, (sign, n) => view.setUint8(at + n, sign.charCodeAt(0)));
  text(0, "RIFF");
  view.setUint32(4, HEAD - 8 + size, true);
  text(8, "WAVEfmt ");
  view.setUint32(16, 16, true);
  view.setUint16(20, 1, true); // numbers as they are
  view.setUint16(22, 1, true); // channels
  view.setUint32(24, RATE, true);
  view.setUint32(28, RATE * BYTES, true);
  view.setUint16(32, BYTES, true);
  view.setUint16(34, 8 * BYTES, true);
  text(36, "data");
  view.setUint32(40, size, true);
  for (const [n, sample] of samples.entries()) {
    const kept = Math.min(Math.max(sample, -1), 1);
    view.setInt16(HEAD + BYTES * n, Math.round(LOUDEST * kept), true);
  }
  return view.buffer;
}
