# nacre_texts(TARGET FOLDER FUNCTION): the .mtlx files of a folder as texts in the target:
#
#     const std::vector<std::pair<std::string_view, std::string_view>>& FUNCTION();
#
# name and text of each, by name: "nacre:a.mtlx", so that no file of a user is taken for one.
function(nacre_texts target folder function)
  file(GLOB files CONFIGURE_DEPENDS ${folder}/*.mtlx)
  list(SORT files)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files})
  set(rows "")
  foreach(file IN LISTS files)
    file(READ ${file} text)
    get_filename_component(name ${file} NAME)
    string(APPEND rows "      {\"nacre:${name}\", R\"mtlx(${text})mtlx\"},\n")
  endforeach()
  nacre_table(${target} ${function} "std::pair<std::string_view, std::string_view>" "" "${rows}")
endfunction()
