# Flags that every target of ours shares. `nacre_flags` is linked privately.
add_library(nacre_flags INTERFACE)
target_include_directories(nacre_flags INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
target_compile_options(nacre_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  # Contraction is a pass of our own: the interpreter must round as the JIT does.
  -ffp-contract=off
  $<$<BOOL:${NACRE_WERROR}>:-Werror>)

# nacre_library(NAME SOURCES... ): one folder of the library as a static archive.
function(nacre_library name)
  add_library(${name} STATIC ${ARGN})
  target_link_libraries(${name} PRIVATE nacre_flags)
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
endfunction()

# nacre_test(NAME SOURCES...): a GoogleTest program, one ctest entry per test.
function(nacre_test name)
  add_executable(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE nacre_flags GTest::gtest GTest::gtest_main)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endfunction()
