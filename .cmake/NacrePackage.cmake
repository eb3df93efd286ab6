# The installed product: libnacre.so, its headers, the MaterialX data library and
# a CMake package, so that a host writes find_package(nacre) and links nacre::nacre.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

get_property(nacre_archives GLOBAL PROPERTY NACRE_ARCHIVES)
get_property(nacre_headers GLOBAL PROPERTY NACRE_PUBLIC_HEADERS)

# Every archive whole: node bodies and engines register themselves, so a linker
# that only takes what is referred to would drop them.
add_library(nacre SHARED)
add_library(nacre::nacre ALIAS nacre)
list(JOIN nacre_archives "," nacre_archives_joined)
target_link_libraries(nacre PRIVATE "$<LINK_LIBRARY:WHOLE_ARCHIVE,${nacre_archives_joined}>")
target_sources(nacre PUBLIC FILE_SET HEADERS
  BASE_DIRS "${PROJECT_SOURCE_DIR}" FILES ${nacre_headers})
target_compile_features(nacre INTERFACE cxx_std_20)
set_target_properties(nacre PROPERTIES
  LINKER_LANGUAGE CXX
  VERSION ${PROJECT_VERSION}
  # Before 1.0 every minor version may break the binary interface.
  SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
  LINK_DEPENDS "${PROJECT_SOURCE_DIR}/.cmake/nacre.map")

# The version script decides what a host can link against; see there.
target_link_options(nacre PRIVATE
  "LINKER:--version-script=${PROJECT_SOURCE_DIR}/.cmake/nacre.map"
  LINKER:-Bsymbolic-functions LINKER:--no-undefined)

install(TARGETS nacre EXPORT nacre
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/nacre)
if(TARGET nacre_tool)
  set_target_properties(nacre_tool PROPERTIES
    INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  install(TARGETS nacre_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
# The tool finds this folder from its own place: <bin>/../share/nacre/libraries.
install(DIRECTORY "${NACRE_MATERIALX_LIBRARIES}/" DESTINATION share/nacre/libraries
  PATTERN .requirement EXCLUDE)
install(FILES LICENSE DESTINATION share/nacre)

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
