// What keys do in the player.

import { chosenBefore, keepChoice } from "./address.js";
import { FRAME } from "./axis.js";
import { KINDS } from "./colours.js";

/** @typedef {import("./player.js").Player} Player */
/** @typedef {import("./story.js").Story} Story */

/** @type {Record<string, (player: Player) => void>} */
const KEYS = {
  ArrowLeft: (player) => player.step(-1),
  ArrowRight: (player) => player.step(1),
  ",": (player) => player.step(-FRAME),
  ".": (player) => player.step(FRAME),
  Home: (player) => player.jump(player.scene.start),
  End: (player) => player.jump(player.scene.end),
  p: (player) => player.event(-1),
  n: (player) => player.event(1),
  "+": (player) => player.zoom(1.4),
  "=": (player) => player.zoom(1.4),
  "-": (player) => player.zoom(1 / 1.4),
  0: (player) => player.fit(),
  "[": (player) => player.choose(Math.max(player.chosen - 1, 0)),
  "]": (player) => player.choose(player.chosen + 1),
  f: (player) => player.follow(!player.follows),
  d: (player) => player.see("dressed", !player.look.dressed),
  t: (player) => player.see("trails", !player.look.trails),
  r: (player) => player.rule(!player.ruling),
  b: (player) => player.beat(!player.drum.on),
  c: (player) => player.paintBy(KINDS[(KINDS.indexOf(player.kind) + 1) % KINDS.length]),
  Escape: (player) => player.choose(-1),
};

/** What keys do while a story is told. @type {Record<string, (story: Story) => void>} */
const STORY_KEYS = {
  ArrowLeft: (story) => story.go(story.at - 1),
  ArrowRight: (story) => story.go(story.at + 1),
  " ": (story) => story.pause(),
  Escape: (story) => story.end(),
};

/** Whether letters, digits and signs are keys; arrows and other keys that write nothing always are. */
export function lettersAreKeys() {
  return chosenBefore("keys") !== "off";
}

/** @param {boolean} on */
export function useLetters(on) {
  keepChoice("keys", on ? "on" : "off");
}

/** Do what a key is for, unless it is meant for something else. @param {Player} player @param {KeyboardEvent} event */
export function pressed(player, event) {
  const target = event.target instanceof Element ? event.target : null;
  const typing = target?.closest("select, textarea, dialog, input:not([type=range], [type=checkbox])");
  const other = target?.closest("input") && !player.root.contains(target); // a slider of the plan
  if (typing || other || event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key.length === 1 && event.key !== " " && !lettersAreKeys()) return;
  const space = event.key === " " && !target?.closest("button, summary, input");
  const { story } = player.face;
  if (story.open && STORY_KEYS[event.key] && (space || event.key !== " ")) STORY_KEYS[event.key](story);
  else if (space) player.play(!player.playing);
  else if (KEYS[event.key]) KEYS[event.key](player);
  else return;
  event.preventDefault();
}
