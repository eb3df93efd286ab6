#include "examples/tool/render_answer.h"

#include <nlohmann/json.hpp>

namespace nacre::tool {

using Json = nlohmann::ordered_json;

Json unwritten_picture(const RenderOptions& options) {
  return {{"document", options.common.file}, {"file", options.out}, {"written", false}};
}

Json written_picture(const RenderOptions& options, const host::RenderStatistics& statistics) {
  Json passes = Json::array();
  for (const host::Pass& pass : options.settings.passes.passes) passes.push_back(pass.name);
  Json answer = unwritten_picture(options);
  answer["written"] = true;
  answer["width"] = options.settings.width;
  answer["height"] = options.settings.height;
  if (const auto& crop = options.settings.crop) {
    answer["crop"] = {crop->x0, crop->y0, crop->x1, crop->y1};
  }
  answer["passes"] = std::move(passes);
  answer["samples"] = {{"asked", options.settings.samples},
                       {"least", statistics.least_samples},
                       {"mean", statistics.mean_samples},
                       {"most", statistics.most_samples},
                       {"whole", statistics.is_whole}};
  answer["paths"] = statistics.paths;
  answer["rays"] = statistics.rays;
  answer["shadow_rays"] = statistics.shadow_rays;
  answer["shading_cpu_seconds"] = statistics.shading_seconds;
  answer["tracing_cpu_seconds"] = statistics.tracing_seconds;
  return answer;
}

}  // namespace nacre::tool
