/** @typedef {import("../../src/benchdragon/web/engine.js").Engine} Engine */

/**
 * Calls entries as they were recorded (recording.py), one after the other.
 *
 * Arrays lie in `memory`, before each call as they were then, after it as it leaves them; the results
 * of a call are written there as floats. Gives the seconds that the calls took, by entry.
 *
 * @param {Engine} engine
 * @param {any[]} calls
 * @param {ArrayBuffer} memory
 */
export function replay(engine, calls, memory) {
  /** @type {Record<string, number>} */
  const seconds = {};
  for (const { entry, values, results } of calls) {
    /** @type {[any, number][]} */
    const arrays = [];
    /** @param {any} value @returns {any} */
    const given = (value) => {
      if (typeof value !== "object") return Number(value);
      if ("fields" in value)
        return Object.fromEntries(
          Object.entries(value.fields).map(([name, field]) => [name, given(field)]),
        );
      const array = engine.array(value.code, value.shape);
      arrays.push([array, value.offset]);
      bytes(array).set(new Uint8Array(memory, value.offset, 8 * array.size));
      return array;
    };
    const arguments_ = values.map(given);
    const start = performance.now();
    const found = engine.call(entry, ...arguments_);
    seconds[entry] = (seconds[entry] ?? 0) + (performance.now() - start) / 1e3;
    new Float64Array(memory, results, found.length).set(found);
    for (const [array, offset] of arrays) {
      new Uint8Array(memory, offset, 8 * array.size).set(bytes(array));
      engine.free(array);
    }
  }
  return seconds;
}

/** @param {any} array */
function bytes(array) {
  return new Uint8Array(array.memory.buffer, array.address, 8 * array.size);
}
