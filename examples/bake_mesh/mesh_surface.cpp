#include "examples/bake_mesh/mesh_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "examples/bake_mesh/curvature.h"
#include "examples/bake_mesh/mesh_points.h"
#include "examples/render/batch_channels.h"
#include "runtime/channel/channel_name.h"
#include "runtime/near_names.h"

namespace nacre::host {

namespace {

constexpr auto transport_properties =
    std::to_array<std::string_view>({"ambientocclusion", "bentnormal", "curvature", "thickness"});

bool is_called(const Mesh& mesh, const std::string& name) {
  return name == mesh.object_name || name == mesh.mesh_name || name == mesh.path;
}

bool reads(const Program& program, std::string_view property) {
  return std::ranges::any_of(program.inputs, [&](const Channel& channel) {
    const ChannelName name = parse_channel(channel.name);
    return name.component >= 0 && name.group.starts_with("geomprop.") &&
           name.group.substr(9) == property;
  });
}

}  // namespace

bool is_transport_property(std::string_view name) {
  return std::ranges::find(transport_properties, name) != transport_properties.end();
}

MeshSurface::MeshSurface(Scene scene, MeshRequest request)
    : scene_(std::move(scene)), request_(std::move(request)) {}

MeshSurface::~MeshSurface() = default;

std::unique_ptr<MeshSurface> MeshSurface::make(Scene scene, MeshRequest request,
                                               Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  std::unique_ptr<MeshSurface> surface(new MeshSurface(std::move(scene), std::move(request)));
  if (!surface->choose(diagnostics)) return nullptr;
  surface->layout_ =
      std::make_unique<UvLayout>(surface->scene_, surface->meshes_, surface->request_.uv_set,
                                 surface->request_.file, diagnostics);
  return diagnostics.error_count() == errors ? std::move(surface) : nullptr;
}

bool MeshSurface::choose(Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  const SourceLocation where{request_.file, 0, 0, {}};
  const auto is_wanted = [&](const Mesh& mesh) {
    return request_.meshes.empty() ||
           std::ranges::any_of(request_.meshes,
                               [&](const std::string& name) { return is_called(mesh, name); });
  };
  for (const std::string& name : request_.meshes) {
    const bool is_there =
        std::ranges::any_of(scene_.meshes, [&](const Mesh& mesh) { return is_called(mesh, name); });
    if (is_there) continue;
    std::set<std::string> names;
    for (const Mesh& mesh : scene_.meshes) names.insert(mesh.object_name);
    std::string known;
    for (const std::string& each : names) {
      if (known.size() < 200) known += (known.empty() ? "" : ", ") + each;
    }
    diagnostics.error("unknown-mesh", where, "the scene has no such mesh", known,
                      fmt::format("'{}'", name), near_hint(diagnostics, name, names));
  }
  for (std::uint32_t i = 0; i < scene_.meshes.size(); ++i) {
    const Mesh& mesh = scene_.meshes[i];
    if (!is_wanted(mesh)) continue;
    const SourceLocation here{request_.file, 0, 0, mesh.object_name};
    if (mesh.is_fibres()) {
      diagnostics.warning("not-baked", here, "fibres have no map and are not baked", "triangles");
      continue;
    }
    if (mesh.instances.size() > 1) {
      diagnostics.warning("several-places", here,
                          fmt::format("the mesh is drawn {} times and baked where it is first",
                                      mesh.instances.size()),
                          "one place");
    }
    meshes_.push_back(i);
  }
  if (meshes_.empty() && diagnostics.error_count() == errors) {
    diagnostics.error("nothing-to-bake", where, "the scene has no mesh to bake on",
                      "a mesh of triangles");
  }
  return diagnostics.error_count() == errors;
}

std::vector<std::string> MeshSurface::varying() const {
  std::set<std::string> names;
  for (const std::uint32_t m : meshes_) {
    for (const Primvar& primvar : scene_.meshes[m].primvars) names.insert(primvar.name);
  }
  names.insert(transport_properties.begin(), transport_properties.end());
  std::vector<std::string> slots = {"object_to_world", "world_to_object"};
  for (const std::string& name : names) slots.push_back("geomprop." + name);
  return slots;
}

bool MeshSurface::has_property(std::string_view name) const {
  return is_transport_property(name) || std::ranges::any_of(meshes_, [&](std::uint32_t m) {
           const auto& primvars = scene_.meshes[m].primvars;
           return std::ranges::find(primvars, name, &Primvar::name) != primvars.end();
         });
}

bool MeshSurface::has_uv_set(int number) const {
  return std::ranges::all_of(meshes_, [&](std::uint32_t m) {
    const Mesh& mesh = scene_.meshes[m];
    if (number == 0) return !mesh.uv.empty();
    return std::ranges::find(mesh.primvars, fmt::format("texcoord{}", number), &Primvar::name) !=
           mesh.primvars.end();
  });
}

std::vector<UvTile> MeshSurface::tiles(Diagnostics& diagnostics) const {
  const SourceLocation where{request_.file, 0, 0, {}};
  std::size_t outside = 0;
  std::vector<UvTile> all = layout_->tiles(outside);
  if (all.empty()) {
    diagnostics.error("no-udim", where, "no triangle is in a tile of a UDIM set",
                      "u from 0 to 10 and v from 0 to 900");
  } else if (all.size() > most_tiles) {
    diagnostics.error(
        "too-many-tiles", where, "triangles reach over more tiles than sets have",
        fmt::format("at most {}, or those that are meant (--udim 1001,...)", most_tiles),
        std::to_string(all.size()));
    all.clear();
  } else if (outside > 0) {
    diagnostics.warning("outside-map", where,
                        fmt::format("{} of {} triangles reach out of all tiles that there are",
                                    outside, layout_->pieces().size()),
                        "u from 0 to 10 and v from 0 to 900");
  }
  return all;
}

bool MeshSurface::prepare(const Program& program, Diagnostics& diagnostics) {
  if (bvh_ == nullptr && (reads(program, "ambientocclusion") || reads(program, "bentnormal") ||
                          reads(program, "thickness"))) {
    bvh_ = std::make_unique<Bvh>(scene_, diagnostics);
    if (!bvh_->ok()) return false;
  }
  if (!curvature_.empty() || !reads(program, "curvature")) return true;
  curvature_.resize(scene_.meshes.size());
  for (const std::uint32_t m : meshes_) {
    const Mesh& mesh = scene_.meshes[m];
    curvature_[m] =
        mean_curvature(mesh, mesh.instances.empty() ? Affine{} : mesh.instances[0].at(0.f));
  }
  return true;
}

bool MeshSurface::lay_out(const MapFrame& frame, Diagnostics& diagnostics) {
  for (const auto& [map, is_right] : known_) {
    if (map == frame) return is_right;
  }
  known_.emplace_back(frame, look_at(frame, diagnostics));
  return known_.back().second;
}

bool MeshSurface::look_at(const MapFrame& frame, Diagnostics& diagnostics) const {
  const SourceLocation where{request_.file, 0, 0, {}};
  const auto rows = rows_of(frame);
  if (rows->depth() == 0.0) {
    diagnostics.error("nothing-to-bake", where,
                      fmt::format("no triangle is in the map of u from {} to {}, v from {} to {}",
                                  frame.tile.u, frame.tile.u + 1, frame.tile.v, frame.tile.v + 1),
                      "another --udim, or auto");
    return false;
  }
  if (rows->depth() > most_depth) {
    diagnostics.error("too-many-overlaps", where,
                      "triangles lie over each other in uv as in no map",
                      fmt::format("at most {:g} times the map's area", most_depth),
                      fmt::format("{:.3g} times", rows->depth()));
    return false;
  }
  std::string pairs;
  std::size_t texels = 0;
  for (const Overlap& overlap : find_overlaps(*rows)) {
    texels += overlap.texels;
    if (pairs.size() > 300) continue;
    const std::string one = layout_->name_of(overlap.mesh), other = layout_->name_of(overlap.other);
    pairs +=
        fmt::format("{}{} {}: {}", pairs.empty() ? "" : ", ", one,
                    overlap.mesh == overlap.other ? "on itself" : "and " + other, overlap.texels);
  }
  if (texels == 0) return true;
  diagnostics.warning(
      "overlaps", where,
      fmt::format("{} texels of the {} x {} map have more than one triangle: the first one in the "
                  "file is baked",
                  texels, frame.width, frame.height),
      "islands apart from each other in uv", pairs);
  return true;
}

std::shared_ptr<const RowIndex> MeshSurface::rows_of(const MapFrame& frame) const {
  const std::lock_guard guard(mutex_);
  if (rows_ == nullptr || rows_->frame() != frame) {
    rows_ = std::make_shared<const RowIndex>(*layout_, frame);
  }
  return rows_;
}

std::unique_ptr<SurfacePoints> MeshSurface::points(const BakeSettings& settings,
                                                   const Program& program) const {
  return std::make_unique<MeshPoints>(
      *this, rows_of({settings.width, settings.height, {settings.corner_u, settings.corner_v}}),
      program, settings.in_frame);
}

}  // namespace nacre::host
