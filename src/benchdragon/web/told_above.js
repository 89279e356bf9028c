// What is told above the picture: it has its room whatever it says, so that the picture stays where it is.

import { make } from "./elements.js";

/** Type of what is told: the largest in which it finds room, and no smaller than the last. */
const TYPE = ["1.1rem", "15px", "13.5px", "12px"];

export class ToldAbove {
  /** @param {(height: number) => void} resized called with its height, CSS pixels */
  constructor(resized) {
    this.element = make("header", { class: "verdicts" });
    const watch = new ResizeObserver(() => {
      this.fit();
      resized(this.element.getBoundingClientRect().height);
    });
    watch.observe(this.element);
  }

  /** Have all of it find room, in smaller type where that takes it. */
  fit() {
    const { element } = this;
    for (const size of TYPE) {
      element.style.setProperty("--type", size);
      if (element.scrollHeight <= element.clientHeight) return;
    }
  }
}
