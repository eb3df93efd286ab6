# What `make docs` gives to Doxygen: the headers that are installed, and pages that lead to them.
# Configuring needs no Doxygen.
file(GLOB nacre_docs_input CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/jit/api/include/nacre/*.h*")
list(FILTER nacre_docs_input EXCLUDE REGEX "\\.in$")
list(APPEND nacre_docs_input
  "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/.docs/index.md")
list(TRANSFORM nacre_docs_input REPLACE "(.+)" "\"\\1\"")
list(JOIN nacre_docs_input " \\\n  " nacre_docs_input)
configure_file(.docs/Doxyfile.in Doxyfile @ONLY)
