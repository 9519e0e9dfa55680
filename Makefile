# The front door: each target installs what it needs (scripts/deps) and uses CMake.
# BUILD=folder builds elsewhere, JOBS=n limits parallel work, PREFIX=folder is where install goes.
BUILD ?= build
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
PREFIX ?= /usr/local
# Names may have blanks, so recipes quote them; and not every shell expands the ~ of PREFIX=~/froe.
override BUILD := $(BUILD:~/%=$(HOME)/%)
override PREFIX := $(PREFIX:~/%=$(HOME)/%)
# Ninja may be installed by the first step, so this is asked anew in every recipe.
export CMAKE_GENERATOR = $(if $(shell command -v ninja 2>/dev/null),Ninja,Unix Makefiles)

.DEFAULT_GOAL := build
.PHONY: help build demo test install uninstall build-bench bench bench-peers claims oracle mutations faults \
    coverage mutate fuzz soak night platforms bare docs python web site dist release-check single format lint clean

deps-%:
	@scripts/deps $*

help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  make \1\t\2/p' $(MAKEFILE_LIST) | expand -t 22

build: deps-build ## the libraries and the program, build/bin/froe
	@cmake -S . -B "$(BUILD)" -DCMAKE_BUILD_TYPE=Release -DFROE_TESTS=OFF
	@cmake --build "$(BUILD)" --parallel $(JOBS)

demo: build ## drawings, answers, motion and partitions on one page: build/demo/index.html
	@"$(BUILD)/bin/froe" demo -o "$(BUILD)/demo"

test: deps-test ## all tests, without benches and without what documents show (ctest -L docs)
	@cmake -S . -B "$(BUILD)" -DCMAKE_BUILD_TYPE=Release -DFROE_TESTS=ON
	@cmake --build "$(BUILD)" --parallel $(JOBS)
	@ctest --test-dir "$(BUILD)" --output-on-failure --parallel $(JOBS) -LE '^docs$$'

install: build ## into PREFIX (/usr/local); DESTDIR is honoured
	@scripts/install "$(BUILD)" "$(PREFIX)"

uninstall: ## removes what `make install` with the same PREFIX and DESTDIR added
	@scripts/install --remove "$(BUILD)" "$(PREFIX)"

build-bench: deps-bench
	@cmake -S . -B "$(BUILD)/bench" -DCMAKE_BUILD_TYPE=Release -DFROE_TESTS=OFF -DFROE_BENCH=ON
	@cmake --build "$(BUILD)/bench" --parallel $(JOBS)

bench: build-bench ## froe beside other programs of Debian: docs/evidence/benchmarks.md; SIZES="10000 10000000" for others
	@bench/run --build "$(BUILD)/bench"

# What cannot be installed is left out by the parts.
bench-peers: deps-bench ## and beside programs that have to be fetched or are large, where they can be had
	-@scripts/deps peers
	@$(MAKE) --no-print-directory build-bench
	@bench/run --build "$(BUILD)/bench" npm lines pieces pictures

claims: build-bench ## what the sources claim, measured: docs/evidence/claims.md
	@"$(BUILD)/bench/bin/bench_claims" docs/evidence/claims.md

oracle: build-bench ## pictures of large scenes against rays, half an hour
	@bench/run --build "$(BUILD)/bench" oracle

mutations: deps-test ## every bit of small tree files turned over, an hour: refused, found, or another right tree
	@cmake -S . -B "$(BUILD)" -DCMAKE_BUILD_TYPE=Release -DFROE_TESTS=ON
	@cmake --build "$(BUILD)" --parallel $(JOBS) --target test_conformance_mutations
	@program=$$(realpath "$(BUILD)/tests/test_conformance_mutations") && cd "$(BUILD)/scratch/conformance-mutations" && "$$program" all

faults: deps-test ## every allocation, read and write of every command failing, and signals at each; an hour
	@cmake -S . -B "$(BUILD)" -DCMAKE_BUILD_TYPE=Release -DFROE_TESTS=ON
	@cmake --build "$(BUILD)" --parallel $(JOBS) --target test_cli_allocations test_cli_faults test_cli_reads froe_faulty froe_faulty_core
	@scripts/faults "$(BUILD)"

# Tests that limit memory, stacks or sizes of files fail here, because counters need some; make test judges them.
coverage: deps-coverage ## which branches do the tests take? Fails below scripts/coverage.thresholds
	@cmake --preset coverage
	@cmake --build --preset coverage --parallel $(JOBS)
	@cmake -E rm -rf build/coverage/counts && mkdir build/coverage/counts
	@git describe --always --abbrev=8 --dirty >build/coverage/counts/commit
	-@ctest --preset coverage --quiet --parallel $(JOBS) --label-exclude 'project|docs|fuzz'
	@scripts/coverage build/coverage

mutate: coverage build ## would the tests notice a wrong operator? A sample of 400, about an hour
	@cmake -S . -B build -DFROE_TESTS=ON
	@cmake --build build --parallel $(JOBS)
	@scripts/mutate

# What is found is kept outside the project: scripts/fuzz says where.
.PHONY: fuzz platforms sanitize soak night
HOURS ?= 1
fuzz: deps-fuzz ## all fuzzers in turn for HOURS=n hours; a table of executions, places and findings
	@cmake --preset fuzz
	@cmake --build --preset fuzz --parallel $(JOBS)
	@scripts/fuzz $(HOURS)

# Left out are the documents, the demo, the project, and tests that look for wrong answers alone. TURN=1 takes every second
# test, TURN=2 the others.
comma := ,
sanitize: deps-test ## the tests under AddressSanitizer and UndefinedBehaviorSanitizer
	@cmake --preset asan-ubsan >/dev/null
	@cmake --build --preset asan-ubsan --parallel $(JOBS)
	@ctest --preset asan-ubsan --parallel $(JOBS) $(if $(TURN),-I $(TURN)$(comma)$(comma)2) -LE '^(claims|docs|project|fuzz)$$' \
	    -E '^(cli/demo|conformance/(floats|hashes|pictures))$$'
	@ctest --preset asan-ubsan --parallel $(JOBS) -L '^fuzz$$'

soak: deps-test ## decisions that are checked, for HOURS=n hours of one processor; tests/soak/ledger.tsv goes on
	@cmake -S . -B "$(BUILD)" -DCMAKE_BUILD_TYPE=Release -DFROE_TESTS=ON
	@cmake --build "$(BUILD)" --parallel $(JOBS) --target soak
	@scripts/soak --build "$(BUILD)" $(HOURS)

night: ## all that takes too long for every change, in order, with a summary; HOURS=n for fuzz and for soak
	@scripts/night $(HOURS)

platforms: deps-test ## trees, answers and pictures by other compilers, machines and checkers: the same hashes
	@scripts/platforms --build "$(BUILD)"

bare: deps-bare ## README.md word for word on a bare Debian 12, made for it and removed again; as root
	@scripts/bare

docs: build ## tables, outputs and pictures in the documents, as they come out now
	@scripts/file-table --write
	@cmake --install "$(BUILD)" --prefix "$(BUILD)/stage" >/dev/null
	@scripts/check-docs --accept "$(BUILD)/stage" *.md docs/*.md docs/*/*.md docs/*/*/*.md

python: deps-python ## wheel and source distribution of the Python package, tested: build/python/dist
	@scripts/python "$(BUILD)"

web: build deps-web ## froe as WebAssembly and its npm package, tested: build/web/package
	@scripts/web "$(BUILD)"

site: build deps-site ## the documents with search, and the functions: build/site/index.html
	@scripts/site/build "$(BUILD)"

dist: deps-dist ## all that a release consists of, with checksums: build/dist
	@scripts/dist "$(BUILD)"

release-check: deps-bare deps-dist ## may this commit be released? What is packed, tried on a bare machine; as root
	@scripts/release-check "$(BUILD)"

single: deps-test deps-single ## froe as one source and one header, tested: build/single/froe.c, froe.h
	@scripts/single "$(BUILD)"

format: deps-lint ## all sources as .clang-format says
	@git ls-files '*.c' '*.h' | xargs clang-format -i

lint: deps-test deps-lint ## format, clang-tidy, layers and sizes
	@scripts/lint

clean: ## removes the build folder
	@cmake -E rm -rf "$(BUILD)"
