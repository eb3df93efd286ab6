// What one call can give besides the usual: results of the point with `begin`, everything with
// `shade`, parts by lobe, and fewer kernels.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>
#include <nacre/nacre.hpp>
#include <string>
#include <vector>

#include "tests/jit/api/surface_points.h"

namespace nacre {
namespace {

constexpr std::size_t count = 800;

/// A noisy coat over a diffuse base that emits and is partly there; the normal of the base leans.
constexpr const char* noisy = R"(<materialx version="1.39">
  <nodegraph name="NG">
    <fractal3d name="noise" type="float"><input name="octaves" type="integer" value="3"/></fractal3d>
    <add name="lifted" type="float"><input name="in1" type="float" nodename="noise"/>
      <input name="in2" type="float" value="1.5"/></add>
    <multiply name="color" type="color3"><input name="in1" type="color3" value="0.2, 0.3, 0.1"/>
      <input name="in2" type="float" nodename="lifted"/></multiply>
    <output name="out" type="color3" nodename="color"/>
    <output name="presence" type="float" nodename="lifted"/>
  </nodegraph>
  <constant name="leaning" type="vector3"><input name="value" type="vector3" value="0.6, 0, 0.8"/></constant>
  <standard_surface name="S" type="surfaceshader">
    <input name="base_color" type="color3" nodegraph="NG" output="out"/>
    <input name="coat" type="float" value="0.5"/>
    <input name="specular_roughness" type="float" value="0.4"/>
    <input name="normal" type="vector3" nodename="leaning"/>
    <input name="emission" type="float" value="0.5"/>
    <input name="emission_color" type="color3" nodegraph="NG" output="out"/>
    <input name="opacity" type="color3" value="0.25, 0.5, 0.75"/>
  </standard_surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>)";

/// A material of one lobe.
std::string of_lobe(const std::string& lobe) {
  return R"(<materialx version="1.39">)" + lobe + R"(
    <surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="lobe"/></surface>
    <surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  </materialx>)";
}

class PointResults : public ::testing::Test {
 protected:
  static Shader compile(const std::string& text, const CompileOptions& options = {}) {
    static System system;
    return system.compile_material(Document::parse(text), "M", options);
  }

  /// All results of an entry, a column each; the state goes where it always is.
  std::map<std::string, std::vector<float>> run(const Shader& shader, nacre_entry entry) {
    std::map<std::string, std::vector<float>> columns;
    Binder binder = points.binder();
    std::vector<void*> arrays = points.arrays();
    for (const Channel& channel : shader.results(entry)) {
      if (channel.role == NACRE_STATE) continue;
      std::vector<float>& column = columns[channel.name];
      column.assign(count, -1.0f);
      binder.array(channel.name, {static_cast<std::uint32_t>(arrays.size())});
      arrays.push_back(column.data());
    }
    Batch batch;
    batch.count = count;
    Binding(binder, shader, 1u << entry).run(entry, arrays, batch);
    return columns;
  }

  SurfacePoints points{count};
};

CompileOptions with_begin(std::vector<std::string> names) {
  CompileOptions options;
  options.with_begin = std::move(names);
  return options;
}

TEST_F(PointResults, OfBeginAreThoseOfTheirOwnKernels) {
  const Shader shader = compile(noisy, with_begin({"albedo", "emission", "opacity"}));
  const auto together = run(shader, NACRE_BEGIN);
  EXPECT_EQ(together.size(), 3u + 3 + 4);
  for (const nacre_entry entry : {NACRE_ALBEDO, NACRE_EMISSION, NACRE_OPACITY}) {
    for (const auto& [name, column] : run(shader, entry)) {
      ASSERT_EQ(together.at(name), column) << name;
      EXPECT_NE(column[0], -1.0f) << name;
    }
  }
}

TEST_F(PointResults, AreThereIfConstantToo) {
  const Shader shader = compile(of_lobe(R"(<oren_nayar_diffuse_bsdf name="lobe" type="BSDF"/>)"),
                                with_begin({"emission", "opacity"}));
  EXPECT_FALSE(shader.has(NACRE_EMISSION));
  const auto results = run(shader, NACRE_BEGIN);
  EXPECT_EQ(results.at("emission.y"), std::vector<float>(count, 0.0f));
  EXPECT_EQ(results.at("opacity"), std::vector<float>(count, 1.0f));
  EXPECT_EQ(results.at("transmission.z"), std::vector<float>(count, 0.0f));
}

TEST_F(PointResults, HaveTheNormalThatIsShadedBy) {
  const auto results = run(compile(of_lobe(R"(
    <constant name="leaning" type="vector3"><input name="value" type="vector3" value="0.6, 0, 0.8"/></constant>
    <oren_nayar_diffuse_bsdf name="lobe" type="BSDF">
      <input name="normal" type="vector3" nodename="leaning"/></oren_nayar_diffuse_bsdf>)"),
                                   with_begin({"normal", "roughness"})),
                           NACRE_BEGIN);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& wo = points.points[i].wo;
    // Where it turns away from a viewer who sees the front, or to one behind, it is mirrored at the
    // plane across the view.
    const float seen = 0.6f * wo[0] + 0.8f * wo[2];
    const float twice = seen * wo[2] < 0 ? 2 * seen : 0.0f;
    const float side = wo[2] < 0 ? -1.0f : 1.0f;
    ASSERT_NEAR(results.at("normal.x")[i], side * (0.6f - twice * wo[0]), 1e-6f);
    ASSERT_NEAR(results.at("normal.z")[i], side * (0.8f - twice * wo[2]), 1e-6f);
  }
  EXPECT_EQ(results.at("roughness"), std::vector<float>(count, 1.0f));
}

TEST_F(PointResults, OfAMixtureLieBetweenThoseOfItsLobes) {
  const auto results = run(compile(noisy, with_begin({"normal", "roughness"})), NACRE_BEGIN);
  for (std::size_t i = 0; i < count; ++i) {
    const float x = results.at("normal.x")[i], y = results.at("normal.y")[i],
                z = results.at("normal.z")[i];
    ASSERT_NEAR(x * x + y * y + z * z, 1, 1e-5f);
    ASSERT_GT(results.at("roughness")[i], 0.1f);  // Of the coat.
    ASSERT_LT(results.at("roughness")[i], 1.0f);
  }
}

TEST_F(PointResults, OfFacetsAreTheRootOfAlpha) {
  const auto results = run(compile(of_lobe(R"(<conductor_bsdf name="lobe" type="BSDF">
                           <input name="roughness" type="vector2" value="0.25, 0.25"/></conductor_bsdf>)"),
                                   with_begin({"roughness"})),
                           NACRE_BEGIN);
  EXPECT_EQ(results.at("roughness"), std::vector<float>(count, 0.5f));
}

TEST_F(PointResults, HaveValuesOfTheGraph) {
  const Shader shader =
      compile(noisy, with_begin({"NG/lifted", "S/base_color", "NG/out", "S/coat", "S/sheen"}));
  const auto results = run(shader, NACRE_BEGIN);
  EXPECT_EQ(results.at("S/coat"), std::vector<float>(count, 0.5f));
  EXPECT_EQ(results.at("S/sheen"), std::vector<float>(count, 0.0f));  // The nodedef's default.
  EXPECT_EQ(results.at("S/base_color.y"), results.at("NG/out.y"));
  static System system;
  const Shader alone = system.compile_outputs(Document::parse(noisy), {"NG/presence", "NG/out"});
  const auto expected = run(alone, NACRE_OUTPUTS);
  EXPECT_EQ(results.at("NG/lifted"), expected.at("NG/presence"));
  EXPECT_EQ(results.at("NG/out.x"), expected.at("NG/out.x"));
}

TEST_F(PointResults, ComeOnceWithWhateverReadsTheState) {
  CompileOptions options = with_begin({"albedo", "S/coat", "albedo", "S/coat"});
  options.entries = 1u << NACRE_EVALUATE;
  std::map<std::string, int> seen;
  for (const Channel& each : compile(noisy, options).results(NACRE_BEGIN)) ++seen[each.name];
  EXPECT_EQ(seen["albedo.x"], 1);
  EXPECT_EQ(seen["S/coat"], 1);
}

TEST_F(PointResults, OfASurfaceAreErrorsWithoutOne) {
  const char* const medium = R"(<materialx version="1.39">
    <absorption_vdf name="v" type="VDF"/>
    <volume name="V" type="volumeshader"><input name="vdf" type="VDF" nodename="v"/></volume>
    <volumematerial name="M" type="material">
      <input name="volumeshader" type="volumeshader" nodename="V"/></volumematerial></materialx>)";
  try {
    compile(medium, with_begin({"albedo"}));
    FAIL() << "nothing was said";
  } catch (const Error& error) {
    EXPECT_EQ(error.diagnostics().front().code, "unknown-request");
    EXPECT_EQ(error.diagnostics().front().path, "M");
  }
}

TEST_F(PointResults, ThatNobodyKnowsAreErrors) {
  const auto code_of = [&](const char* name) {
    try {
      compile(noisy, with_begin({name}));
    } catch (const Error& error) {
      return error.diagnostics().front().code;
    }
    return std::string("none");
  };
  EXPECT_EQ(code_of("NG/nothing"), "unknown-request");
  EXPECT_EQ(code_of("albedos"), "unknown-request");
  EXPECT_EQ(code_of("S"), "not-numeric");
  EXPECT_NE(code_of("S/nothing"), "none");
}

TEST_F(PointResults, PartsByLobeAddUpToTheWhole) {
  CompileOptions options;
  options.by_lobe = true;
  const Shader shader = compile(noisy, options);
  const std::size_t lobes = shader.lobes().size();
  ASSERT_GT(lobes, 1u);
  for (const LobeInfo& lobe : shader.lobes()) {
    EXPECT_TRUE(lobe.path.starts_with("S/")) << lobe.path;
    EXPECT_NE(lobe.kinds, 0);
  }
  run(shader, NACRE_BEGIN);
  const auto sample = run(shader, NACRE_SAMPLE);
  for (std::size_t i = 0; i < count; ++i) {
    points.wi[3 * i] = sample.at("wi.x")[i];
    points.wi[3 * i + 1] = sample.at("wi.y")[i];
    points.wi[3 * i + 2] = sample.at("wi.z")[i];
  }
  const auto evaluate = run(shader, NACRE_EVALUATE);
  std::size_t shared = 0;  // Directions that several lobes scatter to.
  for (const auto& [whole, results] :
       {std::pair{std::string("f"), evaluate}, {std::string("weight"), sample}}) {
    for (const char* component : {".x", ".y", ".z"}) {
      for (std::size_t i = 0; i < count; ++i) {
        float sum = 0;
        int parts = 0;
        for (std::size_t k = 0; k < lobes; ++k) {
          const float part = results.at(whole + ".lobe" + std::to_string(k) + component)[i];
          ASSERT_GE(part, 0);
          sum += part;
          parts += part > 0 ? 1 : 0;
        }
        shared += parts > 1 ? 1 : 0;
        const float expected = results.at(whole + component)[i];
        ASSERT_NEAR(sum, expected, 4e-7f * static_cast<float>(lobes) * expected) << whole << i;
      }
    }
  }
  EXPECT_GT(shared, count);
}

TEST_F(PointResults, OfAMirrorBelongToTheLobeThatWasChosen) {
  CompileOptions options;
  options.by_lobe = true;
  const Shader shader = compile(of_lobe(R"(
    <conductor_bsdf name="mirror" type="BSDF"><input name="roughness" type="vector2" value="0, 0"/></conductor_bsdf>
    <oren_nayar_diffuse_bsdf name="diffuse" type="BSDF"/>
    <mix name="lobe" type="BSDF"><input name="fg" type="BSDF" nodename="mirror"/>
      <input name="bg" type="BSDF" nodename="diffuse"/><input name="mix" type="float" value="0.5"/></mix>)"),
                                options);
  run(shader, NACRE_BEGIN);
  const auto sample = run(shader, NACRE_SAMPLE);
  const auto& flags = sample.at("flags");
  std::size_t mirrored = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_delta = (std::bit_cast<std::int32_t>(flags[i]) & NACRE_SAMPLE_DELTA) != 0;
    mirrored += is_delta ? 1 : 0;
    const std::string mine = is_delta ? "weight.lobe0.x" : "weight.lobe1.x";
    const std::string other = is_delta ? "weight.lobe1.x" : "weight.lobe0.x";
    ASSERT_EQ(sample.at(other)[i], 0.0f);
    ASSERT_NEAR(sample.at(mine)[i], sample.at("weight.x")[i], 1e-6f);
  }
  EXPECT_GT(mirrored, count / 4);
}

TEST_F(PointResults, OfShadeAreThoseOfOneKernelAfterAnother) {
  CompileOptions options = with_begin({"albedo", "normal", "NG/lifted"});
  options.entries =
      1u << NACRE_SHADE | 1u << NACRE_BEGIN | 1u << NACRE_SAMPLE | 1u << NACRE_EVALUATE;
  const Shader shader = compile(noisy, options);
  for (std::size_t i = 0; i < count; ++i) {
    points.wi[3 * i] = -points.points[i].wo[0];
    points.wi[3 * i + 1] = -points.points[i].wo[1];
    points.wi[3 * i + 2] = points.points[i].wo[2];
  }
  auto apart = run(shader, NACRE_BEGIN);
  for (const auto& [name, column] : run(shader, NACRE_EVALUATE)) apart[name] = column;
  for (const auto& [name, column] : run(shader, NACRE_SAMPLE)) {
    apart[name == "lobe" || name == "flags" ? name : "next." + name] = column;
  }
  const auto together = run(shader, NACRE_SHADE);
  ASSERT_EQ(together.size(), apart.size());
  for (const auto& [name, column] : together) {
    for (std::size_t i = 0; i < count; ++i) {
      // Nothing was rounded to be stored in between but where a product is added to.
      ASSERT_NEAR(column[i], apart.at(name)[i], 2e-5f * std::abs(column[i]) + 1e-6f) << name << i;
    }
  }
}

TEST_F(PointResults, OfOnePointAloneComeWithTheirState) {
  CompileOptions options;
  options.entries = 1u << NACRE_EVALUATE_AT;
  const Shader alone = compile(noisy, options);
  options.entries |= 1u << NACRE_EVALUATE;
  const Shader with_evaluate = compile(noisy, options);
  EXPECT_TRUE(alone.has(NACRE_BEGIN));
  EXPECT_GT(alone.state_count(), 0u);
  EXPECT_EQ(alone.state_count(), with_evaluate.state_count());
}

TEST_F(PointResults, OfOnePointAndManyDirectionsAreThoseOfEvaluate) {
  CompileOptions options;
  options.entries = 1u << NACRE_EVALUATE | 1u << NACRE_EVALUATE_AT;
  options.live = {"S/*"};
  options.varying = {"S/coat"};
  const Shader shader = compile(noisy, options);
  constexpr std::size_t directions = 37;
  std::vector<float> wi(3 * directions), f(3 * directions, -1.0f), pdf(directions);
  for (std::size_t i = 0; i < 3 * directions; ++i) wi[i] = points.points[i / 3].wo[i % 3];
  std::vector<float> coats(count, 0.25f);
  Binder binder = points.binder();
  std::vector<void*> arrays = points.arrays();
  const auto bind = [&](const char* name, std::vector<float>& numbers, std::ptrdiff_t stride) {
    binder.array(name, {static_cast<std::uint32_t>(arrays.size()), 0, stride});
    arrays.push_back(numbers.data());
  };
  bind("wi", wi, 12), bind("f", f, 12), bind("pdf", pdf, 4), bind("S/coat", coats, 4);
  const Binding binding(binder, shader);
  Batch batch;
  batch.count = count;
  binding.run(NACRE_BEGIN, arrays, batch);
  batch.count = directions;
  batch.point = 511;
  binding.run(NACRE_EVALUATE_AT, arrays, batch);
  const std::vector<float> found = f;
  // Evaluate takes the state and geometry of its own point: that one again and again.
  const std::vector<std::uint32_t> same(1, 511);
  for (std::size_t i = 0; i < directions; ++i) {
    Batch one;
    one.count = 1;
    one.points = same.data();
    std::vector<float> at(3 * count), density(count), towards(3 * count);
    for (std::size_t k = 0; k < 3; ++k) towards[3 * 511 + k] = wi[3 * i + k];
    std::vector<void*> moved = arrays;
    moved[arrays.size() - 4] = towards.data();
    moved[arrays.size() - 3] = at.data();
    moved[arrays.size() - 2] = density.data();
    binding.run(NACRE_EVALUATE, moved, one);
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_NEAR(found[3 * i + k], at[3 * 511 + k], 1e-5f * at[3 * 511 + k] + 1e-7f) << i;
    }
    ASSERT_NEAR(pdf[i], density[511], 1e-5f * density[511]) << i;
  }
}

TEST_F(PointResults, OnlyWhatARayAsksIsCompiled) {
  CompileOptions options;
  options.entries = 1u << NACRE_OPACITY;
  const Shader shadow = compile(noisy, options);
  for (int entry = 0; entry < NACRE_ENTRY_COUNT; ++entry) {
    EXPECT_EQ(shadow.has(static_cast<nacre_entry>(entry)), entry == NACRE_OPACITY) << entry;
  }
  EXPECT_EQ(run(shadow, NACRE_OPACITY), run(compile(noisy), NACRE_OPACITY));
  options.entries = 1u << NACRE_EVALUATE;
  const Shader lit = compile(noisy, options);
  EXPECT_TRUE(lit.has(NACRE_BEGIN));
  EXPECT_FALSE(lit.has(NACRE_SAMPLE));
}

TEST_F(PointResults, PointsMayHaveNoExtent) {
  const std::string text = of_lobe(R"(
    <position name="place" type="vector3"/>
    <separate3 name="parts" type="multioutput"><input name="in" type="vector3" nodename="place"/></separate3>
    <heighttonormal name="bumpy" type="vector3"><input name="in" type="float" nodename="parts" output="outx"/></heighttonormal>
    <oren_nayar_diffuse_bsdf name="lobe" type="BSDF"><input name="normal" type="vector3" nodename="bumpy"/></oren_nayar_diffuse_bsdf>)");
  const auto reads_changes = [](const Shader& shader) {
    for (const Channel& channel : shader.inputs(NACRE_BEGIN)) {
      if (channel.name.starts_with("dP")) return true;
    }
    return false;
  };
  EXPECT_TRUE(reads_changes(compile(text)));
  CompileOptions options = with_begin({"bumpy"});
  options.no_footprints = true;
  const Shader shader = compile(text, options);
  EXPECT_FALSE(reads_changes(shader));
  // No slope is known: an encoded normal straight up.
  EXPECT_EQ(run(shader, NACRE_BEGIN).at("bumpy.z"), std::vector<float>(count, 1.0f));
}

TEST_F(PointResults, FacetsAreNoSmootherThanTheHostSays) {
  const auto metal = [](const char* alpha) {
    return of_lobe(std::string(R"(<conductor_bsdf name="lobe" type="BSDF">
      <input name="roughness" type="vector2" value=")") +
                   alpha + R"("/></conductor_bsdf>)");
  };
  CompileOptions options;
  options.min_alpha = true;
  const Shader mirror = compile(metal("0, 0"), options);
  const auto weights = [&](const Shader& shader, float least) {
    Instance instance(shader);
    if (least > 0) instance.set("min_alpha", least);
    points.shade(shader, &instance);
    return std::pair(points.f, points.flags);
  };
  const auto plain = weights(compile(metal("0, 0")), 0);
  EXPECT_EQ(weights(mirror, 0), plain);
  EXPECT_TRUE(plain.second[0] & NACRE_SAMPLE_DELTA);
  const auto rough = weights(compile(metal("0.25, 0.25")), 0);
  const auto raised = weights(mirror, 0.25f);
  EXPECT_EQ(raised.second, rough.second);
  for (std::size_t i = 0; i < 3 * count; ++i) {
    ASSERT_NEAR(raised.first[i], rough.first[i], 1e-5f * rough.first[i]) << i;
  }
}

}  // namespace
}  // namespace nacre
