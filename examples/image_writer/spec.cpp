#include "examples/image_writer/spec.h"

namespace nacre::host {

namespace {

OIIO::TypeDesc type_of(SampleType samples) {
  switch (samples) {
    case SampleType::unsigned8: return OIIO::TypeDesc::UINT8;
    case SampleType::unsigned16: return OIIO::TypeDesc::UINT16;
    case SampleType::half: return OIIO::TypeDesc::HALF;
    case SampleType::floating: break;
  }
  return OIIO::TypeDesc::FLOAT;
}

}  // namespace

OIIO::ImageSpec spec_of(const ImageHeader& header) {
  OIIO::ImageSpec spec(header.width, header.height, static_cast<int>(header.channels.size()),
                       type_of(header.samples));
  spec.channelnames = header.channels;
  spec.attribute("compression", "zip");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("oiio:ColorSpace", header.colorspace);
  spec.attribute("DateTime", "");  // Else the writers note the time.
  for (const auto& [name, text] : header.texts) spec.attribute(name, text);
  spec.attribute("tiff:half", 1);  // Else 16-bit floats become 32-bit ones.
  return spec;
}

}  // namespace nacre::host
