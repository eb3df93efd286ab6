#include "examples/bake/texel_runs.h"

#include <algorithm>

namespace nacre::host {

RunStatus run_texels(PointShader& shader, std::span<const std::size_t> texels, int first_row,
                     std::span<const SamplePlace> places, TexelPoints& points,
                     const std::atomic<std::uint32_t>& stop, BakeCounts& counts,
                     const TexelSamples& samples) {
  const auto width = static_cast<std::size_t>(shader.width());
  const std::size_t step = std::max<std::size_t>(1, shader.points_of_a_run() / places.size());
  for (std::size_t begin = 0; begin < texels.size(); begin += step) {
    const std::size_t count = std::min(step, texels.size() - begin);
    points.x.clear();
    points.y.clear();
    points.texel.clear();
    for (const std::size_t texel : texels.subspan(begin, count)) {
      const std::size_t row = static_cast<std::size_t>(first_row) + texel / width;
      const auto left = static_cast<float>(texel % width);
      const auto top = static_cast<float>(row);
      for (const SamplePlace& place : places) {
        points.x.push_back(left + place.x);
        points.y.push_back(top + place.y);
        points.texel.push_back(row * width + texel % width);
      }
    }
    const RunStatus status = shader.run(points, stop);
    if (status != RunStatus::done) return status;
    counts.samples += points.x.size();
    for (std::size_t i = 0; i < count; ++i) samples(begin + i, i * places.size());
  }
  return RunStatus::done;
}

}  // namespace nacre::host
