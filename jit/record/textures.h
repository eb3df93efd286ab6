#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "jit/document/file_resolver.h"
#include "runtime/kernel.h"
#include "runtime/node/texture_source.h"
#include "runtime/program/recorder.h"
#include "runtime/texture/file_identity.h"
#include "runtime/texture/texture_set.h"
#include "runtime/texture/texture_store.h"

namespace nacre {

/// Which images a recording may have.
struct ImageAccess {
  MissingImages missing = MissingImages::error;
  /// Whether a file may be read; null: all may.
  std::function<bool(const std::string& path)> may_read;
  Stop stop;  ///< Images that are not read by then are missing.
  /// Tiles of sets are not loaded: see RecordedTextures::load_tiles.
  bool defers_tiles = false;
};

/// The textures that one recording uses: finds them in the store while nodes
/// are recorded, and binds them to kernels afterwards. One that cannot be read, or may
/// not be, is a complaint as `access` says. Holds the handles, so it must live as long as
/// a kernel runs.
class RecordedTextures final : public TextureProvider {
 public:
  RecordedTextures(TextureStore& store, Recorder& recorder, Diagnostics& diagnostics,
                   int max_anisotropy = default_anisotropy)
      : store_(store),
        recorder_(recorder),
        diagnostics_(diagnostics),
        max_anisotropy_(std::clamp(max_anisotropy, 1, largest_anisotropy)) {}

  TextureSources find(const std::string& name, const std::string& layer) override;
  std::optional<std::string> read(const std::string& name) override;
  void complain(const Diagnostics& problems) override;

  /// What a resolver gave: the path under which find() will have it, wherever it lies. Contents in
  /// memory that there is no room for are a missing image.
  std::string accept(const ResolvedFile& file);
  /// Of look-ups, in 1 .. largest_anisotropy.
  int max_anisotropy() const { return max_anisotropy_; }
  /// Of what is found from now on; without it all may be read, and what is missing is an error.
  void give_access(ImageAccess access) { access_ = std::move(access); }
  /// How many of its complaints were errors: of images, with which kernels are made all the same.
  std::size_t error_count() const { return errors_; }
  /// The files that were looked for, and what they were then: all zero where there was none, and
  /// of names with <UDIM> or <UVTILE>, which stand for those there are. Not what a resolver gave.
  const std::map<std::string, FileIdentity>& files() const { return files_; }
  /// Of images that were found: "image NAME: b is 0, a is 1 everywhere" of channels that kernels
  /// do not look up, for they are the same in all texels.
  std::vector<std::string> uniform_texels() const;
  /// Who asks for what is found from now on: complaints are made there.
  void asked_by(const SourceLocation& where) { where_ = where; }

  /// What the slots of the recording are bound to at some time.
  struct Snapshot {
    std::vector<TextureHandle> textures;   ///< Hold what is bound.
    std::vector<TextureBinding> bindings;  ///< For KernelArguments::textures.
  };
  Snapshot snapshot() const;
  /// What is bound where tiles were left for later (ImageAccess::defers_tiles) and those slots are
  /// wanted; in place of the others there are black ones. The tiles' files are added to `files`.
  /// A tile that is no longer what it was when it was found is an error.
  Snapshot load_tiles(const std::vector<bool>& wanted, std::map<std::string, FileIdentity>& files,
                      Diagnostics& diagnostics) const;
  /// Whether there are any.
  bool has_deferred() const { return !deferred_.empty(); }
  /// Whether the next snapshot may be another.
  bool may_change() const;
  /// For KernelArguments::texture_callback; `user` is the RecordedTextures.
  static void look_up(void* user, const TextureCall* call);

 private:
  TextureHandle acquire(const TextureKey& key, Diagnostics& problems);
  TextureHandle acquire_tile(const TextureKey& key, Diagnostics& problems);
  TextureHandle acquire_allowed(const TextureKey& key, Diagnostics& problems);
  TextureSet acquire_tiles(const TextureKey& pattern, Diagnostics& problems);
  /// What a slot is bound to.
  struct Slot {
    TextureHandle texture;
    std::shared_ptr<const NamedImage> image;  ///< Then not `texture`, but what that is by then.
  };
  /// A file that a resolver gave.
  struct Given {
    std::string name;  ///< For complaints.
    std::shared_ptr<const MemoryFile> contents;
  };
  TextureSource add(Slot slot, const std::string& key);
  TextureSource find_image(const std::string& name, const std::string& layer,
                           const std::string& key, Diagnostics& problems);
  bool may_read(const std::string& path) const;

  TextureStore& store_;
  Recorder& recorder_;
  Diagnostics& diagnostics_;
  int max_anisotropy_;
  ImageAccess access_;
  SourceLocation where_;
  std::size_t errors_ = 0;
  std::vector<Slot> slots_;
  std::map<std::string, Given> given_;  ///< By path.
  std::map<std::string, FileIdentity> files_;
  std::map<TextureHandle, TextureKey> deferred_;  ///< By what stands in for them.
  std::map<std::string, TextureSources> found_;
};

}  // namespace nacre
