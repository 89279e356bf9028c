// The sheets of benches as they are printed: who it is, what they do, a map, and all else that finds room.

import { SHEETS_BRIEFING } from "./compute/constants.js";
import { decimals } from "./compute/number_format.js";
import { drawnCode } from "./code.js";
import { make } from "./elements.js";
import { Basis, benchLines, tightestLine } from "./made/bench_text.js";
import { Clock } from "./made/clock.js";
import { Ground } from "./made/ground.js";
import { called } from "./made/people.js";
import { readable } from "./sheet_map.js";
import { _, language } from "./words.js";

/** What a bench does: see `BenchText` of explain/bench_text.py. @typedef {{ quick: string, place: string[], stretches: string[], paces: string[], tightest: string, people: string[], times: string }} BenchText */
/** @typedef {import("./compute/briefing.js").Briefing} Briefing */
/** @typedef {import("./sheet_map.js").SheetMaps} SheetMaps */

/** Somebody who carries a bench. @typedef {{ name: string, household: string, phone: string, remarks: string, home_phone: string }} Person */
/** Who carries each bench (number, from 1). @typedef {Map<number, Person[]>} People */
/** How sheets are wanted: "a4" or "quarter", in large type, with phones. @typedef {{ paper: string, night: boolean, phones: boolean }} Looks */

/** What a bench's sheet says; `address` opens the player at the bench, if the plan says where that is. @typedef {{ title: string, people: string[], text: BenchText, marks: string, kin: string, address: string }} Told */

// What is tried until a sheet fits, as shares of the format's type: by day, and by night.
const DAY = [1, 0.93, 0.86, 0.8, 0.74];
const NIGHT = [1.5, 1.4, 1.3, 1.2, 1.1];
// People of a bench who have a line each where that leaves too little room; who are named then.
const MOST_LINES = 2;
const FEWER = [24, 12, 6, 3, 1];
// The largest kind of QR code that there is.
const LARGEST_CODE = 40;
// Where names are written by hand.
const BLANK = "_".repeat(22);
// Type that is still too large shrinks by this share, so many times at most.
const [SMALLER, MOST_SMALLER] = [0.9, 20];

/** So many names at most one after another, and how many more there are. @param {string[]} names @param {number} most */
export function listed(names, most) {
  const text = names.slice(0, most).join(_(", "));
  if (names.length <= most) return text;
  return _("{names} and {count} more", { names: text, count: names.length - most });
}

/** What the sheets of a dance say, and who carries. */
export class Sayings {
  /** @param {Briefing} briefing @param {People} people */
  constructor(briefing, people) {
    const { clock, start, ground } = briefing;
    this.briefing = briefing;
    this.people = people;
    this.clock = new Clock(clock, start);
    this.ground = new Ground(ground.peg, ground.turned, ground.north, ground.venue);
  }

  /** What sentences rest on, in the language in use. */
  get basis() {
    const { people, coiled, halts } = this.briefing;
    return new Basis(this.clock, people, this.ground, halts[language()], coiled);
  }

  /** What the village calls a bench (number, from 1). @param {number} bench */
  called(bench) {
    return called(this.briefing.people, bench, this.briefing.benches.length);
  }

  /** The same with who carries it. @param {number} bench */
  named(bench) {
    const names = (this.people.get(bench) ?? []).map(({ name }) => name);
    const text = this.called(bench);
    if (!names.length) return text;
    return _("{bench} ({people})", { bench: text, people: listed(names, SHEETS_BRIEFING.MOST_NAMED) });
  }

  /** The same, with a word for the first bench and the last, where the village says only a number. @param {number} bench */
  titled(bench) {
    const text = this.called(bench);
    if (!this.briefing.people.count_head) return text;
    if (bench === 1) return _("{bench}, the head", { bench: text });
    return bench < this.briefing.benches.length ? text : _("{bench}, the tail", { bench: text });
  }

  /** Which other benches people of a bench's households carry, in words; "" if there are none. @param {number} bench */
  kin(bench) {
    const own = new Set((this.people.get(bench) ?? []).map(({ household }) => household));
    own.delete("");
    const others = [...this.people.keys()]
      .filter((other) => other !== bench)
      .filter((other) => this.people.get(other)?.some(({ household }) => own.has(household)));
    const names = others.sort((a, b) => a - b).map((other) => this.called(other));
    const benches = listed(names, SHEETS_BRIEFING.MOST_NAMED);
    return names.length ? _("Of your household too: {benches}.", { benches }) : "";
  }

  /** Who carries a bench, a line each, and then the phones that are their household's. @param {number} bench @param {boolean} phones */
  carriers(bench, phones) {
    const people = this.people.get(bench) ?? [];
    const { own, home } = phonesOf(people, phones);
    const told = people.map(({ name }, n) => {
      const phone = own[n];
      return phone ? _("{name}, phone {phone}", { name, phone }) : name;
    });
    return [...told, ...home];
  }

  /** The same as the leader reads of them: with what the list remarks. @param {number} bench @param {boolean} phones */
  remarked(bench, phones) {
    const people = this.people.get(bench) ?? [];
    const { own, home } = phonesOf(people, phones);
    const told = people.map(({ name, remarks }, n) => {
      const said = remarks && people[n + 1]?.remarks !== remarks;
      const named = own[n] ? `${name} ${own[n]}` : name;
      return said ? _("{name} ({remarks})", { name: named, remarks }) : named;
    });
    return [...told, ...home];
  }

  /** What a bench does; others in it as `name` calls them. @param {number} bench @param {(bench: number) => string} name */
  text(bench, name) {
    const { benches, landmarks } = this.briefing;
    const landmark = landmarks[language()][bench - 1];
    return benchLines(this.basis, benches[bench - 1], landmark, name);
  }

  /** The tightest moment of a bench as the leader reads of it, others without their people. @param {number} bench */
  tightest(bench) {
    const { tightest } = this.briefing.benches[bench - 1];
    return tightestLine(
      tightest,
      this.clock,
      (/** @type {number} */ other) => this.called(other),
      true,
    );
  }

  /** What a bench's sheet says. @param {number} bench @param {boolean} phones @returns {Told} */
  sheet(bench, phones) {
    return {
      title: this.titled(bench),
      people: this.carriers(bench, phones),
      text: this.text(bench, (other) => this.named(other)),
      marks: markLine(this.briefing.marks[bench - 1]),
      kin: this.kin(bench),
      address: this.#address(bench),
    };
  }

  /** Where the player opens at a bench (number, from 1). @param {number} bench */
  #address(bench) {
    const { address } = this.briefing.people;
    return address ? `${address}${address.includes("#") ? "&" : "#"}bench=${bench}` : "";
  }
}

/** The phone of each of the people of a bench, "" for none of their own, as is what several have; and those of households, in words. @param {Person[]} people @param {boolean} asked whether phones are wanted */
function phonesOf(people, asked) {
  if (!asked) return { own: people.map(() => ""), home: [] };
  const counted = (/** @type {string} */ phone) => people.filter((one) => one.phone === phone).length;
  const own = people.map(({ phone }) => (counted(phone) === 1 ? phone : ""));
  const all = new Set(people.flatMap(({ phone, home_phone }) => [phone, home_phone]));
  const home = [...all].filter((phone) => phone && !own.includes(phone));
  return { own, home: home.map((phone) => _("phone of the household: {phone}", { phone })) };
}

/** Where a front handle starts by the chalk plan's marks: `mark_line` of sheets/benches.py. @param {[number, number] | null} place */
export function markLine(place) {
  if (!place) return "";
  const [n, past] = place;
  if (!past) return _("Your front handle starts at mark {n} of the chalk plan.", { n });
  return _(
    "Your front handle starts between marks {n} and {next} of the chalk plan, {past} m past mark {n} along the line.",
    { n, next: n + 1, past: decimals(past, 2) },
  );
}

/** The code of an address; itself where it is too long for one. @param {string} address */
function codeOf(address) {
  const code = drawnCode(address, "M", LARGEST_CODE, _("QR code of the link"));
  return code ?? make("p", { class: "small" }, address);
}

/** One sheet, which gives way until all of it finds room. */
export class BenchSheet {
  /** @param {Told} told @param {HTMLElement} map @param {Looks} looks @param {string} foot */
  constructor(told, map, { paper, night }, foot) {
    const { text, people, marks, kin, address } = told;
    this.names = people;
    this.map = map;
    this.coded = Boolean(address);
    const blank = make("p", { class: "few" }, _("Names: {blank}", { blank: BLANK }));
    const carriers = people.map((name) => make("p", {}, name));
    this.people = make("div", { class: "people" }, ...(people.length ? carriers : [blank]));
    /** What may be spared, the last first. @type {HTMLElement[]} */
    this.spare = [
      ...[...(marks ? text.place : []), ...(kin ? [kin] : []), ...text.stretches].map((line) =>
        make("p", {}, line),
      ),
      ...text.paces.map((line) => make("p", { class: "small" }, line)),
    ];
    /** What may not, but where nothing else helps. @type {HTMLElement[]} */
    this.facts = [
      ...text.people.map((line) => make("p", { class: "strong" }, line)),
      make("p", {}, text.tightest),
      ...(marks ? [marks] : text.place).map((line) => make("p", {}, line)),
    ];
    this.element = make(
      "article",
      { class: `sheet ${paper}${night ? " night" : ""}` },
      make(
        "div",
        { class: "head" },
        ...(address ? [codeOf(address)] : []),
        make("h2", {}, told.title),
        this.people,
      ),
      make("p", { class: "quick" }, text.quick),
      map,
      ...this.facts,
      ...this.spare,
      make("p", { class: "small" }, text.times),
      make("footer", {}, foot),
    );
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
    if (!this.coded) {
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
    const more = make("p", {}, rest);
    for (const line of this.spare.reverse()) {
      line.replaceWith(more);
      yield;
    }
    if (this.names.length > MOST_LINES)
      for (const most of FEWER) {
        this.people.replaceChildren(make("p", { class: "few" }, listed(this.names, most)));
        yield;
      }
    this.map.remove();
    yield;
    for (const line of this.facts.reverse()) {
      line.replaceWith(more);
      yield;
    }
    for (let n = 0, share = this.shares[this.shares.length - 1]; n < MOST_SMALLER; n++) {
      size((share *= SMALLER));
      yield;
    }
  }
}

/** Have sheets that stand in the page give way until all of each finds room. @param {BenchSheet[]} sheets */
export function fitted(sheets) {
  for (let open = sheets; open.length;) {
    // All are measured before any is changed, so that the browser sets the page once for each step.
    open = open.filter((sheet) => !sheet.fits);
    open = open.filter((sheet) => !sheet.steps.next().done);
  }
  // Maps are as tall as the least of them.
  const maps = sheets.map(({ map }) => map).filter(({ isConnected }) => isConnected);
  const tall = maps.reduce((least, map) => Math.min(least, map.clientHeight), Infinity);
  for (const map of maps) {
    map.style.maxHeight = `${tall}px`;
    readable(map);
  }
}
