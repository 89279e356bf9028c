// A question that is asked again and again as the plan changes, and what is known of answers.

/** @typedef {import("./messages").JobState} JobState */
/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./scene.js").Scene} Scene */

/** A file that was made. @typedef {{ name: string, data: Blob }} MadeFile */

/**
 * A long question under way.
 * @typedef {object} LongQuestion
 * @property {(told: (state: JobState) => void, troubled: (error: Error) => void) => Promise<JobState>} follow
 *   how it stands, time and again, and at last how it ended
 * @property {() => void} cancel
 * @property {() => void} forget how it ended
 */

/**
 * Who answers questions about plans: names are those of tasks, such as "verdict" and "limit/pitch".
 * @typedef {object} Answers
 * @property {(question: string) => boolean} has whether it answers such a question
 * @property {(question: string, plan: Plan, signal: AbortSignal) => Promise<any>} ask
 * @property {(plan: Plan, signal: AbortSignal) => Promise<Scene>} scene
 * @property {(text: string) => Promise<Plan>} opened the plan in a plan file
 * @property {(plan: Plan) => Promise<MadeFile>} saved
 * @property {(kind: string, plan: Plan) => Promise<MadeFile>} [exported] if it makes other files
 * @property {(question: JobState["question"], plan: Plan) => Promise<LongQuestion>} long
 * @property {() => Promise<{ question: JobState["question"], plan: Plan, long: LongQuestion }[]>} taken
 *   long questions that this page had asked before it was loaded again
 * @property {() => Aside} [aside] if it has somebody for questions that nobody waits for
 */

/**
 * Somebody apart, for questions that nobody waits for.
 * @typedef {object} Aside
 * @property {(asked: { question: string, plan: Plan }) => Promise<any>} ask
 * @property {() => void} close give up at once what is under way: it ends in an AbortError
 */

/** Hashes of plans, which come with every answer about one. @type {WeakMap<Plan, string>} */
const hashes = new WeakMap();

/** Note the hash of a plan. @param {Plan} plan @param {string | null} hash */
export function noteHash(plan, hash) {
  if (hash) hashes.set(plan, hash);
}

/** Whether what is said of one plan holds for another. @param {Plan} one @param {Plan} other */
export function samePlan(one, other) {
  const hash = hashes.get(one);
  return one === other || (hash !== undefined && hash === hashes.get(other));
}

/** There is no answer: a status of HTTP, or 0 where nobody answers; `message` is the sentence for it. */
export class Refusal extends Error {
  /** @param {number} status @param {string} message */
  constructor(status, message) {
    super(message);
    this.status = status;
  }
}

/** Statuses after which asking again may help: no answer, another page's question instead, too many
 * questions, a server that is closing or lost its workers. */
const AGAIN = [0, 409, 429, 503];

/** Whether asking again may help. @param {unknown} error @returns {error is Refusal} */
export function mayPass(error) {
  return error instanceof Refusal && AGAIN.includes(error.status);
}

/** How long a question may be on its way before a newer one takes its place, ms: so long, or twice as
 * long as the last answer took, and twice as long again after each that was given up. */
const PATIENCE = 250;
/** The status that says: a newer question is on its way. */
const REPLACED = 409;
/** How soon a question that nobody could answer is asked again, ms: at first, and at most. */
const SOON = 2000;
const LATEST = 30_000;

/**
 * One question that is asked again and again as the plan changes: the newest is always answered, and
 * those that nobody waits for any more are given up. Each answer comes with the plan that it is about.
 * @template Answer
 */
export class Standing {
  /**
   * @param {(plan: Plan, signal: AbortSignal) => Promise<Answer>} ask
   * @param {(answer: Answer, plan: Plan) => void} answered
   * @param {(error: Error, plan: Plan) => void} failed
   */
  constructor(ask, answered, failed) {
    this.ask = ask;
    this.answered = answered;
    this.failed = failed;
    /** The plan to be asked about next. @type {Plan | null} */
    this.wanted = null;
    /** @type {AbortController | null} */
    this.flying = null;
    this.since = 0;
    this.patience = PATIENCE;
    this.pause = SOON;
    this.later = 0;
    /** Times from a question to its answer, ms. @type {number[]} */
    this.times = [];
  }

  /** Ask about a plan, and no more about those before. @param {Plan} plan */
  renew(plan) {
    clearTimeout(this.later);
    this.wanted = plan;
    if (!this.flying) this.#go();
    else if (performance.now() - this.since > this.patience) {
      this.patience *= 2;
      this.flying.abort();
    }
  }

  /** Ask no more. */
  drop() {
    clearTimeout(this.later);
    this.wanted = null;
    this.flying?.abort();
  }

  async #go() {
    while (this.wanted) {
      const plan = this.wanted;
      this.wanted = null;
      this.flying = new AbortController();
      this.since = performance.now();
      try {
        const answer = await this.ask(plan, this.flying.signal);
        const time = performance.now() - this.since;
        this.times.push(time);
        this.patience = Math.max(PATIENCE, 2 * time);
        this.pause = SOON;
        this.answered(answer, plan);
      } catch (error) {
        if (!(error instanceof Error)) throw error;
        if (error.name !== "AbortError") this.#unanswered(error, plan);
      }
    }
    this.flying = null;
  }

  /** @param {Error} error @param {Plan} plan */
  #unanswered(error, plan) {
    const replaced = error instanceof Refusal && error.status === REPLACED;
    if (!replaced) this.failed(error, plan);
    if (this.wanted || !mayPass(error)) return;
    this.later = setTimeout(() => this.renew(plan), this.pause);
    this.pause = Math.min(2 * this.pause, LATEST);
  }
}
