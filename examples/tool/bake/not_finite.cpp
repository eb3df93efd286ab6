#include "examples/tool/bake/not_finite.h"

#include <fmt/format.h>

#include <cstdint>

namespace nacre::tool {

void report_not_finite(const host::TexelStatistics& map, const SourceLocation& where,
                       Diagnostics& diagnostics) {
  std::uint64_t finite = 0, infinite = 0, no_number = 0;
  for (const host::ChannelStatistics& channel : map.channels) {
    finite += channel.finite;
    infinite += channel.unbounded;
    no_number += channel.no_number;
  }
  if (infinite + no_number == 0) return;
  diagnostics.warning("not-finite", where, "numbers of the map are infinite or NaN", "finite ones",
                      fmt::format("{} infinite and {} NaN of {}", infinite, no_number,
                                  finite + infinite + no_number));
}

}  // namespace nacre::tool
