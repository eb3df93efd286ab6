# What the Python module is built with: the interpreter's headers, and nanobind. Sets
# NACRE_HAS_PYTHON. Nothing is fetched; `make` and pip see to nanobind.
set(NACRE_NANOBIND "" CACHE PATH
    "Folder of the package nanobind (nanobind/cmake is in it); empty: that of the interpreter")
set(NACRE_HAS_PYTHON FALSE)

# NumPy and pytest come from Debian, so it is Debian's Python and not the first of the PATH, but
# where somebody names one: pip does.
if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python 3.11 COMPONENTS Interpreter Development.Module)
if(NOT Python_FOUND)
  message(WARNING "No Python module: no headers of Python 3.11 or later (Debian: python3-dev)")
  return()
endif()

set(nanobind_cmake "${NACRE_NANOBIND}/nanobind/cmake")
if(NOT NACRE_NANOBIND)
  execute_process(COMMAND "${Python_EXECUTABLE}" -m nanobind --cmake_dir
    OUTPUT_VARIABLE nanobind_cmake OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
elseif(NOT EXISTS "${nanobind_cmake}/nanobind-config.cmake")
  message(FATAL_ERROR "NACRE_NANOBIND: there is no nanobind in ${NACRE_NANOBIND}")
endif()
if(NOT nanobind_cmake)
  message(WARNING
    "No Python module: ${Python_EXECUTABLE} has no nanobind. Fetch the pinned one:\n"
    "    ${PROJECT_SOURCE_DIR}/.ci/fetch-nanobind <folder>\n"
    "and name it, -DNACRE_NANOBIND=<folder> (`make` does so); -DNACRE_BUILD_PYTHON=OFF does "
    "without.")
  return()
endif()
set(nanobind_DIR "${nanobind_cmake}")
find_package(nanobind 3.1 CONFIG REQUIRED)
set(NACRE_HAS_PYTHON TRUE)
