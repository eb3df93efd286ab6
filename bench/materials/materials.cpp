#include <fmt/format.h>

#include <memory>
#include <string>

#include "bench/common/benchmarks.h"
#include "bench/common/material.h"
#include "bench/common/system.h"
#include "jit/graph/build/build.h"

namespace nacre::bench {

namespace {

/// Narrow lobes magnify rounding; a choice of lobe may fall on the other side.
constexpr Tolerance tolerance{.absolute = 1e-4, .relative = 5e-3, .outliers = 0.01};

/// A material of bench/documents/materials.mtlx; empty where it can't be built.
std::shared_ptr<const Graph> material_graph(const std::string& name, std::string& error) {
  Diagnostics diagnostics;
  auto graph = build_graph(bench_document("materials.mtlx"), shading_system().library(),
                           {.outputs = {}, .material = name}, graph_options(), diagnostics);
  if (graph) return std::make_shared<Graph>(std::move(*graph));
  error = diagnostics.to_string();
  return nullptr;
}

void register_material(const std::string& name, ParameterMode parameters, const char* mode) {
  for (const Entry entry : {Entry::begin, Entry::sample, Entry::evaluate, Entry::albedo}) {
    const auto make = [=](const CompileOptions& options,
                          std::string& error) -> std::unique_ptr<KernelRun> {
      const auto graph = material_graph(name, error);
      return graph == nullptr ? nullptr : run_material(*graph, parameters, entry, options, error);
    };
    register_kernel(fmt::format("materials/{}/{}/{}", name, mode, entry_name(entry)),
                    all_variants(), make, tolerance);
  }
}

}  // namespace

void register_benchmarks() {
  for (const char* name : {"UsdPreviewSurface", "disney_principled", "gltf_pbr", "open_pbr_surface",
                           "standard_surface"}) {
    register_material(name, ParameterMode::frozen, "frozen");
  }
  register_material("standard_surface", ParameterMode::live, "live");
}

}  // namespace nacre::bench
