// Tables as files for spreadsheets.

// What a spreadsheet takes for a formula.
const FORMULA = /^[=+\-@\t\r]/;
const NUMBER = /^-?\d+(\.\d+)?$/;

/** Rows with commas, behind the mark by which spreadsheets know UTF-8. @param {string[][]} rows */
export function csvFile(rows) {
  const text = rows.map((row) => `${row.map(cell).join(",")}\r\n`).join("");
  return new Blob([`\ufeff${text}`], { type: "text/csv" });
}

/** @param {string} text */
function cell(text) {
  const plain = FORMULA.test(text) && !NUMBER.test(text) ? `'${text}` : text;
  return `"${plain.replaceAll('"', '""')}"`;
}
