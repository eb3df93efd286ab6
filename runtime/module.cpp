#include "runtime/module.h"

#include <dlfcn.h>
#include <pthread.h>
#include <sys/mman.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <string_view>
#include <system_error>

#include "runtime/own_file.h"

namespace nacre {

namespace {

namespace fs = std::filesystem;

/// The modules that are open.
struct Modules {
  std::mutex mutex;
  std::map<std::string, const ModuleHead*> heads;

  /// Never destroyed: threads may outlive main().
  static Modules& all() {
    static Modules* const one = make();
    return *one;
  }

 private:
  /// A child of fork() has but one thread, and none that would finish opening a module.
  static Modules* make() {
    auto* const made = new Modules;
    ::pthread_atfork([] { all().mutex.lock(); }, [] { all().mutex.unlock(); },
                     [] { all().mutex.unlock(); });
    return made;
  }
};

/// Address space that has to be free before a module is loaded, and threads that have to be had:
/// the libraries that come with it (some 250) allocate and start threads while they are loaded, and
/// what they do not get there ends the process or stops it for ever: Memory and Processes of
/// tests/examples/tool/resources_test.cpp.
constexpr std::size_t room = std::size_t{768} << 20;
constexpr int threads = 12;

/// Whether they can be had now; they are given back.
bool has_room(ModuleFault& fault) {
  void* const space = ::mmap(nullptr, room, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (space == MAP_FAILED) {
    fault.expected = std::to_string(room >> 20) + " MB of address space to load it into";
    fault.found = "less";
    return false;
  }
  ::munmap(space, room);
  int had = 0;
  std::array<pthread_t, threads> made{};
  std::mutex gate;
  gate.lock();  // All of them at once.
  const auto wait = [](void* at) -> void* {
    const std::lock_guard pass(*static_cast<std::mutex*>(at));
    return nullptr;
  };
  while (had < threads &&
         ::pthread_create(&made[static_cast<std::size_t>(had)], nullptr, wait, &gate) == 0) {
    ++had;
  }
  gate.unlock();
  for (int i = 0; i < had; ++i) ::pthread_join(made[static_cast<std::size_t>(i)], nullptr);
  if (had == threads) return true;
  fault.expected = std::to_string(threads) + " threads to load it with";
  fault.found = std::to_string(had);
  return false;
}

/// The first place that has the file; empty, with the fault, if there is none.
fs::path find(const std::string& name, ModuleFault& fault) {
  const std::string file = name + ".so";
  const OwnFile own{fs::path(NACRE_MODULE_FOLDER) / file, fs::path("modules") / file};
  for (const fs::path& place : places_of(own)) {
    fault.expected += (fault.expected.empty() ? "" : " or ") + place.string();
  }
  fs::path path = find_own_file(own);
  if (path.empty()) fault.found = "no such file";
  return path;
}

/// Its head, if it is that module and of this build.
const ModuleHead* open_file(const fs::path& path, const std::string& name, ModuleFault& fault) {
  if (!has_room(fault)) return nullptr;
  fault.expected = path.string() + " of this build";
  void* const opened = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (opened == nullptr) {
    const char* const reason = ::dlerror();
    fault.found = reason == nullptr ? "a file that cannot be loaded" : reason;
    return nullptr;
  }
  const auto entry = reinterpret_cast<decltype(&nacre_module)>(::dlsym(opened, "nacre_module"));
  if (entry == nullptr) {
    fault.found = "a library that is no module";
    return nullptr;
  }
  const ModuleHead* const head = entry();
  const bool is_of_build = head->build == std::string_view(NACRE_BUILD_KEY);
  if (is_of_build && head->name == name) return head;
  fault.found = is_of_build ? "another module" : "one of another build";
  return nullptr;
}

}  // namespace

const ModuleHead* open_module(const std::string& name, ModuleFault& fault) {
  Modules& modules = Modules::all();
  const std::lock_guard lock(modules.mutex);
  const ModuleHead*& head = modules.heads[name];
  fault = {};
  if (head != nullptr) return head;
  const fs::path path = find(name, fault);
  if (!path.empty()) head = open_file(path, name, fault);
  return head;
}

}  // namespace nacre
