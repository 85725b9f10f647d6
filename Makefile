# make reproduce   the paper: figures, tables, report.html and a verdict in out/
# make test        the tests
# make check       all that has to pass before a change is merged
unexport PYTHONDONTWRITEBYTECODE # each of the many processes would compile all that it imports

PYTHON ?= python3
OUT ?= out
ARGS ?=
BIN := .venv/bin
BENCHMARKS := plant closed_loop sampled_walks batches compiling studies gait_design
PIP := $(BIN)/python -m pip --disable-pip-version-check install --quiet --no-compile --constraint constraints.txt

.PHONY: reproduce test check docs pictures verification findings bench format dev clean

reproduce: .venv/.core
	$(BIN)/biped-adrc reproduce --out $(OUT) $(ARGS)

# as many processes as cores: threads of linear algebra would only wait for each other
test: export OPENBLAS_NUM_THREADS ?= 1
# large arrays go back to the system when they are freed, where glibc would keep their memory
test: export MALLOC_MMAP_THRESHOLD_ ?= 1000000
test: .venv/.test
	$(BIN)/python -m pytest -rs --numprocesses auto --no-loadscope-reorder

# tests, lint, types, import rules, pages, wheel, and reproduction and benchmarks in short
check: .venv/.dev
	$(MAKE) --no-print-directory --jobs=3 --output-sync=target test .pages .static .short

# the pages, in docs/_build/html, after the parts of docs/api and the notebook that are made from package and pages
docs: .venv/.dev
	$(BIN)/python docs/expand.py
	$(BIN)/python docs/make_notebook.py
	$(MAKE) --no-print-directory .pages

.pages: .venv/.dev
	$(BIN)/sphinx-build -W --keep-going -n -E -q -b html docs docs/_build/html
	$(BIN)/biped-adrc play --set hardware.torque_limit=150 -o docs/_build/html/_static/play.html
	$(BIN)/python docs/check_pages.py docs/_build/html

# the pictures of README.md and of the first page
pictures: .venv/.core
	$(BIN)/python docs/make_pictures.py

# published results and closed forms beside those of the package, in docs/verification.csv
verification: .venv/.core
	$(BIN)/python -m validation --out docs/verification.csv

# every finding again, from the stored settings: its walks, its rows and its page; goes on after a kill. With
# ARGS=--search the settings are searched before, for hours
findings: .venv/.test
	$(BIN)/python -m validation.findings $(OUT)/findings $(ARGS)

# tables on the screen, JSON in $(OUT)/benchmarks and their ratios in $(CSV), in about 5 minutes; ARGS=--quick for a
# look, CSV=docs/benchmarks.csv for the documentation. Peers that are not installed (pip install '.[bench]') are rows
# that say so
bench: CSV ?= $(OUT)/benchmarks.csv
bench: .venv/.core
	rm -rf $(OUT)/benchmarks
	set -e; for script in $(BENCHMARKS); do \
	  $(BIN)/python benchmarks/$$script.py $(OUT)/benchmarks $(ARGS); done
	$(BIN)/python benchmarks/report.py $(OUT)/benchmarks $(CSV)

format: .venv/.dev
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

dev: .venv/.dev

clean:
	rm -rf .venv out build dist

.PHONY: .pages .static .short

.static: .venv/.dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/python tests/wheel.py

.short: .venv/.core
	$(MAKE) --no-print-directory reproduce OUT=build/short ARGS=--quick
	$(MAKE) --no-print-directory bench OUT=build/short ARGS=--quick

.venv/.made:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "biped_adrc needs Python >= 3.11; found $$($(PYTHON) --version 2>&1). Try: make PYTHON=python3.12 ..."; exit 1; }
	$(PYTHON) -m venv .venv
	$(BIN)/python -m compileall -q biped_adrc # for a shell in which PYTHONDONTWRITEBYTECODE is set
	@touch $@

.venv/.core: .venv/.made pyproject.toml constraints.txt
	$(PIP) --editable .
	@touch $@

.venv/.test: .venv/.made pyproject.toml constraints.txt
	$(PIP) --editable '.[test]'
	@touch $@ .venv/.core

.venv/.dev: .venv/.made pyproject.toml constraints.txt
	$(PIP) --editable '.[dev]'
	@touch $@ .venv/.test .venv/.core
