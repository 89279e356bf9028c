// @ts-nocheck
// Made from rosters/roster.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { plain } from "./roster_words.js";

export class Person {
  constructor(name, household = "", phone = "", remarks = "", homePhone = "") {
    this.name = name;
    this.household = household;
    this.phone = phone;
    this.remarks = remarks;
    this.home_phone = homePhone;
  }
}
export function phonesOf(people) {
  let home, own, phones;
  phones = py.list(people).map((one) => one.phone);
  own = py.list(phones).map((phone) => ((py.count(phones, phone) === 1) ? phone : ""));
  home = py.list(people).flatMap((one) => py.list([one.phone, one.home_phone]).map((phone) => phone));
  return [own, py.list(py.fromkeys(home)).flatMap((phone) => (((py.truth(phone) && !py.has(own, phone))) ? [phone] : []))];
}
export class Roster {
  constructor(benches = py.dict(), notes = []) {
    this.benches = benches;
    this.notes = notes;
  }
  get persons() {
    let named, one, people;
    named = py.dict([]);
    for (people of py.iter(py.values(this.benches))) {
      for (one of py.iter(people)) {
        py.append(py.setdefault(named, plain(one.name), []), one);
      }
    }
    return py.sum(py.list(py.values(named)).map((one) => _namesakes(one)));
  }
  people(bench) {
    return py.get(this.benches, bench, []);
  }
}
function _namesakes(people) {
  let above, known, marks, one;
  if (py.list(people).some((one) => (!py.truth(one.household) && !py.truth(one.phone)))) {
    return 1;
  }
  above = py.dict([]);
  function root(mark) {
    while (!py.eq(py.setdefault(above, mark, mark), mark)) {
      { const all = py.at(above, py.at(above, mark)); py.set(above, mark, all); mark = all; }
    }
    return mark;
  }
  for (one of py.iter(people)) {
    marks = [["household", one.household], ["phone", one.phone]];
    known = py.list(marks).flatMap((mark) => ((py.truth(py.at(mark, 1))) ? [mark] : []));
    py.set(above, root(py.at(known, -1)), root(py.at(known, 0)));
  }
  return py.len(py.set_of(py.list(py.list(above)).map((mark) => root(mark))));
}
