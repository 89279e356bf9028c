// What the player looks like for one dance in one language: all its elements, and their words.

import { Axis, clock, FRAME, occasionText, toldTime } from "./axis.js";
import { Card } from "./card.js";
import { endTexts, kindName, KINDS } from "./colours.js";
import { choice, drawnSign, make, signButton, textButton, tick, wordButton } from "./elements.js";
import { showKeys, showLegendOf } from "./help.js";
import { Painter } from "./paint.js";
import { Story } from "./story.js";
import { talesOf } from "./tales.js";
import { _, decimals, language } from "./words.js";

/** @typedef {import("./player.js").Player} Player */
/** @typedef {import("./colours.js").Kind} Kind */
/** @typedef {import("./colours.js").Scale} Scale */
/** @typedef {import("./story.js").Tale} Tale */

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 30];
const PLAY = "M7 4v16l13-8z";
const PAUSE = "M6 4h4v16H6zM14 4h4v16h-4z";
const BEFORE = "M4 4h3v16H4zM20 4v16L8 12z";
const NEXT = "M17 4h3v16h-3zM4 4v16l12-8z";
const NOTE = "M9 17.5a3 2.5 0 1 1-2-2.4V5l13-2v12.5a3 2.5 0 1 1-2-2.4V7.4L9 8.9z";
const SHAPES =
  "M4 3h7v7H4zM17 3l4.5 7.5h-9zM7.5 13.5a4 4 0 1 1 0 8 4 4 0 0 1 0-8zM14 14h7v2h-7zM14 18h7v2h-7z";
const PRINTER = "M7 3h10v4H7zM4 8h16v9h-3v-3H7v3H4zM8 15h8v6H8z";
const HALF = "M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18v-2a7 7 0 0 0 0-14z";
/** A frame in a notebook may not print. */
const PRINTABLE = location.protocol !== "about:";

export class Face {
  /** @param {Player} player */
  constructor(player) {
    this.player = player;
    this.scene = player.scene;
    const seen = _("the dragon from above");
    this.canvas = make("canvas", { role: "img", tabindex: "0", "aria-label": seen });
    this.painter = new Painter(this.canvas);
    this.axis = new Axis(this.scene, (time, benches) => player.jump(time, benches));
    this.story = new Story(player);
    this.card = new Card(
      (bench) => player.choose(bench),
      (time, benches) => player.jump(time, benches),
    );
    this.legend = make("div", { class: "legend" });
    this.onPaper = make("p", { class: "on-paper" });
    this.clock = make("p", { class: "clock", title: this.scene.papers?.legend ?? "" });
    this.tight = make("p", { class: "tight" });
    this.spoken = make("p", { class: "spoken", "aria-live": "polite" });
    this.playButton = signButton(drawnSign(PLAY), _("play"), () => player.play(!player.playing), {
      class: "play",
    });
    this.beatButton = signButton(drawnSign(NOTE), _("drum beat"), () => player.beat(!player.drum.on));
    this.showBeat(player.drum.on);
    this.number = this.#numberBox();
    this.followBox = tick(_("follow it (the head, if none)"), player.follows, (on) =>
      player.follow(on),
    );
    this.ruleBox = tick(_("ruler: drag to measure"), player.ruling, (on) => player.rule(on));
    this.trailBox = tick(_("trails"), player.look.trails, (on) => player.see("trails", on));
    this.dressBox = tick(_("drawn as a dragon"), player.look.dressed, (on) =>
      player.see("dressed", on),
    );
    this.kinds = choice(
      _("colour by"),
      KINDS.map((kind) => [kind, kindName(kind)]),
      player.kind,
      (kind) => player.paintBy(/** @type {Kind} */ (kind)),
    );
    this.lists = [this.#views(), this.#events()];
    this.tales = talesOf(this.scene);
    this.storyButtons = make(
      "div",
      { class: "tales" },
      ...this.tales.map((tale) => {
        const told = textButton(drawnSign(PLAY), () => this.tell(tale), { class: "tell" });
        told.append(` ${tale.name()}`);
        return told;
      }),
    );
    this.showStory(false);
    this.stage = make("div", { class: "stage" }, this.canvas, this.legend, this.lists[0]);
    const middle = make("div", { class: "middle" }, this.stage, this.card.element);
    this.elements = [
      this.#header(),
      this.onPaper,
      middle,
      this.story.element,
      this.axis.element,
      this.#controls(),
      make("div", { class: "told-by" }, this.storyButtons),
      this.#footer(),
      this.spoken,
    ];
  }

  #numberBox() {
    const chosen = this.player.chosen;
    const number = make("input", {
      type: "number",
      min: "1",
      max: String(this.scene.benches),
      step: "1",
      inputmode: "numeric",
      value: chosen < 0 ? "" : String(chosen + 1),
      onchange: () => {
        if (number.checkValidity() && number.value) this.player.choose(Number(number.value) - 1);
      },
    });
    return number;
  }

  #header() {
    const { title, verdict } = this.scene.sent;
    const header = make("header", { class: "bar" }, make("h1", {}, title[language()] || "benchdragon"));
    if (verdict) {
      const state = !verdict.decided ? "open" : verdict.safe ? "safe" : "unsafe";
      const sign = { open: "?", safe: "\u2713", unsafe: "\u2716" }[state];
      header.append(
        make(
          "p",
          { class: `summary ${state}` },
          make("span", { "aria-hidden": "true" }, sign),
          ` ${verdict.sentence[language()]}`,
        ),
      );
    }
    const other = language() === "zh" ? "en" : "zh";
    const spoken = other === "zh" ? "\u4e2d\u6587" : "English";
    header.append(
      make(
        "div",
        { class: "tools" },
        textButton(spoken, () => this.player.translate(), { lang: other }),
        signButton(drawnSign(HALF), _("light or dark"), () => this.player.nextTheme()),
        signButton(drawnSign(SHAPES), _("what is drawn"), () =>
          showLegendOf(this.player.root, this.scene),
        ),
        ...(PRINTABLE ? [signButton(drawnSign(PRINTER), _("print"), () => print())] : []),
        signButton("?", _("keys"), () => showKeys(this.player.root, this.scene, this.player.more())),
      ),
    );
    return header;
  }

  #controls() {
    return make(
      "div",
      { class: "controls", role: "group", "aria-label": _("playing") },
      this.playButton,
      signButton(drawnSign(BEFORE), _("to the previous event"), () => this.player.event(-1), {
        class: "wide",
      }),
      wordButton("\u22121 s", _("one second back"), () => this.player.step(-1)),
      signButton("\u2039", _("one frame back"), () => this.player.step(-FRAME)),
      signButton("\u203a", _("one frame on"), () => this.player.step(FRAME)),
      wordButton("+1 s", _("one second on"), () => this.player.step(1)),
      signButton(drawnSign(NEXT), _("to the next event"), () => this.player.event(1), {
        class: "wide",
      }),
      this.clock,
      ...(this.scene.sent.beats ? [this.beatButton] : []),
      choice(
        _("speed of play"),
        SPEEDS.map((speed) => [String(speed), `${speed}\u00d7`]),
        String(this.player.speed),
        (value) => {
          this.player.speed = Number(value);
        },
      ),
      this.tight,
      this.lists[1],
    );
  }

  /** The list of all that happens. */
  #events() {
    const list = make(
      "ol",
      {},
      ...this.scene.sent.occasions.map((occasion) =>
        make(
          "li",
          {},
          make(
            "button",
            {
              type: "button",
              onclick: () => {
                details.open = false;
                this.player.jump(occasion.time, occasion.benches);
              },
            },
            make("time", {}, toldTime(this.scene, occasion.time, clock(occasion.time, 2))),
            ` ${occasionText(occasion)}`,
          ),
        ),
      ),
    );
    const details = make("details", { class: "events" }, make("summary", {}, _("Events")), list);
    return details;
  }

  #views() {
    return make(
      "details",
      { class: "views" },
      make("summary", {}, _("View")),
      make("label", {}, _("colour by"), this.kinds),
      make("label", {}, _("bench"), this.number),
      this.followBox,
      this.dressBox,
      this.trailBox,
      tick(
        this.scene.sent.ground.length
          ? _("ground that the dance covers")
          : _("ground that the dance covers, as a picture of many moments"),
        this.player.look.ground,
        (on) => this.player.see("ground", on),
      ),
      tick(_("route"), this.player.look.route, (on) => this.player.see("route", on)),
      ...(this.scene.sent.disc === null
        ? []
        : [tick(_("turning disc"), this.player.look.disc, (on) => this.player.see("disc", on))]),
      this.ruleBox,
      make(
        "div",
        { class: "zooms" },
        signButton("+", _("nearer"), () => this.player.zoom(1.4)),
        signButton("\u2212", _("farther"), () => this.player.zoom(1 / 1.4)),
        textButton(_("show all"), () => this.player.fit()),
      ),
    );
  }

  #footer() {
    const { frames, plan_sha256: hash, version } = this.scene.sent;
    const error = decimals(0.01 * Math.ceil(1e5 * frames.largest_error), 2);
    const made = hash
      ? _("benchdragon {version}, plan {hash}", { version, hash: hash.slice(0, 12) })
      : `benchdragon ${version}`;
    return make(
      "footer",
      {},
      frames.everywhere
        ? _("Checked between frames: no position is off by more than {error} mm.", { error })
        : _("A first picture, checked between a few frames: no position was off by more than {error} mm there.", { error }), // prettier-ignore
      ` ${made}`,
    );
  }

  /** Tell a story, from a step on. @param {Tale} [tale] @param {number} [step] @param {boolean} [paused] */
  tell(tale = this.tales[0], step = 0, paused = false) {
    this.showStory(true);
    this.story.begin(tale, step, paused);
  }

  /** @param {boolean} told */
  showStory(told) {
    this.storyButtons.hidden = told;
  }

  /** @param {boolean} on */
  showBeat(on) {
    this.beatButton.setAttribute("aria-pressed", String(on));
  }

  /** @param {boolean} playing */
  showPlaying(playing) {
    this.playButton.replaceChildren(drawnSign(playing ? PAUSE : PLAY));
    const name = playing ? _("pause") : _("play");
    this.playButton.title = name;
    this.playButton.setAttribute("aria-label", name);
  }

  /** @param {number} bench from 0, or -1 */
  showChosen(bench) {
    this.card.open(this.scene, bench);
    this.number.value = bench < 0 ? "" : String(bench + 1);
  }

  #legendOf = "";

  /** @param {Scale | null} scale */
  showLegend(scale) {
    const [low, high] = scale ? endTexts(scale) : ["", ""];
    const text = scale ? `${language()} ${scale.name} ${low} ${high}` : "";
    this.legend.hidden = !scale;
    if (!scale || (this.#legendOf === text && this.legend.childElementCount)) return;
    this.#legendOf = text;
    const strip = make("div", { class: "strip" });
    strip.style.background = `linear-gradient(to right, ${scale.colours.join(", ")})`;
    this.legend.replaceChildren(
      make("span", {}, scale.name),
      strip,
      make("span", { class: "ends" }, make("span", {}, low), make("span", {}, high)),
    );
  }
}

/** @param {HTMLElement} label @param {boolean} on */
export function ticked(label, on) {
  const box = label.querySelector("input");
  if (box) box.checked = on;
}
