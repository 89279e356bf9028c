// Long questions: started, followed, cancelled.

import { asked, Refusal } from "./asking.js";
import { make } from "./elements.js";
import { answerText, valueText } from "./evidence.js";
import { _, decimals } from "./words.js";

/** @typedef {import("./wire").JobState} JobState */
/** @typedef {import("./wire").TurnFound} TurnFound */
/** @typedef {JobState["question"]} Question */
/** @typedef {import("./plan_form.js").Plan} Plan */

/** How often a running question is looked at, ms. */
const LOOK_EACH = 400;

/** @param {Question} question */
export function questionText(question) {
  return {
    turn: _("best turn"),
    prove: _("prove the verdict"),
    speed: _("greatest head speed"),
    pace: _("slow down only where it must"),
    margins: _("room for people who are not exact"),
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
    gap: decimals(100 * (found.clearance.lower ?? 0), 1),
  };
  if (before - way < EQUAL)
    return _("no turn of this kind with a shorter way than {before} m was found", lengths);
  return _("way inside the disc {way} m, {before} m before; benches at least {gap} cm apart", lengths);
}

/** The plan that was found, if it is any better. @param {JobState["result"]} result */
function betterPlan(result) {
  if (!result || !("plan" in result)) return null;
  const gain = "saved" in result ? (result.saved ?? 0) : (result.way_before ?? 0) - (result.way ?? 0);
  return gain < EQUAL ? null : /** @type {Plan} */ (result.plan);
}

/** What came out, in words. @param {NonNullable<JobState["result"]>} result */
function resultText(result) {
  if ("sentence" in result)
    return result.proved ? _("Proved. {sentence}", { sentence: result.sentence }) : result.sentence;
  if ("objective" in result) return turnText(result);
  if ("steady" in result)
    return _("steady {speed}; slowing down only where it must saves {saved} s", {
      speed: valueText(result.steady),
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
  return answerText(result);
}

/** Statuses after which it is asked again: no answer, too many questions, a server that is closing. */
const AGAIN = [0, 429, 503];

/**
 * How a long question stands; asked until the server answers.
 * @param {string} id
 * @param {(error: Error) => void} told of each time it does not
 * @returns {Promise<JobState>}
 * @throws {Refusal} where it knows of no such question any more
 */
async function jobState(id, told) {
  for (;;) {
    try {
      return await (await asked(`/api/jobs/${id}`, null)).json();
    } catch (error) {
      if (!(error instanceof Refusal) || !AGAIN.includes(error.status)) throw error;
      told(error);
    }
    await new Promise((done) => setTimeout(done, 5 * LOOK_EACH));
  }
}

export class JobList {
  /** @param {(plan: Plan) => void} take takes the plan that a long question found */
  constructor(take) {
    this.take = take;
    /** What says an item's own words again. @type {Map<HTMLElement, () => void>} */
    this.words = new Map();
    this.element = make("ul", { class: "jobs", "aria-live": "polite" });
  }

  /** Say everything in the language in use; sentences of the server stay as they came. */
  retell() {
    for (const say of this.words.values()) say();
  }

  /** Say an item's words, now and whenever the language changes. @param {HTMLElement} item @param {() => void} say */
  #say(item, say) {
    this.words.set(item, say);
    say();
  }

  /** Ask a long question. @param {Question} question @param {Plan} plan */
  async start(question, plan) {
    const item = make("li", {}, questionText(question));
    this.element.prepend(item);
    try {
      const { id } = await (await asked("/api/jobs", { plan, question })).json();
      await this.#follow(id, question, item);
    } catch (error) {
      if (!(error instanceof Error)) throw error;
      const name = make("strong", {});
      const told = make("span", { class: "told" }, error.message);
      this.#say(item, () => {
        name.textContent = questionText(question);
        item.replaceChildren(name, told, this.#away(item));
      });
    }
  }

  /** @param {string} id @param {Question} question @param {HTMLElement} item */
  async #follow(id, question, item) {
    const name = make("strong", {});
    const bar = make("progress", { max: "1" });
    const told = make("span", { class: "told" });
    // Where the server does not hear it, the next look says so.
    const stop = () => asked(`/api/jobs/${id}`, null, { method: "DELETE" }).catch(() => null);
    const cancel = make("button", { type: "button", onclick: stop });
    item.replaceChildren(name, bar, told, cancel);
    this.#say(item, () => {
      name.textContent = bar.ariaLabel = questionText(question);
      cancel.textContent = _("cancel");
    });
    for (;;) {
      const job = await jobState(id, (error) => {
        told.textContent = error.message;
      });
      item.dataset.state = job.state;
      bar.value = job.share;
      told.textContent = job.state === "waiting" ? _("waiting") : job.text;
      if (!["waiting", "running"].includes(job.state))
        return this.#say(item, () => this.#ended(job, question, item));
      await new Promise((done) => setTimeout(done, LOOK_EACH));
    }
  }

  /** @param {JobState} job @param {Question} question @param {HTMLElement} item */
  #ended(job, question, item) {
    const name = make("strong", {}, questionText(question));
    const text = job.result
      ? resultText(job.result)
      : job.state === "cancelled"
        ? _("cancelled")
        : (job.error ?? "");
    item.replaceChildren(name, make("span", { class: "told" }, text));
    const found = betterPlan(job.result);
    if (found)
      item.append(
        make("button", { type: "button", onclick: () => this.take(found) }, _("take this plan")),
      );
    item.append(this.#away(item));
  }

  /** @param {HTMLElement} item */
  #away(item) {
    return make(
      "button",
      {
        type: "button",
        "aria-label": _("clear away"),
        title: _("clear away"),
        onclick: () => {
          this.words.delete(item);
          item.remove();
        },
      },
      "\u2715",
    );
  }
}
