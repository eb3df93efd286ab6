#include "jit/cache/entry_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace nacre {

namespace {

/// Begins every file. The version changes with the form of the head.
constexpr std::string_view magic = "nacre-1\n";

struct Head {
  char magic[8];
  char digest[32];  ///< Of everything after it.
  std::uint64_t key;
  std::uint64_t symbol;
  std::uint64_t object;
};
static_assert(sizeof(Head) == 64);

/// The finalizer of SplitMix64 (Steele, Lea and Flood, OOPSLA 2014): a bijection.
std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

std::string_view after_digest(std::string_view file) { return file.substr(offsetof(Head, key)); }

}  // namespace

std::string digest(std::string_view bytes) {
  std::uint64_t low = 0x243f6a8885a308d3ull ^ bytes.size();
  std::uint64_t high = 0x13198a2e03707344ull;
  for (std::size_t at = 0; at < bytes.size(); at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min<std::size_t>(8, bytes.size() - at));
    low = mix(low ^ word);
    high = mix(high + word * 0x9e3779b97f4a7c15ull + 1);
  }
  return fmt::format("{:016x}{:016x}", high, low);
}

std::string pack(std::string_view key, const ObjectCode& object) {
  Head head{};
  std::memcpy(head.magic, magic.data(), sizeof head.magic);
  head.key = key.size();
  head.symbol = object.symbol.size();
  head.object = object.bytes.size();
  std::string file(reinterpret_cast<const char*>(&head), sizeof head);
  file += key;
  file += object.symbol;
  file.append(object.bytes.begin(), object.bytes.end());
  file.replace(offsetof(Head, digest), sizeof head.digest, digest(after_digest(file)));
  return file;
}

std::optional<ObjectCode> unpack(std::string_view file, std::string_view key) {
  Head head{};
  if (file.size() < sizeof head) return std::nullopt;
  std::memcpy(&head, file.data(), sizeof head);
  const std::uint64_t rest = file.size() - sizeof head;
  // Each against the file's size first, so that the sum can't overflow.
  const bool sizes = head.key <= rest && head.symbol <= rest && head.object <= rest &&
                     head.key + head.symbol + head.object == rest;
  if (!sizes || std::string_view(head.magic, sizeof head.magic) != magic) return std::nullopt;
  if (digest(after_digest(file)) != std::string_view(head.digest, sizeof head.digest)) {
    return std::nullopt;
  }
  file.remove_prefix(sizeof head);
  if (file.substr(0, head.key) != key) return std::nullopt;
  file.remove_prefix(head.key);
  const std::string_view bytes = file.substr(head.symbol);
  return ObjectCode{std::string(file.substr(0, head.symbol)), {bytes.begin(), bytes.end()}};
}

}  // namespace nacre
