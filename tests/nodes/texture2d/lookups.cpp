#include "tests/nodes/texture2d/lookups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "jit/passes/derive.h"
#include "jit/passes/expand_math.h"
#include "runtime/interpreter/interpreter.h"
#include "runtime/node/geometry.h"
#include "runtime/program/slice.h"

namespace nacre {

void LookupPoints::add(float at_u, float at_v, const std::array<float, 4>& d) {
  u.push_back(at_u);
  v.push_back(at_v);
  dudx.push_back(d[0]);
  dvdx.push_back(d[1]);
  dudy.push_back(d[2]);
  dvdy.push_back(d[3]);
}

ReferenceFootprint LookupPoints::footprint(std::size_t i) const {
  return {dudx[i], dvdx[i], dudy[i], dvdy[i]};
}

LookupPoints edge_points(int width, int height) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  const auto of_size = [](int size) {
    const auto n = static_cast<float>(size);
    std::vector<float> values{
        0.0f,  -0.0f,    1.0f,      -1.0f, 2.0f,  -2.0f,  0.5f,
        1e-9f, -1e-9f,   1e8f,      -1e8f, 3e38f, -3e38f, inf,
        -inf,  12345.7f, -12345.7f, 0.25f, 1.25f, -0.75f, std::numeric_limits<float>::quiet_NaN()};
    for (const float texel : {0.5f, 1.0f, 1.5f, n - 0.5f, n - 1.0f, n + 0.5f, -0.5f}) {
      values.push_back(texel / n);
    }
    values.push_back(std::nextafter(1.0f, 0.0f));
    values.push_back(std::nextafter(1.0f, 2.0f));
    return values;
  };
  LookupPoints points;
  for (const float u : of_size(width)) {
    for (const float v : of_size(height)) points.add(u, v);
  }
  return points;
}

LookupPoints random_points(int count, int width, int height, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<float> coordinate(-3.0f, 3.0f);
  std::uniform_real_distribution<float> octave(-3.0f, 10.0f);
  std::normal_distribution<float> direction;
  LookupPoints points;
  for (int i = 0; i < count; ++i) {
    const float texels = std::exp2(octave(generator));
    const auto size = [&](int extent) {
      return direction(generator) * texels / static_cast<float>(extent);
    };
    points.add(coordinate(generator), coordinate(generator),
               {size(width), size(height), size(width), size(height)});
  }
  return points;
}

RecordedLookup::RecordedLookup(TextureStore& store, const Body& body)
    : textures_(store, recorder_, diagnostics_) {
  const Float4 rgba = body(recorder_, textures_, texcoord(recorder_, 0));
  const std::vector<SliceOutput> outputs{
      {"r", rgba.x.ref()}, {"g", rgba.y.ref()}, {"b", rgba.z.ref()}, {"a", rgba.w.ref()}};
  kernel_ = make_interpreter(
      expand_math(derive(slice(recorder_.program(), "lookup", outputs)), Accuracy::precise));
}

bool RecordedLookup::reads(const std::string& channel) const {
  return std::ranges::any_of(inputs(), [&](const Channel& c) { return c.name == channel; });
}

std::vector<std::array<float, 4>> RecordedLookup::run(const LookupPoints& points) const {
  const std::map<std::string, const std::vector<float>*> channels{
      {"uv0.x", &points.u},       {"uv0.y", &points.v},       {"duv0dx.x", &points.dudx},
      {"duv0dx.y", &points.dvdx}, {"duv0dy.x", &points.dudy}, {"duv0dy.y", &points.dvdy},
      {"texture_u", &points.draw}};
  std::vector<const void*> in;
  for (const Channel& input : inputs()) in.push_back(channels.at(input.name)->data());
  std::array<std::vector<float>, 4> rgba;
  std::vector<void*> out;
  for (auto& channel : rgba) {
    channel.assign(points.size(), -7.0f);
    out.push_back(channel.data());
  }
  // The Program may use fewer textures than were recorded, in the same order.
  std::vector<TextureBinding> bindings;
  for (const TextureSlot& slot : program().textures) {
    const auto& recorded = recorder_.program().textures;
    const auto at = std::ranges::find(recorded, slot) - recorded.begin();
    bindings.push_back(textures_.snapshot().bindings[static_cast<std::size_t>(at)]);
  }
  kernel_->run({.inputs = in.data(),
                .outputs = out.data(),
                .textures = bindings.data(),
                .texture_callback = RecordedTextures::look_up,
                .texture_user = const_cast<RecordedTextures*>(&textures_),
                .count = points.size()});
  std::vector<std::array<float, 4>> results(points.size());
  for (std::size_t i = 0; i < results.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) results[i][c] = rgba[c][i];
  }
  return results;
}

}  // namespace nacre
