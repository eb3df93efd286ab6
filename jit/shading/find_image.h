#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "jit/document/file_roots.h"
#include "jit/graph/graph.h"
#include "jit/record/textures.h"

namespace nacre {

/// Below which the images of a graph lie: the folders of its document, the search paths and
/// the libraries. None for a graph that was made without a document: they lie anywhere.
FileRoots image_roots(const Graph& graph, const std::vector<std::filesystem::path>& search_paths,
                      const std::vector<std::filesystem::path>& libraries);

/// What a recording may have: what the roots hold, or everything where there are none.
ImageAccess image_access(const FileRoots& roots, MissingImages missing, const Stop& stop);

/// The file that a name in a document means: of those beside the document that wrote it,
/// then on the search paths, the first that is there and below a root (anywhere, where there
/// are none). Where there is no such file, the first place that is below a root, for the
/// complaint; else the first place, which the caller refuses as it would if it were there.
/// The name of a tiled image (<UDIM>) names no file: its folder must be there.
std::string find_image(const std::string& name, const std::string& document,
                       const std::vector<std::filesystem::path>& search_paths,
                       const FileRoots& roots);

}  // namespace nacre
