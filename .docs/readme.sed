# Of README.md the pages show what is for hosts, from "Embedding" to "How exact".
/^## Embedding/,/^## How exact/!d
/^## How exact/d
s|^## Embedding|# Embedding {#embedding}|
# What is linked there is shown whole, here or on a page of its own.
s|\[examples/embed/main.cpp\](examples/embed/main.cpp)|`examples/embed/main.cpp`|
s|\[examples/embed/surface.cpp\](examples/embed/surface.cpp)|@ref surface_host "examples/embed/surface.cpp"|
# Other files of the project, by their names.
s|\[\([a-zA-Z_/.]*\)\](\1)|`\1`|g
s|\[\([^]]*\)\](\(bench/[a-z_/.]*\))|\1 (`\2`)|g
