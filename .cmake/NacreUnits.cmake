# nacre_units(TARGET LIST FUNCTION PREFIX): the node bodies named in a text file,
# one sorted line each:
#
#     folder/category          [replaces]
#
# adds folder/category.cpp to the target and the body, `void <PREFIX>_<category>(NodeCall&)`,
# to the table that FUNCTION returns. "replaces" prefers it to the data library's node graph.
function(nacre_units target list function prefix)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${list})
  file(STRINGS ${list} lines REGEX "^[a-z]")
  set(sorted ${lines})
  list(SORT sorted)
  if(NOT sorted STREQUAL lines)
    message(FATAL_ERROR "${list}: lines are not sorted")
  endif()
  set(declarations "")
  set(rows "")
  foreach(line IN LISTS lines)
    string(REGEX MATCH "^([a-z0-9_/]+)[ \t]*(replaces)?$" matched "${line}")
    if(NOT matched)
      message(FATAL_ERROR "${list}: not 'folder/category [replaces]': ${line}")
    endif()
    set(path ${CMAKE_MATCH_1})
    set(replaces false)
    if(CMAKE_MATCH_2)
      set(replaces true)
    endif()
    get_filename_component(category ${path} NAME)
    target_sources(${target} PRIVATE ${path}.cpp)
    string(APPEND declarations "void ${prefix}_${category}(NodeCall& call);\n")
    string(APPEND rows "      {\"${category}\", ${prefix}_${category}, ${replaces}},\n")
  endforeach()
  nacre_table(${target} ${function} NodeBody "${declarations}" "${rows}")
endfunction()
