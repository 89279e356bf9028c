// @ts-nocheck
// Made from progress.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";

export function silent(_share, _text) {
  
}
export function part(progress, start, end, text = "") {
  function told(share, said) {
    progress(py.add(start, (py.sub(end, start) * share)), py.or(said, () => text));
  }
  return told;
}
export function stages(progress, count) {
  let done;
  done = 0;
  function begun(text) {
    let stage;
    stage = part(progress, (done / count), ((done + 1) / count), text);
    done = py.extend(done, 1);
    stage(0.0, "");
    return stage;
  }
  return begun;
}
