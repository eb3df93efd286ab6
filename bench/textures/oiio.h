#pragma once

#include <memory>
#include <string>

#include "bench/textures/lookups.h"

namespace nacre::bench {

/// OpenImageIO's TextureSystem, one look-up at a time with handle and per-thread data, its
/// cache large enough for the image: what a renderer would use in our stead.
class OiioTexture {
 public:
  OiioTexture(const std::string& path, Filter filter);
  ~OiioTexture();
  OiioTexture(const OiioTexture&) = delete;
  OiioTexture& operator=(const OiioTexture&) = delete;

  /// Points [first, first + count), into elements 0 ... of `rgba`. False: an error.
  bool look_up(const Lookups& points, std::size_t first, std::size_t count, Rgba& rgba) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nacre::bench
