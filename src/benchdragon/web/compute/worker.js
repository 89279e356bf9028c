// The planner's Worker: hears questions and answers them one after another, the oldest first.

import { Engine, NoMemory } from "../engine.js";
import { _, speak, useWords } from "../words.js";
import { BenchDragonError } from "./errors.js";
import { checked } from "./plan.js";
import { QUESTIONS, openedPlan } from "./questions.js";
import { heedAtTicks } from "./tick.js";

/**
 * A question: about a plan or wishes for one, or "open" about the text of a plan file.
 * @typedef {object} Question
 * @property {number} id
 * @property {string} question
 * @property {"en" | "zh"} language of all sentences
 * @property {Record<string, any>} [plan]
 * @property {Record<string, any>} [wishes] for a plan, where there is none
 * @property {import("../messages").Verdict | null} [verdict] on that plan, where it is known
 * @property {string} [text]
 */

/** What comes first: the engine, compiled, Chinese for English sentences, the version of the program.
 * @typedef {{ engine: WebAssembly.Module, words: Record<string, string>, version: string }} Beginning */

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

/** An engine that holds more bytes than this after a question gives way to a new one. */
export const MOST_HELD = 200e6;

/** A dance that is checked at once, and calls most of what checks call. */
const SMALL = {
  schema: 1,
  dragon: { benches: 5 },
  route: { kind: "turn" },
  walk: { start: -20, end: 20 },
};

/** The number of no question. */
const WARMING = 0;

class Desk {
  /** @param {WebAssembly.Module} module @param {Engine} engine that of it @param {string} version @param {Port} port */
  constructor(module, engine, version, port) {
    this.module = module;
    this.engine = engine;
    this.version = version;
    this.port = port;
    /** @type {Question[]} */
    this.waiting = [];
    /** The question that is being answered. @type {number | null} */
    this.busy = null;
    this.cancelled = false;
    heedAtTicks(() => this.#heed());
  }

  /** Give up the question under way if nobody waits for it. */
  #heed() {
    if (this.cancelled) throw new CancelledError();
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

  /** Let the browser compile what questions will call, until the first is asked. */
  async warm() {
    if (this.busy !== null) return;
    this.busy = WARMING;
    const { engine, version } = this;
    const progress = () => {
      if (this.waiting.length) throw new CancelledError();
    };
    try {
      await QUESTIONS.verdict({ engine, version, plan: checked(SMALL), progress });
    } catch (error) {
      if (!(error instanceof CancelledError)) throw error;
    }
    this.#work();
  }

  async #work() {
    for (let asked = this.waiting.shift(); asked; asked = this.waiting.shift()) {
      this.busy = asked.id;
      this.cancelled = false;
      await this.#answer(asked);
      if (this.engine.held > MOST_HELD) this.engine = await Engine.load(this.module);
    }
    this.busy = null;
  }

  /** @param {Question} asked */
  async #answer({ id, question, language, plan: data, wishes, verdict, text = "" }) {
    speak(language);
    let hash = "";
    const progress = (/** @type {number} */ share, /** @type {string} */ told) => {
      this.#heed();
      this.port.postMessage({ id, progress: [share, told] }, []);
    };
    try {
      let answer;
      if (data || wishes) {
        const plan = /** @type {import("./plan.js").Plan} */ (data && checked(data));
        hash = plan?.sha256 ?? "";
        const { engine, version } = this;
        answer = await QUESTIONS[question]({ engine, version, plan, wishes, verdict, progress });
      } else answer = openedPlan(text);
      this.port.postMessage({ id, hash, answer }, buffers(answer));
    } catch (error) {
      if (error instanceof CancelledError) return;
      const refusal = refusalOf(error);
      if (refusal) this.port.postMessage({ id, hash, refusal }, []);
      else this.port.postMessage({ fault: String(error) }, []);
    }
  }
}

/** Why a question has no answer; null where the program is wrong. @param {unknown} error */
function refusalOf(error) {
  if (error instanceof BenchDragonError) return error.message;
  if (error instanceof NoMemory)
    return _("This browser has not enough memory for that: the command line may have.");
  return null;
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
      const desk = new Desk(engine, await Engine.load(engine), version, port);
      port.onmessage = ({ data }) => desk.hear(data);
      port.postMessage({ ready: Object.keys(QUESTIONS) }, []);
      for (const { data } of early) desk.hear(data);
      await desk.warm();
    } catch (error) {
      port.postMessage({ fault: String(error) }, []);
    }
  };
}
