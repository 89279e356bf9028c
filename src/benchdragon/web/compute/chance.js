// Chances of so many hits in so many trials, and bounds on probabilities: by sums of the binomial distribution,
// where solve/tolerance.py asks SciPy.

const HALVINGS = 80;

/** The probability that so many of `count` trials hit or fewer, if each does with that one. @param {number} hits @param {number} count @param {number} risk */
export function atMost(hits, count, risk) {
  return sumOf(0, hits, count, risk);
}

/** The probability that more than so many hit. @param {number} hits @param {number} count @param {number} risk */
function moreThan(hits, count, risk) {
  return sumOf(hits + 1, count, count, risk);
}

/** The probability of low to high hits. @param {number} low @param {number} high @param {number} count @param {number} risk */
function sumOf(low, high, count, risk) {
  if (risk <= 0 || risk >= 1) return Number(risk <= 0 ? low <= 0 : high >= count);
  const odds = Math.log(risk) - Math.log1p(-risk);
  const logs = [];
  for (let k = 0, log = count * Math.log1p(-risk); k <= high; k++) {
    if (k >= low) logs.push(log);
    log += Math.log((count - k) / (k + 1)) + odds;
  }
  const most = logs.reduce((a, b) => Math.max(a, b), -Infinity);
  if (most === -Infinity) return 0;
  return Math.min(logs.reduce((sum, log) => sum + Math.exp(log - most), 0) * Math.exp(most), 1);
}

/**
 * Share of `count` trials that hit, and the bounds of the probability by Clopper and Pearson.
 * @param {number} hits @param {number} count @param {number} confidence
 * @returns {[number, number, number]}
 */
export function chance(hits, count, confidence) {
  const tail = 0.5 * (1 - confidence);
  const low = hits ? riskAt((risk) => moreThan(hits - 1, count, risk) >= tail) : 0;
  const high = hits < count ? riskAt((risk) => atMost(hits, count, risk) <= tail) : 1;
  return [hits / count, low, high];
}

/** The least risk that is enough. @param {(risk: number) => boolean} enough */
function riskAt(enough) {
  let [low, high] = [0, 1];
  for (let n = 0; n < HALVINGS && low < 0.5 * (low + high) && 0.5 * (low + high) < high; n++) {
    const middle = 0.5 * (low + high);
    if (enough(middle)) high = middle;
    else low = middle;
  }
  return 0.5 * (low + high);
}
