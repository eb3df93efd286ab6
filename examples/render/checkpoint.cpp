#include "examples/render/checkpoint.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "examples/common/atomic_file.h"
#include "runtime/digest.h"

namespace nacre::host {

namespace {

constexpr std::string_view magic = "nacre render checkpoint 1\n";

std::string hash_of(std::string_view bytes) { return to_hex(sha256(bytes)); }

}  // namespace

Checkpoint::Content Checkpoint::load(Diagnostics& diagnostics) const {
  std::error_code none;
  if (!std::filesystem::exists(file_, none)) return {};
  const auto wrong = [&](const char* what, const char* expected) {
    diagnostics.error("bad-checkpoint", {file_, 0, 0, {}}, what, expected);
    return Content{};
  };
  std::ifstream in(file_, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  const std::string key = hash_of(key_);
  // The magic, the hash of what follows, the hash of the key; then how many tiles, and all else.
  const std::size_t head = magic.size() + 2 * key.size();
  if (!bytes.starts_with(magic) || bytes.size() < head + sizeof(std::uint64_t)) {
    return wrong("the file is no checkpoint of a render", "another name, or no such file");
  }
  std::string_view rest(bytes);
  rest.remove_prefix(magic.size());
  if (hash_of(rest.substr(key.size())) != rest.substr(0, key.size())) {
    return wrong("the checkpoint is broken", "the bytes that were written");
  }
  rest.remove_prefix(key.size());
  if (rest.substr(0, key.size()) != key) {
    return wrong("the checkpoint is of another render",
                 "the same files and options; or no such file");
  }
  rest.remove_prefix(key.size());
  std::uint64_t tiles = 0;
  std::memcpy(&tiles, rest.data(), sizeof tiles);
  rest.remove_prefix(sizeof tiles);
  if (tiles > rest.size() / sizeof(int)) return wrong("the checkpoint is broken", "whole");
  Content content;
  content.done.resize(tiles);
  std::memcpy(content.done.data(), rest.data(), tiles * sizeof(int));
  content.sums = rest.substr(tiles * sizeof(int));
  return content;
}

bool Checkpoint::is_due() const { return Clock::now() - last_ >= every_; }

bool Checkpoint::save(const Content& content, Diagnostics& diagnostics) {
  last_ = Clock::now();
  std::string body = hash_of(key_);
  const std::uint64_t tiles = content.done.size();
  body.append(reinterpret_cast<const char*>(&tiles), sizeof tiles);
  body.append(reinterpret_cast<const char*>(content.done.data()), tiles * sizeof(int));
  body += content.sums;
  return write_text_atomically(file_, std::string(magic) + hash_of(body) + body, diagnostics);
}

}  // namespace nacre::host
