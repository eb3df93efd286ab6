#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/jit/document/tree_text.h"
#include "tests/support/standard_library.h"

namespace nacre {

/// The document of that version with that body.
inline std::unique_ptr<Document> read_version(std::string_view version, std::string_view body,
                                              Diagnostics& diagnostics,
                                              std::string_view attributes = "") {
  std::string text = "<materialx version=\"" + std::string(version) + "\" ";
  text += std::string(attributes) + ">\n" + std::string(body) + "</materialx>\n";
  return read_document_text(text, "test.mtlx", {}, diagnostics);
}

/// The tree of `body` in that version, in 1.39.
inline std::string upgraded(std::string_view version, std::string_view body,
                            std::string_view attributes = "") {
  Diagnostics diagnostics;
  const auto document = read_version(version, body, diagnostics, attributes);
  EXPECT_TRUE(diagnostics.all().empty()) << diagnostics.to_string();
  return document != nullptr ? tree_text(*document) : "";
}

inline std::string current(std::string_view body, std::string_view attributes = "") {
  return upgraded("1.39", body, attributes);
}

}  // namespace nacre
