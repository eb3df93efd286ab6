#include "examples/render/gltf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>

#include "examples/render/gltf_value.h"

namespace nacre::host {

namespace {

using Json = nlohmann::json;

// No property of glTF is nested deeper than this but within `extras`.
constexpr int deepest_json = 64;

/// Looks at JSON before anything is made of it: how deep it is and how many values it has.
class Counter : public nlohmann::json_sax<Json> {
 public:
  explicit Counter(std::size_t most) : most_(most) {}

  bool too_deep() const { return too_deep_; }
  bool too_many() const { return values_ > most_; }

  bool null() override { return count(); }
  bool boolean(bool) override { return count(); }
  bool number_integer(number_integer_t) override { return count(); }
  bool number_unsigned(number_unsigned_t) override { return count(); }
  bool number_float(number_float_t, const string_t&) override { return count(); }
  bool string(string_t&) override { return count(); }
  bool binary(binary_t&) override { return count(); }
  bool key(string_t&) override { return true; }
  bool start_object(std::size_t) override { return enter(); }
  bool start_array(std::size_t) override { return enter(); }
  bool end_object() override { return leave(); }
  bool end_array() override { return leave(); }
  /// Who makes the values finds the fault again, and says it.
  bool parse_error(std::size_t, const std::string&, const Json::exception&) override {
    return false;
  }

 private:
  bool count() { return ++values_ <= most_; }
  bool enter() {
    too_deep_ = ++depth_ > deepest_json;
    return !too_deep_ && count();
  }
  bool leave() {
    --depth_;
    return true;
  }

  std::size_t most_, values_ = 0;
  int depth_ = 0;
  bool too_deep_ = false;
};

/// Line and column, from 1, of a byte, from 1.
SourceLocation place(const std::string& file, std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte == 0 ? 0 : byte - 1, text.size()));
  const std::size_t line = before.rfind('\n');
  return {file, 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
          static_cast<int>(before.size() - (line == before.npos ? 0 : line + 1)) + 1, ""};
}

/// What the parser complains of, without its own name and place.
std::string reason(const Json::exception& fault) {
  std::string text = fault.what();
  if (const std::size_t end = text.find("] "); end != text.npos) text.erase(0, end + 2);
  if (text.starts_with("parse error")) {
    if (const std::size_t colon = text.find(": "); colon != text.npos) text.erase(0, colon + 2);
  }
  return text;
}

std::optional<Json> parse_json(const std::string& file, std::string_view text,
                               const SceneLimits& limits, Diagnostics& diagnostics) {
  // A callback of parse() would do both at once, and look at all elements of an array as
  // often as it has objects.
  Counter counter(limits.values);
  Json::sax_parse(text.begin(), text.end(), &counter);
  if (counter.too_deep() || counter.too_many()) {
    diagnostics.error(
        "scene-too-large", {file, 0, 0, {}},
        counter.too_deep() ? "the JSON is nested too deeply" : "the JSON has too many values",
        counter.too_deep() ? fmt::format("at most {} levels", deepest_json)
                           : fmt::format("at most {} (--max-scene-values)", limits.values));
    return {};
  }
  try {
    return Json::parse(text.begin(), text.end());
  } catch (const Json::parse_error& fault) {
    diagnostics.error("bad-gltf", place(file, text, fault.byte), "this is not JSON",
                      "a glTF 2.0 file", reason(fault));
  } catch (const Json::exception& fault) {
    diagnostics.error("bad-gltf", {file, 0, 0, {}}, "this is not JSON", "a glTF 2.0 file",
                      reason(fault));
  }
  return {};
}

std::uint32_t word(std::string_view bytes, std::size_t at) {
  std::uint32_t value;  // Little-endian, as the machines we run on.
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// The chunks of a .glb: glTF 2.0, 4.4. Each is a part of `bytes`.
bool split_glb(const GltfReport& report, std::string_view bytes, std::string_view& json,
               std::optional<std::string_view>& binary) {
  const auto fail = [&](const char* message, std::string expected, std::string found) {
    report.error({}, message, std::move(expected), std::move(found));
    return false;
  };
  if (bytes.size() < 12 || bytes.substr(0, 4) != "glTF") {
    return fail("this is not a .glb", "a header that begins with \"glTF\"",
                fmt::format("\"{}\" in {} bytes", bytes.substr(0, 4), bytes.size()));
  }
  if (word(bytes, 4) != 2) {
    return fail("this version of .glb is not supported", "2", fmt::format("{}", word(bytes, 4)));
  }
  if (word(bytes, 8) > bytes.size()) {
    return fail("the file is shorter than its header says", fmt::format("{} bytes", word(bytes, 8)),
                fmt::format("{}", bytes.size()));
  }
  bytes = bytes.substr(0, word(bytes, 8));
  std::size_t at = 12;
  for (int chunk = 0; at < bytes.size(); ++chunk) {
    const std::size_t left = bytes.size() - at;
    if (left < 8 || word(bytes, at) > left - 8) {
      return fail("a chunk reaches beyond the end of the file", fmt::format("{} bytes", left),
                  left < 8 ? "less than its header" : fmt::format("{} and 8", word(bytes, at)));
    }
    const std::string_view type = bytes.substr(at + 4, 4);
    const std::string_view content = bytes.substr(at + 8, word(bytes, at));
    if (chunk == 0 && type != "JSON") {
      return fail("the first chunk is another", "JSON", fmt::format("\"{}\"", type));
    }
    if (chunk == 0) json = content;
    if (chunk == 1 && type == std::string_view("BIN\0", 4)) binary = content;
    at += 8 + content.size();
  }
  if (json.data() != nullptr) return true;
  return fail("the file has no chunk", "JSON", "none");
}

/// glTF 2.0, 3.2: what has the same major version can be read, unless it asks for more.
bool check_version(const GltfValue& root) {
  for (const char* name : {"version", "minVersion"}) {
    const GltfValue version = root["asset"][name];
    if (!version && std::string_view(name) == "minVersion") continue;
    const auto text = version.need("\"2.0\"").text();
    if (!text) return false;
    const bool fits =
        std::string_view(name) == "version" ? text->starts_with("2.") : *text == "2.0";
    if (fits) continue;
    version.error("this version of glTF is not supported", "\"2.0\"", version.shown());
    return false;
  }
  return true;
}

}  // namespace

std::optional<GltfFile> parse_gltf_file(const std::string& file, std::string bytes,
                                        const SceneLimits& limits, Diagnostics& diagnostics) {
  const GltfReport report{file, diagnostics};
  // As load_scene() tells them apart.
  const bool is_binary = file.ends_with('b') || file.ends_with('B');
  std::string_view json = is_binary ? std::string_view() : bytes;
  std::optional<std::string_view> binary;
  if (is_binary && !split_glb(report, bytes, json, binary)) return {};
  auto root = parse_json(file, json, limits, diagnostics);
  if (!root || !check_version(GltfValue(&*root, {}, report))) return {};
  GltfFile result{std::move(*root), {}};
  if (binary) {
    const auto first = static_cast<std::size_t>(binary->data() - bytes.data());
    bytes.erase(first + binary->size());
    bytes.erase(0, first);
    result.binary = std::move(bytes);
  }
  return result;
}

}  // namespace nacre::host
