#include "examples/bake/write_texture.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <limits>
#include <memory>

#include "examples/common/atomic_file.h"
#include "examples/common/srgb.h"
#include "jit/graph/colorspace.h"

namespace nacre::host {

namespace {

bool is_color(Type type) { return type == Type::color3 || type == Type::color4; }

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

/// What one extension can hold.
struct Format {
  std::string_view extension;
  const char* plugin;
  int default_bits;
  OIIO::TypeDesc of_8, of_16, of_32;  ///< UNKNOWN where it cannot.
  bool is_integer;
};

const OIIO::TypeDesc unknown = OIIO::TypeDesc::UNKNOWN;
const OIIO::TypeDesc half_float = OIIO::TypeDesc::HALF;
const OIIO::TypeDesc full_float = OIIO::TypeDesc::FLOAT;

const std::array formats = std::to_array<Format>({
    {".exr", "openexr", 32, unknown, half_float, full_float, false},
    {".png", "png", 8, OIIO::TypeDesc::UINT8, OIIO::TypeDesc::UINT16, unknown, true},
    {".tx", "tiff", 32, unknown, half_float, full_float, false},
});

const Format* format_of(std::string_view extension) {
  for (const Format& format : formats) {
    if (format.extension == extension) return &format;
  }
  return nullptr;
}

OIIO::TypeDesc type_of(const Format& format, int bits) {
  switch (bits == 0 ? format.default_bits : bits) {
    case 8: return format.of_8;
    case 16: return format.of_16;
    case 32: return format.of_32;
    default: return unknown;
  }
}

/// One output on its way into one file.
struct Job {
  const OutputKernel& kernel;
  std::size_t index;
  const BakeSettings& settings;
  const TextureEncoding& encoding;
  const Format& format;
  const BakeControl& control;
  TexelRange* range;

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
  bool is_srgb() const {
    return host::is_srgb(
        texture_colorspace(output().type, std::string(format.extension), encoding));
  }
};

OIIO::ImageSpec spec_of(const Job& job) {
  const int channels = job.channels();
  OIIO::ImageSpec spec(job.settings.width, job.settings.height, channels,
                       type_of(job.format, job.encoding.bits));
  spec.channelnames = channel_names(channels);
  spec.attribute("compression", "zip");
  // A fourth channel is a number like the others: nothing is multiplied by it.
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("oiio:ColorSpace", job.file_colorspace());
  return spec;
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
bool bake_encoded(const Job& job, const std::function<bool(const BakedRows&)>& sink) {
  const auto channels = static_cast<std::size_t>(job.channels());
  const bool srgb = job.is_srgb();
  BakedRows encoded;
  const auto encode = [&](const BakedRows& rows) {
    encoded = chosen_channels(job, rows);
    if (job.range != nullptr) widen(*job.range, encoded.texels, channels);
    for (std::size_t i = 0; i < encoded.texels.size(); ++i) {
      float& texel = encoded.texels[i];
      const bool alpha = channels == 4 && i % 4 == 3;
      if (srgb && !alpha) texel = srgb_encode(texel);
      if (job.encoding.is_direction) texel = 0.5f * texel + 0.5f;
    }
    return sink(encoded);
  };
  return bake(job.kernel, job.index, job.settings, encode, job.control);
}

/// Rows to an open file, in the file's own format.
std::string write_rows(const Job& job, const std::string& file) {
  const auto out = OIIO::ImageOutput::create(job.format.plugin);
  if (out == nullptr) return OIIO::geterror();
  if (!out->open(file, spec_of(job))) return out->geterror();
  const bool finished = bake_encoded(job, [&](const BakedRows& rows) {
    return out->write_scanlines(rows.first, rows.first + rows.rows, 0, OIIO::TypeDesc::FLOAT,
                                rows.texels.data());
  });
  if (!finished) return job.control.stop.stop_requested() ? "stopped" : out->geterror();
  return out->close() ? std::string() : out->geterror();
}

std::string write_tx(const Job& job, const std::string& file) {
  OIIO::ImageBuf image(spec_of(job));
  const bool finished = bake_encoded(job, [&](const BakedRows& rows) {
    const OIIO::ROI roi(0, job.settings.width, rows.first, rows.first + rows.rows, 0, 1, 0,
                        image.nchannels());
    return image.set_pixels(roi, OIIO::TypeDesc::FLOAT, rows.texels.data());
  });
  if (!finished) return job.control.stop.stop_requested() ? "stopped" : image.geterror();
  OIIO::ImageSpec config;
  config.attribute("maketx:highlightcomp", 0);
  if (OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, image, file, config)) {
    return {};
  }
  const std::string why = OIIO::geterror();
  return why.empty() ? "the texture could not be made" : why;
}

/// What makes a job impossible, or "".
std::string fault_of(const Job& job) {
  const TextureEncoding& encoding = job.encoding;
  if (type_of(job.format, encoding.bits) == unknown) {
    return fmt::format("a {} file does not hold {}-bit channels", job.format.extension.substr(1),
                       encoding.bits);
  }
  if (job.format.is_integer && job.channels() > 4) {
    return "a png holds at most four channels";
  }
  return {};
}

}  // namespace

std::string texture_colorspace(Type type, const std::string& extension,
                               const TextureEncoding& encoding) {
  if (!is_color(type)) return {};
  if (!encoding.colorspace.empty()) return encoding.colorspace;
  return holds_unit_range_only(extension) ? "srgb_texture" : "lin_rec709";
}

std::string output_space(const std::string& extension, const TextureEncoding& encoding) {
  const std::string space = texture_colorspace(Type::color3, extension, encoding);
  if (is_srgb(space)) return "lin_rec709";
  return encoding.colorspace.empty() ? std::string() : space;
}

bool is_srgb(std::string_view colorspace) {
  return canonical_colorspace(colorspace) == "srgb_texture";
}

bool holds_unit_range_only(const std::string& extension) {
  const Format* format = format_of(extension);
  return format != nullptr && format->is_integer;
}

bool bake_to_file(const OutputKernel& kernel, std::size_t output, const BakeSettings& settings,
                  const TextureEncoding& encoding, const std::string& path,
                  Diagnostics& diagnostics, const BakeControl& control, TexelRange* range) {
  const Format* format = format_of(std::filesystem::path(path).extension().string());
  return write_atomically(
      path,
      [&](const std::string& file) -> std::string {
        if (format == nullptr) return "unknown extension; .exr, .png and .tx can be written";
        const Job job{kernel, output, settings, encoding, *format, control, range};
        const std::string fault = fault_of(job);
        if (!fault.empty()) return fault;
        return format->extension == ".tx" ? write_tx(job, file) : write_rows(job, file);
      },
      diagnostics);
}

}  // namespace nacre::host
