#pragma once

#include <cmath>
#include <cstdint>
#include <nacre/nacre.hpp>
#include <random>
#include <vector>

namespace nacre {

/// Shading points as a path tracer has them: structures, with arrays beside them for what kernels
/// store. Binds and runs a shader on them.
class SurfacePoints {
 public:
  struct Point {
    float P[3];
    float N[3];
    float T[3];
    float B[3];
    float wo[3];
    float uv[2];
    std::uint32_t material;
  };
  static constexpr std::size_t most_state = 128;

  explicit SurfacePoints(std::size_t count)
      : points(count),
        state(count * most_state),
        u(3 * count),
        wi(3 * count),
        weight(3 * count),
        f(3 * count),
        pdf(count),
        sample_pdf(count),
        flags(count),
        albedo(3 * count),
        instances(count) {
    std::mt19937 random(7);
    const auto number = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
    for (std::size_t i = 0; i < count; ++i) {
      const float azimuth = 6.2831853f * number();
      const float z = 0.05f + 0.95f * number();
      const float r = std::sqrt(1 - z * z);
      points[i] = {{number(), number(), 0},
                   {0, 0, 1},
                   {1, 0, 0},
                   {0, 1, 0},
                   {r * std::cos(azimuth), r * std::sin(azimuth), z},
                   {number(), number()},
                   0};
      for (std::size_t k = 0; k < 3; ++k) u[3 * i + k] = number();
    }
  }

  Binder binder() const {
    const auto of_point = [](std::size_t offset) {
      return Layout{0, static_cast<std::ptrdiff_t>(offset), sizeof(Point)};
    };
    Binder made;
    made.array("P", of_point(offsetof(Point, P))).array("Po", of_point(offsetof(Point, P)));
    for (const char* normal : {"N", "No", "Ng"}) made.array(normal, of_point(offsetof(Point, N)));
    for (const char* tangent : {"T", "To"}) made.array(tangent, of_point(offsetof(Point, T)));
    for (const char* bitangent : {"B", "Bo"}) made.array(bitangent, of_point(offsetof(Point, B)));
    made.array("wo", of_point(offsetof(Point, wo))).array("uv0", of_point(offsetof(Point, uv)));
    // The state as columns: what a kernel takes without a copy.
    made.array("state", {1, 0, 4, 4 * static_cast<std::ptrdiff_t>(points.size())});
    made.array("u", {2, 0, 12}).array("wi", {3, 0, 12}).array("weight", {4, 0, 12});
    made.array("f", {5, 0, 12}).array("pdf", {6}).array("flags", {7}).array("albedo", {8, 0, 12});
    return made;
  }

  std::vector<void*> arrays() {
    return {points.data(), state.data(), u.data(),     wi.data(),    weight.data(),
            f.data(),      pdf.data(),   flags.data(), albedo.data()};
  }

  /// begin, sample, evaluate towards what was sampled, and albedo, of all points or those listed.
  void shade(const Shader& shader, const Instance* instance = nullptr,
             const std::vector<std::uint32_t>* list = nullptr) {
    const Binding binding(binder(), shader);
    shade(binding, instance, list);
  }
  void shade(const Binding& binding, const Instance* instance = nullptr,
             const std::vector<std::uint32_t>* list = nullptr) {
    Batch batch;
    batch.count = list != nullptr ? list->size() : points.size();
    batch.points = list != nullptr ? list->data() : nullptr;
    batch.instances = instances.data();
    for (const nacre_entry entry : {NACRE_BEGIN, NACRE_SAMPLE, NACRE_EVALUATE, NACRE_ALBEDO}) {
      binding.run(entry, arrays(), batch, instance);
      if (entry == NACRE_SAMPLE) sample_pdf = pdf;
    }
  }

  bool same_results(const SurfacePoints& other) const {
    const auto same = [](const auto& a, const auto& b) {
      return std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
    };
    return same(wi, other.wi) && same(weight, other.weight) && same(f, other.f) &&
           same(pdf, other.pdf) && same(sample_pdf, other.sample_pdf) && same(flags, other.flags) &&
           same(albedo, other.albedo);
  }

  std::vector<Point> points;
  std::vector<float> state, u, wi, weight, f, pdf, sample_pdf;
  std::vector<std::int32_t> flags;
  std::vector<float> albedo;
  std::vector<std::uint32_t> instances;
};

}  // namespace nacre
