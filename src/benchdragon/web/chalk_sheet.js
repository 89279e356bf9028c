// How the line gets onto the ground: a peg, a tape and chalk; a table of ticks, and a picture; as a file too.

import { pegLine } from "./made/ground.js";
import { ANALYSIS_CHALK } from "./compute/constants.js";
import { decimals } from "./compute/number_format.js";
import { make, table } from "./elements.js";
import { Sayings } from "./sayings.js";
import { readable, SheetMaps } from "./sheet_map.js";
import { _, language } from "./words.js";

/** @typedef {import("./compute/briefing.js").ChalkPlan} ChalkPlan */
/** @typedef {import("./compute/briefing.js").Leg} Leg */
/** @typedef {import("./compute/briefing.js").Star} Star */
/** @typedef {import("./compute/briefing.js").Tick} Tick */
/** @typedef {import("./compute/briefing.js").Briefing} Briefing */
/** @typedef {import("./name_list.js").NameList} NameList */
/** @typedef {import("./sheets.js").Built} Built */
/** @typedef {import("./sheets.js").Looks} Looks */

// Assumed of two people with a tape: minutes for the peg, a spoke or a tape, a tick.
const [PEG, TAPE, TICK] = [5, 1, 0.5];
// Sides of a tape, and ticks on the way out, by signs; what is nearer to a tape, m, is told as on it.
const [LEFT, RIGHT, OUT, ON] = ["◁", "▷", "×", 0.005];
/** Places that are named, by letters. @type {Record<string, string>} */
const LETTERS = { tail: "A", head: "B", end: "C" };

/** A length, m. @param {number} length */
function metres(length) {
  return decimals(length, 2);
}

/** The paper. @param {Briefing} briefing @param {NameList} _names @param {Looks} looks @returns {Built} */
export function chalkSheet(briefing, _names, { foot }) {
  const said = new Sayings(briefing, new Map());
  const { chalk, title } = briefing;
  const named = title[language()];
  const head = make("h2", {}, named ? _("Chalk plan: {title}", { title: named }) : _("Chalk plan"));
  const maps = new SheetMaps(briefing, "a4");
  const sheet = make("article", { class: "chalk" }, head);
  if (chalk) sheet.append(...told(said, chalk), maps.chalk(chalk, LETTERS));
  else sheet.append(_("This line is too long to be chalked tick by tick: it has no chalk plan."));
  sheet.append(make("footer", {}, foot));
  const paper = make("div", { class: "paper a4" }, sheet);
  return { pages: [maps.shared(), paper], settle: async () => onePage(paper, sheet) };
}

/** What stands above the picture. @param {Sayings} said @param {ChalkPlan} chalk */
function told(said, chalk) {
  return [
    make("p", {}, effort(chalk)),
    make("ol", {}, ...steps(said, chalk).map((text) => make("li", {}, text))),
    ...chalk.stars.map((star, n) => spokeTable(chalk, star, n)),
    ...(chalk.legs.length ? [legTable(chalk)] : []),
    make("p", { class: "small" }, signs(chalk)),
  ];
}

/** How much there is to do. @param {ChalkPlan} chalk */
function effort({ stars, legs, ticks }) {
  const tapes = stars.reduce((sum, { spokes }) => sum + spokes, legs.length);
  const minutes = 5 * Math.ceil((PEG + TAPE * tapes + TICK * ticks.length) / 5);
  return _(
    "{ticks} ticks on {tapes} tapes: about {minutes} minutes for two people with a long tape and chalk (assumed: {tick} min a tick, {tape} min a tape, {peg} min to begin).",
    { ticks: ticks.length, tapes, minutes, tick: TICK, tape: TAPE, peg: PEG },
  );
}

/** What to do, one after another. @param {Sayings} said @param {ChalkPlan} chalk */
function steps({ ground, briefing }, { stars, legs, met, stray }) {
  const edge = briefing.venue.length ? pegLine(ground, briefing.venue) : "";
  const found = [
    _("Drive the peg where the picture shows it. {where}", { where: edge || ground.legend }),
  ];
  for (const [n, star] of stars.entries()) found.push(...starSteps(ground, star, n));
  if (legs.length) found.push(...legSteps(legs));
  found.push(...met.map((one) => metStep(briefing, one)));
  const half = { stray: metres(stray), half: metres(0.5 * stray) };
  found.push(
    _(
      "Join the ticks in one smooth bend. Joined by straight lines it would be off by at most {stray} m; bent at least half as much as it should be and at most half again as much, by about {half} m at most.",
      half,
    ),
    _("Pull out the peg and whatever else marks tapes before anybody dances: the line alone stays."),
  );
  return found;
}

/** @param {Sayings["ground"]} ground @param {Star} star @param {number} n */
function starSteps(ground, { place, spokes, wheel, chord }, n) {
  const [x, y] = place.map(metres);
  const own = Math.hypot(...place) < ON;
  const values = { n: n + 1, x, y, spokes, wheel, chord: metres(chord), way: ground.way_names[0] };
  const stake = own
    ? []
    : [_("Stake {n} stands at x = {x} m, y = {y} m from the peg: its spokes begin there.", values)];
  return [
    ...stake,
    _(
      "Spokes by tape alone: with the tape's ring on it chalk a circle of {wheel} m. Spoke 1 goes {way}. From where it crosses the circle it is {chord} m straight across to spoke 2, to the left as one faces outwards, and so on to spoke {spokes}; from there {chord} m lead back to spoke 1: share what is missing among all.",
      values,
    ),
    _(
      "Lay the tape out along each spoke and make a tick at each length in its column; a cross where the table has {out}.",
      { out: OUT },
    ),
  ];
}

/** What stands in the way of tapes. @param {Sayings["briefing"]} briefing @param {ChalkPlan["met"][number]} met */
function metStep({ ways }, { obstacle, star, tapes }) {
  const values = { name: ways.obstacles[obstacle].shown[language()], tapes: tapes.join(_(", ")) };
  if (star < 0)
    return _(
      "{name} is in the way of tapes {tapes}: carry them over it, or past it on a line that is sighted.",
      values,
    );
  return _(
    "{name} is in the way of spokes {tapes}: carry the tape over it, or past it on a line that is sighted.",
    values,
  );
}

/** @param {Leg[]} legs */
function legSteps(legs) {
  const several = legs.some(({ swing }) => !Number.isNaN(swing));
  const told = [
    _(
      "Lay each tape straight from its first place to its last, and make ticks at the lengths along it, and beside it at a right angle where the table says so.",
    ),
  ];
  if (several)
    told.push(
      _(
        "A tape that begins where another ends: carry that one straight on by {arm} m; from there the next one is as far to the left or right as the table says, at {arm} m of its own.",
        { arm: ANALYSIS_CHALK.ARM },
      ),
    );
  return told;
}

/** How the table is read. @param {ChalkPlan} chalk */
function signs({ ticks }) {
  const found = [_("Lengths in metres from the beginning of the tape.")];
  if (ticks.some(({ aside }) => Math.abs(aside) >= ON))
    found.push(
      _("{left} 0.40: so far to the left of the tape, {right} to the right, at a right angle.", {
        left: LEFT,
        right: RIGHT,
      }),
    );
  if (ticks.some(({ out }) => out))
    found.push(_("{out}: on the way out again; join crosses to crosses alone.", { out: OUT }));
  found.push(
    _("{tail}: here the tail stands at first, {head}: the head. {end}: the head's end.", LETTERS),
  );
  return found.join(" ");
}

/** A tick as the table has it. @param {Tick} tick */
function cellOf({ along, aside, out, kind }) {
  const beside = Math.abs(aside) < ON ? "" : ` ${aside > 0 ? LEFT : RIGHT}${metres(Math.abs(aside))}`;
  return `${out ? OUT : ""}${metres(along)}${beside}${kind ? ` ${LETTERS[kind]}` : ""}`;
}

/** The ticks of a tape, from its beginning on. @param {ChalkPlan} chalk @param {number} star @param {number} tape */
function ticksOf({ ticks }, star, tape) {
  const own = ticks.filter((one) => one.star === star && one.tape === tape);
  return own.sort((a, b) => a.along - b.along);
}

/** Spokes against radii: a column each. @param {ChalkPlan} chalk @param {Star} star @param {number} n */
function spokeTable(chalk, { spokes }, n) {
  const columns = Array.from({ length: spokes }, (_none, k) => ticksOf(chalk, n, k + 1).map(cellOf));
  const rows = Array.from({ length: Math.max(...columns.map(({ length }) => length)) }, (_none, k) =>
    columns.map((column) => column[k] ?? ""),
  );
  const heads = columns.map((_column, k) => String(k + 1));
  const name = chalk.stars.length > 1 ? _("Spokes of stake {n}", { n: n + 1 }) : _("Spokes");
  return table(heads, rows, { kind: "spokes", name });
}

/** Tapes along the line: a row each. @param {ChalkPlan} chalk */
function legTable(chalk) {
  const heads = [
    _("tape"),
    _("from (x, y from the peg, m)"),
    _("to (x, y from the peg, m)"),
    _("length (m)"),
    _("turned from the tape before (m)"),
    _("ticks (m)"),
  ];
  const rows = chalk.legs.map(({ place: [x, y], way, length, swing }, n) => [
    String(n + 1),
    `${metres(x)}, ${metres(y)}`,
    `${metres(x + length * way[0])}, ${metres(y + length * way[1])}`,
    metres(length),
    Number.isNaN(swing) ? "-" : `${swing > 0 ? LEFT : RIGHT}${metres(Math.abs(swing))}`,
    ticksOf(chalk, -1, n + 1)
      .map(cellOf)
      .join("; "),
  ]);
  return table(heads, rows, { kind: "legs" });
}

/** Make type smaller until all of it stands on one page, if it can. @param {HTMLElement} paper @param {HTMLElement} sheet */
function onePage(paper, sheet) {
  for (let points = 10; points >= 7; points -= 0.5) {
    sheet.style.fontSize = `${points}pt`;
    if (sheet.scrollHeight <= sheet.clientHeight + 1) break;
  }
  paper.classList.toggle("long", sheet.scrollHeight > sheet.clientHeight + 1);
  for (const map of sheet.querySelectorAll(".map")) readable(map);
}

/** The ticks as a file for spreadsheets and total stations: commas, and the mark by which they know UTF-8. @param {Briefing} briefing */
export function chalkTable(briefing) {
  const { ground } = new Sayings(briefing, new Map());
  const rows = (briefing.chalk?.ticks ?? []).map(({ s, point, star, tape, along, aside, kind }, n) => {
    const numbers = [s, along, aside, ...ground.seen_at(point), ...point];
    const told = numbers.map((/** @type {number} */ number) => number.toFixed(3));
    return [n + 1, star < 0 ? "" : star + 1, tape, LETTERS[kind] ?? "", ...told].join(",");
  });
  const head = [
    _("tick"), _("stake"), _("tape"), _("letter"), "s (m)", _("along (m)"), _("left of it (m)"), _("x from the peg (m)"),
    _("y from the peg (m)"), _("x of the plan (m)"), _("y of the plan (m)"),
  ]; // prettier-ignore
  const text = [head.join(","), ...rows].map((row) => `${row}\r\n`).join("");
  return new Blob([`\ufeff${text}`], { type: "text/csv" });
}
