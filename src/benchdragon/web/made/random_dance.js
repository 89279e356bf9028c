// @ts-nocheck
// Made from solve/random_dance.py by tools/make_twins.py; to make it again: make generate

import { memory as budgetMemory } from "../compute/budget.js";
import { EngineQuestion } from "../compute/engine_question.js";
import { InputError, UnsureError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { inColumns } from "./bench_tables.js";
import { inOrder } from "./errors.js";
import { PlanFamily, QUESTIONS, kernelFamily } from "./size_family.js";

export async function answered(plan, limits) {
  let end, ending, family, figures, first, handle, known, laid, last, name, question, start, walk;
  walk = plan.build();
  [start, end] = py.list(plan.span(walk));
  inOrder(start, end);
  [first, last] = py.list(py.tolist(walk.head_position([start, end])));
  name = (py.eq(py.at(limits, 0), 0) ? "pitch" : "width");
  [family, laid] = py.list(kernelFamily(new PlanFamily(plan, py.at(QUESTIONS, name), 0.0), walk));
  known = py.dict([[1, plan.limits.margin], [2, first], [3, last], [7, budgetMemory()], ...py.items(limits)]);
  handle = py.entry("bd_random_dance_question_open_dance", family, laid, inColumns(known))[0];
  [figures, ending] = py.list([py.zeros(25), 8]);
  question = new EngineQuestion(handle, py.entered("bd_random_dance_question_step_dance"), py.entered("bd_random_dance_question_read_dance"), figures);
  try {
    while (py.eq(ending, 8)) {
      ending = (await question.step());
    }
  } finally {
    question.free();
  }
  refuse(ending, py.at(limits, 4), (py.int(py.at(limits, 6)) + 1));
  return py.float(py.at(figures, 2));
}
function refuse(ending, guess, number) {
  let text;
  if (py.eq(ending, 2)) {
    throw new InputError(_("the walk is too long, or the dragon, for random dances"));
  }
  if (py.eq(ending, 3)) {
    text = _("dance {number} has a bench that cannot be; make the deviations smaller");
    throw new InputError(py.filled(text, { number: number }));
  }
  if (py.eq(ending, 1)) {
    text = _("no pitch near {guess} m was found with which dance {number} is just free of contact");
    throw new UnsureError(py.filled(text, { guess: `${py.format(guess, `.4g`)}`, number: number }));
  }
}
