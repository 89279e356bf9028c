"""What pages are given of which Python modules, and what they do otherwise than those."""

# Of which modules pages are given what: the file, and the names that are asked for.
TWINS = {
    "analysis.beats": ("beats", "score_of"),
    "analysis.bench_walks": ("bench_walks", "BenchWalk", "bench_walks"),
    "analysis.bends": ("bends", "Bends"),
    "analysis.check": ("check", "checked", "in_one_coil", "peak_text", "sentence"),
    "analysis.clock": ("clock", "Clock"),
    "analysis.contact": (
        "contact", "contact_windows", "first_sure_contact", "least_clearance", "seen_clearance",
    ),
    "analysis.contact_search": ("contact_search", "assumed_within", "stand_alone"),
    "analysis.distance": ("distance", "FEATURES", "nearness"),
    "analysis.findings": (
        "findings", "Finding", "all_findings", "named", "shown_name", "touch_text",
    ),
    "analysis.ground": ("ground", "Ground"),
    "analysis.head_times": ("head_times", "HeadTimes"),
    "analysis.marks": ("marks", "Trail", "among", "usual_gap"),
    "analysis.nearby": ("nearby", "checked_off"),
    "analysis.rounds": ("rounds", "Rounds", "repeats", "returns"),
    "analysis.tables": ("bench_tables", "beginnings", "in_columns", "kinds_of", "walk_tables"),
    "analysis.left_open": ("left_open", "DEAR", "HIDDEN", "open_finding"),
    "analysis.not_looked_at": ("not_looked_at", "not_looked_at"),
    "analysis.obstacle_search": ("obstacle_search", "ObstacleSearch"),
    "analysis.obstacles": (
        "obstacles", "ObstacleAnswers", "least_distance", "obstacle_answers", "touching",
    ),
    "analysis.records": ("records", "answer_of", "answer_or_none", "verdict_of"),
    "analysis.room": ("room_levels", "Asked", "room_levels", "shown_name"),
    "analysis.shortage": ("shortage", "shortage"),
    "analysis.speed": (
        "speed", "QUANTITIES", "Quantity", "fastest_handle", "given_limits", "greatest", "greatest_of",
        "greatest_speed",
    ),
    "analysis.stops": ("stops", "stops_of"),
    "analysis.unfinished": ("unfinished", "unfinished"),
    "errors": ("advice", "advice"),
    "explain.bench_text": (
        "bench_text", "Basis", "Halt", "Landmark", "bench_lines", "tightest_line",
    ),
    "kernels.route_parts": ("poses", "Pose"),
    "model.answer": ("answer", "keeps", "shown", "sure", "vanishing"),
    "model.base_curve": ("base_curve", "checked_size", "laid_rows"),
    "model.connections": ("connections", "programme"),
    "model.curves": ("curves", "Route"),
    "model.dragon": ("dragon", "count_text", "fault_of"),
    "model.formations": ("formations", "FORMATIONS"),
    "model.holds": ("holds", "Hold"),
    "model.numbering": ("numbering", "handle_words"),
    "model.obstacle": ("obstacle", "Obstacle", "rectangle_outline"),
    "model.profile": ("profile", "SpeedProfile"),
    "model.turns": ("turns", "Turn"),
    "number_format": ("number_format", "at_most", "finite_or_none", "known", "seconds"),
    "player.occasions": ("occasions", "occasion", "occasions_found", "tighten"),
    "progress": ("stages", "part", "stages"),
    "plans.cues": (
        "cues", "Moment", "Paced", "check_cue", "cue_name", "outside", "paced", "time_of_day",
    ),
    "plans.digits": ("digits", "measured"),
    "plans.formations": ("formation_tables", "FormationTable", "StepTable"),
    "plans.idle": ("idle", "drop", "drop_replaced", "idle_keys"),
    "plans.people": ("people", "called", "village", "web_address"),
    "plans.routes": (
        "plan_routes", "DrawnRoute", "FormationRoute", "PartsRoute", "ProgrammeRoute", "SpiralInRoute",
        "TurnRoute",
    ),
    "plans.signs": ("signs", "narrow"),
    "plans.square": (
        "square", "CircleTable", "LineTable", "PolygonTable", "RectangleTable", "VenueTable",
        "built_obstacles",
    ),
    "plans.tables": (
        "tables", "ArcPart", "ClothoidPart", "LinePart", "LogSpiralPart", "SpiralPart", "TurnTable",
        "one_line",
    ),
    "plans.toml": ("quantity", "quantity"),
    "surveys.alignment": ("absorbed", "Absorbed"),
    "surveys.clothoids": ("unfit", "unfit"),
    "surveys.fitting": ("fits", "check_fewest", "checked_fit", "rounded"),
    "solve.head_speed": ("head_speed", "greatest_head_speed", "slowed", "with_pace"),
    "solve.random_dance": ("random_dance", "refuse"),
    "solve.turn": ("best_turn", "best_turn"),
    "solve.turn_goal": ("turn_goal", "TurnGoal"),
    "solve.turn_question": ("turn_question", "TurnQuestion"),
    "rosters.names": ("roster_names", "like_two"),
    "rosters.words": (
        "roster_words", "NUMERALS", "numeral", "heading", "doubtful", "is_name", "is_other", "is_sum",
        "names_of", "places", "with_places", "without_phones",
    ),
    "rosters.columns": ("roster_columns", "layout"),
    "rosters.entries": ("roster_entries", "entries"),
    "rosters.extent": ("roster_limits", "too_large", "torn"),
    "rosters.grid": ("roster_rows", "decoded", "is_text", "limited", "text_rows"),
    "rosters.roster": ("roster_people", "Person"),
    "rosters.reading": ("roster", "roster_of", "Numbering"),
}  # fmt: skip
# What hand-written modules of the page hold of other modules, by the same names.
OWN = {
    "analysis.engine_question": "../compute/engine_question.js",
    "budget": "../compute/budget.js",
    "i18n": "../words.js", "errors": "../compute/errors.js", "plans.source": "../compute/errors.js",
}  # fmt: skip
# What single functions of the page do otherwise.
GIVEN = {
    "analysis.bench_walks._handles": "../compute/bench_walks.js",
    "analysis.bench_walks._nearest": "../compute/bench_walks.js",
    "analysis.bench_walks._seen": "../compute/bench_walks.js",
    "analysis.contact.refined": "../compute/budget.js",
    "analysis.distance.nearness_at": "../compute/distance.js",
    "analysis.nearby.must_stand": "../compute/nearby.js",
    "analysis.nearby.origin_at": "../compute/nearby.js",
    "analysis.left_open.speed_at_start": "../compute/left_open.js",
    "analysis.left_open.told_if_open": "../compute/left_open.js",
    "analysis.records.bracketed": "../compute/answer.js",
    "analysis.room.with_people": "../compute/dragon.js",
    "analysis.shortage._Seen": "../compute/shortage.js",
    "plans.toml._vast": "../compute/python_text.js",
    "rosters.grid._cells": "../compute/roster_text.js",
    "decoding.readings": "../compute/roster_text.js",
    "analysis.not_looked_at.given_from": "../compute/walk_facts.js",
    "analysis.not_looked_at.places": "../compute/walk_facts.js",
    "analysis.not_looked_at.runs_on": "../compute/walk_facts.js",
    "kernels.chain.empty_placements": "../compute/arrays.js",
    "model.base_curve.Curve": "../compute/curve.js",
    "model.profile._along": "../compute/stretches.js",
    "model.holds.HoldError": "../compute/holds.js",
    "model.obstacle.Standing": "../compute/obstacle.js",
    "model.obstacle._crossing": "../compute/obstacle.js",
    "number_format.decimals": "../compute/number_format.js",
    "number_format.figures": "../compute/number_format.js",
    "plans.routes._fitted": "../compute/fitting.js",
}
# Functions that check what Python is called with, and what they give where pages call.
UNASKED = {
    "analysis.proof.prove_obstacle": "() => null",
    "analysis.room._proved": "() => null",
    "errors.as_number": "(_name, value) => value",
    "errors.of_kind": "() => null",
    "model.arrays.as_list": "(_name, values) => values",
    "model.arrays.as_numbers": "(_name, values) => values",
    "model.arrays.as_table": "(rows) => rows",
    "model.connections._check": "() => null",
    "model.connections._check_steps": "() => null",
    "model.curves._checked_curves": "(curves) => curves",
}
# Functions of pages that give way between their steps.
WAITING = {"analysis.bench_walks._nearest", "analysis.bench_walks._seen"}
# Functions of pages in place of context managers: they give what takes errors.
AROUND = {"analysis.contact.refined", "analysis.left_open.told_if_open"}
# Functions whose results are freed where a context manager would end, as questions of the engine are.
FREED = {"analysis.contact_search.contact_search"}
# Methods of records that pages have as plain data are functions there: their modules, what they take.
AS_FUNCTIONS = {
    "keeps": ("model.answer", ("limit",)),
    "shown": ("model.answer", ("up", "limit")),
    "sure": ("model.answer", ("up",)),
    "vanishing": ("model.answer", ()),
}
# What only Python has of records, of one or of all of a module.
LEFT_OUT = {
    "analysis.beats.Run": ("beats", "time"),
    "analysis.bends.Bends": ("turning",),
    "analysis.marks.Trail": ("of",),
    "analysis.obstacle_search.ObstacleSearch": ("ways",),
    "analysis.ground.Ground": ("of", "seen"),
    "model.answer.Answer": ("as_json", *AS_FUNCTIONS),
    "model.obstacle.Obstacle": ("__eq__", "__hash__"),
    "model.curves.Route": ("__getitem__", "__iter__", "__len__"),
    "model.curves.Spiral": ("angle",),
    "model.formations": ("chinese", "english", "pinyin", "shape", "source"),
    "model.profile.SpeedProfile": ("__getitem__", "__iter__", "__len__", "exact_distance"),
    "solve.turn.BestTurn": ("as_json",),
    "solve.turn_goal.TurnFamily": ("turn",),
    "plans.routes.Drawn": ("line",),
    "plans.square": ("about", "keys"),
    "plans.tables": ("about", "keys"),
}
