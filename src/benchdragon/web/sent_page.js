// This page as a file to be sent: it opens with a plan in it, and its dance walks at once.

import { make } from "./elements.js";
import { planName } from "./names.js";
import { language } from "./words.js";

/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./standing.js").MadeFile} MadeFile */

/** What such a page says where nothing runs it: as it stood in this one at first. */
const WAITING = [...document.querySelectorAll(".waiting")];
/** What of the page a file keeps as it is; all else was made by its script. */
const KEPT = "script, template";

/** Data that may stand in an element of a script. @param {string} json */
function inert(json) {
  return json.replaceAll("<", "\\u003c");
}

/**
 * The page with a plan in it.
 * @param {Plan} plan
 * @param {string} title
 * @param {string} picture the address of what is seen until it walks
 * @returns {MadeFile}
 */
export function sentPage(plan, title, picture) {
  const page = /** @type {HTMLElement} */ (document.documentElement.cloneNode(true));
  const part = (/** @type {string} */ name) => /** @type {HTMLElement} */ (page.querySelector(name));
  const look = make("section", { class: "look" }, make("img", { src: picture, alt: title }));
  const waiting = WAITING.map((one) => one.cloneNode(true));
  const root = make("div", { id: "planner", class: "planner", "data-opens": "walking" });
  root.append(look, ...waiting);
  const kept = [...part("body").children].filter((one) => one.matches(KEPT));
  part("body").replaceChildren(root, ...kept);
  part("body").removeAttribute("class");
  part("title").textContent = title;
  part("#plan").textContent = inert(JSON.stringify(plan));
  part("#papers").textContent = "null"; // which may have names in it
  part("#language").textContent = inert(JSON.stringify(language()));
  delete page.dataset.theme;
  const text = `<!DOCTYPE html>\n${page.outerHTML}\n`;
  return { name: `${planName(plan)}.html`, data: new Blob([text], { type: "text/html" }) };
}
