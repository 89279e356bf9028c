// Questions to the studio's server, and what it refuses.

import { _, language } from "./words.js";

/** This page, to the server: its newer questions replace its older ones. */
const CLIENT = crypto.randomUUID();

/** The server said no, or nothing (status 0); `message` is the sentence for it. */
export class Refusal extends Error {
  /** @param {number} status @param {string} message */
  constructor(status, message) {
    super(message);
    this.status = status;
  }
}

/**
 * Ask, and get the response.
 * @param {string} path
 * @param {object | null} body null: nothing is sent
 * @param {{method?: string, signal?: AbortSignal}} [options]
 * @throws {Refusal}
 */
export async function asked(path, body, { method = body ? "POST" : "GET", signal } = {}) {
  const headers = { "Content-Type": "application/json", "X-Client": CLIENT };
  const sent = body === null ? null : JSON.stringify(body);
  const response = await fetch(`${path}?lang=${language()}`, {
    method,
    headers,
    body: sent,
    signal: signal ?? null,
  }).catch((error) => {
    if (error.name === "AbortError") throw error;
    throw new Refusal(0, _("The studio does not answer: {error}", { error: error.message }));
  });
  if (response.ok) return response;
  const problem = await response.json().catch(() => ({}));
  throw new Refusal(response.status, problem.error ?? `${response.status} ${response.statusText}`);
}

/** How long a question may be on its way before a newer one takes its place, ms: so long, or twice as
 * long as the last answer took, and twice as long again after each that was given up. */
const PATIENCE = 250;
/** The status that says: a newer question is on its way. */
const REPLACED = 409;

/**
 * One question that is asked again and again as the plan changes: the newest is always answered, and
 * those that nobody waits for any more are given up.
 * @template Answer
 */
export class Standing {
  /**
   * @param {(signal: AbortSignal) => Promise<Answer>} ask
   * @param {(answer: Answer) => void} answered
   * @param {(error: Error) => void} failed
   */
  constructor(ask, answered, failed) {
    this.ask = ask;
    this.answered = answered;
    this.failed = failed;
    /** @type {AbortController | null} */
    this.flying = null;
    this.since = 0;
    this.stale = false;
    this.patience = PATIENCE;
    /** Times from a question to its answer, ms. @type {number[]} */
    this.times = [];
  }

  /** The plan has changed. */
  renew() {
    this.stale = true;
    if (!this.flying) this.#go();
    else if (performance.now() - this.since > this.patience) {
      this.patience *= 2;
      this.flying.abort();
    }
  }

  async #go() {
    while (this.stale) {
      this.stale = false;
      this.flying = new AbortController();
      this.since = performance.now();
      try {
        const answer = await this.ask(this.flying.signal);
        const time = performance.now() - this.since;
        this.times.push(time);
        this.patience = Math.max(PATIENCE, 2 * time);
        this.answered(answer);
      } catch (error) {
        if (!(error instanceof Error)) throw error;
        const replaced =
          error.name === "AbortError" || (error instanceof Refusal && error.status === REPLACED);
        if (!replaced) this.failed(error);
      }
    }
    this.flying = null;
  }
}
