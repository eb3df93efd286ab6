#include "jit/cache/entry_file.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "runtime/digest.h"

namespace nacre {

namespace {

/// Begins every file. The version changes with the form of the head.
constexpr std::string_view magic = "nacre-2\n";

struct Head {
  char magic[8];
  Digest signature;  ///< Of everything after it.
  std::uint64_t key;
  std::uint64_t symbol;
  std::uint64_t interface;
  std::uint64_t object;
};
static_assert(sizeof(Head) == 72);

std::string_view bytes_of(const char* data, std::size_t size) { return {data, size}; }

/// The sizes in a head.
std::string_view sizes_of(const Head& head) {
  return bytes_of(reinterpret_cast<const char*>(&head) + offsetof(Head, key),
                  sizeof head - offsetof(Head, key));
}

}  // namespace

std::string pack(std::string_view key, const ObjectCode& object, std::string_view secret) {
  Head head{};
  std::memcpy(head.magic, magic.data(), sizeof head.magic);
  head.key = key.size();
  head.symbol = object.symbol.size();
  head.interface = object.interface.size();
  head.object = object.bytes.size();
  const std::string_view code = bytes_of(object.bytes.data(), object.bytes.size());
  head.signature =
      hmac_sha256(secret, {sizes_of(head), key, object.symbol, object.interface, code});
  std::string file(reinterpret_cast<const char*>(&head), sizeof head);
  file += key;
  file += object.symbol;
  file += object.interface;
  file += code;
  return file;
}

std::optional<ObjectCode> unpack(std::string_view file, std::string_view key,
                                 std::string_view secret) {
  Head head{};
  if (file.size() < sizeof head) return std::nullopt;
  std::memcpy(&head, file.data(), sizeof head);
  file.remove_prefix(sizeof head);
  if (bytes_of(head.magic, sizeof head.magic) != magic) return std::nullopt;
  if (!equal_in_constant_time(head.signature, hmac_sha256(secret, {sizes_of(head), file}))) {
    return std::nullopt;
  }
  // Each against the file's size first, so that the sum can't overflow.
  const std::uint64_t all = file.size();
  const bool sizes = head.key <= all && head.symbol <= all && head.interface <= all &&
                     head.object <= all &&
                     head.key + head.symbol + head.interface + head.object == all;
  if (!sizes || file.substr(0, head.key) != key) return std::nullopt;
  const auto take = [&](std::uint64_t size) {
    const std::string_view part = file.substr(0, size);
    file.remove_prefix(size);
    return part;
  };
  take(head.key);
  ObjectCode object;
  object.symbol = take(head.symbol);
  object.interface = take(head.interface);
  object.bytes.assign(file.begin(), file.end());
  return object;
}

}  // namespace nacre
