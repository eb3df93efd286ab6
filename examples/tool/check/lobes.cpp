#include "examples/tool/check/lobes.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "examples/tool/check/lobe_kernels.h"
#include "examples/tool/check/lobe_nodes.h"
#include "examples/tool/check/lobe_report.h"
#include "jit/graph/find.h"

namespace nacre::tool {

namespace {

using Json = nlohmann::ordered_json;

void check_materials(const CommonOptions& options, const LobeCheck& check, const Opened& opened,
                     Json& all, Diagnostics& diagnostics) {
  const auto look_at = [&](const FoundMaterial& material, Side side) {
    const char* const name = side == Side::back ? "back" : "front";
    ShaderOptions asked = options.shader_options();
    asked.side = side;
    asked.holds_lobes = false;
    auto kernels =
        opened.system->compile_material(*opened.document, material.name, asked, diagnostics);
    if (kernels == nullptr) return false;
    const bool has_back = kernels->has_back;
    const LobeFindings findings = try_lobes(std::move(kernels), check.effort);
    if (check.json) {
      Json one{{"material", material.name}, {"side", name}};
      one.update(to_json(findings));
      all.push_back(std::move(one));
    } else {
      print_views(fmt::format("{} ({})", material.name, name), findings);
    }
    for (const LobeFault& fault : findings.faults) {
      diagnostics.error("lobe-" + fault.law, material.where,
                        fmt::format("the closure breaks a law ({}): {}", name, fault.text));
    }
    return has_back;
  };
  for (const FoundMaterial& material : find_materials(*opened.document)) {
    if (look_at(material, Side::front)) look_at(material, Side::back);
  }
}

}  // namespace

void check_lobes(const CommonOptions& options, const LobeCheck& check, const Opened& opened,
                 Json& found, Diagnostics& diagnostics) {
  if (!check.nodes.empty()) check_lobe_nodes(options, check, opened, found, diagnostics);
  if (check.materials) check_materials(options, check, opened, found, diagnostics);
}

}  // namespace nacre::tool
