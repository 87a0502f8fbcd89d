# Everything needs only make and Python 3.11 or newer with venv and pip; no root, no system package.
SHELL := /bin/bash
VENV := .venv
BIN := $(VENV)/bin
OUT ?= out
WORKERS ?= 2
SECONDS ?= 60
export PIP_CONSTRAINT := $(CURDIR)/constraints.txt
export PIP_BUILD_CONSTRAINT := $(CURDIR)/constraints.txt
PIP := $(BIN)/python -m pip --disable-pip-version-check -qq
PYTHON ?= $(shell for p in python3 python3.14 python3.13 python3.12 python3.11; do \
	$$p -c 'import sys, venv, ensurepip; raise SystemExit(sys.version_info < (3, 11))' 2>/dev/null && echo $$p && break; done)

CORE := $(VENV)/.core-installed
DEV := $(VENV)/.dev-installed
DOCS := $(VENV)/.docs-installed
SAT := $(VENV)/.sat-installed

# As a folder on the path and by no import hook, so that type checkers of editors find the packages.
EDITABLE := --config-settings editable_mode=compat --editable

.PHONY: help setup plan paper test docs deep fuzz theorems lint bench clean
.DEFAULT_GOAL := help

help: ## list the targets
	@awk -F':.*## ' '/^[a-z]+:.*## /{printf "  make %-8s %s\n", $$1, $$2}' Makefile

$(CORE): pyproject.toml constraints.txt
	@test -n "$(PYTHON)" || { echo "Python 3.11 or newer with venv and pip is needed" >&2; exit 1; }
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	$(PIP) install $(EDITABLE) '.[plan]'
	@touch $@

$(DEV): $(CORE) | $(BIN)/experiments
	$(PIP) install $(EDITABLE) '.[dev,solvers,sweep,sat]'
	@touch $@

# Nothing of so common a name is installed: the package is taken from here, whatever the current folder.
$(BIN)/experiments: Makefile | $(CORE)
	@rm -f $@
	@printf '%s\n' '#!/bin/sh' 'export PYTHONPATH="$(CURDIR)$${PYTHONPATH:+:$$PYTHONPATH}" PYTHONSAFEPATH=1' \
		'exec "$$(dirname "$$0")/python" -m experiments "$$@"' > $@
	@chmod +x $@

$(DOCS): $(CORE)
	$(PIP) install $(EDITABLE) '.[docs,squares]'
	@touch $@

$(SAT): $(CORE)
	$(PIP) install $(EDITABLE) '.[sat]'
	@touch $@

setup: $(DEV) ## create .venv with every dependency

plan: $(CORE) ## plan the example path; the report is out/report.html
	$(BIN)/bezier plan examples/three_balls.toml --out $(OUT)

paper: $(SAT) ## check every claim of the paper; the page is out/paper/index.html
	$(BIN)/python -m paper_repro --out $(OUT)/paper

test: $(DEV) ## all tests but the long ones
	$(BIN)/python -m pytest -n $(WORKERS) --dist loadfile -q

docs: $(DOCS) ## build the documentation site: open build/site/index.html
	MPLBACKEND=Agg $(BIN)/python -m sphinx -W -q -b html docs build/site

deep: $(DEV) ## the long randomised tests
	HYPOTHESIS_PROFILE=explore $(BIN)/python -m pytest -n $(WORKERS) -q -m deep

fuzz: $(DEV) ## damaged texts for every reader, SECONDS=60 (by atheris where it is installed)
	$(BIN)/python -m tests.fuzz --seconds $(SECONDS) --guided

theorems: $(DEV) ## prove the theorems of qe/theorems, try the axioms at random instances
	$(BIN)/python -m experiments.theorems

lint: $(DEV) ## ruff, and mypy --strict on all packages
	$(BIN)/ruff check .
	$(BIN)/mypy

bench: $(DEV) ## the benchmark: figures asked beside figures reached
	$(BIN)/python -m experiments.bench
	$(BIN)/python -m experiments.bench_cubic

clean: ## remove .venv and the outputs
	rm -rf $(VENV) $(OUT) build dist *.egg-info .mypy_cache .ruff_cache .pytest_cache .hypothesis
