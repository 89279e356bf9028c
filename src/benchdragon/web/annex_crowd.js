// The crowd in the permit annex: its ground, its ways out, and what the dragon leaves of these.

import { table } from "./annex_words.js";
import { ANALYSIS_CROWD } from "./compute/constants.js";
import { decimalsTowards, general } from "./compute/number_format.js";
import { _, language } from "./words.js";

/** @typedef {import("./compute/annex.js").AnnexFacts} AnnexFacts */
/** @typedef {import("./annex_words.js").Cell} Cell */
/** @typedef {import("./sayings.js").Sayings} Sayings */

/** The numbers of the crowd, and what they mean. @param {Sayings} said @param {AnnexFacts} facts */
export function crowdPart(said, facts) {
  return [
    crowdTable(said, facts),
    _(
      "People a square metre are counted as if they stood evenly; where one sees best they stand closer. Levels: Fruin, after the table in EPJ Data Science (2014): from 2 walking is slowed, from 3.6 people are touched against their will, from 5.6 dangerous forces begin, 7.1 is critical even where nobody moves.",
    ),
  ];
}

/** The numbers of the crowd, and what the dragon leaves of its entrances. @param {Sayings} said @param {AnnexFacts} facts */
function crowdTable(said, { crowd, exits, entrances }) {
  const unknown = _("unknown: the plan has no venue");
  const { people, ground, way } = crowd;
  /** @type {Cell[][]} */
  const rows = [
    [_("spectators expected"), people == null ? null : String(people)],
    [_("ground in the venue outside the spectators' line"), ground == null ? unknown : `${decimalsTowards(ground, 0, false)} m²`],
    [_("people a square metre there"), densityCell(crowd)],
    [_("narrowest way between the line and the edge of the venue"), way == null ? unknown : wayCell(way)],
    [_("width of all ways out, m"), widthCell(exits)],
    [_("people a minute whom these let through at most"), flowCell(exits)],
    [_("minutes until all are out, at least"), minutesCell(exits)],
    ...entrances.map((one, n) => entranceRow(said, one, n + 1)),
  ]; // prettier-ignore
  return table(_("the crowd"), [_("item"), _("value")], rows, "facts");
}

/** @param {number} way */
function wayCell(way) {
  return way > 0
    ? `${decimalsTowards(way, 2, false)} m`
    : _("none: the line reaches the edge of the venue");
}

/** How wide all ways out are; a blank where the plan does not say. @param {AnnexFacts["exits"]} exits @returns {Cell} */
function widthCell({ width, free, unknown }) {
  if (width == null) return null;
  const shut = width - free;
  const values = {
    free: decimalsTowards(free, 2, false),
    shut: shut.toFixed(2),
    names: unknown.join(_(", ")),
  };
  return [
    decimalsTowards(width, 2, false),
    shut > 0 && _("{shut} of it inside the spectators' line: below, {free} count", values),
    unknown.length &&
      _("entrances not counted, since the plan does not say how wide they are: {names}", values),
  ]
    .filter(Boolean)
    .join(_("; "));
}

/** What ways out let through, as was seen, and as is allowed for. @param {AnnexFacts["exits"]} exits @returns {Cell} */
function flowCell({ width, free, flows: [seen, allowed] }) {
  if (width == null) return null;
  if (!free) return _("none while the dragon dances");
  const values = { seen: decimalsTowards(seen, 0, false), allowed: decimalsTowards(allowed, 0, false) };
  return _("{seen} by flows that were seen, {allowed} by the Guide", values);
}

/** How long all need to get through. @param {AnnexFacts["exits"]} exits @returns {Cell} */
function minutesCell({ width, free, minutes }) {
  if (width == null || minutes == null) return null;
  if (!free) return _("unknown");
  const [seen, allowed] = minutes.map((one) => decimalsTowards(one, 1, true));
  return _("{seen} by flows that were seen, {allowed} by the Guide", { seen, allowed });
}

/** How dense spectators stand, and what that means. @param {AnnexFacts["crowd"]} crowd */
function densityCell({ density, ground, level }) {
  if (density == null || !level) return _("unknown");
  if (ground === 0 && density) return _("there is no ground for them");
  const said = decimalsTowards(density, 1, true);
  return _("{density}: {level}", { density: said, level: level[language()] });
}

/** When the dragon's body is nearest to an entrance, and when it shuts it. @param {Sayings} said @param {AnnexFacts["entrances"][number]} entrance @param {number} n @returns {Cell[]} */
function entranceRow(said, { width, time, bench, away, inside, shut }, n) {
  const name = width
    ? _("the dragon's body nearest to entrance {n}, {width} m wide", { n, width: general(width) })
    : _("the dragon's body nearest to entrance {n}", { n });
  if (time == null) return [name, _("unknown")];
  const near = _("{bench}, at {time}: {away} m", {
    bench: said.called(bench),
    time: said.clock.tell(time),
    away: decimalsTowards(away, 2, false),
  });
  if (!inside || !shut) return [name, near];
  return [name, [near, _("shut {times}", { times: shut })].join(_("; "))];
}

/** Where flows through ways out come from, and what the times leave out. @param {AnnexFacts["exits"]} exits */
export function throughTexts({ width }) {
  if (width == null) return [];
  const [seen, allowed] = ANALYSIS_CROWD.FLOWS;
  const text = _(
    "Ways out let through what their widths do: at a stadium in 2021 fewer than {seen} people a metre and minute were seen (Larsson and others, Fire Safety Journal 120); the Guide to Safety at Sports Grounds (6th edition, 2018) allows for {allowed} at most, on level ground. The minutes are those in the ways out alone, as if everybody stood before them already, spread by their widths: walking there, crowding and steps take longer.",
    { seen, allowed },
  );
  return [text];
}
