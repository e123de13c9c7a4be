# make demo: everything it takes, then the page.   make test: everything it takes, then the tests.
# make quick: what to run while working, minutes on two cores.
# make sweep: the rest of the large tables of like cases, of which make test runs an even share; before a release.
# make gpu: on a machine with a GPU, five minutes: draws all, compares, measures, and writes docs/gpu.md.
SHELL := /bin/bash
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
NODE := scripts/node.sh
PIP := $(BIN)/pip install -q --disable-pip-version-check
LOCKED := --require-hashes -r requirements.lock
WEB := webclient
PORT ?= 8000
# uv leaves packages uncompiled: each of the hundreds of processes that tests start would compile all it imports.
unexport PYTHONDONTWRITEBYTECODE

WEB_SOURCES := $(shell find $(addprefix $(WEB)/,src public masks learn build) -type f 2>/dev/null) $(WEB)/index.html docs/formulae.md $(wildcard docs/snippets/*) \
	$(WEB)/package-lock.json $(WEB)/vite.config.ts $(WEB)/vite.library.config.ts $(WEB)/tsconfig.json

# Four groups of tests at once, each under 2 GB: browsers and the pool of workers, what is drawn against float64, what else
# draws, and all else. Two cores wait with three, for browsers and for processes that are started and killed.
POOL := tests/fast/api/pool
LIVE := tests/browser $(POOL)
FAST := tests/fast --ignore=$(POOL)
TRUTH := tests/gpu/reference

# Tests that make many plans: half of the time that quick takes.
PLANS := tests/fast/planner tests/fast/project
# What quick leaves to the whole run: float64 frames, sweeps, masks and documents made anew, generated requests, a GPU's
# compiler, plans of the finest tiers, frames of minutes, and processes that are started, killed and awaited.
SLOW := $(addprefix tests/fast/,project/test_compiler.py project/test_generated.py accuracy cli masks reference api/guard api/pool \
	api/requests/test_api_hostile.py api/requests/test_api_drawn.py api/frames/test_api_accuracy.py api/frames/test_api_sequences.py \
	meta/test_work.py sequences/test_fleet.py)

# What of the large tables of like cases to run: tests/support/sweep.py.
SHARE := not sweep
# Which third of the files of tests: the commit says it, TURN=all are all. tests/support/run/turns.py
TURN ?= $(or $(shell git rev-parse --short HEAD 2>/dev/null),all)
# Of a third, what a group may do: tests/support/run/work.py.
GRANTED = $(if $(SPENT),--spent $(SPENT)) --turn $(TURN) $(if $(filter all,$(TURN)),,--group $(@:test-%=%))

define LINT
$(BIN)/ruff check .
$(BIN)/ruff format --check .
$(BIN)/mypy
$(BIN)/lint-imports
endef

# Groups run at once on two cores: threads of BLAS would wait for one another, and use up the time of all.
test-live test-truth test-gpu test-fast quick-plans quick-rest: export OPENBLAS_NUM_THREADS = 1

.PHONY: demo test quick quick-plans quick-rest lint lint-then-web sweep test-live test-truth test-gpu test-fast test-web bench gpu setup setup-test webclient wheel bake docs stills learn-stills fronts lock clean

demo: setup
	$(BIN)/seafoam serve --port $(PORT) --open

test: setup-test
	@$(MAKE) --no-print-directory -j5 lint-then-web test-live test-truth test-gpu test-fast

# One after the other, beside the tests: each of them takes one processor.
lint-then-web: lint
	@$(MAKE) --no-print-directory test-web
	@touch $(WEB)/node_modules/.checked

# tests/fast but the slow ones, of those that are not of plans the commit's third; with the one half the lint, with the other a small
# picture of every preset.
quick: setup-test
	@$(MAKE) --no-print-directory -j2 quick-plans quick-rest

quick-plans:
	$(BIN)/pytest -q -p no:cacheprovider -m "$(SHARE)" $(PLANS) $(addprefix --ignore=,$(SLOW)) -k "not -high] and not -reference]"
	$(LINT)

quick-rest: $(WEB)/node_modules/.checked
	$(BIN)/pytest -q -p no:cacheprovider -m "$(SHARE)" --turn $(TURN) tests/fast tests/gpu/smoke $(addprefix --ignore=,$(PLANS) $(SLOW)) -k "not foam_is_seen and not first_minute"

# Types, lint and unit tests of the client, unless nothing of it changed since they passed.
$(WEB)/node_modules/.checked: $(WEB_SOURCES) $(wildcard $(WEB)/tests/*) $(WEB)/eslint.config.js | $(WEB)/dist/index.html
	cd $(WEB) && ../$(NODE) npm run lint --silent
	cd $(WEB) && ../$(NODE) npm test --silent
	@touch $@

setup: $(VENV)/.installed webclient
	@scripts/system.sh

setup-test: setup
	@scripts/system.sh test

$(VENV)/.installed: requirements.lock pyproject.toml hatch_build.py
	@scripts/system.sh
	@echo "Installing Python packages into $(VENV)"
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@# uv installs in a tenth of pip's time; where it does not find the packages, pip may, by settings of its own.
	@$(PIP) "uv>=0.8,<1" && $(BIN)/uv pip install -q --python $(BIN)/python $(LOCKED) || $(PIP) $(LOCKED)
	@$(PIP) --no-deps --no-build-isolation -e .
	@touch $@

webclient: $(WEB)/dist/index.html

$(WEB)/node_modules/.installed: $(WEB)/package-lock.json | $(VENV)/.installed
	@echo "Installing the web client's packages"
	@cd $(WEB) && ../$(NODE) npm ci --no-audit --no-fund --silent
	@touch $@

$(WEB)/dist/index.html: $(WEB_SOURCES) $(WEB)/node_modules/.installed
	@echo "Building the web client"
	@cd $(WEB) && ../$(NODE) npm run build --silent
	@touch $@

lint: setup-test
	$(LINT)
	cd $(WEB) && ../$(NODE) npm run lint --silent

test-web: setup-test
	cd $(WEB) && ../$(NODE) npm test --silent

test-live:
	$(BIN)/pytest -q -p no:cacheprovider -m "$(SHARE)" $(GRANTED) $(LIVE)

test-truth:
	$(BIN)/pytest -q -p no:cacheprovider -m "$(SHARE)" $(GRANTED) $(TRUTH)

test-gpu:
	$(BIN)/pytest -q -p no:cacheprovider -m "$(SHARE)" $(GRANTED) tests/gpu --ignore=$(TRUTH)

test-fast:
	$(BIN)/pytest -q -p no:cacheprovider -m "$(SHARE)" $(GRANTED) $(FAST)

sweep: setup-test
	@$(MAKE) --no-print-directory -j4 SHARE=sweep TURN=all test-live test-truth test-gpu test-fast
	cd $(WEB) && MACHINES=1000 ../$(NODE) npm test --silent -- tests/display/resolution.test.ts

bench: setup-test
	$(BIN)/python -m bench

# Needs a GPU's driver with EGL, and Python; no Node, no browser. GPU: options, of which --help tells.
gpu: $(VENV)/.installed
	$(BIN)/python -m bench.gpu $(GPU)

wheel: setup
	$(BIN)/pip wheel -q --no-deps --no-build-isolation -w dist .

# Baked data, checked in; these commands make it again.
bake: setup
	$(BIN)/python masks/bake.py
	$(BIN)/python tests/golden/make.py
	$(BIN)/python tests/references/bake.py

docs: setup-test
	$(BIN)/seafoam openapi > $(WEB)/openapi.json
	cd $(WEB) && ../$(NODE) npm run types --silent
	$(BIN)/python docs/make_stability.py
	$(BIN)/python docs/make_pictures.py

# The page's first pictures, checked in: those whose preset starts otherwise now. After a change of how water looks: NAMES.
stills: setup
	$(BIN)/python webclient/make_stills.py $(NAMES)

# The chapter's figures, as they are drawn at their start.
learn-stills: setup-test
	$(BIN)/python webclient/make_learn_stills.py

# What each tier costs and is worth at each share of the window, for the page to choose by; presets without it, or NAMES.
fronts: setup
	$(BIN)/python webclient/make_fronts.py $(NAMES)

lock: $(VENV)/.installed
	$(PIP) "uv>=0.8,<1"
	$(BIN)/uv pip compile pyproject.toml $(addprefix --extra ,dev reports notebook video cluster telemetry) --universal \
		--python-version 3.11 --generate-hashes \
		--no-emit-index-url --no-header --upgrade -o requirements.lock

clean:
	rm -rf $(VENV) $(WEB)/node_modules $(WEB)/dist dist
