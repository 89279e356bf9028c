// Long questions: started, followed, cancelled.

import { bracketed } from "./compute/answer.js";
import { shown } from "./made/answer.js";
import { make, signButton, textButton } from "./elements.js";
import { answerText, sizeText } from "./evidence.js";
import { samePlan } from "./standing.js";
import { _, decimals } from "./words.js";

/** @typedef {import("./messages").JobState} JobState */
/** @typedef {import("./messages").TurnFound} TurnFound */
/** @typedef {JobState["question"]} Question */
/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./standing.js").Answers} Answers */
/** @typedef {import("./standing.js").LongQuestion} LongQuestion */

/** @param {Question} question */
export function questionText(question) {
  return {
    turn: _("best turn"),
    speed: _("greatest head speed"),
    pace: _("slow down only where it must"),
    margins: _("tolerance for people who are not exact"),
  }[question];
}

/** Ways inside the disc, and times, that are as good as equal, m, s. */
const EQUAL = 1e-3;

/** @param {TurnFound} found */
function turnText(found) {
  const [way, before] = [found.way ?? 0, found.way_before ?? 0];
  const lengths = {
    way: decimals(way, 3),
    before: decimals(before, 3),
    gap: shown(bracketed(found.clearance), false),
  };
  if (before - way < EQUAL)
    return _("no turn of this kind with a shorter path than {before} m was found", lengths);
  return _("path inside the disc {way} m, {before} m before; benches at least {gap} m apart", lengths);
}

/** The plan that was found, if it is any better. @param {JobState["result"]} result */
function betterPlan(result) {
  if (!result || !("plan" in result)) return null;
  const gain = "saved" in result ? (result.saved ?? 0) : (result.way_before ?? 0) - (result.way ?? 0);
  return gain < EQUAL ? null : /** @type {Plan} */ (result.plan);
}

/** What came out, in words. @param {NonNullable<JobState["result"]>} result */
function resultText(result) {
  if ("objective" in result) return turnText(result);
  if ("steady" in result)
    return _("steady {speed}; slowing down only where it must saves {saved} s", {
      speed: sizeText(result.steady, false),
      saved: decimals(result.saved ?? 0, 1),
    });
  if ("draws" in result)
    return [
      _("{chance} % of {draws} random dances touch", {
        chance: decimals(100 * result.chance, 1),
        draws: result.draws,
      }),
      ...result.pitch_for.map(({ risk, pitch }) =>
        _("at most {risk} % with a pitch of {pitch} m", {
          risk: decimals(100 * risk, 0),
          pitch: pitch === null ? "\u2013" : decimals(pitch, 3),
        }),
      ),
    ].join("; ");
  return answerText(result, false);
}

/** A long question on the page.
 * @typedef {{question: Question, plan: Plan, item: HTMLElement, of: HTMLElement, say: () => void}} Entry */

export class JobList {
  /**
   * @param {Answers} answers
   * @param {(plan: Plan) => void} take takes a plan: one that was found, or asked about
   */
  constructor(answers, take) {
    this.answers = answers;
    this.take = take;
    /** @type {Set<Entry>} */
    this.entries = new Set();
    /** The plan on the page. @type {Plan} */
    this.plan = {};
    this.element = make("ul", { class: "jobs", "aria-live": "polite" });
  }

  /** Say everything in the language in use; errors and progress stay as they came. */
  retell() {
    for (const { say } of this.entries) say();
    this.show(this.plan);
  }

  /** Say of each question whether it is about this plan. @param {Plan} plan */
  show(plan) {
    this.plan = plan;
    for (const entry of this.entries) this.#mark(entry);
  }

  /** @param {Entry} entry */
  #mark({ plan, item, of }) {
    const same = samePlan(plan, this.plan);
    const text = same ? _("about this plan") : _("about another plan");
    if (of.firstChild?.textContent === text) return;
    item.dataset.plan = same ? "this" : "other";
    const back = textButton(_("show that plan"), () => this.take(plan));
    of.replaceChildren(text, ...(same ? [] : [back]));
  }

  /** Say an entry's words, now and whenever the language changes. @param {Entry} entry @param {() => void} say */
  #say(entry, say) {
    entry.say = () => {
      say();
      entry.item.append(entry.of);
    };
    entry.say();
    this.#mark(entry);
  }

  /** @param {Question} question @param {Plan} plan @returns {Entry} */
  #entered(question, plan) {
    const of = make("span", { class: "of" });
    const entry = { question, plan, item: make("li"), of, say: () => {} };
    this.entries.add(entry);
    this.#say(entry, () => entry.item.replaceChildren(questionText(question)));
    this.element.prepend(entry.item);
    return entry;
  }

  /** Ask a long question. @param {Question} question @param {Plan} plan */
  async start(question, plan) {
    await this.#follow(this.answers.long(question, plan), this.#entered(question, plan));
  }

  /** @param {LongQuestion} long @param {Entry} entry */
  async #follow(long, entry) {
    const { item, question } = entry;
    const name = make("strong", {});
    const bar = make("progress", { max: "1" });
    const told = make("span", { class: "told" });
    const cancel = textButton("", () => long.cancel());
    this.#say(entry, () => {
      item.replaceChildren(name, bar, told, cancel);
      name.textContent = bar.ariaLabel = questionText(question);
      cancel.textContent = _("cancel");
    });
    const show = (/** @type {JobState} */ job) => {
      this.#mark(entry);
      item.dataset.state = job.state;
      bar.value = job.share;
      told.textContent = job.text;
    };
    const ended = await long.follow(show);
    this.#say(entry, () => this.#ended(ended, entry));
  }

  /** @param {JobState} job @param {Entry} entry */
  #ended(job, entry) {
    const text = job.result
      ? resultText(job.result)
      : job.state === "cancelled"
        ? _("cancelled")
        : (job.error ?? "");
    const found = betterPlan(job.result);
    const take = found && textButton(_("take this plan"), () => this.take(found));
    this.#over(entry, text, take ? [take] : []);
  }

  /** Show an entry in which nothing more happens. @param {Entry} entry @param {string} text @param {HTMLElement[]} more */
  #over(entry, text, more) {
    const { item, question } = entry;
    item.replaceChildren(
      make("strong", {}, questionText(question)),
      make("span", { class: "told" }, text),
      ...more,
      signButton("\u2715", _("clear away"), () => this.#forget(entry)),
    );
  }

  /** @param {Entry} entry */
  #forget(entry) {
    this.entries.delete(entry);
    entry.item.remove();
  }
}
