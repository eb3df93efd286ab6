#include "runtime/texture/pyramid.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "runtime/texture/texel.h"

namespace nacre {

namespace {

using texture_layout::level_extent;
using texture_layout::Plan;

/// The at most three neighbours `first`, `first + 1`, ... that a coarser texel covers.
struct Cover {
  int first = 0;
  int count = 1;
  std::array<float, 3> weight{1.f, 0.f, 0.f};
};

/// With fine = 2 coarse + 1, texel i covers [i (2 + 1/coarse), (i+1) (2 + 1/coarse)):
/// the share (coarse - i)/coarse of 2i, all of 2i+1, the share (i+1)/coarse of 2i+2.
Cover cover(int fine, int coarse, int i) {
  if (fine == coarse) return {i, 1, {1.f, 0.f, 0.f}};
  if (fine == 2 * coarse) return {2 * i, 2, {0.5f, 0.5f, 0.f}};
  const double total = 2.0 * coarse + 1.0;
  return {2 * i,
          3,
          {static_cast<float>((coarse - i) / total), static_cast<float>(coarse / total),
           static_cast<float>((i + 1) / total)}};
}

std::vector<Cover> covers(int fine, int coarse) {
  std::vector<Cover> result;
  result.reserve(static_cast<std::size_t>(coarse));
  for (int i = 0; i < coarse; ++i) result.push_back(cover(fine, coarse, i));
  return result;
}

/// Rounding can carry an average of the largest floats past them.
float finite(float value) {
  constexpr float largest = std::numeric_limits<float>::max();
  std::uint64_t replaced = 0;
  return sanitised(std::clamp(value, -largest, largest), replaced);
}

/// Sum of weight * row over the rows a coarser row covers, then the same across.
void average_row(std::span<const Rgba* const> rows, const Cover& down,
                 const std::vector<Cover>& across, std::vector<Rgba>& column, Rgba* out) {
  std::fill(column.begin(), column.end(), Rgba{});
  for (int k = 0; k < down.count; ++k) {
    const float weight = down.weight[static_cast<std::size_t>(k)];
    const Rgba* row = rows[static_cast<std::size_t>(k)];
    for (std::size_t x = 0; x < column.size(); ++x) {
      for (std::size_t c = 0; c < 4; ++c) column[x][c] += weight * row[x][c];
    }
  }
  for (std::size_t x = 0; x < across.size(); ++x) {
    Rgba sum{};
    for (int k = 0; k < across[x].count; ++k) {
      const Rgba& texel = column[static_cast<std::size_t>(across[x].first + k)];
      const float weight = across[x].weight[static_cast<std::size_t>(k)];
      for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * texel[c];
    }
    for (std::size_t c = 0; c < 4; ++c) out[x][c] = finite(sum[c]);
  }
}

}  // namespace

void build_pyramid(const Plan& plan, std::span<std::uint32_t> words) {
  std::vector<Rgba> fine;    // Level l as floats; empty for level 0, which is decoded as needed.
  std::vector<Rgba> coarse;  // Level l + 1.
  for (int level = 0; level + 1 < plan.levels; ++level) {
    const int fine_width = level_extent(plan.width, level);
    const int fine_height = level_extent(plan.height, level);
    const int width = level_extent(plan.width, level + 1);
    const int height = level_extent(plan.height, level + 1);
    const std::vector<Cover> across = covers(fine_width, width);
    const auto fine_row = static_cast<std::size_t>(fine_width);
    std::vector<Rgba> column(fine_row);
    std::vector<Rgba> decoded(level == 0 ? 3 * fine_row : 0);
    coarse.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));

    for (int y = 0; y < height; ++y) {
      const Cover down = cover(fine_height, height, y);
      std::array<const Rgba*, 3> rows{};
      for (int k = 0; k < down.count; ++k) {
        const auto slot = static_cast<std::size_t>(k);
        if (level == 0) {
          decode_row(plan, 0, down.first + k, words.data(),
                     std::span(decoded).subspan(slot * fine_row, fine_row));
          rows[slot] = &decoded[slot * fine_row];
        } else {
          rows[slot] = &fine[static_cast<std::size_t>(down.first + k) * fine_row];
        }
      }
      Rgba* out = &coarse[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)];
      average_row(rows, down, across, column, out);
      encode_row(plan, level + 1, y, {out, static_cast<std::size_t>(width)}, words.data());
    }
    std::swap(fine, coarse);
  }
}

}  // namespace nacre
