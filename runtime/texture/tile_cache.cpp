#include "runtime/texture/tile_cache.h"

#include <OpenImageIO/imagecache.h>
#include <fmt/format.h>

#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <vector>

#include "runtime/texture/image_input.h"

namespace nacre {

namespace {

/// What a file of the cache is opened by, each time.
struct Origin {
  std::string path;
  FileIdentity identity;
  ImageLimits limits;
};

constexpr const char* origin_attribute = "nacre:origin";

/// What the cache takes for a reader: finds the format's own by the file's contents, and
/// refuses a file that is no longer the one that was looked at.
class CachedInput final : public OIIO::ImageInput {
 public:
  const char* format_name() const override {
    return input_.reader ? input_.reader->format_name() : "nacre";
  }
  int supports(OIIO::string_view feature) const override {
    return input_.reader ? input_.reader->supports(feature) : 0;
  }
  bool open(const std::string& name, OIIO::ImageSpec& spec) override {
    return open(name, spec, OIIO::ImageSpec());
  }
  bool open(const std::string&, OIIO::ImageSpec& spec, const OIIO::ImageSpec& config) override {
    const void* origin = nullptr;
    config.getattribute(origin_attribute, OIIO::TypeDesc::PTR, &origin);
    if (origin == nullptr) return fail("the file has no origin");
    try {
      return open_again(*static_cast<const Origin*>(origin), spec);
    } catch (const std::exception& error) {
      return fail(error.what());
    }
  }
  bool close() override {
    input_.close();
    return true;
  }
  int current_subimage() const override { return input_.reader->current_subimage(); }
  int current_miplevel() const override { return input_.reader->current_miplevel(); }
  bool seek_subimage(int subimage, int level) override {
    return take(input_.seek(subimage, level));
  }
  bool read_native_scanline(int subimage, int level, int y, int z, void* data) override {
    return take(input_.reader->read_native_scanline(subimage, level, y, z, data));
  }
  bool read_native_scanlines(int subimage, int level, int y0, int y1, int z, void* data) override {
    return take(input_.reader->read_native_scanlines(subimage, level, y0, y1, z, data));
  }
  bool read_native_scanlines(int subimage, int level, int y0, int y1, int z, int c0, int c1,
                             void* data) override {
    return take(input_.reader->read_native_scanlines(subimage, level, y0, y1, z, c0, c1, data));
  }
  bool read_native_tile(int subimage, int level, int x, int y, int z, void* data) override {
    return take(input_.reader->read_native_tile(subimage, level, x, y, z, data));
  }
  bool read_native_tiles(int subimage, int level, int x0, int x1, int y0, int y1, int z0, int z1,
                         void* data) override {
    return take(input_.reader->read_native_tiles(subimage, level, x0, x1, y0, y1, z0, z1, data));
  }
  bool read_native_tiles(int subimage, int level, int x0, int x1, int y0, int y1, int z0, int z1,
                         int c0, int c1, void* data) override {
    return take(
        input_.reader->read_native_tiles(subimage, level, x0, x1, y0, y1, z0, z1, c0, c1, data));
  }

 private:
  bool fail(const std::string& reason) {
    input_.close();
    errorfmt("{}", reason);
    return false;
  }

  bool open_again(const Origin& origin, OIIO::ImageSpec& spec) {
    Diagnostic error;
    auto file = ImageFile::open(origin.path, origin.limits, error);
    if (file == nullptr) return fail(error.message);
    if (file->identity() != origin.identity) return fail("the file is another than it was");
    if (const auto problem = open_input(std::move(file), origin.limits, {}, input_)) {
      return fail(problem->found);
    }
    if (const auto problem = check_header(input_.reader->spec(), *input_.file, 1, origin.limits)) {
      return fail(problem->message);
    }
    m_spec = spec = input_.reader->spec();
    return true;
  }

  /// The inner reader's errors and the image that it is at become ours.
  bool take(bool good) {
    if (input_.reader->has_error()) errorfmt("{}", input_.reader->geterror());
    m_spec = input_.reader->spec();
    return good;
  }

  GuardedInput input_;
};

OIIO::ImageInput* make_input() { return new CachedInput; }

}  // namespace

struct TileCache::Cache {
  OIIO::ImageCache* cache = nullptr;
  ImageLimits limits;
  std::atomic<std::uint64_t> read_failures{0};
  std::mutex mutex;
  std::map<std::string, std::unique_ptr<Origin>> origins;  ///< By what the cache calls them.
  ~Cache() {
    if (cache) OIIO::ImageCache::destroy(cache);
  }
};

struct TileCache::File {
  struct Level {
    int width = 0;
    int height = 0;
    int x = 0;  ///< Origin of the full window.
    int y = 0;
  };
  OIIO::ImageCache::ImageHandle* handle = nullptr;
  ImageInfo info;
  std::vector<Level> levels;
};

TileCache::TileCache(std::uint64_t budget_bytes, const ImageLimits& limits)
    : cache_(std::make_unique<Cache>()) {
  cache_->cache = OIIO::ImageCache::create(/*shared=*/false);
  cache_->limits = limits;
  OIIO::ImageCache& cache = *cache_->cache;
  cache.attribute("max_memory_MB", static_cast<float>(budget_bytes) / (1024.f * 1024.f));
  cache.attribute("autotile", 64);
  cache.attribute("automip", 1);
  cache.attribute("unassociatedalpha", 1);
  // By digests that files claim to have: one could take another's place.
  cache.attribute("deduplicate", 0);
}

TileCache::~TileCache() = default;

std::shared_ptr<TileCache::File> TileCache::open(const std::string& path, const ImageInfo& info) {
  OIIO::ImageCache& cache = *cache_->cache;
  // A name for this state of the file; never one that the cache would look for itself.
  const FileIdentity& of = info.file;
  const std::string name = fmt::format("nacre:{:x}.{:x}.{:x}.{:x}.{:x}:{}", of.device, of.inode,
                                       of.bytes, of.modified, of.changed, path);
  const Origin* origin = nullptr;
  {
    const std::lock_guard lock(cache_->mutex);
    auto& place = cache_->origins[name];
    if (!place) place = std::make_unique<Origin>(Origin{path, of, cache_->limits});
    origin = place.get();
  }
  OIIO::ImageSpec config;
  config.attribute(origin_attribute, OIIO::TypeDesc::PTR, &origin);
  const OIIO::ustring id(name);
  auto file = std::make_shared<File>();
  file->info = info;
  cache.add_file(id, make_input, &config);
  file->handle = cache.get_image_handle(id);
  if (!file->handle || !cache.good(file->handle)) {
    cache.geterror();
    return nullptr;
  }
  OIIO::ImageSpec spec;
  for (int level = 0; cache.get_imagespec(file->handle, nullptr, spec, info.subimage, level);
       ++level) {
    file->levels.push_back({spec.full_width, spec.full_height, spec.full_x, spec.full_y});
    if (spec.full_width <= 1 && spec.full_height <= 1) break;
  }
  cache.geterror();  // Asking past the last level is how we learn their number.
  return file->levels.empty() ? nullptr : file;
}

int TileCache::level_count(const File& file) { return static_cast<int>(file.levels.size()); }

int TileCache::width(const File& file, int level) {
  return file.levels[static_cast<std::size_t>(level)].width;
}

int TileCache::height(const File& file, int level) {
  return file.levels[static_cast<std::size_t>(level)].height;
}

std::uint64_t TileCache::read_failures() const {
  return cache_->read_failures.load(std::memory_order_relaxed);
}

bool TileCache::read(const File& file, int level, int x0, int x1, int y0, int y1,
                     float* samples) const {
  OIIO::ImageCache& cache = *cache_->cache;
  const File::Level& size = file.levels[static_cast<std::size_t>(level)];
  const int first = file.info.first_channel;
  const bool good = cache.get_pixels(file.handle, nullptr, file.info.subimage, level, size.x + x0,
                                     size.x + x1, size.y + y0, size.y + y1, 0, 1, first,
                                     first + file.info.channels, OIIO::TypeFloat, samples);
  if (!good) {
    cache.geterror();
    cache_->read_failures.fetch_add(1, std::memory_order_relaxed);
  }
  return good;
}

}  // namespace nacre
