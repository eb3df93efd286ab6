#include "jit/shading/variants.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <thread>
#include <utility>

#include "jit/graph/find.h"
#include "jit/shading/compilation.h"
#include "runtime/float_environment.h"

namespace nacre {

namespace {

/// One of the variants on its way.
struct Variant {
  Variant(const SystemParts& parts, const ShaderOptions& options)
      : compilation(parts, from_now(options), said) {}

  Diagnostics said;
  Compilation compilation;
  std::optional<Compilation::RecordedMaterial> recorded;
  std::unique_ptr<MaterialKernels> kernels;
};

/// The options of a graph that is right for all of them.
ShaderOptions graph_of_all(std::span<const ShaderOptions> variants) {
  ShaderOptions options = from_now(variants.front());
  for (const ShaderOptions& each : variants) {
    options.graph.default_parameters |= from_now(each).graph.default_parameters;
  }
  return options;
}

/// Each once, in their order.
std::vector<std::string> values_of_all(std::span<const ShaderOptions> variants) {
  std::vector<std::string> values;
  for (const ShaderOptions& each : variants) {
    for (std::string& value : values_of(each.kernels.with_begin)) {
      if (std::ranges::find(values, value) == values.end()) values.push_back(std::move(value));
    }
  }
  return values;
}

/// What each says, but once what several say.
void say(const std::vector<std::unique_ptr<Variant>>& variants, Diagnostics& diagnostics) {
  std::set<std::string> known;
  for (const auto& each : variants) {
    for (const Diagnostic& one : each->said.all()) {
      if (known.insert(one.to_string()).second) diagnostics.add(one);
    }
  }
}

}  // namespace

std::vector<std::string> values_of(const std::vector<std::string>& with_begin) {
  std::vector<std::string> values;
  std::ranges::copy_if(with_begin, std::back_inserter(values),
                       [](const std::string& name) { return !is_point_result(name); });
  return values;
}

std::vector<std::unique_ptr<MaterialKernels>> make_variants(const Document& document,
                                                            const std::string& material,
                                                            const SystemParts& parts,
                                                            std::span<const ShaderOptions> variants,
                                                            Diagnostics& diagnostics) {
  if (variants.empty()) return {};
  const std::size_t errors = diagnostics.error_count();
  Compilation building(parts, graph_of_all(variants), diagnostics);
  const auto graph = building.build(
      document, {.outputs = {}, .material = material, .values = values_of_all(variants)});
  if (!graph) return {};
  const SourceLocation where = location_of(document, material);
  std::vector<std::unique_ptr<Variant>> made;
  bool is_recorded = diagnostics.error_count() == errors;
  for (const ShaderOptions& options : variants) {
    Variant& variant = *made.emplace_back(std::make_unique<Variant>(parts, options));
    variant.compilation.is_of(document);
    variant.recorded = variant.compilation.record_material(*graph, where);
    is_recorded = is_recorded && variant.recorded;
    if (!variant.recorded) break;
  }
  if (is_recorded) {
    // They wait for those who compile, each for its own.
    std::vector<std::jthread> waiting;
    for (const auto& variant : made) {
      waiting.emplace_back([&graph, &each = *variant] {
        const ScopedDefaultFloatEnvironment environment;
        each.kernels = each.compilation.finish(*graph, std::move(*each.recorded));
      });
    }
  }
  say(made, diagnostics);
  std::vector<std::unique_ptr<MaterialKernels>> kernels;
  for (const auto& variant : made) {
    if (variant->kernels == nullptr) return {};
    kernels.push_back(std::move(variant->kernels));
  }
  return kernels;
}

}  // namespace nacre
