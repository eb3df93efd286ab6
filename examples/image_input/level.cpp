#include "examples/image_input/level.h"

#include <algorithm>

namespace graph_image {

namespace {

/// How many texels of the finest level lie across one of this, rounded up, and at most `most`.
int across(int finest, int size, int most) {
  return std::clamp((finest + size - 1) / size, 1, most);
}

}  // namespace

int level_count(int width, int height) {
  int count = 1;
  for (int side = std::max(width, height); side > 1; side /= 2) ++count;
  return count;
}

Level level_of(const Request& request, int index) {
  Level level;
  level.width = std::max(1, request.width >> index);
  level.height = std::max(1, request.height >> index);
  level.samples_x = across(request.width, level.width, request.samples);
  level.samples_y = across(request.height, level.height, request.samples);
  return level;
}

}  // namespace graph_image
