// The loop of a page that draws: it turns while something moves, and sleeps while nothing does.

/** One turn of the loop lasts at most, s. */
const LONGEST_TURN = 0.1;

export class Loop {
  /** @param {(passed: number, now: number) => boolean} turn s since the turn before, 0 after a rest, and the time, ms; whether to go on */
  constructor(turn) {
    this.turn = turn;
  }

  #turning = false;
  /** When the turn before was, ms; NaN after a rest. */
  #before = NaN;

  /** Turn until nothing moves any more: a page at rest takes nothing of a phone's battery. */
  wake() {
    if (this.#turning) return;
    this.#turning = true;
    this.#before = NaN;
    this.#next();
  }

  #next() {
    requestAnimationFrame((now) => {
      const passed = Math.min((now - this.#before) / 1000, LONGEST_TURN) || 0;
      this.#before = now;
      this.#turning = this.turn(passed, now);
      if (this.#turning) this.#next();
    });
  }
}
