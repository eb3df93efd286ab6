# `make help` says what there is. CMake does the work; this file fetches what
# it needs and remembers the commands.
PRESET ?= release
BUILD  ?= $(if $(filter release,$(PRESET)),build,build-$(PRESET))
OUT    ?= out
JOBS   ?= $(shell nproc)

CTEST  = ctest --test-dir "$(BUILD)" --output-on-failure --no-tests=error -j $(JOBS)
# Tests that say whether the engines' bits are the same: those that another compiler could fail.
ENGINES = ^(Engines|Interpreter|Identity|.*/Identity|Results.AreThose|Threads)

# Nobody named a build: the targets that test take the ones that they are for.
ALL_BUILDS = $(if $(filter-out file,$(origin PRESET) $(origin BUILD)),,yes)

export ASAN_OPTIONS ?= detect_stack_use_after_return=1:strict_string_checks=1
export UBSAN_OPTIONS ?= print_stacktrace=1
# Children of fork() start threads, and tests look at how a process ends.
export TSAN_OPTIONS ?= suppressions=$(CURDIR)/tests/support/tsan.suppressions:second_deadlock_stack=1$\
  :die_after_fork=0:handle_segv=0:handle_sigbus=0:handle_abort=0:handle_sigill=0:handle_sigfpe=0

# Files of ours that clang-format and clang-tidy look at.
CXX_SOURCES = $(shell git ls-files '*.h' '*.hpp' '*.c' '*.cpp' 2> /dev/null \
  || find runtime nodes pbs jit examples bench tests -name '*.h' -o -name '*.hpp' -o -name '*.c' -o -name '*.cpp')

# Where configuring looks: one copy for all builds, unless somebody names a folder of theirs.
OWN_LIBRARIES = $(abspath $(if $(filter file,$(origin BUILD)),build,$(BUILD)))/materialx/libraries
NACRE_MATERIALX_LIBRARIES ?= $(OWN_LIBRARIES)
OWN_NANOBIND = $(abspath $(if $(filter file,$(origin BUILD)),build,$(BUILD)))/nanobind
NACRE_NANOBIND ?= $(OWN_NANOBIND)

.DEFAULT_GOAL := build
.PHONY: bench build clean configure demo deps docs format format-check fuzz help install \
        materialx mutants nanobind test test-clang test-full \
        test-sanitized tidy

help: ## This list
	@grep -E '^[a-z-]+:.*## ' Makefile | sort \
	  | awk -F ':.*## ' '{ printf "  make %-15s %s\n", $$1, $$2 }'
	@echo "Variables: PRESET=release|debug|ci|clang|asan|tsan  BUILD=folder  OUT=folder  JOBS=n"

demo: configure ## Render and bake the examples into out/demo
	cmake --build "$(BUILD)" --parallel $(JOBS) --target nacre_tool
	examples/demo.sh "$(BUILD)" "$(OUT)/demo"

test: ## What CI runs; with PRESET=release (say) the tests in that build alone
ifeq ($(ALL_BUILDS),yes)
	$(MAKE) format-check
	$(MAKE) test-clang
	$(MAKE) test PRESET=ci
else
	$(MAKE) build
	$(CTEST) --label-exclude '^full$$'
endif

# Warnings are errors, and the engines' bits are the same as GCC's.
test-clang:
	$(MAKE) build PRESET=clang
	ctest --test-dir build-clang --output-on-failure --no-tests=error -j $(JOBS) -R '$(ENGINES)'

test-full: ## The same with all sweeps whole, and then with sanitizers
ifeq ($(ALL_BUILDS),yes)
	$(MAKE) format-check
	$(MAKE) test-clang
	$(MAKE) test-full PRESET=ci
	$(MAKE) test-sanitized
else
	$(MAKE) build
	NACRE_TEST_FULL=1 $(CTEST)
endif

# Without the sweep that compares what checking and compiling say, which test-full has run:
# mutants_many executes as many. OpenEXR's pool of threads is locked by code inlined everywhere, which
# the thread sanitizer half sees: it has none there.
test-sanitized: ## Tests, fuzzers and mutants under ASan and UBSan, what is concurrent under TSan
	$(MAKE) test PRESET=asan
	ctest --test-dir build-asan --output-on-failure --no-tests=error -j $(JOBS) -L '^full$$' -R '^fuzz/' \
	  -E agreeing_many
	$(MAKE) configure PRESET=tsan
	cmake --build build-tsan --parallel $(JOBS) --target concurrent_tests
	OPENIMAGEIO_OPTIONS=exr_threads=-1,threads=1 \
	  ctest --test-dir build-tsan --output-on-failure --no-tests=error -j $(JOBS) -L '^concurrent$$'

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

configure: deps materialx nanobind ## Run CMake
	cmake --preset $(PRESET) -B "$(BUILD)" \
	  -DNACRE_MATERIALX_LIBRARIES="$(NACRE_MATERIALX_LIBRARIES)" \
	  -DNACRE_NANOBIND="$(NACRE_NANOBIND)"

deps: ## Install the Debian packages that are missing (root or sudo)
	@.ci/install-packages

materialx: deps ## Fetch the MaterialX data library (pinned, hash checked)
	@test -f "$(NACRE_MATERIALX_LIBRARIES)/stdlib/stdlib_defs.mtlx" \
	  && test "$(NACRE_MATERIALX_LIBRARIES)" != "$(OWN_LIBRARIES)" \
	  || .ci/fetch-materialx "$(NACRE_MATERIALX_LIBRARIES)"

nanobind: deps ## Fetch what the Python module is built with (pinned, hash checked)
	@test -f "$(NACRE_NANOBIND)/nanobind/__init__.py" \
	  && test "$(NACRE_NANOBIND)" != "$(OWN_NANOBIND)" \
	  || .ci/fetch-nanobind "$(NACRE_NANOBIND)"

docs: configure ## The interface of the library as pages in out/docs
	@.ci/install-packages .packages-docs.txt
	rm -rf "$(OUT)/docs"
	mkdir -p "$(OUT)/docs"
	NACRE_DOCS="$(OUT)/docs" doxygen "$(BUILD)/Doxyfile"
	@echo "The pages begin at $(OUT)/docs/index.html"

install: build ## Install into PREFIX (default /usr/local)
	cmake --install "$(BUILD)" --prefix "$(or $(PREFIX),/usr/local)"

format: ## Format the C++ sources
	clang-format-19 -i $(CXX_SOURCES)

format-check: deps ## Fail if a C++ source is not formatted
	clang-format-19 --dry-run --Werror $(CXX_SOURCES)

tidy: configure ## Run clang-tidy over the C++ sources
	run-clang-tidy-19 -quiet -p "$(BUILD)" -j $(JOBS) '$(CURDIR)/(runtime|nodes|pbs|jit|examples|bench|tests)/'

clean: ## Remove the build folders and the output
	rm -rf $(if $(ALL_BUILDS),build build-*,"$(BUILD)") "$(OUT)"
