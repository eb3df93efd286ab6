#include "examples/tool/render/answer.h"

#include <nlohmann/json.hpp>

namespace nacre::tool {

using Json = nlohmann::ordered_json;

Json unwritten_picture(const RenderOptions& options, const Picture& picture) {
  Json answer{{"document", options.common.file}, {"file", picture.file}, {"written", false}};
  if (!options.series.cameras.empty()) answer["camera"] = picture.camera_name;
  if (picture.frame) answer["frame"] = *picture.frame;
  return answer;
}

Json skipped_picture(const RenderOptions& options, const Picture& picture) {
  Json answer = unwritten_picture(options, picture);
  answer["skipped"] = true;
  return answer;
}

Json written_picture(const RenderOptions& options, const host::RenderSettings& settings,
                     const Picture& picture, const host::RenderStatistics& statistics) {
  Json passes = Json::array();
  for (const host::Pass& pass : settings.passes.passes) passes.push_back(pass.name);
  Json answer = unwritten_picture(options, picture);
  answer["written"] = true;
  answer["width"] = settings.width;
  answer["height"] = settings.height;
  if (const auto& crop = settings.crop) {
    answer["crop"] = {crop->x0, crop->y0, crop->x1, crop->y1};
  }
  answer["passes"] = std::move(passes);
  answer["samples"] = {{"asked", settings.samples},
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

Json final_answer(const RenderOptions& options, const Json& pictures) {
  const Json& list = pictures["pictures"];
  if (options.series.is_series()) return {{"document", options.common.file}, {"pictures", list}};
  if (!list.empty()) return list.front();
  Picture none;
  none.file = options.out;
  return unwritten_picture(options, none);
}

void report_skipped(const std::string& file, Diagnostics& diagnostics) {
  Diagnostic said;
  said.severity = Severity::note;
  said.code = "skipped";
  said.where.file = file;
  said.message = "the image is there, and not rendered again";
  diagnostics.add(said);
}

}  // namespace nacre::tool
