# Standard headers are parsed once a target, not once a file: half of what Clang does at -O0. It
# hides includes that are missing, which another build has to find: an option, and off.

# nacre_precompile(FOLDER): for all targets made so far in a folder and those below it.
function(nacre_precompile folder)
  get_property(targets DIRECTORY "${folder}" PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    nacre_precompile_target(${target})
  endforeach()
  get_property(below DIRECTORY "${folder}" PROPERTY SUBDIRECTORIES)
  foreach(each IN LISTS below)
    nacre_precompile("${each}")
  endforeach()
endfunction()

function(nacre_precompile_target target)
  get_target_property(type ${target} TYPE)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  list(LENGTH sources count)
  # For fewer files it takes longer than it spares.
  if(type STREQUAL "UTILITY" OR type STREQUAL "INTERFACE_LIBRARY" OR count LESS 3)
    return()
  endif()
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <atomic> <bit> <cmath> <cstdint> <cstring> <filesystem> <functional>
    <map> <memory> <mutex> <optional> <set> <span> <string> <string_view> <unordered_map> <utility>
    <vector>)
  # Times of headers would make it another one in each clone, for ccache too.
  target_compile_options(${target} PRIVATE
    $<$<COMPILE_LANG_AND_ID:CXX,Clang>:SHELL:-Xclang -fno-pch-timestamp>)
  # What is compiled for another instruction set parses for itself.
  get_target_property(folder ${target} SOURCE_DIR)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY "${folder}")
    get_source_file_property(flags "${source}" TARGET_DIRECTORY ${target} COMPILE_OPTIONS)
    if(flags)
      set_source_files_properties("${source}" TARGET_DIRECTORY ${target}
        PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
  get_target_property(libraries ${target} LINK_LIBRARIES)
  # By who links it alone: OpenImageIO's headers take its code into the file.
  if("fmt::fmt" IN_LIST libraries)
    target_precompile_headers(${target} PRIVATE <fmt/format.h>)
  endif()
  if("GTest::gtest" IN_LIST libraries)
    target_precompile_headers(${target} PRIVATE <gtest/gtest.h>)
  endif()
endfunction()
