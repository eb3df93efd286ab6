#include "examples/render/checkpoint.h"

#include <cstdint>
#include <filesystem>
#include <limits>

#include "examples/common/atomic_file.h"
#include "examples/render/number_bytes.h"
#include "runtime/digest.h"
#include "runtime/read_file.h"

namespace nacre::host {

namespace {

// A file is the magic, the hash of all that follows, the hash of the key, how many tiles there are,
// their samples, what was counted, and the sums.
constexpr std::string_view magic = "nacre render checkpoint 2\n";
constexpr std::string_view any_version = "nacre render checkpoint ";
constexpr std::size_t hash_size = 64;

std::string hash_of(std::string_view bytes) { return to_hex(sha256(bytes)); }

}  // namespace

Checkpoint::Content Checkpoint::load(Diagnostics& diagnostics) const {
  std::error_code none;
  if (!std::filesystem::exists(file_, none)) return {};
  const auto bytes = read_file(file_, std::numeric_limits<std::uint64_t>::max(), diagnostics);
  if (!bytes) return {};
  const auto wrong = [&](const char* what, const char* expected) {
    diagnostics.error("bad-checkpoint", {file_, 0, 0, {}}, what, expected);
    return Content{};
  };
  std::string_view rest(*bytes);
  if (rest.starts_with(any_version) && !rest.starts_with(magic)) {
    return wrong("the checkpoint is of another version of nacre", "no such file, to begin anew");
  }
  if (!rest.starts_with(magic) || rest.size() < magic.size() + 2 * hash_size) {
    return wrong("the file is no checkpoint of a render", "another name, or no such file");
  }
  const auto take = [&](std::size_t size) {
    const std::string_view taken = rest.substr(0, size);
    rest.remove_prefix(size);
    return taken;
  };
  take(magic.size());
  const std::string_view hash = take(hash_size);
  if (hash_of(rest) != hash) {
    return wrong("the checkpoint is broken", "the bytes that were written");
  }
  if (take(hash_size) != hash_of(key_)) {
    return wrong("the checkpoint is of another render",
                 "the same files and options; or no such file");
  }
  Content content;
  std::vector<std::uint64_t> tiles(1);
  const bool has_tiles = take_numbers(rest, tiles) && tiles[0] <= rest.size() / sizeof(int);
  content.done.resize(has_tiles ? tiles[0] : 0);
  std::vector<RenderCounts> counts(1);
  if (!take_numbers(rest, content.done) || !take_numbers(rest, counts))
    return wrong("the checkpoint is broken", "all of it");
  content.counts = counts[0];
  content.sums = rest;
  return content;
}

bool Checkpoint::is_due() const { return Clock::now() - last_ >= every_; }

bool Checkpoint::save(const std::vector<int>& done, const RenderCounts& counts,
                      const std::function<void(std::string&)>& append, Diagnostics& diagnostics) {
  std::string bytes(magic);
  const std::size_t start = bytes.append(hash_size, '0').size();
  bytes += hash_of(key_);
  append_numbers(bytes, std::vector<std::uint64_t>{done.size()});
  append_numbers(bytes, done);
  append_numbers(bytes, std::vector{counts});
  append(bytes);
  bytes.replace(magic.size(), hash_size, hash_of(std::string_view(bytes).substr(start)));
  const bool is_written = write_text_atomically(file_, bytes, diagnostics);
  last_ = Clock::now();
  return is_written;
}

}  // namespace nacre::host
