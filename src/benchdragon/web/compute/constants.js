// Numbers of the kernels and of modules that have twins here. Made by tools/make_constants.py;
// to make it again: make generate

export const BENCH_NEARNESS = { REACH: 1.5, OTHER_COIL: 3, TIGHTEST_COLUMNS: 9, NEAR_COLUMNS: 3 };

export const Neighbour = { NEAR: 0, WHEN: 1, NUMBER: 2 };

export const BENCH_WALKS = { PACE_PIECE_COLUMNS: 9, BENCH_ROW_COLUMNS: 7 };

export const BOX = { BOX_COLUMNS: 6, LONGEST_BENCH: 10000, SHORTEST_LINK: 0.001 };

export const Box = { CX: 0, CY: 1, UX: 2, UY: 3, HALF_LENGTH: 4, HALF_WIDTH: 5 };

export const CURVE = { COLUMNS: 14, MOST_METRES: 100000000 };

export const RouteRow = {
  KIND: 0,
  PART: 1,
  S_START: 2,
  LENGTH: 3,
  U_START: 4,
  U_END: 5,
  U_BACK: 6,
  X: 7,
  Y: 8,
  ANGLE: 9,
  P: 10,
  Q: 11,
  AXIS_X: 12,
  AXIS_Y: 13,
};

export const DRAWN_ROUTE = { STRETCH_ERROR: 2e-5, MOST_STRETCH_NODES: 4097 };

export const FOLLOWING = { FINE: 1e-9, LONGEST: 20, MOST_NODES: 4096, STRETCH_COLUMNS: 4 };

export const FRAMES = { QUANTUM: 0.0001, SLOTS: 32 };

export const ObstacleKind = { CIRCLE: 0, BODY: 1, LINE: 2, VENUE: 3 };

export const Told = { SPENT: 0, WANTED: 1 };

export const QuestionEnding = { MORE: 8, OVER_MEMORY: 20, OUT_OF_MEMORY: 21, CLOSED: 22 };

export const ROUTE = { END_SLACK: 1e-9 };

export const SPIRAL = { LANES: 64 };

export const Status = {
  OK: 0,
  BEFORE_ROUTE: 1,
  AFTER_ROUTE: 2,
  ROUTE_TOO_SHORT: 3,
  FOLDED: 4,
  LINK_OVER_DIAMETER: 5,
};

export const ANALYSIS_CHALK = { ARM: 5 };

export const ANALYSIS_CONTACT_SEARCH = { REFINING: 0.25, REFINING_ON: 0.05 };

export const ANALYSIS_CROWD = { FLOWS: [60, 82] };

export const ANALYSIS_LEFT_OPEN = { REST: 0.25 };

export const ANALYSIS_NEARBY = { FAR: 100, SPREADS: 4, NOWHERE: [0, 0] };

export const ANALYSIS_NOT_LOOKED_AT = { DUST: 1e-6 };

export const ANALYSIS_POSTS = { EVERY: 25, MOST_RUNS: 5 };

export const ANALYSIS_RUNNING = { APART: 5 };

export const ANALYSIS_SWEPT_STEPS = {
  FIRST_STEP: 0.25,
  LEAST_STEP: 1e-7,
  MOST_STEPS: 200000,
  BATCH: 4096,
  SLACK: 1e-7,
  STRAY_SHARE: 0.1,
  FILL_SHARE: 0.6,
};

export const BUDGET = { WORK: 1000000000, MEMORY: 600000000 };

export const ERRORS = { MOST_SHOWN: 80 };

export const MODEL_ANSWER = { ROUNDING: 1e-11 };

export const MODEL_DRAGON = { MOST_BENCHES: 1000000, MOST_FAULTS: 20 };

export const MODEL_PLACEMENT = { PLACE: 40 };

export const NUMBER_FORMAT = { FIGURES: 5 };

export const PLANS_ROUTES = { RUN_UP: 1 };

export const PLANS_SOURCE = { MOST_FAULTS: 20 };

export const PLANS_TOML = { MOST_KEYS: 500000, MOST_ENTRIES: 1000000 };

export const PLAYER_FOLLOWING = {
  SHARE: 0.0001,
  MOST_ALL: 100000,
  MOST_KINDS: 8,
  LOOK: 0.25,
  MOST_LOOKS: 60000000,
  MOST_COMPARED: 1500000,
};

export const PLAYER_FRAMES = {
  STEPS: [4, 2, 1, 0.5, 0.25, 0.125, 0.0625, 0.03125, 0.015625],
  SHARES: [0.5, 0.125, 0.25, 0.375, 0.625, 0.75, 0.875],
  LEAP: 0.125,
  CLOSE: 0.015625,
  BEFORE: 0.125,
  TRIED: 40,
  MOST_PLACES: 12000000,
  FARTHEST: 200000,
};

export const PLAYER_SCENE = {
  MOST_ERROR: 0.001,
  REACH: 1,
  MOST_TIMES: 1500,
  MOST_DISTANCES: 3000000,
  AROUND: 5,
  MOST_BENCHES: 5000,
  LONG: 500000,
};

export const ROSTERS_EXTENT = {
  MOST_UNPACKED: 100000000,
  MOST_PARTS: 2000,
  MOST_ROWS: 20000,
  MOST_COLUMNS: 100,
};

export const ROSTERS_GRID = { MOST_BYTES: 20000000 };

export const SOLVE_IMPRECISE = { RISK: 0.05 };

export const SOLVE_SIZE = { QUICK_SIZE: 1e-5 };

export const SOLVE_WISHES = { SHOULDERS: 0.5, CORNERS: 90 };

export const SURVEYS_LINES = { SAME: 1e-9 };
