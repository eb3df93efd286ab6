#include "examples/bake_mesh/mesh_points.h"

#include <algorithm>
#include <bit>

#include "runtime/channel/channel_name.h"

namespace nacre::host {

namespace {

float component_of(Vec3 v, int i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }

/// The number of a set, of the group "uv1" say; nothing for others.
std::optional<int> uv_number(std::string_view group) {
  if (!group.starts_with("uv") || group.size() != 3) return {};
  const int number = group[2] - '0';
  return number >= 0 && number <= 9 ? std::optional(number) : std::nullopt;
}

/// By the texel and where in it the point is; `pixel` of a SampleKey, which hashes it.
std::uint32_t seed_of(std::size_t texel, float x, float y) {
  const auto mixed = static_cast<std::uint32_t>(texel) * 0x9e3779b9u;
  return mixed ^ std::bit_cast<std::uint32_t>(x) * 0x85ebca6bu ^
         std::rotl(std::bit_cast<std::uint32_t>(y), 16) * 0xc2b2ae35u;
}

constexpr std::string_view property_prefix = "geomprop.";

}  // namespace

MeshPoints::MeshPoints(const MeshSurface& surface, std::shared_ptr<const RowIndex> rows,
                       const Program& program, bool in_frame)
    : surface_(surface),
      rows_(std::move(rows)),
      cover_(*rows_),
      geometry_(surface.scene_),
      camera_({}, 1, 1, 1.f) {
  if (in_frame) needs_.attributes |= attribute_tangents;
  for (const Channel& channel : program.inputs) {
    if (!fillers_.contains(channel.name)) fillers_[channel.name] = filler_of(channel.name);
  }
}

MeshPoints::Filler MeshPoints::filler_of(const std::string& channel) {
  const auto [group, i] = parse_channel(channel);
  if (const auto derivative = parse_derivative(group)) {
    return derivative_of(derivative->group, i, derivative->axis);
  }
  if (group.starts_with(property_prefix)) {
    const std::string_view property = group.substr(property_prefix.size());
    if (!has_attribute(property) && is_transport_property(property)) {
      return transport_of(property, i);
    }
    if (i < 0) {  // Whether the point's mesh has it.
      const int index = request_primvar(property, 1, needs_);
      return [this, index](float, std::vector<float>& values) {
        const std::int32_t* present = buffer_->batch.primvars[index].present;
        values.assign(present, present + points_.size());
      };
    }
  }
  // Of viewers there is one who looks along the normal, or none.
  const std::string name = group == "wo" ? channel_text("N", i) : channel;
  const BatchSource source = batch_channel(name, needs_);
  return [this, source](float, std::vector<float>& values) {
    const auto* lane = source ? static_cast<const float*>(source(buffer_->batch)) : nullptr;
    if (lane == nullptr) return values.assign(points_.size(), 0.f);
    values.assign(lane, lane + points_.size());
  };
}

/// From one texel to the next to the right, or below.
MeshPoints::Filler MeshPoints::derivative_of(std::string_view group, int component, int axis) {
  const auto of_each = [this, axis](const auto& change_of) {
    return [this, axis, change_of](float footprint, std::vector<float>& values) {
      const std::vector<FlatWeights>& changes = axis == 0 ? along_x_ : along_y_;
      values.resize(points_.size());
      for (std::size_t i = 0; i < points_.size(); ++i) {
        values[i] = footprint * change_of(points_[i], changes[i]);
      }
    };
  };
  if (const auto number = uv_number(group)) {
    std::vector<std::vector<Vec2>> sets(surface_.scene_.meshes.size());
    for (const std::uint32_t m : surface_.meshes_) {
      sets[m] = uv_set_of(surface_.scene_.meshes[m], *number);
    }
    return of_each([this, sets, component](const SurfacePoint& p, FlatWeights change) {
      if (sets[p.mesh].empty()) return 0.f;
      const std::uint32_t* v = surface_.scene_.meshes[p.mesh].triangles[p.triangle].v;
      const auto at = [&](std::uint32_t corner) {
        const Vec2 uv = sets[p.mesh][corner];
        return static_cast<double>(component == 0 ? uv.x : uv.y);
      };
      return static_cast<float>((at(v[1]) - at(v[0])) * change.b1 +
                                (at(v[2]) - at(v[0])) * change.b2);
    });
  }
  const bool in_object = group == "Po" || group == "Pm";
  if (group != "P" && !in_object) {
    return [this](float, std::vector<float>& values) { values.assign(points_.size(), 0.f); };
  }
  return of_each([this, in_object, component](const SurfacePoint& p, FlatWeights change) {
    return component_of(position_change(p, change, in_object), component);
  });
}

Vec3 MeshPoints::position_change(const SurfacePoint& point, FlatWeights change,
                                 bool in_object) const {
  const Mesh& mesh = surface_.scene_.meshes[point.mesh];
  const std::uint32_t* v = mesh.triangles[point.triangle].v;
  const bool has_own = in_object && !mesh.position_object.empty();
  const std::vector<Vec3>& position = has_own ? mesh.position_object : mesh.position;
  const auto b1 = static_cast<float>(change.b1), b2 = static_cast<float>(change.b2);
  const Vec3 moved =
      b1 * (position[v[1]] - position[v[0]]) + b2 * (position[v[2]] - position[v[0]]);
  if (in_object || mesh.instances.empty()) return moved;
  return transform_vector(mesh.instances[0].at(0.f), moved);
}

bool MeshPoints::has_attribute(std::string_view property) const {
  return std::ranges::any_of(surface_.meshes_, [&](std::uint32_t m) {
    const auto& primvars = surface_.scene_.meshes[m].primvars;
    return std::ranges::find(primvars, property, &Primvar::name) != primvars.end();
  });
}

MeshPoints::Filler MeshPoints::transport_of(std::string_view property, int component) {
  if (component < 0) {
    return [this](float, std::vector<float>& values) { values.assign(points_.size(), 1.f); };
  }
  if (property == "curvature") {
    return [this, component](float, std::vector<float>& values) {
      values.resize(points_.size());
      for (std::size_t i = 0; i < points_.size(); ++i) {
        const SurfacePoint& p = points_[i];
        const std::vector<float>& of_vertex = surface_.curvature_[p.mesh];
        const std::uint32_t* v = surface_.scene_.meshes[p.mesh].triangles[p.triangle].v;
        values[i] = component > 0 ? 0.f
                                  : (1.f - p.u - p.v) * of_vertex[v[0]] + p.u * of_vertex[v[1]] +
                                        p.v * of_vertex[v[2]];
      }
    };
  }
  if (property == "thickness") {
    wants_thickness_ = true;
    return [this, component](float, std::vector<float>& values) {
      values.assign(points_.size(), 0.f);
      if (component == 0) values = thickness_;
    };
  }
  wants_openness_ = true;
  const bool is_direction = property == "bentnormal";
  return [this, component, is_direction](float, std::vector<float>& values) {
    values.resize(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const float ambient = component == 0 ? openness_[i].ambient : 0.f;
      values[i] = !is_direction   ? ambient
                  : component < 3 ? component_of(openness_[i].bent, component)
                                  : 0.f;
    }
  };
}

std::span<const std::uint8_t> MeshPoints::place(const TexelPoints& points) {
  const std::size_t count = points.x.size();
  if (buffer_ == nullptr || buffer_->capacity() < count) {
    buffer_ =
        std::make_unique<BatchBuffer>(static_cast<std::uint32_t>(count), 0, needs_.primvars.size());
  }
  points_.resize(count);
  is_inside_.resize(count);
  along_x_.resize(count);
  along_y_.resize(count);
  seeds_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const CoverPoint at = cover_.at(
        points.texel[i], {static_cast<double>(points.x[i]), static_cast<double>(points.y[i])});
    const UvLayout::Piece piece = rows_->layout().pieces()[at.piece];
    points_[i] = {.mesh = piece.mesh,
                  .triangle = piece.triangle,
                  .u = static_cast<float>(at.weights.b1),
                  .v = static_cast<float>(at.weights.b2),
                  .keeps_normal = true};
    rows_->layout().triangle(at.piece, rows_->frame()).derivatives(along_x_[i], along_y_[i]);
    is_inside_[i] = at.is_inside ? 1 : 0;
    seeds_[i] = seed_of(points.texel[i], points.x[i], points.y[i]);
  }
  geometry_.fill(points_, needs_, camera_, *buffer_);
  trace();
  return is_inside_;
}

void MeshPoints::trace() {
  const std::size_t count = points_.size();
  const TransportSettings& settings = surface_.request_.transport;
  openness_.resize(wants_openness_ ? count : 0);
  for (std::size_t i = 0; i < openness_.size(); ++i) {
    openness_[i] = openness(*surface_.bvh_, transport_point(i), settings);
  }
  thickness_.resize(wants_thickness_ ? count : 0);
  for (std::size_t i = 0; i < thickness_.size(); ++i) {
    thickness_[i] = thickness(*surface_.bvh_, transport_point(i), settings);
  }
}

TransportPoint MeshPoints::transport_point(std::size_t i) const {
  const ShadingBatch& b = buffer_->batch;
  return {load(b.P, i), load(b.N, i), load(b.Ng, i), seeds_[i]};
}

void MeshPoints::fill(std::string_view channel, const TexelPoints& points,
                      std::vector<float>& values) const {
  fillers_.find(channel)->second(points.footprint, values);
}

void MeshPoints::turn_into_frame(const std::array<std::span<float>, 3>& vectors) const {
  const ShadingBatch& b = buffer_->batch;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vec3 v{vectors[0][i], vectors[1][i], vectors[2][i]};
    vectors[0][i] = dot(v, load(b.T, i));
    vectors[1][i] = dot(v, load(b.B, i));
    vectors[2][i] = dot(v, load(b.N, i));
  }
}

}  // namespace nacre::host
