#pragma once

#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "jit/document/definitions.h"
#include "jit/document/document.h"
#include "jit/document/read.h"

namespace nacre {

/// A data library: nodedefs, the node graphs that implement them, units and
/// geometric properties. Loaded once, never changed, shared by all documents
/// and threads.
class Library {
 public:
  /// Reads the definitions of a document; faults of its nodedefs are reported.
  Library(std::unique_ptr<Document> document, Diagnostics& diagnostics)
      : document_(std::move(document)), definitions_(*document_, nullptr, diagnostics) {}

  /// All files as one tree.
  const Document& document() const { return *document_; }
  /// What it declares, by name.
  const Definitions& definitions() const { return definitions_; }

 private:
  std::unique_ptr<Document> document_;
  Definitions definitions_;
};

/// How a data library is read.
struct LibraryOptions {
  ReadOptions read;  ///< Search paths, limits and whether comments are kept.
  /// Also the GLSL texts of the data library itself (the folder that has a
  /// "stdlib"), for those who want them run: nothing else needs them, and they
  /// are a quarter of what there is to read.
  bool standard_texts = false;
  /// Name and text of what is read after all files, of two of one name the first stays.
  std::vector<std::pair<std::string_view, std::string_view>> more = {};
};

/// Loads files and folders, in the order given; of a folder all .mtlx files
/// below it in the order of their paths, "stdlib" before the others, without
/// the folders of implementations for other targets ("genosl" and so on).
/// Null if there was an error.
std::shared_ptr<const Library> load_library(const std::vector<std::filesystem::path>& paths,
                                            Diagnostics& diagnostics,
                                            const LibraryOptions& options = {});

}  // namespace nacre
