// The planner's Worker: hears questions and answers them one after another, the oldest first.

import { Engine } from "../engine.js";
import { speak, useWords } from "../words.js";
import { BenchDragonError } from "./errors.js";
import { checkedPlan } from "./plan.js";
import { QUESTIONS, openedPlan } from "./questions.js";

/**
 * A question: about a plan, or "open" about the text of a plan file.
 * @typedef {object} Question
 * @property {number} id
 * @property {string} question
 * @property {"en" | "zh"} language of all sentences
 * @property {Record<string, any>} [plan]
 * @property {string} [text]
 */

/** What comes first: the engine's bytes, Chinese for English sentences, the version of the program.
 * @typedef {{ engine: ArrayBuffer, words: Record<string, string>, version: string }} Beginning */

/**
 * What is said: once that it is ready, and for what; of each question how far it is, and at last its answer,
 * why there is none. `hash` is that of the plan, where it is one. After a fault of the program
 * there is no more.
 * @typedef {{ ready: string[] }
 *   | { id: number, progress: [number, string] }
 *   | { id: number, hash: string, answer: unknown }
 *   | { id: number, hash: string, refusal: string }
 *   | { fault: string }} Said
 */

/** What hears and speaks: a Worker's own scope.
 * @typedef {{ onmessage: ((event: MessageEvent) => void) | null,
 *   postMessage: (said: Said, transfer: Transferable[]) => void }} Port */

/** A question that nobody waits for any more. */
class CancelledError extends Error {}

class Desk {
  /** @param {Engine} engine @param {string} version @param {Port} port */
  constructor(engine, version, port) {
    this.engine = engine;
    this.version = version;
    this.port = port;
    /** @type {Question[]} */
    this.waiting = [];
    /** The question that is being answered. @type {number | null} */
    this.busy = null;
    this.cancelled = false;
  }

  /** @param {Question | { cancel: number }} message */
  hear(message) {
    if ("cancel" in message) return this.#cancel(message.cancel);
    this.waiting.push(message);
    if (this.busy === null) this.#work();
  }

  /** @param {number} id */
  #cancel(id) {
    if (this.busy === id) this.cancelled = true;
    else this.waiting = this.waiting.filter((asked) => asked.id !== id);
  }

  async #work() {
    for (let asked = this.waiting.shift(); asked; asked = this.waiting.shift()) {
      this.busy = asked.id;
      this.cancelled = false;
      await this.#answer(asked);
    }
    this.busy = null;
  }

  /** @param {Question} asked */
  async #answer({ id, question, language, plan: data, text = "" }) {
    speak(language);
    let hash = "";
    const progress = (/** @type {number} */ share, /** @type {string} */ told) => {
      if (this.cancelled) throw new CancelledError();
      this.port.postMessage({ id, progress: [share, told] }, []);
    };
    try {
      let answer;
      if (data) {
        const plan = checkedPlan(data);
        hash = plan.sha256;
        const { engine, version } = this;
        answer = await QUESTIONS[question]({ engine, version, plan, progress });
      } else answer = openedPlan(text);
      this.port.postMessage({ id, hash, answer }, buffers(answer));
    } catch (error) {
      if (error instanceof CancelledError) return;
      if (error instanceof BenchDragonError)
        this.port.postMessage({ id, hash, refusal: error.message }, []);
      else this.port.postMessage({ fault: String(error) }, []);
    }
  }
}

/** The memory of lists of numbers in an answer, which is handed over. @param {unknown} answer */
function buffers(answer) {
  const values = typeof answer === "object" && answer ? Object.values(answer).flat() : [];
  return values.filter((value) => ArrayBuffer.isView(value)).map(({ buffer }) => buffer);
}

/** Begin to hear, first of all the engine. @param {Port} port */
export function serve(port) {
  port.onmessage = async ({ data: { engine, words, version } }) => {
    useWords(words);
    /** @type {MessageEvent[]} */
    const early = [];
    port.onmessage = (event) => early.push(event);
    try {
      const desk = new Desk(await Engine.load(engine), version, port);
      port.onmessage = ({ data }) => desk.hear(data);
      port.postMessage({ ready: Object.keys(QUESTIONS) }, []);
      for (const { data } of early) desk.hear(data);
    } catch (error) {
      port.postMessage({ fault: String(error) }, []);
    }
  };
}
