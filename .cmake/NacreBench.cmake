# `bench` runs every benchmark program in turn, leaves one JSON file for each, and tables
# and plots of them all beside these.
# The plots are matplotlib's, which comes from Debian, so it is Debian's Python and not the
# first of the PATH; where there is none, that.
find_program(NACRE_BENCH_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(NACRE_BENCH_PYTHON python3 REQUIRED)
if(NACRE_BUILD_TESTS)
  add_test(NAME bench/python COMMAND "${NACRE_BENCH_PYTHON}" -c "import matplotlib.pyplot")
endif()
get_property(nacre_benches GLOBAL PROPERTY NACRE_BENCHES)
set(nacre_bench_results "${CMAKE_BINARY_DIR}/bench-results")
set(nacre_bench_programs ${nacre_benches})
list(TRANSFORM nacre_bench_programs REPLACE "(.+)" "$<TARGET_FILE:\\1>")
set(nacre_bench_figures "")
if(TARGET nacre_python)
  list(APPEND nacre_benches nacre_python)
  list(APPEND nacre_bench_programs "${PROJECT_SOURCE_DIR}/bench/python/bench_python.py")
  # The other figures of the README; Mitsuba comes from PyPI where there is none.
  set(nacre_bench_python "${CMAKE_COMMAND}" -E env "PYTHONPATH=${CMAKE_BINARY_DIR}/python"
    "${NACRE_BENCH_PYTHON}")
  set(nacre_bench_figures
    COMMAND ${nacre_bench_python} "${PROJECT_SOURCE_DIR}/bench/front.py"
      --install "${CMAKE_BINARY_DIR}/bench-peers" --out "${nacre_bench_results}/report"
    COMMAND ${nacre_bench_python} "${PROJECT_SOURCE_DIR}/bench/fading.py"
      --out "${nacre_bench_results}/report")
endif()
set(nacre_bench_hosts startup_host)
set(nacre_bench_tool "")
set(nacre_bench_renders "")
if(TARGET nacre_tool)
  list(APPEND nacre_bench_hosts nacre_tool)
  set(nacre_bench_tool --tool $<TARGET_FILE:nacre_tool>)
  # Beside another renderer, which comes from PyPI where there is none.
  set(nacre_bench_renders COMMAND "${NACRE_BENCH_PYTHON}"
    "${PROJECT_SOURCE_DIR}/bench/renders/equal_error.py" "${nacre_bench_results}/report/equal_error.md"
    $<TARGET_FILE:nacre_tool> --install "${CMAKE_BINARY_DIR}/bench-peers"
    --keep "${nacre_bench_results}/equal_error")
endif()
add_custom_target(bench
  COMMAND ${CMAKE_COMMAND} -E env "PYTHONPATH=${CMAKE_BINARY_DIR}/python"
    "${NACRE_BENCH_PYTHON}" "${PROJECT_SOURCE_DIR}/bench/run.py"
    --out "${nacre_bench_results}" ${nacre_bench_programs}
  COMMAND "${NACRE_BENCH_PYTHON}" "${PROJECT_SOURCE_DIR}/bench/report.py"
    "${nacre_bench_results}" --out "${nacre_bench_results}/report"
  COMMAND "${NACRE_BENCH_PYTHON}" "${PROJECT_SOURCE_DIR}/bench/startup.py"
    --host $<TARGET_FILE:startup_host> ${nacre_bench_tool}
    --out "${nacre_bench_results}/report/startup.md"
  ${nacre_bench_figures}
  ${nacre_bench_renders}
  COMMAND "${NACRE_BENCH_PYTHON}" "${PROJECT_SOURCE_DIR}/bench/report.py"
    "${nacre_bench_results}" --verify
  COMMAND ${CMAKE_COMMAND} -E echo "Tables and plots: ${nacre_bench_results}/report"
  DEPENDS ${nacre_benches} ${nacre_bench_hosts}
  USES_TERMINAL VERBATIM)
