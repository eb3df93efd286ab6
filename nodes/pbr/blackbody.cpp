#include <array>
#include <cmath>
#include <vector>

#include "nodes/pbr/cie_1931.h"
#include "runtime/node/node_call.h"

namespace nacre {

namespace {

// The table runs over 1000 / T, in which the colour is smooth: from infinite
// temperature to 800 K, near the Draper point below which nothing glows.
constexpr int table_steps = 512;
constexpr float hottest = 0.0f;
constexpr float coldest = 1000.0f / 800.0f;

/// Planck's law at that wavelength, up to a factor that depends on T only, so that
/// infinite T has a limit. Second radiation constant: CODATA 2018.
double planck(double nanometres, double thousand_over_t) {
  constexpr double c2 = 1.438776877e-2;  // m K
  const double x = c2 / (nanometres * 1e-9) * thousand_over_t * 1e-3;
  const double bose = x < 1e-9 ? 1.0 : x / std::expm1(x);
  return bose / std::pow(nanometres, 4.0);
}

/// Linear Rec.709 colour of unit luminance; negative where out of gamut.
std::array<double, 3> planckian(double thousand_over_t) {
  std::array<double, 3> xyz{};
  for (std::size_t i = 0; i < cie_1931.size(); ++i) {
    const double wavelength = cie_first_wavelength + cie_wavelength_step * static_cast<double>(i);
    const double power = planck(wavelength, thousand_over_t);
    for (std::size_t k = 0; k < 3; ++k) xyz[k] += power * cie_1931[i][k];
  }
  const double x = xyz[0] / xyz[1];
  const double z = xyz[2] / xyz[1];
  // IEC 61966-2-1 primaries and D65 (0.3127, 0.3290).
  return {3.2409699419 * x - 1.5373831776 - 0.4986107603 * z,
          -0.9692436363 * x + 1.8759675015 + 0.0415550574 * z,
          0.0556300797 * x - 0.2039769589 + 1.0569715142 * z};
}

/// Three tables of one channel each, one after the other.
const std::vector<float>& planckian_table() {
  static const std::vector<float> table = [] {
    std::vector<float> values(3 * (table_steps + 1));
    for (std::size_t i = 0; i <= table_steps; ++i) {
      const double s = hottest + (coldest - hottest) * static_cast<double>(i) / table_steps;
      const std::array<double, 3> rgb = planckian(s);
      for (std::size_t k = 0; k < 3; ++k) {
        values[k * (table_steps + 1) + i] = static_cast<float>(rgb[k]);
      }
    }
    return values;
  }();
  return table;
}

}  // namespace

/// Colour of a black body at a temperature in kelvin, scaled to unit luminance, in
/// linear Rec.709 with what lies outside its gamut cut off. MaterialX 1.39
/// Physically Based Shading Nodes, "blackbody". Planck's law through the CIE 1931
/// observer, interpolated in a table (error below 4e-5), as in Open Shading
/// Language. MaterialX's other generators have cubic fits to the locus, off by 0.005
/// above 1667 K and by more than 1 below, where they are extrapolated. Below 800 K
/// and for NaN the colour at 800 K; there is no upper limit.
void record_blackbody(NodeCall& call) {
  Recorder& recorder = call.recorder();
  const std::uint32_t table = recorder.table("planckian_rec709", planckian_table());
  const Float temperature = max(call.number("temperature"), 800.0f);
  const Float at = (1000.0f / temperature) * (table_steps / coldest);
  const Int step = min(to_int(at), Int(table_steps - 1));
  const Float fraction = at - to_float(step);
  const auto channel = [&](int k) {
    const auto entry = [&](Int index) {
      const std::array<Ref, 1> operand{index.ref()};
      return Float(recorder.emit(Op::table, operand, table));
    };
    const Int first = step + Int(k * (table_steps + 1));
    return max(lerp(entry(first), entry(first + Int(1)), fraction), 0.0f);
  };
  const Float3 rgb(channel(0), channel(1), channel(2));
  const Float luminance = dot(rgb, Float3(0.2126390059f, 0.7151686788f, 0.0721923154f));
  call.set(rgb / Float3(luminance));
}

}  // namespace nacre
