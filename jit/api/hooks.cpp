#include "jit/api/hooks.h"

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "jit/api/call.h"
#include "runtime/texture/texel.h"

namespace nacre::api {

namespace {

/// What the functions of a hook are called with; destroyed with its last owner.
template <class Hook>
std::shared_ptr<void> user_of(const Hook& hook) {
  return {hook.user, [destroy = hook.destroy](void* user) {
            if (destroy != nullptr) destroy(user);
          }};
}

class HostSampler final : public TextureSampler {
 public:
  HostSampler(const nacre_texture_system& hook, std::shared_ptr<void> user, void* image)
      : hook_(hook), user_(std::move(user)), image_(image) {}
  ~HostSampler() override {
    if (hook_.close != nullptr) hook_.close(user_.get(), image_);
  }
  HostSampler(const HostSampler&) = delete;
  HostSampler& operator=(const HostSampler&) = delete;

  void lookup(const TextureLookup& points, const std::array<float*, 4>& rgba) const override {
    const nacre_texture_lookup asked{.size = sizeof asked,
                                     .count = points.count,
                                     .u = points.u,
                                     .v = points.v,
                                     .dudx = points.dudx,
                                     .dvdx = points.dvdx,
                                     .dudy = points.dudy,
                                     .dvdy = points.dvdy,
                                     .filter = static_cast<int>(points.filter),
                                     .u_mode = static_cast<int>(points.u_mode),
                                     .v_mode = static_cast<int>(points.v_mode),
                                     .max_anisotropy = points.max_anisotropy};
    hook_.look_up(user_.get(), image_, &asked, rgba.data());
    // Kernels rely on what no image of ours has.
    std::uint64_t replaced = 0;
    for (float* channel : rgba) {
      for (int i = 0; i < points.count; ++i) channel[i] = sanitised(channel[i], replaced);
    }
  }

 private:
  nacre_texture_system hook_;
  std::shared_ptr<void> user_;
  void* image_;
};

class HostTextureSystem final : public TextureSystem {
 public:
  explicit HostTextureSystem(const nacre_texture_system& hook)
      : hook_(hook), user_(user_of(hook)) {}

  std::optional<Opened> open(const std::string& name, const std::string& layer) override {
    nacre_opened_image opened{};
    opened.size = sizeof opened;
    if (hook_.open == nullptr || hook_.look_up == nullptr) return {};
    if (hook_.open(user_.get(), name.c_str(), layer.c_str(), &opened) == 0) return {};
    return Opened{std::make_unique<HostSampler>(hook_, user_, opened.image),
                  std::max(opened.width, 1), std::max(opened.height, 1)};
  }

 private:
  nacre_texture_system hook_;
  std::shared_ptr<void> user_;
};

class HostExecutor final : public Executor {
 public:
  explicit HostExecutor(const nacre_executor& hook) : hook_(hook), user_(user_of(hook)) {}

  void submit(std::function<void()> task) override {
    auto given = std::make_unique<std::function<void()>>(std::move(task));
    hook_.submit(
        user_.get(),
        [](void* taken) {
          const std::unique_ptr<std::function<void()>> mine(
              static_cast<std::function<void()>*>(taken));
          (*mine)();
        },
        given.release());
  }

 private:
  nacre_executor hook_;
  std::shared_ptr<void> user_;
};

class HostMemory final : public BlockMemory {
 public:
  explicit HostMemory(const nacre_allocator& hook) : hook_(hook), user_(user_of(hook)) {}

  void* allocate(std::size_t bytes) noexcept override { return hook_.allocate(user_.get(), bytes); }
  void release(void* block, std::size_t bytes) noexcept override {
    if (hook_.release != nullptr) hook_.release(user_.get(), block, bytes);
  }

 private:
  nacre_allocator hook_;
  std::shared_ptr<void> user_;
};

}  // namespace

FileResolver host_resolver(const nacre_file_resolver& given) {
  const nacre_file_resolver hook = options_of(&given);
  if (hook.resolve == nullptr) return {};
  return [hook, user = user_of(hook)](const std::string& name, const std::string& named_by,
                                      FileKind kind) -> std::optional<ResolvedFile> {
    nacre_file file{};
    file.size = sizeof file;
    const int what = kind == FileKind::include ? NACRE_INCLUDE : NACRE_IMAGE;
    if (hook.resolve(user.get(), name.c_str(), named_by.c_str(), what, &file) == 0) return {};
    ResolvedFile found{.path = text_or_empty(file.path)};
    if (found.path.empty()) found.path = name;
    if (file.bytes != nullptr) {
      found.bytes = std::make_shared<const std::string>(static_cast<const char*>(file.bytes),
                                                        file.byte_count);
    }
    return found;
  };
}

std::shared_ptr<TextureSystem> host_texture_system(const nacre_texture_system& given) {
  return std::make_shared<HostTextureSystem>(options_of(&given));
}

std::shared_ptr<Executor> host_executor(const nacre_executor& given) {
  return std::make_shared<HostExecutor>(options_of(&given));
}

std::shared_ptr<BlockMemory> host_memory(const nacre_allocator& given) {
  return std::make_shared<HostMemory>(options_of(&given));
}

}  // namespace nacre::api
