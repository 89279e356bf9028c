// The player page: reads the dance that the page holds, and the address.

import { chosenBefore, obey, remember } from "./address.js";
import { held } from "./elements.js";
import { Player } from "./player.js";
import { unpackedScene } from "./scene.js";
import { _, speak, useWords } from "./words.js";

/** Show the dance that the page holds. */
export async function start() {
  useWords(held("words"));
  const chosen = chosenBefore("lang");
  speak(chosen === "en" || chosen === "zh" ? chosen : held("language"));
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
  player.onSettled = () => remember(player);
  addEventListener("hashchange", () => obey(player));
  Object.assign(globalThis, { benchdragon: player }); // for the browser's console
}
