// The player page: reads the dance that the page holds, and the address.

import { Player } from "./player.js";
import { unpackedScene } from "./scene.js";
import { _, speak, useWords } from "./words.js";

/** What an inert script element of the page holds. @param {string} id */
export function held(id) {
  return JSON.parse(/** @type {HTMLElement} */ (document.getElementById(id)).textContent ?? "");
}

/** Time and bench in an address such as #t=192&bench=37; null where it does not say. */
export function addressed() {
  const values = new URLSearchParams(location.hash.slice(1));
  const number = (/** @type {string} */ name) =>
    Number.isFinite(Number.parseFloat(values.get(name) ?? ""))
      ? Number.parseFloat(values.get(name) ?? "")
      : null;
  return { time: number("t"), bench: number("bench") };
}

/** Go where the address says. @param {Player} player */
function obey(player) {
  const { time, bench } = addressed();
  if (bench !== null) player.choose(Math.round(bench) - 1);
  if (time !== null) player.jump(time);
}

/** Put time and bench into the address. @param {number} time @param {number} bench */
function remember(time, bench) {
  if (location.protocol === "about:") return; // inside a notebook the page has no address
  const values = new URLSearchParams(location.hash.slice(1));
  values.set("t", String(Number(time.toFixed(3))));
  if (bench >= 0) values.set("bench", String(bench + 1));
  else values.delete("bench");
  history.replaceState(null, "", `#${values}`);
}

/** Show the dance that the page holds. */
export async function start() {
  useWords(held("words"));
  speak(held("language"));
  const root = /** @type {HTMLElement} */ (document.getElementById("player"));
  if (typeof DecompressionStream === "undefined") {
    root.textContent = _("This browser is too old to show the dance: it takes one of 2023 or newer.");
    return;
  }
  const scene = await unpackedScene(held("dance")).catch(() => null);
  if (!scene) {
    root.textContent = _("This file is damaged: the dance in it cannot be read.");
    return;
  }
  const player = new Player(root, scene);
  obey(player);
  player.onSettled = remember;
  addEventListener("hashchange", () => obey(player));
  Object.assign(globalThis, { benchdragon: player }); // for the browser's console
}
