#include "examples/tool/bake/shard.h"

#include <charconv>

namespace nacre::tool {

std::optional<Shard> parse_shard(std::string_view text) {
  const auto take_number = [&text](std::size_t& number) {
    const char* end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, number);
    text.remove_prefix(static_cast<std::size_t>(last - text.data()));
    return error == std::errc{} && number >= 1 && number <= most_shards;
  };
  Shard shard;
  if (!take_number(shard.index) || !text.starts_with('/')) return std::nullopt;
  text.remove_prefix(1);
  if (!take_number(shard.count) || !text.empty() || shard.index > shard.count) return std::nullopt;
  return shard;
}

}  // namespace nacre::tool
