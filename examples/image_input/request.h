#pragma once

#include <string>

namespace graph_image {

enum class Accuracy { standard, precise, fast };

/// What is wanted of a document.
struct Request {
  std::string document;  ///< The file.
  std::string output;    ///< GRAPH/NAME, or NAME at the root; "": the only one.
  std::string profile;   ///< A file that `nacre tune` wrote, below the document's folder; "": none.
  Accuracy accuracy = Accuracy::standard;
  int anisotropy = 0;  ///< Of footprints on images; 0: as usual.
  float frame = 1.0f;
  float time = 0.0f;               ///< Seconds.
  int width = 0, height = 0;       ///< Texels of the finest level; 0: as the output says.
  int corner_u = 0, corner_v = 0;  ///< uv of the image's lower left corner.
  int samples = 8;       ///< Points on a side of a texel, at most, of levels but the finest.
  std::string wrap;      ///< Beyond the edges, for who looks up: "periodic".
  bool is_half = false;  ///< Of samples.
};

}  // namespace graph_image
