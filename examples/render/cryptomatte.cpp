#include "examples/render/cryptomatte.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <nlohmann/json.hpp>

namespace nacre::host {

namespace {

std::uint32_t mixed(std::uint32_t k) { return std::rotl(k * 0xcc9e2d51u, 15) * 0x1b873593u; }

}  // namespace

std::uint32_t matte_hash(std::string_view name) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(name[i]); };
  std::uint32_t h = 0;
  const std::size_t whole = name.size() / 4 * 4;
  for (std::size_t i = 0; i < whole; i += 4) {
    const std::uint32_t word = byte(i) | std::uint32_t{byte(i + 1)} << 8 |
                               std::uint32_t{byte(i + 2)} << 16 | std::uint32_t{byte(i + 3)} << 24;
    h = std::rotl(h ^ mixed(word), 13) * 5 + 0xe6546b64u;
  }
  std::uint32_t tail = 0;
  for (std::size_t i = name.size(); i > whole; --i) tail = tail << 8 | byte(i - 1);
  h ^= mixed(tail);
  h ^= static_cast<std::uint32_t>(name.size());
  h = (h ^ h >> 16) * 0x85ebca6bu;
  h = (h ^ h >> 13) * 0xc2b2ae35u;
  return h ^ h >> 16;
}

float matte_id(std::uint32_t hash) {
  const std::uint32_t exponent = hash >> 23 & 255;
  if (exponent == 0 || exponent == 255) hash ^= 1u << 23;
  return std::bit_cast<float>(hash);
}

void MattePixel::add(std::uint32_t name) {
  const auto known = std::ranges::find(counts, name, &Count::name);
  if (known != counts.end()) {
    ++known->samples;
  } else {
    counts.push_back({name, 1});
  }
}

std::vector<MattePixel::Count> MattePixel::ranked(std::size_t most) const {
  std::vector<Count> sorted = counts;
  std::ranges::sort(sorted, [](const Count& a, const Count& b) {
    return a.samples != b.samples ? a.samples > b.samples : a.name < b.name;
  });
  sorted.resize(std::min(sorted.size(), most));
  return sorted;
}

Mattes::Mattes(std::string type_name, const std::vector<std::string>& of_meshes, std::size_t pixels)
    : type(std::move(type_name)), planes(2 * ranks, std::vector<float>(pixels)) {
  std::map<std::string, std::uint32_t> known;
  for (const std::string& name : of_meshes) {
    const auto [at, is_new] = known.emplace(name, static_cast<std::uint32_t>(names.size()));
    if (is_new) {
      names.push_back(name);
      ids.push_back(matte_id(matte_hash(name)));
    }
    of_mesh.push_back(at->second);
  }
}

std::vector<std::string> Mattes::channels() const {
  std::vector<std::string> all;
  for (int layer = 0; layer < ranks / 2; ++layer) {
    for (const char channel : {'R', 'G', 'B', 'A'}) {
      all.push_back(fmt::format("{}{:02}.{}", type, layer, channel));
    }
  }
  return all;
}

std::vector<std::pair<std::string, std::string>> Mattes::attributes() const {
  nlohmann::json manifest = nlohmann::json::object();
  for (const std::string& name : names) manifest[name] = fmt::format("{:08x}", matte_hash(name));
  const std::string head =
      "cryptomatte/" + fmt::format("{:08x}", matte_hash(type)).substr(0, 7) + '/';
  using Replace = nlohmann::json::error_handler_t;
  return {{head + "name", type},
          {head + "hash", "MurmurHash3_32"},
          {head + "conversion", "uint32_to_float32"},
          {head + "manifest", manifest.dump(-1, ' ', false, Replace::replace)}};
}

}  // namespace nacre::host
