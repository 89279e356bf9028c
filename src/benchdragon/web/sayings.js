// What the sheets of a dance say, and who carries its benches.

import { Basis, benchLines, tightestLine } from "./made/bench_text.js";
import { Clock } from "./made/clock.js";
import { Ground } from "./made/ground.js";
import { called } from "./made/people.js";
import { Roster, phonesOf } from "./made/roster_people.js";
import { _, language } from "./words.js";

/** What a bench does: see `BenchText` of explain/bench_text.py. @typedef {{ quick: string, place: string[], stretches: string[], paces: string[], tightest: string, people: string[], times: string }} BenchText */
/** @typedef {import("./compute/briefing.js").Briefing} Briefing */

/** Somebody who carries a bench. @typedef {{ name: string, household: string, phone: string, remarks: string, home_phone: string }} Person */
/** Who carries each bench (number, from 1). @typedef {Map<number, Person[]>} People */

/** What is said of a bench on its sheet; `address` opens the player at it, if the plan says where that is. @typedef {{ bench: number, called: string, title: string, people: string[], text: BenchText, kin: string, address: string }} Told */
/** What one gets: one's bench, or benches of a household under its name. @typedef {{ title: string, entries: Told[] }} Sheet */

// People of another bench, and benches of a household, who are named on a sheet.
const MOST_NAMED = 4;

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

  /** How many people carry: who is named at several benches counts once. */
  get persons() {
    return new Roster(this.people).persons;
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
    return _("{bench} ({people})", { bench: text, people: listed(names, MOST_NAMED) });
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
    const benches = listed(names, MOST_NAMED);
    return names.length ? _("Of your household too: {benches}.", { benches }) : "";
  }

  /** Who carries a bench, a line each, and then the phones that are their household's. @param {number} bench @param {boolean} asked whether phones are */
  carriers(bench, asked) {
    const people = this.people.get(bench) ?? [];
    const [own, home] = phones(people, asked);
    const told = people.map(({ name }, n) => {
      const phone = own[n];
      return phone ? _("{name}, phone {phone}", { name, phone }) : name;
    });
    return [...told, ...home];
  }

  /** The same as the leader reads of them: with what the list remarks. @param {number} bench @param {boolean} asked whether phones are */
  remarked(bench, asked) {
    const people = this.people.get(bench) ?? [];
    const [own, home] = phones(people, asked);
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

  /** The sheets of some benches (numbers, from 1): of each, or so many of a household's on one. @param {number[]} benches @param {boolean} phones @param {number} most benches on a sheet; 0: each has its own @returns {Sheet[]} */
  sheets(benches, phones, most) {
    const told = benches.map((bench) => this.#told(bench, phones));
    if (!most) return told.map((one) => ({ title: "", entries: [one] }));
    /** Benches by households; those of none stand alone. @type {Map<string | number, Told[]>} */
    const groups = new Map();
    for (const one of told) {
      const people = this.people.get(one.bench) ?? [];
      const names = new Set(people.map(({ household }) => household).filter(Boolean));
      for (const key of names.size ? names : [one.bench])
        groups.set(key, [...(groups.get(key) ?? []), one]);
    }
    return [...groups].flatMap(([key, all]) =>
      Array.from({ length: Math.ceil(all.length / most) }, (_sheet, n) => ({
        title: typeof key === "string" ? key : "",
        entries: all.slice(n * most, (n + 1) * most),
      })),
    );
  }

  /** What is said of a bench on its sheet. @param {number} bench @param {boolean} phones @returns {Told} */
  #told(bench, phones) {
    return {
      bench,
      called: this.called(bench),
      title: this.titled(bench),
      people: this.carriers(bench, phones),
      text: this.text(bench, (other) => this.named(other)),
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

/** The phones of a bench's people, and those of households in words; none unless they are asked for. @param {Person[]} people @param {boolean} asked @returns {[string[], string[]]} */
function phones(people, asked) {
  const [own, home] = phonesOf(asked ? people : []);
  return [
    own,
    home.map((/** @type {string} */ phone) => _("phone of the household: {phone}", { phone })),
  ];
}
