#include "examples/tool/bake_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "examples/common/atomic_file.h"
#include "examples/common/image_writer.h"
#include "examples/tool/baked_document.h"
#include "examples/tool/file_stems.h"
#include "examples/tool/plane_reads.h"
#include "examples/tool/process.h"
#include "examples/tool/sampling_request.h"
#include "examples/tool/stop.h"
#include "jit/graph/build/build.h"

namespace nacre::tool {

namespace {

namespace fs = std::filesystem;

fs::path absolute_path(const fs::path& path) {
  std::error_code error;
  return fs::absolute(path, error).lexically_normal();
}

const std::vector<UdimTile> one_tile(1);

/// Textures have at most four channels: a matrix takes one for each of its rows.
int matrix_rows(Type type) {
  if (type == Type::matrix33) return 3;
  return type == Type::matrix44 ? 4 : 1;
}

/// The whole numbers that channels of so many bits hold without a gap.
float largest_integer(int bits) { return bits == 16 ? 2048.0f : 16777216.0f; }

/// The texel of a uniform map.
std::vector<float> least_of(const host::TexelStatistics& statistics) {
  std::vector<float> texel;
  for (const host::ChannelStatistics& channel : statistics.channels) texel.push_back(channel.least);
  return texel;
}

class MaterialBaker {
 public:
  MaterialBaker(const DocumentBake& options, const Opened& opened, const Definitions& definitions,
                BakeReport& report, Diagnostics& diagnostics)
      : options_(options),
        opened_(opened),
        report_(report),
        diagnostics_(diagnostics),
        reads_(diagnostics),
        folder_(absolute_path(options.document).parent_path()),
        baked_(*opened.document, definitions, options.shader.graph.lenient, folder_.string(),
               diagnostics) {}

  void run() {
    promise_files({options_.document});
    if (!is_new_document() || !host::prepare_output(options_.document, diagnostics_) ||
        !host::prepare_folder(options_.folder, diagnostics_)) {
      return;
    }
    const std::size_t errors = diagnostics_.error_count();
    for (const std::string& material : options_.materials) baked_.add_material(material);
    baked_.finish_source();
    for (const BakedDocument::Job& job : baked_.jobs()) {
      if (stop().is_due() || diagnostics_.error_count() != errors) return;
      bake(job);
    }
    if (!stop().is_due() && diagnostics_.error_count() == errors) write();
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
    for (const std::string& file : opened_.document->files()) {
      std::error_code error;
      if (!fs::equivalent(file, options_.document, error)) continue;
      diagnostics_.error("output-is-input", {options_.document, 0, 0, {}},
                         "the baked document would replace the one it is made from",
                         "another name");
      return false;
    }
    return true;
  }

  void bake(const BakedDocument::Job& job) {
    if (const auto known = results_.find(job.source); known != results_.end()) {
      return finish(job, known->second);
    }
    TextureSettings texture;
    if (!texture_settings(options_.textures, job.output, texture, diagnostics_)) return;
    texture.encoding.is_direction = !job.frame.empty();
    texture.encoding.encodes_vectors = false;  // The document reads them as they are.
    texture.encoding.is_tile = !options_.tiles.empty();
    ShaderOptions shader = with_profile(opened_, job.request, false, options_.shader, diagnostics_);
    shader.graph.output_space = host::output_space(texture.extension, texture.encoding);
    shader.compile.stop = stop_from_now(shader.compile);
    const auto graph = build_graph(*opened_.document, opened_.system->library(),
                                   {.outputs = {job.request}, .material = {}},
                                   opened_.system->graph_options(shader), diagnostics_);
    const auto kernel =
        graph ? opened_.system->compile_outputs(*graph, shader, diagnostics_) : nullptr;
    if (kernel == nullptr) return;
    reads_.warn(*graph, kernel->kernel.program(), !job.frame.empty(), where_of(job));
    host::BakeSettings settings = options_.settings;
    settings.width = texture.width;
    settings.height = texture.height;
    // What asks for nothing of a point is the same at all of them.
    if (kernel->kernel.program().inputs.empty()) {
      settings.width = settings.height = 1;
      const std::vector<float> texel = host::bake_image(*kernel, 0, settings);
      if (texel.empty()) return host::report_too_many_steps(kernel->outputs[0], diagnostics_);
      return set_value(job, texel, shader.graph.output_space);
    }
    bake_texture(job, *kernel, settings, texture);
    report_code(kernel->kernel, shader, diagnostics_);
  }

  /// A texture for every tile, of a matrix for every row; or a value, where all
  /// texels of all of them are alike.
  void bake_texture(const BakedDocument::Job& job, const OutputKernel& kernel,
                    host::BakeSettings settings, TextureSettings& texture) {
    const std::string whole = stems_.stem_of(job.stem, where_of(job), diagnostics_);
    std::vector<std::unique_ptr<host::PartialFile>> files;
    std::vector<std::string> names;
    std::vector<BakedMap> maps;
    host::TexelStatistics all;
    warn_of_no_mean(settings.sampling, job.type, where_of(job), diagnostics_);
    const int rows = matrix_rows(job.type);
    for (int row = 0; row < rows; ++row) {
      host::TexelStatistics row_all;
      texture.encoding.first_channel = row * rows;
      texture.encoding.channels = rows == 1 ? 0 : rows;
      const std::string stem = rows == 1 ? whole : fmt::format("{}.row{}", whole, row + 1);
      for (const UdimTile& tile : options_.tiles.empty() ? one_tile : options_.tiles) {
        settings.corner_u = tile.u;
        settings.corner_v = tile.v;
        const fs::path file = file_of(stem, options_.tiles.empty() ? "" : tile.number(), texture);
        const Stopwatch watch;
        host::TextureReport report;
        report.is_judged = !options_.textures.clip;
        report.histogram = report_.form() == BakeReport::Form::json;
        files.push_back(bake_file(kernel, settings, texture, file, report));
        if (files.back() == nullptr) return;
        row_all.add(report.statistics);
        maps.push_back({file.lexically_relative(absolute_path(".")).string(), job.stem, job.type,
                        texture, report.statistics, watch.seconds()});
      }
      names.push_back(relative(file_of(stem, options_.tiles.empty() ? "" : "<UDIM>", texture)));
      all.channels.insert(all.channels.end(), row_all.channels.begin(), row_all.channels.end());
    }
    if (all.is_uniform()) {
      return set_value(job, least_of(all), host::output_space(texture.extension, texture.encoding));
    }
    if (!check_range(job, texture, all)) return;
    for (const auto& file : files) {
      if (!host::commit(*file, diagnostics_)) return;
      const fs::path path = file->path();
      file_is_written(path.lexically_relative(absolute_path(".")).string(), options_.quiet);
    }
    for (BakedMap& map : maps) report_.add(std::move(map));
    if (!options_.tiles.empty()) baked_.set_tiles(options_.tiles);
    finish(
        job,
        remember(job, {{},
                       std::move(names),
                       host::texture_colorspace(job.type, texture.extension, texture.encoding)}));
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

  fs::path file_of(const std::string& stem, const std::string& tile,
                   const TextureSettings& texture) const {
    const std::string name =
        fmt::format("{}{}{}{}", stem, tile.empty() ? "" : ".", tile, texture.extension);
    return absolute_path(fs::path(options_.folder) / name);
  }

  /// As it reads from the document's folder.
  std::string relative(const fs::path& file) const {
    const std::string name = file.lexically_relative(folder_).generic_string();
    return name.empty() ? file.string() : name;
  }

  std::unique_ptr<host::PartialFile> bake_file(const OutputKernel& kernel,
                                               const host::BakeSettings& settings,
                                               const TextureSettings& texture, const fs::path& file,
                                               host::TextureReport& report) {
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
    }
  }

  const DocumentBake& options_;
  const Opened& opened_;
  BakeReport& report_;
  Diagnostics& diagnostics_;
  PlaneReads reads_;
  FileStems stems_;
  std::map<std::string, Result> results_;  ///< By Job::source.
  fs::path folder_;
  BakedDocument baked_;
};

}  // namespace

void bake_document(const DocumentBake& options, const Opened& opened, BakeReport& report,
                   Diagnostics& diagnostics) {
  const Definitions definitions(*opened.document, &opened.system->library().definitions(),
                                diagnostics);
  MaterialBaker(options, opened, definitions, report, diagnostics).run();
}

}  // namespace nacre::tool
