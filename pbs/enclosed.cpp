#include "pbs/enclosed.h"

#include <memory>
#include <utility>

#include "pbs/color_channels.h"
#include "pbs/vdf.h"
#include "runtime/program/origin.h"

namespace nacre {

namespace {

/// What there is of several, by how much is seen of each; nothing of none.
Vdf mean_medium(const std::vector<SeenMedium>& media) {
  if (media.empty()) return {};
  if (media.size() == 1) return *media.front().medium;
  VdfPtr sum;
  Float total = 0.0f;
  for (const SeenMedium& each : media) {
    const Float weight = max(average(each.weight), 1e-20f);
    sum = nacre::sum(sum, scaled(each.medium, Color3(weight)));
    total = total + weight;
  }
  return *scaled(sum, Color3(1.0f / total));
}

}  // namespace

std::vector<SliceOutput> interior_channels(const View& view, const std::vector<Term>& terms,
                                           const std::vector<SeenMedium>& media) {
  const ScopedOrigin origin(*view.recorder, "interior");
  std::vector<SeenMedium> entered;  // Indices, as media that only absorb.
  for (const Term& term : terms) {
    const Float* index = term.lobe->interior_index();
    if (index == nullptr) continue;
    auto vdf = std::make_shared<Vdf>();
    vdf->absorption = Color3(*index);
    entered.push_back({std::move(vdf), term.weight});
  }
  if (entered.empty() || view.thin_walled.is_constant(true)) return {};
  const Vdf index = mean_medium(entered);
  const Vdf medium = mean_medium(media);
  const Bool thin = view.thin_walled;
  const auto inside = [&](Color3 c) { return select(thin, Color3(0.0f), c); };
  std::vector<SliceOutput> channels{{"eta", select(thin, 1.0f, index.absorption.x).ref()}};
  if (is_zero(medium.absorption) && is_zero(medium.scattering)) return channels;
  add_color(channels, "absorption", inside(finite_coefficients(medium.absorption)));
  add_color(channels, "scattering", inside(finite_coefficients(medium.scattering)));
  channels.push_back({"anisotropy", medium.anisotropy.ref()});
  return channels;
}

/// Of the lobe that the host names; of the first one where light goes below, if it names another.
std::vector<SliceOutput> subsurface_channels(const View& view, const std::vector<Term>& terms) {
  if (view.thin_walled.is_constant(true)) return {};
  const ScopedOrigin origin(*view.recorder, "subsurface");
  const Int asked(view.recorder->input("of_lobe", Scalar::i32));
  bool any = false;
  Vdf medium;
  Color3 albedo;
  Float3 normal;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Lobe& lobe = *terms[i].lobe;
    if (!lobe.goes_below()) continue;
    const Vdf below = lobe.medium_below();
    const Bool mine = any ? asked == Int(static_cast<int>(i)) : Bool(true);
    medium.absorption = select(mine, below.absorption, medium.absorption);
    medium.scattering = select(mine, below.scattering, medium.scattering);
    medium.anisotropy = select(mine, below.anisotropy, medium.anisotropy);
    albedo = select(mine, lobe.albedo(view), albedo);
    normal = select(mine, facing(lobe.normal(view), view.wo), normal);
    any = true;
  }
  if (!any) return {};
  std::vector<SliceOutput> channels;
  add_color(channels, "absorption", medium.absorption);
  add_color(channels, "scattering", medium.scattering);
  channels.push_back({"anisotropy", medium.anisotropy.ref()});
  add_color(channels, "albedo", albedo);
  add_color(channels, "normal", normal);
  return channels;
}

}  // namespace nacre
