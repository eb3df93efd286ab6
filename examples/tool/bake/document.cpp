#include "examples/tool/bake/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <set>

#include "examples/bake/plane_tiles.h"
#include "examples/common/atomic_file.h"
#include "examples/common/image_writer.h"
#include "examples/tool/bake/baked_document.h"
#include "examples/tool/bake/map_plan.h"
#include "examples/tool/bake/not_finite.h"
#include "examples/tool/bake/output_compilation.h"
#include "examples/tool/bake/sampling_request.h"
#include "examples/tool/file_stems.h"
#include "examples/tool/output_files.h"
#include "examples/tool/paths.h"
#include "examples/tool/process.h"
#include "examples/tool/stop.h"

namespace nacre::tool {

namespace {

namespace fs = std::filesystem;

/// The whole numbers that channels of so many bits hold without a gap.
float largest_integer(int bits) { return bits == 16 ? 2048.0f : 16777216.0f; }

/// The texel of a uniform map, or the mean of others.
std::vector<float> texel_of(const host::TexelStatistics& statistics) {
  const bool is_uniform = statistics.is_uniform();
  std::vector<float> texel;
  for (const host::ChannelStatistics& channel : statistics.channels) {
    texel.push_back(is_uniform ? channel.least : static_cast<float>(channel.mean()));
  }
  return texel;
}

class MaterialBaker {
 public:
  MaterialBaker(const DocumentBake& options, const Opened& opened, const Definitions& definitions,
                BakeLedger& ledger, BakeTarget& target, BakeReport& report,
                Diagnostics& diagnostics)
      : options_(options),
        opened_(opened),
        ledger_(ledger),
        target_(target),
        report_(report),
        diagnostics_(diagnostics),
        folder_(absolute_path(options.document).parent_path()),
        baked_(*opened.document, definitions, options.shader.graph.lenient, folder_.string(),
               diagnostics) {
    baked_.set_uv_set(options.uv_set);
  }

  void run() {
    if (!options_.is_shard) promise_files({options_.document});
    if (!is_new_document() || !host::prepare_output(options_.document, diagnostics_) ||
        !host::prepare_folder(options_.folder, diagnostics_)) {
      return;
    }
    const std::size_t errors = diagnostics_.error_count();
    for (const std::string& material : options_.materials) baked_.add_material(material);
    baked_.finish_source();
    const auto& jobs = baked_.jobs();
    std::deque<Begun> begun;
    std::size_t next = 0;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      // The one after it is compiled while this one is baked.
      for (; next < std::min(i + 2, jobs.size()); ++next) begun.push_back(begin(jobs[next]));
      if (stop().is_due() || diagnostics_.error_count() != errors) return;
      finish(std::move(begun.front()));
      begun.pop_front();
    }
    const bool is_done = !stop().is_due() && diagnostics_.error_count() == errors;
    if (is_done && left_.empty() && !options_.is_shard) write();
  }

 private:
  /// What an input got; other inputs that the same feeds get it too.
  struct Result {
    std::vector<float> texel;        ///< Of a value, or
    std::vector<std::string> names;  ///< of a texture.
    std::string colorspace;
  };

  /// The document read must stay: what is baked cannot be had back from what is written.
  bool is_new_document() {
    const std::array<OutputFile, 1> outputs{{{"--document", options_.document}}};
    return check_outputs(outputs, opened_.document->files(), diagnostics_);
  }

  /// A job that others may begin before it is finished.
  struct Begun {
    std::string source;
    Diagnostics said;
    std::function<void()> rest = {};  ///< What is left to do, if anything.
  };

  Begun begin(const BakedDocument::Job& job) {
    Begun begun{.source = job.source, .said = {}};
    // What another has begun is known only once that is finished.
    if (unfinished_.contains(job.source)) {
      begun.rest = [this, &job] { finish(begin(job)); };
      return begun;
    }
    if (left_.contains(job.source)) return begun;
    if (const auto known = results_.find(job.source); known != results_.end()) {
      begun.rest = [this, &job, result = known->second] { finish(job, result); };
      return begun;
    }
    unfinished_.insert(job.source);
    begin_map(job, begun);
    return begun;
  }

  void finish(Begun begun) {
    for (const Diagnostic& one : begun.said.all()) diagnostics_.add(one);
    unfinished_.erase(begun.source);
    if (begun.rest) begun.rest();
  }

  void begin_map(const BakedDocument::Job& job, Begun& begun) {
    TextureSettings texture;
    if (!texture_settings(options_.textures, job.output, texture, begun.said)) return;
    texture.encoding.is_direction = !job.frame.empty();
    texture.encoding.encodes_vectors = false;  // The document reads them as they are.
    texture.encoding.is_tile = !options_.tiles.empty();
    texture.encoding.output = job.stem;
    const std::string stem = stems_.stem_of(job.stem, where_of(job), begun.said);
    MapPlan plan =
        plan_map(job.stem, job.type, stem, texture, options_.settings, options_.tiles,
                 {absolute_path(options_.folder), folder_, options_.textures.name}, ledger_);
    // Images that are not kept are not finished for whoever wants them.
    if (options_.average) {
      for (PlannedImage& image : plan.images) image.item.settings["average"] = "yes";
    }
    const std::string space = host::output_space(texture.extension, texture.encoding);
    if (const BakedRecord* const known = ledger_.value(plan.images.front().item)) {
      begun.rest = [this, &job, value = known->value, space] { set_value(job, value, space); };
      return;
    }
    for (PlannedImage& image : plan.images) image.step = ledger_.step(image.item, begun.said);
    if (!plan.has(BakeStep::bake)) {
      begun.rest = [this, &job, plan] { conclude(job, plan, {}); };
      return;
    }
    ShaderOptions shader = options_.shader;
    shader.graph.output_space = space;
    const auto compilation = std::make_shared<OutputCompilation>(opened_, job.request, shader);
    begun.rest = [this, &job, plan, compilation] { bake(job, plan, *compilation); };
  }

  void bake(const BakedDocument::Job& job, const MapPlan& plan, OutputCompilation& compilation) {
    const std::size_t errors = diagnostics_.error_count();
    const auto [graph, kernel] = compilation.finish(diagnostics_);
    if (kernel == nullptr) return;
    // Without an image, say, there is to be no document: nothing is finished then.
    const bool is_right = is_sound(*opened_.system, errors, diagnostics_);
    if (ledger_.is_recording() && !is_right) return;
    if (!target_.prepare(*graph, kernel->kernel.program(), !job.frame.empty(), where_of(job))) {
      return;
    }
    host::BakeSettings settings = options_.settings;
    // What asks for nothing of a point is the same at all of them, but for the frame it is in.
    const bool is_turned = !job.frame.empty() && settings.surface != nullptr;
    if (kernel->kernel.program().inputs.empty() && !is_turned) {
      settings.surface = nullptr;
      settings.width = settings.height = 1;
      const OutputKernel loaded =
          host::with_tiles(*kernel, 0, settings, opened_.system->textures(), diagnostics_);
      const std::vector<float> texel = host::bake_image(loaded, 0, settings);
      if (texel.empty()) return host::report_too_many_steps(kernel->outputs[0], diagnostics_);
      BakedRecord record;
      record.type = type_name(job.type);
      record.value = texel;
      if (is_sound(*opened_.system, errors, diagnostics_)) {
        ledger_.add_value(plan.images.front().item, record, loaded.kernel, diagnostics_);
      }
      return set_value(job, texel, compilation.shader().graph.output_space);
    }
    bake_map(job, *kernel, plan);
    report_code(kernel->kernel, compilation.shader(), diagnostics_);
  }

  /// Of each image what is not there yet.
  void bake_map(const BakedDocument::Job& job, const OutputKernel& kernel, const MapPlan& plan) {
    std::vector<Written> written;
    const std::size_t errors = diagnostics_.error_count();
    host::BakeSettings settings = options_.settings;
    settings.width = plan.texture.width;
    settings.height = plan.texture.height;
    settings.in_frame = !job.frame.empty();
    warn_of_no_mean(settings.sampling, job.type, where_of(job), diagnostics_);
    for (const PlannedImage& image : plan.images) {
      if (image.step != BakeStep::bake) continue;
      settings.corner_u = image.tile.u;
      settings.corner_v = image.tile.v;
      if (!target_.lay_out(settings)) return;
      const Stopwatch watch;
      host::TextureReport report;
      report.is_judged = !options_.textures.clip;
      report.histogram = report_.form() == BakeReport::Form::json;
      const TextureSettings texture = plan.texture_of(image.row);
      const fs::path path = image.item.path;
      const OutputKernel loaded =
          host::with_tiles(kernel, 0, settings, opened_.system->textures(), diagnostics_);
      auto file = bake_file(loaded, settings, texture, path, report);
      if (file == nullptr) return;
      const BakedMap map{shown(path),
                         job.stem,
                         job.type,
                         texture,
                         report.statistics,
                         watch.seconds(),
                         settings.surface != nullptr};
      // Else it has its name only once all of the map is known to be right.
      if (ledger_.is_recording()) {
        if (!host::commit(*file, diagnostics_)) return;
        // What lacks a tile, say, is written, but not finished.
        if (!is_sound(*opened_.system, errors, diagnostics_)) return;
        if (!ledger_.add(image.item, record_of(map), loaded.kernel, diagnostics_)) return;
        file_is_written(map.file, options_.quiet);
      }
      written.push_back({&image, std::move(file), map});
    }
    conclude(job, plan, std::move(written));
  }

  /// An image that this run has baked.
  struct Written {
    const PlannedImage* image;
    std::unique_ptr<host::PartialFile> file;
    BakedMap map;
  };

  /// All of a map at once, with those images that were there.
  std::vector<BakedMap> whole_map(const MapPlan& plan, const std::vector<Written>& written) const {
    std::vector<BakedMap> maps;
    auto next = written.begin();
    for (const PlannedImage& image : plan.images) {
      if (next != written.end() && next->image == &image) {
        maps.push_back((next++)->map);
      } else if (image.step == BakeStep::keep) {
        maps.push_back(kept_map(shown(image.item.path), ledger_.record(image.item),
                                plan.texture_of(image.row), target_.surface() != nullptr,
                                ledger_.is_merging()));
      }
    }
    return maps;
  }

  /// The input gets a texture; or a value, where all texels of all images are alike.
  void conclude(const BakedDocument::Job& job, const MapPlan& plan, std::vector<Written> written) {
    std::vector<BakedMap> maps = whole_map(plan, written);
    if (maps.size() < plan.images.size()) {
      for (BakedMap& map : maps) report_.add(std::move(map));
      left_.insert(job.source);
      return;
    }
    host::TexelStatistics all;
    const std::size_t of_a_row = maps.size() / static_cast<std::size_t>(plan.rows);
    for (std::size_t row = 0; row < maps.size(); row += of_a_row) {
      host::TexelStatistics row_all;
      for (std::size_t i = 0; i < of_a_row; ++i) row_all.add(maps[row + i].statistics);
      all.channels.insert(all.channels.end(), row_all.channels.begin(), row_all.channels.end());
    }
    const TextureSettings& texture = plan.texture;
    report_not_finite(all, where_of(job), diagnostics_);
    if (all.is_uniform() || (options_.average && host::has_mean(job.type))) {
      if (ledger_.is_recording()) {
        for (const PlannedImage& image : plan.images) ledger_.drop(image.item);
      }
      return set_value(job, texel_of(all), host::output_space(texture.extension, texture.encoding));
    }
    if (!check_range(job, texture, all)) return;
    for (const Written& one : written) {
      if (ledger_.is_recording()) break;
      if (!host::commit(*one.file, diagnostics_)) return;
      file_is_written(one.map.file, options_.quiet);
    }
    for (BakedMap& map : maps) report_.add(std::move(map));
    if (!options_.tiles.empty()) baked_.set_tiles(options_.tiles);
    finish(
        job,
        remember(job, {{},
                       plan.names,
                       host::texture_colorspace(job.type, texture.extension, texture.encoding)}));
  }

  /// As messages have it.
  static std::string shown(const fs::path& path) {
    return path.lexically_relative(absolute_path(".")).string();
  }

  const Result& remember(const BakedDocument::Job& job, Result result) {
    return results_.emplace(job.source, std::move(result)).first->second;
  }

  void finish(const BakedDocument::Job& job, const Result& result) {
    if (result.names.empty()) return baked_.set_value(job, result.texel, result.colorspace);
    baked_.set_texture(job, result.names, result.colorspace);
  }

  SourceLocation where_of(const BakedDocument::Job& job) const {
    if (job.output != nullptr) return location(*job.output);
    return {opened_.document->files().front(), 0, 0, job.stem};
  }

  std::unique_ptr<host::PartialFile> bake_file(const OutputKernel& kernel,
                                               const host::BakeSettings& settings,
                                               const TextureSettings& texture, const fs::path& file,
                                               host::TextureReport& report) {
    const std::array<const BoundKernel*, 1> kernels{&kernel.kernel};
    const OutputFile output{"the map of " + file.stem().string(), file.string()};
    if (!check_output(output, kernels, diagnostics_)) return nullptr;
    if (!host::prepare_image(file.string(), diagnostics_)) return nullptr;
    ProgressLine line(file.stem().string(), options_.quiet);
    const host::BakeControl control{.stop = stop().token(),
                                    .progress = [&](double share) { line.update(share); }};
    return host::bake_to_partial_file(kernel, 0, settings, texture.encoding, file.string(),
                                      diagnostics_, control, &report);
  }

  void set_value(const BakedDocument::Job& job, const std::vector<float>& texel,
                 std::string_view colorspace) {
    const bool finite =
        std::all_of(texel.begin(), texel.end(), [](float x) { return std::isfinite(x); });
    if (finite) {
      report_.add(BakedValue{job.stem, texel, std::string(colorspace)});
      return finish(job, remember(job, {texel, {}, std::string(colorspace)}));
    }
    diagnostics_.error("cannot-bake", {options_.document, 0, 0, job.stem},
                       "the value is not a finite number");
  }

  /// Whole numbers hold 0 to 1, or -1 to 1 for directions; more would be cut off.
  bool check_range(const BakedDocument::Job& job, const TextureSettings& texture,
                   const host::TexelStatistics& all) {
    if (job.type == Type::integer && !check_integers(job, texture.encoding.bits, all)) {
      return false;
    }
    const bool is_limited =
        host::holds_unit_range_only(texture.extension) ||
        host::is_srgb(host::texture_colorspace(job.type, texture.extension, texture.encoding));
    if (!is_limited || options_.textures.clip) return true;
    constexpr float rounding = 1e-5f;
    const float lowest = job.frame.empty() ? 0.0f : -1.0f;
    float least = all.channels[0].least;
    float most = all.channels[0].most;
    for (const host::ChannelStatistics& channel : all.channels) {
      least = std::min(least, channel.least);
      most = std::max(most, channel.most);
    }
    if (least >= lowest - rounding && most <= 1.0f + rounding) return true;
    diagnostics_.error("out-of-range", {options_.document, 0, 0, job.stem},
                       "the texture cannot hold these values; exr and tx can",
                       fmt::format("{} to 1", lowest), fmt::format("{} to {}", least, most));
    return false;
  }

  bool check_integers(const BakedDocument::Job& job, int bits, const host::TexelStatistics& all) {
    const float limit = largest_integer(bits);
    const host::ChannelStatistics& channel = all.channels[0];
    if (channel.least >= -limit && channel.most <= limit) return true;
    diagnostics_.error("out-of-range", {options_.document, 0, 0, job.stem},
                       "the texture cannot hold these integers", fmt::format("-{0} to {0}", limit),
                       fmt::format("{} to {}", channel.least, channel.most));
    return false;
  }

  void write() {
    if (host::write_text_atomically(options_.document, baked_.text(), diagnostics_)) {
      file_is_written(options_.document, options_.quiet);
      report_.set_document(options_.document);
      ledger_.set_document(options_.document);
    }
  }

  const DocumentBake& options_;
  const Opened& opened_;
  BakeLedger& ledger_;
  BakeTarget& target_;
  BakeReport& report_;
  Diagnostics& diagnostics_;
  FileStems stems_;
  std::map<std::string, Result> results_;  ///< By Job::source.
  std::set<std::string> left_;             ///< The same of what other shards have to bake, too,
  std::set<std::string> unfinished_;       ///< and of what was begun.
  fs::path folder_;
  BakedDocument baked_;
};

}  // namespace

void bake_document(const DocumentBake& options, const Opened& opened, BakeLedger& ledger,
                   BakeTarget& target, BakeReport& report, Diagnostics& diagnostics) {
  const Definitions definitions(*opened.document, &opened.system->library().definitions(),
                                diagnostics);
  MaterialBaker(options, opened, definitions, ledger, target, report, diagnostics).run();
}

}  // namespace nacre::tool
