# `bench` runs every benchmark program in turn, leaves one JSON file for each, and tables
# and plots of them all beside these.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
get_property(nacre_benches GLOBAL PROPERTY NACRE_BENCHES)
set(nacre_bench_results "${CMAKE_BINARY_DIR}/bench-results")
set(nacre_bench_programs ${nacre_benches})
list(TRANSFORM nacre_bench_programs REPLACE "(.+)" "$<TARGET_FILE:\\1>")
add_custom_target(bench
  COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/bench/run.py"
    --out "${nacre_bench_results}" ${nacre_bench_programs}
  COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/bench/report.py"
    "${nacre_bench_results}" --out "${nacre_bench_results}/report"
  COMMAND ${CMAKE_COMMAND} -E echo "Tables and plots: ${nacre_bench_results}/report"
  DEPENDS ${nacre_benches}
  USES_TERMINAL VERBATIM)
