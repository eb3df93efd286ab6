#pragma once

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "examples/render/batch_buffer.h"
#include "examples/render/shader.h"

/// \file
/// Materials with closed forms, to prove the integrator by.
namespace nacre::host {

/// All of a result is of one class, for passes.
inline void say_all_is(ScatterClass one, const ShadingBatch& batch, const Lanes3& whole,
                       const PartLanes* parts) {
  if (parts == nullptr) return;
  for (std::size_t c = 0; c < scatter_classes; ++c) {
    const bool mine = c == static_cast<std::size_t>(one);
    for (std::size_t i = 0; i < batch.count; ++i) {
      store((*parts)[c], i, mine ? load(whole, i) : Vec3{});
    }
  }
}

/// Lambertian about the geometric normal on the viewer's side, with optional
/// emission and opacity.
class LambertShader : public Shader {
 public:
  explicit LambertShader(Vec3 albedo, Vec3 glow = {}, Vec3 opacity_rgb = {1.f, 1.f, 1.f})
      : albedo_(albedo), glow_(glow), opacity_(opacity_rgb) {}

  Capabilities capabilities() const override {
    Capabilities c;
    c.emits = glow_.x > 0.f || glow_.y > 0.f || glow_.z > 0.f;
    c.has_opacity = opacity_.x < 1.f || opacity_.y < 1.f || opacity_.z < 1.f;
    return c;
  }
  std::size_t state_bytes(std::uint32_t capacity) const override { return capacity * sizeof(Vec3); }

  void begin(const ShadingBatch& batch, void* state) const override {
    auto* normals = static_cast<Vec3*>(state);
    for (std::size_t i = 0; i < batch.count; ++i) {
      const Vec3 ng = load(batch.Ng, i);
      normals[i] = dot(ng, load(batch.wo, i)) < 0.f ? -ng : ng;
    }
  }

  void sample(const ShadingBatch& batch, const void* state, Lanes3 u,
              SampleLanes out) const override {
    const auto* normals = static_cast<const Vec3*>(state);
    for (std::size_t i = 0; i < batch.count; ++i) {
      const float phi = 2.f * std::numbers::pi_v<float> * u.y[i];
      const float r = std::sqrt(u.z[i]);
      const float z = std::sqrt(1.f - u.z[i]);
      const Vec3 t = perpendicular(normals[i]);
      const Vec3 b = cross(normals[i], t);
      store(out.wi, i, normalize(r * std::cos(phi) * t + r * std::sin(phi) * b + z * normals[i]));
      store(out.weight, i, albedo_);
      out.pdf[i] = z / std::numbers::pi_v<float>;
      out.flags[i] = z > 0.f ? sample_valid : 0u;
    }
    say_all_is(ScatterClass::diffuse, batch, out.weight, out.parts);
  }

  void evaluate(const ShadingBatch& batch, const void* state, Lanes3 wi,
                EvaluateLanes out) const override {
    const auto* normals = static_cast<const Vec3*>(state);
    for (std::size_t i = 0; i < batch.count; ++i) {
      const float z = std::max(0.f, dot(normals[i], load(wi, i)));
      out.pdf[i] = z / std::numbers::pi_v<float>;
      store(out.value, i, out.pdf[i] * albedo_);
    }
    say_all_is(ScatterClass::diffuse, batch, out.value, out.parts);
  }

  void emission(const ShadingBatch& batch, Lanes3 radiance) const override {
    for (std::size_t i = 0; i < batch.count; ++i) store(radiance, i, glow_);
  }
  void opacity(const ShadingBatch& batch, Lanes3 rgb) const override {
    for (std::size_t i = 0; i < batch.count; ++i) store(rgb, i, opacity_);
  }

 private:
  Vec3 albedo_, glow_, opacity_;
};

/// A perfect mirror: a Dirac lobe and nothing else.
class MirrorShader final : public Shader {
 public:
  explicit MirrorShader(Vec3 reflectance) : reflectance_(reflectance) {}

  Capabilities capabilities() const override {
    Capabilities c;
    c.only_delta = true;
    return c;
  }
  std::size_t state_bytes(std::uint32_t) const override { return 0; }
  void begin(const ShadingBatch&, void*) const override {}
  void sample(const ShadingBatch& batch, const void*, Lanes3, SampleLanes out) const override {
    for (std::size_t i = 0; i < batch.count; ++i) {
      const Vec3 n = load(batch.Ng, i), wo = load(batch.wo, i);
      store(out.wi, i, normalize(2.f * dot(n, wo) * n - wo));
      store(out.weight, i, reflectance_);
      out.pdf[i] = 1.f;
      out.flags[i] = sample_valid | sample_delta;
    }
    say_all_is(ScatterClass::mirror, batch, out.weight, out.parts);
  }
  void evaluate(const ShadingBatch&, const void*, Lanes3, EvaluateLanes) const override {}
  void emission(const ShadingBatch&, Lanes3) const override {}
  void opacity(const ShadingBatch&, Lanes3) const override {}

 private:
  Vec3 reflectance_;
};

/// What a faulty kernel would return.
class BrokenShader final : public LambertShader {
 public:
  BrokenShader() : LambertShader({1.f, 1.f, 1.f}) {}
  void sample(const ShadingBatch& batch, const void* state, Lanes3 u,
              SampleLanes out) const override {
    LambertShader::sample(batch, state, u, out);
    for (std::size_t i = 0; i < batch.count; ++i) {
      out.weight.x[i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
};

}  // namespace nacre::host
