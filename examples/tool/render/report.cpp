#include "examples/tool/render/report.h"

#include <fmt/format.h>

#include "examples/render/media.h"

namespace nacre::tool {

namespace {

void report_invalid_results(const host::RenderStatistics& statistics, Diagnostics& diagnostics) {
  if (statistics.invalid_results == 0) return;
  diagnostics.warning("invalid-results", {},
                      "some results of kernels were not finite and were left out", "finite numbers",
                      fmt::format("{} that were not", statistics.invalid_results));
}

void report_media(const host::RenderStatistics& statistics, Diagnostics& diagnostics) {
  if (statistics.paths_cut != 0) {
    diagnostics.warning("paths-cut", {},
                        "some light was scattered too often in media and is missing",
                        "more --max-scatterings",
                        fmt::format("{} of {} paths", statistics.paths_cut, statistics.paths));
  }
  if (statistics.beyond_bound != 0) {
    diagnostics.warning("dense-volume", {},
                        "a volume is denser in places than was found before: more noise there", {},
                        fmt::format("{} times", statistics.beyond_bound));
  }
  if (statistics.media_dropped != 0) {
    diagnostics.warning("media-dropped", {}, "some media lie in too many others and were left out",
                        fmt::format("{} within one another", host::Media::capacity),
                        fmt::format("{} times", statistics.media_dropped));
  }
}

}  // namespace

void report_left_out(const host::RenderStatistics& statistics, Diagnostics& diagnostics) {
  report_invalid_results(statistics, diagnostics);
  report_media(statistics, diagnostics);
}

}  // namespace nacre::tool
