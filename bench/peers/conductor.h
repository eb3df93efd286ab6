#pragma once

#include <memory>
#include <string>

#include "jit/compile/compile.h"
#include "jit/tune/kernel_run.h"

namespace nacre::bench {

/// The reflection of a conductor in the local frame as the lobe's `evaluate` has it, less
/// the compensation for several reflections: f cos and the density of bounded visible
/// normals. In: wo.*, wi.*, alpha.x, alpha.y; slots n.*, k.*; out: f.*, pdf.
std::unique_ptr<KernelRun> run_conductor(const CompileOptions& options, std::string& error);

/// Complex index of gold at 630, 532 and 465 nm, rounded.
inline constexpr float gold_n[3] = {0.18f, 0.42f, 1.37f};
inline constexpr float gold_k[3] = {3.42f, 2.35f, 1.77f};

}  // namespace nacre::bench
