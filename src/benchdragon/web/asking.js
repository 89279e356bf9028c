// The first screen: what this is, three questions, and the dance that is proposed for the answers.

import { keepChoice } from "./address.js";
import { AnswerBox } from "./answer_box.js";
import { make, textButton } from "./elements.js";
import { Frame } from "./grip_kinds.js";
import { QUESTIONS, wished } from "./made/answers.js";
import { valueOf } from "./number_control.js";
import { openings } from "./openings.js";
import { samePlan } from "./standing.js";
import { besideStreet, restsOf, streetOf } from "./things.js";
import { _, language, speak } from "./words.js";

/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./planner.js").Planner} Planner */
/** @typedef {import("./standing.js").Aside} Aside */
/** What was found for wishes: a plan, if there is one; what is said of that, and of what was wished and is
 * not in it; how many benches fit; whether all do with bearers under them.
 * @typedef {{ plan: Plan | null, said: string[], left: string[], benches: number, under?: boolean }} Proposed */

/** What everybody is asked; all else has usual answers. */
const FIRST = ["benches", "bench_length", "square", "carry"];

/** What plans say of people that no proposal does. */
const NAMES = ["roster", "sheet", "unit", "count_head", "step", "address"];

/** How many times a plan coils in and out. @param {Plan | null} plan */
function roundsOf(plan) {
  const { kind, rounds } = plan?.route ?? {};
  return kind === "turn" && Number.isInteger(rounds) ? rounds : 1;
}

/** How many cues a plan has. @param {Plan} plan */
const cuesOf = ({ cues }) => (Array.isArray(cues?.cue) ? cues.cue.length : 0);

/** What a plan says of drum and clock, and its rests that a dance in its place has, too: before rounds, and in the street. @param {Plan} before @param {Plan} plan of that dance @returns {Record<string, any>} */
function hoursOf({ cues, ...before }, plan) {
  const { cue: _cue, ...hours } = cues ?? {};
  const rests = restsOf({ cues, ...before }).map(([, one]) => one);
  const kept = rests.filter(({ round, place }) =>
    round ? round <= roundsOf(plan) : besideStreet(plan, place),
  );
  return kept.length ? { ...hours, cue: kept } : hours;
}

/** A proposed plan with what another says of the event, its hours and names. @param {Plan} plan @param {Plan | null} before @param {boolean} titled whether its title is its own */
function withNames(plan, before, titled) {
  if (!before) return plan;
  /** @type {Plan} */
  const copy = { ...plan, people: { ...plan.people } };
  const { meta, event, people = {} } = before;
  if (titled && meta) copy.meta = meta;
  if (event) copy.event = event;
  const cues = hoursOf(before, plan);
  if (Object.keys(cues).length) copy.cues = cues;
  if (cues.cue) copy.walk = { ...plan.walk, end: null }; // the dance takes longer
  for (const name of NAMES) if (name in people) copy.people[name] = people[name];
  return copy;
}

/** What of a plan would be lost with another in its place, in sentences; `left` are those about its square. @param {Plan | null} before @param {Plan} plan @param {string[]} left */
function lossesOf(before, plan, left) {
  if (!before) return [];
  const lost = [...left];
  if (!["spiral-in", "turn"].includes(before.route.kind))
    lost.push(_("The route of the plan before gives way to a coil."));
  const count = cuesOf(before) - cuesOf(plan);
  if (count > 0) lost.push(_("Rests and calls of the dance before are left out: {count}.", { count }));
  return lost.length ? [...lost, _("Undo brings back the dance before, with all of that.")] : [];
}

/** Where a square lies: a plan's own stays in place, for what stands there. @param {any} sides or its corners @param {any} venue */
function placed(sides, venue) {
  const moved = venue?.rectangle && (venue.centre || venue.angle);
  if (!sides || !(moved || Array.isArray(sides[0]))) return {};
  const frame = new Frame(venue.centre ?? [0, 0], venue.angle ?? 0);
  const [a, b] = [0.5 * sides[0], 0.5 * sides[1]];
  /** @type {[number, number][]} */
  const corners = [[a, b], [-a, b], [-a, -b], [a, -b]]; // prettier-ignore
  const own = Array.isArray(sides[0]) ? sides : corners.map((corner) => frame.ground(corner));
  return { rectangle: null, boundary: own };
}

export class Asking {
  /** @type {Planner | null} */
  #planner = null;
  /** Who looks for a dance. @type {Aside | null} */
  #lane = null;
  /** Whether the questions are on the page; and whether that is because it has no plan. */
  #open = false;
  #first = false;
  /** What was proposed, and whether it is still to begin its walk. @type {Proposed | null} */
  #proposed = null;
  #begins = false;

  /** @param {HTMLElement} root that of the page */
  constructor(root) {
    this.root = root;
    /** A picture of the dance that walks beside the questions, until that does. */
    this.look = root.querySelector(".look") ?? "";
    this.boxes = QUESTIONS.map((question) => new AnswerBox(question, () => this.#usual()));
    this.element = make("section", { class: "wishes", role: "main", hidden: true });
    this.element.addEventListener("keydown", ({ key }) => key === "Escape" && this.#away());
    this.rest = make("details", { class: "rest" });
    this.go = make("div", { class: "go" });
    this.told = make("div", { class: "unfit", role: "alert" });
    this.button = make("button", { class: "main" });
    this.bar = make("progress", { max: "1" });
    this.far = make("span", { class: "far" });
    this.cancel = textButton("", () => this.#lane?.close());
    this.go.append(this.button, this.bar, this.far, this.cancel);
    /** What was proposed, to be read again beside the dance. */
    this.said = make("details");
    this.aside = make("aside", { class: "proposed", hidden: true }, this.said);
    this.build();
  }

  /** Whether the page has no plan but the one that it shows beside the questions. */
  get first() {
    return this.#first;
  }

  /** Be asked by a page that can answer. @param {Planner} planner */
  begin(planner) {
    this.#planner = planner;
    if (this.#first) planner.stage.append(this.look);
  }

  /** All of it, in the language in use. */
  build() {
    for (const box of this.boxes) box.build();
    const named = (/** @type {string} */ name) =>
      /** @type {AnswerBox} */ (this.boxes.find(({ question }) => question.name === name)).element;
    const others = this.boxes.filter(({ question }) => !FIRST.includes(question.name));
    this.rest.replaceChildren(
      make("summary", {}, _("All else is as usual: see and change it")),
      ...others.map(({ element }) => element),
    );
    const planner = this.#planner;
    const form = make(
      "form",
      {
        hidden: planner !== null && !planner.answers.has("propose"),
        onsubmit: (event) => this.#submitted(event),
      },
      ...FIRST.map(named),
      this.rest,
      this.go,
      this.told,
    );
    this.element.ariaLabel = _("your benches and your square");
    this.element.replaceChildren(
      this.#head(),
      form,
      ...(planner && this.#open ? openings(planner) : []),
    );
    this.#usual();
    this.#stand();
    this.#tell();
  }

  #head() {
    const other = language() === "zh" ? "en" : "zh";
    const spoken = other === "zh" ? "\u4e2d\u6587" : "English";
    const translate = textButton(spoken, () => this.#translate(other), { lang: other });
    const close = textButton(_("close"), () => this.#away(), { hidden: this.#first });
    const sentence = _(
      "Say how many benches you have and how large the square is: this page searches for a dance that they can walk, shows it from above, and prints a sheet for each bench.",
    );
    return make(
      "header",
      {},
      make("div", { class: "corner" }, translate, close),
      make("h1", {}, _("Your bench dragon on your square")),
      make("p", {}, sentence),
    );
  }

  /** @param {"en" | "zh"} other */
  #translate(other) {
    if (this.#planner?.player) return this.#planner.player.translate();
    speak(other);
    keepChoice("lang", other);
    this.build();
  }

  /** Ask: at first because the page has no plan, later for another dance than its own. @param {boolean} first */
  open(first) {
    this.#first = first;
    this.#open = true;
    const { plan } = this.#planner ?? {};
    if (plan && !first)
      for (const box of this.boxes) {
        /** @type {string[]} */
        const keys = box.question.keys;
        box.keep(
          keys.map((key) => valueOf(plan, key)).find((value) => value !== undefined && value !== null),
        );
      }
    this.build();
    this.#place();
    if (!first) this.boxes[0].focus();
  }

  /** Away from the questions, to the plan of the page. */
  #away() {
    if (this.#first) return;
    this.#close();
    this.opener?.focus();
  }

  #close() {
    this.#lane?.close();
    if (!this.#open) return;
    this.#open = this.#first = false;
    this.#place();
  }

  /** The button that opens it later, in the language in use. */
  control() {
    this.opener = textButton(_("my benches"), () => this.open(false));
    return this.opener;
  }

  /** Have the questions beside the dance, at dusk, or the page about its plan. */
  #place() {
    this.root.classList.toggle("asking", this.#open);
    this.element.hidden = !this.#open;
    if (!this.element.isConnected) this.root.replaceChildren(this.element, this.look);
    for (const one of this.root.children)
      /** @type {HTMLElement} */ (one).inert = this.#open && one !== this.element;
    const player = this.#planner?.player;
    player?.face.painter.dress();
    player?.put(player.time);
  }

  /** The page is about a plan from now on. @param {Plan} plan */
  about(plan) {
    this.#close();
    this.aside.hidden = !this.#proposed?.plan || !samePlan(this.#proposed.plan, plan);
  }

  /** A picture of a plan's dance is on the page: those of this screen walk at once. @param {Plan} plan */
  pictured(plan) {
    const player = this.#planner?.player;
    if (!player || !(this.#first || (this.#begins && plan === this.#proposed?.plan))) return;
    if (this.#begins) player.put(player.scene.start);
    this.#begins = false;
    player.play(!player.still.matches);
  }

  /** Answer as usual what nobody answered: some of it follows from other answers. */
  #usual() {
    /** @type {Record<string, any>} */
    const said = {};
    for (const box of this.boxes) {
      const { name, usually } = box.question;
      const follows = usually.startsWith("+") && typeof said.bench_length !== "number";
      if (usually && !follows) box.fill(box.question.usual(said));
      said[name] = box.known;
    }
  }

  /** The plan that the page has, in whose place another is wished. */
  get #before() {
    return this.#first ? null : (this.#planner?.plan ?? null);
  }

  /** The answers as wishes; null where one is asked back. */
  #wishes() {
    /** @type {Record<string, any>} */
    const said = {};
    for (const box of this.boxes)
      if (box.text || !box.question.usually) said[box.question.name] = box.read(); // else it follows
    const asked = this.boxes.filter(({ question }) => said[question.name] === undefined);
    if (asked.length) {
      this.rest.open ||= asked.some((box) => !box.asked.hidden && this.rest.contains(box.element));
      asked[0].focus();
      return null;
    }
    const given = this.boxes.filter(({ typed }) => typed).map(({ question }) => question.name);
    const plan = this.#before;
    const wishes = Object.fromEntries(wished(said, given));
    const square = { boundary: null, ...placed(wishes.rectangle, plan?.venue) };
    return {
      ...wishes,
      ...square,
      obstacles: plan?.obstacle ?? [],
      street: plan && streetOf(plan).length ? plan.route.street : null,
      kind: null,
      rounds: roundsOf(plan),
    };
  }

  /** @param {Event} event */
  #submitted(event) {
    event.preventDefault();
    const wishes = this.#lane ? null : this.#wishes();
    if (wishes) this.#propose(wishes);
  }

  /** Look for a dance. @param {Record<string, any>} wishes */
  async #propose(wishes) {
    const planner = /** @type {Planner} */ (this.#planner);
    const lane = planner.answers.aside();
    this.#lane = lane;
    this.#tell();
    this.#stand(0, _("working ..."));
    try {
      const told = (/** @type {number} */ share, /** @type {string} */ text) =>
        this.#stand(share, text);
      /** @type {Proposed} */
      const found = await lane.ask({ question: "propose", wishes }, undefined, told);
      this.#lane = null;
      if (found.plan) this.#offer(found, found.plan);
      else this.#tell(found.said, found);
    } catch (error) {
      if (!(error instanceof Error)) throw error;
      if (error.name !== "AbortError") this.#tell([error.message]);
    } finally {
      lane.close();
      this.#lane = null;
      this.#stand();
    }
  }

  /** Show what was proposed; where something would be lost, say so before. @param {Proposed} found @param {Plan} bare what was proposed, without what the page knows besides */
  #offer(found, bare) {
    const planner = /** @type {Planner} */ (this.#planner);
    const before = this.#before;
    const titles = planner.presets.map(({ title }) => title.en);
    const plan = withNames(bare, before, !titles.includes(before?.meta?.title));
    const lost = lossesOf(before, plan, found.left);
    if (!lost.length) return this.#show(found, plan);
    this.#tell(lost, { take: () => this.#show(found, plan) });
  }

  /** Show what was proposed, walking. @param {Proposed} found @param {Plan} plan */
  #show(found, plan) {
    const planner = /** @type {Planner} */ (this.#planner);
    this.#proposed = { ...found, plan };
    this.#begins = true;
    const [first, ...others] = found.said;
    this.said.replaceChildren(make("summary", {}, first), ...others.map((text) => make("p", {}, text)));
    this.said.open = matchMedia("(min-width: 801px)").matches; // on a phone it would lie over the dance
    this.aside.ariaLabel = _("What was proposed");
    planner.change(plan, true);
    scrollTo(0, 0);
    planner.stage.querySelector("canvas")?.focus({ preventScroll: true });
  }

  /** The button, or in its place how far it is. @param {number} [share] @param {string} [text] */
  #stand(share = 0, text = "") {
    const busy = this.#lane !== null;
    const focused = this.go.contains(document.activeElement);
    this.button.disabled = !this.#planner;
    this.button.textContent = this.#planner ? _("Find our dance") : _("starting ...");
    this.cancel.textContent = _("cancel");
    this.far.textContent = text;
    this.bar.ariaLabel = _("Find our dance");
    this.bar.value = share;
    this.button.hidden = busy;
    for (const one of [this.bar, this.far, this.cancel]) one.hidden = !busy;
    for (const { element } of this.boxes) element.disabled = busy;
    if (focused) (busy ? this.cancel : this.button).focus();
  }

  /** Say why there is no dance, and offer what has one; or what one found would cost, and offer it. @param {string[]} said @param {{ benches?: number, under?: boolean, take?: () => void }} fits */
  #tell(said = [], { benches = 0, under = false, take } = {}) {
    /** @param {string} text @param {string} name @param {unknown} answer */
    const offer = (text, name, answer) =>
      textButton(text, () => {
        this.boxes.find(({ question }) => question.name === name)?.take(answer);
        this.element.querySelector("form")?.requestSubmit();
      });
    this.told.replaceChildren(
      ...said.map((text) => make("p", {}, text)),
      ...(take ? [textButton(_("show the new dance"), take)] : []),
      ...(under ? [offer(_("walk under the benches"), "carry", 1)] : []),
      ...(benches > 1
        ? [offer(_("take {count} benches", { count: benches }), "benches", benches)]
        : []),
    );
    if (said.length) this.told.scrollIntoView({ block: "nearest" });
  }
}
