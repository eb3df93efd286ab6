# `make help` says what there is. CMake does the work; this file fetches what
# it needs and remembers the commands.
PRESET ?= release
BUILD  ?= $(if $(filter release,$(PRESET)),build,build-$(PRESET))
OUT    ?= out
JOBS   ?= $(shell nproc)

CTEST  = ctest --test-dir "$(BUILD)" --output-on-failure --no-tests=error -j $(JOBS)
# Files of ours that clang-format and clang-tidy look at.
CXX_SOURCES = $(shell git ls-files '*.h' '*.cpp')

# Where configuring looks; the same folder unless somebody names another.
NACRE_MATERIALX_LIBRARIES ?= $(abspath $(BUILD))/materialx/libraries

.DEFAULT_GOAL := build
.PHONY: bench build clean configure demo deps format format-check fuzz help install \
        materialx mutants test test-full tidy

help: ## This list
	@grep -E '^[a-z-]+:.*## ' Makefile | sort \
	  | awk -F ':.*## ' '{ printf "  make %-13s %s\n", $$1, $$2 }'
	@echo "Variables: PRESET=release|debug|asan|ci|clang  BUILD=folder  OUT=folder  JOBS=n"

demo: build ## Render and bake the examples into out/demo
	examples/demo.sh "$(BUILD)" "$(OUT)/demo"

test: build ## Run the tests, except the very long ones
	$(CTEST) --label-exclude '^full$$'

test-full: build ## Run every test, and let sweeps visit all they can
	NACRE_TEST_FULL=1 $(CTEST)

fuzz: ## Build the fuzzers and run each for FUZZ_SECONDS (default 60)
	$(MAKE) configure PRESET=asan
	FUZZ_SECONDS=$(or $(FUZZ_SECONDS),60) cmake --build build-asan --parallel $(JOBS) --target fuzz

mutants: ## Run COUNT (default 100000) documents spliced from others, with sanitizers
	$(MAKE) configure PRESET=asan
	cmake --build build-asan --parallel $(JOBS) --target mutants
	build-asan/tests/fuzz/mutants --count $(or $(COUNT),100000) --jobs $(JOBS) --keep build-asan/fuzz/mutants

bench: build ## Measure; results as JSON in <build>/bench-results
	cmake --build "$(BUILD)" --target bench

build: configure ## Compile everything
	cmake --build "$(BUILD)" --parallel $(JOBS)

configure: deps materialx ## Run CMake
	cmake --preset $(PRESET) -B "$(BUILD)" \
	  -DNACRE_MATERIALX_LIBRARIES="$(NACRE_MATERIALX_LIBRARIES)"

deps: ## Install the Debian packages that are missing (root or sudo)
	@.ci/install-packages

materialx: deps ## Fetch the MaterialX data library (pinned, hash checked)
	@test -f "$(NACRE_MATERIALX_LIBRARIES)/stdlib/stdlib_defs.mtlx" \
	  && test "$(NACRE_MATERIALX_LIBRARIES)" != "$(abspath $(BUILD))/materialx/libraries" \
	  || .ci/fetch-materialx "$(NACRE_MATERIALX_LIBRARIES)"

install: build ## Install into PREFIX (default /usr/local)
	cmake --install "$(BUILD)" --prefix "$(or $(PREFIX),/usr/local)"

format: ## Format the C++ sources
	clang-format-19 -i $(CXX_SOURCES)

format-check: ## Fail if a C++ source is not formatted
	clang-format-19 --dry-run --Werror $(CXX_SOURCES)

tidy: configure ## Run clang-tidy over the C++ sources
	run-clang-tidy-19 -quiet -p "$(BUILD)" -j $(JOBS) '$(CURDIR)/(runtime|nodes|pbs|jit|examples|bench|tests)/'

clean: ## Remove the build folder and the output
	rm -rf "$(BUILD)" "$(OUT)"
