// What is told of a plan: lines that say so where it is another plan than the one on the page.

import { make, textButton } from "./elements.js";
import { samePlan } from "./standing.js";
import { _ } from "./words.js";

/** @typedef {import("./plan_form.js").Plan} Plan */
/** Whether a walk is safe, too tight or touches ("unsafe"), or that is open; "none": nothing is known of it; "": it is
 * not about that.
 * @typedef {"safe" | "tight" | "unsafe" | "open" | "none" | ""} State */

/** @type {Record<State, string>} */
export const STATE_SIGNS = {
  safe: "\u2713",
  tight: "\u25b2",
  unsafe: "\u2716",
  open: "?",
  none: "!",
  "": "",
};

export class Line {
  /** @param {HTMLElement} element @param {string} [waiting] what it says before anything is told */
  constructor(element, waiting = "") {
    this.element = element;
    this.base = element.className;
    this.waiting = waiting;
    /** @type {{plan: Plan, text: string, state: State, why: string, beside: HTMLElement[]} | null} */
    this.told = null;
  }

  /**
   * What is told of a plan from now on.
   * @param {Plan} plan
   * @param {string} text
   * @param {State} [state]
   * @param {string} [why] why there is no answer, if there is none
   * @param {HTMLElement[]} [beside] what else stands there, as long as it is about the plan on the page
   */
  tell(plan, text, state = "", why = "", beside = []) {
    this.told = { plan, text, state, why, beside };
  }

  /** Tell nothing any more. */
  forget() {
    this.told = null;
  }

  /** Whether what is told is about this plan. @param {Plan} plan */
  about(plan) {
    return this.told !== null && samePlan(this.told.plan, plan);
  }

  /** Whether another line says already why there is no answer. @param {Line} other */
  repeats(other) {
    return this.told?.why === other.told?.why;
  }

  /** Show what is told, and whether it is about this plan. @param {Plan} plan */
  show(plan) {
    const { element, told } = this;
    const old = Boolean(told?.text) && !this.about(plan);
    const state = told && !old ? told.state : "";
    const said = told?.text ?? this.waiting;
    const text = old ? _("earlier plan: {text}", { text: said }) : said;
    element.toggleAttribute("data-stale", old);
    element.ariaBusy = String(old); // screen readers need not hear what is past
    element.className = `${this.base} ${state}`.trim();
    const sign = old && told?.state ? "\u2026" : STATE_SIGNS[state];
    const beside = old ? [] : (told?.beside ?? []);
    const words = [sign ? `${sign} ` : "", text, ...beside.map((one) => one.textContent)];
    if (element.textContent === words.join("")) return;
    element.replaceChildren(
      ...(sign ? [make("span", { "aria-hidden": "true" }, `${sign} `)] : []),
      text,
      ...beside,
    );
  }
}

/** What is said of a link that cannot be read. @param {string} says @param {() => void} goOn */
export function unreadWords(says, goOn) {
  const on = textButton(_("go on with the plan in the controls"), goOn);
  return [
    make("strong", {}, _("The plan in this link cannot be read.")),
    ` ${_("What the controls show is another plan. The link says:")}`,
    make("code", { tabindex: "0" }, says),
    on,
  ];
}
