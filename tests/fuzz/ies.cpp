// Bytes as a light profile: what is taken for one is whole.
#include "pbs/profile/ies.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tests/fuzz/host.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  IesFault fault;
  const auto profile = parse_ies({reinterpret_cast<const char*>(data), size}, fault);
  if (!profile) {
    if (fault.line < 1 || fault.message.empty()) fuzz::fail("a fault without a place or a reason");
    return 0;
  }
  const std::size_t pairs = profile->vertical.size() * profile->horizontal.size();
  if (profile->intensity.size() != pairs) fuzz::fail("values are missing");
  const double all = emittance(*profile);
  if (!(all >= 0.0) || !std::isfinite(all)) fuzz::fail("the emittance is no number");
  return 0;
}
