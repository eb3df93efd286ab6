#pragma once

#include <memory>
#include <optional>
#include <string>

#include "runtime/texture/texture_sampler.h"

namespace nacre {

/// Images that the host has and looks up itself. Asked before the files of a store; members may be
/// called by any thread.
class TextureSystem {
 public:
  /// An image of the host's.
  struct Opened {
    std::unique_ptr<TextureSampler> sampler;
    int width = 1;   ///< In pixels.
    int height = 1;  ///< In pixels.
  };

  virtual ~TextureSystem() = default;

  /// The image of that name, as the document and the file resolver have it, and layer; nothing for
  /// what is to be read as a file.
  virtual std::optional<Opened> open(const std::string& name, const std::string& layer) = 0;
};

}  // namespace nacre
