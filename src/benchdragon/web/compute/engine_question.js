// Questions that the engine holds: stepped until they are answered, within what a question may take.
// Twin of analysis/engine_question.py.

import { NoMemory } from "../engine.js";
import { hold, left, spend } from "./budget.js";
import { QuestionEnding, Told } from "./constants.js";
import { py } from "./python.js";
import { tick } from "./tick.js";

/** A question that the engine holds, until it is freed: what Python modules ask. */
export class EngineQuestion {
  /**
   * @param {number} handle what its entry `open` gave
   * @param {(...given: any[]) => number} step its entry that goes on
   * @param {(...given: any[]) => number} read its entry that fills arrays with what is known
   * @param {any[]} told these arrays, the first as kernels/question.py says
   */
  constructor(handle, step, read, ...told) {
    if (!handle) throw new NoMemory("no memory for a question");
    this._handle = handle;
    this.entries = { step, read };
    this.arrays = told;
  }

  /** Give all back. */
  free() {
    py.entry("bd_question_close_question", this._handle);
  }

  /** What it tells of itself. */
  get figures() {
    return this.arrays[0];
  }

  /** Some of these figures. @param {number[]} columns */
  tell(...columns) {
    return columns.map((column) => py.at(this.figures, column));
  }

  /** Let go, so that a Worker hears what it is told. */
  rest() {
    return tick();
  }

  /** Go on for some hundredths of a second; how that ended. @param {number[]} said what else the entry takes */
  async step(...said) {
    const ending = this.entries.step(this._handle, left(), ...said);
    this.entries.read(this._handle, ...this.arrays);
    if (ending === QuestionEnding.CLOSED) throw new TypeError("this question was closed");
    const [spent, wanted] = this.tell(Told.SPENT, Told.WANTED);
    spend(spent);
    if (ending === QuestionEnding.OVER_MEMORY) hold(wanted);
    if (ending === QuestionEnding.OVER_MEMORY || ending === QuestionEnding.OUT_OF_MEMORY)
      throw new NoMemory("no memory for the tables of a question");
    await tick();
    return ending;
  }
}
