// The list of names on the page of sheets: opened or pasted, kept in this page alone, and in this browser if that is asked for.

import { keep, kept } from "./address.js";
import { sheetsOf } from "./compute/roster_book.js";
import { rowsOf } from "./compute/roster_grid.js";
import { choice, fileInput, make, textButton } from "./elements.js";
import { keeper } from "./files.js";
import { rosterOf } from "./made/roster.js";
import { _ } from "./words.js";

/** @typedef {import("./sayings.js").People} People */
/** @typedef {import("./made/roster.js").Numbering} Numbering */
/** @typedef {import("./compute/roster_book.js").Sheet} Sheet */

/** What was pasted, a sheet of a file of some name, or what this page was made with. @typedef {{ text: string } | { name: string, sheet: Sheet } | import("./messages").NamesHeld} List */

export class NameList {
  /** @param {() => void} changed what is done when there are other names */
  constructor(changed) {
    this.told = changed;
    /** @type {List | null} */
    this.list = JSON.parse(kept("names") ?? "null");
    /** Sheets of the file, of which one is to be chosen. @type {Sheet[]} */
    this.sheets = [];
    /** Why a list was not read. */
    this.refusal = "";
    /** The name of the file. */
    this.file = "";
    /** @type {People} */
    this.people = new Map();
    /** What is odd about the list. @type {string[]} */
    this.notes = [];
    this.open = false;
  }

  /** Whether the page was made with the list. */
  get held() {
    return this.list !== null && "people" in this.list;
  }

  /** Whether the list has phones. */
  get phones() {
    return [...this.people.values()].flat().some(({ phone, home_phone }) => phone || home_phone);
  }

  /** Whether the list tells households. */
  get households() {
    return [...this.people.values()].flat().some(({ household }) => household);
  }

  /** There is another list, or none. */
  changed() {
    if (kept("names") !== null) keep("names", JSON.stringify(this.list));
    this.told();
  }

  /** Read the list for a dragon, in the language in use. @param {Numbering} numbering */
  read(numbering) {
    [this.people, this.notes] = [new Map(), []];
    if (!this.list) return;
    this.refusal = "";
    this.#tried((list) => {
      if ("people" in list) {
        [this.people, this.notes] = [new Map(list.people), list.notes];
        return;
      }
      const name = "name" in list ? list.name : _("the list");
      const rows = "text" in list ? rowsOf(list.text, name) : list.sheet.rows;
      const { benches, notes } = rosterOf(rows, name, numbering);
      [this.people, this.notes] = [benches, notes];
    }, this.list);
  }

  /** Read from something, or say why not. @template Read @param {(from: Read) => void} read @param {Read} from */
  #tried(read, from) {
    try {
      read(from);
    } catch (error) {
      if (!(error instanceof Error)) throw error;
      this.refusal = error.message;
    }
  }

  /** Take another list, which is of no file. @param {List | null} list */
  #take(list) {
    this.list = list;
    this.sheets = [];
    this.refusal = "";
    this.changed();
  }

  /** @param {File} file */
  async #file(file) {
    const data = await file.arrayBuffer();
    this.list = null;
    this.sheets = [];
    this.refusal = "";
    this.#tried(({ name }) => {
      const sheets = sheetsOf(data, name);
      if (sheets.length === 1) this.list = { name, sheet: sheets[0] };
      else this.sheets = sheets;
      this.file = name;
    }, file);
    this.changed();
  }

  /** What chooses a sheet, where a file has several. */
  #choice() {
    const { list, sheets } = this;
    const chosen = list && "sheet" in list ? sheets.indexOf(list.sheet) : -1;
    /** @type {[string, string][]} */
    const names = sheets.map(({ name }, n) => [String(n), name]);
    const none = _("{file} has several sheets: choose one", { file: this.file });
    return choice(_("sheet"), [["-1", none], ...names], String(chosen), (value) => {
      const sheet = sheets[Number(value)];
      this.list = sheet ? { name: this.file, sheet } : null;
      this.refusal = "";
      this.changed();
    });
  }

  /** The controls, in the language in use. */
  controls() {
    const input = fileInput((file) => this.#file(file));
    const area = make("textarea", { "aria-label": _("list of names"), spellcheck: "false" });
    area.placeholder = _(
      "bench, name, household, phone, remarks: paste the rows of a spreadsheet here",
    );
    area.value = this.list && "text" in this.list ? this.list.text : "";
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
        textButton(_("take the rows above"), () => this.#take({ text: area.value })),
        textButton(_("open a list (XLSX, CSV)"), () => input.click()),
        textButton(_("no names"), () => this.#take(null)),
        input,
      ),
      keeper(_("keep the names in this browser"), "names", () => JSON.stringify(this.list)),
      ...(this.sheets.length ? [make("div", { class: "row" }, this.#choice())] : []),
      ...(this.refusal ? [make("p", { class: "odd", role: "alert" }, this.refusal)] : []),
      ...(this.notes.length
        ? [make("ul", { class: "odd" }, ...this.notes.map((note) => make("li", {}, note)))]
        : []),
    );
    return details;
  }
}
