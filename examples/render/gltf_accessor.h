#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "examples/render/gltf_buffers.h"
#include "examples/render/gltf_value.h"

namespace nacre::host {

/// An accessor whose elements are all within its buffer.
struct GltfAccessor {
  const char* data = nullptr;
  std::size_t count = 0, stride = 0;  ///< Elements, and bytes from one to the next.
  int component_type = 0;             ///< glTF 2.0, 3.6.2.2.
  int components = 0;                 ///< 1 to 16.
  bool normalized = false;
};

/// Reads glTF accessors. Errors name the accessor.
class GltfAccessors {
 public:
  GltfAccessors(const GltfValue& root, GltfBuffers& buffers) : root_(root), buffers_(buffers) {}

  /// The accessor that `index` names, of `least` to 4 components of a type that
  /// attributes have; nothing after an error.
  std::optional<GltfAccessor> attribute(const GltfValue& index, int least);
  /// Likewise, unsigned numbers of 8, 16 or 32 bits.
  std::optional<GltfAccessor> indices(const GltfValue& index);

  /// Its `count * components` values; normalised integers become [0, 1] or [-1, 1]
  /// (glTF 2.0, 3.6.2.3).
  static std::vector<float> floats(const GltfAccessor& accessor);
  static std::vector<std::uint32_t> integers(const GltfAccessor& accessor);

 private:
  std::optional<GltfAccessor> open(const GltfValue& index);

  GltfValue root_;
  GltfBuffers& buffers_;
};

}  // namespace nacre::host
