// Bytes as an image file: header, decoding, pyramid, and tiles through the cache.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/texture/texture_store.h"
#include "tests/fuzz/host.h"
#include "tests/fuzz/memory_file.h"

namespace {

using namespace nacre;

/// TGA has no signature, so the name says it; all other formats are told by their first bytes.
const fuzz::MemoryFile& file() {
  static const fuzz::MemoryFile file(".tga");
  return file;
}

void look_up(const TextureSampler& texture) {
  const std::vector<float> u{-0.5f, 0.1f, 0.5f, 0.99f};
  const std::vector<float> zero(u.size());
  std::vector<std::vector<float>> rgba(4, std::vector<float>(u.size()));
  TextureLookup lookup{};
  lookup.count = static_cast<int>(u.size());
  lookup.u = lookup.v = u.data();
  lookup.dudx = lookup.dvdx = lookup.dudy = lookup.dvdy = zero.data();
  texture.lookup(lookup, {rgba[0].data(), rgba[1].data(), rgba[2].data(), rgba[3].data()});
}

void load(std::uint64_t budget, const std::string& layer) {
  TextureOptions options;
  options.budget = budget;
  options.tile_memory = 1 << 20;
  options.limits.max_size = 512;
  options.limits.max_bytes = 4 << 20;
  TextureStore store(options);
  Diagnostics diagnostics;
  const TextureHandle texture = store.acquire({.path = file().path(), .layer = layer}, diagnostics);
  if (texture->missing() != diagnostics.has_errors()) {
    fuzz::fail("an image is missing without a reason, or there with an error");
  }
  if (texture->words().empty()) fuzz::fail("a texture without a header");
  if (texture->sampler() != nullptr) look_up(*texture->sampler());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  file().write(fuzz::as_text(data, size));
  load(8 << 20, size % 3 == 0 ? "1" : "");
  load(0, "");  // no room: through the tile cache
  return 0;
}
