// How far long work is, in stages: the twin of progress.py.

/** @typedef {import("./tick.js").Progress} Progress */

/**
 * The progress of a part of the work, from one share of the whole to another.
 * @param {Progress} progress
 * @param {number} start @param {number} end
 * @param {string} text what is said while the part itself says nothing
 * @returns {Progress}
 */
export function part(progress, start, end, text = "") {
  return (share, said) => progress(start + (end - start) * share, said || text);
}

/**
 * Work in so many stages, each taken to last as long as the others: begins the next, and gives its
 * progress.
 * @param {Progress} progress
 * @param {number} count
 */
export function stages(progress, count) {
  let done = 0;
  return (/** @type {string} */ text) => {
    const stage = part(progress, done / count, (done + 1) / count, text);
    done++;
    stage(0, "");
    return stage;
  };
}
