// The studio: a plan as controls, its verdict as it changes, the player, long questions, files.

import { addressed, obey, remember } from "./address.js";
import { Refusal, Standing, asked } from "./asking.js";
import { make } from "./elements.js";
import { answerText, evidenceDialog } from "./evidence.js";
import { JobList, questionText } from "./jobs.js";
import { planText, PlanForm, textPlan } from "./plan_form.js";
import { Player, REST } from "./player.js";
import { unpackedScene } from "./scene.js";
import { _, language, speak, useWords } from "./words.js";

/** @typedef {import("./wire").Answer} Answer */
/** @typedef {import("./wire").Preset} Preset */
/** @typedef {import("./wire").Verdict} Verdict */
/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./plan_form.js").Plan} Plan */

/** The status that says: this plan cannot be walked, or is none. */
const UNUSABLE = 422;
const MOST_STEPS_BACK = 200;
const FIRST = "spiral-in";
const QUESTIONS = /** @type {const} */ (["turn", "prove", "speed", "pace", "margins"]);

/** A plan's smallest pitch says something: its spiral ends at a disc. @param {Plan} plan */
function hasPitch(plan) {
  return plan.route.kind === "turn" || (plan.route.kind === "spiral-in" && plan.disc.radius != null);
}

class Studio {
  /** @param {Preset[]} presets @param {Plan} plan */
  constructor(presets, plan) {
    this.presets = presets;
    /** @type {Plan[]} */
    this.past = [];
    /** @type {Plan[]} */
    this.future = [];
    this.plan = plan;
    this.settled = plan;
    this.first = plan;
    /** @type {Verdict | null} */
    this.verdict = null;
    /** @type {Answer | null} */
    this.pitch = null;
    /** @type {Player | null} */
    this.player = null;
    this.rest = 0;
    this.jobs = new JobList((found) => this.change(found, true));
    this.verdicts = new Standing(
      (signal) => this.#answer("/api/verdict", signal),
      (found) => this.#judged(found),
      (error) => this.#refused(error),
    );
    this.pitches = new Standing(
      (signal) => this.#answer("/api/limit/pitch", signal),
      (found) => this.#limited(found),
      (error) => this.#unlimited(error),
    );
    // Unpacked before it counts as answered, so that no older one can come in late.
    this.dances = new Standing(
      async (signal) => unpackedScene({ ...(await this.#answer("/api/dance", signal)), ruling: null }),
      (scene) => this.#danced(scene),
      (error) => this.#undanced(error),
    );
    this.root = /** @type {HTMLElement} */ (document.getElementById("studio"));
    this.stage = make("main", { id: "player", class: "player" });
    this.#build();
    addEventListener("keydown", (event) => this.#key(event));
    addEventListener("hashchange", () => this.#obey());
    this.#ask();
  }

  /** @param {string} path @param {AbortSignal} signal */
  async #answer(path, signal) {
    return (await asked(path, { plan: this.plan }, { signal })).json();
  }

  /** Build the page, in the language in use. */
  #build() {
    document.title = _("Bench dragon studio");
    this.line = make(
      "button",
      {
        type: "button",
        class: "verdict",
        "aria-live": "polite",
        title: _("show the evidence"),
        onclick: () => this.#evidence(),
      },
      _("looking ..."),
    );
    this.limitLine = make("output", { class: "limit" });
    this.danceLine = make("output");
    this.form = new PlanForm(this.presets, (plan, final) => this.change(plan, final));
    this.undoButton = make("button", { type: "button", onclick: () => this.undo() }, _("undo"));
    this.redoButton = make("button", { type: "button", onclick: () => this.redo() }, _("redo"));
    const reset = make(
      "button",
      { type: "button", onclick: () => this.change(structuredClone(this.first), true) },
      _("reset"),
    );
    const steps = make("div", { class: "row" }, this.undoButton, this.redoButton, reset);
    const panel = make(
      "section",
      { class: "panel", "aria-label": _("plan") },
      steps,
      this.form.element,
      this.#long(),
      this.#files(),
    );
    this.root.replaceChildren(
      make("header", { class: "verdicts" }, this.line, this.limitLine, this.danceLine),
      panel,
      this.stage,
    );
    this.#shown();
  }

  /** Long questions. */
  #long() {
    const buttons = QUESTIONS.map((question) =>
      make(
        "button",
        {
          type: "button",
          "data-question": question,
          onclick: () => this.jobs.start(question, this.plan),
        },
        questionText(question),
      ),
    );
    this.turnButton = buttons[0];
    return make(
      "fieldset",
      {},
      make("legend", {}, _("Long questions")),
      make("div", { class: "row" }, ...buttons),
      this.jobs.element,
    );
  }

  /** Files in and out. */
  #files() {
    const file = make("input", {
      type: "file",
      accept: ".toml",
      hidden: true,
      onchange: () => this.#open(file),
    });
    const open = make("button", { type: "button", onclick: () => file.click() }, _("open a plan file"));
    const save = make(
      "button",
      { type: "button", onclick: () => this.#download("/api/toml", {}) },
      _("save the plan file"),
    );
    const names = {
      "player.html": _("player (a page)"),
      "motion.xlsx": _("places, spreadsheet"),
      "motion.csv": _("places, CSV"),
      "motion.npz": _("places, NumPy"),
      "motion.parquet": _("places, Parquet"),
      "motion.nc": _("places, NetCDF"),
      "check.xlsx": _("moment of contact, spreadsheet"),
      png: _("pictures, PNG"),
      svg: _("pictures, SVG"),
      pdf: _("pictures, PDF"),
    };
    const options = Object.entries(names).map(([value, name]) => make("option", { value }, name));
    const kinds = make("select", { "aria-label": _("file to export") }, ...options);
    const get = make(
      "button",
      {
        type: "button",
        onclick: () => this.#download(`/api/export/${kinds.value}`, { lang: language() }),
      },
      _("export"),
    );
    this.fileLine = make("output", { class: "told" });
    return make(
      "fieldset",
      {},
      make("legend", {}, _("Files")),
      make("div", { class: "row" }, file, open, save),
      make("div", { class: "row" }, kinds, get),
      this.fileLine,
    );
  }

  /** @param {HTMLInputElement} input */
  async #open(input) {
    const file = input.files?.[0];
    input.value = "";
    if (!file) return;
    await this.#tried(async () => {
      const { plan } = await (await asked("/api/plan", { toml: await file.text() })).json();
      this.change(plan, true);
      return file.name;
    });
  }

  /** @param {string} path @param {object} more */
  async #download(path, more) {
    await this.#tried(async () => {
      const response = await asked(path, { plan: this.plan, ...more });
      const name =
        /filename="([^"]+)"/.exec(response.headers.get("Content-Disposition") ?? "")?.[1] ??
        "benchdragon";
      const url = URL.createObjectURL(await response.blob());
      make("a", { href: url, download: name }).click();
      setTimeout(() => URL.revokeObjectURL(url), 60_000);
      return name;
    });
  }

  /** Do something with files, and say how it went. @param {() => Promise<string>} action */
  async #tried(action) {
    const line = /** @type {HTMLElement} */ (this.fileLine);
    line.textContent = _("working ...");
    try {
      line.textContent = await action();
    } catch (error) {
      if (!(error instanceof Error)) throw error;
      line.textContent = error.message;
    }
  }

  /** Another plan. @param {Plan} plan @param {boolean} final whether it is a step of its own */
  change(plan, final) {
    this.plan = plan;
    if (final && JSON.stringify(plan) !== JSON.stringify(this.settled)) {
      this.past.push(this.settled);
      if (this.past.length > MOST_STEPS_BACK) this.past.shift();
      this.future = [];
      this.settled = plan;
    }
    this.#shown();
    this.#ask();
  }

  undo() {
    const before = this.past.pop();
    if (before) this.#step(before, this.future);
  }

  redo() {
    const next = this.future.pop();
    if (next) this.#step(next, this.past);
  }

  /** @param {Plan} plan @param {Plan[]} left */
  #step(plan, left) {
    left.push(this.settled);
    this.settled = plan;
    this.plan = plan;
    this.#shown();
    this.#ask();
  }

  /** Show the plan in the controls. */
  #shown() {
    this.form?.show(this.plan);
    if (this.undoButton) this.undoButton.disabled = !this.past.length;
    if (this.redoButton) this.redoButton.disabled = !this.future.length;
    if (this.turnButton) this.turnButton.disabled = this.plan.route.kind !== "turn";
  }

  /** Another address was put into the same window: go there. */
  #obey() {
    const text = addressed().get("plan");
    const plan = text ? textPlan(text) : null;
    if (text && !plan) this.unread();
    if (this.player) obey(this.player);
    if (plan && planText(plan) !== planText(this.plan)) this.change(plan, true);
    else this.#remember();
  }

  /** The address holds a plan that cannot be read. */
  unread() {
    const line = /** @type {HTMLElement} */ (this.fileLine);
    line.textContent = _("The plan in the address cannot be read.");
  }

  /** Put the plan into the address, and where the player stands. */
  #remember() {
    remember(this.player, { plan: planText(this.plan), lang: language() });
  }

  /** Ask all that follows from the plan; the dance once a change has come to rest. */
  #ask() {
    this.root.setAttribute("aria-busy", "true");
    for (const line of [this.line, this.limitLine]) if (line) line.dataset.stale = "";
    this.verdicts.renew();
    if (hasPitch(this.plan)) this.pitches.renew();
    else this.#noLimit();
    clearTimeout(this.rest);
    this.rest = setTimeout(() => {
      this.#remember();
      this.dances.renew();
    }, REST);
  }

  /** @param {Verdict} found */
  #judged(found) {
    this.verdict = found;
    this.#say(found.decided ? (found.safe ? "safe" : "unsafe") : "open", found.sentence);
  }

  /** No verdict: the plan cannot be walked, or read, or there is no answer. @param {Error} error */
  #refused(error) {
    this.verdict = null;
    this.root.setAttribute("aria-busy", "false");
    this.#say(error instanceof Refusal && error.status === UNUSABLE ? "unsafe" : "open", error.message);
  }

  /** Say why the player shows no new dance, unless the verdict does. @param {Error} error */
  #undanced(error) {
    this.root.setAttribute("aria-busy", "false");
    this.root.dataset.picture = "old";
    const line = /** @type {HTMLElement} */ (this.danceLine);
    const same = error.message === this.told;
    line.textContent = same
      ? _("the picture is of the plan before")
      : _("This plan cannot be shown: {error}", { error: error.message });
  }

  /** @param {"safe" | "unsafe" | "open"} state @param {string} text */
  #say(state, text) {
    const line = /** @type {HTMLElement} */ (this.line);
    const sign = { open: "?", safe: "\u2713", unsafe: "\u2716" }[state];
    this.told = text;
    delete line.dataset.stale;
    line.className = `verdict ${state}`;
    line.replaceChildren(make("span", { "aria-hidden": "true" }, `${sign} `), text);
  }

  /** @param {Answer} found */
  #limited(found) {
    this.pitch = found;
    const line = /** @type {HTMLElement} */ (this.limitLine);
    delete line.dataset.stale;
    line.textContent = _("smallest pitch: {answer}", { answer: answerText(found) });
  }

  /** @param {Error} error */
  #unlimited(error) {
    this.#noLimit(error.message === this.told ? "" : error.message);
  }

  #noLimit(told = "") {
    const line = /** @type {HTMLElement} */ (this.limitLine);
    this.pitch = null;
    delete line.dataset.stale;
    line.textContent = told;
  }

  #evidence() {
    if (!this.verdict) return;
    const dialog = evidenceDialog(this.verdict, this.pitch, (time) => this.player?.jump(time));
    this.root.append(dialog);
    dialog.showModal();
  }

  /** @param {Scene} scene */
  #danced(scene) {
    this.root.setAttribute("aria-busy", "false");
    delete this.root.dataset.picture;
    /** @type {HTMLElement} */ (this.danceLine).textContent = "";
    if (this.player) return this.player.show(scene);
    const player = new Player(this.stage, scene);
    this.player = player;
    obey(player);
    player.onSettled = () => this.#remember();
    player.onTranslated = () => this.#translated();
  }

  #translated() {
    this.#build();
    this.jobs.retell();
    this.#ask();
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const key = event.key.toLowerCase();
    if (!(event.ctrlKey || event.metaKey) || !["y", "z"].includes(key)) return;
    event.preventDefault();
    if (key === "y" || event.shiftKey) this.redo();
    else this.undo();
  }
}

/** Begin with the plan of the address, or the first preset. */
async function open() {
  const values = addressed();
  speak((values.get("lang") ?? navigator.language).startsWith("zh") ? "zh" : "en");
  useWords(await (await asked("/api/words", null)).json());
  /** @type {Preset[]} */
  const presets = await (await asked("/api/presets", null)).json();
  const first = /** @type {Plan} */ (
    presets.find(({ name }) => name === FIRST)?.plan ?? presets[0].plan
  );
  const text = values.get("plan");
  const plan = text ? textPlan(text) : null;
  const studio = new Studio(presets, plan ?? first);
  if (text && !plan) studio.unread();
  Object.assign(globalThis, { benchdragon: studio }); // for the browser's console
}

await open();
