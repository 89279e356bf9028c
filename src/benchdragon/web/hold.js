// Whether a finger or a mouse holds a part of the page that is not to be taken away meanwhile.

export class Hold {
  /** @type {Set<number>} */
  #pointers = new Set();

  /** @param {() => void} freed called when the last one has let go, and what it did has been heard */
  constructor(freed) {
    const free = (/** @type {number[]} */ pointers) => {
      const held = this.on;
      for (const pointer of pointers) this.#pointers.delete(pointer);
      if (held && !this.on) setTimeout(freed);
    };
    for (const type of /** @type {const} */ (["pointerup", "pointercancel"]))
      addEventListener(type, ({ pointerId }) => free([pointerId]));
    addEventListener("blur", () => free([...this.#pointers]));
  }

  /** Whether anything is held. */
  get on() {
    return this.#pointers.size > 0;
  }

  /** @param {HTMLElement} element that may be held */
  watch(element) {
    element.addEventListener("pointerdown", ({ pointerId }) => this.#pointers.add(pointerId));
  }
}
