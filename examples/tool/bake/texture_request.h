#pragma once

#include <string>

#include "examples/bake/write_texture.h"
#include "examples/tool/bake/file_name.h"
#include "jit/document/document.h"
#include "runtime/diagnostic.h"

namespace CLI {
class App;
}

namespace nacre::tool {

/// What the command line says about the textures to write. What it leaves open is
/// taken from the `width`, `height`, `bitdepth` and `colorspace` of an <output>
/// (MaterialX Specification, "Output Elements"), then from the format.
struct TextureRequest {
  std::string size;                      ///< --size: "N", "WxH", or "" if not given.
  int bits = 0;                          ///< --bitdepth, 0 if not given.
  std::string format;                    ///< --format, "" if not given.
  std::string vectors = "raw";           ///< --vectors: "raw" or "encoded".
  bool clip = false;                     ///< --clip, for --document: cut off rather than refuse.
  std::string name = default_file_name;  ///< --name: see file_name.h.
  std::string document = {};             ///< Not of the command line: the digest that files name.

  void add(CLI::App& command);
  /// True if what was given can be understood.
  bool check(Diagnostics& diagnostics) const;
};

/// One texture: how large, and what it holds.
struct TextureSettings {
  int width = 1024, height = 1024;
  host::TextureEncoding encoding;
  std::string extension;  ///< ".exr", or ".png" where a bit depth of 8 and no format is asked for.
};

/// The settings for an <output>, null for what has none; false after an error.
bool texture_settings(const TextureRequest& request, const Element* output,
                      TextureSettings& settings, Diagnostics& diagnostics);

}  // namespace nacre::tool
