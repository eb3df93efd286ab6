/// \file
/// What every closure must hold, tried on a compiled material: for the tests of hosts that write
/// lobes, and for anybody who wants to know what a material does with light. Not part of
/// <nacre/nacre.hpp>.
#ifndef NACRE_LOBE_TEST_HPP
#define NACRE_LOBE_TEST_HPP

#include <nacre/lobe_test/report.hpp>
#include <nacre/lobe_test/trial.hpp>

namespace nacre {
inline namespace v0 {

/// Looks at a material from each direction of the options: see LobeFault for the laws. All of them
/// hold by chance in 999 of 1000 seeds where there is no fault.
/// Throws Error where the shader lacks NACRE_SAMPLE, NACRE_EVALUATE or NACRE_ALBEDO.
inline LobeReport test_lobes(const Shader& shader, const LobeTestOptions& options = {}) {
  int kinds = 0;
  for (const LobeInfo& lobe : shader.lobes()) kinds |= lobe.kinds;
  LobeReport report;
  detail::LobeProbe probe(shader, options.instance, options.bind);
  for (const Direction& wo : options.wo) detail::LobeTrial(probe, options, kinds, wo).run(report);
  return report;
}

}  // namespace v0
}  // namespace nacre

#endif
