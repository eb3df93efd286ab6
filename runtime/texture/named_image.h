#pragma once

#include <mutex>
#include <utility>

#include "runtime/texture/texture.h"

namespace nacre {

/// An image in memory by a name of the host's, which may be replaced while kernels have it: a batch
/// reads the one that was there when it began. All members may be called by any thread.
class NamedImage {
 public:
  explicit NamedImage(TextureHandle texture) : texture_(std::move(texture)) {}

  TextureHandle get() const {
    const std::scoped_lock lock(mutex_);
    return texture_;
  }
  void set(TextureHandle texture) {
    const std::scoped_lock lock(mutex_);
    texture_.swap(texture);
  }

 private:
  mutable std::mutex mutex_;
  TextureHandle texture_;
};

}  // namespace nacre
