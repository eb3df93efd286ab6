#include "jit/record/sample_table.h"

#include <string>
#include <vector>

namespace nacre {

namespace {

/// Where a look-up falls along one axis.
struct Cell {
  Int first;
  Float fraction;  ///< Of the way to the next texel.
};

/// The texel that holds a coordinate.
Int nearest(Float coordinate, std::size_t size) {
  const Float last(static_cast<float>(size - 1));
  return to_int(clamp(floor(coordinate * Float(static_cast<float>(size))), 0.0f, last));
}

/// The two texels whose centres are around a coordinate; the last two from the last
/// centre on, so that both exist.
Cell around(Float coordinate, std::size_t size) {
  const Float last(static_cast<float>(size - 1));
  const Float place = clamp(coordinate * Float(static_cast<float>(size)) - 0.5f, 0.0f, last);
  const Float first = min(floor(place), last - 1.0f);
  return {to_int(first), place - first};
}

}  // namespace

std::uint32_t add_table(Recorder& recorder, const TextTable& table) {
  return recorder.table("table." + table.values->digest(), table.values->values());
}

std::array<Float, 4> sample_table(Recorder& recorder, const TextTable& table, std::uint32_t index,
                                  std::span<const Float> place) {
  Int base(0);
  std::vector<Float> fractions;
  std::vector<int> offsets{0};  // Of the texels read, x fastest.
  int stride = static_cast<int>(table.channels);
  for (std::size_t axis = 0; axis < place.size(); ++axis) {
    const std::size_t size = table.size[axis];
    if (table.filter == TextTable::Filter::nearest) {
      base = base + nearest(place[axis], size) * Int(stride);
    } else if (size > 1) {
      const Cell cell = around(place[axis], size);
      base = base + cell.first * Int(stride);
      fractions.push_back(cell.fraction);
      const std::size_t count = offsets.size();
      for (std::size_t k = 0; k < count; ++k) offsets.push_back(offsets[k] + stride);
    }
    stride *= static_cast<int>(size);
  }

  // Word after word, as engines read them best; then one axis after another goes.
  const std::size_t channels = table.channels;
  std::vector<Float> texels;
  for (const int offset : offsets) {
    for (std::size_t channel = 0; channel < channels; ++channel) {
      const Ref at = (base + Int(offset + static_cast<int>(channel))).ref();
      texels.emplace_back(recorder.emit(Op::table, std::span(&at, 1), index));
    }
  }
  for (const Float& fraction : fractions) {
    for (std::size_t k = 0; k < texels.size() / 2; ++k) {
      const std::size_t low = 2 * (k / channels) * channels + k % channels;
      texels[k] = lerp(texels[low], texels[low + channels], fraction);
    }
    texels.resize(texels.size() / 2);
  }
  std::array<Float, 4> result{0.0f, 0.0f, 0.0f, 1.0f};
  for (std::size_t channel = 0; channel < channels; ++channel) result[channel] = texels[channel];
  return result;
}

}  // namespace nacre
