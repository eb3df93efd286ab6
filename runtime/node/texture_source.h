#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/diagnostic.h"
#include "runtime/texture/layout.h"
#include "runtime/texture/uniform_channels.h"
#include "runtime/value/value.h"

namespace nacre {

/// One image as a node body sees it while recording: what is known of it now,
/// and the slot under which the kernel will find it.
struct TextureSource {
  /// How a kernel gets its texels.
  enum class State {
    resident,  ///< Texels through Op::texel, laid out as runtime/texture/layout.h says.
    by_call,   ///< Look up through Op::texture_call: too large, or the host's.
    missing,   ///< No image: the node's default colour.
  };
  State state = State::missing;          ///< Decided while recording.
  Int slot;                              ///< A literal.
  texture_layout::TexelFormat format{};  ///< Fixed in the kernel.
  int channels = 0;                      ///< In the file, at most 4.
  bool single = false;                   ///< One texel: the same everywhere.
  UniformChannels uniform;               ///< Fixed in the kernel; of what may change nothing.
};

/// What a file name with or without `<UDIM>` / `<UVTILE>` stands for.
struct TextureSources {
  std::vector<TextureSource> images;  ///< One, or one a tile; empty: missing.
  /// For tile sets the table of runtime/texture/tile_set.h; empty for one image.
  std::vector<std::uint32_t> directory;
  int max_anisotropy = 1;  ///< Of look-ups; runtime/texture/sampling.h.
};

/// Finds images, and other files, for node bodies; the compiler of a document implements it.
class TextureProvider {
 public:
  virtual ~TextureProvider() = default;
  /// `name` as the node has it, prefixes applied; `layer` as `image` defines it.
  virtual TextureSources find(const std::string& name, const std::string& layer) = 0;
  /// The bytes of a small file that is no image. Nothing where it cannot be had; that is said.
  virtual std::optional<std::string> read(const std::string& name) = 0;
  /// For a body that cannot use a file: said as of one that cannot be had. `where` of a problem is
  /// the file.
  virtual void complain(const Diagnostics& problems) = 0;
};

}  // namespace nacre
