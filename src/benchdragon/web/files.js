// Plan files in and out, and the plan that the browser keeps.

import { keep, kept } from "./address.js";
import { commandList } from "./commands.js";
import { fileInput, make, textButton } from "./elements.js";
import { readLink } from "./link.js";
import { planIn } from "./pasted.js";
import { planText, textPlan } from "./plan_form.js";
import { _ } from "./words.js";

/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./standing.js").Answers} Answers */
/** @typedef {import("./standing.js").MadeFile} MadeFile */

/**
 * The page that files are of.
 * @typedef {object} Host
 * @property {Plan} plan
 * @property {import("./messages").Preset[]} presets
 * @property {HTMLElement} root
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
    addEventListener("paste", (event) => this.#pasted(event));
  }

  /** Something was pasted where nothing takes it. @param {ClipboardEvent} event */
  #pasted({ target, clipboardData }) {
    const taken = target instanceof Element && target.closest("input, textarea, select");
    if (taken || !clipboardData || this.host.root.inert) return;
    const [file] = clipboardData.files;
    if (file) this.#open(file);
    else this.paste(clipboardData.getData("text/plain"));
  }

  /** The controls, in the language in use. @param {HTMLElement} told where it is said how it went */
  controls(told) {
    const save = textButton(_("save the plan file"), () => this.#save());
    return make(
      "fieldset",
      {},
      make("legend", {}, _("Files")),
      ...this.opener(),
      make("div", { class: "row" }, save),
      keeper(_("keep the plan in this browser"), "plan", () => planText(this.host.plan)),
      this.#commandsOf().element,
      told,
    );
  }

  /** A button that opens a plan file, and what it takes for that; and a box to paste a plan into. */
  opener() {
    // Whatever is chosen is told: phones grey out plans where files are to be of some kind.
    const input = fileInput((file) => this.#open(file), { class: "plan-file" });
    const open = textButton(_("open a plan file"), () => input.click());
    const text = _("or paste its link, its letters, or the text of its file");
    const asked = make("p", { class: "asked", role: "alert", hidden: true });
    const box = make("textarea", {
      rows: "1",
      autocomplete: "off",
      spellcheck: "false",
      oninput: async () => {
        asked.textContent = await this.paste(box.value);
        asked.hidden = !asked.textContent;
        if (asked.hidden) box.value = "";
      },
    });
    return [
      make("div", { class: "row" }, input, open),
      make("label", { class: "paste" }, text, box),
      asked,
    ];
  }

  /** What can be made of the plan by commands. */
  #commandsOf() {
    this.commands = commandList(
      (name) => this.answers.has(name),
      () => this.host.plan,
    );
    return this.commands;
  }

  /** Keep a plan, where the browser keeps one already, and name it in commands. @param {Plan} plan */
  keep(plan) {
    this.commands?.tell();
    if (kept("plan") !== null) keep("plan", planText(plan));
  }

  /** @param {File} file */
  #open(file) {
    return this.#take(file.name, async () => {
      if (file.size > MOST_BYTES)
        throw new Error(
          _("{source} is too large for a plan: {size} MB, at most {most} MB are read", {
            source: file.name,
            size: Math.floor(file.size / 1e6),
            most: MOST_BYTES / 1e6,
          }),
        );
      return this.#planOf(await file.text());
    });
  }

  /** Open the plan in a text that was pasted; why not, or "". @param {string} text */
  paste(text) {
    return this.#take(_("what was pasted"), async () => {
      if (!planIn(text)[0]) throw noPlan();
      return this.#planOf(text);
    });
  }

  /** The plan in the text of a file, of a page that was sent, or of a link. @param {string} text */
  async #planOf(text) {
    const [kind, told] = planIn(text);
    if (kind === "link") {
      const { plan } = await readLink(told, this.host.presets);
      if (!plan) throw new Error(_("The plan in this link cannot be read."));
      return plan;
    }
    if (kind !== "page") return this.answers.opened(told);
    const plan = textPlan(told);
    if (!plan) throw noPlan();
    return plan;
  }

  /** Be about a plan once it is read, unless the page is about another by then. @param {string} name of where it comes from @param {() => Promise<Plan>} read */
  #take(name, read) {
    const before = this.host.subject;
    return this.#tried(async () => {
      const plan = await read();
      if (this.host.subject !== before)
        throw new Error(_("The plan was changed meanwhile: open it again."));
      this.host.change(plan, true);
      return { name, plan };
    });
  }

  async #save() {
    const { plan } = this.host;
    await this.#tried(async () => ({ name: deliver(await this.answers.saved(plan)), plan }));
  }

  /** Do something with files, and say how it went; why it did not, or "". @param {() => Promise<{ name: string, plan: Plan }>} action */
  async #tried(action) {
    const before = this.host.subject;
    this.host.tellFile(before, _("working ..."));
    try {
      const { name, plan } = await action();
      this.host.tellFile(plan, name);
      return "";
    } catch (error) {
      if (!(error instanceof Error)) throw error;
      this.host.tellFile(before, error.message, true);
      return error.message;
    }
  }
}

/** What is said where a text holds no plan. */
function noPlan() {
  return new Error(
    _("There is no plan in this: paste its link, its letters, or the text of its file."),
  );
}

/** A tick that has the browser keep something of one's own, as it then is. @param {string} text @param {"plan" | "names"} what @param {() => string} now */
export function keeper(text, what, now) {
  const box = make("input", { type: "checkbox", checked: kept(what) !== null });
  box.addEventListener("change", () => {
    if (!keep(what, box.checked ? now() : null)) box.checked = false;
  });
  return make("label", { class: "row" }, box, text);
}

/** Have the browser save a file; its name. @param {MadeFile} file */
export function deliver({ name, data }) {
  const url = URL.createObjectURL(data);
  make("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
  return name;
}
