// <nacre/code.hpp>: machine code that a host calls by itself, and code for single points.
#include <gtest/gtest.h>

#include <array>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <nacre/code.hpp>
#include <nacre/nacre.hpp>
#include <random>
#include <string>
#include <vector>

#include "tests/jit/api/surface_document.h"

namespace nacre {
namespace {

/// A column of numbers for each channel of an entry.
class Columns {
 public:
  Columns(const std::vector<Channel>& channels, std::size_t count) {
    for (const Channel& channel : channels) {
      names_.push_back(channel.name);
      columns_.emplace_back(count, 0u);
    }
    for (auto& column : columns_) pointers_.push_back(column.data());
  }
  void fill(std::uint32_t seed) {
    std::mt19937 random(seed);
    for (auto& column : columns_) {
      for (std::uint32_t& bits : column) {
        const float number = static_cast<float>(random() >> 8) * 0x1p-24f;
        std::memcpy(&bits, &number, sizeof bits);
      }
    }
  }
  Binder& bind(Binder& binder, std::uint32_t first_array) const {
    for (std::uint32_t i = 0; i < names_.size(); ++i) {
      binder.array(names_[i], {first_array + i});
    }
    return binder;
  }
  void** get() { return pointers_.data(); }
  const std::vector<void*>& pointers() const { return pointers_; }
  const std::vector<std::vector<std::uint32_t>>& bits() const { return columns_; }

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<std::uint32_t>> columns_;
  std::vector<void*> pointers_;
};

/// What nacre_run computes, `at_once` points a batch.
std::vector<std::vector<std::uint32_t>> run(const Shader& shader, nacre_entry entry,
                                            const Columns& inputs, std::size_t count,
                                            std::size_t at_once,
                                            const Instance* instance = nullptr) {
  Columns results(shader.results(entry), count);
  Binder binder;
  inputs.bind(binder, 0);
  results.bind(binder, static_cast<std::uint32_t>(inputs.pointers().size()));
  const Binding binding(binder, shader, 1u << entry);
  for (std::size_t first = 0; first < count; first += at_once) {
    std::vector<void*> arrays;
    for (const Columns* columns : {&inputs, static_cast<const Columns*>(&results)}) {
      for (void* const column : columns->pointers()) {
        arrays.push_back(static_cast<std::uint32_t*>(column) + first);
      }
    }
    Batch batch;
    batch.count = at_once;
    binding.run(entry, arrays, batch, instance);
  }
  return results.bits();
}

class ApiCode : public testing::Test {
 protected:
  Shader compile(const CompileOptions& options) {
    return system.compile_material(
        Document::parse(surface_document("0.8, 0.4, 0.1", "0.5").c_str()), "M", options);
  }
  System system;
};

constexpr std::size_t count = 16 * 7;  // Whole passes of any code.

TEST_F(ApiCode, GivesTheBitsOfARun) {
  CompileOptions options;
  options.single_points = true;
  options.live = {"S/base_color"};
  options.no_footprints = true;
  std::array<std::vector<std::vector<std::vector<std::uint32_t>>>, 2> all;
  for (const bool is_fitted : {false, true}) {
    options.fit_parameters = is_fitted;
    const Shader shader = compile(options);
    Instance instance(shader);
    instance.set("S/base_color", {0.1f, 0.9f, 0.3f});
    const FloatEnvironment environment;
    for (const nacre_entry entry : {NACRE_BEGIN, NACRE_EVALUATE, NACRE_SAMPLE, NACRE_ALBEDO}) {
      Columns inputs(shader.inputs(entry), count);
      inputs.fill(entry);
      const auto expected = run(shader, entry, inputs, count, count, &instance);
      all[is_fitted ? 1 : 0].push_back(expected);
      for (const bool single : {false, true}) {
        const Code code(shader, entry, &instance, single);
        EXPECT_EQ(code.lanes() == 1, single);
        Columns results(shader.results(entry), count);
        EXPECT_EQ(code(inputs.get(), results.get(), count), NACRE_OK);
        EXPECT_EQ(results.bits(), expected) << entry << single << is_fitted;
        EXPECT_EQ(nacre_code_function(code.get()), code.function());
      }
    }
  }
  EXPECT_TRUE(all[0] != all[1]);
}

TEST_F(ApiCode, SinglePointsHaveTheBitsOfMany) {
  CompileOptions options;
  options.single_points = true;
  options.no_footprints = true;
  for (const bool in_background : {false, true}) {
    options.background = in_background;
    const Shader shader = compile(options);
    shader.wait();
    EXPECT_FALSE(shader.is_pending());
    for (const nacre_entry entry : {NACRE_BEGIN, NACRE_EVALUATE, NACRE_SAMPLE}) {
      Columns inputs(shader.inputs(entry), count);
      inputs.fill(entry);
      EXPECT_EQ(run(shader, entry, inputs, count, 1), run(shader, entry, inputs, count, count));
    }
  }
}

TEST_F(ApiCode, OutlivesItsShaderAndReadsImages) {
  std::vector<float> texels{0.25f, 0.5f, 0.75f};
  Image image;
  image.width = image.height = 1;
  image.channels = 3;
  image.samples = NACRE_FLOAT32;
  image.pixels = texels.data();
  system.set_image("painted", image);
  std::unique_ptr<Code> code;
  std::size_t input_count = 0;
  {
    CompileOptions options;
    options.no_footprints = true;
    const Shader shader = system.compile_outputs(
        Document::parse(R"(<materialx version="1.39"><image name="i" type="color3">
          <input name="file" type="filename" value="painted"/></image>
          <output name="out" type="color3" nodename="i"/></materialx>)"),
        {"out"}, options);
    input_count = shader.inputs(NACRE_OUTPUTS).size();
    code = std::make_unique<Code>(shader, NACRE_OUTPUTS);
  }
  system.remove_image("painted");
  const auto lanes = static_cast<std::size_t>(code->lanes());
  std::vector<float> zeros(lanes), results(3 * lanes);
  const std::vector<const void*> inputs(input_count, zeros.data());
  void* const outputs[] = {results.data(), results.data() + lanes, results.data() + 2 * lanes};
  const FloatEnvironment environment;
  EXPECT_EQ((*code)(inputs.data(), outputs, lanes), NACRE_OK);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(results[i * lanes], texels[i]);
}

std::string refusal(const Shader& shader, nacre_entry entry, bool single) {
  try {
    const Code code(shader, entry, nullptr, single);
  } catch (const Error& error) {
    return error.diagnostics().empty() ? "refused" : error.diagnostics().front().code;
  }
  return "";
}

TEST_F(ApiCode, IsRefusedWhereThereIsNone) {
  CompileOptions options;
  const Shader shader = compile(options);
  EXPECT_EQ(refusal(shader, NACRE_SAMPLE, false), "");
  EXPECT_EQ(refusal(shader, NACRE_SAMPLE, true), "no-code");
  EXPECT_EQ(refusal(shader, NACRE_LIGHT, false), "no-code");
  EXPECT_EQ(refusal(shader, NACRE_EVALUATE_AT, false), "refused");
  options.lanes = 1;
  EXPECT_EQ(refusal(compile(options), NACRE_SAMPLE, true), "");
  options.engine = NACRE_INTERPRETER;
  EXPECT_EQ(refusal(compile(options), NACRE_SAMPLE, false), "no-code");
  const Code code(shader, NACRE_ALBEDO);
  if (code.lanes() > 1) {
    EXPECT_EQ(code(nullptr, nullptr, 1), NACRE_WRONG_ARGUMENTS);
  }
  EXPECT_EQ(code(nullptr, nullptr, 0), NACRE_OK);
}

// Intel SDM vol. 1, 10.2.3, and what C says of rounding.
TEST_F(ApiCode, EnvironmentIsTheKernelsAndThenTheHostsOwn) {
  std::fesetround(FE_UPWARD);
  const volatile float denormal = 1e-40f;
  {
    const FloatEnvironment environment;
    EXPECT_EQ(denormal * 1.0f, 0.0f);
    const volatile float one = 1.0f;
    EXPECT_EQ(one + 0x1p-26f, 1.0f);
  }
  EXPECT_GT(denormal * 1.0f, 0.0f);
  const volatile float one = 1.0f;
  EXPECT_GT(one + 0x1p-26f, 1.0f);
  std::fesetround(FE_TONEAREST);
}

}  // namespace
}  // namespace nacre
