// Bytes as the image that lights a scene: read, its tables built, looked up and sampled.
#include "examples/render/environment.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/host.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  static const fuzz::MemoryFile file(".image");
  file.write(fuzz::as_text(data, size));
  ImageLimits limits;
  limits.max_size = 512;
  limits.max_bytes = 4 << 20;
  Diagnostics diagnostics;
  const auto environment = host::Environment::load(file.path(), 1.5f, 0.25f, limits, diagnostics);
  if (environment.has_value() == diagnostics.has_errors()) {
    fuzz::fail("an environment is refused without a reason, or there with an error");
  }
  if (!environment) return 0;
  for (const float u : {0.f, 0.25f, 0.999f}) {
    const auto sample = environment->sample({u, 1.f - u});
    if (!std::isfinite(sample.pdf) || !std::isfinite(sample.radiance.x)) {
      fuzz::fail("an environment gives samples that are not finite");
    }
    const auto light = environment->light(sample.wi);
    if (!std::isfinite(light.pdf) || !std::isfinite(light.radiance.x)) {
      fuzz::fail("an environment gives light that is not finite");
    }
  }
  return 0;
}
