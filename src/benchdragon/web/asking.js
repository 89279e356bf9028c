// Questions to the studio's server.

import { Refusal, mayPass, noteHash } from "./standing.js";
import { unpackedScene } from "./scene.js";
import { _, language } from "./words.js";

/** @typedef {import("./messages").JobState} JobState */
/** @typedef {import("./messages").JobTaken} JobTaken */
/** @typedef {import("./messages").Preset} Preset */
/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./standing.js").Answers} Answers */
/** @typedef {import("./standing.js").MadeFile} MadeFile */

/** A name that nobody guesses; `crypto.randomUUID` is for addresses with https alone. */
function freshName() {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
}

/** This page, to the server: its newer questions replace its older ones. */
const CLIENT = freshName();

/** Who asks long questions: this tab, also after the page was loaded again, where the browser keeps anything. */
function holder() {
  const key = "benchdragon-client";
  try {
    const name = sessionStorage.getItem(key) ?? CLIENT;
    sessionStorage.setItem(key, name);
    return name;
  } catch (error) {
    if (error instanceof DOMException) return CLIENT;
    throw error;
  }
}
const HOLDER = holder();

/**
 * Ask, and get the response.
 * @param {string} path
 * @param {{plan?: Plan} & Record<string, any> | null} body null: nothing is sent
 * @param {{method?: string, signal?: AbortSignal}} [options]
 * @throws {Refusal}
 */
async function asked(path, body, { method = body ? "POST" : "GET", signal } = {}) {
  const client = path.startsWith("/api/jobs") ? HOLDER : CLIENT;
  const sent = body === null ? null : JSON.stringify(body);
  const response = await fetch(`${path}?lang=${language()}`, {
    method,
    headers: { "Content-Type": "application/json", "X-Client": client },
    body: sent,
    signal: signal ?? null,
  }).catch((error) => {
    if (error.name === "AbortError") throw error;
    throw new Refusal(0, _("The studio does not answer: {error}", { error: error.message }));
  });
  if (body?.plan) noteHash(body.plan, response.headers.get("X-Plan-SHA256"));
  if (response.ok) return response;
  const problem = await response.json().catch(() => ({}));
  throw new Refusal(response.status, problem.error ?? `${response.status} ${response.statusText}`);
}

/** How often a running question is looked at, ms. */
const LOOK_EACH = 400;

/** @param {number} time ms */
function pause(time) {
  return new Promise((done) => setTimeout(done, time));
}

/**
 * What the server says of long questions; asked until it answers.
 * @param {string} path
 * @param {(error: Error) => void} told of each time it does not
 * @throws {Refusal} where it knows of no such question any more
 */
async function heard(path, told) {
  for (;;) {
    try {
      return await (await asked(path, null)).json();
    } catch (error) {
      if (!mayPass(error)) throw error;
      told(error);
    }
    await pause(5 * LOOK_EACH);
  }
}

/** A long question that the server took on. */
class ServerJob {
  /** @param {string} id @param {Plan} plan */
  constructor(id, plan) {
    this.id = id;
    this.plan = plan;
  }

  /**
   * @param {(state: JobState) => void} told
   * @param {(error: Error) => void} troubled
   * @returns {Promise<JobState>}
   */
  async follow(told, troubled) {
    for (;;) {
      /** @type {JobState} */
      const job = await heard(`/api/jobs/${this.id}`, troubled);
      noteHash(this.plan, job.plan_sha256);
      told(job);
      if (!["waiting", "running"].includes(job.state)) return job;
      await pause(LOOK_EACH);
    }
  }

  /** Where the server does not hear it, the next look says so. */
  cancel() {
    asked(`/api/jobs/${this.id}`, null, { method: "DELETE" }).catch(() => null);
  }

  /** Or it is forgotten later. */
  forget() {
    this.cancel();
  }
}

/** @param {Response} response @returns {Promise<MadeFile>} */
async function madeFile(response) {
  const told = response.headers.get("Content-Disposition") ?? "";
  return { name: /filename="([^"]+)"/.exec(told)?.[1] ?? "benchdragon", data: await response.blob() };
}

/** The studio's server as who answers. @implements {Answers} */
export class ServerAnswers {
  /** It answers all. */
  has() {
    return true;
  }

  /** @param {string} question @param {Plan} plan @param {AbortSignal} signal */
  async ask(question, plan, signal) {
    return (await asked(`/api/${question}`, { plan }, { signal })).json();
  }

  /** @param {Plan} plan @param {AbortSignal} signal */
  async scene(plan, signal) {
    return unpackedScene({ ...(await this.ask("dance", plan, signal)), verdict: null });
  }

  /** @param {string} text @returns {Promise<Plan>} */
  async opened(text) {
    return (await (await asked("/api/plan", { toml: text })).json()).plan;
  }

  /** @param {Plan} plan */
  async saved(plan) {
    return madeFile(await asked("/api/toml", { plan }));
  }

  /** @param {string} kind @param {Plan} plan */
  async exported(kind, plan) {
    return madeFile(await asked(`/api/export/${kind}`, { plan, lang: language() }));
  }

  /** @param {JobState["question"]} question @param {Plan} plan */
  async long(question, plan) {
    const { id } = await (await asked("/api/jobs", { plan, question })).json();
    return new ServerJob(id, plan);
  }

  async taken() {
    /** @type {JobTaken[]} */
    const taken = await heard("/api/jobs", () => {});
    return taken.map(({ id, question, plan, plan_sha256: hash }) => {
      noteHash(plan, hash);
      return { question, plan, long: new ServerJob(id, plan) };
    });
  }

  /** @returns {Promise<Record<string, string>>} */
  async words() {
    return (await asked("/api/words", null)).json();
  }

  /** @returns {Promise<Preset[]>} */
  async presets() {
    return (await asked("/api/presets", null)).json();
  }
}
