// A host may end its process while threads of ours compile, by exit() or by returning from main().

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <thread>
#include <vector>

#include "jit/service/compile_service.h"
#include "tests/support/random_program.h"
#include "tests/support/small_program.h"

namespace {

std::atomic<bool> is_counting = false;
std::atomic<int> made = 0;
const std::thread::id first_thread = std::this_thread::get_id();

}  // namespace

/// In place of the C library's, for all that the process consists of: what registers a destructor
/// of a static object.
extern "C" int __cxa_atexit(void (*destroy)(void*), void* object, void* module) {
  using Function = int (*)(void (*)(void*), void*, void*);
  static const auto next = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "__cxa_atexit"));
  if (is_counting && std::this_thread::get_id() != first_thread) ++made;
  return next(destroy, object, module);
}

namespace nacre {
namespace {

void begins_to_count() { is_counting = true; }
int made_on_threads() { return made; }

/// As hosts keep it: made before LLVM has made its tables, so it is destroyed after them.
std::unique_ptr<CompileService>& service() {
  static std::unique_ptr<CompileService> one;
  return one;
}

void make_service() {
  Diagnostics diagnostics;
  ServiceOptions options;
  options.threads = 2;
  service() = CompileService::create(options, diagnostics);
}

std::vector<std::shared_ptr<CompiledKernel>> begin_to_compile() {
  std::vector<std::shared_ptr<CompiledKernel>> kernels;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    kernels.push_back(service()->request_async(random_program(seed, {.operations = 300}), {}));
  }
  return kernels;
}

void exit_while_compiling(int milliseconds) {
  make_service();
  const auto kernels = begin_to_compile();
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  std::exit(7);
}

TEST(ExitDeathTest, WhileThreadsCompile) {
  for (int milliseconds = 0; milliseconds < 150; milliseconds += 6) {
    EXPECT_EXIT(exit_while_compiling(milliseconds), testing::ExitedWithCode(7), "") << milliseconds;
  }
}

// What is made on a thread is destroyed before anybody waits for the thread.
TEST(ExitDeathTest, ThreadsMakeNothingThatExitDestroys) {
  const auto compile = [] {
    make_service();
    begins_to_count();
    const auto kernels = begin_to_compile();
    for (const auto& kernel : kernels) kernel->wait();
    _exit(made_on_threads());
  };
  EXPECT_EXIT(compile(), testing::ExitedWithCode(0), "");
}

// Nobody must wait for a thread that waits for itself.
TEST(ExitDeathTest, OnAThreadThatCompiles) {
  const auto exit_when_compiled = [] {
    make_service();
    const auto kernel = service().release()->request_async(small_program(1.0f), {}, 0);
    kernel->when_ended([] { std::exit(7); });
    std::this_thread::sleep_for(std::chrono::seconds(20));
  };
  EXPECT_EXIT(exit_when_compiled(), testing::ExitedWithCode(7), "");
}

// It has none of its parent's threads.
TEST(ExitDeathTest, OfAChildThatCompilesNothing) {
  const auto fork_while_compiling = [] {
    make_service();
    const auto kernels = begin_to_compile();
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    const pid_t child = fork();
    if (child == 0) {
      alarm(20);
      std::exit(7);
    }
    int status = 0;
    waitpid(child, &status, 0);
    _exit(WIFEXITED(status) ? WEXITSTATUS(status) : 1);
  };
  EXPECT_EXIT(fork_while_compiling(), testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace nacre
