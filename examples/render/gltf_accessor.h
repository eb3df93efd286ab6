#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "examples/render/gltf_buffers.h"
#include "examples/render/gltf_value.h"
#include "examples/render/scene_budget.h"

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
  GltfAccessors(const GltfValue& root, GltfBuffers& buffers, SceneBudget& budget)
      : root_(root), buffers_(buffers), budget_(budget) {}

  /// The accessor that `index` names, of `least` to 4 components of a type that
  /// attributes have; nothing after an error.
  std::optional<GltfAccessor> attribute(const GltfValue& index, int least);
  /// Likewise, 4x4 matrices of floats, by columns.
  std::optional<GltfAccessor> matrices(const GltfValue& index);
  /// Likewise, unsigned numbers of 8, 16 or 32 bits.
  std::optional<GltfAccessor> indices(const GltfValue& index);
  /// Likewise, four of 8 or 16 bits.
  std::optional<GltfAccessor> joints(const GltfValue& index);

  /// Of elements in a buffer.
  struct Form {
    std::size_t count;
    int type, components;
    std::size_t bytes() const;  ///< Of an element.
  };
  /// What an accessor says of itself; nothing after an error.
  std::optional<Form> form(const GltfValue& accessor) const;
  /// From now on accessors[number] has these bytes, one element after another.
  void give(std::size_t number, const Form& form, std::string bytes);

  /// Its `count * components` values; normalised integers become [0, 1] or [-1, 1]
  /// (glTF 2.0, 3.6.2.3).
  static std::vector<float> floats(const GltfAccessor& accessor);
  /// Its `count * components` values.
  static std::vector<std::uint32_t> integers(const GltfAccessor& accessor);

 private:
  std::optional<GltfAccessor> open(const GltfValue& index);
  std::optional<GltfAccessor> elements(const GltfValue& accessor, const GltfValue& view,
                                       const Form& form);
  std::optional<GltfAccessor> sparse(const GltfValue& accessor, const Form& form);

  GltfValue root_;
  GltfBuffers& buffers_;
  SceneBudget& budget_;
  std::deque<std::string> made_;  ///< What is not in a buffer as it is.
  std::map<std::size_t, GltfAccessor> given_;
};

}  // namespace nacre::host
