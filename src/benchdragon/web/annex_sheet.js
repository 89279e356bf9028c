// The permit annex: what an organiser hands in with an application, from the plan and its check. What the plan
// does not say is a blank to be filled in by hand; what the program knows nothing of is a heading with lines.
// No rule is quoted: which apply, the office says.

import { crowdPart, throughTexts } from "./annex_crowd.js";
import { annexMap } from "./annex_map.js";
import {
  DEVIATIONS,
  answerRow,
  askedText,
  blank,
  chapter,
  metres,
  reasonText,
  sourceRows,
  table,
} from "./annex_words.js";
import { ANALYSIS_POSTS, ANALYSIS_RUNNING, SOLVE_IMPRECISE } from "./compute/constants.js";
import { decimalsTowards, general } from "./compute/number_format.js";
import { make } from "./elements.js";
import { lasting } from "./made/clock.js";
import { roundedUp } from "./made/number_format.js";
import { Sayings } from "./sayings.js";
import { _, language } from "./words.js";

/** @typedef {import("./compute/annex.js").AnnexFacts} AnnexFacts */
/** @typedef {import("./compute/briefing.js").Briefing} Briefing */
/** @typedef {import("./name_list.js").NameList} NameList */
/** @typedef {import("./sheets.js").Built} Built */
/** @typedef {import("./sheets.js").Looks} Looks */
/** @typedef {import("./annex_words.js").Cell} Cell */
/** @typedef {[number, number]} Point */

const { RISK } = SOLVE_IMPRECISE;
/** A way that is no longer is none, m. */
const NEAR = 0.05;
/** Lines under a heading that the program knows nothing of. */
const LINES = 5;

/** The annex. @param {Briefing} briefing @param {NameList} names @param {Looks} looks @param {AnnexFacts} facts @returns {Built} */
export function annexSheet(briefing, { people }, { date, foot }, facts) {
  const said = new Sayings(briefing, people);
  const title = briefing.title[language()];
  const sheet = make(
    "article",
    { class: "annex" },
    make("h2", {}, title ? _("Permit annex: {title}", { title }) : _("Permit annex")),
    ...firstPage(said, facts),
    basics(said, facts),
    theDance(said, facts),
    theGround(said, facts),
    theTimes(briefing),
    thePeople(said, facts),
    clearances(facts),
    chapter(_("Speeds"), answers(_("greatest values over the whole dance"), facts.speeds)),
    posts(said, facts),
    chanceOf(facts),
    ...byHand(),
    sources(said, facts),
    make(
      "section",
      {},
      make("h3", {}, _("Version")),
      make(
        "p",
        {},
        _(
          "Made by benchdragon {version}. The plan was checked on {date} and bears the number {plan}. If the plan changes, this annex no longer holds.",
          { version: facts.version, date, plan: said.briefing.sha256.slice(0, 12) },
        ),
      ),
    ),
    make("footer", {}, foot),
  );
  return { pages: [sheet] };
}

/** What an officer reads first. @param {Sayings} said @param {AnnexFacts} facts */
function firstPage(said, facts) {
  const glance = chapter(
    _("At a glance"),
    facts.verdict[language()],
    ...facts.findings.map(({ code, text }) =>
      make("p", { class: "strong" }, _("Attention, {code}: {what}.", { code, what: text[language()] })),
    ),
    _(
      "Not considered: how spectators move, press or run, and how long they need to reach a way out; weather, light and the state of the ground, slopes, steps and kerbs; fire, from lanterns, fireworks, firecrackers and electricity; bearers who tire or fall, benches that break or come apart, a tail that swings out; weights and forces, and stands, stages and bridges that must bear them; vehicles, and anything that moves but the dragon; and what is not in the plan: obstacles, people and edges that nobody wrote down.",
    ),
    ...crowdPart(said, facts),
  );
  return [glance, theTail(said, facts)];
}

/** What the program does not know of the tail, and who walks there. @param {Sayings} said @param {AnnexFacts} facts */
function theTail(said, { dragon, ground, tail }) {
  const { first, off, beside } = tail;
  const beyond = make(
    "p",
    { class: "strong" },
    _("Where the spectators' line runs on the inside of a bend, benches may come beyond it."),
  );
  return chapter(
    _("The tail"),
    _(
      "Elsewhere here all benches are taken to keep to the line. Real bearers are drawn along by the bench before them and cut bends: how far is estimated below from how fast they steer back, for benches that are all on the line at the start. Whether benches that are off it touch one another, an obstacle or the edge, and how far a tail is thrown outwards, is not computed. Nobody should watch at bends where one cannot step back; the spectators' line keeps {margin} m from benches that keep to the line.",
      { margin: general(ground.margin) },
    ),
    ...(off.some(({ far }) => far == null || far + beside > ground.margin) ? [beyond] : []),
    table(
      _("the last benches"),
      [_("item"), _("as the plan says")],
      [
        [_("benches"), _("{first} to {last}", { first: said.called(first), last: said.called(dragon.count) })],
        [_("greatest speed among them that was seen"), tailSpeed(said, first)],
        [_("who stands at the tail, and who holds it back"), null],
        ...off.map((one) => [_("how far any bench leaves the line"), offTheLine(said.briefing.people, one)]),
      ],
      "facts",
    ),
  ); // prettier-ignore
}

/** How far benches leave the line, and what that rests on. @param {Record<string, any>} people @param {AnnexFacts["tail"]["off"][number]} one */
function offTheLine({ steering, source }, { gain, far }) {
  const told = {
    far: far == null ? "" : decimalsTowards(far, 1, true),
    way: (Math.log(2) / gain).toFixed(1),
    source: (steering != null && source.steering) || _("assumption"),
  };
  if (far == null) return _("not computed: it takes too much work");
  if (far === Infinity)
    return _("benches would fold, if bearers get back half of the way in {way} m ({source})", told);
  return _("about {far} m, if bearers get back half of the way in {way} m ({source})", told);
}

/** How fast the last benches go, and which of them when. @param {Sayings} said @param {number} first number of the first of them */
function tailSpeed(said, first) {
  const walked = said.briefing.benches
    .slice(first - 1)
    .flatMap(({ bench, stretches }) => stretches.map((/** @type {any} */ one) => ({ ...one, bench })));
  const { bench, start, end, speeds } = walked.reduce((one, other) =>
    other.speeds[1] > one.speeds[1] ? other : one,
  );
  return _("{speed} m/s: {bench}, {start} to {end}", {
    speed: decimalsTowards(speeds[1], 2, true),
    bench: said.called(bench),
    start: said.clock.tell(start),
    end: said.clock.tell(end),
  });
}

/** The facts of the event. @param {Sayings} said @param {AnnexFacts} facts */
function basics(said, { event }) {
  const place = language() === "zh" ? event.place_zh || event.place : event.place || event.place_zh;
  const told = (/** @type {unknown} */ value) => (value == null || value === "" ? null : String(value));
  /** @type {Cell[][]} */
  const rows = [
    [_("title"), told(said.briefing.title[language()])],
    [_("place"), told(place)],
    [_("date"), told(event.date)],
    [_("start of the dance"), told(said.briefing.clock)],
    [_("organiser"), told(event.organiser)],
    [_("whom to ask"), told(event.contact)],
    [_("spectators expected"), told(event.spectators)],
    [_("marshals"), told(event.marshals)],
  ];
  const blanks = rows.filter(([, value]) => value === null).map(([name]) => name);
  const names = blanks.join(_(", "));
  const found = chapter(
    _("Basics"),
    table(_("the event"), [_("item"), _("as the plan says")], rows, "facts"),
    ...(names ? [_("The plan does not say: {names}. Fill these in by hand.", { names })] : []),
    _(
      "This annex quotes no law and no rule. Which are in force, and what they ask for, is to be checked with the office that gives the permit.",
    ),
  );
  found.className = "basics";
  return found;
}

/** @param {Sayings} said @param {AnnexFacts} facts */
function theDance(said, { dragon, head }) {
  const { briefing } = said;
  const time = lasting(head.end - briefing.start);
  const [x, y] = said.ground.seen_at(briefing.benches[0].place);
  return chapter(
    _("The dragon and the dance"),
    _(
      "A bench dragon is a line of benches, joined by pins one behind the other and carried by people. This one has {count} benches and is {length} from the first pin to the last. The head's bench is {head} long, the second {body}; the widest is {width} wide.",
      {
        count: dragon.count,
        length: metres(dragon.length),
        head: metres(dragon.head),
        body: metres(dragon.body),
        width: metres(dragon.width),
      },
    ),
    _(
      "All pins follow one line on the ground, the route, one after another. The head walks {way} of it in {time}. It starts at x, y = {place} m from the peg.",
      { way: metres(head.way), time, place: `${x.toFixed(2)}, ${y.toFixed(2)}` },
    ),
    said.ground.legend,
  );
}

/** The ground covered in numbers, and as a picture to scale. @param {Sayings} said @param {AnnexFacts} facts */
function theGround(said, facts) {
  const { ground } = facts;
  const { figure, scale } = annexMap(said.briefing, facts);
  const { width, height } = ground.rectangle;
  /** @type {Cell[][]} */
  const rows = [
    [_("ground within the spectators' line, all of it"), `${decimalsTowards(ground.within, 0, true)} m²`],
    [_("of it, what boards pass over: strips along the route"), `${decimalsTowards(ground.area, 1, true)} m²`],
    [_("smallest rectangle that holds these strips"), `${roundedUp(width)} m × ${roundedUp(height)} m`],
    [_("length of the spectators' line round the outside"), metres(ground.length)],
  ]; // prettier-ignore
  return chapter(
    _("Route and ground, to scale"),
    _(
      "The area below contains everything that any bench covers from the start of the dance to its end; nothing of it is farther than {error} from what is covered. It is the benches' own: people who stand out beyond their sides need more (see Clearances and margins).",
      { error: metres(ground.error, true) },
    ),
    table(_("the ground"), [_("item"), _("value")], rows, "facts"),
    make(
      "div",
      { class: "kept" },
      make("p", {}, _("Scale 1:{scale} on A4, printed at 100 %, not fitted to the page.", { scale })),
      figure,
    ),
  );
}

/** When head and tail pass each place. @param {Briefing} briefing */
function theTimes({ timetable }) {
  const { name, columns, rows, lines } = timetable[language()];
  return chapter(_("Timetable"), ...lines, table(name, columns, rows));
}

/** How many people there are. @param {Sayings} said @param {AnnexFacts} facts */
function thePeople(said, { dragon, event }) {
  const { persons } = said;
  const without = said.briefing.benches.filter(({ bench }) => !said.people.get(bench)?.length).length;
  const told = (/** @type {unknown} */ value) => (value == null ? null : String(value));
  /** @type {Cell[][]} */
  const rows = [
    [_("benches"), String(dragon.count)],
    [_("bearers in the list of names"), persons ? String(persons) : null],
    [_("benches for which the list names nobody"), persons ? String(without) : null],
    [_("marshals"), told(event.marshals)],
    [_("spectators expected"), told(event.spectators)],
  ];
  return chapter(
    _("People"),
    table(_("numbers of people"), [_("item"), _("value")], rows, "facts"),
    _("Names and telephone numbers of bearers are not part of this annex."),
  );
}

/** @param {string} name @param {AnnexFacts["speeds"]} told */
function answers(name, told) {
  const heads = [_("what"), _("value"), _("bracket"), _("how"), _("asked for")];
  return table(name, heads, told.map(answerRow));
}

/** What benches keep from one another and from the square. @param {AnnexFacts} facts */
function clearances({ clearances: told, room }) {
  return chapter(
    _("Clearances and margins"),
    _(
      "Each number was computed over the whole dance, between instants too; the bracket holds the true value. They speak of benches that keep exactly to the plan.",
    ),
    answers(_("least distances over the whole dance"), told),
    _("What these numbers rest on: rigid, level benches whose pins keep to the route."),
    ...(room.length
      ? roomFor(room)
      : [
          _(
            "The plan says nothing of the room that bearers need beside the benches: these distances are those of the benches alone.",
          ),
        ]),
  );
}

/** Room for people, level upon level. @param {AnnexFacts["room"]} room */
function roomFor(room) {
  const heads = [_("room"), _("asked for"), _("between benches side by side, at least"), _("verdict")];
  const rows = room.map(({ name, asked, between, kept }) => [
    name[language()],
    askedText(asked),
    `${general(between)} m`,
    kept == null ? _("undecided") : kept ? _("kept") : _("not kept"),
  ]);
  return [
    _("Room for people, one thing after another, each with all before it:"),
    table(_("room for people"), heads, rows),
    _(
      "Room is asked for at the sides of benches. Benches one behind another in the line, such as the next but one, may be nearer: see the least clearances above.",
    ),
  ];
}

/** Posts for marshals. @param {Sayings} said @param {AnnexFacts} facts */
function posts(said, facts) {
  const { ground, crowd, event } = facts;
  const { EVERY, MOST_RUNS } = ANALYSIS_POSTS;
  const rows = facts.posts.map(({ point, reasons }, n) => [
    String(n + 1),
    placeText(said, point),
    reasons.map((one) => reasonText(one, said.clock)).join(_("; ")),
  ]);
  const outside = _(
    "Somewhere the spectators' line lies outside the venue's edge: nobody can stand there, and whoever watches over it stands at the nearest place inside.",
  );
  const round = _(
    "Where benches go round ground that they leave free, such as the middle of a coil, the drawing has a line there too: it is no place for spectators, and has no posts.",
  );
  return chapter(
    _("Spectators' line and posts for marshals"),
    _(
      "The spectators' line keeps {distance} from the ground that benches cover. Posts are proposed by a rule of this program, which is no regulation: where benches come nearest to the venue's edge, at entrances that the plan names, where benches come nearest to one another, where the fastest handle is (unless all are about as fast), where else handles run, and between these so that no two that follow one another are farther apart than {every} along the line.",
      { distance: metres(ground.margin), every: metres(EVERY) },
    ),
    _(
      "Handles run where they go at {run} m/s or more. Positions where they do are one stretch if they are within {apart} of one another. The fastest position of each stretch has a post, if it is farther than that from the fastest handle: of the {most} fastest stretches at most.",
      {
        run: general(said.briefing.people.run_from),
        apart: metres(ANALYSIS_RUNNING.APART),
        most: MOST_RUNS,
      },
    ),
    _(
      "Each post stands on the line. What it watches lies inside the line, and at an entrance outside.",
    ),
    ...(ground.round ? [round] : []),
    _(
      "The line is drawn closed. The organiser leaves it open where the dragon comes in and where it goes out.",
    ),
    ...(crowd.way === 0 ? [outside] : []),
    table(_("posts for marshals"), [_("post"), _("place"), _("reason")], rows, "posts"),
    ...fewer(facts.posts.length, event.marshals),
  );
}

/** That there are fewer marshals than posts. @param {number} count @param {number | null} marshals */
function fewer(count, marshals) {
  if (marshals == null || marshals >= count) return [];
  const values = { posts: count, marshals, less: count - marshals };
  return [_("There are {posts} posts and {marshals} marshals: {less} fewer than posts.", values)];
}

/** A place as told from what stays on the square while people dance: what is nearest to it. @param {Sayings} said @param {Point} place */
function placeText({ briefing, ground }, place) {
  const { ways } = briefing;
  /** @type {Array<[string, Point]>} */
  const things = ways.entrances.map((one, n) => [_("entrance {n}", { n: n + 1 }), one]);
  for (const { kind, points, shown } of ways.obstacles) {
    if (kind === "venue") continue;
    const sum = points.reduce(([x, y], [u, v]) => [x + u, y + v], [0, 0]);
    things.push([shown[language()], [sum[0] / points.length, sum[1] / points.length]]);
  }
  if (!things.length) things.push([_("the peg"), ground.peg]);
  const away = (/** @type {Point} */ one) => Math.hypot(one[0] - place[0], one[1] - place[1]);
  const [name, at] = things.reduce((one, other) => (away(other[1]) < away(one[1]) ? other : one));
  const [x, y] = ground.seen_at(place).map((value, n) => value - ground.seen_at(at)[n]);
  const [ahead, left, back, right] = ground.way_names;
  /** @type {Array<[number, string]>} */
  const steps = [[Math.abs(x), x < 0 ? back : ahead], [Math.abs(y), y < 0 ? right : left]]; // prettier-ignore
  const told = steps
    .filter(([far]) => far >= NEAR)
    .map(([far, way]) => _("{far} m {way}", { far: far.toFixed(1), way }))
    .join(_(", "));
  return told ? _("from {name}: {steps}", { name, steps: told }) : name;
}

/** How likely imprecise people come too near. @param {AnnexFacts} facts */
function chanceOf({ chance, margin }) {
  const name = _("Imprecision and its chance");
  if (!chance.draws)
    return chapter(
      name,
      _("Random dances could not be walked for this plan: nothing is said of the chance."),
    );
  const values = {
    draws: chance.draws,
    hits: chance.hits,
    risk: general(100 * RISK),
    margin: metres(margin),
    high: decimalsTowards(100 * chance.most, 1, true),
  };
  const said = chance.shown
    ? _(
        "People are not exact. {draws} dances were drawn at random, with the deviations below. In {hits} of them benches came nearer to one another than the {margin} asked for, or could not follow. So the chance of that is at most {high} %, with a confidence of 95 %: less than the {risk} % that this annex asks for.",
        values,
      )
    : _(
        "People are not exact. Dances were drawn at random, with the deviations below: {hits} of the first {draws} came nearer than the {margin} asked for, or could not follow. That is too many to show that the chance of it is below {risk} %, so no number is told: practise, ask for more room, or draw more dances (benchdragon margins).",
        values,
      );
  const rows = Object.keys(DEVIATIONS).map((key) => [
    _(DEVIATIONS[key]),
    `${general(chance.deviations[key])} m`,
  ]);
  return chapter(
    name,
    said,
    table(_("deviations of random dances"), [_("deviation"), _("standard deviation")], rows, "facts"),
    _(
      "What these dances do not count: the venue's edge and obstacles, the room of people, sway, an uneven pace, falls, and deviations that depend on one another.",
    ),
  );
}

/** What is left to the organiser: a plan of a dance says nothing of it. */
function byHand() {
  const names = [
    _("How it is organised, and tasks and marks of safety staff"),
    _("Fire safety"),
    _("Buffer areas and their signs"),
    _("Tickets and security checks"),
    _("Vehicles, parking and ways of the crowd"),
    _("Emergencies"),
  ];
  return names.map((name) =>
    chapter(
      name,
      _("To be filled in by the organiser: the plan of the dance says nothing of it."),
      ...Array.from({ length: LINES }, () => make("p", { class: "line" }, blank())),
    ),
  );
}

/** Figures and where they come from. @param {Sayings} said @param {AnnexFacts} facts */
function sources({ briefing }, { ground, exits }) {
  const distance = ground.given
    ? _("as the plan says")
    : _("assumption of this program, since the plan says none");
  const rows = [
    ...sourceRows(briefing.people),
    [_("distance of the spectators' line"), `${general(ground.margin)} m`, distance],
    [_("deviations of random dances"), "–", _("assumption of this program")],
  ];
  return chapter(
    _("Figures and where they come from"),
    _("A number that has no source is an assumption: somebody is to check it on the spot."),
    table(_("figures and sources"), [_("figure"), _("value"), _("source")], rows),
    ...throughTexts(exits),
  );
}
