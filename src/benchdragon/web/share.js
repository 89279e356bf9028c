// How a plan is sent to others: a link with a QR code, where the page has an address, else its letters; a picture; files.

import { drawnCode } from "./code.js";
import { copy } from "./commands.js";
import { make, textButton } from "./elements.js";
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

/** Files of what is sent, as they are made. @typedef {object} Makers
 * @property {() => Promise<MadeFile>} plan the plan's own
 * @property {(code: string, words: string) => Promise<MadeFile>} picture for chats: `code` is what its code holds */

/**
 * Show other ways to send the plan than as a page.
 * @param {HTMLElement} root
 * @param {string} text the plan as an address holds it
 * @param {Makers} makers
 */
export function showShare(root, text, makers) {
  const dialog = make("dialog", {
    class: "share",
    "aria-label": _("share"),
    onclose: () => dialog.remove(),
  });
  const told = make("output", { class: "told" });
  const web = onTheWeb();
  const link = `${web ? location.href.split("#")[0] : ""}#plan=${text}`;
  const shown = make("code", { tabindex: "0" }, link);
  const buttons = [
    textButton(_("copy"), async () => {
      await copy(link, shown);
      told.textContent = _("copied");
    }),
  ];
  if (web && "share" in navigator)
    buttons.push(textButton(_("send ..."), () => send({ title: document.title, url: link }, told)));
  const words = web
    ? _("Scan the code: the dance opens in a browser, and walks.")
    : _("Scan the code, copy its letters, and paste them into the planner's page.");
  const picture = fileButton(makers.picture(link, words), told, {
    wait: _("picture"),
    sends: _("send a picture with a code ..."),
    saves: _("save a picture with a code"),
  });
  const plan = fileButton(makers.plan(), told, {
    wait: _("plan file"),
    sends: _("send the plan file ..."),
    saves: _("save the plan file"),
  });
  const close = textButton(_("close"), () => dialog.close());
  dialog.append(
    make("h2", {}, _("Share this plan")),
    ...(web ? linkWords(link, shown) : fileWords(shown)),
    make("div", { class: "row" }, ...buttons),
    make("div", { class: "row" }, picture, plan),
    told,
    make("p", {}, close),
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
    "This page was opened from a file or on this machine alone: it has no web address, and no link leads others to it.",
  );
  const how = _(
    "These letters hold the plan: who has this page, or a dance that was sent, pastes them anywhere in it.",
  );
  return [make("p", {}, why), make("p", {}, how), shown];
}

/**
 * A button that sends a file where the system can, and else saves it.
 * @param {Promise<MadeFile>} making made beforehand: systems send only at once after a tap
 * @param {HTMLElement} told where it is said how it went
 * @param {{ wait: string, sends: string, saves: string }} names of the button
 */
function fileButton(making, told, { wait, sends, saves }) {
  const button = make("button", { type: "button", disabled: true }, wait);
  making.then(
    (made) => {
      button.textContent = sendable(made) ? sends : saves;
      button.disabled = false;
      button.addEventListener("click", () => sendFile(made, told));
    },
    (error) => {
      told.textContent = error.message;
    },
  );
  return button;
}

/** What a system is asked to send, where it sends such files. @param {MadeFile} made @returns {ShareData | null} */
function sendable({ name, data }) {
  const files = [new File([data], name, { type: data.type })];
  return navigator.canShare?.({ files }) ? { files } : null;
}

/** Have the system send a file, or else the browser save it. @param {MadeFile} made @param {HTMLElement} told */
export async function sendFile(made, told) {
  const what = sendable(made);
  if (what) return send(what, told);
  told.textContent = deliver(made);
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
