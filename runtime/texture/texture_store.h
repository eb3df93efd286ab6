#pragma once

#include <compare>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include "runtime/diagnostic.h"
#include "runtime/texture/image_io.h"
#include "runtime/texture/memory_files.h"
#include "runtime/texture/named_image.h"
#include "runtime/texture/pixels.h"
#include "runtime/texture/texture.h"
#include "runtime/texture/texture_loader.h"
#include "runtime/texture/texture_system.h"
#include "runtime/texture/tile_cache.h"
#include "runtime/texture/tile_set.h"

namespace nacre {

/// What makes two requests the same texture.
struct TextureKey {
  std::string path;   ///< Resolved by the caller, against the roots it trusts.
  std::string layer;  ///< See ImageReader; empty: the first.
  TexelPolicy policy = TexelPolicy::automatic;  ///< How samples become texels.

  auto operator<=>(const TextureKey&) const = default;
};

/// What it means that an image cannot be had. The node's default colour takes its place
/// either way.
enum class MissingImages {
  error,       ///< The result is not what was asked for.
  use_default  ///< It is, with a warning.
};

/// What a store may keep in memory, and accept.
struct TextureOptions {
  /// Bytes of texels kept in memory, unused textures included.
  std::uint64_t budget = std::uint64_t{2} << 30;
  /// Bytes of tiles kept for images that are not resident, by all of them together.
  std::uint64_t tile_memory = std::uint64_t{256} << 20;
  /// Of every image. The store keeps to sides of 16384, which its layout can hold.
  ImageLimits limits;
  TileLimits tiles;  ///< Of what a name with `<UDIM>` or `<UVTILE>` stands for.
  std::shared_ptr<BlockMemory> memory = nullptr;    ///< For texels; null: the process's own.
  std::shared_ptr<TextureSystem> system = nullptr;  ///< Asked before files; null: none.
};

/// What a store has, and has done since it was made.
struct TextureStatistics {
  std::uint64_t resident_bytes = 0;       ///< Of the arrays of all resident textures, used or not.
  std::uint64_t peak_resident_bytes = 0;  ///< The most that there were at once.
  std::uint64_t resident_textures = 0;    ///< Texels in memory now; those of set_image too.
  std::uint64_t tiled_textures = 0;       ///< Known to the store now, read by tiles.
  std::uint64_t missing_textures = 0;     ///< Known to the store now, with a problem.
  std::uint64_t loads = 0;                ///< Times an image was opened.
  std::uint64_t hits = 0;                 ///< Requests that found their texture loaded.
  std::uint64_t evictions = 0;            ///< Unused textures dropped for room.
  std::uint64_t replaced_texels = 0;      ///< NaN and infinite samples, over all loads.
  std::uint64_t read_failures = 0;        ///< Lookups of tiles that read 0 instead.
};

/// Textures by file, shared by all that ask for the same key. A texture lives while a
/// handle does; without one it stays for the next request until its room is needed. A file
/// that was written again or replaced (FileIdentity) is another one: who asks next gets its
/// pixels, who holds the old ones keeps them.
///
/// Over the budget, unused textures go first, the least recently asked for before others;
/// if there still is no room the image is read by tiles (TiledTexture) for as long
/// as someone holds it, and considered anew afterwards. Nothing in use is ever moved.
///
/// Building the pyramid takes, for the time of loading, up to 4 bytes a texel more.
///
/// All members may be called from any thread. Different images load concurrently; the
/// same one loads once, and the other threads wait. Handles may outlive the store.
class TextureStore {
 public:
  /// An empty store.
  explicit TextureStore(const TextureOptions& options = {});
  TextureStore(const TextureStore&) = delete;
  TextureStore& operator=(const TextureStore&) = delete;

  /// Never null. When the image cannot be had, or not before `stop` is due, the texture is
  /// `missing`, and its problem is added to `diagnostics` unless that already has it. An
  /// image that failed is tried again once nobody holds the failed texture.
  TextureHandle acquire(const TextureKey& key, Diagnostics& diagnostics, const Stop& stop = {});

  /// What stands for a texture that is acquired later: of its format, channels and number of texels
  /// as far as kernels know them, but of few and black. Of the file the header alone is looked at.
  /// Null where that is wrong, or the image would not be resident.
  TextureHandle stand_in(const TextureKey& key, const Stop& stop = {}) const;

  /// Images in memory, by names of the host's: documents that name one get it in place of a file.
  /// Set again, it is replaced in all kernels that have it, by an image of as many channels that is
  /// kept as the first one was. False, with a diagnostic, for what cannot be meant, does not fit
  /// into the budget, or cannot take the other's place.
  bool set_image(const std::string& name, const Pixels& pixels, Diagnostics& diagnostics);
  /// Kernels that have it keep it.
  void remove_image(const std::string& name);
  /// Null if there is none of that name.
  std::shared_ptr<const NamedImage> image(const std::string& name) const;

  /// Of contents in memory, a file to give acquire(); see MemoryFiles::keep.
  std::shared_ptr<const MemoryFile> keep_file(std::string_view bytes) { return files_.keep(bytes); }

  /// Forgets every texture that no handle refers to.
  void drop_unused();

  /// As given, within what the layout allows.
  const TextureOptions& options() const { return options_; }

  /// As they are now.
  TextureStatistics statistics() const;

 private:
  struct Entry {
    TextureHandle texture;  ///< Null while a thread loads it.
    std::uint64_t bytes = 0;
    std::uint64_t last_request = 0;
  };
  /// The key, and which file that is at the time.
  using Entries = std::map<std::pair<TextureKey, FileIdentity>, Entry>;

  struct Loaded {
    TextureHandle texture;
    std::uint64_t bytes = 0;
  };
  Loaded load(const TextureKey& key, const Stop& stop);
  Loaded load_image(const TextureKey& key, const Stop& stop);
  TextureHandle open_tiled(const TextureKey& key, const ImageInfo& info);
  bool reserve(std::uint64_t bytes);
  void release(std::uint64_t bytes);
  struct Named {
    std::shared_ptr<NamedImage> image;
    std::uint64_t bytes = 0;
  };
  Entries::iterator forget(Entries::iterator entry);
  void forget_others(const Entries::key_type& key);

  const TextureOptions options_;
  mutable std::mutex mutex_;
  std::condition_variable loaded_;
  Entries entries_;
  std::map<std::string, Named> named_;
  MemoryFiles files_;
  std::uint64_t requests_ = 0;
  TextureStatistics statistics_;
  std::shared_ptr<TileCache> tile_cache_;
};

}  // namespace nacre
