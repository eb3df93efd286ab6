#pragma once

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace nacre {

/// An image as OpenImageIO reads it: its channels, and the texts of the header.
struct Layers {
  std::map<std::string, std::vector<float>> planes;
  std::map<std::string, std::string> texts;
  OIIO::ROI window, whole;  ///< What there are pixels of, and in what: of an EXR, data and display.

  const std::vector<float>& operator[](const std::string& name) const { return planes.at(name); }
};

inline Layers layers_of(const std::string& file) {
  const auto in = OIIO::ImageInput::open(file);
  EXPECT_NE(in, nullptr);
  if (in == nullptr) return {};
  Layers layers;
  const OIIO::ImageSpec& spec = in->spec();
  layers.window = spec.roi();
  layers.whole = spec.roi_full();
  const auto pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  std::vector<float> all(pixels * channels);
  in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, all.data());
  for (std::size_t c = 0; c < channels; ++c) {
    std::vector<float>& plane = layers.planes[spec.channelnames[c]];
    for (std::size_t i = 0; i < pixels; ++i) plane.push_back(all[i * channels + c]);
  }
  for (const OIIO::ParamValue& each : spec.extra_attribs) {
    if (each.type() == OIIO::TypeDesc::STRING) {
      layers.texts[each.name().string()] = each.get_string();
    }
  }
  return layers;
}

}  // namespace nacre
