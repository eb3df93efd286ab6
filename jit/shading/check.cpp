// ShadingSystem::check: what compiling would say, without machine code.
#include "jit/graph/check/check.h"

#include <set>
#include <tuple>
#include <utility>

#include "jit/graph/find.h"
#include "jit/graph/resolve/node_source.h"
#include "jit/record/source_bodies.h"
#include "jit/shading/compilation.h"
#include "runtime/float_environment.h"

namespace nacre {

namespace {

/// Materials by name, outputs that lead to one too.
std::vector<std::string> names_of_materials(const Document& document) {
  std::vector<std::string> names;
  for (const FoundMaterial& material : find_materials(document)) names.push_back(material.name);
  for (const FoundOutput& output : find_outputs(document)) {
    if (output.type == Type::material) names.push_back(output.name);
  }
  return names;
}

/// What is shared is met once for each that shares it.
void add_once(const Diagnostics& all, Diagnostics& diagnostics) {
  std::set<std::tuple<std::string, std::string, int, std::string, std::string>> seen;
  for (const Diagnostic& one : all.all()) {
    const SourceLocation& at = one.where;
    if (seen.emplace(one.code, at.file, at.line, at.path, one.message).second) diagnostics.add(one);
  }
}

void append(const Diagnostics& some, Diagnostics& all) {
  for (const Diagnostic& one : some.all()) all.add(one);
}

}  // namespace

void ShadingSystem::check(const Document& document, const ShaderOptions& asked,
                          Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  const ShaderOptions options = from_now(asked);
  Diagnostics found;
  if (check_document(document, *library_, graph_options(options), found)) {
    check_sources(document, found);
    check_outputs(document, options, found);
    for (const std::string& material : names_of_materials(document)) {
      if (options.compile.stop.is_due() && found.has_errors()) break;
      check_material(document, material, options, found);
    }
  }
  add_once(found, diagnostics);
}

void ShadingSystem::check_sources(const Document& document, Diagnostics& diagnostics) {
  Diagnostics known;
  const Definitions definitions(document, &library_->definitions(), known);
  for (const NodeDef* def : definitions.all()) {
    const Element* source = definitions.source_of(*def);
    if (source == nullptr || &source->document() != &document || !may_be_source(*def)) continue;
    sources_->check(node_source(*def, *source), *def, diagnostics);
  }
}

// All at once, so that what outputs share is recorded once; where that goes wrong, halves of
// them, down to the one that is at fault.
void ShadingSystem::check_outputs(const Document& document, const ShaderOptions& options,
                                  Diagnostics& diagnostics) {
  std::vector<std::string> kernels;
  std::vector<std::string> parts;  // Of kernels: closures, shaders, texts.
  for (const FoundOutput& output : find_outputs(document)) {
    if (output.type == Type::material) continue;
    (has_kernel(output.type) ? kernels : parts).push_back(output.name);
  }
  Diagnostics known;
  const Definitions definitions(document, &library_->definitions(), known);
  for (const FoundOutput& shader : find_loose_shaders(document, definitions)) {
    parts.push_back(shader.name);
  }
  for (const std::vector<std::string>* names : {&kernels, &parts}) {
    std::vector<std::vector<std::string>> pending;
    if (!names->empty()) pending.push_back(*names);
    while (!pending.empty()) {
      const std::vector<std::string> some = std::move(pending.back());
      pending.pop_back();
      Diagnostics said;
      try_outputs(document, some, names == &kernels, options, said);
      if (!said.has_errors() || some.size() == 1 || options.compile.stop.is_due()) {
        append(said, diagnostics);
        continue;
      }
      const auto middle = some.begin() + static_cast<std::ptrdiff_t>(some.size() / 2);
      pending.emplace_back(middle, some.end());
      pending.emplace_back(some.begin(), middle);
    }
  }
}

void ShadingSystem::try_outputs(const Document& document, const std::vector<std::string>& names,
                                bool are_kernels, const ShaderOptions& options,
                                Diagnostics& diagnostics) {
  const auto graph = build(document, {.outputs = names, .material = {}}, options, diagnostics);
  if (!graph) return;
  Compilation compilation(options, *bodies_, *sources_, *textures_, service_.get(), diagnostics);
  if (!are_kernels) {
    compilation.record(*graph);
  } else if (const auto recorded = record_outputs(compilation, *graph, options, diagnostics)) {
    compilation.try_stages({compilation.entry("outputs", recorded->channels, Keeps::pass)});
  }
}

void ShadingSystem::check_material(const Document& document, const std::string& material,
                                   const ShaderOptions& options, Diagnostics& diagnostics) {
  Diagnostics said;
  const auto graph = build(document, {.outputs = {}, .material = material}, options, said);
  if (graph) {
    Compilation compilation(options, *bodies_, *sources_, *textures_, service_.get(), said);
    auto recorded =
        record_material(compilation, *graph, options, location_of(document, material), said);
    if (recorded) compilation.try_stages(std::move(recorded->programs));
  }
  append(said, diagnostics);
}

}  // namespace nacre
