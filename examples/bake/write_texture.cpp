#include "examples/bake/write_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "examples/bake/texture_format.h"
#include "examples/common/atomic_file.h"
#include "examples/common/image_writer.h"
#include "examples/common/srgb.h"
#include "jit/graph/color/colorspace.h"

namespace nacre::host {

namespace {

constexpr float largest_half = 65504.0f;

bool is_vector(Type type) {
  return type == Type::vector2 || type == Type::vector3 || type == Type::vector4;
}

std::vector<std::string> channel_names(int count) {
  if (count == 1) return {"Y"};
  std::vector<std::string> names{"R", "G", "B", "A"};
  if (count <= 4) {
    names.resize(static_cast<std::size_t>(count));
    return names;
  }
  names.clear();
  for (int i = 0; i < count; ++i) names.emplace_back("m").append(std::to_string(i));
  return names;
}

/// Numbers that a file cannot hold, and the span of all that there were.
struct Cut {
  std::size_t count = 0;
  float least = std::numeric_limits<float>::infinity();
  float most = -std::numeric_limits<float>::infinity();
};

/// One output on its way into one file.
struct Job {
  const OutputKernel& kernel;
  std::size_t index;
  const BakeSettings& settings;
  const TextureEncoding& encoding;
  const Format& format;
  const BakeControl& control;
  TexelRange* range;
  Cut* cut;
  bool& too_many_steps;  ///< Set if the kernel took too many.

  const OutputKernel::Output& output() const { return kernel.outputs[index]; }
  int components() const { return component_count(output().type); }
  int channels() const { return encoding.channels > 0 ? encoding.channels : components(); }
  /// As OpenImageIO calls it.
  std::string file_colorspace() const {
    if (is_srgb()) return "sRGB";
    const std::string space =
        texture_colorspace(output().type, std::string(format.extension), encoding);
    const std::string_view known = canonical_colorspace(space);
    return known.empty() || known == "lin_rec709" ? "Linear" : space;
  }
  bool is_direction() const {
    return encoding.is_direction || (encoding.encodes_vectors && is_vector(output().type));
  }
  std::optional<SampleType> type() const { return type_of(format, encoding.bits); }
  bool is_srgb() const {
    return host::is_srgb(
        texture_colorspace(output().type, std::string(format.extension), encoding));
  }
};

ImageHeader header_of(const Job& job) {
  return {.kind = job.format.kind,
          .width = job.settings.width,
          .height = job.settings.height,
          .channels = channel_names(job.channels()),
          .samples = job.type().value(),
          .colorspace = job.file_colorspace(),
          .is_multiplied = false,  // A fourth channel is a number like the others.
          .repeats = !job.encoding.is_tile};
}

void widen(TexelRange& range, const std::vector<float>& texels, std::size_t channels) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  range.least.resize(channels, infinity);
  range.most.resize(channels, -infinity);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    float& least = range.least[i % channels];
    float& most = range.most[i % channels];
    if (texels[i] < least) least = texels[i];
    if (texels[i] > most) most = texels[i];
  }
}

/// Notes what lies outside the numbers that the file holds, or is none.
void note(Cut& cut, float value, float least, float most) {
  constexpr float rounding = 1e-5f;
  if (!(value >= least - rounding && value <= most + rounding)) ++cut.count;
  cut.least = std::min(cut.least, value);
  cut.most = std::max(cut.most, value);
}

BakedRows chosen_channels(const Job& job, const BakedRows& rows) {
  if (job.channels() == job.components()) return rows;
  BakedRows chosen{rows.first, rows.rows, {}};
  const auto first = static_cast<std::size_t>(job.encoding.first_channel);
  const auto stride = static_cast<std::size_t>(job.components());
  for (std::size_t i = first; i < rows.texels.size(); i += stride) {
    for (int c = 0; c < job.channels(); ++c) {
      chosen.texels.push_back(rows.texels[i + static_cast<std::size_t>(c)]);
    }
  }
  return chosen;
}

/// Bakes, and hands rows to `sink` as the numbers that the file is to hold.
BakeResult bake_encoded(const Job& job, const std::function<bool(const BakedRows&)>& sink) {
  const auto channels = static_cast<std::size_t>(job.channels());
  const bool srgb = job.is_srgb();
  const bool direction = job.is_direction();
  const bool is_half = job.type() == SampleType::half;
  BakedRows encoded;
  const auto encode = [&](const BakedRows& rows) {
    encoded = chosen_channels(job, rows);
    if (job.range != nullptr) widen(*job.range, encoded.texels, channels);
    for (std::size_t i = 0; i < encoded.texels.size(); ++i) {
      float& texel = encoded.texels[i];
      const bool is_coded = srgb && !(channels == 4 && i % 4 == 3);  // Alpha never is.
      if (job.format.is_integer || is_coded) {
        note(*job.cut, texel, direction ? -1.0f : 0.0f, 1.0f);
      } else if (is_half && std::isfinite(texel)) {
        note(*job.cut, texel, -largest_half, largest_half);
      }
      if (is_coded) texel = srgb_encode(texel);
      if (direction) texel = 0.5f * texel + 0.5f;
    }
    return sink(encoded);
  };
  const BakeResult result = bake(job.kernel, job.index, job.settings, encode, job.control);
  job.too_many_steps = result == BakeResult::too_many_steps;
  return result;
}

/// Why a bake that ended so has written nothing; `unwritten` where the file is the cause.
std::string reason(BakeResult result, const std::string& unwritten) {
  switch (result) {
    case BakeResult::done: return {};
    case BakeResult::stopped: return "stopped";
    case BakeResult::too_many_steps: return "there is no result";
    case BakeResult::refused: break;
  }
  return unwritten;
}

/// "", or why there is no such file.
std::string write_image(const Job& job, const std::string& file) {
  std::string problem;
  const auto image = open_image(file, header_of(job), problem);
  if (image == nullptr) return problem;
  const BakeResult result = bake_encoded(job, [&](const BakedRows& rows) {
    return image->write(rows.first, rows.rows, rows.texels.data());
  });
  return result == BakeResult::done ? image->finish() : reason(result, image->problem());
}

/// What there is to say of numbers that were cut off; nothing if there are none.
std::optional<Diagnostic> complaint_of(const Job& job, const std::string& path) {
  const Cut& cut = *job.cut;
  if (cut.count == 0) return std::nullopt;
  const bool is_refused = is_vector(job.output().type);
  const bool is_half = job.type() == SampleType::half;
  Diagnostic complaint;
  complaint.severity = is_refused ? Severity::error : Severity::warning;
  complaint.code = "out-of-range";
  complaint.where = {path, 0, 0, job.output().name};
  complaint.message =
      is_refused ? "the texture cannot hold these vectors; exr and tx can, and png with --vectors "
                   "encoded unit vectors"
                 : "what the texture cannot hold was cut off";
  complaint.expected = is_half ? "-65504 to 65504" : job.is_direction() ? "-1 to 1" : "0 to 1";
  const std::size_t all = static_cast<std::size_t>(job.settings.width) *
                          static_cast<std::size_t>(job.settings.height) *
                          static_cast<std::size_t>(job.channels());
  complaint.found =
      fmt::format("{} to {}, {} of {} numbers outside", cut.least, cut.most, cut.count, all);
  return complaint;
}

/// What makes a job impossible, or "".
std::string fault_of(const Job& job) {
  const TextureEncoding& encoding = job.encoding;
  if (!job.type()) {
    return fmt::format("a {} file does not hold {}-bit channels", job.format.extension.substr(1),
                       encoding.bits);
  }
  if (job.format.is_integer && job.channels() > 4) {
    return "a png holds at most four channels";
  }
  return {};
}

}  // namespace

std::unique_ptr<PartialFile> bake_to_partial_file(const OutputKernel& kernel, std::size_t output,
                                                  const BakeSettings& settings,
                                                  const TextureEncoding& encoding,
                                                  const std::string& path, Diagnostics& diagnostics,
                                                  const BakeControl& control, TexelRange* range) {
  const Format* format = format_of(std::filesystem::path(path).extension().string());
  Cut cut;
  std::optional<Diagnostic> complaint;
  bool too_many_steps = false;
  const auto write = [&](const std::string& file) -> std::string {
    if (format == nullptr) return "unknown extension; .exr, .png and .tx can be written";
    const Job job{kernel,  output, settings, encoding,      *format,
                  control, range,  &cut,     too_many_steps};
    const std::string fault = fault_of(job);
    if (!fault.empty()) return fault;
    const std::string problem = write_image(job, file);
    if (problem.empty() && (range == nullptr || job.type() == SampleType::half)) {
      complaint = complaint_of(job, path);
    }
    return problem;
  };
  auto file = std::make_unique<PartialFile>(path);
  std::string problem = file->problem();
  if (problem.empty()) problem = write(file->name());
  if (control.stop.stop_requested()) return nullptr;
  if (too_many_steps) {
    report_too_many_steps(kernel.outputs[output], diagnostics);
    return nullptr;
  }
  if (complaint) diagnostics.add(*complaint);
  if (complaint && complaint->severity == Severity::error) return nullptr;
  if (problem.empty()) return file;
  write_failed(path, problem, diagnostics);
  return nullptr;
}

bool commit(PartialFile& file, Diagnostics& diagnostics) {
  const std::string problem = file.commit();
  return problem.empty() || write_failed(file.path(), problem, diagnostics);
}

bool bake_to_file(const OutputKernel& kernel, std::size_t output, const BakeSettings& settings,
                  const TextureEncoding& encoding, const std::string& path,
                  Diagnostics& diagnostics, const BakeControl& control, TexelRange* range) {
  const auto file =
      bake_to_partial_file(kernel, output, settings, encoding, path, diagnostics, control, range);
  return file != nullptr && commit(*file, diagnostics);
}

}  // namespace nacre::host
