// Plan files in and out, and the plan that the browser keeps.

import { keepPlan, keptPlan } from "./address.js";
import { commandList } from "./commands.js";
import { make } from "./elements.js";
import { planText } from "./plan_form.js";
import { _ } from "./words.js";

/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./standing.js").Answers} Answers */
/** @typedef {import("./standing.js").MadeFile} MadeFile */

/**
 * The page that files are of.
 * @typedef {object} Host
 * @property {Plan} plan
 * @property {object} subject what it is about: the plan, or what stands in the address instead
 * @property {(plan: Plan, final: boolean) => void} change
 * @property {(plan: object, text: string, failed?: boolean) => void} tellFile how it went, and with which plan
 */

/** A page reads smaller files than the program: what is opened stays in memory several times. */
const MOST_BYTES = 20e6;

export class Files {
  /** @param {Host} host @param {Answers} answers */
  constructor(host, answers) {
    this.host = host;
    this.answers = answers;
    /** @type {ReturnType<typeof commandList> | null} */
    this.commands = null;
    addEventListener("dragover", (event) => {
      if (event.dataTransfer?.types.includes("Files")) event.preventDefault();
    });
    addEventListener("drop", (event) => {
      const [file] = event.dataTransfer?.files ?? [];
      if (!file) return;
      event.preventDefault();
      this.#open(file);
    });
  }

  /** The controls, in the language in use. @param {HTMLElement} told where it is said how it went */
  controls(told) {
    const save = make("button", { type: "button", onclick: () => this.#save() });
    save.append(_("save the plan file"));
    return make(
      "fieldset",
      {},
      make("legend", {}, _("Files")),
      make("div", { class: "row" }, ...this.opener(), save),
      this.#keeper(),
      this.#commandsOf().element,
      told,
    );
  }

  /** A button that opens a plan file, and what it takes for that. */
  opener() {
    const input = make("input", { type: "file", accept: ".toml", hidden: true });
    input.addEventListener("change", () => {
      const file = input.files?.[0];
      input.value = "";
      if (file) this.#open(file);
    });
    const open = make("button", { type: "button", onclick: () => input.click() });
    open.append(_("open a plan file"));
    return [input, open];
  }

  /** What can be made of the plan by commands. */
  #commandsOf() {
    this.commands = commandList(
      (name) => this.answers.has(name),
      () => this.host.plan,
    );
    return this.commands;
  }

  /** A tick that has the browser keep the plan. */
  #keeper() {
    const kept = make("input", { type: "checkbox" });
    kept.checked = keptPlan() !== null;
    kept.addEventListener("change", () => {
      const keeps = keepPlan(kept.checked ? planText(this.host.plan) : null);
      if (!keeps) kept.checked = false;
    });
    return make("label", { class: "row" }, kept, _("keep the plan in this browser"));
  }

  /** Keep a plan, where the browser keeps one already, and name it in commands. @param {Plan} plan */
  keep(plan) {
    this.commands?.tell();
    if (keptPlan() !== null) keepPlan(planText(plan));
  }

  /** @param {File} file */
  async #open(file) {
    const before = this.host.subject;
    await this.#tried(async () => {
      if (file.size > MOST_BYTES)
        throw new Error(
          _("{source} is too large for a plan: {size} MB, at most {most} MB are read", {
            source: file.name,
            size: Math.floor(file.size / 1e6),
            most: MOST_BYTES / 1e6,
          }),
        );
      const plan = await this.answers.opened(await file.text());
      if (this.host.subject !== before)
        throw new Error(_("The plan was changed meanwhile: open it again."));
      this.host.change(plan, true);
      return { name: file.name, plan };
    });
  }

  async #save() {
    const { plan } = this.host;
    await this.#tried(async () => ({ name: deliver(await this.answers.saved(plan)), plan }));
  }

  /** Do something with files, and say how it went. @param {() => Promise<{ name: string, plan: Plan }>} action */
  async #tried(action) {
    const before = this.host.subject;
    this.host.tellFile(before, _("working ..."));
    try {
      const { name, plan } = await action();
      this.host.tellFile(plan, name);
    } catch (error) {
      if (!(error instanceof Error)) throw error;
      this.host.tellFile(before, error.message, true);
    }
  }
}

/** Have the browser save a file; its name. @param {MadeFile} file */
export function deliver({ name, data }) {
  const url = URL.createObjectURL(data);
  make("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
  return name;
}
