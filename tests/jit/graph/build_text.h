#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "jit/graph/build/build.h"
#include "tests/support/standard_library.h"

namespace nacre {

/// The graph of outputs of a document given as text; empty after a failure.
inline Graph graph_of(std::string_view body, const std::vector<std::string>& outputs,
                      const GraphOptions& options = {}, std::string_view attributes = "") {
  Diagnostics diagnostics;
  const auto document = document_of(body, diagnostics, attributes);
  std::optional<Graph> graph;
  if (document != nullptr) {
    graph = build_graph(*document, standard_library(), {outputs, ""}, options, diagnostics);
  }
  EXPECT_TRUE(graph) << diagnostics.to_string();
  if (!graph) return {};
  EXPECT_TRUE(verify(*graph, diagnostics)) << diagnostics.to_string();
  return *graph;
}

inline std::string text_of(std::string_view body, const std::vector<std::string>& outputs,
                           const GraphOptions& options = {}, std::string_view attributes = "") {
  return to_string(graph_of(body, outputs, options, attributes));
}

}  // namespace nacre
