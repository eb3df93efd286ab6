#include "examples/render/image_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "examples/common/atomic_file.h"
#include "examples/common/image_writer.h"
#include "examples/common/srgb.h"

namespace nacre::host {

namespace {

/// As a byte holds it.
float rounded(float v) {
  return static_cast<float>(static_cast<std::uint8_t>(255.f * v + 0.5f)) / 255.f;
}

/// Linear radiance as a screen shows it, 0 to 1.
Vec3 toned(Vec3 rgb, float white) {
  const float l = luminance(rgb);
  if (white > 0.f && l > 0.f) rgb = ((1.f + l / (white * white)) / (1.f + l)) * rgb;
  return {srgb_encode(rgb.x), srgb_encode(rgb.y), srgb_encode(rgb.z)};
}

using Planes = std::vector<std::vector<float>>;

Planes planes_of(const Film& film) {
  Planes planes(film.has_alpha() ? 4 : 3);
  for (std::vector<float>& plane : planes) plane.reserve(film.pixels().size());
  return planes;
}

void append(Planes& planes, Vec3 rgb, float alpha) {
  planes[0].push_back(rgb.x);
  planes[1].push_back(rgb.y);
  planes[2].push_back(rgb.z);
  if (planes.size() == 4) planes[3].push_back(alpha);
}

/// All pixels as the file has them, without alpha.
std::vector<Vec3> exposed(const Film& film, float exposure) {
  std::vector<Vec3> pixels;
  pixels.reserve(film.pixels().size());
  const float scale = std::exp2(exposure);
  for_pixels(film.window(), [&](int x, int y) {
    const float alpha = film.alpha(x, y);
    const Vec3 rgb = alpha > 0.f ? (1.f / alpha) * film.mean(x, y) : Vec3{};
    pixels.push_back(is_finite(rgb) ? scale * rgb : Vec3{});
  });
  return pixels;
}

/// In place: as a view has it, and 0 for what is no number.
void apply_view(std::vector<Vec3>& pixels, const std::function<void(std::span<float>)>& view) {
  static_assert(sizeof(Vec3) == 3 * sizeof(float));
  view({&pixels.data()->x, 3 * pixels.size()});
  const auto clipped = [](float v) { return v > 0.f ? std::min(v, 1.f) : 0.f; };
  for (Vec3& p : pixels) p = {clipped(p.x), clipped(p.y), clipped(p.z)};
}

Planes developed(const Film& film, const WriteOptions& options) {
  std::vector<Vec3> pixels = exposed(film, options.exposure);
  if (options.view) {
    apply_view(pixels, options.view);
  } else {
    for (Vec3& p : pixels) p = toned(p, options.white);
  }
  Planes planes = planes_of(film);
  const Vec3* next = pixels.data();
  for_pixels(film.window(), [&](int x, int y) {
    const Vec3 rgb = *next++;
    append(planes, {rounded(rgb.x), rounded(rgb.y), rounded(rgb.z)}, rounded(film.alpha(x, y)));
  });
  return planes;
}

Planes linear(const Film& film) {
  Planes planes = planes_of(film);
  for_pixels(film.window(),
             [&](int x, int y) { append(planes, film.mean(x, y), film.alpha(x, y)); });
  return planes;
}

/// Adds what lies beside the picture to its header and planes.
void append_passes(const PassFilm& passes, ImageHeader& header, Planes& planes) {
  header.channels.insert(header.channels.end(), passes.channels.begin(), passes.channels.end());
  planes.insert(planes.end(), passes.planes.begin(), passes.planes.end());
  for (const Mattes& mattes : passes.mattes) {
    const std::vector<std::string> channels = mattes.channels();
    header.channels.insert(header.channels.end(), channels.begin(), channels.end());
    planes.insert(planes.end(), mattes.planes.begin(), mattes.planes.end());
    for (const auto& text : mattes.attributes()) header.texts.push_back(text);
  }
}

/// Says what 16-bit floats cannot hold of each channel, which becomes the largest that they can.
/// What is infinite stays so.
void report_cut(const ImageHeader& header, const Planes& planes, const std::string& path,
                Diagnostics& diagnostics) {
  for (std::size_t k = 0; k < planes.size(); ++k) {
    std::size_t count = 0;
    float least = INFINITY, most = -INFINITY;
    for (const float value : planes[k]) {
      if (!std::isfinite(value)) continue;
      count += std::abs(value) > largest_half ? 1 : 0;
      least = std::min(least, value);
      most = std::max(most, value);
    }
    if (count == 0) continue;
    diagnostics.warning(
        "out-of-range", {path, 0, 0, header.channels[k]}, "what the image cannot hold was cut off",
        "-65504 to 65504, or no --half",
        fmt::format("{} to {}, {} of {} pixels outside", least, most, count, planes[k].size()));
  }
}

/// Empty when written; otherwise why not.
std::string write_file(const Film& film, const std::string& path, bool exr,
                       const WriteOptions& options, const std::string& name,
                       Diagnostics& diagnostics) {
  ImageHeader header{.kind = exr ? ImageKind::exr : ImageKind::png,
                     .width = film.window().width(),
                     .height = film.window().height(),
                     .channels = {"R", "G", "B"},
                     .samples = SampleType::unsigned8,
                     .colorspace = exr ? "Linear" : "sRGB"};
  if (exr) header.samples = options.half ? SampleType::half : SampleType::floating;
  header.repeats = false;
  if (exr) {
    header.display = {film.window().x0, film.window().y0, film.width(), film.height()};
  }
  if (film.has_alpha()) header.channels.emplace_back("A");
  Planes planes = exr ? linear(film) : developed(film, options);
  if (exr) append_passes(film.passes, header, planes);
  if (!exr && options.view) {
    header.colorspace.clear();
    header.texts.emplace_back("view", options.view_name);
  }
  if (!film.denoised_by.empty()) header.texts.emplace_back("denoised", film.denoised_by);
  std::string problem;
  const auto image = open_image(path, header, problem);
  if (image == nullptr) return problem;
  problem = write_planes(*image, header, planes);
  if (problem.empty() && exr && options.half) report_cut(header, planes, name, diagnostics);
  return problem;
}

}  // namespace

bool is_image_name(const std::string& path, Diagnostics& diagnostics) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".exr" || extension == ".png") return true;
  diagnostics.error("unknown-image-format", {path, 0, 0, {}}, "cannot write this kind of image",
                    "a name ending in .exr or .png", "\"" + extension + "\"");
  return false;
}

bool write_image(const Film& film, const std::string& path, const WriteOptions& options,
                 Diagnostics& diagnostics) {
  if (!is_image_name(path, diagnostics)) return false;
  const std::string extension = std::filesystem::path(path).extension().string();
  return write_atomically(
      path,
      [&](const std::string& file) {
        return write_file(film, file, extension == ".exr", options, path, diagnostics);
      },
      diagnostics);
}

}  // namespace nacre::host
