#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "jit/document/read.h"
#include "jit/shading/shading_system.h"

namespace nacre {

/// The system of the test program, with the data library.
inline ShadingSystem& tune_system() {
  static const std::unique_ptr<ShadingSystem> made = [] {
    Diagnostics diagnostics;
    auto system =
        ShadingSystem::create({.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}}, diagnostics);
    EXPECT_EQ(diagnostics.to_string(), "");
    return system;
  }();
  return *made;
}

inline std::unique_ptr<Document> document_of(const std::string& text) {
  Diagnostics diagnostics;
  auto document = read_document_text(text, "test.mtlx", {}, diagnostics);
  EXPECT_NE(document, nullptr) << diagnostics.to_string();
  return document;
}

}  // namespace nacre
