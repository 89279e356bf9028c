// The sheets of benches as they are printed: who it is, what they do, a map, and all else that finds room.

import { drawnCode } from "./code.js";
import { make } from "./elements.js";
import { Sayings, listed } from "./sayings.js";
import { SheetMaps, readable } from "./sheet_map.js";
import { _ } from "./words.js";

/** @typedef {import("./compute/briefing.js").Briefing} Briefing */
/** @typedef {import("./name_list.js").NameList} NameList */
/** @typedef {import("./sayings.js").Sheet} Sheet */
/** @typedef {import("./sayings.js").Told} Told */
/** @typedef {import("./sheets.js").Built} Built */
/** @typedef {import("./sheets.js").Looks} Looks */

/** @type {Record<string, number>} */
const ON_A_PAGE = { a4: 1, quarter: 4, lanyard: 2 };
// Benches of a household on one sheet, where sheets are large and the type is not.
const MOST_BENCHES = 2;

// What is tried until a sheet fits, as shares of the format's type: by day, and by night.
const DAY = [1, 0.93, 0.86, 0.8, 0.74];
const NIGHT = [1.5, 1.4, 1.3, 1.2, 1.1, 1];
// People of a bench who have a line each where that leaves too little room; who are named then.
const MOST_LINES = 2;
const FEWER = [24, 12, 6, 3, 1];
// The largest kind of QR code that there is.
const LARGEST_CODE = 40;
// A map is as tall as that, or there is none.
const LEAST_MAP = "25mm";
// Where names are written by hand.
const BLANK = "_".repeat(22);
// Type that is still too large shrinks by this share, so many times at most.
const [SMALLER, MOST_SMALLER] = [0.9, 20];
// So many sheets are fitted before the page is shown how far it is.
const AT_ONCE = 25;

/** The code of an address; itself where it is too long for one. @param {string} address */
function codeOf(address) {
  const code = drawnCode(address, "M", LARGEST_CODE, _("QR code of the link"));
  return code ?? make("p", { class: "small" }, address);
}

/** Who carries a bench, and the element that names them. @param {Told} told */
function carriersOf({ people }) {
  const blank = make("p", { class: "few" }, _("Names: {blank}", { blank: BLANK }));
  const lines = people.map((name) => make("p", {}, name));
  return { people, element: make("div", { class: "people" }, ...(lines.length ? lines : [blank])) };
}

/** What may be left out of what is said of a bench, the last first; and what may not, but where nothing else helps. @param {Told} told @param {boolean} several whether other benches stand on the sheet */
function factsOf({ called, text, kin }, several) {
  const line = (/** @type {string} */ said, name = "") => make("p", name ? { class: name } : {}, said);
  const facts = [
    ...text.people.map((said) => line(said, "strong")),
    line(text.tightest),
    ...text.place.map((said) => line(said)),
  ];
  const spare = [
    ...[...(kin ? [kin] : []), ...text.stretches].map((said) => line(said)),
    ...text.paces.map((said) => line(said, "small")),
  ];
  return { name: several ? [line(called, "strong")] : [], facts, spare };
}

/** One side of a sheet, which gives way until all of it finds room. */
class Side {
  /**
   * @param {HTMLElement} element
   * @param {{ carriers?: ReturnType<typeof carriersOf>[], told?: ReturnType<typeof factsOf>[], map?: HTMLElement | null }} holds
   * @param {boolean} night @param {boolean} coded whether a code leads to all that is left out
   */
  constructor(element, { carriers = [], told = [], map = null }, night, coded) {
    this.element = element;
    this.carriers = carriers;
    this.told = told;
    this.map = map;
    this.coded = coded;
    this.shares = night ? NIGHT : DAY;
    this.steps = this.#versions();
    this.steps.next();
  }

  /** Whether all of it finds room. */
  get fits() {
    return this.element.scrollHeight <= this.element.clientHeight + 1;
  }

  /** What gives way, step by step: type, without a code the map, what may be spared, people but the first, the map, other facts, and type again. */
  *#versions() {
    const size = (/** @type {number} */ share) =>
      this.element.style.setProperty("--share", String(share));
    for (const share of this.shares) {
      size(share);
      yield;
    }
    if (!this.coded && this.map) {
      // Who has no code to see the times by needs them more than the map.
      this.map.remove();
      for (const share of this.shares) {
        size(share);
        yield;
      }
    }
    const rest = this.coded
      ? _("And so on: the rest is in the player.")
      : _("There is no room here for the rest.");
    const more = this.told.map(() => make("p", {}, rest));
    for (const _left of this.#leaving(
      this.told.map(({ spare }) => spare),
      more,
    ))
      yield;
    for (const { people, element } of this.carriers)
      if (people.length > MOST_LINES)
        for (const most of FEWER) {
          element.replaceChildren(make("p", { class: "few" }, listed(people, most)));
          yield;
        }
    this.map?.style.setProperty("min-height", LEAST_MAP);
    yield;
    this.map?.remove();
    yield;
    for (const _left of this.#leaving(
      this.told.map(({ facts }) => facts),
      more,
    ))
      yield;
    for (let n = 0, share = this.shares[this.shares.length - 1]; n < MOST_SMALLER; n++) {
      size((share *= SMALLER));
      yield;
    }
  }

  /** Leave out one line after another: the last of the bench of which most are left, and say there that there is more. @param {HTMLElement[][]} lines of each bench @param {HTMLElement[]} more */
  *#leaving(lines, more) {
    const left = lines.map((all) => [...all]);
    for (let count = left.flat().length; count > 0; count--) {
      const most = Math.max(...left.map(({ length }) => length));
      const n = left.map(({ length }) => length).lastIndexOf(most);
      left[n].pop()?.replaceWith(more[n]);
      yield;
    }
  }
}

/** A sheet: of one side, or a card to hang round the neck, which is folded. */
export class BenchSheet {
  /** @param {Sheet} sheet @param {HTMLElement} map @param {Looks} looks */
  constructor({ title, entries }, map, { paper, night, foot }) {
    const [{ address, text }] = entries;
    const several = entries.length > 1;
    const carriers = entries.map(carriersOf);
    const told = entries.map((one) => factsOf(one, several));
    const names = entries.flatMap((one, n) => [
      make("h2", several || title ? { class: "one" } : {}, one.title),
      carriers[n].element,
      ...(several ? [make("p", { class: "quick" }, one.text.quick)] : []),
    ]);
    const household = title ? [make("h2", {}, _("household: {name}", { name: title }))] : [];
    const head = [
      make("div", { class: "head" }, ...(address ? [codeOf(address)] : []), ...household, ...names),
      ...(several ? [] : [make("p", { class: "quick" }, text.quick)]),
      map,
    ];
    const body = [
      ...told.flatMap(({ name, facts, spare }) => [...name, ...facts, ...spare]),
      make("p", { class: "small" }, entries[entries.length - 1].text.times),
    ];
    const side = (/** @type {HTMLElement[]} */ ...all) =>
      make(
        "article",
        { class: `sheet ${paper}${night ? " night" : ""}${several ? " several" : ""}` },
        ...all,
        make("footer", {}, foot),
      );
    const coded = Boolean(address);
    /** What gives way each for itself. @type {Side[]} */
    this.sides =
      paper === "lanyard"
        ? [
            new Side(side(...head), { carriers, map }, night, true),
            new Side(side(...body), { told }, night, coded),
          ]
        : [new Side(side(...head, ...body), { carriers, told, map }, night, coded)];
    const elements = this.sides.map(({ element }) => element);
    this.element = elements.length > 1 ? make("div", { class: "folded" }, ...elements) : elements[0];
  }
}

/** Have sheets that stand in the page give way until all of each finds room. @param {BenchSheet[]} sheets @param {(share: number) => void} told how far it is */
async function fitted(sheets, told) {
  const sides = sheets.flatMap((sheet) => sheet.sides);
  for (let n = 0; n < sides.length; n += AT_ONCE) {
    if (n) await new Promise((done) => setTimeout(done)); // so that the page is shown, and heard
    for (let open = sides.slice(n, n + AT_ONCE); open.length;) {
      // All are measured before any is changed, so that the browser sets them once for each step.
      open = open.filter((side) => !side.fits);
      open = open.filter((side) => !side.steps.next().done);
    }
    told(Math.min(n + AT_ONCE, sides.length) / sides.length);
  }
  // Maps are as tall as the least of them that had not to give way.
  const maps = sides.flatMap(({ map }) => (map?.isConnected ? [map] : []));
  const usual = maps.filter((map) => !map.style.minHeight);
  const tall = usual.reduce((least, map) => Math.min(least, map.clientHeight), Infinity);
  for (const map of usual) map.style.maxHeight = `${tall}px`;
  for (const map of maps) readable(map);
}

/** A sheet for each bench, or for each household's. @param {Briefing} briefing @param {NameList} names @param {Looks} looks @returns {Built} */
export function benchSheets(briefing, names, looks) {
  const said = new Sayings(briefing, names.people);
  const maps = new SheetMaps(briefing, looks.paper);
  const most = looks.paper === "a4" && !looks.night ? MOST_BENCHES : 1;
  const numbers = looks.bench ? [looks.bench] : briefing.benches.map(({ bench }) => bench);
  const sheets = said
    .sheets(numbers, looks.phones, looks.households && names.households ? most : 0)
    .map((sheet) => new BenchSheet(sheet, maps.tracks(sheet.entries), looks));
  const each = ON_A_PAGE[looks.paper];
  const pages = Array.from({ length: Math.ceil(sheets.length / each) }, (_page, n) => {
    const there = sheets.slice(n * each, (n + 1) * each).map(({ element }) => element);
    return make("div", { class: `paper ${looks.paper}` }, ...there);
  });
  return { pages: [maps.shared(), ...pages], settle: (told) => fitted(sheets, told) };
}
