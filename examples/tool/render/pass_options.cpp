#include "examples/tool/render/pass_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>

#include "jit/graph/look/geometry_names.h"
#include "runtime/channel/channel_name.h"
#include "runtime/near_names.h"

namespace nacre::tool {

namespace {

constexpr std::string_view environment_name = "environment";

/// NAME of NAME=PATTERNS, and the patterns.
std::pair<std::string, std::string_view> split_group(const std::string& text) {
  const std::size_t at = text.find('=');
  return {text.substr(0, at), std::string_view(text).substr(at + 1)};
}

bool is_layer_name(std::string_view name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

std::string check_group(const std::string& text) {
  const std::size_t at = text.find('=');
  if (at != std::string::npos && is_layer_name(text.substr(0, at)) && at + 1 < text.size()) {
    return {};
  }
  return "NAME=PATTERN[,PATTERN...] is expected, NAME of letters, digits and _";
}

bool matches_mesh(std::string_view pattern, const host::Mesh& mesh) {
  const auto is = [&](const std::string& name) {
    return !name.empty() && geom_matches(pattern, name);
  };
  return is(mesh.path) || is(mesh.object_name) || is(mesh.mesh_name) || is(mesh.material_name);
}

/// Puts what a pattern names into a group. False where that is nothing.
bool put(std::string_view pattern, std::uint8_t group, const host::Scene& scene,
         const std::vector<std::string>& lights, host::LightGroups& groups) {
  bool any = pattern == environment_name;
  if (any) groups.of_environment = group;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    if (!matches_mesh(pattern, scene.meshes[i])) continue;
    groups.of_mesh[i] = group;
    any = true;
  }
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (lights[i].empty() || !geom_matches(pattern, lights[i])) continue;
    groups.of_light[i] = group;
    any = true;
  }
  return any;
}

/// What a pattern could have named.
std::vector<std::string> names_of(const host::Scene& scene, std::vector<std::string> lights) {
  std::vector<std::string> names = std::move(lights);
  names.emplace_back(environment_name);
  for (const host::Mesh& mesh : scene.meshes) {
    for (const auto& name : {mesh.path, mesh.object_name, mesh.mesh_name, mesh.material_name}) {
      names.push_back(name);
    }
  }
  return names;
}

}  // namespace

void PassOptions::add(CLI::App& command) {
  command
      .add_option("--aov", names,
                  "Images beside the picture, layers of the .exr. Which there are stands below. "
                  "Light adds up: emission, background, direct and indirect are the picture")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAME,...");
  command
      .add_option("--light-group", groups,
                  "A layer light_NAME of what these lights give: object, mesh, material and light "
                  "names with * and ?, and environment; light_other is of the rest. Together they "
                  "are the picture")
      ->check(CLI::Validator(check_group, ""))
      ->allow_extra_args(false)
      ->type_name("NAME=PATTERN,...");
}

namespace {

std::vector<std::string> pass_names() {
  std::vector<std::string> names{"crypto_object", "crypto_material"};
  for (const host::Pass& pass : host::known_passes()) names.emplace_back(pass.name);
  return names;
}

}  // namespace

host::PassRequest pass_request(const PassOptions& options, Diagnostics& diagnostics) {
  host::PassRequest request;
  const auto has = [&](std::string_view name) {
    return std::ranges::any_of(request.passes, [&](auto& pass) { return pass.name == name; });
  };
  for (const std::string& name : options.names) {
    if (name == "crypto_object") {
      request.object_mattes = true;
    } else if (name == "crypto_material") {
      request.material_mattes = true;
    } else if (const auto pass = host::find_pass(name)) {
      if (!has(pass->name)) request.passes.push_back(*pass);
    } else if (name.find('/') != std::string::npos) {
      const bool known =
          std::ranges::any_of(request.values, [&](auto& value) { return value.name == name; });
      if (!known) request.values.push_back({name, 0});
    } else {
      diagnostics.error("unknown-aov", {}, "there is no such pass",
                        "one of those that nacre render --help-all lists, or GRAPH/NODE of a value",
                        "'" + name + "'", near_hint(diagnostics, name, pass_names()));
    }
  }
  for (const std::string& group : options.groups) {
    request.groups.names.push_back(split_group(group).first);
  }
  if (request.groups.names.size() > host::LightGroups::most) {
    diagnostics.error("too-many-groups", {}, "too many light groups",
                      fmt::format("at most {}", host::LightGroups::most),
                      fmt::format("{}", request.groups.names.size()));
  }
  return request;
}

void ask_for_passes(const host::PassRequest& passes, KernelRequest& request) {
  request.by_lobe = passes.any(host::PassNeed::split);
  for (const char* name : {"albedo", "normal", "roughness"}) {
    const bool asked =
        std::ranges::any_of(passes.passes, [&](auto& pass) { return pass.name == name; });
    if (asked) request.with_begin.emplace_back(name);
  }
  for (const host::GraphValue& value : passes.values) request.with_begin.push_back(value.name);
}

void look_for_values(const MaterialKernels& kernels, host::PassRequest& passes,
                     Diagnostics& diagnostics) {
  if (!kernels.begin) return;
  for (host::GraphValue& value : passes.values) {
    if (value.components != 0) continue;
    for (const Channel& output : kernels.begin->program().outputs) {
      value.components += parse_channel(output.name).group == value.name;
    }
    if (value.components > 4) {
      diagnostics.error("wide-aov", {}, "the value has more numbers than a layer of an image",
                        "at most 4", fmt::format("{} of '{}'", value.components, value.name));
    }
  }
}

void complete_values(host::PassRequest& passes, Diagnostics& diagnostics) {
  std::size_t first = 0;
  for (const host::GraphValue& value : passes.values) {
    if (value.components == 0) {
      diagnostics.error("unknown-aov", {}, "no material of the scene has this value",
                        "a material on a mesh", "'" + value.name + "'");
      return;
    }
    passes.passes.push_back(host::value_pass(value, first));
    first += static_cast<std::size_t>(value.components);
  }
}

void complete_groups(const PassOptions& options, const host::Scene& scene,
                     const std::vector<std::string>& lights, host::PassRequest& passes,
                     Diagnostics& diagnostics) {
  host::LightGroups& groups = passes.groups;
  groups.of_mesh.assign(scene.meshes.size(), groups.rest());
  groups.of_light.assign(lights.size(), groups.rest());
  groups.of_environment = groups.rest();
  if (groups.names.empty()) return;
  for (std::size_t k = 0; k < options.groups.size(); ++k) {
    for (const std::string_view pattern : split_geom_list(split_group(options.groups[k]).second)) {
      if (put(pattern, static_cast<std::uint8_t>(k), scene, lights, groups)) continue;
      diagnostics.error("unmatched-light", {}, "--light-group names nothing of the scene",
                        "an object, mesh, material or light, or environment",
                        fmt::format("'{}' of '{}'", pattern, groups.names[k]),
                        near_hint(diagnostics, pattern, names_of(scene, lights)));
    }
  }
  for (std::size_t k = 0; k <= groups.names.size(); ++k) {
    passes.passes.push_back(host::group_pass(groups, k));
  }
}

std::string pass_help() {
  std::string text = "Passes, by name or light path expression (--aov):\n";
  for (const host::Pass& pass : host::known_passes()) {
    text += fmt::format("  {:<22}{:<26}{}\n", pass.name, pass.path_expression, pass.about);
  }
  text +=
      "  crypto_object, crypto_material                  Cryptomatte 1.2, six names a pixel\n"
      "  GRAPH/NODE                                      a value of the graph, or input of a node\n"
      "direct and indirect passes are by what light last left before the camera; albedo, normal "
      "and what follows are of the first surface that does not let the ray through.";
  return text;
}

}  // namespace nacre::tool
