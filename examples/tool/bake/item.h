#pragma once

#include <string>

#include "examples/bake/bake.h"
#include "examples/tool/bake/manifest.h"
#include "examples/tool/bake/texture_request.h"
#include "examples/tool/bake/udim.h"

namespace nacre::tool {

/// An image that a bake is to write.
struct BakeItem {
  std::string path;
  Facts settings;          ///< Of BakedRecord.
  std::size_t number = 0;  ///< Among all of the bake, from 0.
  std::string name = {};   ///< As manifests have it.
};

/// What there is to do about an image.
enum class BakeStep {
  bake,  ///< It is ours, and not there as it is to be.
  keep,  ///< It is there, and recorded.
  leave  ///< It is another shard's, or missing where all should be there; that is said.
};

/// What the bytes of an image depend on beside inputs and options: BakedRecord::settings.
/// `output`: by which the graph knows it.
Facts settings_of(const std::string& output, const TextureSettings& texture,
                  const host::BakeSettings& settings, const UdimTile& tile);

}  // namespace nacre::tool
