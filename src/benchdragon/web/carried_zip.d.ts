/** What of the carried library the planner uses: see tools/make_carried.mjs. */

/**
 * The files in a zip file, by their names: those that a filter lets through.
 * @throws {Error} where it is torn
 */
export function unzipSync(
  data: Uint8Array,
  options: { filter: (file: { name: string; originalSize: number }) => boolean },
): Record<string, Uint8Array>;
