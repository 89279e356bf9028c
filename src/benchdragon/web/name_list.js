// The list of names on the page of sheets: opened or pasted, kept in this page alone.

import { readRoster } from "./compute/roster.js";
import { textOf } from "./compute/roster_grid.js";
import { make } from "./elements.js";
import { _ } from "./words.js";

/** @typedef {import("./bench_sheet.js").People} People */
/** @typedef {import("./compute/roster.js").Numbering} Numbering */

export class NameList {
  /** @param {() => void} changed what is done when there are other names */
  constructor(changed) {
    this.changed = changed;
    /** What was opened or pasted; its name, if it is a file. @type {{ text: string, name: string } | null} */
    this.list = null;
    /** Why a list was not read. */
    this.refusal = "";
    /** @type {People} */
    this.people = new Map();
    /** What is odd about the list. @type {string[]} */
    this.notes = [];
    this.open = false;
  }

  /** Whether the list has phones. */
  get phones() {
    return [...this.people.values()].flat().some(({ phone }) => phone);
  }

  /** Read the list for a dragon, in the language in use. @param {Numbering} numbering */
  read(numbering) {
    [this.people, this.notes] = [new Map(), []];
    if (!this.list) return;
    this.refusal = "";
    this.#tried(({ text, name }) => {
      const { benches, notes } = readRoster(text, name || _("the list"), numbering);
      [this.people, this.notes] = [benches, notes];
    }, this.list);
  }

  /** Read from a list, or say why not. @template List @param {(list: List) => void} read @param {List} list */
  #tried(read, list) {
    try {
      read(list);
    } catch (error) {
      if (!(error instanceof Error)) throw error;
      this.refusal = error.message;
    }
  }

  /** Take another list. @param {{ text: string, name: string } | null} list */
  #take(list) {
    this.list = list;
    this.refusal = "";
    this.changed();
  }

  /** @param {File} file */
  async #file(file) {
    const data = await file.arrayBuffer();
    this.list = null;
    this.refusal = "";
    this.#tried(({ name }) => {
      this.list = { text: textOf(data, name), name };
    }, file);
    this.changed();
  }

  /** The controls, in the language in use. */
  controls() {
    const input = make("input", { type: "file", accept: ".csv,.tsv,.txt,.xlsx,.ods", hidden: true });
    input.addEventListener("change", () => {
      const file = input.files?.[0];
      input.value = "";
      if (file) this.#file(file);
    });
    const area = make("textarea", { "aria-label": _("list of names"), spellcheck: "false" });
    area.placeholder = _(
      "bench, name, household, phone, remarks: paste the rows of a spreadsheet here",
    );
    area.value = this.list && !this.list.name ? this.list.text : "";
    const button = (/** @type {string} */ text, /** @type {() => void} */ action) =>
      make("button", { type: "button", onclick: action }, text);
    const summary = this.list
      ? _("list of names: {count} benches have people", { count: this.people.size })
      : _("list of names: none yet");
    const details = make(
      "details",
      { class: "names", open: this.open, ontoggle: () => (this.open = details.open) },
      make("summary", {}, summary),
      area,
      make(
        "div",
        { class: "row" },
        button(_("take the rows above"), () => this.#take({ text: area.value, name: "" })),
        button(_("open a list (CSV)"), () => input.click()),
        button(_("no names"), () => this.#take(null)),
        input,
      ),
      ...(this.refusal ? [make("p", { class: "odd", role: "alert" }, this.refusal)] : []),
      ...(this.notes.length
        ? [make("ul", { class: "odd" }, ...this.notes.map((note) => make("li", {}, note)))]
        : []),
    );
    return details;
  }
}
