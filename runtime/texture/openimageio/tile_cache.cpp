#include "runtime/texture/openimageio/tile_cache.h"

#include <OpenImageIO/imagecache.h>
#include <fmt/format.h>

#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <vector>

#include "runtime/texture/openimageio/image_input.h"

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
    if (const auto problem =
            open_input(std::move(file), origin.limits, ImageExtent::whole, {}, input_)) {
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

struct CachedFile final : TileCache::File {
  /// Of a level's full window.
  struct Corner {
    int x = 0;
    int y = 0;
  };
  OIIO::ImageCache::ImageHandle* handle = nullptr;
  ImageInfo info;
  std::vector<Corner> corners;  ///< As many as levels.
};

class Cache final : public TileCache {
 public:
  Cache(std::uint64_t budget_bytes, const ImageLimits& limits);
  ~Cache() override { OIIO::ImageCache::destroy(&cache_); }

  std::shared_ptr<File> open(const std::string& path, const ImageInfo& info) override;
  bool read(const File& file, int level, int x0, int x1, int y0, int y1,
            float* samples) const override;
  std::uint64_t read_failures() const override {
    return read_failures_.load(std::memory_order_relaxed);
  }

 private:
  OIIO::ImageCache& cache_;
  ImageLimits limits_;
  mutable std::atomic<std::uint64_t> read_failures_{0};
  std::mutex mutex_;
  std::map<std::string, std::unique_ptr<Origin>> origins_;  ///< By what the cache calls them.
};

Cache::Cache(std::uint64_t budget_bytes, const ImageLimits& limits)
    : cache_(*OIIO::ImageCache::create(/*shared=*/false)), limits_(limits) {
  cache_.attribute("max_memory_MB", static_cast<float>(budget_bytes) / (1024.f * 1024.f));
  cache_.attribute("autotile", 64);
  cache_.attribute("automip", 1);
  cache_.attribute("unassociatedalpha", 1);
  // By digests that files claim to have: one could take another's place.
  cache_.attribute("deduplicate", 0);
}

std::shared_ptr<TileCache::File> Cache::open(const std::string& path, const ImageInfo& info) {
  // A name for this state of the file; never one that the cache would look for itself.
  const FileIdentity& of = info.file;
  const std::string name = fmt::format("nacre:{:x}.{:x}.{:x}.{:x}.{:x}:{}", of.device, of.inode,
                                       of.bytes, of.modified, of.changed, path);
  const Origin* origin = nullptr;
  {
    const std::lock_guard lock(mutex_);
    auto& place = origins_[name];
    if (!place) place = std::make_unique<Origin>(Origin{path, of, limits_});
    origin = place.get();
  }
  OIIO::ImageSpec config;
  config.attribute(origin_attribute, OIIO::TypeDesc::PTR, &origin);
  const OIIO::ustring id(name);
  auto file = std::make_shared<CachedFile>();
  file->info = info;
  cache_.add_file(id, make_input, &config);
  file->handle = cache_.get_image_handle(id);
  if (!file->handle || !cache_.good(file->handle)) {
    cache_.geterror();
    return nullptr;
  }
  OIIO::ImageSpec spec;
  for (int level = 0; cache_.get_imagespec(file->handle, nullptr, spec, info.subimage, level);
       ++level) {
    file->levels.push_back({spec.full_width, spec.full_height});
    file->corners.push_back({spec.full_x, spec.full_y});
    if (spec.full_width <= 1 && spec.full_height <= 1) break;
  }
  cache_.geterror();  // Asking past the last level is how we learn their number.
  return file->levels.empty() ? nullptr : file;
}

bool Cache::read(const File& file, int level, int x0, int x1, int y0, int y1,
                 float* samples) const {
  const auto& from = static_cast<const CachedFile&>(file);
  const CachedFile::Corner& corner = from.corners[static_cast<std::size_t>(level)];
  const int first = from.info.first_channel;
  const bool good = cache_.get_pixels(
      from.handle, nullptr, from.info.subimage, level, corner.x + x0, corner.x + x1, corner.y + y0,
      corner.y + y1, 0, 1, first, first + from.info.channels, OIIO::TypeFloat, samples);
  if (!good) {
    cache_.geterror();
    read_failures_.fetch_add(1, std::memory_order_relaxed);
  }
  return good;
}

}  // namespace

std::shared_ptr<TileCache> make_image_cache(std::uint64_t budget_bytes, const ImageLimits& limits) {
  return std::make_shared<Cache>(budget_bytes, limits);
}

}  // namespace nacre
