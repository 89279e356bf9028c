// Rosters of lists, and what words of them mean: node rosters.mjs MODULES ENGINE.wasm QUESTIONS.json
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [modules, , questions] = process.argv.slice(2);
const load = (name) => import(pathToFileURL(`${modules}/${name}.js`));
const names = [
  "made/roster",
  "compute/roster_grid",
  "made/people",
  "made/roster_words",
  "made/roster_names",
];
const [{ Numbering, rosterOf }, { checkFile, rowsOf, textOf }, { called }, roster, { likeTwo }] =
  await Promise.all(names.map((name) => load(name)));
const { speak, useWords } = await load("words");

/** What a list of names says, or why it says nothing. */
function read({ data, name, count, people, language }) {
  speak(language);
  const bytes = Buffer.from(data, "base64");
  const numbering = new Numbering(count, people.count_head, (bench) => called(people, bench, count));
  try {
    checkFile(bytes, name);
    const { benches, notes } = rosterOf(rowsOf(textOf(bytes, name), name), name, numbering);
    return { benches: Object.fromEntries(benches), notes };
  } catch (error) {
    return { error: error.message, kind: error.constructor.name };
  }
}

/** What a cell means in all ways in which it may be read. */
function meant(text) {
  const { doubtful, heading, isName, isOther, isSum } = roster;
  const { namesOf, places, withPlaces, withoutPhones } = roster;
  const halved = new Set(withPlaces("4-1、6-1"));
  const found = heading(text);
  const ranges = places(text)?.map((ends) => ends.map(({ number, end }) => [number, end])) ?? null;
  return [
    found,
    ranges,
    namesOf(text),
    withoutPhones(text),
    isSum(text),
    isName(text),
    isOther(text),
    [...new Set(withPlaces(text))].sort((a, b) => a - b),
    doubtful(text, halved),
    places(text, halved)?.map((ends) => ends.map(({ number }) => number)) ?? null,
    likeTwo(text),
  ];
}

const { lists, cells, words } = JSON.parse(readFileSync(questions, "utf-8"));
useWords(words);
console.log(JSON.stringify({ lists: lists.map(read), cells: cells.map(meant) }));
