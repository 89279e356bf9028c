// Buttons that send the dance on the page: as a page of its own, or in other ways.

import { chatPicture } from "./chat_picture.js";
import { make, textButton } from "./elements.js";
import { linkText } from "./link.js";
import { planName } from "./names.js";
import { sentPage } from "./sent_page.js";
import { sendFile, showShare } from "./share.js";
import { _, language } from "./words.js";

/** @typedef {import("./planner.js").Planner} Planner */

/** Those buttons, in the language in use. @param {Planner} planner */
export function sendButtons(planner) {
  const told = make("output", { class: "told" });
  return [
    textButton(_("send this dance"), () => send(planner, told)),
    textButton(_("share"), () => share(planner)),
    told,
  ];
}

/** What the dance is called. @param {Planner} planner */
function titleOf({ player }) {
  return player?.scene.sent.title[language()] || _("Bench dragon planner");
}

/** The dance as the page shows it. @param {Planner} planner */
function pictureOf({ player }) {
  return player?.face.canvas ?? document.createElement("canvas");
}

/** Send the dance as this page with the plan in it. @param {Planner} planner @param {HTMLElement} told where it is said how it went */
function send(planner, told) {
  sendFile(sentPage(planner.plan, titleOf(planner), pictureOf(planner).toDataURL()), told);
}

/** Show other ways in which the plan is sent to others. @param {Planner} planner */
async function share(planner) {
  const { plan, presets, answers, root } = planner;
  const without = _("This dance is too long for a code: ask who sent this for its file.");
  const [name, title, canvas] = [planName(plan), titleOf(planner), pictureOf(planner)];
  showShare(root, await linkText(plan, presets), {
    plan: () => answers.saved(plan),
    picture: (code, words) => chatPicture({ name, title, canvas, code, words, without }),
  });
}
