// Everything that can go wrong, in words, and the checks of numbers.

import { WalkError, finite, inOrder, notNegative, positive } from "../made/errors.js";
import { Fault, Faults, KeyedError } from "../made/source.js";
import {
  BenchDragonError,
  InputError,
  NoSolutionError,
  PlanError,
  UnsureError,
  brief,
} from "./error_kinds.js";

export { BenchDragonError, InputError, NoSolutionError, PlanError, UnsureError, WalkError, brief };
export { Fault, Faults, KeyedError, finite, inOrder, notNegative, positive };
