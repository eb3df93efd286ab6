#include "examples/render/render_counts.h"

namespace nacre::host {

void RenderCounts::add(const RenderCounts& other) {
  paths += other.paths;
  rays += other.rays;
  shadow_rays += other.shadow_rays;
  invalid_results += other.invalid_results;
  beyond_bound += other.beyond_bound;
  media_dropped += other.media_dropped;
  paths_cut += other.paths_cut;
  shading_seconds += other.shading_seconds;
  tracing_seconds += other.tracing_seconds;
}

}  // namespace nacre::host
