// Made from benchdragon.player.messages and benchdragon.planner.messages by tools/make_types.py; to make it again: make generate

/** A solved number and the bracket that was established: see `answer.Answer`. */
export interface Answer {
  value: number | null;
  lower: number | null;
  upper: number | null;
  unit: string;
  status: "proved" | "found" | "infeasible" | "undecided" | "unlimited";
  witness: Witness | null;
  assumptions: Array<string>;
  evaluations: number;
  seconds: number | null;
  plan_sha256: string;
  version: string;
}

/** A circular arc; a positive angle turns left. */
export interface ArcPart {
  kind: "arc";
  radius: number;
  angle: number;
}

/** Someone who carries a bench: see `roster.Person`. */
export interface Bearer {
  name: string;
  household: string;
  phone: string;
  remarks: string;
  home_phone: string;
}

/** The drum of a dance, by rule: see `beats.Score`. */
export interface Beats {
  tempo: number;
  runs: Array<Run>;
  strokes: Array<number>;
}

/** One bench of its own size; `count` repeats it. */
export interface BenchTable {
  length: number;
  width?: number;
  front_inset?: number;
  rear_inset?: number;
  count?: number;
}

/**
 * The chalk line and the peg: all papers of a dance measure from one.
 *
 * Attributes:
 *     stray: how far the line may stray where ticks are joined straight, m; None for half a link.
 *     peg: where the peg stands, m; None for the centre of the route.
 */
export interface ChalkTable {
  stray?: number | null;
  peg?: [number, number] | null;
}

/** A round obstacle. */
export interface CircleTable {
  name?: string;
  margin?: number | null;
  kind: "circle";
  centre: [number, number];
  radius: number;
}

/** A curve whose curvature changes evenly; positive curvature, 1/m, turns left. */
export interface ClothoidPart {
  kind: "clothoid";
  length: number;
  start_curvature?: number;
  end_curvature?: number;
}

/**
 * The route as cubics between nodes.
 *
 * `packed` holds x, y (m, from `origin`) and heading (rad) of every node as float32, x of all nodes
 * first; see `frames.packed_bytes`.
 */
export interface Course {
  stretches: Array<Stretch>;
  origin: [number, number];
  packed: string;
}

/**
 * One cue, at a time or at a place of the head.
 *
 * Attributes:
 *     at: when, s.
 *     head: where the head is then, m of its walk from the start of the dance.
 *     place: a point on the ground, m, to which the head is nearest then: for the first time, or in
 *         a round.
 *     round: of the dance: that of the place, or the one that the head begins then.
 *     hold: for how long the head stands, s.
 *     tempo: beats a minute from then on.
 */
export interface CueTable {
  kind: "beat" | "hold" | "stop" | "start" | "tempo" | "note";
  at?: number | null;
  head?: number | null;
  place?: [number, number] | null;
  round?: number | null;
  hold?: number | null;
  tempo?: number | null;
  text?: string;
  text_zh?: string;
}

/**
 * Drum, tempo, holds and stops.
 *
 * Attributes:
 *     tempo: beats a minute; None: a step a beat.
 *     bar: beats of a bar.
 *     acceleration: at which the head brakes and starts, m/s^2; None: limits.head_acceleration.
 *     clock: the time of day at which the dance starts.
 *     cue: one after another, or in any order.
 */
export interface CuesTable {
  tempo?: number | null;
  bar?: number;
  acceleration?: number | null;
  clock?: string;
  cue?: Array<CueTable>;
}

/**
 * A whole dance, as a player shows it.
 *
 * Attributes:
 *     ground: outlines of the ground that the dance covers, m, those around holes too; of plans with a
 *         square alone.
 *     beats: of plans with cues alone.
 *     papers: of plans with people or cues alone.
 *     village: of plans that say how benches are counted alone.
 *     north: whether y points north.
 *     entrances: where people come in, x and y, m, and how wide, m, where that is known.
 */
export interface Dance {
  version: string;
  plan_sha256: string;
  title: Words;
  benches: Sizes;
  disc: number | null;
  centre: [number, number];
  course: Course;
  frames: Frames;
  following: Following | null;
  occasions: Array<Occasion>;
  nearest: Nearest;
  tightness: Tightness;
  margin: number;
  speed_limit: number | null;
  obstacles: Array<DrawnObstacle>;
  ground: Array<Array<[number, number]>>;
  verdict: Verdict | null;
  beats?: Beats | null;
  papers?: Papers | null;
  village?: Village | null;
  north?: boolean;
  entrances?: Array<Array<number>>;
}

/** The turning space: a circle about the spiral's centre. */
export interface DiscTable {
  radius?: number | null;
}

/** The dragon: one set of sizes, or `[[dragon.bench]]` for each bench its own. */
export interface DragonTable {
  benches?: number;
  width?: number;
  head_length?: number;
  body_length?: number;
  tail_length?: number;
  front_inset?: number;
  rear_inset?: number;
  bench?: Array<BenchTable>;
}

/**
 * An obstacle, or the venue's edge: see `obstacle.Obstacle`.
 *
 * Attributes:
 *     name: in both languages.
 *     kind: "line" alone has no inside, and "venue" has its inside free.
 *     points: corners, m; of a circle the centre.
 *     radius: of a circle, m; else 0.
 *     margin: m.
 *     open: of a venue with the gate of a street, what benches must not touch, m; else empty.
 *     left: of a venue with gates or entrances, what they leave of its edge, m; else empty.
 */
export interface DrawnObstacle {
  name: Words;
  kind: "circle" | "rectangle" | "polygon" | "line" | "venue";
  points: Array<[number, number]>;
  radius: number;
  margin: number;
  open?: Array<[number, number]>;
  left?: Array<Array<[number, number]>>;
}

/**
 * Along a line that was drawn or surveyed.
 *
 * A closed line is walked once round, and the dragon stands on it behind its head, however often
 * that leads round.
 */
export interface DrawnRoute {
  points?: Array<[number, number]> | null;
  piece?: Array<PieceTable> | null;
  file?: string | null;
  layer?: string | null;
  deviation?: number;
  smooth?: "none" | "G1" | "G2";
  least_radius?: number | null;
  joint_gap?: number;
  joint_kink?: number;
  drawn_within?: number;
  at?: [number, number] | null;
  turned?: number;
  kind: "drawn";
  closed?: boolean;
}

/**
 * What the permit annex says of the event; what is not said is left to be filled in by hand.
 *
 * Attributes:
 *     place: where it is.
 *     place_zh: the same in Chinese.
 *     date: the day, or the days.
 *     organiser: who is responsible for it.
 *     contact: who is asked about it.
 *     spectators: how many are expected.
 *     marshals: how many there will be.
 *     distance: of the spectators' line from the ground that the benches cover, m.
 *     entrances: where people come in, x and y, m, and how wide, m, where that is known.
 */
export interface EventTable {
  place?: string;
  place_zh?: string;
  date?: string;
  organiser?: string;
  contact?: string;
  spectators?: number | null;
  marshals?: number | null;
  distance?: number | null;
  entrances?: Array<Array<number>>;
}

/** One figure of a preset: its key in the plan, and where it comes from. */
export interface Figure {
  key: string;
  status: "measured" | "reported" | "derived" | "assumed";
}

/**
 * A violation of the plan, or an undecided question: see `findings.Finding`.
 *
 * Attributes:
 *     code: BD101 and so on: those never change.
 *     obstacle: the name of the obstacle, null without one.
 */
export interface Finding {
  code: string;
  kind: string;
  decided: boolean;
  text: Words;
  time: number | null;
  benches: Array<number>;
  value: number | null;
  limit: number | null;
  obstacle?: string | null;
}

/**
 * How much longer than `link`, m, the way from a handle back to the next is, by its place.
 *
 * Cubics between nodes; `packed` holds the values of all nodes, then their changes along the route, as
 * whole multiples of `fine`; see `following.Table`.
 */
export interface FollowTable {
  link: number;
  stretches: Array<Stretch>;
  fine: number;
  packed: string;
}

/**
 * How the handles of a long dance follow its head, whose frames alone are sent.
 *
 * Attributes:
 *     tables: one for each length of link.
 *     kinds: number of each bench's table.
 *     fastest: greatest speed of each bench's front handle, m/s.
 *     when: time of that, s.
 *     speeds: least and greatest of all handles, m/s.
 *     change: the greatest change of a handle's speed, m/s^2.
 */
export interface Following {
  tables: Array<FollowTable>;
  kinds: Array<number>;
  fastest: Array<number>;
  when: Array<number>;
  speeds: [number, number];
  change: number;
}

/** One formation; at time 0 the whole dragon stands on it, its tail at the start. */
export interface FormationRoute {
  name: "coil-in" | "coil-out" | "figure-eight" | "three-plum-blossoms" | "double-door" | "straight-dragon" | "tail-swing";
  pitch?: number | null;
  outer_radius?: number | null;
  inner_radius?: number | null;
  between?: number | null;
  radius?: number | null;
  waist?: number | null;
  length?: number | null;
  swing?: number | null;
  run?: number | null;
  swings?: number | null;
  rounds?: number | null;
  clockwise?: boolean | null;
  at?: [number, number] | null;
  turned?: number;
  street?: StreetTable | null;
  kind: "formation";
}

/** A size of a formation: see `formations.Size`; `usual` where nothing is said. */
export interface FormationSize {
  name: string;
  text: Words;
  least: number;
  most: number;
  unit: string;
  usual: number;
}

/**
 * Route positions and speeds of handles at evenly spaced times, packed.
 *
 * Of all handles, or of the head's alone where the dance says how the others follow. Handle by handle;
 * see `frames.packed_frames`. Between them positions go along cubics, speeds along lines; in all
 * samples no handle was farther than `largest_error` (m) from its place. They were taken `everywhere`,
 * between all frames, or for a first picture between few.
 */
export interface Frames {
  start: number;
  step: number;
  count: number;
  quantum: number;
  packed: string;
  largest_error: number;
  everywhere: boolean;
}

/** A time in which the head, and with it every handle, stands: see `stops.Stop`. */
export interface HeadStop {
  start: number | null;
  end: number | null;
  s: number | null;
}

/**
 * The state of a long question.
 *
 * Attributes:
 *     share: of the work done, 0 to 1, estimated.
 *     text: what is being done.
 *     result: once it is done.
 *     error: why there is none, if it failed.
 */
export interface JobState {
  question: "turn" | "speed" | "pace" | "margins";
  state: "running" | "done" | "failed" | "cancelled";
  share: number;
  text: string;
  result?: TurnFound | PaceFound | MarginsFound | Answer | null;
  error?: string | null;
}

/** The greatest value of a quantity that the plan limits, and its name in words. */
export interface LimitedPeak {
  name: string;
  text: Words;
  peak: Answer;
}

/**
 * The limits of a walk.
 *
 * Greatest speed and accelerations (m/s^2) of any handle: along the route, across it and in total;
 * turning rate (degrees a second) of any bench, change of the head's own speed (m/s^2), and distance
 * of non-adjacent benches.
 */
export interface LimitsTable {
  speed?: number | null;
  acceleration?: number | null;
  lateral_acceleration?: number | null;
  total_acceleration?: number | null;
  turning_rate?: number | null;
  head_acceleration?: number;
  margin?: number;
  venue_margin?: number | null;
}

/** A straight line. */
export interface LinePart {
  kind: "line";
  length: number;
}

/** A chain of straight lines. */
export interface LineTable {
  name?: string;
  margin?: number | null;
  kind: "line";
  points: Array<[number, number]>;
}

/** A logarithmic spiral: both its curvatures, 1/m, have the same sign; positive ones turn left. */
export interface LogSpiralPart {
  kind: "log-spiral";
  length: number;
  start_curvature: number;
  end_curvature: number;
}

/** What imprecise dances need: see `tolerance.Tolerance`; chance at the plan's own pitch. */
export interface MarginsFound {
  draws: number;
  exact: number | null;
  pitch: number;
  chance: number;
  chance_lower: number;
  chance_upper: number;
  pitch_for: Array<PitchFor>;
}

/** Titles of the plan. */
export interface MetaTable {
  title?: string;
  title_zh?: string;
  author?: string;
  notes?: string;
}

/** A formation that plans can name. */
export interface NamedFormation {
  name: string;
  title: Words;
  sizes: Array<FormationSize>;
}

/** A list of names that was read: the people of benches, by number, and what is odd about it. */
export interface NamesHeld {
  people: Array<[number, Array<Bearer>]>;
  notes: Array<string>;
}

/**
 * When each bench comes nearest to a non-adjacent one, in samples.
 *
 * Distance, m (minus the depth of an overlap), time, s, and number of the other bench; 0 where it
 * never comes within `reach`.
 */
export interface Nearest {
  reach: number;
  distance: Array<number>;
  time: Array<number>;
  other: Array<number>;
}

/** A subject that the check did not consider: see `not_looked_at.NotLookedAt`. */
export interface NotLookedAt {
  kind: string;
  text: Words;
}

/**
 * The answers about an obstacle, or the venue's edge: see `obstacles.ObstacleAnswers`.
 *
 * Attributes:
 *     name: what the plan calls it.
 *     shown: the name for readers; without a name, the number.
 *     kind: of the obstacle.
 *     margin: m.
 *     contact: when a bench first comes nearer than the margin; null if none does.
 *     distance: the least that benches keep from it, m.
 */
export interface ObstacleRecord {
  name: string;
  shown: Words;
  kind: "circle" | "rectangle" | "polygon" | "line" | "venue";
  margin: number | null;
  contact: Answer | null;
  touch: Answer | null;
  distance: Answer;
}

/**
 * Something that happens at a time.
 *
 * Attributes:
 *     kind: what.
 *     time: s.
 *     text: in words.
 *     benches: numbers from 1.
 *     obstacle: number of the obstacle that takes part, from 0.
 */
export interface Occasion {
  kind: "contact" | "tightest" | "fastest" | "joint" | "end" | "obstacle" | "venue" | "cue";
  time: number;
  text: Words;
  benches: Array<number>;
  obstacle?: number | null;
}

/** The plan walked at its own head speed, slowed down only where a limit requires it. */
export interface PaceFound {
  plan: Record<string, unknown>;
  steady: Answer;
  seconds: number | null;
  saved: number | null;
}

/**
 * How papers tell times: see `clock.Clock`.
 *
 * Attributes:
 *     said: the time of day at which the dance starts, or "".
 *     start: of the dance, s.
 */
export interface Papers {
  said: string;
  start: number;
}

/** Any parts, each moved to where the one before it ends. */
export interface PartsRoute {
  at?: [number, number] | null;
  turned?: number;
  street?: StreetTable | null;
  kind: "parts";
  part: Array<LinePart | ArcPart | ClothoidPart | SpiralPart | LogSpiralPart>;
  start?: [number, number] | null;
  heading?: number | null;
}

/**
 * Who carries the benches, the room that they need, and their speeds.
 *
 * Attributes:
 *     roster: a list of names beside the plan; `sheet` of it, if it has several.
 *     unit: what benches are counted in.
 *     count_head: whether the head's bench is number 1; else it is called the head, and 1 the next.
 *     beside: room for bearers on each side of a bench, m.
 *     ahead: room that is free before the head's bench, m.
 *     sway: how far benches sway to a side, m.
 *     imprecision: how far bearers stray from their line, m.
 *     steering: how fast bearers steer back, 1/m: an offset falls to 37 % over 1 / steering.
 *     step: length of a step, m.
 *     hurry_from: speed from which walking is called hurrying, m/s.
 *     run_from: speed from which it is called running, m/s.
 *     most_speed: the greatest at which a bench can be carried, m/s.
 *     address: where the player of the dance will be: http, https, or a relative file.
 */
export interface PeopleTable {
  roster?: string;
  sheet?: string;
  unit?: "bench" | "qiao" | "jie";
  count_head?: boolean;
  beside?: number;
  ahead?: number;
  sway?: number;
  imprecision?: number;
  steering?: number | null;
  step?: number;
  hurry_from?: number;
  run_from?: number;
  most_speed?: number | null;
  address?: string;
  source?: SourcesTable;
}

/** A surveyed line, arc or clothoid, where it was surveyed. */
export interface PieceTable {
  start: [number, number];
  heading: number;
  length: number;
  start_curvature?: number;
  end_curvature?: number;
}

/** The pitch, m, at which benches touch with at most that chance, with 95 % confidence. */
export interface PitchFor {
  risk: number;
  pitch: number | null;
}

/** A whole plan. */
export interface Plan {
  schema: 1;
  meta?: MetaTable;
  dragon?: DragonTable;
  route: SpiralInRoute | TurnRoute | PartsRoute | FormationRoute | ProgrammeRoute | DrawnRoute;
  disc?: DiscTable;
  turn?: TurnTable;
  walk?: WalkTable;
  limits?: LimitsTable;
  venue?: VenueTable;
  obstacle?: Array<CircleTable | RectangleTable | PolygonTable | LineTable>;
  survey?: SurveyTable;
  people?: PeopleTable;
  cues?: CuesTable;
  chalk?: ChalkTable;
  event?: EventTable;
}

/** An obstacle with any number of corners. */
export interface PolygonTable {
  name?: string;
  margin?: number | null;
  kind: "polygon";
  points: Array<[number, number]>;
}

/** A dance to begin with: see `presets.Preset`. */
export interface Preset {
  name: string;
  title: Words;
  source: Words;
  figures: Array<Figure>;
  plan: Record<string, unknown>;
}

/** Formations one after another; at time 0 the whole dragon stands on the route, as above. */
export interface ProgrammeRoute {
  at?: [number, number] | null;
  turned?: number;
  street?: StreetTable | null;
  kind: "programme";
  formation: Array<StepTable>;
  radius?: number;
}

/** A rectangular obstacle. */
export interface RectangleTable {
  name?: string;
  margin?: number | null;
  kind: "rectangle";
  centre: [number, number];
  size: [number, number];
  angle?: number;
}

/**
 * A requirement that a level of room adds to the one before it: see `room.Asked`.
 *
 * Attributes:
 *     source: null for an assumption.
 */
export interface RoomAsked {
  key: string;
  value: number | null;
  source: string | null;
}

/**
 * Whether a walk keeps a level of room: see `room.RoomLevel`.
 *
 * Attributes:
 *     kept: null where rounding leaves that undecided.
 *     first: when it is first broken, and by which benches; null where it is kept.
 *     obstacle: the name of the obstacle then, null without one.
 */
export interface RoomRecord {
  name: "benches" | "sway" | "imprecision" | "people";
  text: Words;
  asked: Array<RoomAsked>;
  margin: number | null;
  kept: boolean | null;
  first: Answer | null;
  obstacle: string | null;
}

/** Even beats: see `beats.Run`. */
export interface Run {
  start: number;
  end: number;
  period: number;
  bar: number;
  counted: boolean;
}

/** Sizes of every bench, m, bench 1 first. */
export interface Sizes {
  length: Array<number>;
  width: Array<number>;
  front_inset: Array<number>;
  rear_inset: Array<number>;
}

/** Where numbers about people come from; what has no source is an assumption. */
export interface SourcesTable {
  beside?: string;
  ahead?: string;
  sway?: string;
  imprecision?: string;
  steering?: string;
  step?: string;
  hurry_from?: string;
  run_from?: string;
  most_speed?: string;
}

/** In along one spiral, from a turn number at theta = 0 of the last turn, to disc or centre. */
export interface SpiralInRoute {
  at?: [number, number] | null;
  turned?: number;
  street?: StreetTable | null;
  kind: "spiral-in";
  pitch?: number;
  start_turn?: number;
  clockwise?: boolean;
}

/** An Archimedean spiral from one radius to another; as first part its centre is the origin. */
export interface SpiralPart {
  kind: "spiral";
  pitch: number;
  start_radius: number;
  end_radius: number;
  clockwise?: boolean;
}

/** A formation of a programme, and where it is danced. */
export interface StepTable {
  name: "coil-in" | "coil-out" | "figure-eight" | "three-plum-blossoms" | "double-door" | "straight-dragon" | "tail-swing";
  pitch?: number | null;
  outer_radius?: number | null;
  inner_radius?: number | null;
  between?: number | null;
  radius?: number | null;
  waist?: number | null;
  length?: number | null;
  swing?: number | null;
  run?: number | null;
  swings?: number | null;
  rounds?: number | null;
  clockwise?: boolean | null;
  at?: [number, number] | null;
  turned?: number;
}

/** A street that is walked before a dance: it lies where it was drawn, wherever that is danced. */
export interface StreetTable {
  points?: Array<[number, number]> | null;
  piece?: Array<PieceTable> | null;
  file?: string | null;
  layer?: string | null;
  deviation?: number;
  smooth?: "none" | "G1" | "G2";
  least_radius?: number | null;
  joint_gap?: number;
  joint_kink?: number;
  drawn_within?: number;
  radius?: number;
  width?: number;
}

/** Nodes of a stretch of the route, evenly spaced: the next stretch begins where this ends. */
export interface Stretch {
  start: number;
  step: number;
  nodes: number;
}

/** What the coordinates of the plan's files mean; `origin` is what lies at (0, 0) in the plan. */
export interface SurveyTable {
  crs?: string | null;
  unit?: string | null;
  origin?: [number, number] | null;
}

/** Distance of the tightest pair, m, at evenly spaced times; capped at `Nearest.reach`. */
export interface Tightness {
  start: number;
  step: number;
  distance: Array<number>;
}

/**
 * The best turn found, and the plan with it: see `turn.BestTurn`.
 *
 * `way_before` is the way inside the disc of the turn that the plan had, m.
 */
export interface TurnFound {
  plan: Record<string, unknown>;
  objective: Answer;
  length: number | null;
  way: number | null;
  way_before: number | null;
  least_radius: number | null;
  head_speed: Answer | null;
  clearance: Answer;
  active: Array<string>;
}

/**
 * In along a spiral, the turn of `[turn]` inside the disc, out along the spiral's twin.
 *
 * With `rounds` again and again: at `outer_radius` the head turns back, round the coil, and in.
 */
export interface TurnRoute {
  at?: [number, number] | null;
  turned?: number;
  street?: StreetTable | null;
  kind: "turn";
  pitch?: number;
  rounds?: number;
  outer_radius?: number | null;
  back_radius?: number | null;
}

/** The turn of a plan: its own length and the radius of its tightest bend, m. */
export interface TurnShape {
  length: number | null;
  least_radius: number | null;
}

/**
 * The turn inside the disc: what lies between the joints with the spirals.
 *
 * `ratio` belongs to arc-arc, `radii` (of the first and the last arc) to the other families, and
 * `curvature` (of the middle arc, 1/m, left positive) to arc-arc-arc. Clothoids of `ease` metres make
 * the curvature continuous.
 */
export interface TurnTable {
  family?: "arc-arc" | "arc-line-arc" | "arc-arc-arc";
  ratio?: number;
  radii?: [number, number] | null;
  curvature?: number;
  entry_radius?: number | null;
  exit_radius?: number | null;
  ease?: number;
}

/** An answer whose proof failed: see `left_open.Unproved`. */
export interface Unproved {
  kind: string;
  text: Words;
}

/**
 * The edge of the venue: `boundary`, its corners, or a `rectangle` about a `centre`.
 *
 * A `file` with the edge, or a `layer` of it, becomes its corners when the plan is read.
 */
export interface VenueTable {
  boundary?: Array<[number, number]> | null;
  rectangle?: [number, number] | null;
  centre?: [number, number] | null;
  angle?: number | null;
  name?: string;
  file?: string | null;
  layer?: string | null;
}

/**
 * Whether a walk is safe, in one sentence and in full.
 *
 * Attributes:
 *     safe: whether nothing was found.
 *     decided: whether no undecided question could change `safe`.
 *     proved: whether the answers about contact were proved.
 *     unproved: the answers whose proof failed, and why; they stay as found.
 *     sentence: the verdict for readers.
 *     start: of the walk, s.
 *     end: of the walk, s.
 *     clearance: null where the dragon cannot walk, like the following.
 *     not_looked_at: what the check did not consider because the plan does not give it.
 *     room: level upon level, benches alone first; empty where the plan asks for no room for people.
 *     stops: of the head; null for a plan without cues.
 *     seconds: how long it took; null in files, which are the same each time.
 */
export interface Verdict {
  safe: boolean;
  decided: boolean;
  proved: boolean;
  unproved: Array<Unproved>;
  sentence: Words;
  start: number | null;
  end: number | null;
  first_contact: Answer | null;
  clearance: Answer | null;
  greatest_speed: Answer | null;
  peaks: Array<LimitedPeak>;
  obstacles: Array<ObstacleRecord>;
  room: Array<RoomRecord>;
  findings: Array<Finding>;
  not_looked_at: Array<NotLookedAt>;
  stops?: Array<HeadStop> | null;
  seconds: number | null;
  plan_sha256: string;
  version: string;
}

/**
 * What a village calls its benches: head and tail by name, {n} for the number of those between.
 *
 * That number is the plan's, less `before`.
 */
export interface Village {
  head: Words;
  between: Words;
  tail: Words;
  before: number;
}

/**
 * The head's walk: a constant speed, or `profile`, [time, speed] pairs joined by straight lines.
 *
 * `start` and `end` are times; `position` is the head's route position at time 0, where it is not
 * to stand where the route's kind says.
 */
export interface WalkTable {
  speed?: number;
  profile?: Array<[number, number]>;
  start?: number | null;
  end?: number | null;
  position?: number | null;
}

/**
 * The papers on which a page opens.
 *
 * Attributes:
 *     only: their names; none: all.
 *     paper: the size of benches' sheets.
 *     households: whether benches of a household share a sheet.
 *     night: whether the type is large.
 *     phones: whether phone numbers are printed.
 *     names: who carries; null: without names.
 */
export interface WantedPapers {
  only: Array<string>;
  paper: "a4" | "quarter" | "lanyard";
  households: boolean;
  night: boolean;
  phones: boolean;
  names: NamesHeld | null;
}

/** Where and when the value of an answer occurs: see `answer.Witness`. */
export interface Witness {
  time: number | null;
  s: number | null;
  benches: Array<number>;
  point: [number | null, number | null];
  gap: number | null;
  features: Array<[number, string]>;
  handle: number | null;
  obstacle: string | null;
}

/** The same words in both languages. */
export interface Words {
  en: string;
  zh: string;
}
