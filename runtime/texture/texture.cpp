#include "runtime/texture/texture.h"

#include <new>
#include <utility>

namespace nacre {

using namespace texture_layout;

namespace {

/// A 1x1 texel of 0 that stands in for an image that is elsewhere or nowhere.
AlignedWords placeholder(std::uint32_t flags, int image_width, int image_height) {
  const Plan one = plan(TexelFormat::r32f, 1, 1, 1);
  AlignedWords words = AlignedWords::allocate(one.total_words);
  if (words.empty()) throw std::bad_alloc();
  write_header(one, flags, words.span());
  words.span()[word_image_width] = static_cast<std::uint32_t>(image_width);
  words.span()[word_image_height] = static_cast<std::uint32_t>(image_height);
  return words;
}

}  // namespace

Texture::Texture(AlignedWords words, std::uint64_t replaced_texels)
    : words_(std::move(words)), replaced_texels_(replaced_texels) {}

Texture::Texture(std::unique_ptr<TextureSampler> sampler, int width, int height)
    : words_(placeholder(texture_by_call, width, height)), sampler_(std::move(sampler)) {}

Texture::Texture(Diagnostic problem)
    : words_(placeholder(texture_missing, 1, 1)), problem_(std::move(problem)) {}

const UniformChannels& Texture::uniform() const {
  std::call_once(has_uniform_, [this] {
    if (resident()) uniform_ = uniform_channels(words());
  });
  return uniform_;
}

}  // namespace nacre
