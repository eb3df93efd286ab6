# The installed product: libnacre.so, its headers, the MaterialX data library and
# a CMake package, so that a host writes find_package(nacre) and links nacre::nacre.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

get_property(nacre_archives GLOBAL PROPERTY NACRE_ARCHIVES)

# Every object of every archive: node bodies and engines register themselves, so a linker
# that takes only what is referred to would drop them. The archives are named as well for
# the libraries they need; by then nothing of theirs is missing, so nothing comes twice.
list(TRANSFORM nacre_archives REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>" OUTPUT_VARIABLE nacre_objects)
add_library(nacre SHARED ${nacre_objects})
add_library(nacre::nacre ALIAS nacre)
target_link_libraries(nacre PRIVATE ${nacre_archives})
add_dependencies(nacre nacre_compile_worker)
target_include_directories(nacre INTERFACE
  "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/jit/api/include>"
  "$<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/jit/api/include>"
  "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
target_compile_features(nacre INTERFACE cxx_std_17)
set_target_properties(nacre PROPERTIES
  LINKER_LANGUAGE CXX
  VERSION ${PROJECT_VERSION}
  # Before 1.0 every minor version may break the binary interface.
  SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
  LINK_DEPENDS "${PROJECT_SOURCE_DIR}/.cmake/nacre.map")

# The version script decides what a host can link against; see there.
target_link_options(nacre PRIVATE
  "LINKER:--version-script=${PROJECT_SOURCE_DIR}/.cmake/nacre.map"
  LINKER:-Bsymbolic-functions
  # What Clang's sanitizers call is in the program.
  $<$<NOT:$<BOOL:${NACRE_SANITIZED}>>:LINKER:--no-undefined>)

install(TARGETS nacre EXPORT nacre
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY "${PROJECT_SOURCE_DIR}/jit/api/include/nacre"
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} PATTERN "*.in" EXCLUDE)
install(FILES "${PROJECT_BINARY_DIR}/jit/api/include/nacre/version.h"
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/nacre)
# The library finds this from its own place, and so does a program that has it inside.
install(TARGETS nacre_compile_worker RUNTIME DESTINATION libexec/nacre)
# Programs find this folder from their own place: <bin>/../share/nacre/libraries.
install(DIRECTORY "${NACRE_MATERIALX_LIBRARIES}/" DESTINATION share/nacre/libraries
  PATTERN .requirement EXCLUDE)
install(FILES LICENSE DESTINATION share/nacre)
install(FILES jit/api/man/nacre.3 DESTINATION ${CMAKE_INSTALL_MANDIR}/man3)

set(nacre_package ${CMAKE_INSTALL_LIBDIR}/cmake/nacre)
install(EXPORT nacre NAMESPACE nacre:: FILE nacreTargets.cmake DESTINATION ${nacre_package})
configure_package_config_file(.cmake/nacreConfig.cmake.in
  "${CMAKE_CURRENT_BINARY_DIR}/nacreConfig.cmake"
  INSTALL_DESTINATION ${nacre_package} PATH_VARS CMAKE_INSTALL_PREFIX)
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/nacreConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/nacreConfig.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/nacreConfigVersion.cmake"
  DESTINATION ${nacre_package})

# For hosts without CMake; finds the prefix from its own place.
set(nacre_pc_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH nacre_prefix_from_pc "/${nacre_pc_folder}" "/")
configure_file(.cmake/nacre.pc.in "${CMAKE_CURRENT_BINARY_DIR}/nacre.pc" @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/nacre.pc" DESTINATION ${nacre_pc_folder})

# nacre_install_program(TARGET): a program for users, which may link libnacre.so.
function(nacre_install_program target)
  set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  install(TARGETS ${target} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()
