// What is known of a scene changes no bit of MaterialX's own materials, and leaves something out.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "jit/graph/find.h"
#include "jit/record/leaves.h"
#include "pbs/kernels.h"
#include "tests/conformance/corpus.h"
#include "tests/support/random.h"
#include "tests/support/tier.h"

namespace nacre {
namespace {

constexpr std::size_t count = 150;

/// Numbers of channels, by name.
using Columns = std::map<std::string, std::vector<std::uint32_t>>;

struct Vector {
  double x, y, z;
};

/// Surfaces that are seen from their front, mapped to the unit square, and light from everywhere.
Columns points(std::uint64_t seed) {
  Random random(seed);
  Columns columns;
  const auto share = [&] { return static_cast<double>(random.below(1 << 20)) / (1 << 20); };
  const auto add = [&](const std::string& name, double x) {
    columns[name].push_back(std::bit_cast<std::uint32_t>(static_cast<float>(x)));
  };
  const auto add_vector = [&](const std::string& name, const Vector& v) {
    add(name + ".x", v.x), add(name + ".y", v.y), add(name + ".z", v.z);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = 2 * std::numbers::pi * share(), tilt = 3 * share();
    const Vector n{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn),
                   std::cos(tilt)};
    const Vector t{std::cos(tilt) * std::cos(turn), std::cos(tilt) * std::sin(turn),
                   -std::sin(tilt)};
    const Vector b{-std::sin(turn), std::cos(turn), 0};
    const auto direction = [&](double least) {
      const double along = least + (1 - least) * share(), across = std::sqrt(1 - along * along);
      const double angle = 2 * std::numbers::pi * share();
      const double x = across * std::cos(angle), y = across * std::sin(angle);
      return Vector{x * t.x + y * b.x + along * n.x, x * t.y + y * b.y + along * n.y,
                    x * t.z + y * b.z + along * n.z};
    };
    for (const char* name : {"N", "Ng", "No"}) add_vector(name, n);
    for (const char* name : {"T", "To"}) add_vector(name, t);
    for (const char* name : {"B", "Bo"}) add_vector(name, b);
    add_vector("wo", direction(0.02));
    add_vector("wi", direction(-1));
    for (const char* name : {"P", "Po"}) {
      add_vector(name, {2 * share() - 1, 2 * share() - 1, 2 * share() - 1});
    }
    add_vector("u", {share(), share(), share()});
    for (const char* set : {"uv0", "uv1"}) {
      add(set + std::string(".x"), share()), add(set + std::string(".y"), share());
    }
    for (const char* color : {"color0.x", "color0.y", "color0.z", "color0.w"}) add(color, share());
  }
  return columns;
}

/// What is so of all these.
std::vector<Fact> facts_of_points() {
  std::vector<Fact> facts{
      {"uv0", 0, 1}, {"uv1", 0, 1}, {"color0", 0, 1},           {"u", 0, 1},
      {"P", -1, 1},  {"Po", -1, 1}, {"dot(N,wo)", 0.01, 1.001}, {"dot(Ng,wo)", 0.01, 1.001}};
  for (const char* unit : {"N", "Ng", "No", "T", "To", "B", "Bo", "wo", "wi"}) {
    facts.push_back({fmt::format("dot({},{})", unit, unit), 0.999, 1.001});
  }
  return facts;
}

/// That live parameters are what the document says.
void add_facts(const std::vector<Parameter>& parameters, std::vector<Fact>& facts) {
  for (const Parameter& parameter : parameters) {
    const std::vector<float>& values = parameter.value.floats;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::string name =
          slot_name(parameter.path, static_cast<int>(i), static_cast<int>(values.size()));
      if (!std::signbit(values[i]) || values[i] < 0) facts.push_back({name, values[i], values[i]});
    }
  }
}

/// The kernels of a material that ask only for points, in an order in which each is given what it
/// reads.
std::vector<std::pair<std::string, const BoundKernel*>> kernels_of(const MaterialKernels& made) {
  std::vector<std::pair<std::string, const BoundKernel*>> list;
  const auto add = [&](const char* name, const std::optional<BoundKernel>& kernel) {
    if (kernel) list.emplace_back(name, &*kernel);
  };
  add("begin", made.begin), add("sample", made.sample), add("evaluate", made.evaluate);
  add("albedo", made.albedo), add("emission", made.emission), add("opacity", made.opacity);
  add("shade", made.shade), add("interior", made.interior), add("shadow", made.shadow);
  add("volume", made.volume), add("displacement", made.displacement), add("emit", made.emit);
  return list;
}

/// What a kernel stores; of channels that nobody knows every number is 0.
Columns run(const BoundKernel& kernel, const Columns& columns) {
  const std::vector<std::uint32_t> nothing(count, 0);
  std::vector<const void*> inputs;
  for (const Channel& channel : kernel.program().inputs) {
    const auto found = columns.find(channel.name);
    inputs.push_back(found != columns.end() ? found->second.data() : nothing.data());
  }
  Columns results;
  std::vector<void*> outputs;
  for (const Channel& channel : kernel.program().outputs) {
    outputs.push_back((results[channel.name] = nothing).data());
  }
  EXPECT_EQ(kernel.run(inputs, outputs, count), RunStatus::done);
  return results;
}

/// Where two differ first, for people; "" where they have the same bits.
std::string first_difference(const Columns& found, const Columns& expected) {
  for (const auto& [name, column] : expected) {
    const std::vector<std::uint32_t>& others = found.at(name);
    const auto [at, other] = std::ranges::mismatch(column, others);
    if (at == column.end()) continue;
    return fmt::format("{} of point {}: {:#x} ({}), not {:#x} ({})", name, at - column.begin(),
                       *other, std::bit_cast<float>(*other), *at, std::bit_cast<float>(*at));
  }
  return found.size() == expected.size() ? "" : "the channels";
}

class CorpusFacts : public Corpus {
 protected:
  /// Instructions that kernels have left once ranges have decided, without the look whether what
  /// was said is so.
  static std::size_t decided(const MaterialKernels& made) {
    std::size_t sum = 0;
    for (const StageReport& stage : made.stages) {
      if (stage.name.ends_with(": decide")) sum += stage.instructions;
    }
    return sum;
  }

  /// Adds how much less its kernels are to both sums.
  void compare(const Document& document, const std::string& material, const std::string& place,
               ParameterMode mode, Backend backend) {
    ShaderOptions options = this->options(Backend::interpreter);
    options.parameters = mode;
    options.kernels.entries |= entry_shade | entry_interior | entry_shadow | entry_emit;
    Diagnostics said;
    const auto general = system_->compile_material(document, material, options, said);
    if (general == nullptr) return;  // EveryMaterialCompiles says which these are.
    options.compile.facts = facts_of_points();
    add_facts(general->parameters, options.compile.facts);
    options.compile.backend = backend;
    const auto narrow = system_->compile_material(document, material, options, said);
    ASSERT_NE(narrow, nullptr) << place << said.to_string();
    Columns all = points(1), few = all;
    const auto kernels = kernels_of(*general), narrower = kernels_of(*narrow);
    ASSERT_EQ(kernels.size(), narrower.size());
    for (std::size_t i = 0; i < kernels.size(); ++i) {
      const Columns expected = run(*kernels[i].second, all), found = run(*narrower[i].second, few);
      EXPECT_EQ(first_difference(found, expected), "") << place << ' ' << kernels[i].first;
      EXPECT_EQ(narrower[i].second->points_outside_facts(), 0u) << place << kernels[i].first;
      if (kernels[i].first == "begin") {
        all.insert(expected.begin(), expected.end());
        few.insert(found.begin(), found.end());
      }
    }
    before_ += decided(*general), after_ += decided(*narrow);
    ++materials_;
  }

  /// Every so many of them.
  void compare_all(ParameterMode mode, std::size_t every) {
    std::size_t met = 0;
    for (const std::filesystem::path& file : documents()) {
      Diagnostics diagnostics;
      const auto document = read(file, diagnostics);
      ASSERT_NE(document, nullptr) << file << diagnostics.to_string();
      for (const FoundMaterial& material : find_materials(*document)) {
        if (met++ % every != 0) continue;
        // Machine code of some, for it takes long to make.
        const Backend backend = materials_ % 8 == 0 ? Backend::jit : Backend::interpreter;
        compare(*document, material.name, name_of(file) + ' ' + material.name, mode, backend);
      }
    }
    std::cout << materials_ << " materials, " << before_ << " instructions, with facts " << after_
              << '\n';
    EXPECT_EQ(met, 161u);
    EXPECT_GE(materials_, 159u / every);
  }

  std::size_t materials_ = 0, before_ = 0, after_ = 0;
};

TEST_F(CorpusFacts, OfPointsChangeNoBit) {
  compare_all(ParameterMode::frozen, 1);
  EXPECT_LT(after_, before_);
}

// Seven of them take as long as all above: a share each day.
TEST_F(CorpusFacts, OfLiveParametersChangeNoBit) {
  compare_all(ParameterMode::live, number_of("NACRE_TEST_EVERY", 9));
  EXPECT_LT(static_cast<double>(after_), 0.8 * static_cast<double>(before_));
}

}  // namespace
}  // namespace nacre
