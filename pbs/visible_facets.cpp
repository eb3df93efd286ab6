#include "pbs/visible_facets.h"

#include <utility>

#include "pbs/estimate.h"
#include "pbs/sampling.h"

namespace nacre {

namespace {

/// What lies farther out than 200 is a hundred-thousandth of the facets.
constexpr float last = 0.99999f;

/// From a line to (-1, 1), by the root of what it is away from the sphere's centre.
Float on_side(Float y, Float away2) {
  return clamp(y * estimated_inverse_root(fma(y, y, away2)), -last, last);
}
/// One over the root of 1 - x^2.
Float from_side(Float x) { return estimated_inverse_root((1.0f - x) * (1.0f + x)); }

int fibonacci_before(int number) {
  int before = 1, at = 1;
  while (at < number) before = std::exchange(at, at + before);
  return before;
}

}  // namespace

VisibleFacets::VisibleFacets(Float3 wo, const Facets& facets, Float eta)
    : distribution_(facets.distribution) {
  const Float2 alpha = facets.alpha;
  const auto stretched = [&](Float3 v) { return Float3{alpha.x * v.x, alpha.y * v.y, v.z}; };
  const Float3 view = stretched(wo);
  length_ = sqrt(dot(view, view));
  const Float3 s = view * Float3(1.0f / max(length_, 1e-30f));
  const Float across2 = fma(s.x, s.x, square(s.y));
  const Bool slanted = across2 > 1e-30f;
  const Float across = sqrt(across2);
  const Float inverse = 1.0f / max(across, 1e-15f);
  const Float2 on{select(slanted, s.x * inverse, 1.0f), select(slanted, s.y * inverse, 0.0f)};
  const Float3 level{-on.y, on.x, 0.0f}, up{-s.z * on.x, -s.z * on.y, across};
  s_ = stretched(s);
  level_ = stretched(level);
  up_ = stretched(up);
  // The form of the normal's length in y; its determinant without a difference.
  form_up_ = max(dot(up_, up_), 1e-12f);
  const Float area = alpha.x * alpha.y / max(length_, 1e-30f);
  form_level_ = max(square(area) / form_up_, 1e-12f);
  shear_ = -dot(level_, up_) / form_up_;
  // The facet that faces the view is the middle of the ellipse: its normal is the shortest.
  const Float3 facing{wo.x / alpha.x, wo.y / alpha.y, wo.z};
  middle_level_ = length_ * dot(facing, level);
  middle_up_ = length_ * dot(facing, up);
  const Float beyond = (1.0f - eta) * (1.0f + eta);
  within_ = select(beyond > 0.0f, square(length_ * eta) / max(beyond, 1e-12f), 1e20f);
  const Float far = sqrt(within_ / form_level_);
  low_ = on_side(middle_level_ - far, 1.0f);
  width_ = on_side(middle_level_ + far, 1.0f) - low_;
  lowest_ = -s.z / max(across, 1e-12f);
  scale_ = (2.0f * one_over_pi) / (1.0f + s.z);
  if (distribution_ == FacetDistribution::beckmann) {
    scale_ = scale_ * (length_ + wo.z) / max(facets.root(wo) + wo.z, 1e-30f);
  }
}

VisibleFacets::Periodic VisibleFacets::periodic(Float u) {
  const Float rest = 1.0f - u;
  return {square(u) * fma(rest, 2.0f, 1.0f), 6.0f * u * rest};
}

VisibleFacets::Line VisibleFacets::line(Int k, Lines lines, Bool many) const {
  // Of either number before a lane chooses: one number for all lanes.
  const Float number = to_float(k);
  const auto either = [&](auto&& f) {
    const Periodic a = f(lines.many), b = f(lines.few);
    return Periodic{select(many, a.at, b.at), select(many, a.weight, b.weight)};
  };
  const Periodic u = either([&](int n) {
    const float share = 1.0f / static_cast<float>(n);
    Periodic p = periodic(fma(number, share, 0.5f * share));
    p.weight = p.weight * (0.5f * share);
    return p;
  });
  const auto along = [&](float part) {
    return either([&](int n) {
      const float step = static_cast<float>(fibonacci_before(n)) / static_cast<float>(n);
      return periodic(fma(0.5f, fract(fma(number, step, 0.25f)), part));
    });
  };
  const Float x = fma(width_, u.at, low_);
  const Float away = from_side(x);
  const Float y = x * away;
  const Float aside = y - middle_level_;
  const Float middle = fma(shear_, aside, middle_up_);
  const Float rest = max(fma(-form_level_ * aside, aside, within_), 1e-30f);
  const Float half = rest * estimated_inverse_root(rest * form_up_);
  const Float from = max(middle - half, lowest_);
  const Float away2 = square(away);
  const Float low = on_side(from, away2);
  const Float width = on_side(max(middle + half, from), away2) - low;
  return {.normal = fma(Float3(y), level_, s_),
          .away = away,
          .low = low,
          .width = width,
          .points = {along(0.0f), along(0.5f)},
          .share = scale_ * width_ * u.weight * width};
}

VisibleFacet VisibleFacets::at(const Line& line, const Periodic& u) const {
  const Float x = fma(line.width, u.at, line.low);
  const Float out = from_side(x);
  const Float3 normal = fma(Float3(line.away * (x * out)), up_, line.normal);
  const Float inverse = estimated_inverse_root(dot(normal, normal));
  // (1 - x^2)^2 is what (1 + y^2)^-2 has less than the plane's marginal.
  Float dense = (1.0f - x) * (1.0f + x) * out;
  if (distribution_ == FacetDistribution::beckmann) {
    const Float slope2 = clamp(square(line.away * out / max(normal.z, 1e-10f)) - 1.0f, 0.0f, 80.0f);
    dense = dense * exp(-slope2) * square(1.0f + slope2);
  }
  return {.normal = normal,
          .inverse = inverse,
          .cosine = min(length_ * inverse, 1.0f),
          .share = line.share * u.weight * dense};
}

}  // namespace nacre
