// Shades a surface: scatters one ray at each of many points of a material.
//
//   surface LIBRARY DOCUMENT.mtlx MATERIAL
#include <bit>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "jit/document/read.h"
#include "jit/shading/shading_system.h"

namespace {

constexpr std::size_t points = 4096;

/// Arrays by channel: one four-byte number a point. What a kernel stores the next may read.
using Channels = std::map<std::string, std::vector<std::uint32_t>>;

void set(Channels& channels, const std::string& name, float value) {
  channels[name].assign(points, std::bit_cast<std::uint32_t>(value));
}

float get(const Channels& channels, const std::string& name, std::size_t i) {
  return std::bit_cast<float>(channels.at(name)[i]);
}

/// Runs a kernel where there is one. A channel that nobody has set is 0.
void run(const std::optional<nacre::BoundKernel>& kernel, Channels& channels) {
  if (!kernel) return;
  const auto array_of = [&](const nacre::Channel& channel) {
    std::vector<std::uint32_t>& array = channels[channel.name];
    array.resize(points);
    return array.data();
  };
  std::vector<const void*> in;
  std::vector<void*> out;
  for (const nacre::Channel& channel : kernel->program().inputs) in.push_back(array_of(channel));
  for (const nacre::Channel& channel : kernel->program().outputs) out.push_back(array_of(channel));
  if (kernel->run(in, out, points) != nacre::RunStatus::done) {
    std::fprintf(stderr, "a loop of the shader does not end\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return std::fprintf(stderr, "usage: surface LIBRARY DOCUMENT MATERIAL\n"), 2;
  nacre::Diagnostics diagnostics;
  const auto fail = [&] {
    std::fputs(diagnostics.to_string().c_str(), stderr);
    return 1;
  };
  // What goes wrong in LLVM then costs a kernel its speed, not this program its life.
  const auto system =
      nacre::ShadingSystem::create({.libraries = {argv[1]}, .compile_apart = true}, diagnostics);
  if (system == nullptr) return fail();
  const auto document = nacre::read_document(argv[2], {}, diagnostics);
  if (document == nullptr) return fail();
  const auto material = system->compile_material(*document, argv[3], {}, diagnostics);
  if (material == nullptr) return fail();
  std::fputs(diagnostics.to_string().c_str(), stderr);  // Warnings, if there are any.

  // 1. Where the points are, and from where they are seen: on a plane, from 45 degrees.
  Channels channels;
  for (const char* normal : {"N.z", "No.z", "Ng.z", "T.x", "To.x", "B.y", "Bo.y"}) {
    set(channels, normal, 1.0f);
  }
  for (const char* viewer : {"wo.x", "wo.z"}) set(channels, viewer, 0.70710678f);
  for (const char* place : {"uv0.x", "P.x", "Po.x"}) {
    set(channels, place, 0.0f);
    for (std::size_t i = 0; i < points; ++i) {
      channels[place][i] = std::bit_cast<std::uint32_t>(float(i) / points);
    }
  }

  // 2. What of the material depends on the point alone, once a point.
  run(material->begin, channels);

  // 3. A direction for each point, chosen by three numbers in [0, 1).
  set(channels, "u.z", 0.5f);
  for (std::size_t i = 0; i < points; ++i) {
    channels["u.x"].resize(points);
    channels["u.y"].resize(points);
    channels["u.x"][i] = std::bit_cast<std::uint32_t>(float(i % 64) / 64 + 1.0f / 128);
    channels["u.y"][i] = std::bit_cast<std::uint32_t>(float(i / 64) / 64 + 1.0f / 128);
  }
  run(material->sample, channels);

  // 4. The same direction evaluated: what a light there would be weighted with.
  run(material->evaluate, channels);
  run(material->albedo, channels);

  double weight = 0, albedo = 0;
  for (std::size_t i = 0; i < points; ++i) {
    if (material->sample) weight += get(channels, "weight.y", i) / points;
    if (material->albedo) albedo += get(channels, "albedo.y", i) / points;
  }
  std::printf("%s: %zu lobes, mean weight %.3f, mean albedo %.3f (green)\n", argv[3],
              material->lobes.size(), weight, albedo);
  return 0;
}
