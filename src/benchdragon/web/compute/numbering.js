// How handles are numbered, and where they are. Twin of model/numbering.py.

import { _ } from "../words.js";

/** Where a handle is in a dragon of so many benches, in the language in use. @param {number} handle @param {number} benches */
export function handlePlace(handle, benches) {
  if (handle === 0) return _("front of bench 1");
  if (handle === benches) return _("rear of bench {bench}", { bench: benches });
  return _("between benches {a} and {b}", { a: handle, b: handle + 1 });
}
