# nacre_table(TARGET FUNCTION TYPE HEAD ROWS): adds a source to the target in which FUNCTION returns
# a `const std::vector<TYPE>&` with these rows, after what HEAD declares.
function(nacre_table target function type head rows)
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp CONTENT
"// Written by CMake.
#include <string_view>
#include <utility>
#include <vector>

#include \"runtime/node/node_call.h\"

namespace nacre {

@head@
const std::vector<@type@>& @function@() {
  static const std::vector<@type@> rows{
@rows@  };
  return rows;
}

}  // namespace nacre
" @ONLY)
  target_sources(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp)
endfunction()
