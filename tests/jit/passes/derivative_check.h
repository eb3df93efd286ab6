#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "jit/passes/derive.h"
#include "runtime/program/recorder.h"
#include "runtime/program/slice.h"
#include "runtime/reference/reference.h"
#include "runtime/value/control.h"

namespace nacre {

/// One point of the footprint and its derivatives: u = uv0.x, v = uv0.y.
struct FootprintPoint {
  float u, v;
  float dudx, dvdx, dudy, dvdy;
};

/// The value of a named channel at `point` moved by (x, y) in its footprint.
/// The offsets are chosen so that the moved coordinates are floats exactly.
inline float channel_value(std::string_view name, const FootprintPoint& p, float x, float y) {
  if (name == "uv0.x") return p.u + x * p.dudx + y * p.dudy;
  if (name == "uv0.y") return p.v + x * p.dvdx + y * p.dvdy;
  if (name == "duv0dx.x") return p.dudx;
  if (name == "duv0dx.y") return p.dvdx;
  if (name == "duv0dy.x") return p.dudy;
  if (name == "duv0dy.y") return p.dvdy;
  ADD_FAILURE() << "unexpected channel " << name;
  return 0.0f;
}

/// The only output of `program` there, by the reference engine in double.
inline double evaluate(const ReferenceKernel& kernel, const FootprintPoint& point, float x = 0,
                       float y = 0) {
  std::vector<float> values;
  for (const Channel& channel : kernel.program().inputs) {
    values.push_back(channel_value(channel.name, point, x, y));
  }
  std::vector<const void*> inputs;
  for (const float& value : values) inputs.push_back(&value);
  std::vector<std::uint32_t> slots;
  for (const ParameterSlot& slot : kernel.program().parameters) slots.push_back(slot.value);
  double out = std::numeric_limits<double>::quiet_NaN();
  void* outputs[] = {&out};
  kernel.run_double(
      {.inputs = inputs.data(), .outputs = outputs, .parameters = slots.data(), .count = 1});
  return out;
}

/// Records f(recorder, u, v); the value as a Program of one output.
using Body = std::function<Float(Recorder&, Float, Float)>;

inline Program record_body(const Body& body) {
  Recorder recorder;
  const Float u(recorder.input("uv0.x", Scalar::f32));
  const Float v(recorder.input("uv0.y", Scalar::f32));
  const std::vector<SliceOutput> outputs{{"out", body(recorder, u, v).ref()}};
  return slice(recorder.program(), "test", outputs);
}

/// The derivative of `body` along `axis`, as the pass makes it.
inline Program derivative_of(const Body& body, int axis) {
  return derive(record_body([&](Recorder& recorder, Float u, Float v) {
    return footprint_derivative(body(recorder, u, v), axis);
  }));
}

/// Central difference along `axis`, extrapolated once (Richardson), so that
/// its error is O(h^4); h is a power of two and coordinates stay exact floats.
inline double central_difference(const ReferenceKernel& kernel, const FootprintPoint& point,
                                 int axis) {
  const auto difference = [&](float h) {
    const float x = axis == 0 ? h : 0.0f;
    const float y = axis == 1 ? h : 0.0f;
    return (evaluate(kernel, point, x, y) - evaluate(kernel, point, -x, -y)) /
           (2.0 * static_cast<double>(h));
  };
  const float h = 0x1p-12f;
  return (4.0 * difference(h / 2) - difference(h)) / 3.0;
}

/// Points whose coordinates and derivatives have few bits.
inline std::vector<FootprintPoint> generic_points() {
  return {{0.34375f, 0.65625f, 0.5f, 0.25f, -0.75f, 1.0f},
          {0.828125f, 0.203125f, -1.0f, 0.375f, 0.5f, 0.5f},
          {0.140625f, 0.484375f, 0.25f, -0.5f, 1.25f, -0.125f}};
}

/// The pass against central differences, at generic points along both axes. The
/// tolerance is that of literals in rules (ln 2), which are rounded to float.
inline void expect_derivative(const Body& body, double tolerance = 0x1p-24) {
  const auto primal = make_reference(derive(record_body(body)));
  for (const int axis : {0, 1}) {
    const auto derived = make_reference(derivative_of(body, axis));
    for (const FootprintPoint& point : generic_points()) {
      const double expected = central_difference(*primal, point, axis);
      ASSERT_EQ(verify(derived->program()), "");
      EXPECT_NEAR(evaluate(*derived, point), expected, tolerance * (1.0 + std::abs(expected)))
          << "axis " << axis << " at " << point.u << ", " << point.v << "\n"
          << to_string(derived->program());
    }
  }
}

}  // namespace nacre
