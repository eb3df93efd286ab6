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
    const auto kernel = opened_.system->compile_outputs(*opened_.document, {job.request},
                                                        options_.shader, diagnostics_);
    if (kernel == nullptr) return;
    host::BakeSettings settings = options_.settings;
    settings.width = texture.width;
    settings.height = texture.height;
    // What asks for nothing of a point is the same at all of them.
    if (kernel->kernel.program().inputs.empty()) {
      settings.width = settings.height = 1;
      return set_value(job, host::bake_image(*kernel, 0, settings));
    }
    bake_texture(job, *kernel, settings, texture);
  }

  void bake_texture(const BakedDocument::Job& job, const OutputKernel& kernel,
                    const host::BakeSettings& settings, const TextureSettings& texture) {
    const fs::path file = absolute_path(fs::path(options_.folder) / (job.stem + texture.extension));
    host::TexelRange range;
    ProgressLine line(job.stem, options_.quiet);
    const host::BakeControl control{.stop = stop_,
                                    .progress = [&](double share) { line.update(share); }};
    if (!host::bake_to_file(kernel, 0, settings, texture.encoding, file.string(), diagnostics_,
                            control, &range)) {
      return;
    }
    std::error_code error;
    if (range.is_uniform()) {
      fs::remove(file, error);
      return set_value(job, range.least);
    }
    check_range(job, texture, range);
    const std::string relative = file.lexically_relative(folder_).generic_string();
    baked_.set_texture(job, relative.empty() ? file.string() : relative,
                       host::texture_colorspace(job.type, texture.extension, texture.encoding));
    if (!options_.quiet) fmt::print("{}\n", file.lexically_relative(absolute_path(".")).string());
  }

  void set_value(const BakedDocument::Job& job, const std::vector<float>& texel) {
    const bool finite =
        std::all_of(texel.begin(), texel.end(), [](float x) { return std::isfinite(x); });
    if (finite) return baked_.set_value(job, texel);
    diagnostics_.error("cannot-bake", {options_.document, 0, 0, job.stem},
                       "the value is not a finite number");
  }

  /// Whole numbers hold 0 to 1, or -1 to 1 for directions; more would be cut off.
  void check_range(const BakedDocument::Job& job, const TextureSettings& texture,
                   const host::TexelRange& range) {
    const bool is_limited =
        host::holds_unit_range_only(texture.extension) ||
        host::texture_colorspace(job.type, texture.extension, texture.encoding) == "srgb_texture";
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
