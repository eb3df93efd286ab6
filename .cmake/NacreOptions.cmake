# Flags that every target of ours shares. `nacre_flags` is linked privately.
add_library(nacre_flags INTERFACE)
target_include_directories(nacre_flags INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
target_compile_options(nacre_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  # GCC 12 sees overlaps in any literal + std::string (GCC bug 105651, mended in 13).
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>
  # Contraction is a pass of our own: the interpreter must round as the JIT does.
  -ffp-contract=off
  # Nobody replaces our functions by preloading, so calls inside libnacre.so stay direct.
  -fno-semantic-interposition
  $<$<BOOL:${NACRE_WERROR}>:-Werror>)

string(FIND "${CMAKE_CXX_FLAGS}" -fsanitize= NACRE_SANITIZED)
math(EXPR NACRE_SANITIZED "${NACRE_SANITIZED} + 1")

# What a sanitizer takes itself, as a factor: tests that bound time or memory allow it.
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize=[a-z,-]*address")
  set(NACRE_SANITIZER_SHARE 4)
endif()

# A rebuild after switching branches costs seconds; somebody who includes us decides for themselves.
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(NACRE_CCACHE ccache)
  mark_as_advanced(NACRE_CCACHE)
  if(NACRE_CCACHE AND NACRE_PRECOMPILE)
    # What ccache asks for to keep what precompiled headers are used for.
    set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros "${NACRE_CCACHE}")
  elseif(NACRE_CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER "${NACRE_CCACHE}")
  endif()
endif()

# nacre_library(NAME SOURCES...): one folder of the library as a static archive.
# Tests link the archives they need; libnacre.so is all of runtime, nodes, pbs and jit.
function(nacre_library name)
  add_library(${name} STATIC ${ARGN})
  target_link_libraries(${name} PRIVATE nacre_flags)
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  set_property(GLOBAL APPEND PROPERTY NACRE_ARCHIVES ${name})
endfunction()

# nacre_test(NAME [FULL] [CONCURRENT] SOURCES...): a GoogleTest program, one ctest entry per test.
# FULL: too long for every day; left out by `make test`, run by `make test-full`.
# CONCURRENT: threads of ours meet in it; `make test-full` runs it with the thread sanitizer too.
function(nacre_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "FULL;CONCURRENT" "" "")
  add_executable(${name} ${arg_UNPARSED_ARGUMENTS})
  target_link_libraries(${name} PRIVATE nacre_flags GTest::gtest GTest::gtest_main)
  set(seconds 1200)
  if(NACRE_SANITIZER_SHARE)
    math(EXPR seconds "${seconds} * ${NACRE_SANITIZER_SHARE}")
  endif()
  set(properties TIMEOUT ${seconds})
  if(arg_FULL)
    set(properties TIMEOUT 7200 LABELS full)
  elseif(arg_CONCURRENT)
    list(APPEND properties LABELS concurrent)
    set_property(GLOBAL APPEND PROPERTY NACRE_CONCURRENT_TESTS ${name})
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES ${properties})
endfunction()

# nacre_optimize_folder(): of tests that compute much, where others are not optimised.
macro(nacre_optimize_folder)
  if(NACRE_OPTIMIZE_HOSTS AND NOT NACRE_OPTIMIZE_TESTS)
    add_compile_options(-O2)
  endif()
endmacro()

# nacre_bench(NAME SOURCES...): a Google Benchmark program, run by the target `bench`; it
# defines register_benchmarks() (bench/common/benchmarks.h).
function(nacre_bench name)
  add_executable(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE nacre_flags nacre_bench_common)
  set_property(GLOBAL APPEND PROPERTY NACRE_BENCHES ${name})
endfunction()

# nacre_unite(TARGET PATTERN): sources that include such headers are compiled together, a dozen at a
# time: each would compile all of what a library has inline anew, as CLI11 is as a whole.
function(nacre_unite target pattern)
  get_target_property(sources ${target} SOURCES)
  set(count 0)
  foreach(source IN LISTS sources)
    file(STRINGS "${source}" includes REGEX "#include .*(${pattern})")
    if(includes)
      math(EXPR group "${count} / 12")
      math(EXPR count "${count} + 1")
      set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${target}_${group}")
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
