#include "tests/pbs/edf/emission_case.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace nacre {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180.0;

std::string uniform(const std::string& name, double red) {
  return fmt::format(
      R"(<uniform_edf name="{}" type="EDF"><input name="color" type="color3" value="{}, 0.5, 2"/></uniform_edf>)",
      name, red);
}

/// Red 1; the angles from side to side.
std::string cone(const std::string& name, double inner, double outer) {
  return fmt::format(
      R"(<conical_edf name="{}" type="EDF"><input name="color" type="color3" value="1, 2, 0"/>
        <input name="inner_angle" type="float" value="{}"/><input name="outer_angle" type="float" value="{}"/></conical_edf>)",
      name, inner, outer);
}

std::string measured() {
  return R"(<measured_edf name="e" type="EDF"><input name="color" type="color3" value="1, 0.5, 0"/>
    <input name="file" type="filename" value="light.ies"/></measured_edf>)";
}

std::string with(const std::string& category, const std::string& inputs) {
  return fmt::format(R"(<{0} name="e" type="EDF">{1}</{0}>)", category, inputs);
}

std::string edf(const std::string& input, const std::string& node) {
  return fmt::format(R"(<input name="{}" type="EDF" nodename="{}"/>)", input, node);
}

std::string number(const std::string& input, double value) {
  return fmt::format(R"(<input name="{}" type="float" value="{}"/>)", input, value);
}

std::string color(const std::string& input, const std::string& value) {
  return fmt::format(R"(<input name="{}" type="color3" value="{}"/>)", input, value);
}

/// Of radiance that goes from 1 within the inner of two half-angles to 0 at the outer one, as
/// smoothstep of the cosine, in front of a surface: Simpson's rule.
double cone_power(double inner, double outer) {
  const double from = std::cos(outer * degree), to = std::cos(inner * degree);
  constexpr int steps = 20'000;
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double x = double(i) / steps;
    const double t = std::min(std::max((x - from) / (to - from), 0.0), 1.0);
    const double weight = i == 0 || i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * t * t * (3.0 - 2.0 * t) * x;
  }
  return 2.0 * pi * sum / (3.0 * steps);
}

/// The same for any falloff, from above: what no cone of that width emits more than.
double weight_of_cone(double outer) {
  // All that there may be of the density, over its least cosine.
  const double from = std::max(std::cos(outer * degree), 0.0);
  return 2.0 * pi * (1.0 - from) * (0.5 * (1.0 + from) + 0.125) / (from + 0.125);
}

std::string ies(int vertical, int horizontal, int type, const std::string& numbers) {
  return fmt::format("TILT=NONE\n1 1 1 {} {} {} 2 0 0 0\n1 1 1\n{}\n", vertical, horizontal, type,
                     numbers);
}

/// 37 vertical angles, 25 horizontal ones, each value another.
std::string large_profile() {
  std::string numbers;
  for (int v = 0; v < 37; ++v) numbers += fmt::format("{} ", 5 * v);
  numbers += "\n";
  for (int h = 0; h < 25; ++h) numbers += fmt::format("{} ", 15 * h);
  numbers += "\n";
  for (int h = 0; h < 25; ++h) {
    for (int v = 0; v < 37; ++v) {
      const double around = h % 24 * 15 * degree, along = 5 * v * degree;
      const double value =
          150 + 80 * std::cos(2 * around) * std::sin(along) + 60 * std::cos(3 * along);
      numbers += fmt::format("{:.3f} ", value);
    }
    numbers += "\n";
  }
  return ies(37, 25, 1, numbers);
}

std::vector<EmissionCase> make_cases() {
  // A measured one emits as uniform_edf does. Its weights: the sum of (cos + 1/8) intensity over
  // the least 1/8 that cosines count with; of types A and B two such factors.
  const double all = 2 * pi;
  const double measured_most = 1.01 * all * 1.5 * 8, floodlight_most = 1.01 * all * 2.0 * 64;
  const auto floodlight = [](int type, const char* vertical, const char* horizontal) {
    return ies(3, 3, type, fmt::format("{}\n{}\n2 1 0\n4 9 18\n1 18 36", vertical, horizontal));
  };
  return {
      {"uniform", uniform("e", 3.0), {}, 3 * all, 3.01 * all},
      {"unlit",
       R"(<surface_unlit name="s" type="surfaceshader"><input name="emission_color" type="color3" value="2, 1, 0"/></surface_unlit>)",
       {},
       2 * all,
       2.01 * all},
      {"cone_sharp", cone("e", 60, 60), {}, pi / 4, weight_of_cone(30), 1e-4},
      {"cone_outer_smaller", cone("e", 60, 20), {}, pi / 4, weight_of_cone(30), 1e-4},
      {"cone_soft", cone("e", 40, 90), {}, cone_power(20, 45), weight_of_cone(45), 1e-4},
      {"cone_all_soft", cone("e", 0, 100), {}, cone_power(0, 50), weight_of_cone(50), 1e-4},
      {"cone_half_sphere", cone("e", 180, 180), {}, pi, 1.01 * weight_of_cone(90), 1e-4},
      {"cone_beyond", cone("e", 300, 340), {}, pi, 1.01 * weight_of_cone(90), 1e-4},
      {"cone_cut_off", cone("e", 100, 240), {}, cone_power(50, 120), weight_of_cone(90), 1e-4},
      {"cone_narrow", cone("e", 1, 2), {}, cone_power(0.5, 1), 1.1 * weight_of_cone(1), 1e-2},
      {"schlick",
       uniform("b", 1.0) +
           with("generalized_schlick_edf", edf("base", "b") + color("color0", "0.25, 1, 1") +
                                               color("color90", "2, 1, 1") + number("exponent", 5)),
       {},
       // The mean of (1 - cos)^5 over cosines: 2 / 42.
       all * (0.25 + 1.75 / 21),
       2.01 * all},
      {"schlick_of_edges",
       uniform("b", 1.0) +
           with("generalized_schlick_edf", edf("base", "b") + color("color0", "0, 0, 0") +
                                               color("color90", "1, 1, 1") + number("exponent", 3)),
       {},
       all * 2 / 20,
       1.01 * all},
      {"mix",
       uniform("a", 1.0) + cone("c", 60, 60) +
           with("mix", edf("fg", "c") + edf("bg", "a") + number("mix", 0.25)),
       {},
       0.75 * all + 0.25 * pi / 4,
       30.0},
      {"add",
       uniform("a", 0.1) + cone("c", 20, 40) + with("add", edf("in1", "a") + edf("in2", "c")),
       {},
       0.1 * all + cone_power(10, 20),
       40.0},
      {"shared",
       cone("c", 60, 60) + uniform("a", 1.0) + R"(<add name="twice" type="EDF">)" +
           edf("in1", "c") + edf("in2", "c") + "</add>" + R"(<add name="more" type="EDF">)" +
           edf("in1", "twice") + edf("in2", "a") + "</add>" +
           with("add", edf("in1", "more") + edf("in2", "twice")),
       {},
       all + 4 * pi / 4,
       60.0},
      {"multiply",
       cone("c", 60, 60) + with("multiply", edf("in1", "c") + color("in2", "8, 0, 1")),
       {},
       2 * pi,
       8 * weight_of_cone(30),
       1e-4},
      {"ring", measured(), ies(2, 1, 1, "0 90\n0\n7 7"), all, measured_most, 1e-4},
      {"ring_both_sides", measured(), ies(3, 1, 1, "0 100 180\n0\n1 5 2"), all, measured_most,
       1e-4},
      {"ring_two_angles", measured(), ies(2, 1, 1, "0 180\n0\n1 3"), all, measured_most, 1e-4},
      {"ring_up", measured(), ies(3, 1, 1, "90 120 180\n0\n0 3 1"), all, measured_most, 1e-4},
      {"bat_wing", measured(), ies(5, 1, 1, "0 20 50 80 90\n0\n0 1 5 0 0"), all, measured_most,
       1e-4},
      {"spot", measured(), ies(4, 1, 1, "0 1 1.02 90\n0\n1 1 0 0"), all, measured_most, 2e-2},
      {"quarter", measured(), ies(3, 2, 1, "0 10 90\n0 90\n10 30 0\n20 60 0"), all, measured_most,
       1e-4},
      {"half", measured(), ies(3, 3, 1, "0 40 180\n0 30 180\n1 3 0\n2 6 0\n4 0 1"), all,
       measured_most, 1e-4},
      {"half_of_90_to_270", measured(), ies(2, 3, 1, "0 90\n90 180 270\n1 1\n2 2\n3 0"), all,
       measured_most, 1e-4},
      {"whole", measured(), ies(2, 5, 1, "0 90\n0 90 180 270 360\n1 1\n2 2\n3 0\n0 0\n1 1"), all,
       measured_most, 1e-4},
      {"large", measured(), large_profile(), all, measured_most, 1e-4},
      {"floodlight_b", measured(), floodlight(2, "-90 0 90", "-90 0 90"), all, floodlight_most,
       1e-4},
      {"floodlight_a", measured(), floodlight(3, "-90 0 90", "-90 0 90"), all, floodlight_most,
       1e-4},
      {"floodlight_b_folded", measured(), floodlight(2, "0 30 90", "0 5 90"), all, floodlight_most,
       1e-4},
      {"floodlight_a_folded", measured(), floodlight(3, "0 30 90", "0 5 90"), all, floodlight_most,
       1e-4},
      {"floodlight_a_half", measured(), floodlight(3, "-90 30 90", "0 5 90"), all, floodlight_most,
       1e-4},
      {"measured_in_mix",
       R"(<measured_edf name="m" type="EDF"><input name="color" type="color3" value="1, 1, 1"/>
         <input name="file" type="filename" value="light.ies"/></measured_edf>)" +
           uniform("a", 1.0) + with("mix", edf("fg", "m") + edf("bg", "a") + number("mix", 0.5)),
       ies(5, 1, 1, "0 20 50 80 90\n0\n0 1 5 0 0"), all, 2 * measured_most},
  };
}

}  // namespace

std::span<const EmissionCase> emission_cases() {
  static const std::vector<EmissionCase> cases = [] {
    std::vector<EmissionCase> made = make_cases();
    for (EmissionCase& row : made) {
      // A cosine over itself and an eighth varies by 0.15, two of them by less; one of directions
      // all over the sphere, which need no table, by sqrt(1 / 3).
      if (!row.profile.empty()) row.spread = 0.25;
    }
    return made;
  }();
  return cases;
}

}  // namespace nacre
