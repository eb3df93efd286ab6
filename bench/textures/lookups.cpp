#include "bench/textures/lookups.h"

#include <random>

#include "bench/textures/image_file.h"
#include "jit/tune/kernel_run.h"

namespace nacre::bench {

namespace {

std::vector<float> random_numbers(std::size_t count) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<float> number(0.0f, 1.0f);
  std::vector<float> numbers(count);
  for (float& each : numbers) each = number(generator);
  return numbers;
}

}  // namespace

Lookups coherent_lookups(float footprint_texels) {
  constexpr std::size_t side = 64;
  constexpr float texel = 1.0f / image_size;
  static_assert(side * side == batch_points);
  Lookups points;
  points.footprint = footprint_texels * texel;
  for (std::size_t batch = 0; batch < lookup_batches; ++batch) {
    const auto left = static_cast<float>(batch % 8 * 4 * side);
    const auto bottom = static_cast<float>(batch / 8 * 4 * side);
    for (std::size_t i = 0; i < batch_points; ++i) {
      points.u.push_back((left + static_cast<float>(i % side) + 0.3f) * texel);
      points.v.push_back((bottom + static_cast<float>(i / side) + 0.7f) * texel);
    }
  }
  points.draw = random_numbers(points.u.size());
  return points;
}

Lookups random_lookups(float footprint_texels) {
  Lookups points;
  points.footprint = footprint_texels / image_size;
  std::mt19937 generator(1);
  std::uniform_real_distribution<float> coordinate(0.0f, 1.0f);
  for (std::size_t i = 0; i < lookup_batches * batch_points; ++i) {
    points.u.push_back(coordinate(generator));
    points.v.push_back(coordinate(generator));
  }
  points.draw = random_numbers(points.u.size());
  return points;
}

const char* filter_name(Filter filter) {
  switch (filter) {
    case Filter::closest: return "closest";
    case Filter::bilinear: return "bilinear";
    case Filter::trilinear: return "trilinear";
    case Filter::anisotropic: return "anisotropic";
  }
  return "";
}

}  // namespace nacre::bench
