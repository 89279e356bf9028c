// How a plan is sent to others: a link with a QR code, where the page has an address; else its file.

import { drawnCode } from "./code.js";
import { copy } from "./commands.js";
import { make } from "./elements.js";
import { deliver } from "./files.js";
import { _ } from "./words.js";

/** @typedef {import("./standing.js").MadeFile} MadeFile */

/** The largest kind of QR code that is shown: 97 squares on a side, of nearly 3 CSS pixels on a small phone. */
const MOST_VERSION = 20;
/** Of machines that nobody else reaches under these names. */
const OWN = ["localhost", "127.0.0.1", "[::1]"];

/** Whether others find the page under its address. */
function onTheWeb() {
  return ["http:", "https:"].includes(location.protocol) && !OWN.includes(location.hostname);
}

/**
 * Show how the plan is sent.
 * @param {HTMLElement} root
 * @param {string} text the plan as an address holds it
 * @param {() => Promise<MadeFile>} saved its file
 */
export function showShare(root, text, saved) {
  const dialog = make("dialog", {
    class: "share",
    "aria-label": _("share"),
    onclose: () => dialog.remove(),
  });
  const told = make("output", { class: "told" });
  const web = onTheWeb();
  const link = `${web ? location.href.split("#")[0] : ""}#plan=${text}`;
  const shown = make("code", { tabindex: "0" }, link);
  const button = (/** @type {string} */ name, /** @type {() => void} */ action) =>
    make("button", { type: "button", onclick: action }, name);
  const buttons = [
    button(_("copy"), async () => {
      await copy(link, shown);
      told.textContent = _("copied");
    }),
  ];
  if (web && "share" in navigator)
    buttons.push(button(_("send ..."), () => send({ title: document.title, url: link }, told)));
  dialog.append(
    make("h2", {}, _("Share this plan")),
    ...(web ? linkWords(link, shown) : fileWords(shown)),
    make("div", { class: "row" }, ...buttons, ...(web ? [] : [fileButton(saved, told)])),
    told,
    make(
      "p",
      {},
      button(_("close"), () => dialog.close()),
    ),
  );
  root.append(dialog);
  dialog.showModal();
}

/** @param {string} link @param {HTMLElement} shown */
function linkWords(link, shown) {
  const code = drawnCode(link, "L", MOST_VERSION, _("QR code of the link"));
  const tooLong = _(
    "This link has {length} letters: too many for a QR code that phones read. Copy it, or send the plan file.",
    { length: link.length },
  );
  return [
    make("p", {}, _("This link opens the plan in this page.")),
    shown,
    code ?? make("p", { class: "source" }, tooLong),
  ];
}

/** @param {HTMLElement} shown */
function fileWords(shown) {
  const why = _(
    "This page was opened from a file or on this machine alone: it has no web address, and no link leads others to it. Send the plan file instead.",
  );
  const how = _(
    "Who has the planner's page can also put this at the end of its address, which then opens the plan:",
  );
  return [make("p", {}, why), make("p", {}, how), shown];
}

/** A button that sends the plan's file where the system can, and else saves it. @param {() => Promise<MadeFile>} saved @param {HTMLElement} told */
function fileButton(saved, told) {
  const button = make("button", { type: "button", disabled: true }, _("plan file"));
  // Made beforehand: systems share only at once after a tap.
  saved().then(
    (made) => {
      const file = new File([made.data], made.name, { type: made.data.type });
      const sends = navigator.canShare?.({ files: [file] }) ?? false;
      button.textContent = sends ? _("send the plan file ...") : _("save the plan file");
      button.disabled = false;
      button.addEventListener("click", () => {
        if (sends) send({ files: [file] }, told);
        else told.textContent = deliver(made);
      });
    },
    (error) => {
      told.textContent = error.message;
    },
  );
  return button;
}

/** Have the system send something. @param {ShareData} what @param {HTMLElement} told */
async function send(what, told) {
  try {
    await navigator.share(what);
  } catch (error) {
    if (!(error instanceof DOMException)) throw error;
    if (error.name !== "AbortError") told.textContent = error.message; // AbortError: they thought better of it
  }
}
