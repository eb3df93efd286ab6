#include "examples/tool/check_lobes.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "jit/api/handles.h"
#include "jit/graph/find.h"

namespace nacre::tool {

namespace {

using Json = nlohmann::ordered_json;

/// For try_lobes(), which destroys it.
nacre_shader* public_handle(std::unique_ptr<MaterialKernels> kernels) {
  return new nacre_shader{std::make_shared<const api::ShaderData>(std::move(kernels))};
}

void print_table(const std::string& material, const char* side, const LobeFindings& findings) {
  if (findings.views.empty()) {
    fmt::print("{} ({}): no closure\n", material, side);
    return;
  }
  fmt::print("{} ({}): light that leaves, and what `albedo` says\n", material, side);
  fmt::print("  {:>7}  {:>23}  {:>23}  {:>7}  {:>11}\n", "degrees", "light", "albedo", "valid",
             "reciprocity");
  const auto colour = [](const std::array<double, 3>& rgb) {
    return fmt::format("{:7.4f} {:7.4f} {:7.4f}", rgb[0], rgb[1], rgb[2]);
  };
  for (const LobeView& view : findings.views) {
    fmt::print("  {:7.2f}  {}  {}  {:7.4f}  {:11.4g}\n", view.degrees, colour(view.light),
               colour(view.albedo), view.valid, view.reciprocity);
  }
}

Json to_json(const std::string& material, const char* side, const LobeFindings& findings) {
  Json views = Json::array(), faults = Json::array();
  for (const LobeView& view : findings.views) {
    views.push_back({{"degrees", view.degrees},
                     {"light", view.light},
                     {"albedo", view.albedo},
                     {"valid", view.valid},
                     {"reciprocity", view.reciprocity}});
  }
  for (const LobeFault& fault : findings.faults) {
    faults.push_back({{"law", fault.law},
                      {"found", fault.found},
                      {"expected", fault.expected},
                      {"text", fault.text}});
  }
  return {{"material", material}, {"side", side}, {"views", views}, {"faults", faults}};
}

}  // namespace

void check_lobes(const CommonOptions& options, const LobeCheck& check, const Opened& opened,
                 Diagnostics& diagnostics) {
  Json all = Json::array();
  const auto look_at = [&](const FoundMaterial& material, Side side) {
    const char* const name = side == Side::back ? "back" : "front";
    ShaderOptions asked = options.shader_options();
    asked.side = side;
    auto kernels =
        opened.system->compile_material(*opened.document, material.name, asked, diagnostics);
    if (kernels == nullptr) return false;
    const bool has_back = kernels->has_back;
    const bool has_closure = kernels->sample && kernels->evaluate && kernels->albedo;
    const LobeFindings findings =
        has_closure ? try_lobes(public_handle(std::move(kernels)), check.effort) : LobeFindings{};
    if (check.json) {
      all.push_back(to_json(material.name, name, findings));
    } else {
      print_table(material.name, name, findings);
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
  if (check.json) fmt::print("{}\n", all.dump(2));
}

}  // namespace nacre::tool
