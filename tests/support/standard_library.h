#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <memory>

#include "jit/document/library.h"

namespace nacre {

/// Folder of the MaterialX data library: environment variable
/// NACRE_MATERIALX_LIBRARIES, else the one the build was made for.
inline std::filesystem::path standard_library_folder() {
  if (const char* folder = std::getenv("NACRE_MATERIALX_LIBRARIES")) return folder;
  return NACRE_MATERIALX_LIBRARIES_DIR;
}

/// The data library, read once for the whole test program.
inline const Library& standard_library() {
  static const std::shared_ptr<const Library> library = [] {
    Diagnostics diagnostics;
    auto loaded = load_library({standard_library_folder()}, diagnostics,
                               {.read = {}, .standard_texts = true});
    if (loaded == nullptr) {
      ADD_FAILURE() << diagnostics.to_string();
      std::exit(1);
    }
    return loaded;
  }();
  return *library;
}

/// A document from the text between <materialx version="1.39"> and its end.
inline std::unique_ptr<Document> document_of(std::string_view body, Diagnostics& diagnostics,
                                             std::string_view attributes = "") {
  std::string text = "<materialx version=\"1.39\" ";
  text += attributes;
  text += ">\n";
  text += body;
  text += "</materialx>\n";
  return read_document_text(text, "test.mtlx", {}, diagnostics);
}

inline std::filesystem::path source_folder() { return NACRE_SOURCE_DIR; }

}  // namespace nacre
