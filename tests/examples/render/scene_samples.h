#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

/// \file
/// A good glTF scene to spoil: a square card under a node with a camera beside it.
namespace nacre::host {

template <class T>
void append(std::string& data, std::initializer_list<T> values) {
  for (const T v : values) data.append(reinterpret_cast<const char*>(&v), sizeof v);
}

/// Bytes 0-47: four corners; 48-79: uv; 80-91: six 16-bit indices; 92-139: normals along z;
/// 140-203: tangents along x.
inline std::string card_data() {
  std::string data;
  append<float>(data, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  append<float>(data, {0, 1, 1, 1, 1, 0, 0, 0});  // glTF: v runs down
  append<std::uint16_t>(data, {0, 1, 2, 0, 2, 3});
  append<float>(data, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  append<float>(data, {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1});
  return data;
}

/// Its buffer is the file "card.bin".
inline constexpr std::string_view card_json = R"({
  "asset": {"version": "2.0"},
  "scene": 0,
  "scenes": [{"nodes": [0, 1]}],
  "nodes": [{"name": "sign", "mesh": 0, "scale": [1, 1, 1]},
            {"camera": 0, "translation": [0.5, 0.5, 3]}],
  "materials": [{"name": "paint"}],
  "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}],
  "meshes": [{"name": "card", "primitives": [
    {"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "NORMAL": 3}, "indices": 2, "material": 0}]}],
  "buffers": [{"byteLength": 204, "uri": "card.bin"}],
  "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48},
                  {"buffer": 0, "byteOffset": 48, "byteLength": 32},
                  {"buffer": 0, "byteOffset": 80, "byteLength": 12},
                  {"buffer": 0, "byteOffset": 92, "byteLength": 48},
                  {"buffer": 0, "byteOffset": 140, "byteLength": 64}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
                {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"},
                {"bufferView": 3, "componentType": 5126, "count": 4, "type": "VEC3"},
                {"bufferView": 4, "componentType": 5126, "count": 4, "type": "VEC4"}]
})";

/// The card with one piece of its text replaced by another.
inline std::string spoiled_card(std::string_view from, std::string_view to) {
  std::string text(card_json);
  const std::size_t place = text.find(from);
  return place == text.npos ? "the card has no " + std::string(from)
                            : text.replace(place, from.size(), to);
}

/// A .glb: a 12-byte header and two chunks (glTF 2.0, chapter 4).
inline std::string glb(std::string json, std::string data) {
  while (json.size() % 4 != 0) json += ' ';
  while (data.size() % 4 != 0) data += '\0';
  const auto word = [](std::size_t v) {
    const auto u = static_cast<std::uint32_t>(v);
    return std::string(reinterpret_cast<const char*>(&u), 4);
  };
  return "glTF" + word(2) + word(28 + json.size() + data.size()) + word(json.size()) + "JSON" +
         json + word(data.size()) + std::string("BIN\0", 4) + data;
}

/// Puts something before the first place of a text.
inline void put_before(std::string& text, std::string_view place, std::string_view what) {
  text.insert(text.find(place), what);
}

/// One more of the card's buffer views.
inline std::string buffer_view(int offset, int length) {
  return ", {\"buffer\": 0, \"byteOffset\": " + std::to_string(offset) +
         ", \"byteLength\": " + std::to_string(length) + "}";
}

/// One more of its accessors.
inline std::string accessor(int view, int count, const char* type, int component = 5126) {
  return ", {\"bufferView\": " + std::to_string(view) +
         ", \"componentType\": " + std::to_string(component) +
         ", \"count\": " + std::to_string(count) + ", \"type\": \"" + type + "\"}";
}

}  // namespace nacre::host
