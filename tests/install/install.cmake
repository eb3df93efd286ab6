# cmake -DBUILD=folder -DPREFIX=folder -P install.cmake: a fresh installation.
file(REMOVE_RECURSE "${PREFIX}")
execute_process(COMMAND ${CMAKE_COMMAND} --install "${BUILD}" --prefix "${PREFIX}"
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
if(NOT EXISTS "${PREFIX}/libexec/nacre/nacre-compile-worker")
  message(FATAL_ERROR "nacre-compile-worker was not installed into ${PREFIX}")
endif()
if(NOT EXISTS "${PREFIX}/share/nacre/libraries/stdlib/stdlib_defs.mtlx")
  message(FATAL_ERROR "The MaterialX data library was not installed into ${PREFIX}")
endif()
