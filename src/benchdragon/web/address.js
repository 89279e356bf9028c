// The page's address: where the player stands, and what else a page keeps in it.

/** @typedef {import("./player.js").Player} Player */

/** The address as this page read or wrote it last; another one was just put into the window, and its event is on its way. */
let known = globalThis.location?.hash;
globalThis.addEventListener?.("hashchange", () => {
  known = location.hash;
});

/** What stands in an address such as #t=192&bench=37. */
export function addressed() {
  return new URLSearchParams(location.hash.slice(1));
}

/** Go where the address says; what it does not say as a number is left as it is. @param {Player} player */
export function obey(player) {
  const values = addressed();
  const [bench, time] = ["bench", "t"].map((name) => Number.parseFloat(values.get(name) ?? ""));
  if (Number.isFinite(time)) player.jump(time);
  if (!Number.isFinite(bench)) return;
  player.choose(Math.round(bench) - 1);
  if (!values.has("t")) player.follow(true); // as the code on a bench's sheet says it
}

/** Put time and bench into the address, and more, unless another address arrives just now. @param {Player | null} player @param {Record<string, string>} [more] */
export function remember(player, more = {}) {
  if (location.protocol === "about:") return; // inside a notebook the page has no address
  if (location.hash !== known) return;
  const values = addressed();
  for (const [name, value] of Object.entries(more)) values.set(name, value);
  if (player) {
    values.set("t", String(Number(player.time.toFixed(3))));
    if (player.chosen >= 0) values.set("bench", String(player.chosen + 1));
    else values.delete("bench");
  }
  history.replaceState(null, "", `#${values}`);
  known = location.hash;
}

/** What a person chooses once: the language, the theme, how benches are drawn, whether letters are keys, the bench that one carries. @typedef {"lang" | "theme" | "drawn" | "keys" | "mine"} Choice */

/** What a person chose before: as the address says it, else the browser; null: nothing. @param {Choice} name */
export function chosenBefore(name) {
  return addressed().get(name) ?? stored(name);
}

/** Keep what a person chose: in the browser if it lets us, else in the address; where the address says it, there too. @param {Choice} name @param {string} value */
export function keepChoice(name, value) {
  if (!store(name, value) || addressed().has(name)) remember(null, { [name]: value });
}

/** @param {string} name */
function stored(name) {
  try {
    return localStorage.getItem(`benchdragon.${name}`);
  } catch {
    return null; // a browser that keeps nothing throws, even when asked what it has
  }
}

/** Whether the browser keeps a value; null: it is to keep none. @param {string} name @param {string | null} value */
function store(name, value) {
  try {
    if (value === null) localStorage.removeItem(`benchdragon.${name}`);
    else localStorage.setItem(`benchdragon.${name}`, value);
    return true;
  } catch {
    return false; // see above; or it is full
  }
}

/** What the browser keeps of somebody's own, as text: a plan, a list of names; null if it keeps none. @param {"plan" | "names"} what */
export function kept(what) {
  return stored(what);
}

/** Have the browser keep something, or no more of it; whether it does. @param {"plan" | "names"} what @param {string | null} text */
export function keep(what, text) {
  return store(what, text);
}
