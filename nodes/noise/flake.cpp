#include "nodes/noise/flake.h"

#include "nodes/math/safe.h"
#include "nodes/noise/cell.h"
#include "runtime/value/control.h"

namespace nacre {

namespace {

constexpr float two_pi = 6.2831853071795865f;
/// Half the edge of a flake's cube: its corners reach 1.5 cells from its centre.
constexpr float half_edge = 0.86602540378443865f;  // 1.5 / sqrt(3)

/// The share of cells that must have a flake for that share of the area to be
/// covered: a rational fit to measurements, MaterialX 1.39.5, mx_flake.glsl.
Float probability_of_coverage(Float x) {
  const Float numerator = x * fma(-26.19771808f, x, 26.39663835f);
  const Float denominator =
      fma(fma(fma(85.53857017f, x, -102.35069432f), x, -101.42634862f), x, 118.45082288f);
  return numerator / denominator;
}

/// p turned by the random rotation that three numbers in [0, 1] give: Arvo, "Fast
/// Random Rotation Matrices", Graphics Gems III, 1992. The transposed matrix.
Float3 random_rotation(Float3 p, Float3 random) {
  const Float theta = random.x * two_pi;
  const Float phi = random.y * two_pi;
  const Float z = random.z * 2.0f;
  const Float radius = sqrt(z);
  const Float3 v(sin(phi) * radius, cos(phi) * radius, safe_sqrt(2.0f - z));
  const Float s = sin(theta);
  const Float c = cos(theta);
  const Float sx = v.x * c - v.y * s;
  const Float sy = v.x * s + v.y * c;
  const Float along = dot(v, p);
  return {sx * along - c * p.x + s * p.y, sy * along - s * p.x - c * p.y, v.z * along - p.z};
}

struct Flake {
  Float priority;
  Cell3 cell;
};
template <class F>
void visit(Flake& f, F&& g) {
  g(f.priority), g(f.cell.x), g(f.cell.y), g(f.cell.z);
}

Bool inside_cube(Float3 p) { return max_component({abs(p.x), abs(p.y), abs(p.z)}) <= half_edge; }

/// Takes in the flake of one cell; `p` is the point from the centre of that cell.
void visit_cell(Flake& top, Cell3 cell, Float3 p, Float probability) {
  const Bool near = dot(p, p) < 3.0f * half_edge * half_edge;
  const Bool filled = cell_noise(cell) <= probability;
  const Float priority = cell_noise(cell, Int(3));
  const Bool candidate = near & filled & (priority >= top.priority) & (priority > 0.0f);
  top = if_any(candidate, top, [&] {
    const Bool covers = inside_cube(random_rotation(p, cell_noise3(cell)));
    return Flake{select(covers, priority, top.priority),
                 {select(covers, cell.x, top.cell.x), select(covers, cell.y, top.cell.y),
                  select(covers, cell.z, top.cell.z)}};
  });
}

/// The flake that shows at p, of priority 0 where there is none.
Flake top_flake(Recorder& recorder, Float3 p, Float coverage) {
  const Float probability = probability_of_coverage(saturate(coverage));
  const Cell3 cell = cell_of(p);
  const Float3 f = fraction(p);
  const auto body = [&](Int i, Flake& top) {
    const Cell3 offset = neighbour3(i);
    visit_cell(top, cell + offset, f - (to_float(offset) + Float3(0.5f)), probability);
    return i < Int(26);
  };
  return loop(recorder, Bool(true), 27, Flake{0.0f, {Int(0), Int(0), Int(0)}}, body);
}

/// A microfacet normal of the GGX distribution of alpha = roughness^2 in the frame
/// of the node: tan^2 = alpha^2 u / (1 - u), written for sine and cosine so that
/// u = 1 is no special case.
Float3 flake_normal(NodeCall& call, Float3 random) {
  // Its square stays finite; sine is 1 long before.
  const Float alpha = min(square(call.number("roughness")), 1e18f);
  const Float up = 1.0f - random.y;
  const Float across = alpha * alpha * random.y;
  const Float sum = max(up + across, float_min);
  const Float sine = sqrt(across / sum);
  const Float phi = random.x * two_pi;
  const Float3 n = call.vector3("tangent") * Float3(cos(phi) * sine) +
                   call.vector3("bitangent") * Float3(sin(phi) * sine) +
                   call.vector3("normal") * Float3(sqrt(up / sum));
  return normalize(n);
}

}  // namespace

void record_flake(NodeCall& call, Float3 position) {
  Recorder& recorder = call.recorder();
  const Float size = call.number("size");
  const Float3 p(safe_divide(position.x, size), safe_divide(position.y, size),
                 safe_divide(position.z, size));
  const auto search = [&](Float3 q, Float coverage) { return top_flake(recorder, q, coverage); };
  const Flake flake = outline<Flake>(recorder, "flake", search, p, call.number("coverage"));
  const Bool found = flake.priority > 0.0f;
  const Float3 random = cell_noise3(flake.cell, Int(2));
  const Float number = select(found, random.z, 0.0f);
  call.set("rand", number);
  call.set("id", std::vector<Ref>{to_int(number * 16777215.0f).ref()});
  call.set("presence", flake.priority);
  call.set("flakenormal", select(found, flake_normal(call, random), call.vector3("normal")));
}

}  // namespace nacre
