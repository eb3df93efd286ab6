# Parts of the library in files of their own, opened when something needs them (runtime/module.h).
include(GNUInstallDirs)

# What library and modules have in common: the version, the compiler and what it was told, and
# the headers of what they hand each other. A module of another build is refused.
file(GLOB nacre_common_headers RELATIVE "${PROJECT_SOURCE_DIR}" CONFIGURE_DEPENDS
  examples/common/*.h examples/image_input/*.h jit/graph/*.h jit/graph/color/*.h jit/ocio/*.h runtime/*.h runtime/texture/*.h)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${nacre_common_headers})
string(TOUPPER "${CMAKE_BUILD_TYPE}" nacre_build_type)
set(nacre_common "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_CXX_FLAGS} "
  "${CMAKE_BUILD_TYPE} ${CMAKE_CXX_FLAGS_${nacre_build_type}}")
foreach(header IN LISTS nacre_common_headers)
  file(SHA256 "${PROJECT_SOURCE_DIR}/${header}" nacre_digest)
  list(APPEND nacre_common "${header} ${nacre_digest}")
endforeach()
string(SHA256 nacre_digest "${nacre_common}")
string(SUBSTRING "${nacre_digest}" 0 16 nacre_digest)
set(NACRE_BUILD_KEY "${PROJECT_VERSION} ${nacre_digest}")

# nacre_module(NAME SOURCES...): NAME.so, whose functions are in the table that its
# nacre_module() returns.
function(nacre_module name)
  add_library(${name} MODULE ${ARGN})
  target_link_libraries(${name} PRIVATE nacre_flags)
  target_compile_definitions(${name} PRIVATE NACRE_BUILD_KEY="${NACRE_BUILD_KEY}")
  set_target_properties(${name} PROPERTIES
    PREFIX "" LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/modules"
    LINK_DEPENDS "${PROJECT_SOURCE_DIR}/.cmake/module.map")
  target_link_options(${name} PRIVATE
    "LINKER:--version-script=${PROJECT_SOURCE_DIR}/.cmake/module.map"
    $<$<NOT:$<BOOL:${NACRE_SANITIZED}>>:LINKER:--no-undefined>)
  install(TARGETS ${name} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/nacre")
endfunction()
