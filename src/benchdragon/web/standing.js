// A question that is asked again and again as the plan changes, and what is known of answers.

/** @typedef {import("./messages").JobState} JobState */
/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./scene.js").Scene} Scene */

/** A file that was made. @typedef {{ name: string, data: Blob }} MadeFile */

/**
 * A long question under way.
 * @typedef {object} LongQuestion
 * @property {(told: (state: JobState) => void) => Promise<JobState>} follow
 *   how it stands, time and again, and at last how it ended
 * @property {() => void} cancel
 */

/**
 * Who answers questions about plans: names are those of tasks, such as "verdict" and "limit/pitch".
 * @typedef {object} Answers
 * @property {(question: string) => boolean} has whether it answers such a question
 * @property {(question: string, plan: Plan, signal: AbortSignal) => Promise<any>} ask
 * @property {(plan: Plan, signal: AbortSignal) => Promise<Scene>} sketch its dance soon, with what is known
 * @property {(plan: Plan, signal: AbortSignal) => Promise<Scene>} scene its dance, with what its verdict found
 * @property {(text: string) => Promise<Plan>} opened the plan in a plan file
 * @property {(plan: Plan) => Promise<MadeFile>} saved
 * @property {(question: JobState["question"], plan: Plan) => LongQuestion} long
 * @property {() => Aside} aside somebody for questions that nobody waits for
 */

/**
 * Somebody apart, for questions that nobody waits for.
 * @typedef {object} Aside
 * @property {(asked: { question: string, plan?: Plan, wishes?: Record<string, any> }, signal?: AbortSignal,
 *   told?: (share: number, text: string) => void) => Promise<any>} ask `told` hears how far it is
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

/** There is no answer; `message` is the sentence for it. */
export class Refusal extends Error {}

/** There is no answer, and the page is to blame. */
export class PageFault extends Refusal {}

/** What is done once nothing has put it off for so long. */
export class Delayed {
  #timer = 0;

  /** @param {number} delay ms @param {() => void} act */
  constructor(delay, act) {
    this.delay = delay;
    this.act = act;
  }

  /** Put it off, from now on. */
  renew() {
    this.drop();
    this.#timer = setTimeout(this.act, this.delay);
  }

  /** Do it not. */
  drop() {
    clearTimeout(this.#timer);
  }
}

/** How long a question may be on its way before a newer one takes its place, ms: so long, or twice as
 * long as the last answer took, and twice as long again after each that was given up. A plan that stays
 * as it is takes its place sooner: after so long, or twice as long again after each that was given up. */
const PATIENCE = 250;

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
    /** The plan of the question on its way. @type {Plan | null} */
    this.asked = null;
    /** @type {AbortController | null} */
    this.flying = null;
    this.since = 0;
    this.patience = PATIENCE;
    this.resting = new Delayed(PATIENCE, () => this.#rested());
    /** Times from a question to its answer, ms. @type {number[]} */
    this.times = [];
  }

  /** Ask about a plan, and no more about those before. @param {Plan} plan */
  renew(plan) {
    this.wanted = plan;
    if (!this.flying) return void this.#go();
    this.resting.renew();
    if (performance.now() - this.since > this.patience) {
      this.patience *= 2;
      this.flying.abort();
    }
  }

  /** The plan stayed as it is while a question about another was on its way. */
  #rested() {
    if (!this.wanted || this.wanted === this.asked) return;
    this.resting.delay *= 2;
    this.flying?.abort();
  }

  /** Ask no more. */
  drop() {
    this.wanted = null;
    this.flying?.abort();
  }

  async #go() {
    while (this.wanted) {
      const plan = this.wanted;
      [this.asked, this.wanted] = [plan, null];
      this.flying = new AbortController();
      this.since = performance.now();
      try {
        const answer = await this.ask(plan, this.flying.signal);
        const time = performance.now() - this.since;
        this.times.push(time);
        this.patience = Math.max(PATIENCE, 2 * time);
        this.answered(answer, plan);
      } catch (error) {
        if (!(error instanceof Error)) throw error;
        if (error.name !== "AbortError") this.failed(error, plan);
      }
    }
    this.flying = null;
    this.resting.delay = PATIENCE;
  }
}
