#include "examples/bake/write_texture.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <memory>

#include "examples/common/atomic_file.h"
#include "examples/common/srgb.h"

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
  for (int i = 0; i < count; ++i) names.push_back("m" + std::to_string(i));
  return names;
}

OIIO::ImageSpec spec_of(const OutputKernel::Output& output, const BakeSettings& settings,
                        OIIO::TypeDesc type) {
  const int channels = component_count(output.type);
  OIIO::ImageSpec spec(settings.width, settings.height, channels, type);
  spec.channelnames = channel_names(channels);
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace",
                 type == OIIO::TypeDesc::UINT8 && is_color(output.type) ? "sRGB" : "Linear");
  return spec;
}

/// Rows to an open file, in the file's own format.
std::string write_rows(const OutputKernel& kernel, std::size_t output,
                       const BakeSettings& settings, const std::string& file, const char* format,
                       OIIO::TypeDesc type, const BakeControl& control) {
  const auto out = OIIO::ImageOutput::create(format);
  if (out == nullptr) return OIIO::geterror();
  const OIIO::ImageSpec spec = spec_of(kernel.outputs[output], settings, type);
  if (!out->open(file, spec)) return out->geterror();
  const bool encode = type == OIIO::TypeDesc::UINT8 && is_color(kernel.outputs[output].type);
  std::vector<float> encoded;
  const bool finished = bake(
      kernel, output, settings,
      [&](const BakedRows& rows) {
        encoded = rows.texels;
        if (encode) {
          for (std::size_t i = 0; i < encoded.size(); ++i) {
            const bool alpha = spec.nchannels == 4 && i % 4 == 3;
            if (!alpha) encoded[i] = srgb_encode(encoded[i]);
          }
        }
        return out->write_scanlines(rows.first, rows.first + rows.rows, 0, OIIO::TypeDesc::FLOAT,
                                    encoded.data());
      },
      control);
  if (!finished) return control.stop.stop_requested() ? "stopped" : out->geterror();
  return out->close() ? std::string() : out->geterror();
}

std::string write_tx(const OutputKernel& kernel, std::size_t output, const BakeSettings& settings,
                     const std::string& file, const BakeControl& control) {
  OIIO::ImageBuf image(spec_of(kernel.outputs[output], settings, OIIO::TypeDesc::FLOAT));
  const bool finished = bake(
      kernel, output, settings,
      [&](const BakedRows& rows) {
        const OIIO::ROI roi(0, settings.width, rows.first, rows.first + rows.rows, 0, 1, 0,
                            image.nchannels());
        return image.set_pixels(roi, OIIO::TypeDesc::FLOAT, rows.texels.data());
      },
      control);
  if (!finished) return control.stop.stop_requested() ? "stopped" : image.geterror();
  OIIO::ImageSpec config;
  config.attribute("maketx:highlightcomp", 0);
  if (OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, image, file, config)) {
    return {};
  }
  const std::string why = OIIO::geterror();
  return why.empty() ? "the texture could not be made" : why;
}

}  // namespace

bool bake_to_file(const OutputKernel& kernel, std::size_t output, const BakeSettings& settings,
                  const std::string& path, Diagnostics& diagnostics, const BakeControl& control) {
  const std::string extension = std::filesystem::path(path).extension().string();
  return write_atomically(
      path,
      [&](const std::string& file) -> std::string {
        if (extension == ".exr") {
          return write_rows(kernel, output, settings, file, "openexr", OIIO::TypeDesc::FLOAT,
                            control);
        }
        if (extension == ".png") {
          if (component_count(kernel.outputs[output].type) > 4) {
            return "a png holds at most four channels";
          }
          return write_rows(kernel, output, settings, file, "png", OIIO::TypeDesc::UINT8, control);
        }
        if (extension == ".tx") return write_tx(kernel, output, settings, file, control);
        return "unknown extension; .exr, .png and .tx can be written";
      },
      diagnostics);
}

}  // namespace nacre::host
