#include "examples/bake/dilate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace nacre::host {

namespace {

constexpr std::uint32_t none = ~0u;

/// Of each texel the row of the next one in its column that has a value, at most `most` away; the
/// upper one of two.
std::vector<std::uint32_t> next_in_columns(const std::vector<std::uint8_t>& has, std::size_t width,
                                           std::size_t most) {
  std::vector<std::uint32_t> next(has.size(), none);
  const std::size_t height = has.size() / width;
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t i = y * width + x;
      if (has[i] != 0) {
        next[i] = static_cast<std::uint32_t>(y);
      } else if (y > 0 && next[i - width] != none && y - next[i - width] <= most) {
        next[i] = next[i - width];
      }
    }
  }
  for (std::size_t y = height - 1; y-- > 0;) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t i = y * width + x;
      const std::uint32_t below = next[i + width];
      if (below == none || below <= y || below - y > most) continue;
      if (next[i] == none || below - y < y - next[i]) next[i] = below;
    }
  }
  return next;
}

/// Gives texels that are not covered the value of the next one that has one, at most `most` columns
/// and rows away; they have one then.
void take_next(std::vector<std::vector<float>>& planes, const std::vector<std::uint8_t>& covered,
               std::vector<std::uint8_t>& has, std::size_t width, std::size_t most) {
  const std::vector<std::uint32_t> next = next_in_columns(has, width, most);
  std::vector<std::uint8_t> grown = has;
  for (std::size_t i = 0; i < has.size(); ++i) {
    if (covered[i] != 0) continue;
    const std::size_t y = i / width, x = i % width;
    std::size_t best = std::numeric_limits<std::size_t>::max(), from = i;
    for (std::size_t c = x - std::min(x, most); c < std::min(width, x + most + 1); ++c) {
      const std::uint32_t row = next[y * width + c];
      if (row == none) continue;
      const std::size_t dx = c > x ? c - x : x - c, dy = row > y ? row - y : y - row;
      const std::size_t squared = dx * dx + dy * dy;
      if (squared >= best) continue;
      best = squared;
      from = row * width + c;
    }
    if (from == i) continue;
    for (std::vector<float>& plane : planes) plane[i] = plane[from];
    grown[i] = 1;
  }
  has = std::move(grown);
}

/// A level of a pyramid: means, and the number of texels that each is of.
struct Level {
  std::size_t width = 0, height = 0;
  std::vector<float> mean;
  std::vector<float> weight;
};

Level above(const Level& below) {
  Level level{(below.width + 1) / 2, (below.height + 1) / 2, {}, {}};
  level.mean.resize(level.width * level.height);
  level.weight.resize(level.mean.size());
  for (std::size_t y = 0; y < level.height; ++y) {
    for (std::size_t x = 0; x < level.width; ++x) {
      double sum = 0.0, weight = 0.0;
      for (std::size_t j = 2 * y; j < std::min(2 * y + 2, below.height); ++j) {
        for (std::size_t i = 2 * x; i < std::min(2 * x + 2, below.width); ++i) {
          const std::size_t at = j * below.width + i;
          const auto w = static_cast<double>(below.weight[at]);
          if (w > 0.0) sum += w * static_cast<double>(below.mean[at]);
          weight += w;
        }
      }
      level.weight[y * level.width + x] = static_cast<float>(weight);
      if (weight > 0.0) level.mean[y * level.width + x] = static_cast<float>(sum / weight);
    }
  }
  return level;
}

/// Where a level has nothing it gets what is above.
void take_from(const Level& above, Level& level) {
  for (std::size_t y = 0; y < level.height; ++y) {
    for (std::size_t x = 0; x < level.width; ++x) {
      const std::size_t i = y * level.width + x;
      if (level.weight[i] == 0.0f) level.mean[i] = above.mean[y / 2 * above.width + x / 2];
    }
  }
}

void fill(std::vector<float>& plane, const std::vector<std::uint8_t>& covered,
          const std::vector<std::uint8_t>& has, std::size_t width) {
  std::vector<Level> levels(1);
  levels[0] = {width, plane.size() / width, plane, std::vector<float>(plane.size())};
  for (std::size_t i = 0; i < plane.size(); ++i) {
    levels[0].weight[i] = has[i] != 0 ? 1.0f : 0.0f;
  }
  while (levels.back().width > 1 || levels.back().height > 1) {
    levels.push_back(above(levels.back()));
  }
  for (std::size_t i = levels.size() - 1; i-- > 0;) take_from(levels[i + 1], levels[i]);
  for (std::size_t i = 0; i < plane.size(); ++i) {
    if (covered[i] == 0) plane[i] = levels[0].mean[i];
  }
}

}  // namespace

void dilate(std::vector<std::vector<float>>& planes, const std::vector<std::uint8_t>& covered,
            int width, const Dilation& dilation) {
  const auto row = static_cast<std::size_t>(width);
  if (std::find(covered.begin(), covered.end(), 0) == covered.end()) return;
  std::vector<std::uint8_t> has = covered;
  for (std::size_t i = 0; i < has.size(); ++i) {
    for (const std::vector<float>& plane : planes) {
      if (!std::isfinite(plane[i])) has[i] = 0;
    }
  }
  if (dilation.texels > 0) {
    take_next(planes, covered, has, row, static_cast<std::size_t>(dilation.texels));
  }
  if (!dilation.fills) return;
  for (std::vector<float>& plane : planes) fill(plane, covered, has, row);
}

}  // namespace nacre::host
