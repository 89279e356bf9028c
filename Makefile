# `make demo` sets up what the main job needs in .venv/, `make test` what developers need besides. While at
# work: `make quick`, half a minute of lint, types, import contracts and a test of each room.
PYTHON ?= python3
BIN := .venv/bin
PAGES := 'src/benchdragon/web/*.js' '!src/benchdragon/web/carried*.js' 'src/benchdragon/web/compute/*.js' 'src/benchdragon/web/*.css' \
  'tests/engine/*.js' 'tests/engine/*.mjs' 'tests/planner/*.mjs' 'tools/*.mjs'
NPM := $(shell command -v npm 2>/dev/null)
# Two dances whose numbers are recorded: the same on every engine.
RECORDED := tests/model/test_walk.py::test_a_built_in_dance_is_the_recorded_one_with_any_number_of_workers
KERNELS := $(wildcard src/benchdragon/kernels/*.py tests/kernels/*.py tests/conftest.py tests/plain.txt tests/model/test_walk.py tests/solve/test_size_question.py tests/solve/test_turn_question.py)
# One process more than cores: tests wait for browsers.
WORKERS := $(shell expr $$(getconf _NPROCESSORS_ONLN) + 1)
# The kernels are built on one core while the other does what has no need of them; types are checked beside
# the tests, which wait for browsers.
JOBS ?= 2
MAKEFLAGS += --jobs=$(JOBS)
# Tests start a hundred processes: those that may keep no bytecode would each compile the package anew.
export PYTHONDONTWRITEBYTECODE :=

.PHONY: demo test main-test quick lint style mypy pages slow-test page-test long-test manual-test engine docs atlas bench queries picture truth wasm wasm-test carried carried-test mutants mutation hostile generate \
  lock fonts clean

PIP := $(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-compile

.venv/demo: requirements-demo.lock pyproject.toml
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "Python 3.11 or newer is needed")'
	$(PYTHON) -m venv .venv
	$(PIP) --require-hashes -r requirements-demo.lock
	$(PIP) --no-build-isolation -e .
	touch $@

# What the library is built with, by itself: it is built while the rest is installed.
.venv/built: .venv/demo requirements-engine.lock
	$(PIP) --require-hashes -r requirements-engine.lock
	touch $@

.venv/installed: .venv/built requirements.lock
	$(PIP) --require-hashes -r requirements.lock
	touch $@

# The kernels as one library, about twice as fast as engine.wasm, which serves without it.
engine: .venv/engine

.venv/engine: .venv/built src/benchdragon/hosts/signature.py $(wildcard src/benchdragon/kernels/*.py src/benchdragon/engine/*.py src/benchdragon/engine/*.c)
	-$(BIN)/python -m benchdragon.engine
	touch $@

node_modules/installed: package.json package-lock.json .npmrc
	npm ci --no-audit --no-fund
	touch $@

# First answers come at once, the report after minutes.
demo: .venv/demo
	$(BIN)/benchdragon reproduce -o out --force $(if $(wildcard docs/_build/html/en/established.html),--docs docs/_build/html/en)
	$(BIN)/benchdragon view turn -o out/turn.html --force

# All but what takes minutes each, and as long together as the rest.
test: lint pages main-test

slow-test: page-test long-test manual-test

main-test: style .venv/engine .venv/kernels-plain .venv/kernels-compiled
	$(BIN)/python -m pytest -q -n $(WORKERS) --dist loadgroup -m 'not manual and not pages and not long' --ignore tests/kernels

# What pages do in a browser, and what their JavaScript answers beside Python. Like long-test it lets the manual, which
# takes one core all the time, go first where they run together.
page-test: .venv/engine $(if $(NPM),node_modules/installed)
	nice $(BIN)/python -m pytest -q -n $(WORKERS) --dist loadgroup -m pages tests/browser tests/planner

# What takes seconds each: proofs, random dances, strangers' plans, sweeps that are killed.
long-test: .venv/engine
	nice $(BIN)/python -m pytest -q -n $(WORKERS) --dist loadgroup -m long $(sort $(shell cut -d: -f1 tests/long.txt))

quick: lint .venv/engine
	$(BIN)/python -m pytest -q @tests/quick.txt

lint: style mypy

style: .venv/installed
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/lint-imports --no-logo

mypy: .venv/installed
	$(BIN)/mypy

pages: $(if $(NPM),node_modules/installed)
	$(if $(NPM),node_modules/.bin/tsc -p .,@echo "no npm here: the pages' JavaScript is not checked")
	$(if $(NPM),node_modules/.bin/prettier --check --log-level warn $(PAGES))

# The kernels' own tests run once for each state of kernels and tests: as plain Python, each line of which
# can be counted, then by the library and by engine.wasm; what asks these for little is not run again. One
# process: the library is built beside it.
.venv/kernels-plain: .venv/installed $(KERNELS)
	BENCHDRAGON_ENGINE=plain $(BIN)/python -m slipcover -m pytest -q -W ignore::pytest.PytestAssertRewriteWarning -m 'not compiled' tests/kernels $(RECORDED) @tests/plain.txt
	touch $@

.venv/kernels-compiled: .venv/kernels-plain .venv/engine
	$(BIN)/python -m pytest -q -n auto -m 'compiled or not plain' tests/kernels $(RECORDED)
	BENCHDRAGON_ENGINE=wasm $(BIN)/python -m pytest -q -n auto -m 'not plain' tests/kernels $(RECORDED)
	touch $@

manual-test: .venv/engine
	$(BIN)/python -m pytest -q -m manual tests/test_docs.py

docs: .venv/engine
	rm -rf docs/_build
	$(BIN)/sphinx-build -q -W --keep-going -t report -c docs -d docs/_build/trees/en docs/en docs/_build/html/en
	$(BIN)/sphinx-build -q -W --keep-going -t report -c docs -d docs/_build/trees/zh -D language=zh_CN docs/zh docs/_build/html/zh
	rm -r docs/_build/html/jupyter_execute
	$(BIN)/benchdragon --lang en reproduce --docs docs/_build/html/en -o docs/_build/html/en/report
	$(BIN)/benchdragon --lang zh reproduce --docs docs/_build/html/zh -o docs/_build/html/zh/report
	$(BIN)/benchdragon --lang en planner -o docs/_build/html/en/planner.html
	$(BIN)/benchdragon --lang zh planner -o docs/_build/html/zh/planner.html

# The contest's family of dances, two minutes on two cores; sweeps that are there already are not made anew.
SWEEP := $(BIN)/benchdragon sweep
ATLAS := out/atlas
CHAPTERS := pitch disc pitch-disc width lengths benches turn three-keys
atlas: .venv/engine
	$(SWEEP) spiral-in --vary route.pitch=0.45..0.6..0.005 --refine 400 -o $(ATLAS)/pitch
	$(SWEEP) spiral-in --vary disc.radius=2..8..0.1 --ask smallest_pitch --refine 200 -o $(ATLAS)/disc
	$(SWEEP) spiral-in --vary route.pitch=0.4..0.6..0.005 --vary disc.radius=2..8..0.25 -o $(ATLAS)/pitch-disc
	$(SWEEP) spiral-in --set disc.radius=4.5 --vary dragon.width=0.1..0.6..0.01 --ask smallest_pitch -o $(ATLAS)/width
	$(SWEEP) spiral-in --set disc.radius=4.5 --vary dragon.head_length=2..5..0.25 --vary dragon.body_length=1.4..3..0.2 --ask smallest_pitch -o $(ATLAS)/lengths
	$(SWEEP) spiral-in --set disc.radius=4.5 --vary dragon.benches=3..40..1 --ask smallest_pitch -o $(ATLAS)/benches
	$(SWEEP) turn --vary route.pitch=1.4..2..0.1 --vary turn.ratio=0.6..2..0.1 --ask clearance,greatest_speed,greatest_head_speed -o $(ATLAS)/turn
	$(SWEEP) spiral-in --vary route.pitch=0.45..0.65..0.01 --vary dragon.width=0.2..0.4..0.02 --vary dragon.body_length=1.8..2.8..0.2 -o $(ATLAS)/three-keys
	$(BIN)/benchdragon atlas $(addprefix $(ATLAS)/,$(CHAPTERS)) -o out/atlas.html --force

# `make bench BEFORE=FOLDER` times another checkout beside this one.
bench: .venv/engine
	$(BIN)/python benchmarks/run.py $(if $(BEFORE),--before $(BEFORE))

# The open set of 100,000 collision queries, asked of this package and of rivals that are installed in RIVALS:
# a virtual environment with python-fcl and coal, and node_modules with planck beside it.
queries: .venv/engine
	$(BIN)/python benchmarks/queries.py run --write $(if $(RIVALS),--python $(RIVALS)/bin/python --node-folder $(RIVALS))

# The moving picture of README and manual, and the manual's pictures of contact, to be committed.
DANCE := view turn --set dragon.benches=50 --start -10 --end 80 --speed-up 15 --fps 5 --size 400x340 -o dance.gif
picture: .venv/demo
	cd docs/en && ../../$(BIN)/benchdragon $(DANCE) --lang en --force
	cd docs/zh && ../../$(BIN)/benchdragon $(DANCE) --lang zh --force
	$(BIN)/python design/contact_pictures.py docs/contact.svg

truth: .venv/installed
	$(BIN)/python -m tests.truth.make_truth

# Zig is 0.4 GB, and builds engine.wasm alone: the tests take the committed one.
.venv/zig: .venv/built requirements-wasm.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --require-hashes -r requirements-wasm.lock
	touch $@

# The kernels for browsers, to be committed.
wasm: .venv/zig
	$(BIN)/python -m benchdragon.engine --wasm src/benchdragon/engine

# Whether the committed one is, byte for byte, what is built here.
wasm-test: .venv/zig
	$(BIN)/python -m benchdragon.engine --wasm out/wasm
	cmp out/wasm/engine.wasm src/benchdragon/engine/engine.wasm

# The libraries that the planner carries, to be committed.
carried: node_modules/installed
	node tools/make_carried.mjs src/benchdragon/web

# Whether the committed ones are, byte for byte, what is bundled here.
carried-test: node_modules/installed
	node tools/make_carried.mjs out
	for module in carried.js carried_code.js carried_shapes.js carried_zip.js; do cmp out/$$module src/benchdragon/web/$$module; done

# Strangers' plans, each asked about in a child process, with a tenth of the budget of a question; for the night.
# One that was broken off goes on where it was.
hostile: .venv/engine
	$(BIN)/python -m tests.hostile 0 10000
	$(BIN)/python -m tests.hostile.certificates 0 20000

mutants: .venv/installed
	$(BIN)/python tools/mutants.py

.venv/mutation: .venv/installed requirements-mutation.lock
	$(PIP) --require-hashes -r requirements-mutation.lock
	touch $@

# Mutants that a tool makes, of kernels, proofs, certificates and the verdict, or of `MODULES=proofs/cells.py`; for
# the night. One that was broken off goes on where it was.
mutation: .venv/mutation .venv/engine
	$(BIN)/python tools/mutation.py $(MODULES)

# What is made from other files here: pages' modules, types and constants, the catalogue, tables and the map.
generate: .venv/installed
	$(BIN)/python -m tools.generate

fonts: .venv/installed
	$(BIN)/python tools/make_fonts.py

lock:
	uv pip compile --quiet --universal --generate-hashes --no-emit-index-url --no-annotate --no-header \
	  --python-version 3.11 --extra data --extra prove --extra video --extra cluster --extra refine --extra survey --extra build --group dev --group build --group docs pyproject.toml -o requirements.lock
	uv pip compile --quiet --universal --generate-hashes --no-emit-index-url --no-annotate --no-header \
	  --python-version 3.11 --extra prove --group build -c requirements.lock pyproject.toml -o requirements-demo.lock
	printf 'llvmlite\nnumba\n' | uv pip compile --quiet --universal --generate-hashes --no-emit-index-url --no-annotate --no-header \
	  --python-version 3.11 --no-deps -c requirements.lock - -o requirements-engine.lock
	uv pip compile --quiet --universal --generate-hashes --no-emit-index-url --no-annotate --no-header \
	  --python-version 3.11 --no-deps --group wasm -o requirements-wasm.lock
	uv pip compile --quiet --universal --generate-hashes --no-emit-index-url --no-annotate --no-header \
	  --python-version 3.11 -c requirements.lock --group mutation -o requirements-mutation.lock

clean:
	rm -rf src/benchdragon/engine/*.so .venv node_modules out docs/_build .coverage .mypy_cache .pytest_cache .ruff_cache
