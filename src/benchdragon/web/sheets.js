// The papers of a dance on a page of their own: asked for, seen, printed.

import { annexSheet } from "./annex_sheet.js";
import { benchSheets } from "./bench_sheet.js";
import { chalkSheet, chalkTable } from "./chalk_sheet.js";
import { InputError } from "./compute/errors.js";
import { planName } from "./names.js";
import { choice, make, textButton, tick } from "./elements.js";
import { deliver } from "./files.js";
import { sha256 } from "./compute/sha256.js";
import { called } from "./made/people.js";
import { Numbering } from "./made/roster.js";
import { drumFile } from "./drum_file.js";
import { overviewSheet, overviewTable } from "./overview_sheet.js";
import { NameList } from "./name_list.js";
import { planText } from "./plan_form.js";
import { Sayings } from "./sayings.js";
import { Refusal, samePlan } from "./standing.js";
import { timetableSheet, timetableTable } from "./timetable_sheet.js";
import { N_, _ } from "./words.js";

/** @typedef {import("./compute/briefing.js").Briefing} Briefing */
/** @typedef {import("./messages").WantedPapers} WantedPapers */
/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./standing.js").Answers} Answers */
/** @typedef {import("./standing.js").Aside} Aside */

/**
 * How papers are wanted.
 * @typedef {object} Looks
 * @property {string} paper "a4", "quarter" or "lanyard": the size of benches' sheets
 * @property {boolean} households whether benches of a household share a sheet
 * @property {boolean} night whether the type is large
 * @property {boolean} phones whether phone numbers are printed
 * @property {number} bench whose sheet is wanted alone; 0: all
 * @property {string} date the day, as 2026-02-17
 * @property {string} foot what stands at the foot of each page
 */

/** What a paper came to: its elements, and what is done once they stand in the page, which tells what share of it is done.
 * @typedef {{ pages: Element[], settle?: (told: (share: number) => void) => Promise<void> }} Built */

/** A file that a paper is saved as: what its button says, what is added to the dance's name, and what is in it.
 * @typedef {{ label: string, name: string, data: (briefing: Briefing, names: NameList, looks: Looks) => Blob }} Saved */

/**
 * A paper.
 * @typedef {object} Paper
 * @property {string} name by which it is asked for
 * @property {string} label what it is called
 * @property {boolean} [people] whether it names people, with phones where they are wanted
 * @property {string} [question] what a Worker is asked besides about the plan
 * @property {(briefing: Briefing, names: NameList, looks: Looks, facts: any) => Built} build what makes it, with the answer
 * @property {Saved[]} [saved] files that it is saved as
 */

/** What is printed of a dance. A new paper is a row. @type {Paper[]} */
// prettier-ignore
const PAPERS = [
  { name: "benches", label: N_("a sheet for each bench"), people: true, build: benchSheets },
  { name: "overview", label: N_("the leader's overview"), people: true, build: overviewSheet,
    saved: [{ label: N_("save as CSV"), name: N_("benches"), data: overviewTable }] },
  { name: "timetable", label: N_("timetable and drum"), build: timetableSheet,
    saved: [{ label: N_("save the timetable as CSV"), name: N_("timetable"), data: timetableTable },
      { label: N_("save the drum"), name: N_("drum"), data: drumFile }] },
  { name: "chalk", label: N_("chalk plan"), build: chalkSheet,
    saved: [{ label: N_("save ticks as CSV"), name: N_("chalk plan"), data: chalkTable }] },
  { name: "annex", label: N_("the permit annex"), question: "annex", build: annexSheet },
];
// Width of a page, in pixels of 96 to an inch, and of what is around it.
const [WIDE, AROUND] = [(210 / 25.4) * 96, 20];

/** The day, as 2026-02-17. */
function today() {
  const now = new Date();
  const parts = [now.getFullYear(), now.getMonth() + 1, now.getDate()];
  return parts.map((part) => String(part).padStart(2, "0")).join("-");
}

export class Sheets {
  /** @param {HTMLElement} behind what the sheets stand before @param {Answers} answers */
  constructor(behind, answers) {
    this.behind = behind;
    this.answers = answers;
    /** Whose sheets are open. @type {Plan | null} */
    this.plan = null;
    /** @type {Aside | null} */
    this.lane = null;
    /** @type {Briefing | null} */
    this.briefing = null;
    /** What papers tell besides, by the questions that were asked for it. @type {Map<string, any>} */
    this.facts = new Map();
    this.names = new NameList(() => this.#anew());
    this.looks = { paper: "a4", households: false, night: false, phones: false, bench: 0 };
    /** The names of papers that are shown; none: all. */
    this.chosen = ["benches"];
    /** Which showing of papers is the last: another one that is under way ends. */
    this.showing = 0;
    /** How it stands: papers that are still being made are not printed. @type {{ busy: boolean, share: number, text: string } | null} */
    this.state = null;
    this.section = make("section", { id: "sheets", class: "sheets", tabindex: "-1" });
    this.section.addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.close();
    });
    /** What the page is called else. */
    this.title = "";
    this.told = make("output", { class: "told" });
    this.pages = make("div", { class: "pages" });
    addEventListener("resize", () => this.#zoom());
  }

  /** The button that opens the sheets. @param {() => Plan} plan that on the page */
  control(plan) {
    const button = textButton(_("benches' sheets"), () => this.open(plan()));
    return make(
      "fieldset",
      { hidden: !this.answers.has("sheets") },
      make("legend", {}, _("On paper")),
      make("div", { class: "row" }, button),
    );
  }

  /** Show the papers of a plan, as somebody wants them; else as they were chosen last. @param {Plan} plan @param {WantedPapers | null} [wanted] */
  async open(plan, wanted = null) {
    this.close();
    this.plan = plan;
    if (wanted) this.#want(wanted);
    this.opener = /** @type {HTMLElement | null} */ (document.activeElement);
    this.title = document.title;
    this.behind.inert = true;
    this.pages.replaceChildren();
    this.#build();
    document.body.append(this.section);
    this.section.focus();
    await this.#tried(async () => {
      this.briefing = await this.#answer("sheets", plan);
      await this.#anew();
    });
  }

  /** Do what somebody may give up, and a Worker refuse: then say why. @param {() => Promise<void>} work */
  async #tried(work) {
    try {
      await work();
    } catch (error) {
      if (error instanceof Refusal) this.#tell(error.message);
      else if (!(error instanceof DOMException)) throw error;
    }
  }

  /** What a Worker of its own answers about the plan, which says how far it is. @param {string} question @param {Plan} plan */
  async #answer(question, plan) {
    const lane = this.answers.aside();
    this.lane = lane;
    this.#tell(_("working ..."), 0);
    const told = (/** @type {number} */ share, /** @type {string} */ text) => this.#tell(text, share);
    try {
      return await lane.ask({ question, plan }, undefined, told);
    } finally {
      lane.close();
    }
  }

  /** Show them no more. */
  close() {
    this.lane?.close();
    this.lane = null;
    this.briefing = null;
    this.facts.clear();
    this.showing++;
    if (!this.plan) return;
    this.plan = null;
    this.section.remove();
    document.title = this.title;
    this.behind.inert = false;
    this.opener?.focus();
  }

  /** The page is about this plan: sheets of another close. @param {object} plan */
  about(plan) {
    if (this.plan && !samePlan(this.plan, plan)) this.close();
  }

  /** @param {WantedPapers} wanted */
  #want({ only, names, ...looks }) {
    this.chosen = only;
    Object.assign(this.looks, looks);
    this.names.list = names;
  }

  /** Say what is being done, and how far it is; without a share that it is over. @param {string} text @param {number | null} [share] */
  #tell(text, share = null) {
    this.state = { busy: share !== null, share: share ?? 1, text };
    this.told.textContent = share === null ? text : `${Math.round(100 * share)} % ${text}`;
    this.section.ariaBusy = String(share !== null);
  }

  /** The controls, in the language in use. */
  #build() {
    const close = textButton(_("close"), () => this.close());
    const { briefing } = this;
    const header = make(
      "header",
      {},
      make("h1", {}, _("benches' sheets")),
      make("div", { class: "row" }, ...(briefing ? this.#choices(briefing) : []), close),
      this.told,
      ...(briefing ? [this.names.controls()] : []),
      this.#help(),
    );
    this.section.ariaLabel = _("benches' sheets");
    const focused = this.section.contains(document.activeElement) ? document.activeElement : null;
    const early = _("The sheets are not ready yet: print them once they are shown.");
    this.section.replaceChildren(header, make("p", { class: "early" }, early), this.pages);
    if (focused) this.#refocus(focused);
  }

  /** Focus the control that took the place of one. @param {Element} focused */
  #refocus(focused) {
    const name = focused.getAttribute("aria-label") ?? focused.textContent;
    const controls = /** @type {NodeListOf<HTMLElement>} */ (
      this.section.querySelectorAll("button, select, textarea, summary")
    );
    const like = [...controls].find((one) => (one.ariaLabel ?? one.textContent) === name);
    (like ?? this.section).focus();
  }

  /** Read the names again, and show all of it. */
  async #anew() {
    const { briefing } = this;
    if (!briefing) return;
    const { people, benches } = briefing;
    const name = (/** @type {number} */ bench) => called(people, bench, benches.length);
    this.names.read(new Numbering(benches.length, people.count_head, name));
    this.#build();
    await this.show();
  }

  /** The papers that are shown. */
  get papers() {
    return PAPERS.filter(({ name }) => !this.chosen.length || this.chosen.includes(name));
  }

  /** What they are called. */
  get label() {
    return this.chosen.length
      ? this.papers.map(({ label }) => _(label)).join(_(", "))
      : _("all papers");
  }

  /** What is chosen of what is shown. @param {Briefing} briefing */
  #choices(briefing) {
    const { looks } = this;
    const what = choice(_("what is printed"), this.#whats(), this.chosen.join(), (value) => {
      this.chosen = value ? value.split(",") : [];
      this.#anew();
    });
    /** @type {[string, string][]} */
    const papers = [
      ["a4", _("A4, one on a page")],
      ["quarter", _("a quarter, four on a page")],
      ["lanyard", _("to hang round the neck, two on a page")],
    ];
    const paper = choice(_("size of the sheets"), papers, looks.paper, (chosen) =>
      this.#look({ paper: chosen }),
    );
    const households = tick(_("by household"), looks.households, (on) =>
      this.#look({ households: on }),
    );
    const night = tick(_("large type"), looks.night, (on) => this.#look({ night: on }));
    const phones = tick(_("print phone numbers"), looks.phones, (on) => this.#look({ phones: on }));
    const print = textButton(_("print"), () => globalThis.print());
    const saves = this.papers.flatMap(({ saved = [] }) => saved).map((one) => this.#saving(one));
    const grouped = this.names.households ? [households] : [];
    const benches = this.papers.some(({ name }) => name === "benches");
    const people = this.papers.some((one) => one.people);
    return [
      what,
      ...(benches ? [paper, this.#which(briefing), ...grouped, night] : []),
      ...saves,
      ...(people && this.names.phones ? [phones] : []),
      print,
    ];
  }

  /** What may be printed: all papers, each alone, and those that are asked for now. @returns {[string, string][]} */
  #whats() {
    const { chosen } = this;
    /** @type {[string, string][]} */
    const whats = [["", _("all papers")]];
    for (const { name, label } of PAPERS) whats.push([name, _(label)]);
    if (chosen.length > 1) whats.push([chosen.join(), this.label]);
    return whats;
  }

  /** Which benches: all, or one. @param {Briefing} briefing */
  #which(briefing) {
    const said = new Sayings(briefing, this.names.people);
    /** @type {[string, string][]} */
    const all = [["0", _("all benches")]];
    for (const { bench } of briefing.benches) all.push([String(bench), said.called(bench)]);
    return choice(_("which benches"), all, String(this.looks.bench), (value) =>
      this.#look({ bench: Number(value) }),
    );
  }

  /** Have papers look otherwise. @param {Partial<Sheets["looks"]>} looks */
  #look(looks) {
    Object.assign(this.looks, looks);
    this.show();
  }

  /** What these sheets lack. */
  #help() {
    return make(
      "details",
      {},
      make("summary", {}, _("About these sheets")),
      make(
        "p",
        {},
        this.names.held
          ? _("The list of names is in this file: who is sent the file is sent the names.")
          : _(
              "Names stay in this page: they come neither into its address nor into a plan file or a dance that is sent, and are gone when it is closed, unless this browser is to keep them.",
            ),
      ),
      make(
        "p",
        {},
        _(
          "The command line writes these papers as one page and as PDF files: benchdragon sheets PLAN --pdf DIR",
        ),
      ),
    );
  }

  /** How papers are wanted now: at the foot of each stands what names the dance, and what names all else that papers say. @param {Briefing} briefing @param {Plan} plan @returns {Looks} */
  #looks({ sha256: dance }, plan) {
    const date = today();
    const rest = sha256(planText(plan) + JSON.stringify([...this.names.people]));
    return { ...this.looks, date, foot: `${dance.slice(0, 12)}-${rest.slice(0, 4)} · ${date}` };
  }

  /** Set what is chosen, in the language in use. */
  show() {
    this.lane?.close();
    return this.#tried(() => this.#show(++this.showing));
  }

  /** @param {number} turn */
  async #show(turn) {
    const { briefing, facts, names, plan } = this;
    if (!briefing || !plan) return;
    for (const { question } of this.papers)
      if (question && !facts.has(question)) {
        this.pages.replaceChildren();
        const answer = await this.#answer(question, plan);
        if (turn !== this.showing) return;
        facts.set(question, answer);
      }
    const looks = this.#looks(briefing, plan);
    const built = this.papers.map((paper) => {
      const { pages, settle } = paper.build(briefing, names, looks, facts.get(paper.question ?? ""));
      return { paper, element: standing(paper, pages), settle };
    });
    this.pages.style.setProperty("--zoom", "1");
    this.pages.replaceChildren(...built.map(({ element }) => element));
    for (const [n, { paper, settle }] of built.entries()) {
      const told = (/** @type {number} */ share) => {
        if (turn === this.showing) this.#tell(_(paper.label), (n + share) / built.length);
      };
      told(0);
      await settle?.(told);
      if (turn !== this.showing) return;
    }
    document.title = `${this.#name} ${this.label}`;
    this.#tell("");
    this.#zoom();
  }

  /** Show pages as large as there is room, and no larger than on paper. */
  #zoom() {
    const room = this.section.clientWidth - AROUND;
    if (room > 0) this.pages.style.setProperty("--zoom", String(Math.min(1, room / WIDE)));
  }

  /** What files of the dance are called: browsers take it from the title for what they print. */
  get #name() {
    return this.plan ? planName(this.plan) : "";
  }

  /** The button that saves a file, or says why there is none. @param {Saved} saved */
  #saving({ label, name, data }) {
    const save = () => {
      const { briefing, names, plan } = this;
      if (!briefing || !plan) return;
      try {
        const made = data(briefing, names, this.#looks(briefing, plan));
        const ending = made.type.split("/")[1];
        deliver({ name: `${this.#name}-${_(name)}.${ending}`, data: made });
      } catch (error) {
        if (!(error instanceof InputError)) throw error;
        this.#tell(error.message);
      }
    };
    return textButton(_(label), save);
  }
}

/** A paper as it stands in the page. @param {Paper} paper @param {Element[]} pages */
function standing({ name, label }, pages) {
  return make("section", { class: "kind", "data-paper": name, "aria-label": _(label) }, ...pages);
}
