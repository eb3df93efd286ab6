#pragma once

#include <optional>
#include <vector>

#include "examples/render/gltf_buffers.h"
#include "examples/render/gltf_dropped.h"
#include "examples/render/scene_material.h"

namespace nacre::host {

/// Reads the textures of glTF materials (2.0, 3.8) with their images and samplers. What no reader
/// of images has, KTX2, is a warning, and there is no texture then.
class GltfTextures {
 public:
  GltfTextures(const GltfValue& root, GltfBuffers& buffers, GltfDropped& dropped)
      : root_(root), buffers_(buffers), dropped_(dropped) {}

  /// What a textureInfo says; none where it is not there or after an error.
  std::optional<SceneTexture> read(const GltfValue& info);

  /// Those that the textures use, once all are read.
  std::vector<SceneImage> take_images() { return std::move(images_); }

 private:
  std::optional<std::size_t> source(const GltfValue& texture);
  std::optional<std::size_t> image(std::size_t number);
  std::optional<SceneImage> read_image(const GltfValue& image);

  GltfValue root_;
  GltfBuffers& buffers_;
  GltfDropped& dropped_;
  std::vector<SceneImage> images_;
  std::vector<std::optional<std::size_t>> places_;  ///< Of images that were read, in `images_`.
};

}  // namespace nacre::host
