#pragma once

#include <optional>
#include <string>

#include "examples/render/gltf_value.h"

namespace nacre::host {

/// Which material a primitive has: its own, or that of a variant (KHR_materials_variants).
class GltfVariants {
 public:
  explicit GltfVariants(const GltfValue& root) : root_(root) {}

  /// The variant of that name; "" for none. False, with an error, where the file has no such.
  bool choose(const std::string& name);

  /// The index of a material, which may be missing.
  GltfValue material_of(const GltfValue& primitive) const;

 private:
  GltfValue root_;
  std::optional<std::size_t> chosen_;
};

}  // namespace nacre::host
