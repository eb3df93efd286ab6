#include "examples/render/gltf_buffers.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <system_error>
#include <utility>

#include "examples/render/gltf_meshopt.h"
#include "examples/render/scene_file.h"

namespace nacre::host {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::int8_t, 256> base64_values() {
  constexpr std::string_view alphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<std::int8_t, 256> table{};
  table.fill(-1);
  for (std::size_t i = 0; i < alphabet.size(); ++i) {
    table[static_cast<unsigned char>(alphabet[i])] = static_cast<std::int8_t>(i);
  }
  return table;
}

/// RFC 4648, section 4; nothing if it is something else.
std::optional<std::string> decode_base64(std::string_view text) {
  static constexpr std::array<std::int8_t, 256> values = base64_values();
  while (text.ends_with('=')) text.remove_suffix(1);
  if (text.size() % 4 == 1) return {};
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    const std::int8_t value = values[static_cast<unsigned char>(c)];
    if (value < 0) return {};
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes += static_cast<char>(bits >> held & 0xff);
  }
  return bytes;
}

int hex(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// "%20" is a blank: RFC 3986, 2.1.
std::string percent_decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_code =
        text[i] == '%' && i + 2 < text.size() && hex(text[i + 1]) >= 0 && hex(text[i + 2]) >= 0;
    result += is_code ? static_cast<char>(16 * hex(text[i + 1]) + hex(text[i + 2])) : text[i];
    if (is_code) i += 2;
  }
  return result;
}

}  // namespace

GltfBuffers::GltfBuffers(const GltfValue& root, std::optional<std::string> binary,
                         std::size_t file_bytes)
    : root_(root), binary_(std::move(binary)), file_bytes_(file_bytes) {
  std::error_code ignored;
  folder_ = fs::weakly_canonical(fs::absolute(root.report().file, ignored).parent_path(), ignored);
  buffers_.resize(root["buffers"].size());
}

std::optional<std::string_view> GltfBuffers::bytes(std::size_t index) {
  Buffer& buffer = buffers_[index];
  if (!std::exchange(buffer.is_read, true)) buffer.bytes = read(index, root_["buffers"][index]);
  if (!buffer.bytes) return {};
  return *buffer.bytes;
}

std::optional<std::string> GltfBuffers::read(std::size_t index, const GltfValue& buffer) {
  const auto length = buffer["byteLength"].need("the length in bytes").count();
  if (!length) return {};
  std::optional<std::string> bytes;
  const GltfValue uri = buffer["uri"];
  if (!uri) {
    if (index == 0) bytes = std::exchange(binary_, std::nullopt);
    if (!bytes) buffer.error("the buffer has no bytes", "a uri, or a BIN chunk", "none");
  } else if (const auto text = uri.text()) {
    bytes = is_data(*text) ? data(uri) : read_file(uri, *text);
  }
  if (!bytes || bytes->size() >= *length) return bytes;
  buffer.error("the buffer is shorter than it says", fmt::format("{} bytes", *length),
               fmt::format("{}", bytes->size()));
  return {};
}

bool GltfBuffers::is_data(std::string_view uri) { return uri.starts_with("data:"); }

std::string GltfBuffers::file_name(std::string_view uri) { return percent_decoded(uri); }

std::optional<std::string> GltfBuffers::data(const GltfValue& uri) {
  const std::string text = uri.text().value_or("");
  constexpr std::string_view base64 = ";base64,";
  const std::size_t start = text.find(base64);
  if (start == text.npos) {
    uri.error("the data of the URI are in another form", "base64", text.substr(0, 40));
    return {};
  }
  auto bytes = decode_base64(std::string_view(text).substr(start + base64.size()));
  if (!bytes) uri.error("the data of the URI are not base64", "base64", text.substr(0, 40));
  return bytes;
}

std::optional<std::string_view> GltfBuffers::view(const GltfValue& index) {
  const auto number = index.need("the index of a buffer view").index_of(root_["bufferViews"]);
  if (!number) return {};
  const GltfValue described = root_["bufferViews"][*number];
  const GltfValue packed = described["extensions"]["EXT_meshopt_compression"];
  const auto known = unpacked_.find(*number);
  if (known != unpacked_.end()) return known->second;
  // It has a buffer, an offset and a length of its own.
  const GltfValue& view = packed ? packed : described;
  const auto buffer = view["buffer"].need("the index of a buffer").index_of(root_["buffers"]);
  const auto length = view["byteLength"].need("a length in bytes").count();
  if (!buffer || !length) return {};
  // What is there but wrong has been reported and counts as nothing until the end.
  const std::size_t offset = view["byteOffset"].count().value_or(0);
  const auto data = bytes(*buffer);
  if (!data) return {};
  if (offset <= data->size() && *length <= data->size() - offset) {
    if (!packed) return data->substr(offset, *length);
    auto bytes = unpack_meshopt(packed, data->substr(offset, *length), file_bytes_);
    if (!bytes) return {};
    file_bytes_ -= bytes->size();
    return unpacked_[*number] = std::move(*bytes);
  }
  view.error("the buffer view is not within its buffer",
             fmt::format("at most {} bytes", data->size()),
             fmt::format("{} bytes from {}", *length, offset));
  return {};
}

std::optional<std::string> GltfBuffers::read_file(const GltfValue& uri, const std::string& name) {
  std::error_code status;
  const fs::path wanted = fs::weakly_canonical(folder_ / percent_decoded(name), status);
  const fs::path inside = status ? fs::path() : fs::relative(wanted, folder_, status);
  if (status || inside.empty() || *inside.begin() == "..") {
    uri.error("the buffer is outside the folder of the scene", "a file of that folder or below",
              uri.shown());
    return {};
  }
  return read_scene_file(wanted.string(), uri.location(), file_bytes_, uri.report().diagnostics);
}

}  // namespace nacre::host
