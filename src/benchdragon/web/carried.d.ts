/** What of the carried library the planner uses: see tools/make_carried.mjs. */

/** The data in a TOML file. @throws {TomlError} */
export function parse(text: string, options?: { integersAsBigInt?: boolean }): Record<string, unknown>;

/** Data as a TOML file. */
export function stringify(data: Record<string, unknown>): string;

/** A date in a TOML file. */
export class TomlDate extends Date {}

/** What is wrong with a TOML file, and where. */
export class TomlError extends Error {
  line: number;
  column: number;
}
