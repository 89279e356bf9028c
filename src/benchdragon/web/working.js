// Questions to Workers of the page's own, which compute without a server.

import { Table } from "./following.js";
import { planName } from "./names.js";
import { Scene } from "./scene.js";
import { PageFault, Refusal, noteHash } from "./standing.js";
import { _, language } from "./words.js";

/** @typedef {import("./compute/worker.js").Beginning} Beginning */
/** @typedef {import("./compute/worker.js").Said} Said */
/** @typedef {import("./messages").JobState} JobState */
/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./standing.js").Answers} Answers */

/** @typedef {import("./messages").Verdict} Verdict */
/** What is asked of a Worker: see `Question` of compute/worker.js.
 * @typedef {{ question: string, plan?: Plan, wishes?: Record<string, any>, verdict?: Verdict | null,
 *   text?: string }} Asked */
/** Who waits for an answer.
 * @typedef {{ plan: Plan | undefined, done: (answer: any) => void, failed: (error: Error) => void,
 *   told: (share: number, text: string) => void }} Waiting */

/** What those who wait hear when nobody waits any more. */
function abandoned() {
  return new DOMException("", "AbortError");
}

/** One Worker, started when it is asked for the first time, and again after it failed. */
class Lane {
  #number = 0;
  /** @type {Worker | null} */
  #worker = null;
  /** @type {Map<number, Waiting>} */
  #waiting = new Map();
  /** Who waits for it to be ready. @type {{ done: (names: string[]) => void, failed: (error: Error) => void }} */
  #starting = { done: () => {}, failed: () => {} };

  /** @param {string} script its address @param {Beginning} beginning */
  constructor(script, beginning) {
    this.script = script;
    this.beginning = beginning;
  }

  /** The questions that it answers, once it is ready. @returns {Promise<string[]>} */
  started() {
    return new Promise((done, failed) => {
      this.#starting = { done, failed };
      this.#start();
    });
  }

  #start() {
    this.#worker = new Worker(this.script);
    this.#worker.onmessage = ({ data }) => this.#hear(data);
    this.#worker.onerror = (event) => {
      event.preventDefault();
      this.#fail(event.message);
    };
    this.#worker.postMessage(this.beginning);
  }

  /** Ask no more; those who wait hear it. */
  close() {
    this.#worker?.terminate();
    this.#worker = null;
    for (const { failed } of this.#waiting.values()) failed(abandoned());
    this.#waiting.clear();
  }

  /**
   * @param {Asked} asked
   * @param {AbortSignal} [signal]
   * @param {(share: number, text: string) => void} [told] how far it is
   * @returns {Promise<any>}
   */
  ask(asked, signal, told = () => {}) {
    if (!this.#worker) this.#start();
    const id = ++this.#number;
    return new Promise((done, failed) => {
      this.#waiting.set(id, { plan: asked.plan, done, failed, told });
      signal?.addEventListener("abort", () => {
        if (!this.#waiting.delete(id)) return;
        this.#worker?.postMessage({ cancel: id });
        failed(abandoned());
      });
      this.#worker?.postMessage({ id, language: language(), ...asked });
    });
  }

  /** @param {Said} said */
  #hear(said) {
    if ("ready" in said) return this.#starting.done(said.ready);
    if ("fault" in said) return this.#fail(said.fault);
    const waiting = this.#waiting.get(said.id);
    if (!waiting) return;
    if ("progress" in said) return waiting.told(...said.progress);
    this.#waiting.delete(said.id);
    if (waiting.plan) noteHash(waiting.plan, said.hash);
    if ("answer" in said) waiting.done(said.answer);
    else waiting.failed(new Refusal(said.refusal));
  }

  /** The Worker cannot go on: its memory may be damaged. @param {string} fault */
  #fail(fault) {
    const refusal = new PageFault(_("something is wrong with this page: {fault}", { fault }));
    for (const { failed } of [this.#starting, ...this.#waiting.values()]) failed(refusal);
    this.#waiting.clear();
    this.close();
  }
}

/** A long question, with a Worker of its own, which ends with it. */
class WorkerQuestion {
  /** @param {Lane} lane @param {JobState["question"]} question @param {Plan} plan */
  constructor(lane, question, plan) {
    this.lane = lane;
    this.question = question;
    this.plan = plan;
  }

  /** @param {(state: JobState) => void} told @returns {Promise<JobState>} */
  async follow(told) {
    const { lane, question, plan } = this;
    const state = { question, share: 0, text: "" };
    const tell = (/** @type {number} */ share, /** @type {string} */ text) =>
      told({ ...state, state: "running", share, text });
    tell(0, "");
    try {
      const asked = { question: `job/${question}`, plan };
      const result = await lane.ask(asked, undefined, tell);
      return { ...state, state: "done", result };
    } catch (error) {
      if (error instanceof DOMException) return { ...state, state: "cancelled" };
      if (!(error instanceof Refusal)) throw error;
      return { ...state, state: "failed", error: error.message };
    } finally {
      lane.close();
    }
  }

  cancel() {
    this.lane.close();
  }
}

/** There is no answer: say so to those who can do without. @param {Error} error */
function withoutAnswer(error) {
  if (error instanceof Refusal) return null;
  throw error;
}

/** Workers as who answers. @implements {Answers} */
export class WorkerAnswers {
  /** @type {Set<string>} */
  #questions = new Set();

  /** @param {string} script the address of the Worker's script @param {Beginning} beginning */
  constructor(script, beginning) {
    this.lane = () => new Lane(script, beginning);
    this.quick = this.lane();
    // Sizes and dances take longer than a verdict, which is not to wait for them, nor they for one another.
    this.slower = this.lane();
    this.drawing = this.lane();
    /** The plan that was judged last, and what was found by now; null where there is no verdict.
     * @type {{ plan: Plan, known: Verdict | null, found: Promise<Verdict | null> } | null} */
    this.judging = null;
  }

  /** Wait until there are answers. @throws {Refusal} where the browser cannot compute */
  async start() {
    this.#questions = new Set(await this.quick.started());
  }

  /** @param {string} question */
  has(question) {
    return this.#questions.has(question);
  }

  /** @param {string} question @param {Plan} plan @param {AbortSignal} signal */
  ask(question, plan, signal) {
    if (question !== "verdict") return this.slower.ask({ question, plan }, signal);
    const asked = this.quick.ask({ question, plan }, signal);
    /** @type {NonNullable<WorkerAnswers["judging"]>} */
    const judging = { plan, known: null, found: asked.catch(withoutAnswer) };
    this.judging = judging;
    const given = () => {}; // up, which those who asked hear
    judging.found.then((verdict) => (judging.known = verdict), given);
    return asked;
  }

  /** @param {Plan} plan @param {AbortSignal} signal */
  async sketch(plan, signal) {
    const verdict = this.judging?.plan === plan ? this.judging.known : null;
    return this.#drawn({ question: "sketch", plan, verdict }, signal);
  }

  /** @param {Plan} plan @param {AbortSignal} signal */
  async scene(plan, signal) {
    const verdict = this.judging?.plan === plan ? await this.judging.found : null;
    signal.throwIfAborted();
    return this.#drawn({ question: "dance", plan, verdict }, signal);
  }

  /** @param {Asked} asked @param {AbortSignal} signal */
  async #drawn(asked, signal) {
    const { sent, nodes, framed, tables } = await this.drawing.ask(asked, signal);
    const behind = sent.following?.tables ?? [];
    const follow = behind.map(
      (/** @type {any} */ one, /** @type {number} */ i) => new Table(one, tables[i]),
    );
    return new Scene(sent, nodes, framed, follow);
  }

  /** @param {string} text @returns {Promise<Plan>} */
  opened(text) {
    return this.quick.ask({ question: "open", text });
  }

  /** @param {Plan} plan */
  async saved(plan) {
    const text = await this.quick.ask({ question: "toml", plan });
    return {
      name: `${planName(plan)}.dragon.toml`,
      data: new Blob([text], { type: "application/toml" }),
    };
  }

  /** @param {JobState["question"]} question @param {Plan} plan */
  long(question, plan) {
    return new WorkerQuestion(this.lane(), question, plan);
  }

  aside() {
    return this.lane();
  }
}
