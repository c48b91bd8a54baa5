# What a developer does often: `make` lists it.
PYTHON ?= python

.PHONY: help lint types test bench clean ci

help:  ## this list
	@grep -E '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed 's/:.*## /\t/' | expand -t 10

lint:  ## style: ruff format and ruff check
	ruff format .
	ruff check --fix .

types:  ## types: mypy --strict
	mypy

test:  ## the tests
	$(PYTHON) -m pytest

bench:  ## speed: the task benchmark, then tests/bench
	$(PYTHON) run.py task=benchmark
	$(PYTHON) -m pytest tests/bench --override-ini addopts=-q

clean:  ## compiled kernels, which numba does not renew when a kernel that they call has changed
	find treefit generators experiments \( -name '*.nbi' -o -name '*.nbc' \) -delete

ci:  ## all of it in a fresh virtual environment
	.ci/run
