// What kernels read that is fitted to values of live parameters.
#include <algorithm>
#include <array>
#include <thread>

#include "tests/jit/api/rix_bxdf.h"

namespace nacre {
namespace {

class LiveFits : public RixBxdfPage {
 protected:
  using Color = std::array<float, 3>;

  static Shader metal(int accuracy = NACRE_STANDARD, int engine = NACRE_JIT,
                      bool is_fitted = true) {
    CompileOptions options;
    options.live = {"*"};
    options.fit_parameters = is_fitted;
    options.accuracy = accuracy;
    return compile(surface_of(lobe("conductor_bsdf", facets("0.25"))), options, engine);
  }
  /// Indices of refraction of gold, aluminium and iron (https://refractiveindex.info), and others.
  static const std::vector<std::pair<Color, Color>>& indices() {
    static const std::vector<std::pair<Color, Color>> all = {
        {{0.143f, 0.375f, 1.442f}, {3.983f, 2.386f, 1.603f}},
        {{1.346f, 0.965f, 0.617f}, {7.475f, 6.400f, 5.303f}},
        {{2.911f, 2.950f, 2.585f}, {3.089f, 2.932f, 2.767f}},
        {{0.02f, 1.0f, 40.0f}, {0.0f, 30.0f, 1e-3f}},
    };
    return all;
  }
  static void set(Instance& instance, const std::pair<Color, Color>& metal) {
    const auto& [n, k] = metal;
    instance.set("b/ior", {n[0], n[1], n[2]});
    instance.set("b/extinction", {k[0], k[1], k[2]});
  }
  static Columns points() {
    const std::vector<Direction> wi = sphere(600);
    Columns in = random(direction(40, 10), wi.size());
    put(in, "wi", wi);
    return in;
  }
};

TEST_F(LiveFits, ChangedInstancesShadeAsFreshOnes) {
  const Shader shader = metal();
  const Columns in = points();
  Instance changed(shader);
  std::vector<Columns> first;
  for (int round = 0; round < 2; ++round) {
    for (std::size_t k = 0; k < indices().size(); ++k) {
      set(changed, indices()[k]);
      const Columns found = ask(shader, NACRE_EVALUATE, in, 600, 0, 0, &changed);
      Instance fresh(shader);
      set(fresh, indices()[k]);
      EXPECT_EQ(ask(shader, NACRE_EVALUATE, in, 600, 0, 0, &fresh), found) << k;
      if (round == 0) {
        first.push_back(found);
      } else {
        EXPECT_EQ(found, first[k]) << k;
      }
    }
  }
  EXPECT_NE(first[0], first[1]);
}

TEST_F(LiveFits, AreMadeWhereTheyAreAskedFor) {
  const Columns in = points();
  const auto evaluated = [&](bool is_fitted) {
    const Shader shader = metal(NACRE_STANDARD, NACRE_JIT, is_fitted);
    Instance instance(shader);
    set(instance, indices()[0]);
    return ask(shader, NACRE_EVALUATE, in, 600, 0, 0, &instance);
  };
  EXPECT_NE(evaluated(true), evaluated(false));
}

// `precise` fits nothing.
TEST_F(LiveFits, AreAsCloseAsTheyShouldBe) {
  const Columns in = points();
  for (const auto& [accuracy, error] : {std::pair{NACRE_STANDARD, 1.5e-4f}, {NACRE_FAST, 1e-2f}}) {
    const Shader shader = metal(accuracy), exact = metal(NACRE_PRECISE, NACRE_INTERPRETER);
    for (const auto& each : indices()) {
      Instance instance(shader), of_exact(exact);
      set(instance, each), set(of_exact, each);
      const Columns found = ask(shader, NACRE_EVALUATE, in, 600, 0, 0, &instance);
      const Columns wanted = ask(exact, NACRE_EVALUATE, in, 600, 0, 0, &of_exact);
      for (const char* channel : {"f.x", "f.y", "f.z"}) {
        const std::vector<float>&a = found.at(channel), &b = wanted.at(channel);
        for (std::size_t i = 0; i < a.size(); ++i) {
          ASSERT_NEAR(a[i], b[i], error * std::max(b[i], 1e-3f)) << channel << ' ' << i;
        }
      }
    }
  }
}

TEST_F(LiveFits, EnginesAndCallsOfAnyNumberOfPointsAgree) {
  const Shader shader = metal(), interpreted = metal(NACRE_STANDARD, NACRE_INTERPRETER);
  Instance instance(shader), other(interpreted);
  set(instance, indices()[1]), set(other, indices()[1]);
  Columns in = points();
  const Columns all = ask(shader, NACRE_EVALUATE, in, 600, 0, 0, &instance);
  EXPECT_EQ(ask(interpreted, NACRE_EVALUATE, in, 600, 0, 0, &other), all);
  for (const std::size_t i : {0u, 17u, 599u}) {
    Columns one;
    for (const auto& [name, column] : in) one[name] = {column.size() == 1 ? column[0] : column[i]};
    const Columns found = ask(shader, NACRE_EVALUATE, one, 1, 0, 0, &instance);
    EXPECT_EQ(found.at("f.x")[0], all.at("f.x")[i]) << i;
  }
}

TEST_F(LiveFits, ThreadsThatMeetNewValuesAgree) {
  const Shader shader = metal();
  const Columns in = points();
  for (const auto& each : indices()) {
    Instance instance(shader);
    set(instance, each);
    std::array<Columns, 4> found;
    std::vector<std::thread> threads;
    for (Columns& mine : found) {
      threads.emplace_back([&] { mine = ask(shader, NACRE_EVALUATE, in, 600, 0, 0, &instance); });
    }
    for (std::thread& thread : threads) thread.join();
    Instance alone(shader);
    set(alone, each);
    const Columns expected = ask(shader, NACRE_EVALUATE, in, 600, 0, 0, &alone);
    for (const Columns& mine : found) EXPECT_EQ(mine, expected);
  }
}

}  // namespace
}  // namespace nacre
