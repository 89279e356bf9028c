// Files of text with lists of names: what of rosters/grid.py the libraries of Python do.

/** Each text that bytes can be: UTF-16 with its mark, else UTF-8 and `others`. @param {Uint8Array} bytes @param {Iterable<string>} others */
export function* readings(bytes, others) {
  const mark = bytes[0] === 0xff && bytes[1] === 0xfe ? "utf-16le" : "utf-16be";
  const wide = mark === "utf-16le" || (bytes[0] === 0xfe && bytes[1] === 0xff);
  for (const encoding of wide ? [mark] : both(others)) {
    try {
      yield new TextDecoder(encoding, { fatal: true }).decode(bytes);
    } catch (error) {
      if (!(error instanceof TypeError)) throw error;
    }
  }
}

/** UTF-8, then others, which are not looked for before it has failed. @param {Iterable<string>} others */
function* both(others) {
  yield "utf-8";
  for (const name of others) yield name === "big5hkscs" ? "big5" : name;
}

/** Rows of a table, whose cells may stand between quotes, as Python's csv reads them. @param {string} text @param {string} mark */
export function _cells(text, mark) {
  /** @type {string[][]} */
  const rows = [];
  /** @type {string[]} */
  let row = [];
  let [cell, quoted, begun] = ["", false, false];
  const endCell = () => {
    row.push(cell);
    [cell, begun] = ["", false];
  };
  const endRow = () => {
    if (row.length || begun) endCell();
    rows.push(row);
    row = [];
  };
  for (let n = 0; n < text.length; n++) {
    const sign = text[n];
    if (quoted) {
      if (sign !== '"') cell += sign;
      else if (text[n + 1] === '"') cell += text[++n];
      else quoted = false;
    } else if (sign === '"' && !begun) [quoted, begun] = [true, true];
    else if (sign === mark) endCell();
    else if (sign === "\n" || sign === "\r") {
      if (sign === "\r" && text[n + 1] === "\n") n++;
      endRow();
    } else [cell, begun] = [cell + sign, true];
  }
  if (row.length || begun) endRow();
  return rows;
}
