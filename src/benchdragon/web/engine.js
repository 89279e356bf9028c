// The kernels in WebAssembly: calls the entries of engine.wasm (benchdragon/engine), which itself tells
// what they take. Arrays lie in the module's memory until they are freed.

/** @typedef {"d" | "q"} Code float64 or int64 */
/** @typedef {{ name: string, code: Code, dimensions: number }} Leaf a number (no dimensions) or an array */
/** @typedef {{ name: string, fields: Array<Leaf | Group> }} Group */
/** @typedef {{ parameters: Array<Leaf | Group>, results: Array<Code> }} Entry */
/** @typedef {number | boolean | Numbers | { [field: string]: Argument }} Argument */

const SECTION = "benchdragon";
const SLOT = 8; // bytes
const VIEWS = { d: Float64Array, q: BigInt64Array };
const CODES = { d: "float64", q: "int64" };

/** An array of numbers in the module's memory, C-contiguous. */
export class Numbers {
  /**
   * @param {WebAssembly.Memory} memory
   * @param {number} address
   * @param {Code} code
   * @param {number[]} shape length along each dimension
   */
  constructor(memory, address, code, shape) {
    this.memory = memory;
    this.address = address;
    this.code = code;
    this.shape = shape;
    this.size = shape.reduce((size, length) => size * length, 1);
  }

  /** Its numbers, for now: memory that grows, as it may in any call, leaves a view empty. */
  get view() {
    return new VIEWS[this.code](this.memory.buffer, this.address, this.size);
  }
}

/** How many slots an argument takes. @param {Leaf | Group} parameter @returns {number} */
function slots(parameter) {
  if (!("fields" in parameter)) return 1 + parameter.dimensions;
  return parameter.fields.reduce((sum, field) => sum + slots(field), 0);
}

/** There is not as much memory as was wanted. */
export class NoMemory extends RangeError {
  name = "RangeError";
}

export class Engine {
  /** @param {BufferSource | WebAssembly.Module} code the bytes of engine.wasm, or what was compiled of them */
  static async load(code) {
    const module = code instanceof WebAssembly.Module ? code : await WebAssembly.compile(code);
    const [told] = WebAssembly.Module.customSections(module, SECTION);
    const { entries } = JSON.parse(new TextDecoder().decode(told));
    const { exports } = await WebAssembly.instantiate(module);
    return new Engine(exports, entries);
  }

  /**
   * @param {any} exports of the module
   * @param {Record<string, Entry>} entries by name
   */
  constructor(exports, entries) {
    exports._initialize();
    this.exports = exports;
    this.entries = entries;
    const sizes = Object.values(entries).map(
      ({ parameters, results }) => slots({ name: "", fields: parameters }) + results.length,
    );
    this.blockSlots = Math.max(...sizes);
    this.block = this.#room(this.blockSlots);
  }

  /** @param {number} count of numbers */
  #room(count) {
    // A length too great for an address would be cut to a small one.
    const address = SLOT * count < 2 ** 32 ? this.exports.malloc(SLOT * count) >>> 0 : 0;
    if (!address) throw new NoMemory(`no memory for ${count} numbers`);
    return address;
  }

  /** Bytes of memory that it holds, which never become fewer. */
  get held() {
    return this.exports.memory.buffer.byteLength;
  }

  /** Room for an array; what stands in it is not said. @param {Code} code @param {number[]} shape */
  array(code, shape) {
    const size = shape.reduce((all, length) => all * length, 1);
    return new Numbers(this.exports.memory, this.#room(Math.max(size, 1)), code, shape);
  }

  /** Give arrays back, which are not to be used any more. @param {Numbers[]} arrays */
  free(...arrays) {
    for (const array of arrays) this.exports.free(array.address);
  }

  /**
   * Call an entry; what it returns, number by number. Groups are objects of their fields.
   * @param {string} name
   * @param {Argument[]} values
   * @returns {number[]}
   */
  call(name, ...values) {
    if (!(name in this.entries)) throw new TypeError(`there is no ${name}`);
    const { parameters, results } = this.entries[name];
    if (values.length !== parameters.length)
      throw new TypeError(`${name} takes ${parameters.length} arguments, not ${values.length}`);
    const block = new Block(this.exports.memory, this.block, this.blockSlots);
    parameters.forEach((parameter, n) => block.put(parameter, parameter.name, values[n]));
    const code = this.exports[name](this.block);
    if (code) throw new NoMemory(`${name} ended with code ${code}: no memory for its scratch`);
    const after = new Block(this.exports.memory, this.block, this.blockSlots);
    return results.map((kind, n) => Number(after[kind][block.next + n]));
  }
}

/** The slots that an entry reads its arguments from, and then writes its results to. */
class Block {
  /** The slot that comes next. */
  next = 0;

  /** @param {WebAssembly.Memory} memory @param {number} block @param {number} count of slots */
  constructor(memory, block, count) {
    this.d = new Float64Array(memory.buffer, block, count);
    this.q = new BigInt64Array(memory.buffer, block, count);
  }

  /** @param {Leaf | Group} parameter @param {string} path @param {Argument} value */
  put(parameter, path, value) {
    if ("fields" in parameter) this.#group(parameter, path, value);
    else if (parameter.dimensions > 0) this.#array(parameter, path, value);
    else this.#number(parameter.code, path, value);
  }

  /** @param {Group} parameter @param {string} path @param {Argument} value */
  #group(parameter, path, value) {
    if (typeof value !== "object" || value instanceof Numbers)
      throw new TypeError(`${path} must be an object of its fields`);
    for (const field of parameter.fields) this.put(field, `${path}.${field.name}`, value[field.name]);
  }

  /** @param {Leaf} parameter @param {string} path @param {Argument} value */
  #array({ code, dimensions }, path, value) {
    if (!(value instanceof Numbers) || value.code !== code || value.shape.length !== dimensions)
      throw new TypeError(`${path} must be a ${dimensions}-dimensional array of ${CODES[code]}`);
    this.q[this.next++] = BigInt(value.address);
    for (const length of value.shape) this.q[this.next++] = BigInt(length);
  }

  /** @param {Code} code @param {string} path @param {Argument} value */
  #number(code, path, value) {
    if (typeof value !== "number" && typeof value !== "boolean")
      throw new TypeError(`${path} must be a number`);
    if (code === "d") this.d[this.next++] = Number(value);
    else this.q[this.next++] = BigInt(value);
  }
}
