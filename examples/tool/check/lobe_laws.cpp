// The only file of the tool that knows the public C++ interface, whose names are those of the
// library's own classes.
#include "examples/tool/check/lobe_laws.h"

#include <cmath>
#include <nacre/lobe_test.hpp>

namespace nacre::tool {

LobeFindings try_lobes(nacre_shader* shader, const LobeEffort& effort) {
  const nacre::Shader owned = nacre::Shader::adopt(shader);
  nacre::LobeTestOptions options;
  options.samples = effort.samples;
  options.most_energy = effort.most_energy;
  const nacre::LobeReport report = nacre::test_lobes(owned, options);
  LobeFindings findings;
  for (const nacre::LobeView& view : report.views) {
    findings.views.push_back({std::acos(std::fmin(view.wo.z, 1.0f)) * 57.29577951308232,
                              view.energy, view.albedo, view.valid, view.chi_square,
                              view.reciprocity, view.is_too_thin});
  }
  for (const nacre::LobeFault& fault : report.faults) {
    findings.faults.push_back({fault.law, fault.text, fault.found, fault.expected});
  }
  return findings;
}

}  // namespace nacre::tool
