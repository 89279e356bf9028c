// The planner's page: reads what the page holds, and starts what computes.

import { addressed, chosenBefore, kept } from "./address.js";
import { Asking } from "./asking.js";
import { TAP, held } from "./elements.js";
import { readLink } from "./link.js";
import { planText, textPlan } from "./plan_form.js";
import { Planner } from "./planner.js";
import { WorkerAnswers } from "./working.js";
import { _, speak, useWords } from "./words.js";

/** @typedef {import("./messages").Preset} Preset */
/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./standing.js").Answers} Answers */

/** Bytes that were deflated, in base64. @param {string} packed @returns {Promise<ArrayBuffer>} */
function inflated(packed) {
  const squeezed = Uint8Array.from(atob(packed), (sign) => sign.charCodeAt(0));
  const stream = new Blob([squeezed]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Response(stream).arrayBuffer();
}

/**
 * The page on which a dance is planned: with the plan of the address, else with the one given, else with
 * the one that the browser keeps; else it asks for benches and square, beside the first preset.
 * @param {Answers} answers
 * @param {Preset[]} presets
 * @param {Plan | null} plan the one given or kept
 * @param {Asking} asking
 * @param {import("./messages").WantedPapers | null} wanted papers of the plan given
 */
async function opened(answers, presets, plan, asking, wanted) {
  const text = addressed().get("plan");
  const told = text ? await readLink(text, presets) : null;
  const first = told?.plan ?? plan ?? presets[0].plan;
  const planner = new Planner(answers, presets, first, asking);
  if (told && !told.plan) planner.refuse(told.says);
  else planner.show(planner.plan);
  if (!told && !plan) asking.open(true);
  if (wanted && plan && planText(planner.plan) === planText(plan))
    planner.sheets.open(planner.plan, wanted);
  Object.assign(globalThis, { benchdragon: planner }); // for the browser's console
}

/** Mark the page while somebody types into it, and until a tap that ends that has met what it was meant for. @param {HTMLElement} root */
function markTyping(root) {
  const typing = () =>
    document.activeElement?.matches('.panel :is(input[type="text"], textarea)') ?? false;
  root.addEventListener("focusin", () => typing() && root.classList.add("typing"));
  root.addEventListener("focusout", () =>
    setTimeout(() => root.classList.toggle("typing", typing()), TAP),
  );
}

/** Begin the page. */
export async function start() {
  const words = held("words");
  useWords(words);
  const wanted = held("papers");
  // Papers are in the language in which they were asked for.
  const chosen = wanted ? addressed().get("lang") : chosenBefore("lang");
  speak(chosen === "en" || chosen === "zh" ? chosen : held("language"));
  const root = /** @type {HTMLElement} */ (document.getElementById("planner"));
  if (typeof DecompressionStream === "undefined") {
    root.textContent = _("This browser is too old to show the dance: it takes one of 2023 or newer.");
    return;
  }
  const asking = new Asking(root);
  const given = held("plan");
  const plan = given ?? textPlan(kept("plan") ?? "");
  if (addressed().has("plan") || plan !== given)
    root.querySelector(".look")?.remove(); // of another
  else if (!plan) asking.open(true);
  try {
    const engine = await WebAssembly.compile(await inflated(held("engine")));
    const script = new Blob([await inflated(held("worker"))], { type: "text/javascript" });
    const answers = new WorkerAnswers(URL.createObjectURL(script), {
      engine,
      words,
      version: held("version"),
    });
    await answers.start();
    markTyping(root);
    await opened(answers, held("presets"), plan, asking, wanted);
  } catch (error) {
    if (!(error instanceof Error)) throw error;
    root.textContent = error.message;
  }
}
