#include "examples/tool/bake/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "examples/bake/texture_encoding.h"
#include "examples/bake/texture_format.h"
#include "examples/tool/report.h"

namespace nacre::tool {

namespace {

using Json = nlohmann::ordered_json;

/// Bits of a channel in the file.
int bits_of(const TextureSettings& texture) {
  if (texture.encoding.bits != 0) return texture.encoding.bits;
  const host::Format* format = host::format_of(texture.extension);
  return format == nullptr ? 0 : format->default_bits;
}

std::string channel_name(const BakedMap& map, std::size_t channel) {
  const std::size_t count = map.statistics.channels.size();
  if (count == 1) return "Y";
  return count <= 4 ? std::string(1, "RGBA"[channel]) : "m" + std::to_string(channel);
}

double samples_of_a_texel(const host::TexelStatistics& statistics) {
  return statistics.texels == 0
             ? 0.0
             : static_cast<double>(statistics.samples) / static_cast<double>(statistics.texels);
}

const char* name_of(BakedMap::State state) {
  switch (state) {
    case BakedMap::State::written: return "written";
    case BakedMap::State::skipped: return "skipped";
    case BakedMap::State::merged: break;
  }
  return "merged";
}

/// Whether there are counts: of what another run has baked there may be none.
bool has_histogram(const BakedMap& map, const host::ChannelStatistics& channel) {
  return map.state == BakedMap::State::written ||
         std::ranges::any_of(channel.histogram, [](std::uint64_t count) { return count != 0; });
}

Json json_of(const host::ChannelStatistics& channel, const std::string& name, bool is_direction,
             bool has_counts) {
  Json one;
  one["name"] = name;
  one["min"] = channel.least;
  one["mean"] = channel.mean();
  one["max"] = channel.most;
  one["infinite"] = channel.unbounded;
  one["nan"] = channel.no_number;
  if (!has_counts) return one;
  Json& histogram = one["histogram"];
  histogram["from"] = is_direction ? -1.0 : 0.0;
  histogram["to"] = 1.0;
  histogram["below"] = channel.histogram.front();
  histogram["counts"] =
      std::vector<std::uint64_t>(channel.histogram.begin() + 1, channel.histogram.end() - 1);
  histogram["above"] = channel.histogram.back();
  return one;
}

bool is_direction(const BakedMap& map) {
  const bool is_vector =
      map.type == Type::vector2 || map.type == Type::vector3 || map.type == Type::vector4;
  return map.texture.encoding.is_direction || (map.texture.encoding.encodes_vectors && is_vector);
}

Json json_of(const BakedMap& map) {
  Json one;
  one["file"] = map.file;
  one["state"] = name_of(map.state);
  one["output"] = map.output;
  one["type"] = type_name(map.type);
  one["width"] = map.texture.width;
  one["height"] = map.texture.height;
  one["format"] = map.texture.extension.substr(1);
  one["bits"] = bits_of(map.texture);
  one["colorspace"] =
      host::texture_colorspace(map.type, map.texture.extension, map.texture.encoding);
  std::error_code ignored;
  const auto bytes = std::filesystem::file_size(map.file, ignored);
  one["bytes"] = ignored ? 0 : bytes;
  one["uniform"] = map.statistics.is_uniform();
  one["covered_texels"] = map.statistics.texels;
  one["samples"] = map.statistics.samples;
  one["samples_per_texel"] = samples_of_a_texel(map.statistics);
  one["texels_with_most_samples"] = map.statistics.unfinished;
  one["seconds"] = map.seconds;
  one["shading_cpu_seconds"] = map.statistics.shading_seconds;
  one["channels"] = Json::array();
  for (std::size_t c = 0; c < map.statistics.channels.size(); ++c) {
    const host::ChannelStatistics& channel = map.statistics.channels[c];
    one["channels"].push_back(
        json_of(channel, channel_name(map, c), is_direction(map), has_histogram(map, channel)));
  }
  return one;
}

std::string numbers(const std::vector<float>& value) {
  std::string text;
  for (const float number : value) text += fmt::format("{}{:g}", text.empty() ? "" : ", ", number);
  return text;
}

/// How much of a map there is something in.
std::string coverage(const BakedMap& map) {
  if (!map.has_islands) return {};
  const double all = static_cast<double>(map.texture.width) * map.texture.height;
  return fmt::format(", {:.3g} % of it islands",
                     100.0 * static_cast<double>(map.statistics.texels) / all);
}

}  // namespace

BakedMap kept_map(const std::string& file, const BakedRecord& record,
                  const TextureSettings& texture, bool has_islands, bool is_merged) {
  return {file,
          record.output,
          parse_type(record.type).value_or(Type::none),
          texture,
          record.statistics,
          record.seconds,
          has_islands,
          is_merged ? BakedMap::State::merged : BakedMap::State::skipped};
}

BakedRecord record_of(const BakedMap& map) {
  BakedRecord record;
  record.type = type_name(map.type);
  record.statistics = map.statistics;
  record.seconds = map.seconds;
  return record;
}

void BakeReport::print() const {
  if (form_ == Form::text) print_text();
  if (form_ == Form::json) print_json();
}

void BakeReport::print_text() const {
  for (const BakedMap& map : maps_) {
    const bool is_ours = map.state == BakedMap::State::written;
    fmt::print("{}: {} {}x{}{}, {:g} samples a texel, {:.3g} s{}{}{}\n", map.file, map.output,
               map.texture.width, map.texture.height, coverage(map),
               samples_of_a_texel(map.statistics), map.seconds, is_ours ? "" : ", ",
               is_ours ? "" : name_of(map.state),
               map.statistics.is_uniform() ? "; uniform: a value would do" : "");
    for (std::size_t c = 0; c < map.statistics.channels.size(); ++c) {
      const host::ChannelStatistics& channel = map.statistics.channels[c];
      if (channel.finite + channel.unbounded == 0) {
        fmt::print("  {}: no number\n", channel_name(map, c));
        continue;
      }
      const std::uint64_t others = channel.unbounded + channel.no_number;
      fmt::print("  {}: {:g} to {:g}, mean {:g}{}\n", channel_name(map, c), channel.least,
                 channel.most, channel.mean(),
                 others == 0 ? "" : fmt::format(", {} not finite", others));
    }
  }
  for (const BakedValue& value : values_) {
    fmt::print("{}: uniform, a value: {}\n", value.input, numbers(value.value));
  }
}

void BakeReport::print_json() const {
  Json all;
  if (!document_.empty()) all["document"] = document_;
  all["files"] = Json::array();
  for (const BakedMap& map : maps_) all["files"].push_back(json_of(map));
  all["values"] = Json::array();
  for (const BakedValue& value : values_) {
    Json one;
    one["input"] = value.input;
    one["value"] = value.value;
    one["colorspace"] = value.colorspace;
    all["values"].push_back(one);
  }
  for (const auto state :
       {BakedMap::State::written, BakedMap::State::skipped, BakedMap::State::merged}) {
    all[name_of(state)] =
        std::ranges::count_if(maps_, [&](const BakedMap& map) { return map.state == state; });
  }
  all["seconds"] = watch_.seconds();
  tool::print_json(all);
}

}  // namespace nacre::tool
