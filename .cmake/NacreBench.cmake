# `bench` runs every benchmark program in turn and leaves one JSON file for each.
get_property(nacre_benches GLOBAL PROPERTY NACRE_BENCHES)
set(nacre_bench_results "${CMAKE_BINARY_DIR}/bench-results")
set(nacre_bench_commands COMMAND ${CMAKE_COMMAND} -E make_directory "${nacre_bench_results}")
foreach(bench IN LISTS nacre_benches)
  list(APPEND nacre_bench_commands COMMAND ${bench}
    "--benchmark_out=${nacre_bench_results}/${bench}.json" --benchmark_out_format=json)
endforeach()
add_custom_target(bench ${nacre_bench_commands}
  COMMAND ${CMAKE_COMMAND} -E echo "Results: ${nacre_bench_results}"
  DEPENDS ${nacre_benches}
  USES_TERMINAL VERBATIM)
