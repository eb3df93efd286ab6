#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <nacre/nacre.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace nacre::bench {

constexpr std::size_t all = 4096;
constexpr std::size_t numbers_a_point = 21;

/// From one column to the next, in numbers: no multiple of a page, for then all columns meet in the
/// same sets of the caches. A cache line more is enough, as measured; half a page more costs half
/// as much as none. What none costs is a row of its own.
constexpr std::size_t apart = all + 80;

inline System& host_system() {
  static System system;
  return system;
}

/// Named groups of numbers, every one an array of its own or all in structures.
class Points {
 public:
  /// `state_by_place`: an element for each point of the list that is shaded. `stride`: of columns.
  explicit Points(bool structures, bool state_by_place = false, std::size_t stride = apart)
      : structures_(structures), state_by_place_(state_by_place), stride_(stride) {
    std::mt19937 random(1);
    const auto number = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
    for (std::size_t i = 0; i < all; ++i) {
      const float z = 0.05f + 0.95f * number();
      const float azimuth = 6.2831853f * number();
      const float r = std::sqrt(1 - z * z);
      const float P[]{number(), number(), 0};
      const float N[]{0, 0, 1}, T[]{1, 0, 0}, B[]{0, 1, 0};
      const float wo[]{r * std::cos(azimuth), r * std::sin(azimuth), z};
      const float u[]{number(), number(), number()};
      for (const auto* group : {P, N, T, B, wo, u, wo}) {
        numbers_.insert(numbers_.end(), group, group + 3);
      }
    }
    if (!structures_) {
      std::vector<float> columns(numbers_a_point * stride_);
      for (std::size_t i = 0; i < all; ++i) {
        for (std::size_t k = 0; k < numbers_a_point; ++k) {
          columns[k * stride_ + i] = numbers_[numbers_a_point * i + k];
        }
      }
      numbers_ = std::move(columns);
    }
    for (std::size_t i = 0; i < all; ++i)
      instances_.push_back(static_cast<std::uint32_t>(i * 7 % 16));
    for (int k = 0; k < 16 * 4; ++k) looks_.push_back(0.1f + 0.8f * number());
  }

  Binding bind(const Shader& shader) { return Binding(binder(shader), shader); }

  /// Of everything but results of other names than the usual.
  Binder binder(const Shader& shader) {
    state_.resize(std::max<std::size_t>(shader.state_count(), 1) * stride_);
    const auto column = static_cast<std::ptrdiff_t>(4 * stride_);
    Binder binder;
    const auto group = [&](std::initializer_list<const char*> names, std::ptrdiff_t first) {
      for (const char* name : names) {
        binder.array(name, structures_ ? Layout{0, 4 * first, 4 * numbers_a_point}
                                       : Layout{0, first * column, 4, column});
      }
    };
    group({"P", "Po"}, 0);
    group({"N", "No", "Ng"}, 3);
    group({"T", "To"}, 6);
    group({"B", "Bo"}, 9);
    group({"wo"}, 12);
    group({"u"}, 15);
    group({"wi"}, 18);
    binder.array("state", {1, 0, 4, column, state_by_place_ ? NACRE_OF_PLACE : NACRE_OF_POINT});
    results_.resize(12 * stride_);
    const auto result = [&](const char* name, std::ptrdiff_t first) {
      binder.array(name,
                   structures_ ? Layout{2, 4 * first, 48} : Layout{2, first * column, 4, column});
    };
    result("f", 0), result("weight", 3), result("pdf", 6);
    result("flags", 7), result("lobe", 8), result("albedo", 9);
    binder.array("S_standard_surface/base_color", {3, 0, 16, 4, NACRE_OF_INSTANCE});
    binder.array("S_standard_surface/specular_roughness", {3, 12, 16, 4, NACRE_OF_INSTANCE});
    return binder;
  }

  std::vector<void*> arrays() {
    return {numbers_.data(), state_.data(), results_.data(), looks_.data()};
  }
  /// Of a channel, where every number is an array of its own; of what a material does not read or
  /// a host does not keep, numbers that count for nothing.
  float* column(const Channel& channel) {
    constexpr std::pair<const char*, std::size_t> groups[] = {
        {"P", 0},  {"Po", 0}, {"N", 3},  {"No", 3},  {"Ng", 3}, {"T", 6},
        {"To", 6}, {"B", 9},  {"Bo", 9}, {"wo", 12}, {"u", 15}, {"wi", 18}};
    constexpr std::pair<const char*, std::size_t> results[] = {
        {"f", 0}, {"weight", 3}, {"pdf", 6}, {"flags", 7}, {"lobe", 8}, {"albedo", 9}};
    const auto component = static_cast<std::size_t>(std::max(channel.component, 0));
    const std::string group = channel.name.substr(0, channel.name.find('.'));
    if (group == "state") return state_.data() + component * stride_;
    for (const auto& [name, first] : groups) {
      if (group == name) return numbers_.data() + (first + component) * stride_;
    }
    for (const auto& [name, first] : results) {
      if (group == name) return results_.data() + (first + component) * stride_;
    }
    spare_.resize(all);
    return spare_.data();
  }
  const std::uint32_t* instances() const { return instances_.data(); }
  /// Result number `k` of a point.
  float result(std::size_t i, std::size_t k) const {
    return structures_ ? results_[12 * i + k] : results_[k * stride_ + i];
  }

 private:
  bool structures_, state_by_place_;
  std::size_t stride_;
  std::vector<float> numbers_, state_, results_, looks_, spare_;
  std::vector<std::uint32_t> instances_;
};

}  // namespace nacre::bench
