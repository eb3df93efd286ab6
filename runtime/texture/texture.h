#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "runtime/diagnostic.h"
#include "runtime/texture/aligned_words.h"
#include "runtime/texture/layout.h"
#include "runtime/texture/texture_sampler.h"
#include "runtime/texture/uniform_channels.h"

namespace nacre {

/// One image as a kernel sees it; immutable. In each state `words()` is a whole array as
/// layout.h describes it, so that a kernel may always read the header.
class Texture {
 public:
  /// A resident image: the array with all its levels.
  Texture(AlignedWords words, std::uint64_t replaced_texels);
  /// An image that is looked up by calls, of that size.
  Texture(std::unique_ptr<TextureSampler> sampler, int width, int height);
  /// An image that could not be read, and why.
  explicit Texture(Diagnostic problem);

  /// As layout.h describes them, the header first.
  std::span<const std::uint32_t> words() const { return words_.span(); }
  /// texture_missing, texture_by_call or 0.
  std::uint32_t flags() const { return words()[texture_layout::word_flags]; }
  /// The image could not be read.
  bool missing() const { return (flags() & texture_layout::texture_missing) != 0; }
  /// The texels are in words().
  bool resident() const { return flags() == 0; }
  /// Of the image in the file; 1 if it is missing.
  int width() const { return static_cast<int>(words()[texture_layout::word_image_width]); }
  /// Of the image in the file; 1 if it is missing.
  int height() const { return static_cast<int>(words()[texture_layout::word_image_height]); }

  const TextureSampler* sampler() const { return sampler_.get(); }  ///< Null unless by calls.
  /// Why it is missing.
  const std::optional<Diagnostic>& problem() const { return problem_; }
  /// What all texels have, found out when first asked for; nothing unless resident.
  const UniformChannels& uniform() const;
  /// NaN and infinite samples of level 0 that became 0.
  std::uint64_t replaced_texels() const { return replaced_texels_; }

 private:
  AlignedWords words_;
  std::unique_ptr<TextureSampler> sampler_;
  std::optional<Diagnostic> problem_;
  std::uint64_t replaced_texels_ = 0;
  mutable std::once_flag has_uniform_;
  mutable UniformChannels uniform_;
};

using TextureHandle = std::shared_ptr<const Texture>;  ///< Keeps the texture in memory.

}  // namespace nacre
