// Bytes as a light profile: what is taken for one is whole, and can be sampled.
#include "pbs/profile/ies.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "pbs/profile/profile_tables.h"
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
  const ProfileTables tables = make_profile_tables(*profile);
  const std::size_t places = tables.vertical.size() * tables.horizontal.size();
  if (tables.intensity.size() != places || tables.below.size() != places) {
    fuzz::fail("values of the tables are missing");
  }
  if (!(tables.total >= 0.0) || !std::isfinite(tables.total)) fuzz::fail("the total is no number");
  if (!std::ranges::is_sorted(tables.before)) fuzz::fail("what is before an angle decreases");
  for (std::size_t i = 0; i < places; ++i) {
    const bool begins = i % tables.vertical.size() == 0;
    const float least = begins ? 0.0f : tables.below[i - 1];
    if (!(tables.below[i] >= least && std::isfinite(tables.below[i]))) {
      fuzz::fail("what is below an angle decreases");
    }
  }
  return 0;
}
