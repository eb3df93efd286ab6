# nacre_texts(TARGET FOLDER FUNCTION): the .mtlx files of a folder as texts in the target:
#
#     const std::vector<std::pair<std::string_view, std::string_view>>& FUNCTION();
#
# name and text of each, by name.
function(nacre_texts target folder function)
  file(GLOB files CONFIGURE_DEPENDS ${folder}/*.mtlx)
  list(SORT files)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files})
  set(rows "")
  foreach(file IN LISTS files)
    file(READ ${file} text)
    get_filename_component(name ${file} NAME)
    string(APPEND rows "      {\"${name}\", R\"mtlx(${text})mtlx\"},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp CONTENT
"// Written by CMake from the files of @folder@.
#include <string_view>
#include <utility>
#include <vector>

namespace nacre {

const std::vector<std::pair<std::string_view, std::string_view>>& @function@() {
  static const std::vector<std::pair<std::string_view, std::string_view>> texts{
@rows@  };
  return texts;
}

}  // namespace nacre
" @ONLY)
  target_sources(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp)
endfunction()
