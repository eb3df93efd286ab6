#include "examples/tool/check/lobe_nodes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "examples/tool/check/lobe_inputs.h"
#include "examples/tool/check/lobe_kernels.h"
#include "examples/tool/check/lobe_report.h"
#include "jit/document/definitions.h"
#include "jit/document/document.h"
#include "jit/document/write.h"
#include "runtime/near_names.h"

namespace nacre::tool {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Inputs = std::vector<LobeInput>;

constexpr const char* material_name = "nacre_check_lobe";

/// A material of that lobe alone. It includes the document, which may declare the node.
std::string material_of(const NodeDef& def, const Inputs& inputs, const std::string& file) {
  std::string values;
  for (const LobeInput& input : inputs) {
    values += fmt::format(R"(<input name="{}" type="{}" value="{}"/>)", xml_text(input.name),
                          xml_text(input.type), xml_text(input.value));
  }
  return fmt::format(
      R"(<materialx version="1.39"><xi:include href="{0}"/>
<{1} name="{2}_b" type="BSDF" nodedef="{3}">{4}</{1}>
<surface name="{2}_s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="{2}_b"/></surface>
<surfacematerial name="{2}" type="material">
<input name="surfaceshader" type="surfaceshader" nodename="{2}_s"/></surfacematerial></materialx>)",
      xml_text(file), def.category, material_name, xml_text(def.name), values);
}

class LobeNodes {
 public:
  LobeNodes(const CommonOptions& options, const LobeCheck& check, const Opened& opened,
            Diagnostics& diagnostics)
      : options_(options), check_(check), opened_(opened), diagnostics_(diagnostics) {}

  /// All that is found of one lobe; nothing, with diagnostics, where it cannot be compiled.
  void run(const NodeDef& def, Json& all) {
    const std::vector<Inputs> sets = lobe_inputs(def, check_.sets);
    std::vector<LobeFindings> found;
    for (const Inputs& inputs : sets) {
      auto findings = try_set(def, inputs, found.empty());
      if (!findings) return;
      found.push_back(std::move(*findings));
    }
    const std::vector<LawResult> laws = try_laws(found);
    for (const LawResult& law : laws) {
      if (law.state != LawResult::State::broken) continue;
      diagnostics_.error(
          "lobe-" + law.law, location(*def.element),
          fmt::format("the lobe breaks a law ({}): {}", to_string(sets[law.set]), law.figure));
    }
    if (check_.json) {
      all.push_back(to_json(def, sets, found, laws));
      return;
    }
    for (std::size_t i = 0; i < sets.size(); ++i) {
      print_views(fmt::format("{}, set {}: {}", def.name, i + 1, to_string(sets[i])), found[i]);
    }
    print_laws(std::string(def.name), found, laws);
    const std::vector<std::string> fixed = inputs_without_range(def);
    if (!fixed.empty()) {
      fmt::print("  without uimin and uimax, by default: {}\n", fmt::join(fixed, ", "));
    }
  }

 private:
  std::optional<LobeFindings> try_set(const NodeDef& def, const Inputs& inputs, bool is_first) {
    const fs::path file(options_.file);
    const std::string text = material_of(def, inputs, file.filename().string());
    const std::string name = (file.parent_path() / "nacre check --lobe").string();
    Diagnostics said;
    ShaderOptions asked = options_.shader_options();
    asked.holds_lobes = false;
    const auto document = read_document_text(text, name, options_.read_options(), said);
    auto kernels = document == nullptr
                       ? nullptr
                       : opened_.system->compile_material(*document, material_name, asked, said);
    // What is said of all sets is said once.
    if (is_first || kernels == nullptr) {
      for (const Diagnostic& one : said.all()) diagnostics_.add(one);
    }
    if (kernels == nullptr) return std::nullopt;
    return try_lobes(std::move(kernels), check_.effort);
  }

  static Json to_json(const NodeDef& def, const std::vector<Inputs>& sets,
                      const std::vector<LobeFindings>& found, const std::vector<LawResult>& laws) {
    Json all_sets = Json::array(), all_laws = Json::array();
    for (std::size_t i = 0; i < sets.size(); ++i) {
      Json inputs = Json::object();
      for (const LobeInput& input : sets[i]) inputs[input.name] = input.value;
      Json set = tool::to_json(found[i]);
      set["inputs"] = inputs;
      all_sets.push_back(std::move(set));
    }
    constexpr const char* names[] = {"holds", "broken", "not tried"};
    for (const LawResult& law : laws) {
      all_laws.push_back({{"law", law.law},
                          {"state", names[static_cast<std::size_t>(law.state)]},
                          {"figure", law.figure}});
    }
    return {{"lobe", def.name}, {"laws", all_laws}, {"sets", all_sets}};
  }

  const CommonOptions& options_;
  const LobeCheck& check_;
  const Opened& opened_;
  Diagnostics& diagnostics_;
};

bool makes_lobe(const NodeDef& def) {
  return def.outputs.size() == 1 && def.outputs.front().type == Type::bsdf;
}

/// Nodes that are lobes, and their nodedefs.
std::vector<std::string_view> known_lobes(const Definitions& definitions) {
  std::vector<std::string_view> names;
  for (const NodeDef* def : definitions.all()) {
    if (!makes_lobe(*def)) continue;
    names.insert(names.end(), {def->category, def->name});
  }
  return names;
}

}  // namespace

void check_lobe_nodes(const CommonOptions& options, const LobeCheck& check, const Opened& opened,
                      Json& all, Diagnostics& diagnostics) {
  Diagnostics known;
  const Definitions definitions(*opened.document, &opened.system->library().definitions(), known);
  LobeNodes nodes(options, check, opened, diagnostics);
  for (const std::string& name : check.nodes) {
    bool is_known = false;
    for (const NodeDef* def : definitions.all()) {
      if (!makes_lobe(*def) || (def->name != name && def->category != name)) continue;
      is_known = true;
      nodes.run(*def, all);
    }
    if (is_known) continue;
    diagnostics.error("no-such-lobe", {}, "there is no lobe of this name",
                      "a node, or its nodedef, whose output is a BSDF", "'" + name + "'",
                      near_hint(diagnostics, name, known_lobes(definitions)));
  }
}

}  // namespace nacre::tool
