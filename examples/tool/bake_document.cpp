#include "examples/tool/bake_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "examples/common/atomic_file.h"
#include "examples/tool/baked_document.h"

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

class MaterialBaker {
 public:
  MaterialBaker(const DocumentBake& options, const Opened& opened, const Definitions& definitions,
                const std::stop_token& stop, Diagnostics& diagnostics)
      : options_(options),
        opened_(opened),
        stop_(stop),
        diagnostics_(diagnostics),
        folder_(absolute_path(options.document).parent_path()),
        baked_(*opened.document, definitions, folder_.string(), diagnostics) {}

  void run() {
    const std::size_t errors = diagnostics_.error_count();
    for (const std::string& material : options_.materials) baked_.add_material(material);
    baked_.finish_source();
    for (const BakedDocument::Job& job : baked_.jobs()) {
      if (stop_.stop_requested() || diagnostics_.error_count() != errors) return;
      bake(job);
    }
    if (diagnostics_.error_count() == errors) write();
  }

 private:
  void bake(const BakedDocument::Job& job) {
    TextureSettings texture;
    if (!texture_settings(options_.textures, job.output, texture, diagnostics_)) return;
    texture.encoding.is_direction = !job.frame.empty();
    texture.encoding.encodes_vectors = false;  // The document reads them as they are.
    texture.encoding.is_tile = !options_.tiles.empty();
    ShaderOptions shader = options_.shader;
    shader.graph.output_space = host::output_space(texture.extension, texture.encoding);
    const auto kernel =
        opened_.system->compile_outputs(*opened_.document, {job.request}, shader, diagnostics_);
    if (kernel == nullptr) return;
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
  }

  /// A texture for every tile, of a matrix for every row; or a value, where all
  /// texels of all of them are alike.
  void bake_texture(const BakedDocument::Job& job, const OutputKernel& kernel,
                    host::BakeSettings settings, TextureSettings& texture) {
    std::vector<fs::path> files;
    std::vector<std::string> names;
    host::TexelRange all;
    const int rows = matrix_rows(job.type);
    for (int row = 0; row < rows; ++row) {
      host::TexelRange range;
      texture.encoding.first_channel = row * rows;
      texture.encoding.channels = rows == 1 ? 0 : rows;
      const std::string stem = rows == 1 ? job.stem : fmt::format("{}.row{}", job.stem, row + 1);
      for (const UdimTile& tile : options_.tiles.empty() ? one_tile : options_.tiles) {
        settings.corner_u = tile.u;
        settings.corner_v = tile.v;
        files.push_back(file_of(stem, options_.tiles.empty() ? "" : tile.number(), texture));
        if (!bake_file(kernel, settings, texture, files.back(), range)) return;
      }
      names.push_back(relative(file_of(stem, options_.tiles.empty() ? "" : "<UDIM>", texture)));
      all.least.insert(all.least.end(), range.least.begin(), range.least.end());
      all.most.insert(all.most.end(), range.most.begin(), range.most.end());
    }
    std::error_code error;
    if (all.is_uniform()) {
      for (const fs::path& file : files) fs::remove(file, error);
      return set_value(job, all.least, host::output_space(texture.extension, texture.encoding));
    }
    check_range(job, texture, all);
    baked_.set_texture(job, names,
                       host::texture_colorspace(job.type, texture.extension, texture.encoding));
    if (!options_.tiles.empty()) baked_.set_tiles(options_.tiles);
    if (options_.quiet) return;
    for (const fs::path& file : files) {
      fmt::print("{}\n", file.lexically_relative(absolute_path(".")).string());
    }
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

  bool bake_file(const OutputKernel& kernel, const host::BakeSettings& settings,
                 const TextureSettings& texture, const fs::path& file, host::TexelRange& range) {
    ProgressLine line(file.stem().string(), options_.quiet);
    const host::BakeControl control{.stop = stop_,
                                    .progress = [&](double share) { line.update(share); }};
    return host::bake_to_file(kernel, 0, settings, texture.encoding, file.string(), diagnostics_,
                              control, &range);
  }

  void set_value(const BakedDocument::Job& job, const std::vector<float>& texel,
                 std::string_view colorspace) {
    const bool finite =
        std::all_of(texel.begin(), texel.end(), [](float x) { return std::isfinite(x); });
    if (finite) return baked_.set_value(job, texel, colorspace);
    diagnostics_.error("cannot-bake", {options_.document, 0, 0, job.stem},
                       "the value is not a finite number");
  }

  /// Whole numbers hold 0 to 1, or -1 to 1 for directions; more would be cut off.
  void check_range(const BakedDocument::Job& job, const TextureSettings& texture,
                   const host::TexelRange& range) {
    if (job.type == Type::integer) check_integers(job, texture.encoding.bits, range);
    const bool is_limited =
        host::holds_unit_range_only(texture.extension) ||
        host::is_srgb(host::texture_colorspace(job.type, texture.extension, texture.encoding));
    if (!is_limited) return;
    constexpr float rounding = 1e-5f;
    const float lowest = job.frame.empty() ? 0.0f : -1.0f;
    const float least = *std::min_element(range.least.begin(), range.least.end());
    const float most = *std::max_element(range.most.begin(), range.most.end());
    if (least >= lowest - rounding && most <= 1.0f + rounding) return;
    diagnostics_.error("out-of-range", {options_.document, 0, 0, job.stem},
                       "the texture cannot hold these values; exr and tx can",
                       fmt::format("{} to 1", lowest), fmt::format("{} to {}", least, most));
  }

  void check_integers(const BakedDocument::Job& job, int bits, const host::TexelRange& range) {
    const float limit = largest_integer(bits);
    if (range.least[0] >= -limit && range.most[0] <= limit) return;
    diagnostics_.error("out-of-range", {options_.document, 0, 0, job.stem},
                       "the texture cannot hold these integers", fmt::format("-{0} to {0}", limit),
                       fmt::format("{} to {}", range.least[0], range.most[0]));
  }

  void write() {
    const std::string text = baked_.text();
    const auto fill = [&](const std::string& path) -> std::string {
      std::ofstream stream(path, std::ios::binary | std::ios::trunc);
      stream.write(text.data(), static_cast<std::streamsize>(text.size()));
      stream.close();
      return stream ? "" : "the data cannot be written";
    };
    if (host::write_atomically(options_.document, fill, diagnostics_) && !options_.quiet) {
      fmt::print("{}\n", options_.document);
    }
  }

  const DocumentBake& options_;
  const Opened& opened_;
  const std::stop_token& stop_;
  Diagnostics& diagnostics_;
  fs::path folder_;
  BakedDocument baked_;
};

}  // namespace

void bake_document(const DocumentBake& options, const Opened& opened, const std::stop_token& stop,
                   Diagnostics& diagnostics) {
  const Definitions definitions(*opened.document, &opened.system->library().definitions(),
                                diagnostics);
  MaterialBaker(options, opened, definitions, stop, diagnostics).run();
}

}  // namespace nacre::tool
