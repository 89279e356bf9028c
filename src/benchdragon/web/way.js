// Where an element stands within another, to be found again in what takes its place.

/** The way from an element up to one that it is in: which child of each it is; null if it is not in it. @param {Element | null} element @param {Element} above @returns {number[] | null} */
export function wayTo(element, above) {
  if (element === above) return [];
  const parent = element?.parentElement;
  const way = element && parent ? wayTo(parent, above) : null;
  return way && [...way, [...(parent?.children ?? [])].indexOf(/** @type {Element} */ (element))];
}

/** What such a way leads to. @param {number[]} way @param {Element | undefined} above @returns {HTMLElement | null} */
export function elementAt(way, above) {
  const found = way.reduce((element, child) => element?.children[child], above);
  return found instanceof HTMLElement ? found : null;
}
