// A child of fork() has none of the threads that compile: it must neither wait for them nor
// for what they hold.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <ctime>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "jit/service/compile_service.h"
#include "tests/support/random_program.h"
#include "tests/support/small_program.h"

namespace nacre {
namespace {

std::unique_ptr<CompileService> service(int threads) {
  ServiceOptions options;
  options.threads = threads;
  Diagnostics diagnostics;
  return CompileService::create(options, diagnostics);
}

CodegenOptions quick() {
  CodegenOptions options;
  options.tier = Tier::quick;
  options.lanes = 4;
  return options;
}

/// Seconds of work that the threads of this process have done.
double work_done() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// What `body` gives in a child of fork(), as exit status; -1 if it does not end by itself.
int in_child(const std::function<int()>& body) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);
    _exit(body());
  }
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
  return WEXITSTATUS(status);
}

TEST(Fork, ChildCompilesWithThreadsOfItsOwn) {
  auto one = service(2);
  Diagnostics diagnostics;
  auto ready = one->request(small_program(1.0f), quick(), diagnostics);
  ASSERT_NE(ready, nullptr);
  const int status = in_child([&] {
    if (run_small(*ready, 2.0f) != 5.0f || std::string(ready->engine()) != "jit") return 1;
    for (const float number : {1.0f, 2.0f, 3.0f}) {
      Diagnostics said;
      const auto kernel = one->request(small_program(number), quick(), said);
      if (kernel == nullptr || run_small(*kernel, 2.0f) != 4.0f + number) return 2;
      if (std::string(kernel->engine()) != "jit" || !said.all().empty()) return 3;
      const auto later = one->request_async(small_program(number + 10.0f), quick());
      if (!later->wait() || run_small(*later, 2.0f) != 14.0f + number) return 4;
    }
    one.reset();
    if (run_small(*ready, 3.0f) != 7.0f) return 5;
    ready.reset();
    return 0;
  });
  EXPECT_EQ(status, 0);
  // And the parent goes on.
  EXPECT_NE(one->request(small_program(4.0f), quick(), diagnostics), nullptr);
  EXPECT_EQ(run_small(*ready, 2.0f), 5.0f);
}

TEST(Fork, InTheMiddleOfCompilingTheChildInterprets) {
  auto one = service(1);
  Diagnostics diagnostics;
  auto ready = one->request(small_program(1.0f), quick(), diagnostics);
  auto busy = one->request_async(random_program(1, {.operations = 600}), {});
  auto waiting = one->request_async(small_program(2.0f), quick());
  // Until the other thread has done some of it.
  const double begun = work_done();
  while (work_done() < begun + 0.02) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ASSERT_EQ(busy->state(), CompiledKernel::State::waiting);
  const int status = in_child([&] {
    if (std::string(ready->engine()) != "jit" || run_small(*ready, 2.0f) != 5.0f) return 1;
    if (waiting->wait() || run_small(*waiting, 2.0f) != 6.0f) return 2;
    if (waiting->state() != CompiledKernel::State::cancelled) return 3;
    if (waiting->diagnostics().all().front().code != "forked") return 4;
    Diagnostics said;
    const auto kernel = one->request(small_program(3.0f), quick(), said);
    if (kernel == nullptr || run_small(*kernel, 2.0f) != 7.0f) return 5;
    if (said.warning_count() != 1 || said.error_count() != 0) return 6;
    waiting.reset();
    busy.reset();
    one.reset();
    ready.reset();
    return 0;
  });
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(waiting->wait());
}

/// Many threads fork while many compile: whatever is held at that moment.
// What a process makes once was made with the service, so that no thread is just making it.
TEST(Fork, WhileTheFirstThreadBegins) {
  for (int k = 0; k < 20; ++k) {
    const int status = in_child([&] {
      const auto one = service(1);
      std::atomic<bool> begins = false;
      std::thread asking([&] {
        begins = true;
        Diagnostics said;
        const auto kernel = one->request(small_program(1.0f), quick(), said);
      });
      while (!begins) std::this_thread::yield();
      const int grandchild = in_child([&] {
        Diagnostics said;
        const auto kernel = one->request(small_program(2.0f), quick(), said);
        return kernel != nullptr && run_small(*kernel, 2.0f) == 6.0f ? 0 : 1;
      });
      asking.join();
      return grandchild == 0 ? 0 : 1;
    });
    EXPECT_EQ(status, 0) << k;
  }
}

TEST(Fork, AtAnyMoment) {
  const auto one = service(2);
  std::atomic<bool> done = false;
  std::thread asking([&] {
    for (int k = 0; !done; ++k) {
      Diagnostics said;
      const auto kernel = one->request(small_program(static_cast<float>(k % 1000)), quick(), said);
    }
  });
  for (int k = 0; k < 60; ++k) {
    const int status = in_child([&] {
      Diagnostics said;
      const auto kernel = one->request(small_program(2000.0f), quick(), said);
      return kernel != nullptr && run_small(*kernel, 2.0f) == 2004.0f ? 0 : 1;
    });
    EXPECT_EQ(status, 0) << k;
  }
  done = true;
  asking.join();
}

}  // namespace
}  // namespace nacre
