#include "examples/bake/write_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "examples/bake/adaptive_texels.h"
#include "examples/bake/bake_filled.h"
#include "examples/bake/cut.h"
#include "examples/bake/texture_format.h"
#include "examples/common/atomic_file.h"
#include "examples/common/image_writer.h"
#include "examples/common/srgb.h"
#include "jit/graph/color/colorspace.h"

namespace nacre::host {

namespace {

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

/// One output on its way into one file.
struct Job {
  const OutputKernel& kernel;
  std::size_t index;
  const BakeSettings& settings;
  const TextureEncoding& encoding;
  const Format& format;
  const BakeControl& control;
  TextureReport& report;
  Cut& cut;
  BakeResult& result;

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

/// Of the spaces that have primaries that files can say: Rec. ITU-R BT.709-6, and AP1 and AP0 with
/// the white of ACES (SMPTE ST 2065-1, Academy S-2014-004).
std::optional<std::array<float, 8>> chromaticities_of(std::string_view space) {
  using Points = std::array<float, 8>;
  if (space == "Linear" || space == "sRGB" || canonical_colorspace(space) == "lin_rec709") {
    return Points{0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f};
  }
  if (canonical_colorspace(space) == "acescg") {
    return Points{0.713f, 0.293f, 0.165f, 0.83f, 0.128f, 0.044f, 0.32168f, 0.33767f};
  }
  return std::nullopt;
}

/// What the file is said to be, and of what.
std::vector<std::pair<std::string, std::string>> texts_of(const Job& job) {
  std::vector<std::pair<std::string, std::string>> texts;
  const auto add = [&](const char* name, const std::string& text) {
    if (!text.empty()) texts.emplace_back(name, text);
  };
  add("Software", job.encoding.software);
  add("nacre:document", job.encoding.document);
  add("nacre:output", job.encoding.output);
  return texts;
}

ImageHeader header_of(const Job& job) {
  const bool is_color = job.output().type == Type::color3 || job.output().type == Type::color4;
  return {.kind = job.format.kind,
          .width = job.settings.width,
          .height = job.settings.height,
          .channels = channel_names(job.channels()),
          .samples = job.type().value(),
          .colorspace = job.file_colorspace(),
          .codes_srgb = job.format.is_integer && job.is_srgb(),
          .repeats = !job.encoding.is_tile,
          .chromaticities = is_color ? chromaticities_of(job.file_colorspace()) : std::nullopt,
          .texts = texts_of(job)};
}

/// Turns numbers as computed into those that the file is to hold, but for what its writer does.
Cut encode(const Job& job, std::span<std::vector<float>> planes,
           const TexelStatistics& statistics) {
  const bool direction = job.is_direction();
  const Span unit{direction ? -1.0f : 0.0f, 1.0f};
  Cut cut;
  for (std::size_t c = 0; c < planes.size(); ++c) {
    std::vector<float>& plane = planes[c];
    const ChannelStatistics& known = statistics.channels[c];
    const bool is_coded = job.is_srgb() && c != 3;  // Alpha never is.
    if (job.format.is_integer || is_coded) {
      cut.add(cut_of(plane, known, unit, false));
    } else if (job.type() == SampleType::half) {
      cut.add(cut_of(plane, known, {-largest_half, largest_half}, true));
    }
    if (is_coded && !job.format.is_integer) {
      for (float& texel : plane) texel = srgb_encode(texel);
    }
    if (direction) {
      for (float& texel : plane) texel = 0.5f * texel + 0.5f;
    }
  }
  return cut;
}

/// What the surface itself has of planes.
std::vector<std::vector<float>> covered_texels(std::span<const std::vector<float>> planes,
                                               const std::vector<std::uint8_t>& covered) {
  std::vector<std::vector<float>> own(planes.size());
  for (std::size_t c = 0; c < planes.size(); ++c) {
    for (std::size_t i = 0; i < covered.size(); ++i) {
      if (covered[i] != 0) own[c].push_back(planes[c][i]);
    }
  }
  return own;
}

/// Bakes into an image that is open.
BakeResult bake_into(const Job& job, ImageWriter& image) {
  const StatisticsRequest request{job.report.histogram, job.is_direction() ? -1.0f : 0.0f, 1.0f};
  const auto sink = [&](BakedRows& rows) -> std::function<bool()> {
    const auto planes = std::span(rows.planes)
                            .subspan(static_cast<std::size_t>(job.encoding.first_channel),
                                     static_cast<std::size_t>(job.channels()));
    const TexelStatistics statistics =
        rows.covered.empty() ? statistics_of(planes, request)
                             : statistics_of(covered_texels(planes, rows.covered), request);
    const Cut cut = encode(job, planes, statistics);
    return [&, statistics, cut, encoded = image.encode({rows.first, rows.rows, planes})] {
      job.report.statistics.add(statistics);
      job.cut.add(cut);
      return image.append(encoded);
    };
  };
  BakeCounts counts;
  const auto run = job.settings.surface == nullptr ? bake : bake_filled;
  const BakeResult result =
      run(job.kernel, job.index, job.settings, image.block_rows(), sink, job.control, &counts);
  job.report.statistics.samples += counts.samples;
  job.report.statistics.unfinished += counts.unfinished;
  job.report.statistics.shading_seconds += counts.shading_seconds;
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
  job.result = bake_into(job, *image);
  return job.result == BakeResult::done ? image->finish() : reason(job.result, image->problem());
}

/// What there is to say of numbers that were cut off; nothing if there are none.
std::optional<Diagnostic> complaint_of(const Job& job, const std::string& path) {
  const Cut& cut = job.cut;
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

/// Says how many texels have the most samples that there are, and were to have more.
void report_unfinished(std::uint64_t texels, const BakeSettings& settings, const std::string& path,
                       Diagnostics& diagnostics) {
  if (texels == 0) return;
  diagnostics.warning(
      "most-samples", {path, 0, 0, {}},
      fmt::format(
          "{} of {} texels have {} samples and may still be less exact", texels,
          static_cast<std::uint64_t>(settings.width) * static_cast<std::uint64_t>(settings.height),
          AdaptiveTexels::most_samples),
      fmt::format("an error of at most {}", settings.sampling.error));
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
  const double bytes = 4.0 * job.components() * job.settings.width * job.settings.height;
  if (job.settings.surface != nullptr && bytes > largest_filled) {
    return fmt::format("a map of a mesh is kept in memory: {:.3g} GB, of at most {:.3g}",
                       bytes * 1e-9, largest_filled * 1e-9);
  }
  return {};
}

}  // namespace

std::unique_ptr<PartialFile> bake_to_partial_file(const OutputKernel& kernel, std::size_t output,
                                                  const BakeSettings& settings,
                                                  const TextureEncoding& encoding,
                                                  const std::string& path, Diagnostics& diagnostics,
                                                  const BakeControl& control,
                                                  TextureReport* report) {
  const Format* format = format_of(std::filesystem::path(path).extension().string());
  Cut cut;
  std::optional<Diagnostic> complaint;
  TextureReport own;
  TextureReport& said = report == nullptr ? own : *report;
  const std::uint64_t unfinished = said.statistics.unfinished;
  BakeResult result = BakeResult::refused;
  const auto write = [&](const std::string& file) -> std::string {
    if (format == nullptr) return "unknown extension; .exr, .png and .tx can be written";
    const Job job{kernel, output, settings, encoding, *format, control, said, cut, result};
    const std::string fault = fault_of(job);
    if (!fault.empty()) return fault;
    const std::string problem = write_image(job, file);
    if (problem.empty() && (!said.is_judged || job.type() == SampleType::half)) {
      complaint = complaint_of(job, path);
    }
    return problem;
  };
  auto file = std::make_unique<PartialFile>(path);
  std::string problem = file->problem();
  if (problem.empty()) problem = write(file->name());
  if (control.stop.stop_requested()) return nullptr;
  if (result == BakeResult::too_many_steps) {
    report_too_many_steps(kernel.outputs[output], diagnostics);
    return nullptr;
  }
  if (complaint) diagnostics.add(*complaint);
  if (complaint && complaint->severity == Severity::error) return nullptr;
  if (problem.empty()) {
    report_unfinished(said.statistics.unfinished - unfinished, settings, path, diagnostics);
    return file;
  }
  write_failed(path, problem, diagnostics);
  return nullptr;
}

bool commit(PartialFile& file, Diagnostics& diagnostics) {
  const std::string problem = file.commit();
  return problem.empty() || write_failed(file.path(), problem, diagnostics);
}

bool bake_to_file(const OutputKernel& kernel, std::size_t output, const BakeSettings& settings,
                  const TextureEncoding& encoding, const std::string& path,
                  Diagnostics& diagnostics, const BakeControl& control, TextureReport* report) {
  const auto file =
      bake_to_partial_file(kernel, output, settings, encoding, path, diagnostics, control, report);
  return file != nullptr && commit(*file, diagnostics);
}

}  // namespace nacre::host
