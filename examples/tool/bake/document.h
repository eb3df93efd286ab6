#pragma once

#include <functional>
#include <string>
#include <vector>

#include "examples/bake/write_texture.h"
#include "examples/tool/bake/ledger.h"
#include "examples/tool/bake/report.h"
#include "examples/tool/bake/target.h"
#include "examples/tool/bake/texture_request.h"
#include "examples/tool/bake/udim.h"
#include "examples/tool/options.h"

namespace nacre::tool {

struct DocumentBake {
  std::string document;                ///< The file to write.
  std::vector<std::string> materials;  ///< Names of material nodes.
  std::string folder;                  ///< Of the textures.
  TextureRequest textures;
  host::BakeSettings settings;  ///< But for the size and the tile.
  std::vector<UdimTile> tiles;  ///< One texture for each; none: one for uv from 0 to 1.
  ShaderOptions shader;
  int uv_set = 0;  ///< That textures are read by.
  bool quiet = false;
  bool is_shard = false;  ///< Then there is no document.
  bool average = false;   ///< Means in place of textures.
};

/// Bakes what feeds materials into textures, and writes a document that has them
/// in place of the graphs. The opened document gets outputs for it. A file that
/// could not be written is an error, and then there is no document; nor is there if the work
/// is stopped, or some of it is another shard's or missing.
void bake_document(const DocumentBake& options, const Opened& opened, BakeLedger& ledger,
                   BakeTarget& target, BakeReport& report, Diagnostics& diagnostics);

}  // namespace nacre::tool
