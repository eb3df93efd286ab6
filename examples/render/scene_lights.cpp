#include "examples/render/scene_lights.h"

#include <algorithm>

#include "examples/render/light_probes.h"
#include "examples/render/mesh.h"
#include "examples/render/render_context.h"

namespace nacre::host {

namespace {

/// Whether light sampling looks for the surface of a mesh.
bool is_light(const RenderContext& context, std::uint32_t mesh) {
  const Mesh& m = context.scene.meshes[mesh];
  const bool emits = context.materials[context.front_materials[mesh]].capabilities.emits ||
                     context.materials[context.back_materials[mesh]].capabilities.emits;
  // What nothing sees is no light either (Geometry Extensions, "Visibility Elements"). What moves
  // is found by paths alone: how large its triangles are is a matter of the time. And of fibres:
  // their pieces are no triangles.
  return emits && m.visible_to != 0 && m.instances.empty() && m.poses.empty() && !m.is_fibres();
}

float area_of(const Mesh& mesh, const Triangle& t) {
  const Vec3 a = mesh.position[t.v[0]];
  return 0.5f * length(cross(mesh.position[t.v[1]] - a, mesh.position[t.v[2]] - a));
}

/// Of one that is closed: its front is outside, by the sign of its volume.
bool has_normals_outwards(const Mesh& mesh) {
  double volume = 0.0;
  const Vec3 from = mesh.position[mesh.triangles[0].v[0]];
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.position[t.v[0]] - from, b = mesh.position[t.v[1]] - from;
    volume += double{dot(a, cross(b, mesh.position[t.v[2]] - from))};
  }
  return volume >= 0.0;
}

}  // namespace

/// What the tree is built of.
struct SceneLights::Gathering {
  const RenderContext& context;
  SceneLights& lights;
  BatchBuffer buffer;
  std::vector<LightBounds> bounds;

  Gathering(const RenderContext& of, SceneLights& to)
      : context(of), lights(to), buffer(of.settings.batch_size, 0, of.primvars) {
    buffer.batch.time = context.settings.time;
    buffer.batch.frame = context.settings.frame;
  }

  void add_mesh(std::uint32_t mesh) {
    const Mesh& m = context.scene.meshes[mesh];
    const std::vector<float> front = probe_side(context, mesh, false, buffer);
    const std::vector<float> back = probe_side(context, mesh, true, buffer);
    const auto brightest = [](const std::vector<float>& side) {
      return side.empty() ? 0.f : *std::ranges::max_element(side);
    };
    const float most = std::max(brightest(front), brightest(back));
    if (!(most > 0.f)) return;
    Entry entry{.mesh = mesh, .front = brightest(front) > 0.f, .back = brightest(back) > 0.f};
    if (entry.front && entry.back && is_shell(m)) {
      (has_normals_outwards(m) ? entry.back : entry.front) = false;
    }
    lights.first_[mesh] = static_cast<std::uint32_t>(lights.entries_.size());
    for (entry.index = 0; entry.index < m.triangles.size(); ++entry.index) {
      // Where the probes saw nothing a texture may still glow.
      float radiance = 0.02f * most;
      if (entry.front) radiance = std::max(radiance, front[entry.index]);
      if (entry.back) radiance = std::max(radiance, back[entry.index]);
      entry.area = area_of(m, m.triangles[entry.index]);
      add_triangle(entry, radiance);
    }
  }

  /// Whether light from inside does not get out.
  bool is_shell(const Mesh& mesh) const { return !context.any_opacity && is_closed(mesh); }

  void add_triangle(const Entry& entry, float radiance) {
    const Mesh& m = context.scene.meshes[entry.mesh];
    LightBounds b;
    for (const std::uint32_t v : m.triangles[entry.index].v) b.box.add(m.position[v]);
    b.intensity = double{entry.area} * double{radiance};
    const Vec3 n = surface_normal(context.scene, {.mesh = entry.mesh, .triangle = entry.index});
    b.cone = DirectionCone::about(entry.front ? n : -n, 1.f);
    b.cos_e = 0.f;
    b.both_ways = entry.front && entry.back;
    bounds.push_back(b);
    lights.entries_.push_back(entry);
  }

  void add_lights() {
    for (std::uint32_t i = 0; i < context.point_lights.size(); ++i) {
      const auto known = context.point_lights[i]->bounds();
      if (!known) {
        lights.far_.push_back(i);
        continue;
      }
      bounds.push_back(*known);
      lights.entries_.push_back({.index = i});
    }
  }

  /// By what arrives of each. What the probes did not find may be a thin beam.
  void share_far_lights() {
    std::vector<double> weights;
    for (const std::uint32_t i : lights.far_) {
      weights.push_back(double{probe_light(context, *context.point_lights[i], buffer)});
    }
    const double brightest = weights.empty() ? 0.0 : *std::ranges::max_element(weights);
    double sum = 0.0;
    for (double& w : weights) {
      w = brightest > 0.0 ? std::max(w, 0.1 * brightest) : 1.0;
      sum += w;
    }
    lights.far_cdf_.assign(1, 0.0);
    for (const double w : weights) lights.far_cdf_.push_back(lights.far_cdf_.back() + w / sum);
    lights.far_cdf_.back() = weights.empty() ? 0.0 : 1.0;
  }
};

SceneLights::SceneLights(const RenderContext& context) {
  Gathering gathering(context, *this);
  first_.assign(context.scene.meshes.size(), Entry::none);
  for (std::uint32_t mesh = 0; mesh < context.scene.meshes.size(); ++mesh) {
    if (is_light(context, mesh)) gathering.add_mesh(mesh);
  }
  gathering.add_lights();
  gathering.share_far_lights();
  tree_ = LightTree(gathering.bounds);
  const int kinds =
      (context.environment != nullptr ? 1 : 0) + (far_.empty() ? 0 : 1) + (tree_.empty() ? 0 : 1);
  const float each = kinds == 0 ? 0.f : 1.f / static_cast<float>(kinds);
  environment_chance_ = context.environment != nullptr ? each : 0.f;
  far_chance_ = far_.empty() ? 0.f : each;
  tree_chance_ = tree_.empty() ? 0.f : each;
}

bool SceneLights::empty() const {
  return !(environment_chance_ > 0.f) && far_.empty() && tree_.empty();
}

SceneLights::Choice SceneLights::choose(const LitPlace& from, Uniform2 u) const {
  if (u.x < environment_chance_) return {Kind::environment, environment_chance_};
  // Many lights are more than one number tells apart.
  const double fine = double{u.x} + 0x1p-24 * double{u.y} - double{environment_chance_};
  const auto within = [](double v) { return std::clamp(v, 0.0, 0x1.fffffffffffffp-1); };
  if (far_chance_ > 0.f && (fine < double{far_chance_} || !(tree_chance_ > 0.f))) {
    const auto above =
        std::ranges::upper_bound(far_cdf_, within(fine / double{far_chance_})) - far_cdf_.begin();
    const auto i = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(above - 1, 0, static_cast<std::ptrdiff_t>(far_.size()) - 1));
    const double share = far_cdf_[i + 1] - far_cdf_[i];
    return {Kind::unmet, far_chance_ * static_cast<float>(share), far_[i]};
  }
  if (tree_.empty()) return {};
  const auto drawn =
      tree_.sample(from, within((fine - double{far_chance_}) / double{tree_chance_}));
  if (!drawn) return {};
  const Entry& e = entries_[drawn->light];
  const float probability = tree_chance_ * static_cast<float>(drawn->probability);
  if (e.mesh == Entry::none) return {Kind::unmet, probability, e.index};
  return {Kind::triangle, probability, 0, e.mesh, e.index, e.area, e.front, e.back};
}

float SceneLights::area_pdf(const LitPlace& from, std::uint32_t mesh, std::uint32_t triangle,
                            bool back) const {
  const std::uint32_t first = first_[mesh];
  if (first == Entry::none) return 0.f;
  const std::uint32_t light = first + triangle;
  if (!(back ? entries_[light].back : entries_[light].front)) return 0.f;
  const auto probability = static_cast<float>(tree_.probability(from, light));
  return probability > 0.f ? tree_chance_ * probability / entries_[light].area : 0.f;
}

}  // namespace nacre::host
