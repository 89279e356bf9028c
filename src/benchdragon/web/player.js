// The player: a dance on a canvas, with a time axis, keys, gestures and a card for each bench.

import { Axis, clock, occasionText } from "./axis.js";
import { Camera, listen } from "./camera.js";
import { Card } from "./card.js";
import { endTexts, kindName, KINDS, scaleOf } from "./colours.js";
import { choice, make, signButton, tick } from "./elements.js";
import { Boxes } from "./nearness.js";
import { Painter } from "./paint.js";
import { _, decimals, language, shortLength, speak } from "./words.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./colours.js").Kind} Kind */

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 30];
/** A film's frame, s; and the longest that one turn of the loop may last, s. */
const FRAME = 1 / 25;
const LONGEST_TURN = 0.1;
const THEMES = /** @type {const} */ (["auto", "light", "dark"]);
/** The page speaks to screen readers this often while it plays, ms. */
const SPOKEN_EACH = 5000;
/** Frame times kept, ms. */
const TIMES_KEPT = 600;

export class Player {
  /**
   * @param {HTMLElement} root
   * @param {Scene} scene
   */
  constructor(root, scene) {
    this.root = root;
    this.camera = new Camera();
    this.time = scene.start;
    this.playing = false;
    this.speed = 1;
    this.chosen = -1;
    this.follows = false;
    this.ruling = false;
    /** @type {[number, number][]} */
    this.ruler = [];
    /** @type {Kind} */
    this.kind = "plain";
    this.look = { trails: false, disc: true, route: true };
    /** @type {number[]} */
    this.frameTimes = [];
    this.still = matchMedia("(prefers-reduced-motion: reduce)");
    this.#install(scene);
    this.#build();
    this.fit();
    document.addEventListener("keydown", (event) => this.#key(event));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.#dressed());
    requestAnimationFrame((now) => this.#turn(now));
  }

  /** @param {Scene} scene */
  #install(scene) {
    this.scene = scene;
    this.stand = scene.room();
    this.boxes = new Boxes(scene);
    this.time = Math.min(Math.max(this.time, scene.start), scene.end);
    if (this.chosen >= scene.benches) this.chosen = -1;
  }

  /** Show another dance, at the same time and place. @param {Scene} scene */
  show(scene) {
    this.#install(scene);
    this.#build();
  }

  /** Build the page anew, in the language in use. */
  #build() {
    const canvas = make("canvas", { role: "img", tabindex: "0" });
    this.painter = new Painter(canvas);
    this.axis = new Axis(this.scene, (time) => this.jump(time));
    this.card = new Card((bench) => this.choose(bench), (time) => this.jump(time));
    this.legend = make("div", { class: "legend" });
    this.clock = make("output", { class: "clock" });
    this.tight = make("output", { class: "tight" });
    this.spoken = make("p", { class: "spoken", "aria-live": "polite" });
    this.spokenAt = 0;
    this.playButton = signButton("\u25b6", _("play"), () => this.play(!this.playing), { class: "play" });
    this.stage = make("div", { class: "stage" }, canvas, this.legend, this.card.element, this.#views());
    this.root.replaceChildren(this.#header(), this.stage, this.axis.element, this.#controls(), this.#footer(), this.spoken);
    this.card.open(this.scene, this.chosen);
    listen(canvas, this.camera, {
      moved: () => this.#touched(),
      tapped: (px, py) => this.choose(this.boxes.at(...this.camera.toGround(px, py), 12 / this.camera.scale)),
      measured: (px, py, ended, began) => this.#measured(px, py, ended, began),
    });
    this.#painted = -1;
    const resized = new ResizeObserver(() => this.#resize());
    resized.observe(this.stage);
    this.#resize();
    this.#dressed();
    this.play(this.playing);
  }

  #header() {
    const { title, ruling } = this.scene.sent;
    const header = make("header", { class: "bar" }, make("h1", {}, title[language()] || "benchdragon"));
    if (ruling) {
      const state = !ruling.decided ? "open" : ruling.safe ? "safe" : "unsafe";
      const sign = { open: "?", safe: "\u2713", unsafe: "\u2716" }[state];
      header.append(make("p", { class: `ruling ${state}` }, make("span", { "aria-hidden": "true" }, sign), ` ${ruling.text[language()]}`));
    }
    header.append(
      make("div", { class: "tools" },
        make("button", { type: "button", lang: language() === "zh" ? "en" : "zh", onclick: () => this.translate() }, language() === "zh" ? "English" : "\u4e2d\u6587"),
        signButton("\u25d0", _("light or dark"), () => this.#nextTheme()),
        signButton("?", _("keys"), () => this.#help()),
      ),
    );
    return header;
  }

  #controls() {
    return make("div", { class: "controls", role: "group", "aria-label": _("playing") },
      signButton("\u23ee\ufe0e", _("to the previous event"), () => this.#event(-1), { class: "wide" }),
      signButton("\u22121 s", _("one second back"), () => this.step(-1)),
      signButton("\u2039", _("one frame back"), () => this.step(-FRAME)),
      this.playButton,
      signButton("\u203a", _("one frame on"), () => this.step(FRAME)),
      signButton("+1 s", _("one second on"), () => this.step(1)),
      signButton("\u23ed\ufe0e", _("to the next event"), () => this.#event(1), { class: "wide" }),
      this.clock,
      choice(_("speed of play"), SPEEDS.map((speed) => [String(speed), `${speed}\u00d7`]), String(this.speed), (value) => { this.speed = Number(value); }),
      this.tight,
      this.#events(),
    );
  }

  /** The list of all that happens. */
  #events() {
    const list = make("ol", {}, ...this.scene.sent.occasions.map((occasion) =>
      make("li", {}, make("button", { type: "button", onclick: () => { details.open = false; this.jump(occasion.time, occasion.benches); } },
        make("time", {}, clock(occasion.time, 2)), ` ${occasionText(occasion)}`))));
    const details = make("details", { class: "events" }, make("summary", {}, _("Events")), list);
    return details;
  }

  #views() {
    const toggled = (/** @type {"trails" | "disc" | "route"} */ name) => (/** @type {boolean} */ on) => { this.look[name] = on; this.#touch(); };
    const number = make("input", {
      type: "number", min: "1", max: String(this.scene.benches), step: "1", inputmode: "numeric", value: this.chosen < 0 ? "" : String(this.chosen + 1),
      onchange: () => { if (number.checkValidity() && number.value) this.choose(Number(number.value) - 1); },
    });
    this.number = number;
    this.followBox = tick(_("follow it (the head, if none)"), this.follows, (on) => this.follow(on));
    this.ruleBox = tick(_("ruler: drag to measure"), this.ruling, (on) => this.rule(on));
    return make("details", { class: "views" },
      make("summary", {}, _("View")),
      make("label", {}, _("colour by"), choice(_("colour by"), KINDS.map((kind) => [kind, kindName(kind)]), this.kind, (kind) => this.paintBy(/** @type {Kind} */ (kind)))),
      make("label", {}, _("bench"), number),
      this.followBox,
      tick(_("trails"), this.look.trails, toggled("trails")),
      tick(_("route"), this.look.route, toggled("route")),
      ...(this.scene.sent.disc === null ? [] : [tick(_("turning disc"), this.look.disc, toggled("disc"))]),
      this.ruleBox,
      make("div", { class: "zooms" },
        signButton("+", _("nearer"), () => this.zoom(1.4)),
        signButton("\u2212", _("farther"), () => this.zoom(1 / 1.4)),
        make("button", { type: "button", onclick: () => this.fit() }, _("show all")),
      ),
    );
  }

  #footer() {
    const { frames, plan_sha256: hash, version } = this.scene.sent;
    const error = decimals(1000 * frames.largest_error, 2);
    return make("footer", {}, _("Between its frames a place is off by at most {error} mm. benchdragon {version}, plan {hash}", { error, version, hash: hash.slice(0, 12) }));
  }

  #help() {
    const keys = /** @type {[string, string][]} */ ([
      [_("space"), _("play or pause")], ["\u2190 \u2192", _("one second back or on")], [", .", _("one frame back or on")], ["p n", _("to the previous or next event")],
      ["+ \u2212 0", _("nearer, farther, show all")], ["[ ]", _("the bench before or behind")], ["f", _("follow")], ["c", _("colour by something else")],
      ["t", _("trails")], ["r", _("ruler")], [_("Home, End"), _("to the beginning, to the end")], ["Esc", _("close the card")],
    ]);
    const dialog = make("dialog", { "aria-label": _("keys"), onclose: () => dialog.remove() },
      make("table", {}, ...keys.map(([key, text]) => make("tr", {}, make("th", { scope: "row" }, key), make("td", {}, text)))),
      make("form", { method: "dialog" }, make("button", {}, _("close"))));
    this.root.append(dialog);
    dialog.showModal();
  }

  #resize() {
    const box = this.stage.getBoundingClientRect();
    const density = devicePixelRatio || 1;
    const canvas = this.painter.canvas;
    [canvas.width, canvas.height] = [Math.max(Math.round(box.width * density), 1), Math.max(Math.round(box.height * density), 1)];
    const first = this.camera.width <= 1;
    this.camera.resize(Math.max(box.width, 1), Math.max(box.height, 1));
    if (first) this.fit();
    this.#touch();
  }

  #nextTheme() {
    const now = /** @type {typeof THEMES[number]} */ (document.documentElement.dataset.theme ?? "auto");
    document.documentElement.dataset.theme = THEMES[(THEMES.indexOf(now) + 1) % THEMES.length];
    this.#dressed();
  }

  #dressed() {
    this.painter.dress();
    this.#touch();
  }

  translate() {
    speak(language() === "zh" ? "en" : "zh");
    this.#build();
    this.onTranslated?.();
  }

  /** Called when the page has changed its language. @type {(() => void) | undefined} */
  onTranslated;

  /** @param {boolean} on */
  play(on) {
    if (on && this.time >= this.scene.end) this.time = this.scene.start;
    this.playing = on;
    this.playButton.textContent = on ? "\u23f8\ufe0e" : "\u25b6\ufe0e";
    const name = on ? _("pause") : _("play");
    this.playButton.title = name;
    this.playButton.setAttribute("aria-label", name);
    if (!on) this.#settled();
  }

  /** @param {number} seconds */
  step(seconds) {
    this.play(false);
    this.jump(this.time + seconds);
  }

  /** Go to a time, s; and to the first of some benches, where it is not in sight. @param {number} time @param {number[]} [benches] */
  jump(time, benches = []) {
    this.time = Math.min(Math.max(time, this.scene.start), this.scene.end);
    this.#touch();
    if (benches.length) {
      this.#pose();
      const bench = benches[0] - 1;
      const [px, py] = this.camera.toScreen(this.boxes.x[bench], this.boxes.y[bench]);
      if (px < 0 || py < 0 || px > this.camera.width || py > this.camera.height) [this.camera.x, this.camera.y] = [this.boxes.x[bench], this.boxes.y[bench]];
    }
    if (!this.playing) this.#settled();
  }

  /** To the event before or after. @param {1 | -1} way */
  #event(way) {
    const ahead = this.scene.sent.occasions.filter(({ time }) => way * (time - this.time) > 1e-6);
    ahead.sort((a, b) => way * (a.time - b.time));
    if (ahead.length) this.jump(ahead[0].time, ahead[0].benches);
  }

  /** @param {number} bench from 0; -1: none */
  choose(bench) {
    this.chosen = Math.min(Math.max(bench, -1), this.scene.benches - 1);
    this.card.open(this.scene, this.chosen);
    this.number.value = this.chosen < 0 ? "" : String(this.chosen + 1);
    this.#touch();
    this.#settled();
  }

  /** @param {boolean} on */
  follow(on) {
    this.follows = on;
    ticked(this.followBox, on);
    this.#touch();
  }

  /** @param {boolean} on */
  rule(on) {
    this.ruling = on;
    if (!on) this.ruler = [];
    ticked(this.ruleBox, on);
    this.painter.canvas.classList.toggle("ruling", on);
    this.#touch();
  }

  /** @param {Kind} kind */
  paintBy(kind) {
    this.kind = kind;
    this.#touch();
  }

  /** @param {number} factor */
  zoom(factor) {
    this.camera.zoom(factor, 0.5 * this.camera.width, 0.5 * this.camera.height);
    this.#touched();
  }

  /** Show the whole dragon as it stands, and the disc. */
  fit() {
    this.#pose();
    const { x, y } = this.stand;
    const { disc, centre } = this.scene.sent;
    const room = this.boxes.half[0] * 2;
    const across = [Math.min(...x), Math.max(...x)];
    const up = [Math.min(...y), Math.max(...y)];
    if (disc !== null) {
      across.push(centre[0] - disc, centre[0] + disc);
      up.push(centre[1] - disc, centre[1] + disc);
    }
    this.camera.fit(Math.min(...across) - room, Math.min(...up) - room, Math.max(...across) + room, Math.max(...up) + room);
    this.#touch();
  }

  /** A gesture moved the camera: stop following. */
  #touched() {
    if (this.follows) this.follow(false);
    this.#touch();
  }

  /** @param {number} px @param {number} py @param {boolean} ended @param {boolean} began */
  #measured(px, py, ended, began) {
    if (!this.ruling) return false;
    const here = this.camera.toGround(px, py);
    if (began) this.ruler = [here];
    else if (this.ruler.length && !ended) this.ruler = [this.ruler[0], here];
    this.#touch();
    return true;
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const target = /** @type {Element | null} */ (event.target instanceof Element ? event.target : null);
    const typing = target?.closest("select, textarea, dialog, input:not([type=range], [type=checkbox])");
    if (typing || event.ctrlKey || event.metaKey || event.altKey) return;
    const space = event.key === " " && !target?.closest("button, summary, input");
    const action = space ? () => this.play(!this.playing) : this.#keys[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  /** @type {Record<string, () => void>} */
  #keys = {
    ArrowLeft: () => this.step(-1),
    ArrowRight: () => this.step(1),
    ",": () => this.step(-FRAME),
    ".": () => this.step(FRAME),
    Home: () => this.jump(this.scene.start),
    End: () => this.jump(this.scene.end),
    p: () => this.#event(-1),
    n: () => this.#event(1),
    "+": () => this.zoom(1.4),
    "=": () => this.zoom(1.4),
    "-": () => this.zoom(1 / 1.4),
    0: () => this.fit(),
    "[": () => this.choose(Math.max(this.chosen - 1, 0)),
    "]": () => this.choose(this.chosen + 1),
    f: () => this.follow(!this.follows),
    t: () => { this.look.trails = !this.look.trails; this.#touch(); },
    r: () => this.rule(!this.ruling),
    c: () => this.paintBy(KINDS[(KINDS.indexOf(this.kind) + 1) % KINDS.length]),
    Escape: () => this.choose(-1),
  };

  /** Something changed: draw at the next turn of the loop. */
  #touch() {
    this.#painted = -1;
  }

  /** Time that is on the canvas, or -1. */
  #painted = -1;
  #before = 0;

  /** One turn of the loop. @param {number} now ms */
  #turn(now) {
    const passed = Math.min((now - this.#before) / 1000, LONGEST_TURN);
    if (this.playing) this.#advance(passed, now);
    if (this.#painted !== this.time || this.playing) {
      const began = performance.now();
      this.#draw();
      this.frameTimes.push(performance.now() - began);
      if (this.frameTimes.length > TIMES_KEPT) this.frameTimes.shift();
    }
    this.#before = now;
    requestAnimationFrame((next) => this.#turn(next));
  }

  #stillSince = 0;

  /** @param {number} passed s @param {number} now ms */
  #advance(passed, now) {
    let seconds = passed * this.speed;
    if (this.still.matches) {
      // A picture a second instead of motion.
      if (now - this.#stillSince < 1000) return;
      this.#stillSince = now;
      seconds = this.speed;
    }
    this.time += seconds;
    if (this.time >= this.scene.end) {
      this.time = this.scene.end;
      this.play(false);
    }
    if (now - this.spokenAt > SPOKEN_EACH) this.#say(now);
  }

  #pose() {
    this.scene.stand(this.time, this.stand);
    this.boxes.place(this.stand);
  }

  #draw() {
    this.#pose();
    const reach = this.scene.sent.nearest.reach;
    this.tightest = this.boxes.measure(reach);
    if (this.follows) {
      const bench = Math.max(this.chosen, 0);
      [this.camera.x, this.camera.y] = [this.boxes.x[bench], this.boxes.y[bench]];
    }
    const scale = scaleOf(this.kind, this.scene, this.stand, this.boxes);
    const { scene, stand, boxes, camera, chosen, ruler, tightest } = this;
    this.painter.paint({ scene, stand, boxes, camera, chosen, ruler, tightest, scale, ...this.look });
    this.#painted = this.time;
    this.axis.show(this.time);
    this.clock.textContent = `t = ${clock(this.time, 2)}`;
    this.tight.textContent = tightestText(tightest, reach);
    this.card.show(stand, boxes, chosen);
    this.#showLegend(scale);
    this.root.dataset.time = this.time.toFixed(3);
  }

  #legendOf = "";

  /** @param {import("./colours.js").Scale | null} scale */
  #showLegend(scale) {
    const [low, high] = scale ? endTexts(scale) : ["", ""];
    const text = scale ? `${language()} ${scale.name} ${low} ${high}` : "";
    this.legend.hidden = !scale;
    if (!scale || (this.#legendOf === text && this.legend.childElementCount)) return;
    this.#legendOf = text;
    const strip = make("div", { class: "strip" });
    strip.style.background = `linear-gradient(to right, ${scale.colours.join(", ")})`;
    this.legend.replaceChildren(make("span", {}, scale.name), strip, make("span", { class: "ends" }, make("span", {}, low), make("span", {}, high)));
  }

  /** Tell what the canvas shows to those who cannot see it. @param {number} now ms */
  #say(now) {
    this.spokenAt = now;
    const reach = this.scene.sent.nearest.reach;
    const text = `t = ${clock(this.time)}. ${tightestText(this.boxes.measure(reach), reach)}`;
    this.painter.canvas.setAttribute("aria-label", `${_("the dragon from above")}: ${text}`);
    this.spoken.textContent = text;
  }

  /** The page came to rest: tell it, and put it into the address. */
  #settled() {
    this.#pose();
    this.#say(performance.now());
    this.onSettled?.(this.time, this.chosen);
  }

  /** Called when the page has come to rest. @type {((time: number, bench: number) => void) | undefined} */
  onSettled;
}

/** @param {HTMLElement} label @param {boolean} on */
function ticked(label, on) {
  const box = label.querySelector("input");
  if (box) box.checked = on;
}

/** @param {import("./nearness.js").Pair | null} pair @param {number} reach */
function tightestText(pair, reach) {
  if (!pair) return _("all benches more than {reach} apart", { reach: shortLength(reach) });
  const benches = { a: pair.i + 1, b: pair.j + 1 };
  if (pair.distance <= 0) return _("benches {a} and {b} touch", benches);
  return _("tightest {gap}: benches {a} and {b}", { gap: shortLength(pair.distance), ...benches });
}
