#include "runtime/texture/texture_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <utility>

#include "runtime/texture/file_identity.h"
#include "runtime/texture/image_format.h"
#include "runtime/texture/tiled_texture.h"

namespace nacre {

namespace {

/// One user should hear of a broken file once, though many nodes may name it.
void report(const Diagnostic& problem, Diagnostics& diagnostics) {
  const auto& all = diagnostics.all();
  const bool known = std::any_of(all.begin(), all.end(), [&](const Diagnostic& said) {
    return said.code == problem.code && said.where.file == problem.where.file &&
           said.found == problem.found;
  });
  if (!known) diagnostics.add(problem);
}

TextureOptions for_textures(TextureOptions options) {
  options.limits.max_size = std::min(options.limits.max_size, texture_layout::max_size);
  return options;
}

/// Under the store's lock nobody but a holder can make another handle, so a count of one
/// cannot grow behind our back.
bool unused(const TextureHandle& texture) { return texture && texture.use_count() == 1; }

}  // namespace

TextureStore::TextureStore(const TextureOptions& options) : options_(for_textures(options)) {}

TextureHandle TextureStore::acquire(const TextureKey& wanted, Diagnostics& diagnostics,
                                    const Stop& stop) {
  const Entries::key_type key{wanted, identify(wanted.path)};
  std::unique_lock lock(mutex_);
  forget_others(key);
  for (;;) {
    const auto found = entries_.find(key);
    if (found == entries_.end()) break;
    if (!found->second.texture) {
      loaded_.wait(lock);  // The entry may be gone when we wake; look again.
      continue;
    }
    if (!found->second.texture->resident() && unused(found->second.texture)) {
      forget(found);
      break;
    }
    ++statistics_.hits;
    found->second.last_request = ++requests_;
    TextureHandle texture = found->second.texture;
    lock.unlock();
    if (texture->problem()) report(*texture->problem(), diagnostics);
    return texture;
  }

  entries_[key].last_request = ++requests_;
  ++statistics_.loads;
  lock.unlock();
  Loaded loaded;
  try {
    loaded = load(wanted, stop);
  } catch (...) {  // Not even a placeholder could be allocated: leave no entry to wait for.
    lock.lock();
    entries_.erase(key);
    loaded_.notify_all();
    throw;
  }
  lock.lock();
  Entry& entry = entries_[key];
  entry.texture = loaded.texture;
  entry.bytes = loaded.bytes;
  statistics_.replaced_texels += loaded.texture->replaced_texels();
  loaded_.notify_all();
  lock.unlock();
  if (loaded.texture->problem()) report(*loaded.texture->problem(), diagnostics);
  return loaded.texture;
}

/// What cannot be allocated is, to the user, one more image that cannot be read.
TextureStore::Loaded TextureStore::load(const TextureKey& key, const Stop& stop) {
  try {
    return load_image(key, stop);
  } catch (const std::exception& error) {
    return {std::make_shared<Texture>(broken_image(key.path, error.what())), 0};
  }
}

TextureStore::Loaded TextureStore::load_image(const TextureKey& key, const Stop& stop) {
  ImageReader reader;
  if (auto problem = reader.open(key.path, key.layer, options_.limits, stop)) {
    return {std::make_shared<Texture>(std::move(*problem)), 0};
  }
  const texture_layout::Plan plan = plan_texture(reader.info(), key.policy);
  if (!reserve(plan.bytes())) return {open_tiled(key, reader.info()), 0};

  struct Reservation {
    TextureStore& store;
    std::uint64_t bytes;
    ~Reservation() {
      if (bytes != 0) store.release(bytes);
    }
  } reservation{*this, plan.bytes()};
  AlignedWords words = AlignedWords::allocate(plan.total_words, options_.memory);
  if (words.empty()) return {open_tiled(key, reader.info()), 0};
  std::uint64_t replaced = 0;
  if (auto problem = load_texture(reader, plan, words, replaced)) {
    return {std::make_shared<Texture>(std::move(*problem)), 0};
  }
  auto texture = std::make_shared<Texture>(std::move(words), replaced);
  return {std::move(texture), std::exchange(reservation.bytes, 0)};
}

TextureHandle TextureStore::stand_in(const TextureKey& key, const Stop& stop) const {
  ImageReader reader;
  if (reader.look(key.path, key.layer, options_.limits, stop)) return nullptr;
  const texture_layout::Plan whole = plan_texture(reader.info(), key.policy);
  if (whole.bytes() > options_.budget) return nullptr;
  const int side = whole.levels == 1 ? 1 : 2;
  const texture_layout::Plan plan = texture_layout::plan(whole.format, side, side, whole.channels);
  AlignedWords words = AlignedWords::allocate(plan.total_words, options_.memory);
  if (words.empty()) return nullptr;
  texture_layout::write_header(plan, 0, words.span());
  return std::make_shared<Texture>(std::move(words), 0);
}

TextureHandle TextureStore::open_tiled(const TextureKey& key, const ImageInfo& info) {
  std::shared_ptr<TileCache> cache;
  {
    const std::lock_guard lock(mutex_);
    if (!tile_cache_) tile_cache_ = TileCache::make(options_.tile_memory, options_.limits);
    cache = tile_cache_;
  }
  auto file = cache ? cache->open(key.path, info) : nullptr;
  if (!file) {
    return std::make_shared<Texture>(
        image_error("broken-image", key.path, "the image cannot be opened in the tile cache"));
  }
  return std::make_shared<Texture>(
      std::make_unique<TiledTexture>(std::move(cache), std::move(file), info), info.width,
      info.height);
}

bool TextureStore::reserve(std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  if (bytes > options_.budget) return false;
  std::uint64_t in_use = statistics_.resident_bytes;
  for (const auto& [key, entry] : entries_) {
    if (unused(entry.texture)) in_use -= entry.bytes;
  }
  if (in_use > options_.budget - bytes) return false;  // Evicting would not be enough.
  while (statistics_.resident_bytes > options_.budget - bytes) {
    auto oldest = entries_.end();
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
      if (entry->second.bytes == 0 || !unused(entry->second.texture)) continue;
      if (oldest == entries_.end() || entry->second.last_request < oldest->second.last_request) {
        oldest = entry;
      }
    }
    forget(oldest);
    ++statistics_.evictions;
  }
  statistics_.resident_bytes += bytes;
  statistics_.peak_resident_bytes =
      std::max(statistics_.peak_resident_bytes, statistics_.resident_bytes);
  return true;
}

namespace {

/// Whether kernels that were made for one texture can read the other.
bool can_replace(const texture_layout::Plan& plan, const Texture& old) {
  const auto words = old.words();
  const bool was_single = words[texture_layout::word_level_count] == 1;
  const bool is_single = plan.levels == 1;
  return static_cast<std::uint32_t>(plan.channels) == words[texture_layout::word_channels] &&
         (is_single || !was_single);
}

}  // namespace

bool TextureStore::set_image(const std::string& name, const Pixels& pixels,
                             Diagnostics& diagnostics) {
  if (auto fault = fault_of(pixels, name, options_.limits)) {
    diagnostics.add(std::move(*fault));
    return false;
  }
  const std::shared_ptr<const NamedImage> known = image(name);
  const TextureHandle old = known != nullptr ? known->get() : nullptr;
  const texture_layout::TexelFormat format =
      old != nullptr
          ? static_cast<texture_layout::TexelFormat>(old->words()[texture_layout::word_format])
          : texel_format(info_of(pixels), TexelPolicy::automatic);
  const texture_layout::Plan plan =
      texture_layout::plan(format, pixels.width, pixels.height, pixels.channels);
  if (old != nullptr && !can_replace(plan, *old)) {
    diagnostics.add(image_error("bad-image", name, "the image cannot take the other's place",
                                "as many channels, and more than one pixel only where the first "
                                "image had more"));
    return false;
  }
  AlignedWords words;
  const bool has_room = reserve(plan.bytes());
  if (has_room) words = AlignedWords::allocate(plan.total_words, options_.memory);
  if (words.empty()) {
    if (has_room) release(plan.bytes());
    diagnostics.add(image_error("texture-memory", name, "there is no memory for the image",
                                fmt::format("{} bytes", plan.bytes())));
    return false;
  }
  std::uint64_t replaced = 0;
  load_texture(pixels, plan, words, replaced);
  const auto texture = std::make_shared<Texture>(std::move(words), replaced);

  const std::scoped_lock lock(mutex_);
  statistics_.replaced_texels += replaced;
  Named& named = named_[name];
  if (named.image != nullptr) {
    named.image->set(texture);
  } else {
    named.image = std::make_shared<NamedImage>(texture);
  }
  statistics_.resident_bytes -= named.bytes;
  named.bytes = plan.bytes();
  return true;
}

void TextureStore::remove_image(const std::string& name) {
  const std::scoped_lock lock(mutex_);
  const auto found = named_.find(name);
  if (found == named_.end()) return;
  statistics_.resident_bytes -= found->second.bytes;
  named_.erase(found);
}

std::shared_ptr<const NamedImage> TextureStore::image(const std::string& name) const {
  const std::scoped_lock lock(mutex_);
  const auto found = named_.find(name);
  return found != named_.end() ? found->second.image : nullptr;
}

void TextureStore::release(std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  statistics_.resident_bytes -= bytes;
}

TextureStore::Entries::iterator TextureStore::forget(Entries::iterator entry) {
  statistics_.resident_bytes -= entry->second.bytes;
  return entries_.erase(entry);
}

/// Textures of the same name that nobody holds, of a file that is no longer there.
void TextureStore::forget_others(const Entries::key_type& key) {
  for (auto entry = entries_.lower_bound({key.first, {}});
       entry != entries_.end() && entry->first.first == key.first;) {
    const bool is_stale = entry->first.second != key.second && unused(entry->second.texture);
    entry = is_stale ? forget(entry) : std::next(entry);
  }
}

void TextureStore::drop_unused() {
  const std::lock_guard lock(mutex_);
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    entry = unused(entry->second.texture) ? forget(entry) : std::next(entry);
  }
  // It remembers files too. Textures that still need it hold it.
  tile_cache_.reset();
}

TextureStatistics TextureStore::statistics() const {
  const std::lock_guard lock(mutex_);
  TextureStatistics result = statistics_;
  if (tile_cache_) result.read_failures = tile_cache_->read_failures();
  result.resident_textures = named_.size();
  for (const auto& [key, entry] : entries_) {
    if (!entry.texture) continue;
    if (entry.texture->missing()) {
      ++result.missing_textures;
    } else if (entry.texture->resident()) {
      ++result.resident_textures;
    } else {
      ++result.tiled_textures;
    }
  }
  return result;
}

}  // namespace nacre
