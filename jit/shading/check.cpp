#include "jit/shading/check.h"

#include <set>
#include <tuple>
#include <utility>

#include "jit/graph/check/check.h"
#include "jit/graph/find.h"
#include "jit/graph/resolve/node_text.h"
#include "jit/shading/compilation.h"

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

/// What compiling would say, without machine code.
class ShadingCheck {
 public:
  ShadingCheck(const Document& document, const SystemParts& parts, const ShaderOptions& options)
      : document_(document), parts_(parts), options_(options) {}

  void run(Diagnostics& diagnostics) {
    Diagnostics found;
    if (check_document(document_, *parts_.library, parts_.graph_options(options_), found)) {
      check_sources(found);
      check_outputs(found);
      for (const std::string& material : names_of_materials(document_)) {
        if (options_.compile.stop.is_due() && found.has_errors()) break;
        check_material(material, found);
      }
    }
    add_once(found, diagnostics);
  }

 private:
  void check_sources(Diagnostics& diagnostics) {
    Diagnostics known;
    const Definitions definitions(document_, &parts_.library->definitions(), known);
    for (const NodeDef* def : definitions.all()) {
      const Element* source = definitions.text_of(*def);
      if (source == nullptr || &source->document() != &document_ || !may_be_text(*def)) continue;
      parts_.texts->check(node_text(*def, *source), *def, diagnostics);
    }
  }

  // All at once, so that what outputs share is recorded once; where that goes wrong, halves of
  // them, down to the one that is at fault.
  void check_outputs(Diagnostics& diagnostics) {
    std::vector<std::string> kernels;
    std::vector<std::string> parts;  // Of kernels: closures, shaders, texts.
    for (const FoundOutput& output : find_outputs(document_)) {
      if (output.type == Type::material) continue;
      (has_kernel(output.type) ? kernels : parts).push_back(output.name);
    }
    Diagnostics known;
    const Definitions definitions(document_, &parts_.library->definitions(), known);
    for (const FoundOutput& shader : find_loose_shaders(document_, definitions)) {
      parts.push_back(shader.name);
    }
    for (const std::vector<std::string>* names : {&kernels, &parts}) {
      std::vector<std::vector<std::string>> pending;
      if (!names->empty()) pending.push_back(*names);
      while (!pending.empty()) {
        const std::vector<std::string> some = std::move(pending.back());
        pending.pop_back();
        Diagnostics said;
        try_outputs(some, names == &kernels, said);
        if (!said.has_errors() || some.size() == 1 || options_.compile.stop.is_due()) {
          append(said, diagnostics);
          continue;
        }
        const auto middle = some.begin() + static_cast<std::ptrdiff_t>(some.size() / 2);
        pending.emplace_back(middle, some.end());
        pending.emplace_back(some.begin(), middle);
      }
    }
  }

  void try_outputs(const std::vector<std::string>& names, bool are_kernels,
                   Diagnostics& diagnostics) {
    Compilation compilation(parts_, options_, diagnostics);
    const auto graph = compilation.build(document_, {.outputs = names, .material = {}});
    if (!graph) return;
    if (!are_kernels) {
      compilation.record(*graph);
    } else if (auto recorded = compilation.record_outputs(*graph)) {
      compilation.try_stages(std::move(recorded->programs));
    }
  }

  void check_material(const std::string& material, Diagnostics& diagnostics) {
    Diagnostics said;
    Compilation compilation(parts_, options_, said);
    const auto graph = compilation.build(document_, {.outputs = {}, .material = material});
    if (graph) {
      auto recorded = compilation.record_material(*graph, location_of(document_, material));
      if (recorded) compilation.try_stages(std::move(recorded->programs));
    }
    append(said, diagnostics);
  }

  const Document& document_;
  const SystemParts& parts_;
  const ShaderOptions& options_;
};

}  // namespace

void check_shading(const Document& document, const SystemParts& parts, const ShaderOptions& options,
                   Diagnostics& diagnostics) {
  ShadingCheck(document, parts, options).run(diagnostics);
}

}  // namespace nacre
