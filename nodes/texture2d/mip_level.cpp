#include "nodes/texture2d/mip_level.h"

namespace nacre {

namespace {

using namespace texture_layout;

constexpr int tile_mask = (1 << tile_log2) - 1;

MipLevel make_level(const TexelFetch& fetch, Int width, Int height, Int index) {
  MipLevel level;
  level.x = {width, to_float(width)};
  level.y = {height, to_float(height)};
  level.start = fetch.word(Int(word_level_start) + index);
  // What header word 32 + index says, without a look-up: tiles across times their words.
  const Int across = (width + Int(tile_mask)) >> Int(tile_log2);
  level.row = across << Int(2 * tile_log2 + texel_words_log2(fetch.format));
  return level;
}

/// The two parts of a texel's address; they add up.
Int x_part(Int x, TexelFormat format) {
  const Int in_tile = x & Int(tile_mask);
  const int words = texel_words_log2(format);
  return ((x & Int(~tile_mask)) << Int(tile_log2 + words)) | (in_tile << Int(words));
}

Int y_part(Int y, const MipLevel& level, TexelFormat format) {
  const Int in_tile = y & Int(tile_mask);
  return level.start + (y >> Int(tile_log2)) * level.row +
         (in_tile << Int(tile_log2 + texel_words_log2(format)));
}

/// f of every component.
template <class F, class... V>
Float4 each(F&& f, V... v) {
  return {f(v.x...), f(v.y...), f(v.z...), f(v.w...)};
}

/// The weighted sum of a component of four texels; a literal is the same in all of them.
Float weigh_steps(const std::array<Float, 4>& weight, Float a, Float b, Float c, Float d) {
  if (a.is_constant() && b.is_constant()) return a;
  return fma(weight[3], d, fma(weight[2], c, fma(weight[1], b, weight[0] * a)));
}

}  // namespace

Float4 mix_steps(const Float4& a, const Float4& b, Float t) {
  const auto mix = [&](Float x, Float y) {
    return x.is_constant() && y.is_constant() ? x : fma(t, y - x, x);
  };
  return each(mix, a, b);
}

Int texel_word(const TexelFetch& fetch, const MipLevel& level, Int column, Int row) {
  return y_part(row, level, fetch.format) + x_part(column, fetch.format);
}

MipLevel finest_level(const TexelFetch& fetch) {
  return make_level(fetch, fetch.word(Int(word_width)), fetch.word(Int(word_height)), Int(0));
}

MipLevel mip_level(const TexelFetch& fetch, Int index) {
  const Int width = fetch.word(Int(word_width)) >> index;
  const Int height = fetch.word(Int(word_height)) >> index;
  return make_level(fetch, max(width, Int(1)), max(height, Int(1)), index);
}

Float4 filter_level(const TexelFetch& fetch, const MipLevel& level, Float u, Float v,
                    TextureModes modes) {
  const Taps across = taps(u, level.x, modes.filter, modes.u);
  const Taps up = taps(v, level.y, modes.filter, modes.v);
  std::array<Int, 4> columns;
  for (std::size_t i = 0; i < 4; ++i) columns[i] = x_part(across.texel[i], fetch.format);
  const bool cubic = modes.filter == TextureFilter::cubic;
  const std::array<Float, 4> weights_x = b_spline(cubic ? across.t : Float(0.0f));

  std::array<Float4, 4> rows;
  for (std::size_t j = 0; j < static_cast<std::size_t>(up.count); ++j) {
    const Int row = y_part(up.texel[j], level, fetch.format);
    const auto texel = [&](std::size_t i) { return fetch.texel(row + columns[i]); };
    switch (modes.filter) {
      case TextureFilter::closest: rows[j] = texel(0); break;
      case TextureFilter::linear: rows[j] = mix_steps(texel(0), texel(1), across.t); break;
      case TextureFilter::cubic:
        rows[j] = each([&](auto... step) { return weigh_steps(weights_x, step...); }, texel(0),
                       texel(1), texel(2), texel(3));
        break;
    }
  }
  switch (modes.filter) {
    case TextureFilter::closest: break;
    case TextureFilter::linear: return mix_steps(rows[0], rows[1], up.t);
    case TextureFilter::cubic:
      return each([&](auto... step) { return weigh_steps(b_spline(up.t), step...); }, rows[0],
                  rows[1], rows[2], rows[3]);
  }
  return rows[0];
}

}  // namespace nacre
