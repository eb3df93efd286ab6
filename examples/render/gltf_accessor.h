#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/diagnostic.h"

namespace tinygltf {
class Model;
}

namespace nacre::host {

/// Reads glTF accessors with every offset checked against its buffer: tinygltf
/// parses but does not check. Errors name the file and the accessor.
class GltfAccessors {
 public:
  GltfAccessors(const tinygltf::Model& model, std::string file, Diagnostics& diagnostics)
      : model_(model), file_(std::move(file)), diagnostics_(diagnostics) {}

  /// `count * components` floats; normalised integers become [0, 1] or [-1, 1]
  /// (glTF 2.0, 3.6.2.3). Empty, with an error, when the accessor is not of
  /// `min_components` to 4 components or is not within its buffer.
  std::vector<float> floats(int accessor, int min_components, int& components);

  /// Unsigned indices of 8, 16 or 32 bits. `ok` false after an error.
  std::vector<std::uint32_t> indices(int accessor, bool& ok);

 private:
  struct View {
    const unsigned char* data = nullptr;  ///< Null after an error.
    std::size_t count = 0, stride = 0;
    int component_type = 0, components = 0;
    bool normalized = false;
  };
  View view(int accessor);
  void error(int accessor, const char* message, std::string expected, std::string found);

  const tinygltf::Model& model_;
  std::string file_;
  Diagnostics& diagnostics_;
};

}  // namespace nacre::host
