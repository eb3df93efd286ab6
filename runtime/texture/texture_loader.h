#pragma once

#include <cstdint>
#include <optional>

#include "runtime/texture/aligned_words.h"
#include "runtime/texture/image_io.h"
#include "runtime/texture/layout.h"
#include "runtime/texture/pixels.h"

namespace nacre {

/// How samples become texels. One-channel images are r32f under every policy; others:
///
///   samples of the file    automatic   half      full
///   8 bit                  rgba8       rgba8     rgba32f
///   16 bit integer         rgba16      rgba16    rgba32f
///   half                   rgba16f     rgba16f   rgba32f
///   float and all others   rgba32f     rgba16f   rgba32f
///
/// `automatic` loses nothing; `half` halves float images, at 11 bits and |x| <= 65504.
enum class TexelPolicy { automatic, half, full };

/// By the table above.
texture_layout::TexelFormat texel_format(const ImageInfo& info, TexelPolicy policy);

/// The layout an image gets.
texture_layout::Plan plan_texture(const ImageInfo& info, TexelPolicy policy);

/// Decodes the whole image into `words`, which has plan.total_words zeroed words, and
/// builds header and pyramid. Counts NaN and infinite samples into `replaced`.
std::optional<Diagnostic> load_texture(ImageReader& reader, const texture_layout::Plan& plan,
                                       AlignedWords& words, std::uint64_t& replaced);

/// The same of an image in memory.
void load_texture(const Pixels& pixels, const texture_layout::Plan& plan, AlignedWords& words,
                  std::uint64_t& replaced);

}  // namespace nacre
