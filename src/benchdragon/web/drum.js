// The drum of a dance: its beats, played in time with the page by the sound card's own clock.

/** @typedef {import("./messages").Beats} Beats */
/** @typedef {"beat" | "bar" | "count" | "drum"} Sound */

/** So far ahead beats are given to the sound card, s of its clock. */
const AHEAD = 0.25;
/** When the page is so far from where the drum takes it to be, s, the drum starts anew; with a picture a second more. */
const ASTRAY = 0.12;
const ASTRAY_STILL = 1.3;
/** Beats of two runs that are so near are one, s. */
const SAME = 1e-6;
/** The last beat of a run comes so much before its end, as a share of a beat. */
const END_SHARE = 1e-6;
/** Pitch, Hz, loudness, and length, s, of each sound. @type {Record<Sound, [number, number, number]>} */
export const SOUNDS = {
  beat: [1000, 0.25, 0.05],
  bar: [1500, 0.35, 0.06],
  count: [2400, 0.2, 0.05],
  drum: [110, 0.7, 0.2],
};

/**
 * What sounds from one time of the dance on until another, s.
 * @param {Beats} beats @param {number} from @param {number} to
 */
export function soundsBetween(beats, from, to) {
  /** @type {[number, Sound][]} */
  const found = [];
  for (const time of beats.strokes) if (time >= from && time < to) found.push([time, "drum"]);
  for (const { start, end, period, bar, counted } of beats.runs) {
    const count = Math.ceil((end - start) / period - END_SHARE);
    const first = Math.max(0, Math.ceil((from - start) / period));
    for (let n = first; n < count && start + n * period < to; n += 1) {
      const time = start + n * period;
      if (beats.strokes.some((stroke) => Math.abs(stroke - time) < SAME)) continue;
      found.push([time, counted ? "count" : n % bar ? "beat" : "bar"]);
    }
  }
  return found.sort((a, b) => a[0] - b[0]);
}

export class Drum {
  on = false;

  /** @type {AudioContext | null} */
  #context = null;
  /** What was given to the sound card and may not have sounded yet. @type {OscillatorNode[]} */
  #given = [];
  /** The page's time, s, the sound card's then, and the speed of play; null while it does not play. @type {{ time: number, clock: number, speed: number } | null} */
  #since = null;
  /** Until which time of the dance beats are given, s. */
  #until = 0;

  /** @param {boolean} on only what a user does may start sound */
  turn(on) {
    this.on = on;
    if (on) {
      this.#context ??= new AudioContext();
      void this.#context.resume();
    } else {
      this.#silence();
    }
  }

  /**
   * Go on: at each turn of the page's loop.
   * @param {Beats | null | undefined} beats @param {number} time of the page, s
   * @param {boolean} playing @param {number} speed @param {boolean} still whether the page shows a picture a second
   */
  play(beats, time, playing, speed, still) {
    if (!this.on || !this.#context || !beats || !playing) {
      this.#silence();
      return;
    }
    const clock = this.#context.currentTime;
    const { time: from = NaN, clock: then = 0, speed: before = speed } = this.#since ?? {};
    const astray = Math.abs(from + (clock - then) * before - time) / speed;
    if (!(astray <= (still ? ASTRAY_STILL : ASTRAY)) || before !== speed) {
      this.#silence();
      this.#since = { time, clock, speed };
      this.#until = time;
    }
    const { time: base, clock: zero } = this.#since ?? { time, clock };
    const to = base + (clock + AHEAD - zero) * speed;
    for (const [at, sound] of soundsBetween(beats, this.#until, to))
      this.#give(sound, Math.max(zero + (at - base) / speed, clock));
    this.#until = Math.max(to, this.#until);
  }

  /** @param {Sound} name @param {number} when s of the sound card's clock */
  #give(name, when) {
    const context = this.#context;
    if (!context) return;
    const [pitch, loudness, length] = SOUNDS[name];
    const [tone, volume] = [context.createOscillator(), context.createGain()];
    tone.frequency.value = pitch;
    volume.gain.setValueAtTime(loudness, when);
    volume.gain.exponentialRampToValueAtTime(1e-3 * loudness, when + length);
    tone.connect(volume).connect(context.destination);
    tone.onended = () => {
      this.#given = this.#given.filter((one) => one !== tone);
    };
    tone.start(when);
    tone.stop(when + length);
    this.#given.push(tone);
  }

  /** Take back what has not sounded yet. */
  #silence() {
    for (const tone of this.#given) {
      tone.onended = null;
      tone.disconnect();
    }
    this.#given = [];
    this.#since = null;
  }
}
