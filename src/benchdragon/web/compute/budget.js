// How much work and memory one question may take: twin of budget.py, whose limits hold here, too. A Worker
// answers one question at a time, so that one budget at a time is kept.

import { N_, _ } from "../words.js";
import { ANALYSIS_CONTACT_SEARCH, BUDGET } from "./constants.js";
import { BenchDragonError } from "./errors.js";
import { general } from "./number_format.js";

/** What a question may take, `one` that shares with no other, and what it has taken. @typedef {{ work: number, one: number, memory: number, spent: number }} Budget */

const { WORK, MEMORY } = BUDGET;
const { REFINING, REFINING_ON } = ANALYSIS_CONTACT_SEARCH;
const VARIABLE = "BENCHDRAGON_BUDGET";

/** A question that takes more work or memory than it may: not wrong, but not answered. */
export class OverBudgetError extends BenchDragonError {}

/** That of the question at hand. @type {Budget | null} */
let asked = null;

/**
 * What `ask` answers to a question, or to `count` of them that share; within another question it is a part
 * of that one.
 * @template T
 * @param {() => Promise<T>} ask
 * @param {number} [count]
 * @param {{ work?: number, memory?: number }} [most] what a question may take
 * @returns {Promise<T>}
 */
export async function question(ask, count = 1, { work = WORK, memory = MEMORY } = {}) {
  if (asked) return ask();
  asked = { work: work * count, one: work, memory, spent: 0 };
  try {
    return await ask();
  } finally {
    asked = null;
  }
}

/**
 * Refine a bracket to the tolerance of number n with a share of a question's work, counted apart, until
 * `ended` is called of what it gives: what takes an error, and lets none pass but that it is too dear.
 * @param {number} n
 */
export function refined(n) {
  const whole = asked;
  if (whole) asked = { ...whole, work: (n ? REFINING_ON : REFINING) * whole.one, spent: 0 };
  const caught = (/** @type {unknown} */ error) => {
    if (!(error instanceof OverBudgetError)) throw error;
  };
  return Object.assign(caught, { ended: () => void (asked = whole) });
}

/** How many handles may be placed for what an answer can do without. @param {number} share */
export function asideMost(share) {
  return asked ? share * asked.one : Infinity;
}

/** Let the question at hand take so large a share of a question's work from now on, if not more. @param {number} share */
export function allow(share) {
  if (asked) asked.work = Math.max(asked.work, asked.spent + share * asked.one);
}

/** Count handles that were placed; nothing is counted outside of questions. @param {number} handles */
export function spend(handles) {
  if (!asked) return;
  asked.spent += handles;
  expect(0);
}

/** How many handles the question at hand may still place. */
export function left() {
  return asked ? Math.max(asked.work - asked.spent, 0) : Infinity;
}

/** Say how many handles must at least be placed, before that is begun. @param {number} handles */
export function expect(handles) {
  if (!asked || asked.spent + handles <= asked.work) return;
  const text = N_(
    "this takes more work than a question may: at least {asked} million positions of handles, where {most} million are allowed; take fewer benches or a shorter walk (walk.start, walk.end), or allow {times} times as much on the command line by {variable}={times}",
  );
  throw over(text, asked.spent + handles, asked.work, WORK);
}

/** How many bytes the tables of the question at hand may take. */
export function memory() {
  return asked ? asked.memory : Infinity;
}

/** Say how many bytes the tables of the question at hand are to take, before they are made. @param {number} size */
export function hold(size) {
  if (!asked || size <= asked.memory) return;
  const text = N_(
    "this takes more memory than a question may: at least {asked} MB, where {most} MB are allowed; take fewer benches, fewer sizes of benches or a shorter walk (walk.start, walk.end), or allow {times} times as much on the command line by {variable}={times}",
  );
  throw over(text, size, asked.memory, MEMORY);
}

/** What to say of more than is allowed, and which power of ten times `usual` would allow it. @param {string} text @param {number} asked @param {number} most @param {number} usual */
function over(text, asked, most, usual) {
  const times = general(10 ** Math.max(Math.ceil(Math.log10((1.01 * asked) / usual)), 1));
  const amounts = { asked: general(asked / 1e6, 4), most: general(most / 1e6, 4) };
  return new OverBudgetError(_(text, { ...amounts, variable: VARIABLE, times }));
}
