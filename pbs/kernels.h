#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pbs/surface.h"
#include "runtime/program/slice.h"

namespace nacre {

/// The kernels of a material, as bits of KernelRequest::entries.
enum KernelEntry : std::uint32_t {
  entry_begin = 1 << 1,
  entry_sample = 1 << 2,
  entry_evaluate = 1 << 3,
  entry_evaluate_at = 1 << 4,
  entry_albedo = 1 << 5,
  entry_emission = 1 << 6,
  entry_opacity = 1 << 7,
  entry_displacement = 1 << 8,
  entry_volume = 1 << 9,
  entry_light = 1 << 10,
  entry_shade = 1 << 11,
  entry_interior = 1 << 12,
  entry_subsurface = 1 << 13,
  entry_shadow = 1 << 14,
  entry_emit = 1 << 15,
  /// What most renderers ask one after another.
  entry_usual = ~std::uint32_t(entry_evaluate_at | entry_shade | entry_interior | entry_subsurface |
                               entry_shadow | entry_emit),
};

/// What a host wants of a surface's kernels; only this is recorded.
struct KernelRequest {
  /// KernelEntry bits. `begin` comes with whatever reads its state.
  std::uint32_t entries = entry_usual;
  std::int32_t lobes = lobe_all;  ///< LobeKind bits; others are left out for good.
  bool lobe_mask = false;         ///< Lobes can be switched off by the slot "lobe_mask" too.
  /// Roughness can be raised by the slot "min_alpha" (see Facets); `sample` also stores "alpha".
  bool min_alpha = false;
  bool reverse_pdf = false;  ///< The density of wo given wi as well.
  /// No view gets more light than arrives, whatever the model says: what the lobes give together is
  /// divided by what of it exceeds 1, in each channel. As exact as their albedo.
  bool energy_conserving = false;
  Compensation compensation = Compensation::all;
  double table_error = 0;  ///< View::table_error
  bool by_lobe = false;    ///< What each lobe gives of f and weight as well.
  /// `sample` and `evaluate` read the channel "lobes_wanted": LobeKind bits of what scatters there,
  /// where glossy means rough and the delta kinds what is smooth. f is 0 of all others, and the
  /// densities are of those that are wanted. They store "kinds", too.
  bool lobes_wanted = false;
  /// They read the channel "transport", and multiply f and weight by transport_factor.
  bool transport = false;
  /// What `begin` (and `shade`) stores beside the state, so that nothing of the point is computed
  /// twice: "albedo", "emission", "opacity" (with transmission), "normal", "roughness"; all
  /// there, if constant. Other names are values of the graph: see GraphRequest::values.
  std::vector<std::string> with_begin;
};

/// What a host may know of a lobe.
struct LobeInfo {
  std::string name;        ///< Category of its node: "dielectric_bsdf".
  std::string path;        ///< The node: "SR_gold/coat_bsdf". A label for light path expressions.
  std::int32_t kinds = 0;  ///< LobeKind bits.
};

/// Whether KernelRequest::with_begin means that by a name, and no value of the graph.
bool is_point_result(std::string_view name);

/// The recorded entry points of one surface: named values for `slice`, all of
/// one recording. Empty: that kernel has nothing to compute.
///
///   evaluate  in:  wi.*, state, geometry
///             out: f.x f.y f.z (f |cos wi|), pdf [, pdf_reverse]
///   sample    in:  u.x u.y u.z, state, geometry
///             out: wi.x wi.y wi.z, weight.x .y .z (f |cos| / pdf), pdf
///                  [, pdf_reverse], lobe (i32: which), flags (i32: SampleFlag)
///   wanted    both: kinds (i32: LobeKind bits of what f is of, or of the lobe that was sampled)
///   min_alpha sample only: alpha (the mean one of the facets that the sample is of; 0 of mirrors,
///             and of lobes that have none), for the slot of that name where the path goes on
///   by lobe   both: f.lobe<k>.*, weight.lobe<k>.*: what lobe k adds to f or weight
///   albedo    out: albedo.x .y .z     fraction of light that scatters, at wo; at most 1, also
///                                     where weights above 1 let more leave than arrives
///   emission  out: emission.x .y .z   radiance towards wo
///                  [, pdf: where `emit` is asked for too, the density with which it gives wo]
///   emit      in:  u.x u.y u.z, geometry but wo
///             out: emitted.x .y .z: unit, from the point, on either side as `emission` has light
///                  there; weight.x .y .z (emission |cos emitted| / pdf, by the geometric normal:
///                  what a path of light carries there); pdf by solid angle, 0 where there is no
///                  light or none was found. Absent where nothing emits
///   opacity   out: opacity, transmission.x .y .z: of a ray that meets the
///             surface, 1 - opacity + opacity * transmission goes straight on
///   shadow    out: presence, opacity_color.x .y .z: of light that goes straight on through the
///             point, bent or scattered by nothing, presence * opacity_color is held back. That is
///             1 - transmission, less what smooth thin walls and interfaces of index 1 let pass,
///             which `sample` gives as deltas along -wo as well. Absent where all is held back
///   interior  out: eta [, absorption.x .y .z, scattering.x .y .z, anisotropy]: the index over that
///             outside, which is vacuum's without the channel "exterior_index", and the medium
///             where there is one, per unit of length; of several interfaces the mean by how much
///             is seen of each. Absent where light cannot enter
///   subsurface  in: of_lobe (i32): what `sample` says with sample_subsurface
///             out: absorption.x .y .z, scattering.x .y .z, anisotropy: what light is in below the
///                  surface, per unit of length; albedo.x .y .z: the share that leaves again;
///                  normal.x .y .z: unit, towards wo, to leave about. Absent where no light
///                  goes below; asked for it, `evaluate` leaves that light out, and `sample`
///                  sends it there
///   point     out: what KernelRequest::with_begin names; besides the above
///             normal.x .y .z          unit, towards wo: the lobes' mean, as `sample` picks them
///             roughness               [0, 1]: their mean
struct SurfaceKernels {
  /// Channels as listed above.
  /// @{
  std::vector<SliceOutput> evaluate, sample, albedo, emission, opacity, interior, subsurface,
      shadow, emit, point;
  /// @}
  /// One line for each thing that was left out, with the reason.
  std::vector<std::string> manifest;
  /// Those lines of it that change the picture, such as a medium inside.
  std::vector<std::string> not_modelled;
  /// `lobe` counts in this order.
  std::vector<LobeInfo> lobes;
  bool complete = true;  ///< Else `may_go_on` said no, and the rest is of no use.
};

/// Bits of the channel `flags` of sample.
enum SampleFlag : std::int32_t {
  sample_valid = 1,  ///< Else weight and pdfs are 0.
  sample_delta = 2,  ///< pdf is a discrete probability; evaluate gives 0.
  /// wi and wo are on different sides of the surface itself, by the geometric normal Ng:
  /// what a ray along wi passes through, whatever normal it was shaded by (Veach 1997,
  /// "Robust Monte Carlo Methods", section 5.3).
  sample_transmission = 4,
  /// Light goes on below the surface: along wi, drawn by its cosine to Ng, in the medium that the
  /// kernel `subsurface` gives. Where it meets the surface again it leaves, as from paper: into all
  /// directions of the outside by their cosine to the normal. With sample_delta, as no direction
  /// outside leads there.
  sample_subsurface = 8,
};

/// Records the kernels of `surface`. Everything in `surface` must have been
/// recorded on `recorder`, at top level. `may_go_on` is asked before each lobe of each
/// kernel: a surface may have more of them than anybody wants to compile.
SurfaceKernels record_kernels(Recorder& recorder, const Surface& surface, Accuracy accuracy,
                              const KernelRequest& request,
                              const std::function<bool()>& may_go_on = {});

}  // namespace nacre
