#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "runtime/kernel.h"
#include "runtime/node/texture_source.h"
#include "runtime/program/recorder.h"
#include "runtime/texture/texture_set.h"
#include "runtime/texture/texture_store.h"

namespace nacre {

/// The textures that one recording uses: finds them in the store while nodes
/// are recorded (one that cannot be read is a warning, since the node's default
/// takes its place), and binds them to kernels afterwards. Holds the handles, so it
/// must live as long as a kernel runs.
class RecordedTextures final : public TextureProvider {
 public:
  RecordedTextures(TextureStore& store, Recorder& recorder, Diagnostics& diagnostics,
                   int max_anisotropy = default_anisotropy)
      : store_(store),
        recorder_(recorder),
        diagnostics_(diagnostics),
        max_anisotropy_(std::clamp(max_anisotropy, 1, largest_anisotropy)) {}

  TextureSources find(const std::string& name, const std::string& layer) override;

  /// Who asks for what is found from now on: warnings are given there.
  void asked_by(const SourceLocation& where) { where_ = where; }

  /// For KernelArguments::textures: one binding a slot of the recording.
  std::vector<TextureBinding> bindings() const;
  /// For KernelArguments::texture_callback; `user` is the RecordedTextures.
  static void look_up(void* user, const TextureCall* call);

 private:
  void warn(const Diagnostics& problems);
  TextureSource add(const TextureHandle& texture, const std::string& key);

  TextureStore& store_;
  Recorder& recorder_;
  Diagnostics& diagnostics_;
  int max_anisotropy_;
  SourceLocation where_;
  std::vector<TextureHandle> slots_;
  std::map<std::string, TextureSources> found_;
};

}  // namespace nacre
