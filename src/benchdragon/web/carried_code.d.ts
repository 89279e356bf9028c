/** What of the carried library the planner uses: see tools/make_carried.mjs. */

/**
 * A text as a QR code: rows of its squares, true for dark.
 * @throws {RangeError} where it finds no room in the largest that is allowed
 */
export function encode(
  text: string,
  options: { ecc: "L" | "M" | "Q" | "H"; boostEcc: boolean; maxVersion: number; border: number },
): { size: number; data: boolean[][] };
