// What explains the page: the list of keys, and the legend of what is drawn.

import { SIGNS } from "./axis.js";
import { draw, make, textButton, tick } from "./elements.js";
import { lettersAreKeys, useLetters } from "./keys.js";
import { _, shortLength } from "./words.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {[Node | string, string]} Row a sign, and what it means */

/** Show a dialog of rows. @param {HTMLElement} root @param {string} name @param {Row[]} rows @param {Node[]} more */
function showRows(root, name, rows, more = []) {
  const close = textButton(_("close"), () => dialog.close());
  const dialog = make(
    "dialog",
    { "aria-label": name, onclose: () => dialog.remove() },
    make("h2", {}, name),
    make(
      "table",
      {},
      ...rows.map(([sign, text]) =>
        make(
          "tr",
          {},
          typeof sign === "string"
            ? make("th", { scope: "row" }, sign)
            : make("td", { class: "sign" }, sign),
          make("td", {}, text),
        ),
      ),
    ),
    ...more,
    make("p", {}, close),
  );
  root.append(dialog);
  dialog.showModal();
}

/** @param {HTMLElement} root @param {Scene} scene @param {[string, string][]} more keys of the page's own */
export function showKeys(root, { sent }, more) {
  const rows = /** @type {Row[]} */ ([
    [_("space"), _("play or pause")],
    ["\u2190 \u2192", _("one second back or on")],
    [", .", _("one frame back or on")],
    ["p n", _("to the previous or next event")],
    ["+ \u2212 0", _("nearer, farther, show all")],
    ["[ ]", _("the bench before or behind")],
    ["f", _("follow")],
    ["c", _("colour by something else")],
    ["d", _("dragon or plain benches")],
    ["t", _("trails")],
    ["r", _("ruler")],
    ...(sent.beats ? [["b", _("drum beat")]] : []),
    [_("Home, End"), _("to the beginning, to the end")],
    ...more,
    ["Esc", _("close the card")],
  ]);
  const letters = tick(_("letters, digits and signs are keys"), lettersAreKeys(), useLetters);
  showRows(root, _("keys"), rows, [letters]);
}

/** What is drawn in this dance, and what it means. @param {HTMLElement} root @param {Scene} scene */
export function showLegendOf(root, scene) {
  showRows(root, _("What is drawn"), [...pictureRows(scene), ...axisRows(scene)]);
}

/** @param {Scene} scene @returns {Row[]} */
function pictureRows({ sent }) {
  const { disc, obstacles, ground } = sent;
  const kinds = new Set(obstacles.map(({ kind }) => kind));
  const stands = ["circle", "rectangle", "polygon"].some((kind) =>
    kinds.has(/** @type {never} */ (kind)),
  );
  /** @type {[boolean, string, string][]} */
  const rows = [
    [true, "bench-head", _("the head's bench, at true size; it walks ahead")],
    [true, "bench", _("a bench, at true size; its number is written on it or near")],
    [true, "handle", _("a handle: benches pivot about it")],
    [
      true,
      "ring",
      _("the two non-adjacent benches nearest to one another; the label says how far apart they are"),
    ],
    [true, "touch", _("benches that touch: red and hatched")],
    [true, "route", _("the route")],
    [disc !== null, "disc", _("the turning disc")],
    [true, "trail", _("trails: the way of the last 20 seconds")],
    [stands, "obstacle", _("obstacles on the square")],
    [kinds.has("venue"), "venue", _("the edge of the venue")],
    [obstacles.some(({ margin }) => margin > 0), "near", _("no bench may come nearer to it than this")],
    [ground.length > 0, "ground", _("ground that the dance covers")],
  ];
  return rows.filter(([there]) => there).map(([, name, text]) => [sample(name), text]);
}

/** @param {Scene} scene @returns {Row[]} */
function axisRows({ sent: { occasions, margin, nearest } }) {
  const kinds = new Set(occasions.map(({ kind }) => kind));
  /** @type {Record<keyof typeof SIGNS, string>} */
  const names = {
    contact: _("on the time axis: first contact"),
    tightest: _("on the time axis: tightest moment"),
    fastest: _("on the time axis: fastest moment"),
    obstacle: _("on the time axis: a bench and an obstacle"),
    venue: _("on the time axis: a bench and the edge of the venue"),
    cue: _("on the time axis: a cue"),
    joint: _("on the time axis: the head or the tail passes a joint of the route"),
    end: _("on the time axis: from here on the benches cannot follow"),
  };
  const marks = /** @type {(keyof typeof SIGNS)[]} */ (Object.keys(names)).filter((kind) =>
    kinds.has(kind),
  );
  const most = shortLength(nearest.reach);
  return [
    [sample("curve"), _("clearance over time, from 0 below to {most} above", { most })],
    ...(margin > 0
      ? [/** @type {Row} */ ([sample("margin"), _("the clearance that the plan asks for")])]
      : []),
    ...marks.map((kind) => /** @type {Row} */ ([markSign(kind), names[kind]])),
  ];
}

/** @param {keyof typeof SIGNS} kind */
function markSign(kind) {
  return make("span", { class: `mark ${kind}` }, SIGNS[kind]);
}

/** A sample of what the picture shows, whose looks stand in the style sheet. @param {string} name */
function sample(name) {
  const shapes = {
    ring: () => [
      draw("circle", { cx: "22", cy: "12", r: "9" }),
      draw("line", { x1: "19", y1: "12", x2: "25", y2: "12" }),
    ],
    handle: () => [draw("circle", { cx: "22", cy: "12", r: "3" })],
    route: () => [draw("path", { d: "M2 18Q22 -4 42 14" })],
    disc: () => [draw("path", { d: "M2 18Q22 -4 42 14" })],
    trail: () => [draw("path", { d: "M2 18Q22 -4 42 14" })],
    near: () => [draw("path", { d: "M2 18Q22 -4 42 14" })],
    venue: () => [draw("path", { d: "M4 24V4H44" })],
    curve: () => [draw("path", { d: "M0 23V14L12 8L24 16L44 6V23Z" })],
    margin: () => [draw("path", { d: "M0 12H44" })],
  };
  const shape =
    shapes[/** @type {keyof typeof shapes} */ (name)] ?? (() => [draw("path", { d: "M2 6H42V18H2Z" })]);
  const lines = () => [draw("path", { class: "hatch", d: "M8 18L20 6M18 18L30 6M28 18L40 6" })];
  const about = { viewBox: "0 0 44 24", class: `sample ${name}`, "aria-hidden": "true" };
  return draw("svg", about, ...shape(), ...(name === "touch" ? lines() : []));
}
