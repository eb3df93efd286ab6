#pragma once

#include <memory>

#include "jit/glsl/module.h"
#include "jit/graph/graph.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// Thrown where a lobe is asked for something that its text cannot be recorded for, after the
/// diagnostic was added. Regions are left open: nothing more can be recorded.
struct LobeFailure {};

struct TextLobeOptions {
  glsl::RecordLimits limits;  ///< Of each call.
  /// What the text says is held to what lobes promise; see TextLobe.
  bool is_held = true;
};

/// Sets a node's output, a BSDF, to the lobe whose functions the text has
/// (text_lobe_functions.h), times its input `weight` if it has one. False, with diagnostics, where
/// one of them is missing or does not fit. The others are said when the kernels are recorded.
///
/// Directions are unit vectors that lead away from the point, in a frame whose z is the normal (the
/// input `normal`, or the shading normal) turned to the viewer: wo.z is in [0, 1]. x is the input
/// `tangent`, made orthogonal; any direction where there is none.
///
///   evaluate    the scattering function times |wi.z|
///   sample      a direction by up to three independent numbers in [0, 1); zero: none
///   pdf         its density, by solid angle
///   albedo      the integral of evaluate over all wi
///   throughput  what passes to layers below; without it 1 - albedo
///   roughness   for images of it, in [0, 1]; a lobe that has it is glossy, else it is diffuse
///
/// Light is scattered to where wi.z > 0; NodeText::sides may ask for wi.z < 0, or both. The
/// functions are not asked about other wi, and samples there are lost. `diagnostics` of the call
/// must live until the kernels are recorded.
bool set_text_lobe(const NodeText& source, std::shared_ptr<const glsl::Module> module,
                   NodeCall& call, const TextLobeOptions& options, Diagnostics& diagnostics);

/// Records all functions of the lobe that set_text_lobe has set, for their diagnostics: false
/// where there are any.
bool try_text_lobe(Recorder& recorder, const NodeCall& call);

}  // namespace nacre
