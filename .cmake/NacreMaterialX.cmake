# The MaterialX 1.39.5 data library: nodedefs and node graphs, read at run time.
set(NACRE_MATERIALX_LIBRARIES "${CMAKE_BINARY_DIR}/materialx/libraries" CACHE PATH
    "Folder of the MaterialX 1.39.5 data library")
if(NOT NACRE_MATERIALX_LIBRARIES)
  set(NACRE_MATERIALX_LIBRARIES "${CMAKE_BINARY_DIR}/materialx/libraries")
endif()

# pip builds with the wheel that has it (pyproject.toml).
if(DEFINED SKBUILD AND NOT EXISTS "${NACRE_MATERIALX_LIBRARIES}/stdlib/stdlib_defs.mtlx")
  execute_process(
    COMMAND "${Python_EXECUTABLE}" -c "import importlib.util as u; \
print(u.find_spec('MaterialX').submodule_search_locations[0] + '/libraries', end='')"
    OUTPUT_VARIABLE NACRE_MATERIALX_LIBRARIES ERROR_QUIET)
endif()

# Nothing is compiled from it, so its absence stops the tests and the tool, not the build.
if(NOT EXISTS "${NACRE_MATERIALX_LIBRARIES}/stdlib/stdlib_defs.mtlx")
  message(WARNING
    "No MaterialX data library in\n    ${NACRE_MATERIALX_LIBRARIES}\n"
    "Fetch the pinned one:\n"
    "    ${PROJECT_SOURCE_DIR}/.ci/fetch-materialx ${NACRE_MATERIALX_LIBRARIES}\n"
    "(`make` does so), or name another copy of version 1.39.5:\n"
    "    cmake -DNACRE_MATERIALX_LIBRARIES=<folder that holds stdlib/stdlib_defs.mtlx> ...\n"
    "Until then tests, tool and `cmake --install` fail where they need it.")
endif()

# For programs that run in the build tree. What is installed looks beside itself first.
add_library(nacre_materialx_libraries INTERFACE)
target_compile_definitions(nacre_materialx_libraries INTERFACE
  NACRE_MATERIALX_LIBRARIES_DIR="${NACRE_MATERIALX_LIBRARIES}")
