#include "nodes/noise/worley.h"

#include <string>
#include <utility>

#include "nodes/noise/cell.h"
#include "runtime/value/control.h"

namespace nacre {

namespace {

/// The nearest points so far, as a loop over the cells carries them. What isn't
/// asked for isn't carried.
struct Nearest {
  int distances = 0;  ///< How many of the squared distances d are kept.
  bool wants_cell = false;
  Float d[3] = {1e6f, 1e6f, 1e6f};
  Cell3 cell;  ///< Where the nearest point lies, from the cell of p.
};
template <class F>
void visit(Nearest& n, F&& f) {
  for (int i = 0; i < n.distances; ++i) f(n.d[i]);
  if (n.wants_cell) f(n.cell.x), f(n.cell.y), f(n.cell.z);
}

/// Takes in a point at squared distance d. NaN is not near.
void insert(Nearest& n, Float d, Cell3 cell) {
  const Bool nearest = d < n.d[0];
  n.d[2] = select(d < n.d[1], n.d[1], min(d, n.d[2]));
  n.d[1] = select(nearest, n.d[0], min(d, n.d[1]));
  n.d[0] = select(nearest, d, n.d[0]);
  n.cell.x = select(nearest, cell.x, n.cell.x);
  n.cell.y = select(nearest, cell.y, n.cell.y);
  n.cell.z = select(nearest, cell.z, n.cell.z);
}

/// Position of a feature point in its cell.
Float feature(Float random, Float jitter) { return fma(random - 0.5f, jitter, 0.5f); }

/// Takes in the point of the i-th cell around that of p. `f` is p from its cell.
void visit_cell(Nearest& n, Int i, Float2 f, Cell2 cell, Float jitter) {
  const Cell2 offset = neighbour2(i);
  const Float3 random = cell_noise3(cell + offset);
  const Float2 point{feature(random.x, jitter), feature(random.y, jitter)};
  const Float2 to = to_float(offset) + point - f;
  const Cell2 lies_in = offset + cell_of(point);
  insert(n, dot(to, to), {lies_in.x, lies_in.y, Int(0)});
}

void visit_cell(Nearest& n, Int i, Float3 f, Cell3 cell, Float jitter) {
  const Cell3 offset = neighbour3(i);
  const Float3 random = cell_noise3(cell + offset);
  const Float3 point(feature(random.x, jitter), feature(random.y, jitter),
                     feature(random.z, jitter));
  const Float3 to = to_float(offset) + point - f;
  insert(n, dot(to, to), offset + cell_of(point));
}

int cells_around(Float2 /*p*/) { return 9; }
int cells_around(Float3 /*p*/) { return 27; }

template <class P>
Nearest search(Recorder& recorder, P p, Float jitter, Nearest start) {
  const auto cell = cell_of(p);
  const P f = fraction(p);
  const int cells = cells_around(p);
  return loop(recorder, Bool(true), cells, start, [&](Int i, Nearest& n) {
    visit_cell(n, i, f, cell, jitter);
    return i < Int(cells - 1);
  });
}

Cell2 moved(Cell2 a, Cell3 b) { return a + Cell2{b.x, b.y}; }
Cell3 moved(Cell3 a, Cell3 b) { return a + b; }

/// Distances to the nearest `count` points; the other components are 0.
template <class P>
Float3 distances(Recorder& recorder, int count, P p, Float jitter) {
  const auto body = [&](P q, Float j) {
    Nearest start;
    start.distances = count;
    const Nearest n = search(recorder, q, j, start);
    const auto distance = [&](int i) { return i < count ? sqrt(n.d[i]) : Float(0.0f); };
    return Float3(distance(0), distance(1), distance(2));
  };
  const std::string name = "worley" + std::to_string(cells_around(p)) + "_" + std::to_string(count);
  return outline<Float3>(recorder, name, body, p, jitter);
}

/// Random numbers of the cell in which the nearest point lies: three, or one of
/// another kind thrice.
template <class P>
Float3 nearest_cell(Recorder& recorder, bool one, P p, Float jitter) {
  const auto body = [&](P q, Float j) {
    Nearest start;
    start.distances = 1;
    start.wants_cell = true;
    const auto cell = moved(cell_of(q), search(recorder, q, j, start).cell);
    return one ? Float3(cell_noise(cell)) : cell_noise3(cell);
  };
  const std::string name = "worley" + std::to_string(cells_around(p)) + (one ? "_cell1" : "_cell3");
  return outline<Float3>(recorder, name, body, p, jitter);
}

template <class P>
void record_dimension(NodeCall& call, P p) {
  Recorder& recorder = call.recorder();
  const int count = component_count(call.out_type());
  const Float jitter = call.number("jitter");
  const Bool solid = call.integer("style") == Int(1);
  Float3 result;
  if (!solid.is_constant(true)) result = distances(recorder, count, p, jitter);
  if (!solid.is_constant(false)) {
    result = select(solid, nearest_cell(recorder, count == 1, p, jitter), result);
  }
  std::vector<Ref> parts{result.x.ref(), result.y.ref(), result.z.ref()};
  parts.resize(static_cast<std::size_t>(count));
  call.set(std::move(parts));
}

}  // namespace

void record_worley(NodeCall& call, Float2 p) { record_dimension(call, p); }
void record_worley(NodeCall& call, Float3 p) { record_dimension(call, p); }

}  // namespace nacre
