#pragma once

#include <OpenImageIO/imageio.h>
#include <nacre/nacre.h>

#include <string>
#include <vector>

namespace graph_image {

/// What is wanted of a document.
struct Request {
  std::string document;  ///< The file.
  std::string output;    ///< GRAPH/NAME, or NAME at the root; "": the only one.
  std::string profile;   ///< A file that `nacre tune` wrote, below the document's folder; "": none.
  int accuracy = NACRE_STANDARD;
  int anisotropy = 0;  ///< Of footprints on images; 0: as usual.
  float frame = 1.0f;
  float time = 0.0f;               ///< Seconds.
  int width = 0, height = 0;       ///< Texels of the finest level; 0: as the output says.
  int corner_u = 0, corner_v = 0;  ///< uv of the image's lower left corner.
  int samples = 8;   ///< Points on a side of a texel, at most, of levels but the finest.
  std::string wrap;  ///< Beyond the edges, for who looks up: "periodic".
  OIIO::TypeDesc format = OIIO::TypeDesc::FLOAT;  ///< Of samples.
};

/// Of a name as OpenImageIO opens it, and of the attributes "mtlx:KEY" of a configuration, which
/// may be null: what the name says counts before those. Throws Wrong for keys that there are not
/// and for values that make no sense.
Request read_request(const std::string& name, const OIIO::ImageSpec* config);

}  // namespace graph_image
