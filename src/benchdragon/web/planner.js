// A plan as controls, its verdict as it changes, the player, long questions, files.

import { addressed, obey, remember } from "./address.js";
import { showDetails } from "./details.js";
import { make, textButton } from "./elements.js";
import { Files } from "./files.js";
import { helpRows, onFingerTaps } from "./fingers.js";
import { Grips } from "./grips.js";
import { JobList, questionText } from "./jobs.js";
import { linkText, readLink } from "./link.js";
import { MyBench } from "./my_bench.js";
import { Photo } from "./photo.js";
import { Placing } from "./placing.js";
import { planText, PlanForm, turnsOnce } from "./plan_form.js";
import { Player, REST } from "./player.js";
import { sendButtons } from "./sending.js";
import { Sheets } from "./sheets.js";
import { Span } from "./span.js";
import { SquareForm } from "./square_form.js";
import { Delayed, Standing, samePlan } from "./standing.js";
import { Stories } from "./stories.js";
import { Line, unreadWords } from "./telling.js";
import { Tracks } from "./tracks.js";
import { besideWord, stateOf, wordOf } from "./verdict_word.js";
import { _, language } from "./words.js";

/** @typedef {import("./messages").Preset} Preset */
/** @typedef {import("./messages").Verdict} Verdict */
/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./standing.js").Answers} Answers */

const MOST_STEPS_BACK = 200;
/** Once a plan has not changed for so long, ms, the picture is to follow. */
const PAUSE = 60;
const QUESTIONS = /** @type {const} */ (["turn", "speed", "pace", "margins"]);

export class Planner {
  /** @param {Answers} answers @param {Preset[]} presets @param {Plan} plan @param {import("./asking.js").Asking} asking */
  constructor(answers, presets, plan, asking) {
    this.answers = answers;
    this.asking = asking;
    this.presets = presets;
    /** @type {Plan[]} */
    this.past = [];
    /** @type {Plan[]} */
    this.future = [];
    this.plan = plan;
    this.settled = plan;
    this.first = plan;
    /** What an address says that is no plan; of it nothing is told. @type {{says: string} | null} */
    this.unread = null;
    /** @type {{found: Verdict, plan: Plan} | null} */
    this.verdict = null;
    /** @type {Player | null} */
    this.player = null;
    /** The plan whose dance the player shows. @type {Plan | null} */
    this.pictured = null;
    /** @type {HTMLDialogElement | null} */
    this.dialog = null;
    this.pause = new Delayed(PAUSE, () => this.#draws && this.sketches.renew(this.plan));
    this.rest = new Delayed(REST, () => this.#rested());
    this.jobs = new JobList(answers, (found) => this.change(found, true));
    this.files = new Files(this, answers);
    this.stories = new Stories(this);
    /** Who waits for the dance of a plan. @type {{ plan: Plan, done: (shown: boolean) => void } | null} */
    this.awaited = null;
    this.verdicts = new Standing(
      (asked, signal) => answers.ask("verdict", asked, signal),
      (found, about) => this.#judged(found, about),
      (error, about) => this.#unjudged(error, about),
    );
    // A scene before it counts as answered, so that no older one can come in late.
    this.dances = new Standing(
      (asked, signal) => answers.scene(asked, signal),
      (scene, about) => this.#danced(scene, about),
      (error, about) => this.#undanced(error, about),
    );
    // A rough picture first. Where there is none, the dance says why.
    this.sketches = new Standing(
      (asked, signal) => answers.sketch(asked, signal),
      (scene, about) => this.#sketched(scene, about),
      () => {},
    );
    this.root = /** @type {HTMLElement} */ (document.getElementById("planner"));
    this.stage = make("main", { id: "player", class: "player" });
    this.grips = new Grips(this, this.stage);
    this.placing = new Placing(this);
    this.photo = new Photo(this);
    this.sheets = new Sheets(this.root, answers);
    this.mine = new MyBench(this);
    const busy = () => !!this.unread || this.root.ariaBusy === "true" || this.grips.drag !== null;
    this.tracks = new Tracks(answers, busy);
    asking.begin(this);
    onFingerTaps(this.stage, (fingers) => (fingers === 2 ? this.undo() : this.redo()));
    this.notice = make("div", { class: "unread", role: "alert", hidden: true });
    /** What the notice is about. @type {Planner["unread"]} */
    this.noticed = null;
    this.lines = this.#lines();
    this.above = make("header", { class: "verdicts" });
    new ResizeObserver(() => {
      this.root.style.setProperty("--told", `${this.above.offsetHeight}px`); // a phone's picture stays below it
      this.grips.follow();
    }).observe(this.above);
    this.#build();
    addEventListener("keydown", (event) => this.#key(event));
    addEventListener("hashchange", () => this.#obey());
  }

  /** What the page is about: its plan, or what stands in the address instead of one. */
  get subject() {
    return this.unread ?? this.plan;
  }

  /** Lines that tell something, in the language in use. */
  #lines() {
    const how = { class: "verdict", "data-more": _("details") };
    const verdict = textButton("", () => this.#details(), how);
    return {
      verdict: new Line(verdict, _("computing ...")),
      sentence: new Line(make("p", { class: "sentence spoken", "aria-live": "polite" })),
      dance: new Line(make("output")),
      file: new Line(make("output", { class: "told", onclick: () => this.#putAway() })),
    };
  }

  /** Build the page, in the language in use. */
  #build() {
    document.title = _("Bench dragon planner");
    this.form = new PlanForm(this.presets, (plan, final) => this.change(plan, final));
    this.tracks.attach(this.form);
    this.square = new SquareForm(this);
    this.form.source.after(this.square.element);
    this.span = new Span((plan, final) => this.change(plan, final));
    this.undoButton = textButton(_("undo"), () => this.undo());
    this.redoButton = textButton(_("redo"), () => this.redo());
    const reset = textButton(_("reset"), () => this.change(structuredClone(this.first), true));
    const [ours, undo, redo] = [this.asking.control(), this.undoButton, this.redoButton];
    const steps = make("div", { class: "row" }, ours, undo, redo, reset);
    const others = make("div", { class: "row" }, this.mine.control(), ...sendButtons(this));
    const panel = make(
      "section",
      { class: "panel", "aria-label": _("plan") },
      others,
      steps,
      this.form.element,
      this.span.element,
      this.stories.controls(),
      this.#long(),
      this.sheets.control(() => this.plan),
      this.files.controls(this.lines.file.element),
    );
    const { verdict, sentence, dance } = this.lines;
    this.above.replaceChildren(this.notice, verdict.element, sentence.element);
    const old = make("span", {}, _("the picture is of an earlier plan"));
    this.asking.build();
    this.mine.build();
    this.root.replaceChildren(
      this.asking.element,
      this.above,
      make("aside", { class: "old" }, old, dance.element),
      this.asking.aside,
      this.mine.element,
      this.stage,
      this.grips.element,
      panel,
    );
    this.#shown();
  }

  /** Long questions, those that are answered here. */
  #long() {
    const asked = QUESTIONS.filter((question) => this.answers.has(`job/${question}`));
    const buttons = asked.map((question) =>
      textButton(questionText(question), () => this.jobs.start(question, this.plan), {
        "data-question": question,
      }),
    );
    this.turnButton = buttons[asked.indexOf("turn")];
    return make(
      "fieldset",
      { hidden: !asked.length },
      make("legend", {}, _("Long questions")),
      make("div", { class: "row" }, ...buttons),
      this.jobs.element,
    );
  }

  /** How it went with a file; where it did not go, that lies over the page until it is put away. @param {object} plan what it is about @param {string} text @param {boolean} [failed] */
  tellFile(plan, text, failed = false) {
    this.lines.file.tell(plan, text, failed ? "none" : "");
    this.#mark();
  }

  /** Put away what lies over the page. */
  #putAway() {
    const { told } = this.lines.file;
    if (told?.state) this.tellFile(told.plan, told.text);
  }

  /** Another plan. @param {Plan} plan @param {boolean} final whether it is a step of its own */
  change(plan, final) {
    if (this.asking.first) {
      this.first = this.settled = plan; // what walked there was nobody's plan
      for (const line of [this.lines.verdict, this.lines.sentence]) line.forget();
    }
    if (final && JSON.stringify(plan) !== JSON.stringify(this.settled)) {
      this.past.push(this.settled);
      if (this.past.length > MOST_STEPS_BACK) this.past.shift();
      this.future = [];
      this.settled = plan;
    }
    this.show(plan);
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
    this.show(plan);
  }

  /** Be about a plan from now on, and ask all that follows from it. @param {Plan} plan */
  show(plan) {
    this.plan = plan;
    this.unread = null;
    this.stories.show(plan);
    this.asking.about(plan);
    this.mine.about();
    if (this.awaited && this.awaited.plan !== plan) this.#await(false);
    this.#shown();
    this.#ask();
  }

  /** Wait for the dance of the plan on the page; whether it is shown. @param {Plan} plan @returns {Promise<boolean>} */
  whenDanced(plan) {
    return new Promise((done) => {
      this.awaited = { plan, done };
    });
  }

  /** Say to whoever waits for a dance that it is shown, or will not be. @param {boolean} shown */
  #await(shown) {
    this.awaited?.done(shown);
    this.awaited = null;
  }

  /** Show the plan in the controls. */
  #shown() {
    this.form?.show(this.plan);
    this.square?.show(this.plan);
    this.span?.show(this.plan);
    this.tracks.show(this.plan);
    this.grips.show(this.plan);
    if (this.undoButton) this.undoButton.disabled = !this.past.length;
    if (this.redoButton) this.redoButton.disabled = !this.future.length;
    if (this.turnButton) this.turnButton.disabled = !turnsOnce(this.plan);
  }

  /** Addresses that were put into the same window; and those of them that have been read. */
  #arrived = 0;
  #read = 0;

  /** Another address was put into the same window: go there. */
  async #obey() {
    const arrival = ++this.#arrived;
    const text = addressed().get("plan");
    const { plan, says } = text ? await readLink(text, this.presets) : { plan: null, says: "" };
    if (arrival !== this.#arrived) return;
    this.#read = arrival;
    if (this.player) obey(this.player);
    if (text && !plan) this.refuse(says);
    else if (plan && planText(plan) !== planText(this.subject)) this.change(plan, true);
    else if (this.unread) this.show(this.plan);
    else this.#remember();
  }

  /** The address holds what is no plan: say so, leave it there, and tell nothing. @param {string} says */
  refuse(says) {
    this.unread = { says };
    this.asking.about(this.plan);
    for (const one of [this.verdicts, this.sketches, this.dances]) one.drop();
    this.tracks.show(this.plan);
    for (const one of [this.pause, this.rest]) one.drop();
    this.dialog?.close();
    this.verdict = null;
    const text = _("No verdict: the plan in this link cannot be read.");
    this.#tell(this.unread, _("no verdict"), text, "none");
  }

  /** Put the plan into the address, and where the player stands, unless what is there is not to be lost. */
  async #remember() {
    const { plan } = this;
    const text = await linkText(plan, this.presets);
    const there = this.unread !== null || this.asking.first || this.#read !== this.#arrived;
    if (!there && plan === this.plan) remember(this.player, { plan: text, lang: language() });
  }

  /** Ask all that follows from the plan; the dance once a change has come to rest. */
  #ask() {
    this.dialog?.close();
    // A dance that was told, and whose picture another took the place of, comes anew.
    if (!this.#pictures(this.subject)) this.lines.dance.forget();
    this.#mark();
    if (this.answers.has("verdict")) this.verdicts.renew(this.plan);
    // What takes longer than a verdict is given up at once, so that verdict and rough picture come soon.
    this.dances.drop();
    this.pause.renew();
    this.rest.renew();
  }

  /** A change has come to rest. */
  #rested() {
    this.#remember();
    this.files.keep(this.plan);
    if (this.#draws) this.dances.renew(this.plan);
    else if (this.grips.drag) this.rest.renew(); // a grip held without a move asks nothing when it is let go
  }

  /** Whether pictures are asked for now. */
  get #draws() {
    return this.answers.has("dance") && !this.grips.drag;
  }

  /** Show all that was told, and mark what is about another plan than the page. */
  #mark() {
    const { subject, unread } = this;
    const { verdict, sentence, dance } = this.lines;
    for (const line of Object.values(this.lines)) line.show(subject);
    this.sheets.about(subject);
    verdict.element.hidden = unread === null && !this.answers.has("verdict");
    dance.element.hidden = dance.repeats(sentence);
    this.root.ariaBusy = String(!unread && !dance.about(subject));
    this.root.dataset.picture = !this.pictured ? "none" : this.#pictures(subject) ? "this" : "old";
    this.jobs.show(subject);
    this.notice.hidden = unread === null;
    if (unread !== this.noticed)
      this.notice.replaceChildren(
        ...(unread ? unreadWords(unread.says, () => this.show(this.plan)) : []),
      );
    this.noticed = unread;
  }

  /** Whether the player shows the dance of this plan. @param {Plan} plan */
  #pictures(plan) {
    return this.pictured !== null && samePlan(this.pictured, plan);
  }

  /** @param {Verdict} found @param {Plan} plan */
  #judged(found, plan) {
    this.verdict = { found, plan };
    this.#tell(plan, wordOf(found), found.sentence[language()], stateOf(found), "", besideWord(found));
  }

  /** Tell a verdict in a word, and in a sentence to who cannot see it. @param {object} plan @param {string} word @param {string} sentence @param {import("./telling.js").State} state @param {string} [why] @param {HTMLElement[]} [beside] */
  #tell(plan, word, sentence, state, why, beside) {
    this.lines.verdict.tell(plan, word, state, why, beside);
    this.lines.sentence.tell(plan, sentence, state, why);
    this.#mark();
  }

  /** There is no verdict, neither safe nor unsafe. @param {Error} error @param {Plan} plan */
  #unjudged(error, plan) {
    this.verdict = null;
    const text = _("No verdict: {error}", { error: error.message });
    this.#tell(plan, _("no verdict"), text, "none", error.message);
  }

  /** Open what is behind the word: why, what mends it, all numbers. */
  #details() {
    const { sentence } = this.lines;
    if (!sentence.about(this.subject)) return;
    const jump = (/** @type {number} */ time) => this.player?.jump(time);
    this.dialog = showDetails(this.root, this.answers, {
      plan: this.plan,
      found: this.verdict?.found ?? null,
      sentence: sentence.told?.text ?? "",
      jump: this.#pictures(this.subject) ? jump : null,
      take: (plan) => this.change(plan, true),
    });
  }

  /** @param {Scene} scene @param {Plan} plan */
  #danced(scene, plan) {
    this.lines.dance.tell(plan, "");
    this.#mark();
    this.#whenFree(() => {
      this.#picture(scene, plan);
      this.photo.about(plan, scene.sent.plan_sha256);
      if (this.awaited?.plan === plan) this.#await(true);
    });
  }

  /** A rough dance, shown unless the dance itself was faster. @param {Scene} scene @param {Plan} plan */
  #sketched(scene, plan) {
    if (!this.lines.dance.about(plan)) this.#whenFree(() => this.#picture(scene, plan));
  }

  /** Show a dance once no hand holds what it takes the place of. @param {() => void} show */
  #whenFree(show) {
    if (this.player) this.player.whenFree(show);
    else show();
  }

  /** Show a dance, unless a newer one came while a hand held the picture. @param {Scene} scene @param {Plan} plan */
  #picture(scene, plan) {
    if (this.#pictures(this.subject) && !samePlan(plan, this.subject)) return;
    this.pictured = plan;
    this.#mark();
    this.span?.dance(scene, plan);
    if (this.player) this.player.show(scene);
    else this.#play(scene);
    this.asking.pictured(plan);
  }

  /** @param {Scene} scene */
  #play(scene) {
    const player = (this.player = new Player(this.stage, scene));
    player.more = helpRows;
    player.onDrawn = () => {
      this.grips.follow();
      this.mine.tell();
    };
    obey(player);
    player.onSettled = () => this.#remember();
    player.onTranslated = () => this.#translated();
    if (this.root.dataset.opens === "walking") player.play(!player.still.matches);
  }

  /** The player shows no new dance: say why. @param {Error} error @param {Plan} plan */
  #undanced(error, plan) {
    const text = _("This plan cannot be shown: {error}", { error: error.message });
    this.lines.dance.tell(plan, text, "", error.message);
    this.#mark();
    if (this.awaited?.plan === plan) this.#await(false);
  }

  #translated() {
    this.lines = this.#lines();
    this.noticed = null;
    this.#build();
    this.jobs.retell();
    if (this.unread) this.refuse(this.unread.says);
    else this.#ask();
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (event.key === "Escape") this.#putAway();
    const key = event.key.toLowerCase();
    if (!(event.ctrlKey || event.metaKey) || !["y", "z"].includes(key)) return;
    event.preventDefault();
    if (key === "y" || event.shiftKey) this.redo();
    else this.undo();
  }
}
