// The drum of a dance, by rule: twin of analysis/beats.py.

/** @typedef {import("./plan.js").Plan} Plan */
/** @typedef {import("../messages").Run} Run even beats: see analysis/beats.py */

// A tempo that is derived from the head's speed is kept within these, beats a minute.
const [SLOWEST_BEAT, FASTEST_BEAT] = [20, 400];

/** The head's usual speed, m/s. @param {Plan} plan @returns {number} */
function usualPace({ tables: { walk } }) {
  /** @type {Array<[number, number]>} */
  const profile = walk.profile;
  return profile.length ? Math.max(...profile.map(([, speed]) => speed)) : walk.speed;
}

/**
 * The beats of a plan's dance over a span, s: `score_of`.
 * @param {Plan} plan
 * @param {number} start
 * @param {number} end
 */
export function scoreOf(plan, start, end) {
  const { bar, tempo: said } = plan.tables.cues;
  const byStep = (60 * usualPace(plan)) / plan.tables.people.step;
  const tempo = said ?? Math.min(Math.max(byStep, SLOWEST_BEAT), FASTEST_BEAT);
  /** @type {Run[]} */
  const runs = [];
  let [since, period, still] = [start, 60 / tempo, 0];
  const upTo = (/** @type {number} */ until) => {
    if (since >= until) return;
    const counted = Math.min(bar, Math.floor(still / period));
    if (counted) runs.push({ start: since - counted * period, end: since, period, bar, counted: true });
    runs.push({ start: since, end: until, period, bar, counted: false });
    still = 0;
  };
  const moments = plan.moments().filter(({ time }) => start <= time && time <= end);
  for (const { cue, time, until } of moments) {
    if (cue.kind === "tempo" && cue.tempo !== null) {
      upTo(time);
      [period, since] = [60 / cue.tempo, Math.max(time, since)];
    } else if (until > time) {
      upTo(time);
      [since, still] = [Math.min(until, end), until - time];
    }
  }
  upTo(end);
  const strokes = moments.filter(({ cue }) => cue.kind !== "note").map(({ time }) => time);
  return { tempo, byStep: said === null, runs, strokes: [...new Set(strokes)] };
}
