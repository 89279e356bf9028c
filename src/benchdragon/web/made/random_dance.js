// @ts-nocheck
// Made from solve/random_dance.py by tools/make_twins.py; to make it again: make types

import { InputError, UnsureError } from "../compute/errors.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";

const TOO_LONG = 2;
const NO_BENCH = 3;
const NOT_FOUND = 1;
export function refuse(ending, guess, number) {
  let text;
  if (py.eq(ending, TOO_LONG)) {
    throw new InputError(_("the walk is too long, or the dragon, for random dances"));
  }
  if (py.eq(ending, NO_BENCH)) {
    text = _("dance {number} has a bench that cannot be; make the deviations smaller");
    throw new InputError(py.filled(text, { number: number }));
  }
  if (py.eq(ending, NOT_FOUND)) {
    text = _("no pitch near {guess} m was found with which dance {number} is just free of contact");
    throw new UnsureError(py.filled(text, { guess: `${py.format(guess, `.4g`)}`, number: number }));
  }
}
