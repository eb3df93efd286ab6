#include "examples/render/denoise.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace nacre::host {

namespace {

// Of the interface in C of version 2 (OpenImageDenoise/oidn.h), what is called here.
constexpr int device_of_cpu = 1;  ///< OIDN_DEVICE_TYPE_CPU: it reads and writes memory of ours.
constexpr int three_floats = 3;   ///< OIDN_FORMAT_FLOAT3
constexpr int version_2 = 20000;  ///< Of 10000 major + 100 minor + patch.

/// Channels of a pass, one pixel after another; empty where there is none.
std::vector<Vec3> interleaved(const PassFilm& passes, const std::string& name,
                              const char* const (&letters)[3]) {
  std::array<const std::vector<float>*, 3> planes{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto found = std::ranges::find(passes.channels, name + '.' + letters[c]);
    if (found == passes.channels.end()) return {};
    planes[c] = &passes.planes[static_cast<std::size_t>(found - passes.channels.begin())];
  }
  std::vector<Vec3> pixels(planes[0]->size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    pixels[i] = {(*planes[0])[i], (*planes[1])[i], (*planes[2])[i]};
  }
  return pixels;
}

void append(PassFilm& passes, const std::string& name, const std::vector<Vec3>& pixels) {
  std::vector<float> planes[3];
  for (const Vec3& p : pixels) {
    planes[0].push_back(p.x);
    planes[1].push_back(p.y);
    planes[2].push_back(p.z);
  }
  const char* const letters[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    passes.channels.push_back(name + '.' + letters[c]);
    passes.planes.push_back(std::move(planes[c]));
  }
}

}  // namespace

struct Denoiser::Library {
  void* handle = nullptr;
  void* device = nullptr;
  void* (*new_device)(int type) = nullptr;
  void (*set_device_int)(void* device, const char* name, int value) = nullptr;
  int (*get_device_int)(void* device, const char* name) = nullptr;
  void (*commit_device)(void* device) = nullptr;
  int (*get_error)(void* device, const char** message) = nullptr;
  void (*release_device)(void* device) = nullptr;
  void* (*new_filter)(void* device, const char* type) = nullptr;
  void (*set_image)(void* filter, const char* name, void* pixels, int format, std::size_t width,
                    std::size_t height, std::size_t offset, std::size_t pixel_bytes,
                    std::size_t row_bytes) = nullptr;
  void (*set_bool)(void* filter, const char* name, bool value) = nullptr;
  void (*commit_filter)(void* filter) = nullptr;
  void (*execute)(void* filter) = nullptr;
  void (*release_filter)(void* filter) = nullptr;

  ~Library() {
    if (device != nullptr) release_device(device);
    // The library's own threads may still run: it stays.
  }

  /// False where the library has none of that name.
  template <class Function>
  bool find(const char* name, Function& function) const {
    function = reinterpret_cast<Function>(dlsym(handle, name));
    return function != nullptr;
  }

  bool find_all() {
    return find("oidnNewDevice", new_device) && find("oidnSetDeviceInt", set_device_int) &&
           find("oidnGetDeviceInt", get_device_int) && find("oidnCommitDevice", commit_device) &&
           find("oidnGetDeviceError", get_error) && find("oidnReleaseDevice", release_device) &&
           find("oidnNewFilter", new_filter) && find("oidnSetSharedFilterImage", set_image) &&
           find("oidnSetFilterBool", set_bool) && find("oidnCommitFilter", commit_filter) &&
           find("oidnExecuteFilter", execute) && find("oidnReleaseFilter", release_filter);
  }

  /// What went wrong since it was asked last; "" if nothing did.
  std::string problem() const {
    const char* message = nullptr;
    if (get_error(device, &message) == 0) return {};
    return message != nullptr ? message : "it does not say why";
  }
};

Denoiser::Denoiser(std::unique_ptr<Library> library) : library_(std::move(library)) {
  const int version = library_->get_device_int(library_->device, "version");
  name_ = fmt::format("Open Image Denoise {}.{}.{}", version / 10000, version / 100 % 100,
                      version % 100);
}

Denoiser::~Denoiser() = default;

std::unique_ptr<Denoiser> Denoiser::load(const std::string& library, int threads,
                                         Diagnostics& diagnostics) {
  const auto refuse = [&](const std::string& found) {
    diagnostics.error("no-denoiser", {library, 0, 0, {}}, "there is nothing that denoises",
                      "libOpenImageDenoise.so of version 2, of the system or of "
                      "NACRE_OPENIMAGEDENOISE: as the package pyoidn of PyPI has it",
                      found);
    return nullptr;
  };
  auto made = std::make_unique<Library>();
  const std::vector<std::string> names =
      library.empty()
          ? std::vector<std::string>{"libOpenImageDenoise.so.2", "libOpenImageDenoise.so"}
          : std::vector<std::string>{library};
  std::string problem;
  for (const std::string& name : names) {
    if (made->handle == nullptr) made->handle = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (const char* const said = dlerror(); said != nullptr && problem.empty()) problem = said;
  }
  if (made->handle == nullptr) return refuse(problem);
  if (!made->find_all()) return refuse("a library that lacks functions of that version");
  made->device = made->new_device(device_of_cpu);
  if (made->device == nullptr) return refuse("a library that has nothing for this processor");
  if (threads > 0) made->set_device_int(made->device, "numThreads", threads);
  made->commit_device(made->device);
  if (const std::string why = made->problem(); !why.empty()) return refuse(why);
  if (made->get_device_int(made->device, "version") < version_2) return refuse("an older version");
  return std::unique_ptr<Denoiser>(new Denoiser(std::move(made)));
}

bool Denoiser::denoise(Film& film, Diagnostics& diagnostics) const {
  const PixelWindow window = film.window();
  const auto width = static_cast<std::size_t>(window.width());
  const auto height = static_cast<std::size_t>(window.height());
  std::vector<Vec3> noisy = film.pixels();
  std::vector<Vec3> albedo = interleaved(film.passes, "albedo", {"R", "G", "B"});
  std::vector<Vec3> normal = interleaved(film.passes, "normal", {"X", "Y", "Z"});
  std::vector<Vec3> result(noisy.size());
  void* const filter = library_->new_filter(library_->device, "RT");
  const auto give = [&](const char* name, std::vector<Vec3>& pixels) {
    if (pixels.empty()) return;
    library_->set_image(filter, name, pixels.data(), three_floats, width, height, 0, sizeof(Vec3),
                        width * sizeof(Vec3));
  };
  give("color", noisy);
  give("albedo", albedo);
  give("normal", normal);
  give("output", result);
  library_->set_bool(filter, "hdr", true);
  library_->commit_filter(filter);
  library_->execute(filter);
  const std::string problem = library_->problem();
  library_->release_filter(filter);
  if (!problem.empty()) {
    diagnostics.error("not-denoised", {}, "the picture could not be denoised", {}, problem);
    return false;
  }
  film.pixels() = std::move(result);
  append(film.passes, "noisy", noisy);
  film.denoised_by = name_;
  return true;
}

}  // namespace nacre::host
