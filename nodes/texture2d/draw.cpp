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

  static Float below_1(Float u) { return min(u, 0x1.fffffep-1f); }

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
    u = below_1((u - lower) / width);
    return chosen;
  }
};

/// The weights of the probes, one after the other: samples of exp(-2 (spread p)^2) at equal steps,
/// so that each is the one before it times a ratio, which itself changes by a factor.
struct Weights {
  Float weight;
  Float ratio;

  void go_on(Float factor) {
    weight = weight * ratio;
    ratio = ratio * factor;
  }
};

template <class F>
void visit(Weights& w, F&& f) {
  f(w.weight), f(w.ratio);
}

struct Sum {
  Weights at;
  Float weights;
};

template <class F>
void visit(Sum& sum, F&& f) {
  visit(sum.at, f), f(sum.weights);
}

struct Found {
  Weights at;
  Float number;  ///< Of the probe.
  Float below;   ///< What those before it weigh.
};

template <class F>
void visit(Found& found, F&& f) {
  visit(found.at, f), f(found.number), f(found.below);
}

/// The place of a probe on the line, as often as it weighs.
Float draw_probe(Recorder& recorder, const Probes& probes, int most, Draw& draw) {
  const Bool are_several = probes.count > 1.5f;
  const auto drawn = [&]() -> Float2 {
    const Float step = 2.0f / probes.count;
    const Float first = probe_position(probes, 0.0f);
    const Float square = -2.0f * probes.spread * probes.spread;
    const Weights begin{probe_weight(probes, first), exp(square * step * fma(2.0f, first, step))};
    const Float factor = exp(2.0f * square * step * step);
    const auto add = [&](Int i, Sum& sum) {
      sum.weights = sum.weights + sum.at.weight;
      sum.at.go_on(factor);
      return to_float(i) + 1.5f < probes.count;
    };
    const Float all = loop(recorder, are_several, most, Sum{begin, 0.0f}, add).weights;
    const Float wanted = draw.u * all;
    const auto pass = [&](Int, Found& found) {
      found.below = found.below + found.at.weight;
      found.number = found.number + 1.0f;
      found.at.go_on(factor);
      return (found.below + found.at.weight <= wanted) & (found.number + 1.5f < probes.count);
    };
    const Found found = loop(recorder, are_several & (begin.weight <= wanted), most,
                             Found{begin, 0.0f, 0.0f}, pass);
    return {probe_position(probes, found.number),
            Draw::below_1((wanted - found.below) / found.at.weight)};
  };
  const Float2 chosen = if_any(are_several, Float2{0.0f, draw.u}, drawn);
  draw.u = chosen.y;
  return chosen.x;
}

std::array<Float, 4> weights_of(const Taps& taps, TextureFilter filter) {
  if (filter == TextureFilter::cubic) return b_spline(taps.t);
  return {1.0f - taps.t, taps.t};
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
