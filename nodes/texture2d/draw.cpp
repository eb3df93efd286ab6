#include "nodes/texture2d/draw.h"

#include <array>
#include <cstddef>

#include "nodes/texture2d/mip_level.h"
#include "runtime/value/control.h"

namespace nacre {

namespace {

/// Where each choice leaves of a number in [0, 1) what it has not used: again one in [0, 1).
struct Draw {
  Float u;

  /// One of `choices`, as often as it weighs; the weights add up to 1.
  template <class Value, std::size_t N>
  Value one_of(const std::array<Value, N>& choices, const std::array<Float, N>& weights,
               std::size_t count) {
    Value chosen = choices[0];
    Float below(0.0f), lower(0.0f), width = weights[0];
    for (std::size_t k = 1; k < count; ++k) {
      below = below + weights[k - 1];
      const Bool is_beyond = u >= below;
      chosen = select(is_beyond, choices[k], chosen);
      lower = select(is_beyond, below, lower);
      width = select(is_beyond, weights[k], width);
    }
    u = min((u - lower) / width, 0x1.fffffep-1f);
    return chosen;
  }
};

/// The place of a probe on the line, as often as it weighs: each of those that follow takes the
/// place of what was chosen before with its share of the weight so far.
struct ChosenProbe {
  Float weight;
  Float place;
  Float u;
};

template <class F>
void visit(ChosenProbe& chosen, F&& f) {
  f(chosen.weight), f(chosen.place), f(chosen.u);
}

Float draw_probe(Recorder& recorder, const Probes& probes, int most, Draw& draw) {
  const ChosenProbe none{.weight = 0.0f, .place = 0.0f, .u = draw.u};
  const auto draw_next = [&](Int i, ChosenProbe& chosen) {
    const Float place = probe_position(probes, to_float(i));
    const Float weight = probe_weight(probes, place);
    chosen.weight = chosen.weight + weight;
    const Float share = weight / chosen.weight;
    const Bool is_taken = chosen.u < share;
    chosen.place = select(is_taken, place, chosen.place);
    const Float left = select(is_taken, chosen.u, chosen.u - share);
    chosen.u = min(left / select(is_taken, share, 1.0f - share), 0x1.fffffep-1f);
    return to_float(i) + 1.5f < probes.count;
  };
  const Bool are_several = probes.count > 1.5f;
  const ChosenProbe chosen = if_any(
      are_several, none, [&] { return loop(recorder, are_several, most, none, draw_next); });
  draw.u = chosen.u;
  return chosen.place;
}

std::array<Float, 4> weights_of(const Taps& taps, TextureFilter filter) {
  if (filter == TextureFilter::cubic) return b_spline(taps.t);
  return {1.0f - taps.t, taps.t};
}

/// A probe beyond the edge has the texels of the edge.
AddressMode within(AddressMode mode) {
  return mode == AddressMode::constant ? AddressMode::clamp : mode;
}

}  // namespace

Float4 draw_texel(const TexelFetch& fetch, Float2 uv, const Probes& probes, TextureModes modes,
                  Float u) {
  Draw draw{u};
  const Float next = draw.one_of(std::array{Float(0.0f), Float(1.0f)},
                                 std::array{1.0f - probes.blend, probes.blend}, 2);
  const MipLevel level = mip_level(fetch, to_int(probes.level + next));
  if (modes.max_anisotropy > 1) {
    const Float p = draw_probe(fetch.recorder, probes, 2 * modes.max_anisotropy - 1, draw);
    uv = {fma(p, probes.reach.x, uv.x), fma(p, probes.reach.y, uv.y)};
  }
  const auto texel = [&](Float along, const Extent& extent, AddressMode mode) {
    const Taps around = taps(address(along, within(mode)), extent, modes.filter, within(mode));
    return draw.one_of(around.texel, weights_of(around, modes.filter),
                       static_cast<std::size_t>(around.count));
  };
  const Int column = texel(uv.x, level.x, modes.u);
  const Int row = texel(uv.y, level.y, modes.v);
  return fetch.texel(texel_word(fetch, level, column, row));
}

}  // namespace nacre
