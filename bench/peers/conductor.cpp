#include "bench/peers/conductor.h"

#include <bit>
#include <string_view>
#include <vector>

#include "bench/common/system.h"
#include "pbs/fresnel.h"
#include "pbs/microfacet.h"
#include "runtime/node/geometry.h"

namespace nacre::bench {

namespace {

Color3 slots(Recorder& recorder, const std::string& name, const float (&values)[3]) {
  const auto slot = [&](const char* suffix, float value) {
    return Float(
        recorder.parameter(name + suffix, Scalar::f32, std::bit_cast<std::uint32_t>(value)));
  };
  return {slot(".x", values[0]), slot(".y", values[1]), slot(".z", values[2])};
}

std::vector<SliceOutput> record_conductor(Recorder& recorder) {
  const Float3 wo = channel3(recorder, "wo");
  const Float3 wi = channel3(recorder, "wi");
  const Float2 alpha{Float(channel(recorder, "alpha", 0)), Float(channel(recorder, "alpha", 1))};
  const Float3 h = wo + wi;
  const Float length2 = dot(h, h);
  const Bool seen = (wo.z > 0.0f) & (wi.z > 0.0f) & (length2 > 1e-8f);
  const Float half_d = 0.5f * ggx_distribution(h, alpha);
  const Float root = ggx_root(wo, alpha);
  const Float pdf = half_d / max(fma(reflection_bound(wo, alpha), wo.z, root), 1e-30f);
  const Float both = fma(wi.z, root, wo.z * ggx_root(wi, alpha));
  const Float f = select(seen, half_d * wi.z / max(both, 1e-30f), 0.0f);
  const Float cosine = saturate(0.5f * sqrt(length2));
  const Color3 colour = Color3(f) * fresnel_conductor(cosine, slots(recorder, "n", gold_n),
                                                      slots(recorder, "k", gold_k));
  return {{"f.x", colour.x.ref()},
          {"f.y", colour.y.ref()},
          {"f.z", colour.z.ref()},
          {"pdf", select(seen, pdf, 0.0f).ref()}};
}

}  // namespace

std::unique_ptr<KernelRun> run_conductor(const CompileOptions& options, std::string& error) {
  Recorder recorder;
  const std::vector<SliceOutput> outputs = record_conductor(recorder);
  return run_recorded(recorder.program(), "conductor", outputs, options, error);
}

}  // namespace nacre::bench
