#include "examples/tool/bake/manifest.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "examples/common/atomic_file.h"
#include "runtime/read_file.h"

namespace nacre::tool {

namespace {

using Json = nlohmann::ordered_json;

/// A record has some 2 KB.
constexpr std::uint64_t most_bytes = std::uint64_t{1} << 30;

/// JSON has no infinite numbers.
Json json_of(double number) {
  if (std::isfinite(number)) return number;
  return std::isnan(number) ? "nan" : number > 0.0 ? "inf" : "-inf";
}

double number_of(const Json& json) {
  if (json.is_number()) return json.get<double>();
  const auto text = json.get<std::string>();
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  return text == "-inf" ? -std::numeric_limits<double>::infinity()
                        : std::numeric_limits<double>::infinity();
}

Json json_of(const host::ChannelStatistics& channel) {
  Json json;
  json["min"] = json_of(static_cast<double>(channel.least));
  json["max"] = json_of(static_cast<double>(channel.most));
  json["sum"] = channel.sum;
  json["finite"] = channel.finite;
  json["infinite"] = channel.unbounded;
  json["nan"] = channel.no_number;
  for (const std::uint64_t count : channel.histogram) {
    if (count == 0) continue;
    json["histogram"] = channel.histogram;
    break;
  }
  return json;
}

host::ChannelStatistics channel_of(const Json& json) {
  host::ChannelStatistics channel;
  channel.least = static_cast<float>(number_of(json.at("min")));
  channel.most = static_cast<float>(number_of(json.at("max")));
  channel.sum = number_of(json.at("sum"));
  json.at("finite").get_to(channel.finite);
  json.at("infinite").get_to(channel.unbounded);
  json.at("nan").get_to(channel.no_number);
  if (json.contains("histogram")) json["histogram"].get_to(channel.histogram);
  return channel;
}

Json json_of(const BakedRecord& record) {
  Json json;
  if (!record.file.empty()) json["file"] = record.file;
  json["output"] = record.output;
  json["type"] = record.type;
  json["settings"] = record.settings;
  json["images"] = record.images;
  if (record.file.empty()) {
    json["value"] = Json::array();
    for (const float number : record.value) {
      json["value"].push_back(json_of(static_cast<double>(number)));
    }
    return json;
  }
  json["sha256"] = record.digest;
  json["bytes"] = record.bytes;
  json["kept"] = record.is_kept;
  json["texels"] = record.statistics.texels;
  json["samples"] = record.statistics.samples;
  json["unfinished"] = record.statistics.unfinished;
  json["channels"] = Json::array();
  for (const host::ChannelStatistics& channel : record.statistics.channels) {
    json["channels"].push_back(json_of(channel));
  }
  json["seconds"] = record.seconds;
  json["shading_cpu_seconds"] = record.statistics.shading_seconds;
  return json;
}

BakedRecord record_of(const Json& json) {
  BakedRecord record;
  json.at("output").get_to(record.output);
  json.at("type").get_to(record.type);
  json.at("settings").get_to(record.settings);
  json.at("images").get_to(record.images);
  if (json.contains("value")) {
    for (const Json& number : json["value"]) {
      record.value.push_back(static_cast<float>(number_of(number)));
    }
    return record;
  }
  json.at("file").get_to(record.file);
  json.at("sha256").get_to(record.digest);
  json.at("bytes").get_to(record.bytes);
  json.at("kept").get_to(record.is_kept);
  json.at("texels").get_to(record.statistics.texels);
  json.at("samples").get_to(record.statistics.samples);
  json.at("unfinished").get_to(record.statistics.unfinished);
  for (const Json& channel : json.at("channels")) {
    record.statistics.channels.push_back(channel_of(channel));
  }
  json.at("seconds").get_to(record.seconds);
  json.at("shading_cpu_seconds").get_to(record.statistics.shading_seconds);
  return record;
}

BakeManifest manifest_of(const Json& json) {
  BakeManifest manifest;
  json.at("nacre").get_to(manifest.version);
  if (json.at("nacre_bake").get<int>() != BakeManifest::format) return manifest;
  if (json.contains("shard")) {
    Shard& shard = manifest.shard.emplace();
    json["shard"].at("index").get_to(shard.index);
    json["shard"].at("count").get_to(shard.count);
  }
  json.at("inputs").get_to(manifest.inputs);
  json.at("options").get_to(manifest.options);
  if (json.contains("document")) {
    json["document"].at("file").get_to(manifest.document);
    json["document"].at("sha256").get_to(manifest.document_digest);
  }
  for (const Json& file : json.at("files")) manifest.files.push_back(record_of(file));
  for (const Json& value : json.at("values")) manifest.values.push_back(record_of(value));
  return manifest;
}

}  // namespace

std::optional<BakeManifest> read_manifest(const std::string& path, Diagnostics& diagnostics) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return std::nullopt;
  const std::optional<std::string> text = read_file(path, most_bytes, diagnostics);
  if (!text) return std::nullopt;
  try {
    return manifest_of(Json::parse(*text));
  } catch (const Json::exception& error) {
    diagnostics.error("bad-manifest", {path, 0, 0, {}}, "this is no manifest of nacre bake",
                      "the name of one, or of no file", error.what());
    return std::nullopt;
  }
}

bool write_manifest(const std::string& path, const BakeManifest& manifest,
                    Diagnostics& diagnostics) {
  Json json;
  json["nacre_bake"] = BakeManifest::format;
  json["nacre"] = manifest.version;
  if (manifest.shard) {
    json["shard"] = {{"index", manifest.shard->index}, {"count", manifest.shard->count}};
  }
  json["inputs"] = manifest.inputs;
  json["options"] = manifest.options;
  if (!manifest.document.empty()) {
    json["document"] = {{"file", manifest.document}, {"sha256", manifest.document_digest}};
  }
  json["files"] = Json::array();
  for (const BakedRecord& file : manifest.files) json["files"].push_back(json_of(file));
  json["values"] = Json::array();
  for (const BakedRecord& value : manifest.values) json["values"].push_back(json_of(value));
  // Names come from documents, which may hold bytes that are no UTF-8.
  const std::string text = json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
  return host::write_text_atomically(path, text, diagnostics);
}

}  // namespace nacre::tool
