// RixBxdf's lobes: which are wanted goes in with each point (RixBXLobeTraits), which were sampled
// or evaluated comes out, and so do the parts of each.
#include "tests/jit/api/rix_bxdf.h"

namespace nacre {
namespace {

constexpr int every = NACRE_DIFFUSE_REFLECTION | NACRE_GLOSSY_REFLECTION |
                      NACRE_DIFFUSE_TRANSMISSION | NACRE_GLOSSY_TRANSMISSION |
                      NACRE_DELTA_REFLECTION | NACRE_DELTA_TRANSMISSION;
constexpr int kinds_of_all[] = {NACRE_DIFFUSE_REFLECTION,   NACRE_GLOSSY_REFLECTION,
                                NACRE_DIFFUSE_TRANSMISSION, NACRE_GLOSSY_TRANSMISSION,
                                NACRE_DELTA_REFLECTION,     NACRE_DELTA_TRANSMISSION};
constexpr int transmissions =
    NACRE_DIFFUSE_TRANSMISSION | NACRE_GLOSSY_TRANSMISSION | NACRE_DELTA_TRANSMISSION;

class RixBxdfLobes : public RixBxdfPage {
 protected:
  static Shader wanting(const std::string& nodes) {
    CompileOptions options;
    options.lobes_wanted = options.by_lobe = options.reverse_pdf = true;
    return compile(surface_of(nodes), options);
  }
  static Columns asked(const Shader& shader, nacre_entry entry, int wanted, Columns in,
                       std::size_t count = 1) {
    in["lobes_wanted"] = {bits(wanted)};
    return ask(shader, entry, in, count);
  }
  /// Rough glass, a leaf, paper and a mirror, in one.
  static std::string many() {
    return lobe("dielectric_bsdf", given("scatter_mode", "string", "RT") + facets("0.3"), "glass") +
           lobe("translucent_bsdf", "", "leaf") + lobe("oren_nayar_diffuse_bsdf", "", "paper") +
           lobe("conductor_bsdf", facets("0"), "mirror") + both("paper", "leaf", "0.6", "thin") +
           both("mirror", "glass", "0.3", "shiny") + both("thin", "shiny", "0.5");
  }
};

// Each kind alone, together all: f adds up, and so do the parts of each lobe.
TEST_F(RixBxdfLobes, KindsAddUp) {
  const Shader shader = wanting(many());
  const std::vector<Direction> wi = sphere(80);
  const Columns in = directions({direction(35)}, wi);
  const Columns all = asked(shader, NACRE_EVALUATE, every, in, wi.size());
  std::map<std::string, std::vector<double>> sums;
  for (const int kind : kinds_of_all) {
    const Columns part = asked(shader, NACRE_EVALUATE, kind, in, wi.size());
    for (const auto& [name, column] : part) {
      sums[name].resize(wi.size());
      for (std::size_t i = 0; i < wi.size(); ++i) {
        sums[name][i] += static_cast<double>(column[i]);
        if (name != "f.x") continue;
        // What f is of is what was wanted, on that side.
        ASSERT_EQ(integer(part.at("kinds")[i]), column[i] > 0 ? kind : 0);
        if (column[i] == 0) continue;
        ASSERT_EQ((kind & transmissions) != 0, wi[i].z < 0) << kind << ' ' << i;
      }
    }
  }
  std::size_t shared = 0;
  for (const auto& [name, sum] : sums) {
    if (!name.starts_with("f.")) continue;
    for (std::size_t i = 0; i < wi.size(); ++i) {
      const double expected = static_cast<double>(all.at(name)[i]);
      ASSERT_NEAR(sum[i], expected, 1e-6 * expected) << name << ' ' << i;
    }
  }
  for (std::size_t i = 0; i < wi.size(); ++i) {
    const int kinds = integer(all.at("kinds")[i]);
    shared += kinds == (NACRE_DIFFUSE_REFLECTION | NACRE_GLOSSY_REFLECTION) ||
                      kinds == (NACRE_DIFFUSE_TRANSMISSION | NACRE_GLOSSY_TRANSMISSION)
                  ? 1
                  : 0;
  }
  EXPECT_GT(shared, wi.size() / 4);
}

// All wanted is what it is without being asked.
TEST_F(RixBxdfLobes, AllAreTheSameAsNoQuestion) {
  CompileOptions options;
  options.by_lobe = options.reverse_pdf = true;
  const Shader plain = compile(surface_of(many()), options);
  const Shader shader = wanting(many());
  const Columns in = directions({direction(35)}, sphere(50));
  const Columns expected = ask(plain, NACRE_EVALUATE, in, 50);
  const Columns found = asked(shader, NACRE_EVALUATE, every, in, 50);
  EXPECT_EQ(found.size(), expected.size() + 1);  // And kinds.
  for (const auto& [name, column] : expected) {
    for (std::size_t i = 0; i < 50; ++i) {
      ASSERT_NEAR(found.at(name)[i], column[i], 1e-5f * column[i]) << name << ' ' << i;
    }
  }
  for (const nacre_entry entry : {NACRE_SAMPLE, NACRE_EVALUATE}) {
    for (const Channel& input : plain.inputs(entry)) EXPECT_NE(input.name, "lobes_wanted");
    for (const Channel& result : plain.results(entry)) EXPECT_NE(result.name, "kinds");
  }
}

// Densities are of what is wanted: paper alone has that of a cosine, whatever it is mixed with.
TEST_F(RixBxdfLobes, DensitiesAreOfWhatIsWanted) {
  const Shader shader = wanting(many());
  const Direction wo = direction(35), wi = direction(50, 200);
  const Columns paper =
      asked(shader, NACRE_EVALUATE, NACRE_DIFFUSE_REFLECTION, directions({wo}, {wi}));
  EXPECT_FLOAT_EQ(paper.at("pdf")[0], wi.z / pi);
  EXPECT_FLOAT_EQ(paper.at("pdf_reverse")[0], wo.z / pi);
  EXPECT_NEAR(paper.at("f.x")[0], 0.5f * 0.6f * 0.18f * wi.z / pi, 1e-8f);
  // Of rough glass by each side: the density integrates to the share of samples that are none.
  const Shader glass =
      wanting(lobe("dielectric_bsdf", given("scatter_mode", "string", "RT") + facets("0.4")));
  constexpr std::size_t count = 20000;
  for (const int kind : {NACRE_GLOSSY_REFLECTION, NACRE_GLOSSY_TRANSMISSION}) {
    const Columns over = asked(glass, NACRE_EVALUATE, kind, directions({wo}, sphere(count)), count);
    const Columns sample = asked(glass, NACRE_SAMPLE, kind, random(wo, count), count);
    double valid = 0;
    for (std::size_t i = 0; i < count; ++i) valid += is_valid(sample, i) ? 1.0 / count : 0;
    EXPECT_NEAR(mean(over.at("pdf")) * 4 * std::numbers::pi, valid, 0.01) << kind;
    EXPECT_GT(valid, 0.8);  // The others are reflected to below, or not refracted.
    EXPECT_NEAR(mean(over.at("f.x")) * 4 * std::numbers::pi, mean(sample.at("weight.x")), 0.01);
  }
}

// BeginScatter is told what is wanted as well: a mask that the state is made for, here of each
// point.
TEST_F(RixBxdfLobes, BeginScatterHasAMask) {
  CompileOptions options;
  options.lobe_mask = true;
  options.varying = {"lobe_mask"};
  const Shader shader = compile(surface_of(many()), options);
  const Direction wi = direction(50, 200);
  Columns in = directions({direction(35)}, {wi});
  in["lobe_mask"] = {bits(NACRE_DIFFUSE_REFLECTION), bits(NACRE_DIFFUSE_TRANSMISSION), bits(15)};
  const Columns value = ask(shader, NACRE_EVALUATE, in, 3);
  EXPECT_FLOAT_EQ(value.at("pdf")[0], wi.z / pi);
  EXPECT_EQ(value.at("pdf")[1], 0.0f);
  EXPECT_LT(value.at("pdf")[2], value.at("pdf")[0]);
}

// What is sampled is what was wanted, and says so; weight pdf is f of the same question.
TEST_F(RixBxdfLobes, SamplesAreOfWhatIsWanted) {
  const Shader shader = wanting(many());
  const std::vector<LobeInfo> lobes = shader.lobes();
  constexpr std::size_t count = 400;
  for (const int wanted :
       {+NACRE_DIFFUSE_REFLECTION, +NACRE_DIFFUSE_TRANSMISSION, +NACRE_GLOSSY_REFLECTION,
        +NACRE_GLOSSY_TRANSMISSION, +NACRE_DELTA_REFLECTION,
        NACRE_DIFFUSE_REFLECTION | NACRE_GLOSSY_TRANSMISSION}) {
    Columns in = random(direction(35), count);
    const Columns sample = asked(shader, NACRE_SAMPLE, wanted, in, count);
    put(in, "wi", sampled(sample));
    const Columns value = asked(shader, NACRE_EVALUATE, wanted, in, count);
    std::size_t valid = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_valid(sample, i)) continue;
      ++valid;
      const int kind = integer(sample.at("kinds")[i]);
      const int flags = integer(sample.at("flags")[i]);
      ASSERT_NE(kind & wanted, 0);
      ASSERT_EQ((flags & NACRE_SAMPLE_DELTA) != 0, kind == NACRE_DELTA_REFLECTION);
      ASSERT_EQ((flags & NACRE_SAMPLE_TRANSMISSION) != 0, (kind & transmissions) != 0);
      const auto index = static_cast<std::size_t>(integer(sample.at("lobe")[i]));
      const int of_lobe = lobes.at(index).kinds;
      ASSERT_NE((kind == NACRE_DELTA_REFLECTION ? NACRE_GLOSSY_REFLECTION : kind) & of_lobe, 0);
      if (kind == NACRE_DELTA_REFLECTION) continue;
      const float f = sample.at("weight.x")[i] * sample.at("pdf")[i];
      ASSERT_NEAR(value.at("pdf")[i], sample.at("pdf")[i], 1e-4f * sample.at("pdf")[i]);
      ASSERT_NEAR(value.at("f.x")[i], f, 2e-4f * f);
      const std::string part = "weight.lobe" + std::to_string(index) + ".x";
      ASSERT_GT(sample.at(part)[i], 0.0f);
    }
    EXPECT_GT(valid, count * 3 / 4) << wanted;
  }
}

// Smooth is not rough: a mirror is of no glossy question, and the other way round.
TEST_F(RixBxdfLobes, SmoothAndRoughAreApart) {
  for (const bool is_smooth : {true, false}) {
    const Shader metal = wanting(lobe("conductor_bsdf", facets(is_smooth ? "0" : "0.3")));
    const Shader glass = wanting(lobe("dielectric_bsdf", given("scatter_mode", "string", "RT") +
                                                             facets(is_smooth ? "0" : "0.3")));
    const auto share = [](const Shader& shader, int wanted) {
      const Columns sample = asked(shader, NACRE_SAMPLE, wanted, random(direction(20), 500), 500);
      double valid = 0;
      for (std::size_t i = 0; i < 500; ++i) valid += is_valid(sample, i) ? 1.0 / 500 : 0;
      return valid;
    };
    const int reflects = is_smooth ? NACRE_DELTA_REFLECTION : NACRE_GLOSSY_REFLECTION;
    const int passes = is_smooth ? NACRE_DELTA_TRANSMISSION : NACRE_GLOSSY_TRANSMISSION;
    EXPECT_GT(share(metal, reflects), 0.9);
    EXPECT_EQ(share(metal, every & ~reflects), 0.0);
    EXPECT_GT(share(glass, reflects), 0.9);  // Nearly all samples, though glass reflects 4 %.
    EXPECT_GT(share(glass, passes), 0.9);
    EXPECT_EQ(share(glass, every & ~(reflects | passes)), 0.0);
  }
}

// Wanted of nothing, or none of what there is: no light, no density, no sample.
TEST_F(RixBxdfLobes, NothingWantedIsNothing) {
  const Shader shader = wanting(many());
  for (const int wanted : {0, +NACRE_DELTA_TRANSMISSION}) {
    const Columns value =
        asked(shader, NACRE_EVALUATE, wanted, directions({direction(35)}, sphere(20)), 20);
    const Columns sample = asked(shader, NACRE_SAMPLE, wanted, random(direction(35), 20), 20);
    for (std::size_t i = 0; i < 20; ++i) {
      for (const char* name : {"f.x", "pdf", "pdf_reverse"}) EXPECT_EQ(value.at(name)[i], 0.0f);
      for (const char* name : {"weight.x", "pdf", "pdf_reverse"}) {
        EXPECT_EQ(sample.at(name)[i], 0.0f);
      }
      EXPECT_EQ(integer(value.at("kinds")[i]) | integer(sample.at("kinds")[i]), 0);
      EXPECT_EQ(integer(sample.at("flags")[i]), 0);
    }
  }
}

// A fibre has both sides and sends its light where it likes: samples on the other side are lost,
// and what is left has the weight of what is wanted.
TEST_F(RixBxdfLobes, FibresLoseSamplesOfTheOtherSide) {
  const Shader hair = wanting(lobe("chiang_hair_bsdf", ""));
  constexpr std::size_t count = 4000;
  double sum = 0;
  for (const int kind : {NACRE_GLOSSY_REFLECTION, NACRE_GLOSSY_TRANSMISSION}) {
    const Columns sample = asked(hair, NACRE_SAMPLE, kind, random(direction(40), count), count);
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_valid(sample, i)) continue;
      ASSERT_EQ(sample.at("wi.z")[i] < 0, kind != NACRE_GLOSSY_REFLECTION);
    }
    sum += mean(sample.at("weight.x"));
  }
  const Columns all = asked(hair, NACRE_SAMPLE, every, random(direction(40), count), count);
  EXPECT_NEAR(sum, mean(all.at("weight.x")), 1e-4);
}

// One call for all of it, with machine code: the same bits.
TEST_F(RixBxdfLobes, MachineCodeAndShadeGiveTheSame) {
  CompileOptions options;
  options.lobes_wanted = options.transport = true;
  options.entries = 1u << NACRE_SHADE | 1u << NACRE_SAMPLE | 1u << NACRE_EVALUATE;
  const std::string document =
      surface_of(lobe("dielectric_bsdf", given("scatter_mode", "string", "RT") + facets("0.3")));
  const Shader code = compile(document, options, NACRE_JIT);
  const Shader interpreted = compile(document, options);
  Columns in = random(direction(35), 40);
  put(in, "wi", sphere(40));
  in["transport"] = {bits(NACRE_RADIANCE)};
  for (std::size_t i = 0; i < 40; ++i) in["lobes_wanted"].push_back(bits(kinds_of_all[i % 6]));
  const Columns shade = ask(code, NACRE_SHADE, in, 40);
  for (const nacre_entry entry : {NACRE_SAMPLE, NACRE_EVALUATE}) {
    const Columns one = ask(interpreted, entry, in, 40);
    for (const auto& [name, column] : ask(code, entry, in, 40)) {
      const bool is_plain = entry == NACRE_EVALUATE || name == "lobe" || name == "flags";
      const std::vector<float>& together = shade.at((is_plain ? "" : "next.") + name);
      for (std::size_t i = 0; i < 40; ++i) {
        ASSERT_EQ(integer(column[i]), integer(one.at(name)[i])) << name << ' ' << i;
        if (name == "lobe" || name == "flags" || name == "kinds") {
          ASSERT_EQ(integer(together[i]), integer(column[i])) << name << ' ' << i;
          continue;
        }
        ASSERT_NEAR(together[i], column[i], 2e-5f * std::abs(column[i]) + 1e-6f) << name;
      }
    }
  }
}

}  // namespace
}  // namespace nacre
