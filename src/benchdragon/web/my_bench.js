// My bench: the way of one's own bench as a phone tells it while the dance walks, and who is before and behind.

import { chosenBefore, keepChoice } from "./address.js";
import { shortName } from "./card.js";
import { choice, drawnSign, make, textButton } from "./elements.js";
import { spread } from "./extent.js";
import { doing, peopleLines } from "./made/bench_text.js";
import { Numbering } from "./made/roster.js";
import { listed } from "./sayings.js";
import { Refusal, samePlan } from "./standing.js";
import { _ } from "./words.js";

/** @typedef {import("./made/bench_walks.js").BenchWalk} BenchWalk */
/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./planner.js").Planner} Planner */
/** @typedef {import("./standing.js").Aside} Aside */

const LEFT = "M20 21V12a7 7 0 0 0-7-7H9V1L2 7.5 9 14v-4h4a2 2 0 0 1 2 2v9z";
const RIGHT = "M4 21V12a7 7 0 0 1 7-7h4V1l7 6.5L15 14v-4h-4a2 2 0 0 0-2 2v9z";
const STRAIGHT = "M12 1l8 9h-5v12H9V10H4z";
const WAIT = "M5 3h5v18H5zM14 3h5v18h-5z";
/** @type {Record<string, string>} */
const SIGNS = { left: LEFT, right: RIGHT, straight: STRAIGHT };
/** So many benches' lengths are seen across the picture. */
const ACROSS = 12;
/** Who carries a bench: of more than so many it is told how many there are. */
const MOST_NAMED = 2;

export class MyBench {
  /** Whether it is on the page. */
  on = false;
  /** Number of the bench, from 1; 0 where none was chosen. */
  #bench = Math.trunc(Number(chosenBefore("mine"))) || 0;
  /** What all benches of a plan's dance do. @type {{ plan: Plan, walks: BenchWalk[] } | null} */
  #known = null;
  /** Who computes that. @type {Aside | null} */
  #lane = null;
  /** Why it is not known. */
  #trouble = "";
  /** The hold on the screen, that it may not go dark. @type {WakeLockSentinel | null} */
  #light = null;

  /** @param {Planner} planner */
  constructor(planner) {
    this.planner = planner;
    this.element = make("section", { class: "mine", hidden: true });
    this.sign = make("span", { class: "turn" });
    this.now = make("strong", { "aria-live": "polite" });
    this.next = make("p", { class: "next" });
    addEventListener("keydown", ({ key }) => key === "Escape" && this.close());
    document.addEventListener("visibilitychange", () => this.#lit());
  }

  /** The button that opens it, in the language in use. */
  control() {
    this.opener = textButton(_("I carry a bench"), () => this.open());
    this.opener.hidden = !this.planner.answers.has("ways");
    return this.opener;
  }

  open() {
    const { player, root } = this.planner;
    if (!player) return;
    this.on = true;
    root.classList.add("carrying");
    this.build();
    this.#choose(this.#bench);
    this.#ask();
    this.#lit();
    this.element.querySelector("select")?.focus();
  }

  close() {
    const { player, root } = this.planner;
    if (!this.on) return;
    this.on = false;
    this.#lane?.close();
    this.#lit();
    root.classList.remove("carrying");
    this.element.hidden = true;
    player?.choose(-1);
    player?.follow(false);
    player?.fit(spread(player.scene));
    this.opener?.focus();
  }

  /** All of it, in the language in use. */
  build() {
    const { scene } = this.planner.player ?? {};
    this.element.hidden = !this.on;
    if (!this.on || !scene) return;
    const { names } = this.planner.sheets;
    const { before = 0 } = scene.sent.village ?? {};
    names.read(new Numbering(scene.benches, !before, (/** @type {number} */ n) => shortName(scene, n)));
    /** @type {[string, string][]} */
    const benches = Array.from({ length: scene.benches }, (_bench, n) => [
      String(n + 1),
      this.#named(n + 1),
    ]);
    if (!this.#mine) benches.unshift(["0", _("choose your bench")]);
    const chosen = choice(_("the bench that I carry"), benches, String(this.#mine), (value) => {
      this.#choose(Number(value));
      keepChoice("mine", value);
    });
    this.element.ariaLabel = _("my bench");
    this.element.replaceChildren(
      make("h1", { class: "spoken" }, _("my bench")),
      make(
        "div",
        { class: "row" },
        chosen,
        textButton(_("close"), () => this.close()),
      ),
      make("p", { class: "now" }, this.sign, this.now),
      this.next,
      ...this.#around(),
    );
    this.tell();
  }

  /** The bench that was chosen, where the dragon has it. */
  get #mine() {
    return this.#bench <= (this.planner.player?.scene.benches ?? 0) ? this.#bench : 0;
  }

  /** What the bench is called, and who carries it. @param {number} bench */
  #named(bench) {
    const { player, sheets } = this.planner;
    const called = player ? shortName(player.scene, bench) : "";
    const people = sheets.names.people.get(bench)?.map(({ name }) => name) ?? [];
    if (!people.length) return called;
    return _("{bench} ({people})", { bench: called, people: listed(people, MOST_NAMED) });
  }

  /** Who is before and behind, and beside at the end. */
  #around() {
    const walk = this.#known?.walks[this.#mine - 1];
    if (!walk) return [];
    const lines = peopleLines(walk, (/** @type {number} */ n) => this.#named(n));
    return [make("p", { class: "around" }, ...[...lines].map((line) => make("span", {}, line)))];
  }

  /** Follow a bench from near. @param {number} bench */
  #choose(bench) {
    this.#bench = bench;
    this.build();
    const { player } = this.planner;
    if (!player || !this.#mine) return;
    const { length } = player.scene.sent.benches;
    const { camera } = player;
    const across = Math.min(camera.width, camera.height) / (ACROSS * length[bench - 1]);
    player.zoom(across / camera.scale);
    player.choose(bench - 1);
    player.follow(true);
  }

  /** The page is about another plan: what benches do in it is asked anew. */
  about() {
    if (this.on) this.#ask();
  }

  /** Ask what all benches do, unless that is known. */
  async #ask() {
    const { plan, answers } = this.planner;
    this.#lane?.close();
    if (this.#known && samePlan(this.#known.plan, plan)) return this.build();
    const lane = answers.aside();
    this.#lane = lane;
    this.#known = null;
    this.#trouble = _("working ...");
    this.tell();
    try {
      this.#known = { plan, walks: await lane.ask({ question: "ways", plan }) };
    } catch (error) {
      if (error instanceof DOMException) return; // it was closed
      if (!(error instanceof Refusal)) throw error;
      this.#trouble = error.message;
    } finally {
      lane.close();
    }
    this.build();
  }

  /** Tell what to do at the time that the picture shows, and what comes then. */
  tell() {
    const { player } = this.planner;
    if (!this.on || !player) return;
    const { stretches = [] } = this.#known?.walks[this.#mine - 1] ?? {};
    /** @param {{ start: number }} one */
    const begun = ({ start }) => start <= player.time;
    const n = Math.max(stretches.findLastIndex(begun), 0);
    const [now, next] = [stretches[n], stretches[n + 1]];
    const sign = now ? (now.pace === "wait" ? WAIT : SIGNS[now.turning]) : "";
    const hint = _("Choose the bench that you carry: this phone remembers it.");
    const said = now ? doing(now) : this.#mine ? this.#trouble : hint;
    const seconds = Math.ceil((next?.start ?? now?.end ?? 0) - player.time);
    const then = next
      ? _("in {seconds} s: {doing}", { seconds, doing: doing(next) })
      : _("in {seconds} s the dance ends", { seconds });
    if (this.sign.dataset.shape !== sign) this.sign.replaceChildren(...(sign ? [drawnSign(sign)] : []));
    this.sign.dataset.shape = sign;
    // Screen readers read what is set, even where it is the same.
    if (this.now.textContent !== said) this.now.textContent = said;
    this.next.textContent = now ? then : "";
  }

  /** Keep the screen from going dark while it is on the page, where the system lets it. */
  async #lit() {
    await this.#light?.release();
    this.#light = null;
    if (!this.on || document.visibilityState !== "visible" || !("wakeLock" in navigator)) return;
    try {
      this.#light = await navigator.wakeLock.request("screen");
    } catch (error) {
      if (!(error instanceof DOMException)) throw error; // which says that it may not: it goes dark as ever
    }
  }
}
