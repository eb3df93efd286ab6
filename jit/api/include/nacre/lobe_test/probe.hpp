/// \file
/// A material's kernels, asked about directions alone: part of <nacre/lobe_test.hpp>.
#ifndef NACRE_LOBE_TEST_PROBE_HPP
#define NACRE_LOBE_TEST_PROBE_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <nacre/binding.hpp>
#include <nacre/lobe_test/direction.hpp>
#include <random>
#include <string>
#include <vector>

namespace nacre {
inline namespace v0 {
namespace detail {

/// The kernels of a material at the origin: normal z, tangent x, all else 0 unless `bind` says.
class LobeProbe {
 public:
  struct Values {
    std::vector<float> f;  ///< Red, green and blue of each direction, times the cosine.
    std::vector<float> pdf;
  };
  struct Samples {
    std::vector<Direction> wi;
    std::vector<float> weight;  ///< Red, green and blue of each.
    std::vector<float> pdf;
    std::vector<std::int32_t> flags;
  };

  LobeProbe(const Shader& shader, const Instance* instance,
            const std::function<void(Binder&)>& bind)
      : shader_(shader),
        instance_(instance),
        state_count_(shader.state_count()),
        of_one_(binder(0, bind), shader, asked(shader)),
        of_each_(binder(1, bind), shader, asked(shader) | 1u << NACRE_BEGIN) {}

  /// `wo`: one, or as many as wi.
  Values evaluate(const std::vector<Direction>& wo, const std::vector<Direction>& wi) {
    begin(wo);
    wi_ = wi;
    f_.assign(3 * wi.size(), 0.0f);
    pdf_.assign(wi.size(), 0.0f);
    run(wo.size() == 1 ? of_one_ : of_each_, NACRE_EVALUATE, wi.size());
    return {f_, pdf_};
  }
  Samples sample(Direction wo, std::size_t count, std::uint64_t seed) {
    begin({wo});
    std::mt19937_64 random(seed);
    u_.resize(3 * count);
    for (float& u : u_) u = static_cast<float>(random() >> 40) * 0x1p-24f;
    wi_.assign(count, {});
    weight_.assign(3 * count, 0.0f);
    pdf_.assign(count, 0.0f);
    flags_.assign(count, 0);
    run(of_one_, NACRE_SAMPLE, count);
    return {wi_, weight_, pdf_, flags_};
  }
  std::array<float, 3> albedo(Direction wo) {
    begin({wo});
    run(of_one_, NACRE_ALBEDO, 1);
    return albedo_;
  }

 private:
  static std::uint32_t asked(const Shader& shader) {
    std::uint32_t bits = 0;
    for (const nacre_entry entry : {NACRE_SAMPLE, NACRE_EVALUATE, NACRE_ALBEDO}) {
      bits |= 1u << entry;
      if (shader.has(entry)) continue;
      Diagnostic said;
      said.code = "no-lobe";
      said.text = said.message = "the shader has no closure to be tried, or was compiled without";
      throw Error(NACRE_WRONG_ARGUMENTS, {said});
    }
    return bits;
  }

  /// `each`: 1 where points have a wo each, 0 where one is that of all.
  Binder binder(std::ptrdiff_t each, const std::function<void(Binder&)>& bind) const {
    Binder made;
    for (const nacre_entry entry : {NACRE_BEGIN, NACRE_SAMPLE, NACRE_EVALUATE, NACRE_ALBEDO}) {
      for (const Channel& channel : shader_.inputs(entry)) {
        if (channel.role != NACRE_POINT && channel.role != NACRE_SLOT) continue;
        const bool has_group = channel.component >= 0;
        made.constant(has_group ? channel.name.substr(0, channel.name.size() - 2) : channel.name,
                      {0});
      }
    }
    for (const char* const name : {"T", "To"}) made.constant(name, {1, 0, 0});
    for (const char* const name : {"B", "Bo"}) made.constant(name, {0, 1, 0});
    for (const char* const name : {"N", "No", "Ng"}) made.constant(name, {0, 0, 1});
    made.array("wo", {0, 0, 12 * each});
    made.array("state", {1, 0, 4 * each * static_cast<std::ptrdiff_t>(state_count_), 4});
    made.array("u", {2, 0, 12}).array("wi", {3, 0, 12}).array("weight", {4, 0, 12});
    made.array("f", {5, 0, 12}).array("pdf", {6}).array("flags", {7}).array("albedo", {8, 0, 12});
    if (bind) bind(made);
    return made;
  }

  void begin(const std::vector<Direction>& wo) {
    wo_ = wo;
    state_.assign(wo.size() * state_count_ + 1, 0.0f);
    if (shader_.has(NACRE_BEGIN)) run(of_each_, NACRE_BEGIN, wo.size());
  }

  void run(const Binding& binding, nacre_entry entry, std::size_t count) {
    const std::array<void*, 9> arrays{wo_.data(),  state_.data(),  u_.data(),
                                      wi_.data(),  weight_.data(), f_.data(),
                                      pdf_.data(), flags_.data(),  albedo_.data()};
    Batch batch;
    batch.count = count;
    binding.run(entry, arrays, batch, instance_);
  }

  const Shader& shader_;
  const Instance* instance_;
  std::size_t state_count_;
  Binding of_one_, of_each_;
  std::vector<Direction> wo_, wi_;
  std::vector<float> state_, u_, weight_, f_, pdf_;
  std::vector<std::int32_t> flags_;
  std::array<float, 3> albedo_{};
};

}  // namespace detail
}  // namespace v0
}  // namespace nacre

#endif
