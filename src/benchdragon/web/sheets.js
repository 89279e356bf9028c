// The sheets of a dance on a page of their own: asked for, seen, printed.

import { BenchSheet, fitted } from "./bench_sheet.js";
import { planName } from "./names.js";
import { choice, make, tick } from "./elements.js";
import { deliver } from "./files.js";
import { called } from "./made/people.js";
import { Numbering } from "./made/roster.js";
import { overviewSheet, overviewTable } from "./overview_sheet.js";
import { NameList } from "./name_list.js";
import { Sayings } from "./sayings.js";
import { readable, SheetMaps } from "./sheet_map.js";
import { samePlan } from "./standing.js";
import { _ } from "./words.js";

/** @typedef {import("./compute/briefing.js").Briefing} Briefing */
/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./standing.js").Answers} Answers */
/** @typedef {import("./standing.js").Aside} Aside */

// Sheets that are shown and printed at once.
const MOST_SHEETS = 250;
/** @type {Record<string, number>} */
const ON_A_PAGE = { a4: 1, quarter: 4, lanyard: 2 };
// Benches of a household on one sheet, where sheets are large and the type is not.
const MOST_BENCHES = 2;
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
    this.names = new NameList(() => this.#anew());
    this.looks = { paper: "a4", households: false, night: false, phones: false };
    /** "benches" or "overview"; which benches: the first of so many, or the one. */
    this.shown = { what: "benches", from: 1, one: false };
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
    const button = make("button", { type: "button", onclick: () => this.open(plan()) });
    button.append(_("benches' sheets"));
    return make(
      "fieldset",
      { hidden: !this.answers.has("sheets") },
      make("legend", {}, _("On paper")),
      make("div", { class: "row" }, button),
    );
  }

  /** Show the sheets of a plan. @param {Plan} plan */
  async open(plan) {
    this.close();
    this.plan = plan;
    this.opener = /** @type {HTMLElement | null} */ (document.activeElement);
    this.title = document.title;
    this.behind.inert = true;
    this.pages.replaceChildren();
    this.#build();
    document.body.append(this.section);
    this.section.focus();
    const lane = this.answers.aside();
    this.lane = lane;
    this.#tell(_("working ..."));
    try {
      const told = (/** @type {number} */ share, /** @type {string} */ text) =>
        this.#tell(`${Math.round(100 * share)} % ${text}`);
      this.briefing = await lane.ask({ question: "sheets", plan }, undefined, told);
      this.#tell("");
      document.title = `${this.#name} ${_("benches' sheets")}`;
      this.#anew();
    } catch (error) {
      if (!(error instanceof Error)) throw error;
      if (error.name !== "AbortError") this.#tell(error.message);
    } finally {
      lane.close();
    }
  }

  /** Show them no more. */
  close() {
    this.lane?.close();
    this.lane = null;
    this.briefing = null;
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

  /** @param {string} text */
  #tell(text) {
    this.told.textContent = text;
    this.section.ariaBusy = String(!this.briefing && this.lane !== null);
  }

  /** The controls, in the language in use. */
  #build() {
    const close = make("button", { type: "button", onclick: () => this.close() }, _("close"));
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
  #anew() {
    const { briefing } = this;
    if (!briefing) return;
    const { people, benches } = briefing;
    const name = (/** @type {number} */ bench) => called(people, bench, benches.length);
    this.names.read(new Numbering(benches.length, people.count_head, name));
    this.#build();
    this.show();
  }

  /** What is chosen of what is shown. @param {Briefing} briefing */
  #choices(briefing) {
    const { looks, shown } = this;
    const anew = () => this.#anew();
    /** @type {[string, string][]} */
    const whats = [["benches", _("a sheet for each bench")], ["overview", _("the leader's overview")]]; // prettier-ignore
    const what = choice(_("what is printed"), whats, shown.what, (value) => {
      shown.what = value;
      anew();
    });
    /** @type {[string, string][]} */
    const papers = [
      ["a4", _("A4, one on a page")],
      ["quarter", _("a quarter, four on a page")],
      ["lanyard", _("to hang round the neck, two on a page")],
    ];
    const paper = choice(_("size of the sheets"), papers, looks.paper, (value) => {
      looks.paper = value;
      this.show();
    });
    const households = tick(_("by household"), looks.households, (on) => {
      looks.households = on;
      this.show();
    });
    const night = tick(_("large type"), looks.night, (on) => {
      looks.night = on;
      this.show();
    });
    const phones = tick(_("print phone numbers"), looks.phones, (on) => {
      looks.phones = on;
      this.show();
    });
    const print = make("button", { type: "button", onclick: () => globalThis.print() }, _("print"));
    const save = make("button", { type: "button", onclick: () => this.#save() }, _("save as CSV"));
    const grouped = this.names.households ? [households] : [];
    const benches =
      shown.what === "benches" ? [paper, ...this.#which(briefing, anew), ...grouped, night] : [save];
    return [what, ...benches, ...(this.names.phones ? [phones] : []), print];
  }

  /** Which benches: so many after one another, or one. @param {Briefing} briefing @param {() => void} anew */
  #which({ benches }, anew) {
    const { shown } = this;
    /** @type {[string, string][]} */
    const spans = [];
    for (let from = 1; from <= benches.length; from += MOST_SHEETS) {
      const to = Math.min(from + MOST_SHEETS - 1, benches.length);
      const all = benches.length <= MOST_SHEETS;
      spans.push([String(from), all ? _("all benches") : _("rows {from} to {to}", { from, to })]);
    }
    const said = new Sayings(/** @type {Briefing} */ (this.briefing), this.names.people);
    const which = choice(
      _("which benches"),
      [...spans, ["one", _("one bench")]],
      shown.one ? "one" : String(shown.from),
      (value) => {
        shown.one = value === "one";
        shown.from = shown.one ? 1 : Number(value);
        anew();
      },
    );
    if (!shown.one) return [which];
    /** @type {[string, string][]} */
    const names = benches.map(({ bench }) => [String(bench), said.called(bench)]);
    const one = choice(_("bench"), names, String(shown.from), (value) => {
      shown.from = Number(value);
      this.show();
    });
    return [which, one];
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
        _(
          "Names stay in this page: they come neither into its address nor into a plan file, and are gone when it is closed.",
        ),
      ),
      make(
        "p",
        {},
        _(
          "The command line sets the same sheets as PDF, and besides them chalk plan, timetable and permit annex: benchdragon sheets PLAN --check",
        ),
      ),
    );
  }

  /** Set what is chosen, in the language in use. */
  show() {
    const { briefing } = this;
    if (!briefing) return;
    const { looks } = this;
    const maps = new SheetMaps(briefing, this.shown.what === "benches" ? looks.paper : "a4");
    const said = new Sayings(briefing, this.names.people);
    const date = today();
    const foot = `${briefing.sha256.slice(0, 12)} · ${date}`;
    this.pages.style.setProperty("zoom", "1");
    if (this.shown.what === "overview") {
      const sheet = overviewSheet(said, maps, looks.phones, this.names.notes, date, foot);
      this.pages.replaceChildren(maps.shared(), sheet);
      for (const map of sheet.querySelectorAll(".map")) readable(map);
    } else this.#showBenches(briefing, maps, said, foot);
    this.#zoom();
  }

  /** @param {Briefing} briefing @param {SheetMaps} maps @param {Sayings} said @param {string} foot */
  #showBenches({ benches }, maps, said, foot) {
    const { looks, shown } = this;
    const last = shown.one ? shown.from : Math.min(shown.from + MOST_SHEETS - 1, benches.length);
    const most = looks.paper === "a4" && !looks.night ? MOST_BENCHES : 1;
    const numbers = benches.slice(shown.from - 1, last).map(({ bench }) => bench);
    const sheets = said
      .sheets(numbers, looks.phones, looks.households && this.names.households ? most : 0)
      .map((sheet) => new BenchSheet(sheet, maps.tracks(sheet.entries), looks, foot));
    const each = ON_A_PAGE[looks.paper];
    const pages = [];
    for (let n = 0; n < sheets.length; n += each) {
      const there = sheets.slice(n, n + each).map(({ element }) => element);
      pages.push(make("div", { class: `paper ${looks.paper}` }, ...there));
    }
    this.pages.replaceChildren(maps.shared(), ...pages);
    fitted(sheets);
  }

  /** Show pages as large as there is room, and no larger than on paper. */
  #zoom() {
    const room = this.section.clientWidth - AROUND;
    if (this.shown.what === "benches" && room > 0)
      this.pages.style.setProperty("zoom", String(Math.min(1, room / WIDE)));
  }

  /** What files of the dance are called: browsers take it from the title for what they print. */
  get #name() {
    return this.plan ? planName(this.plan) : "";
  }

  /** Save the leader's table. */
  #save() {
    if (!this.briefing || !this.plan) return;
    const text = overviewTable(new Sayings(this.briefing, this.names.people), this.looks.phones);
    const name = `${this.#name}-${_("benches")}.csv`;
    deliver({ name, data: new Blob([text], { type: "text/csv" }) });
  }
}
