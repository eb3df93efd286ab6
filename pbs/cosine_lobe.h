#pragma once

#include "pbs/facets.h"
#include "pbs/lobe.h"

namespace nacre {

/// What the lobes share that scatter about the normal with the density of a
/// cosine: on the viewer's hemisphere, or all on the other. Nothing passes to a layer
/// below (the library's 1.39.5 closures). Derived lobes say how much scatters.
class CosineLobe : public Lobe {
 public:
  enum class Hemisphere { viewer, other };
  /// `normal` is kept: prepare_facing_normal.
  CosineLobe(std::string_view name, Hemisphere hemisphere, Float3 normal)
      : name_(name), hemisphere_(hemisphere), normal_(normal) {}

  std::string_view name() const final { return name_; }
  std::int32_t kinds() const final {
    return hemisphere_ == Hemisphere::viewer ? lobe_diffuse_reflection : lobe_diffuse_transmission;
  }
  bool is_opaque() const final { return true; }
  Color3 throughput(const View&) const final { return Color3(0.0f); }
  LobeValue evaluate(const View& view, Float3 wi) const final;
  LobeSample sample(const View& view, Float3 u) const final;
  Float3 normal(const View&) const final { return normal_; }
  Float roughness(const View&) const final { return 1.0f; }
  std::optional<Color3> share(const View& view, Float3 wi) const final {
    return scattered(view, wi);
  }

 protected:
  /// What of the light along wi is scattered towards wo: f over that density.
  virtual Color3 scattered(const View& view, Float3 wi) const = 0;
  /// The normal on the side that the light comes from.
  Float3 axis(const View& view) const;

 private:
  std::string_view name_;
  Hemisphere hemisphere_;
  Float3 normal_;
};

/// The same radiance in all directions, times `color`: Lambert.
class LambertLobe final : public CosineLobe {
 public:
  /// `color` is prepared: prepare_tint.
  LambertLobe(std::string_view name, Hemisphere hemisphere, Float3 normal, Color3 color)
      : CosineLobe(name, hemisphere, normal), color_(color) {}
  Color3 albedo(const View&) const override { return saturate(color_); }

 private:
  Color3 scattered(const View&, Float3) const override { return color_; }

  Color3 color_;
};

}  // namespace nacre
