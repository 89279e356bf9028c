// Elements of the page, made in one line each.

/** What a tap takes from leaving a box to its click, at most, ms: nothing may come under the finger before. */
export const TAP = 350;

/**
 * An element with attributes and children; `on…` attributes are listeners.
 * @template {keyof HTMLElementTagNameMap} Tag
 * @param {Tag} tag
 * @param {Record<string, string | boolean | ((event: Event) => void)>} attributes
 * @param {(Node | string)[]} children
 * @returns {HTMLElementTagNameMap[Tag]}
 */
export function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name.slice(2), value);
    else if (typeof value === "boolean") element.toggleAttribute(name, value);
    else element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

/** A button outside of forms, and what it does. @param {Node | string} shown on it @param {() => void} action @param {Record<string, string | boolean>} [attributes] */
export function textButton(shown, action, attributes = {}) {
  return make("button", { type: "button", onclick: action, ...attributes }, shown);
}

/**
 * A button with a sign on it and a name for those who cannot see it.
 * @param {Node | string} sign
 * @param {string} name
 * @param {() => void} action
 * @param {Record<string, string>} [attributes]
 */
export function signButton(sign, name, action, attributes = {}) {
  return textButton(sign, action, { title: name, "aria-label": name, ...attributes });
}

/**
 * A button with a word on it, which its name holds too, for those who say what they press.
 * @param {string} word
 * @param {string} name
 * @param {() => void} action
 */
export function wordButton(word, name, action) {
  return signButton(word, name, action, { "aria-label": `${word}: ${name}` });
}

/**
 * An element of a drawing.
 * @template {keyof SVGElementTagNameMap} Tag
 * @param {Tag} tag
 * @param {Record<string, string>} attributes
 * @param {Node[]} children
 * @returns {SVGElementTagNameMap[Tag]}
 */
export function draw(tag, attributes, ...children) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

/**
 * A sign drawn as a path in a square of 24, for those that fonts may lack.
 * @param {string} path
 */
export function drawnSign(path) {
  const about = { viewBox: "0 0 24 24", class: "sign", "aria-hidden": "true" };
  return draw("svg", about, draw("path", { d: path }));
}

/**
 * A choice from a list.
 * @param {string} name
 * @param {[string, string][]} options value and text of each
 * @param {string} chosen
 * @param {(value: string) => void} action
 */
export function choice(name, options, chosen, action) {
  const select = make("select", { "aria-label": name, onchange: () => action(select.value) });
  for (const [value, text] of options)
    select.append(make("option", { value, selected: value === chosen }, text));
  return select;
}

/**
 * A box to tick.
 * @param {string} name
 * @param {boolean} on
 * @param {(on: boolean) => void} action
 */
export function tick(name, on, action) {
  const box = make("input", { type: "checkbox", checked: on, onchange: () => action(box.checked) });
  return make("label", { class: "tick" }, box, name);
}

/**
 * A table: what its columns are called, and its rows, whose first cells name them where they are `named`.
 * @param {string[]} heads
 * @param {(Node | string)[][]} rows
 * @param {{ kind?: string, name?: string, named?: boolean }} [how] its class, and what stands above it
 */
export function table(heads, rows, { kind = "", name = "", named = false } = {}) {
  const cell = (/** @type {Node | string} */ shown, /** @type {number} */ n) =>
    named && n === 0 ? make("th", { scope: "row" }, shown) : make("td", {}, shown);
  const row = (/** @type {(Node | string)[]} */ cells) => make("tr", {}, ...cells.map(cell));
  const head = make("tr", {}, ...heads.map((text) => make("th", { scope: "col" }, text)));
  const parts = [make("thead", {}, head), make("tbody", {}, ...rows.map(row))];
  const above = name ? [make("caption", {}, name)] : [];
  return make("table", kind ? { class: kind } : {}, ...above, ...parts);
}

/** What takes a file, each time that one is chosen. @param {(file: File) => void} take @param {Record<string, string>} [attributes] */
export function fileInput(take, attributes = {}) {
  const input = make("input", { type: "file", hidden: true, ...attributes });
  input.addEventListener("change", () => {
    const file = input.files?.[0];
    input.value = ""; // so that the same may be chosen again
    if (file) take(file);
  });
  return input;
}

/** What an inert script element of the page holds. @param {string} id */
export function held(id) {
  return JSON.parse(/** @type {HTMLElement} */ (document.getElementById(id)).textContent ?? "");
}
