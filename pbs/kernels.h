#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pbs/surface.h"
#include "runtime/program/slice.h"

namespace nacre {

/// What a host wants of a surface's kernels; only this is recorded.
struct KernelRequest {
  std::int32_t lobes = lobe_all;  ///< LobeKind bits; others are left out for good.
  bool lobe_mask = false;         ///< Lobes can be switched off by the slot "lobe_mask" too.
  bool reverse_pdf = false;       ///< The density of wo given wi as well.
  bool evaluate_at = false;       ///< Also evaluate for one point and many directions.
};

/// The recorded entry points of one surface: named values for `slice`, all of
/// one recording. Empty: that kernel has nothing to compute.
///
///   evaluate  in:  wi.*, state, geometry
///             out: f.x f.y f.z (f |cos wi|), pdf [, pdf_reverse]
///   sample    in:  u.x u.y u.z, state, geometry
///             out: wi.x wi.y wi.z, weight.x .y .z (f |cos| / pdf), pdf
///                  [, pdf_reverse], lobe (i32: which), flags (i32: SampleFlag)
///   albedo    out: albedo.x .y .z     fraction of light that scatters, at wo
///   emission  out: emission.x .y .z   radiance towards wo
///   opacity   out: opacity, transmission.x .y .z: of a ray that meets the
///             surface, 1 - opacity + opacity * transmission goes straight on
struct SurfaceKernels {
  /// Channels as listed above.
  /// @{
  std::vector<SliceOutput> evaluate, sample, albedo, emission, opacity;
  /// @}
  /// One line for each thing that was left out, with the reason.
  std::vector<std::string> manifest;
  /// Those lines of it that change the picture, such as a medium inside.
  std::vector<std::string> not_modelled;
  /// Names of the lobes; `lobe` counts in this order.
  std::vector<std::string> lobes;
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
};

/// Records the kernels of `surface`. Everything in `surface` must have been
/// recorded on `recorder`, at top level. `may_go_on` is asked before each lobe of each
/// kernel: a surface may have more of them than anybody wants to compile.
SurfaceKernels record_kernels(Recorder& recorder, const Surface& surface, Accuracy accuracy,
                              const KernelRequest& request,
                              const std::function<bool()>& may_go_on = {});

}  // namespace nacre
