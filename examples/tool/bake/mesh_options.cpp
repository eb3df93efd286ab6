#include "examples/tool/bake/mesh_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>

#include "examples/render/builtin_scene.h"
#include "examples/render/load_scene.h"
#include "examples/tool/number_range.h"
#include "examples/tool/scene/digest.h"
#include "examples/tool/scene/limit_options.h"

namespace nacre::tool {

void MeshOptions::add(CLI::App& command) {
  CLI::Option* file =
      command
          .add_option("--scene", scene,
                      "Bake on the meshes of a scene by their uv: glTF 2.0 or OBJ, or builtin for "
                      "the one that render shows (default: on a plane)")
          ->type_name("FILE");
  const auto add = [&](const char* flag, auto& value, const char* what) {
    return command.add_option(flag, value, what)->needs(file)->group("Baking on meshes, --scene");
  };
  add("--mesh", meshes,
      "A mesh: the object's, the mesh's own or the path's name; may be repeated (default: all)")
      ->type_name("NAME");
  add("--uv-set", uv_set, "The set of texture coordinates that says where texels are")
      ->check(CLI::Range(0, 9))
      ->capture_default_str()
      ->type_name("N");
  add("--dilate", dilate,
      "What texels beside islands get: N of them the value of the next texel of an island, and "
      "those beyond 0; or all: 4, and the rest means of larger and larger squares, so that mip "
      "levels are made of islands alone")
      ->capture_default_str()
      ->type_name("N|all");
  add("--view", view,
      "Who looks, where a graph asks: none, which is an error, or normal: from along the normal")
      ->check(CLI::IsMember({"none", "normal"}))
      ->capture_default_str();
  add("--rays", transport.rays,
      "Rays from each sample for ambientocclusion, bentnormal and thickness; --samples auto takes "
      "their noise for detail")
      ->check(number_within(1, 1 << 20))
      ->capture_default_str()
      ->type_name("N");
  add("--distance", transport.distance,
      "What is as far is not met by them, in units of the scene (default: all is)")
      ->check(number_within(0, host::largest_coordinate))
      ->default_str("")
      ->type_name("D");
  add_scene_limits(command, limits);
}

bool MeshOptions::read(host::Dilation& dilation, Diagnostics& diagnostics) const {
  dilation = {};
  if (dilate == "all") return true;
  dilation.fills = false;
  const char* end = dilate.data() + dilate.size();
  const auto [last, problem] = std::from_chars(dilate.data(), end, dilation.texels);
  if (problem == std::errc{} && last == end && dilation.texels >= 0 &&
      dilation.texels <= most_dilation) {
    return true;
  }
  diagnostics.error("bad-option", {}, "--dilate cannot be understood",
                    fmt::format("0 to {}, or all", most_dilation), dilate);
  return false;
}

std::unique_ptr<host::MeshSurface> MeshOptions::open(float time, Diagnostics& diagnostics) const {
  if (scene.empty()) return nullptr;
  const std::size_t errors = diagnostics.error_count();
  const auto moment = static_cast<double>(time);
  host::Scene loaded = scene == "builtin"
                           ? host::make_builtin_scene()
                           : host::load_scene(scene, limits, diagnostics, {moment, moment});
  if (diagnostics.error_count() != errors) return nullptr;
  // A lamp's shape is no part of what is lit.
  std::erase_if(loaded.meshes, [](const host::Mesh& m) { return m.light_radiance.has_value(); });
  return host::MeshSurface::make(
      std::move(loaded),
      {.file = scene, .meshes = meshes, .uv_set = uv_set, .transport = transport}, diagnostics);
}

void MeshOptions::describe(const host::MeshSurface& surface, BakeManifest& manifest) const {
  manifest.inputs["scene"] = digest_of(surface.scene());
  std::string names;
  for (const std::string& name : meshes) names += (names.empty() ? "" : ", ") + name;
  manifest.options["mesh"] = names;
  manifest.options["uv-set"] = fmt::format("{}", uv_set);
  manifest.options["dilate"] = dilate;
  manifest.options["view"] = view;
  manifest.options["rays"] = fmt::format("{}", transport.rays);
  manifest.options["distance"] = fmt::format("{}", transport.distance);
}

std::vector<UdimTile> read_tiles(std::string_view text, const host::MeshSurface& surface,
                                 const std::string& scene, Diagnostics& diagnostics) {
  const SourceLocation where{scene, 0, 0, {}};
  if (text.empty()) {
    const std::size_t outside = surface.outside({});
    if (outside > 0) {
      diagnostics.warning(
          "udim-not-baked", where,
          fmt::format("{} triangles reach out of u and v from 0 to 1, which is what is baked",
                      outside),
          "--udim auto");
    }
    return {};
  }
  std::vector<UdimTile> there;
  Diagnostics said;
  for (const host::UvTile& tile : surface.tiles(said)) there.push_back({tile.u, tile.v});
  if (text == "auto") {
    for (const Diagnostic& each : said.all()) diagnostics.add(each);
    return there;
  }
  const std::vector<UdimTile> wanted = parse_tiles(text, {scene, 0, 0, "--udim"}, diagnostics);
  std::string missing;
  for (const UdimTile& tile : there) {
    if (std::ranges::find(wanted, tile) != wanted.end() || missing.size() > 200) continue;
    missing += (missing.empty() ? "" : ",") + tile.number();
  }
  if (!wanted.empty() && !missing.empty()) {
    diagnostics.warning("udim-not-baked", where, "the meshes have tiles that are not baked",
                        "--udim auto", missing);
  }
  return wanted;
}

}  // namespace nacre::tool
