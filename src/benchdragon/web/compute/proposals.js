// Dances that are proposed for a square, and where on it a dance has the most room.

import { benchesOutAgain, propose, TooSmall } from "../made/proposal.js";
import { leftLines, proposalLines, refusalLines } from "../made/proposal_text.js";
import { Square } from "../made/square_room.js";
import { part } from "../made/stages.js";
import { Wishes } from "../made/wishes.js";
import { withArenaAsync } from "./arena.js";

/** @typedef {import("./questions.js").Asked} Asked */

/** Of the work what finds a dance; the rest is how many benches would come out again. */
const FOUND = 0.7;

/**
 * A dance for what a village wishes: its plan (null: none fits the square), what is said of it, and of what
 * was wished that it does not have, how many benches fit, and whether all do with bearers under them.
 * @param {Asked} asked
 */
export function proposed({ engine, wishes = {}, progress }) {
  return withArenaAsync(engine, async () => {
    const { benches, length, width } = wishes;
    const asked = Object.assign(new Wishes(benches, length, width), wishes);
    const found = await propose(asked, part(progress, 0, FOUND));
    if (found instanceof TooSmall)
      return {
        plan: null,
        said: refusalLines(asked, found),
        left: [],
        benches: found.benches,
        under: found.under,
      };
    const out = asked.kind || found.plan.route.kind === "turn";
    const again = out ? 0 : await benchesOutAgain(asked, part(progress, FOUND, 1));
    const said = proposalLines(found, asked, again);
    return { plan: found.plan.data(), said, left: leftLines(found, asked), benches };
  });
}

/** The plan with its dance where it has the most room on its square, about so much more than is asked for, m. @param {Asked} asked */
export function placed({ engine, plan, progress }) {
  return withArenaAsync(engine, async () => {
    const square = new Square(plan.with_values({ "route.at": [0, 0], "route.turned": 0 }));
    const pose = square.roomiest(progress);
    return { plan: square.at(pose).data(), room: square.room(pose) };
  });
}
