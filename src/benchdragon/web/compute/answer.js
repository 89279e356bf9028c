// Answers of records, whose brackets are numbers again.

/** An answer of a record; a record has none for what is not finite. @param {import("../messages").Answer} answer */
export function bracketed({ value, lower, upper, unit }) {
  const [number, low, high] = [value ?? Infinity, lower ?? -Infinity, upper ?? Infinity];
  return { value: number, lower: low, upper: high, unit };
}
