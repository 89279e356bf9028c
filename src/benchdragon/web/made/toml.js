// @ts-nocheck
// Made from plans/toml.py by tools/make_twins.py; to make it again: make generate

import { PlanError } from "../compute/error_kinds.js";
import { _below } from "../compute/plan_parts.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { dropReplaced } from "./idle.js";
const PATTERN_1 = py.pattern("-?[0-9]{1,9}", "");

export function withBase(data, folder, source, since = []) {
  let below, keys, merged, own;
  own = py.dict(data);
  if (!py.has(own, "base")) {
    return own;
  }
  below = _below(py.pop(own, "base"), folder, source, [...py.iter(since), source]);
  [merged, keys] = py.list(_merged(below, own));
  dropReplaced(merged, keys);
  return merged;
}
function _merged(below, own) {
  let before, keys, merged, name, table;
  [merged, keys] = py.list([py.dict(below), []]);
  for ([name, table] of py.iter(py.items(own))) {
    before = py.get(merged, name);
    if (((name === "obstacle") && (py.is(table, "list")) && (py.is(before, "list")))) {
      py.set(merged, name, py.add(before, table));
    }
    else {
      if (((py.is(table, "dict")) && (py.is(before, "dict")) && !py.truth(_another(name, before, table)))) {
        py.set(merged, name, py.dict([...py.items(before), ...py.items(table)]));
        keys = py.extend(keys, py.list(table).map((key) => `${py.str(name)}.${py.str(key)}`));
      }
      else {
        py.set(merged, name, table);
        keys = py.extend(keys, ((py.is(table, "dict")) ? py.list([...py.iter(table), "kind"]).map((key) => `${py.str(name)}.${py.str(key)}`) : []));
      }
    }
  }
  return [merged, keys];
}
function _kind(table) {
  return (py.has(table, "part") ? "parts" : py.get(table, "kind"));
}
function _another(name, before, table) {
  let below, own;
  [own, below] = py.list([_kind(table), _kind(before)]);
  return ((name === "venue") || !py.has([null, below], own));
}
export function setValue(data, key, value) {
  let at, name, names, slot;
  at = data;
  names = py.split(key, ".");
  for (name of py.iter(py.slice(names, null, -1))) {
    slot = _slot(at, name, key);
    at = ((py.is(at, "list")) ? py.at(at, slot) : py.setdefault(at, slot, py.dict([])));
    if (!(py.is(at, "dict") || py.is(at, "list"))) {
      throw _nowhere(key);
    }
  }
  py.set(at, _slot(at, py.at(names, -1), key), _plain(value));
}
const _plain = (value) => value;
function _slot(at, name, key) {
  let place;
  if (!(py.is(at, "list"))) {
    return name;
  }
  place = (py.truth(PATTERN_1.fullmatch(name)) ? py.int(name) : py.len(at));
  if (!((-py.len(at) <= place) && (place < py.len(at)))) {
    throw _nowhere(key);
  }
  return place;
}
function _nowhere(key) {
  return new PlanError(py.filled(_("there is no {key} to set"), { key: key }));
}
