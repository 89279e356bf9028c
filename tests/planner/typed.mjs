// What the page reads of answers that people type: node typed.mjs MODULES ENGINE.wasm TEXTS.json, as JSON: of
// each text and unit the number; of each text and question its answer, or why it is asked back.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [modules, , file] = process.argv.slice(2);
const { QUESTIONS, numberIn } = await import(pathToFileURL(`${modules}/made/answers.js`));

function read(text, what) {
  const question = QUESTIONS.find(({ name }) => name === what);
  if (!question) return numberIn(text, what);
  try {
    return question.answer("it", text);
  } catch (error) {
    return error.message;
  }
}
console.log(JSON.stringify(JSON.parse(readFileSync(file)).map(([text, what]) => read(text, what))));
