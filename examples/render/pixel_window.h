#pragma once

#include <algorithm>
#include <cstddef>

namespace nacre::host {

/// Pixels of an image, rows from the top: from (x0, y0) on, x1 and y1 being the first ones beyond.
struct PixelWindow {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool empty() const { return width() <= 0 || height() <= 0; }
  std::size_t pixels() const {
    return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  }
  /// Of a pixel of the image, row by row; within [0, pixels()) for those in the window.
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width()) +
           static_cast<std::size_t>(x - x0);
  }
  bool operator==(const PixelWindow&) const = default;
};

/// What both have; empty() where that is nothing.
inline PixelWindow both(const PixelWindow& a, const PixelWindow& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

/// f(x, y) of each, rows from the top.
template <class F>
void for_pixels(const PixelWindow& window, F&& f) {
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) f(x, y);
  }
}

}  // namespace nacre::host
