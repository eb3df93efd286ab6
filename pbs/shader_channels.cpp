#include "pbs/shader_channels.h"

#include <algorithm>

#include "pbs/displacement.h"
#include "pbs/light.h"
#include "pbs/volume.h"
#include "runtime/node/geometry.h"

namespace nacre {

namespace {

using Channels = std::vector<SliceOutput>;

void add(Channels& channels, const std::string& name, Float3 v) {
  channels.push_back({name + ".x", v.x.ref()});
  channels.push_back({name + ".y", v.y.ref()});
  channels.push_back({name + ".z", v.z.ref()});
}

void add(Channels& channels, const VdfPtr& vdf) {
  const Vdf& medium = vdf == nullptr ? Vdf() : *vdf;
  add(channels, "absorption", finite_coefficients(medium.absorption));
  add(channels, "scattering", finite_coefficients(medium.scattering));
  channels.push_back({"anisotropy", medium.anisotropy.ref()});
}

}  // namespace

std::vector<SliceOutput> shader_channels(Recorder& recorder, Accuracy accuracy,
                                         const Recorded& value) {
  Channels channels;
  switch (value.type) {
    case Type::vdf: add(channels, as_vdf(value.closure)); break;
    case Type::volumeshader: {
      const VolumePtr volume = as_volume(value.closure);
      add(channels, volume == nullptr ? nullptr : volume->vdf);
      Color3 emission(0.0f);
      if (volume != nullptr && volume->edf != nullptr) {
        const View view{
            .recorder = &recorder, .accuracy = accuracy, .wo = view_direction(recorder)};
        emission = radiance(volume->edf, view);
      }
      add(channels, "emission", emission);
      break;
    }
    case Type::displacementshader: {
      const DisplacementPtr displacement = as_displacement(value.closure);
      add(channels, "offset", displacement == nullptr ? Float3(0.0f) : displacement->offset);
      break;
    }
    case Type::lightshader: {
      const LightPtr light = as_light(value.closure);
      add(channels, "intensity", light == nullptr ? Color3(0.0f) : finite_light(light->intensity));
      if (light != nullptr && light->direction) {
        add(channels, "direction", *light->direction);
      }
      if (light != nullptr && light->distance) {
        channels.push_back({"distance", light->distance->ref()});
      }
      break;
    }
    default: break;
  }
  return channels;
}

bool all_zero(const std::vector<SliceOutput>& channels) {
  return std::all_of(channels.begin(), channels.end(), [](const SliceOutput& channel) {
    const bool counts = channel.name != "anisotropy" && channel.name != "distance" &&
                        !channel.name.starts_with("direction");
    return !counts || Float(channel.value).is_constant(0.0f);
  });
}

}  // namespace nacre
