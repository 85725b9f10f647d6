# make reproduce   the paper: figures, tables, report.html and a verdict in out/
# make test        the tests
# each of the many processes would compile all that it imports
unexport PYTHONDONTWRITEBYTECODE

PYTHON ?= python3
OUT ?= out
ARGS ?=
BIN := .venv/bin
BENCHMARKS := plant closed_loop sampled_walks batches compiling studies gait_design
PIP := $(BIN)/python -m pip --disable-pip-version-check install --quiet --no-compile --constraint constraints.txt

.PHONY: reproduce test fuzz docs pictures comparison walkbench tuned soft results verification attacks soft-limit dev lint format types imports bench mutants faults clean

reproduce: .venv/.core
	$(BIN)/biped-adrc reproduce --out $(OUT) $(ARGS)

# as many processes as cores: threads of linear algebra would only wait for each other
test: export OPENBLAS_NUM_THREADS ?= 1
test: .venv/.test
	$(BIN)/python -m pytest -rs --numprocesses auto --dist loadgroup --no-loadscope-reorder

# damaged files and nonsense on the command line, 500 of each kind, and a leak: about 10 minutes
fuzz: .venv/.test
	$(BIN)/python -m tests.fuzz

# the pages, in docs/_build/html
docs: .venv/.dev
	$(BIN)/sphinx-build -W --keep-going -n -E -q -b html docs docs/_build/html
	$(BIN)/biped-adrc play --torque-limit 150 --page docs/_build/html/_static/play.html
	$(BIN)/python docs/check_pages.py docs/_build/html

# what the README shows, from the runs of 'make reproduce'
pictures: .venv/.core
	$(BIN)/python docs/make_pictures.py $(OUT)

# docs/comparison.md with its figures, and what observer guide and README say of orders, from a comparison in
# $(OUT)/comparison, which is made or finished first, with the settings of docs/tuned/summary.json
comparison: .venv/.core
	$(BIN)/python docs/write_tuned_sets.py
	$(BIN)/biped-adrc compare --out $(OUT)/comparison
	$(BIN)/python docs/write_comparison.py $(OUT)/comparison

# the benchmark walkbench-1, frozen from the comparison as it is; a file that is there is never written over
walkbench: .venv/.core
	$(BIN)/python benchmarks/walkbench.py walkbench-1 $(OUT)/walkbench

# docs/tuned.md with its figures, from the searches in $(OUT)/tuned, which are made or finished first: hours
tuned: .venv/.dev
	$(BIN)/python benchmarks/tuned/alike.py $(OUT)/tuned
	$(BIN)/python benchmarks/tuned/alike.py $(OUT)/tuned_orders --contest benchmarks/tuned/orders.toml
	$(BIN)/python benchmarks/tuned/beside.py $(OUT)/tuned
	$(BIN)/python docs/write_tuned.py $(OUT)/tuned

# docs/soft_walk.md with its pictures, from the two studies of soft ground in $(OUT)/soft and $(OUT)/soft-held-out,
# which are made or finished first
soft: .venv/.core
	$(BIN)/biped-adrc sweep examples/soft_ground.toml --out $(OUT)/soft
	$(BIN)/biped-adrc sweep examples/soft_ground_held_out.toml --out $(OUT)/soft-held-out
	$(BIN)/python docs/write_soft_walk.py $(OUT)/soft $(OUT)/soft-held-out
	$(BIN)/python docs/make_soft_pictures.py

# the reproduction's results in docs/ and README.md, from its summary
results: .venv/.core
	$(BIN)/python docs/write_results.py $(OUT)

# published results and closed forms beside those of the package, in docs/verification.md
verification: .venv/.core
	$(BIN)/python docs/write_verification.py

# random walks against the numerics, one to two hours on two cores; tables in docs/robustness.md. What was found is kept
# in $(OUT)/attacks, from where an interrupted run goes on
attacks: .venv/.test
	mkdir -p $(OUT)/attacks
	for attack in engines contact steps searches; do \
	  $(BIN)/python -m tests.robustness $$attack --out $(OUT)/attacks/$$attack.jsonl --page docs/robustness.md; done

# the rigid walk as limit of the soft one, its multipliers, and walks that the rigid model calls legal, in MuJoCo: an
# hour and a half on one core; tables in docs/soft_limit.md. What was found is kept in $(OUT)/soft-limit, from where
# an interrupted run goes on
soft-limit: .venv/.test
	for study in limit multipliers legality; do \
	  $(BIN)/python -W ignore benchmarks/soft/$$study.py $(OUT)/soft-limit --page docs/soft_limit.md; done

dev: .venv/.dev

lint: .venv/.dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

format: .venv/.dev
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

types: .venv/.dev
	$(BIN)/mypy

imports: .venv/.dev
	$(BIN)/lint-imports

# tables on the screen, JSON in $(OUT)/benchmarks and their ratios in $(CSV), in about 5 minutes; ARGS=--quick for a
# look, CSV=docs/benchmarks.csv for the documentation. Peers that are not installed (pip install '.[bench]') are rows
# that say so
bench: CSV ?= $(OUT)/benchmarks.csv
bench: .venv/.core
	rm -rf $(OUT)/benchmarks
	set -e; for script in $(BENCHMARKS); do \
	  $(BIN)/python benchmarks/$$script.py $(OUT)/benchmarks $(ARGS); done
	$(BIN)/python benchmarks/report.py $(OUT)/benchmarks $(CSV)

# faults put in one at a time, and which of them the tests notice: hours, resumable; ARGS="--limit 60" for an hour of
# it, ARGS=--again for the survivors once more, ARGS=--report for the table alone
mutants: .venv/.mutants
	nice -n 19 $(BIN)/python benchmarks/mutants.py $(OUT)/mutants $(ARGS)

# the faults that were chosen by hand, each against the test that has to notice it
faults: .venv/.test
	nice -n 19 $(BIN)/python benchmarks/mutants.py $(OUT)/mutants --planted $(ARGS)

.venv/.made:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "biped_adrc needs Python >= 3.11; found $$($(PYTHON) --version 2>&1). Try: make PYTHON=python3.12 ..."; exit 1; }
	$(PYTHON) -m venv .venv
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

.venv/.mutants: .venv/.made pyproject.toml constraints.txt
	$(PIP) --editable '.[mutants]'
	@touch $@ .venv/.test .venv/.core

clean:
	rm -rf .venv out build dist
