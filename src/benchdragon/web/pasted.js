// What of a text that was opened or pasted may be a plan.

/** A plan in the address of a page, and its letters alone, as chats hand them on. */
const LINK = /(?:^|[\s#&])plan=([\w-]+)/;
const LETTERS = /^\s*([\w-]{24,})\s*$/;
/** The plan in a page that was sent. */
const PAGE = /<script type="application\/json" id="plan">(.*?)<\/script>/s;
/** A line of a plan file as no other text has it: a table's name, or the first key. */
const FILE = /^\s*(?:\[\[?[\w."-]+\]\]?|schema\s*=.*)\s*(?:#.*)?$/m;

/** Where a text holds a plan. @typedef {"page" | "file" | "link" | ""} Kind */

/** What may be a plan in a text, and where it is. @param {string} text @returns {[Kind, string]} */
export function planIn(text) {
  const page = PAGE.exec(text);
  if (page) return ["page", page[1]];
  if (FILE.test(text)) return ["file", text]; // which may hold an address, too
  const link = LINK.exec(text) ?? LETTERS.exec(text);
  return link ? ["link", link[1]] : ["", text];
}
