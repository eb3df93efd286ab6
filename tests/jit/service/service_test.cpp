#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "jit/service/compile_service.h"
#include "tests/support/random_program.h"
#include "tests/support/sanitizer.h"
#include "tests/support/small_program.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

std::unique_ptr<CompileService> service(const ServiceOptions& options = {}) {
  Diagnostics diagnostics;
  auto made = CompileService::create(options, diagnostics);
  EXPECT_EQ(diagnostics.to_string(), "");
  return made;
}

ServiceOptions one_thread(const fs::path& cache = {}) {
  ServiceOptions options;
  options.threads = 1;
  options.cache = cache;
  return options;
}

CodegenOptions quick() {
  CodegenOptions options;
  options.tier = Tier::quick;
  options.lanes = 4;
  return options;
}

/// Keeps a service's only thread busy for a while.
Program large_program() { return random_program(1, {.operations = 1500}); }

TEST(Service, RequestWaitsForCode) {
  const auto one = service();
  Diagnostics diagnostics;
  const auto kernel = one->request(small_program(1.0f), quick(), diagnostics);
  ASSERT_NE(kernel, nullptr) << diagnostics.to_string();
  EXPECT_STREQ(kernel->engine(), "jit");
  EXPECT_EQ(kernel->lanes(), 4);
  EXPECT_EQ(run_small(*kernel, 2.0f), 5.0f);
  EXPECT_GT(kernel->stats().codegen, 0.0);
  EXPECT_GT(kernel->stats().link, 0.0);
  EXPECT_GT(kernel->stats().object_bytes, 0u);
}

TEST(Service, KernelAnswersBeforeItsCodeIsThere) {
  const auto one = service(one_thread());
  const auto busy = one->request_async(large_program(), {});
  const auto kernel = one->request_async(small_program(1.0f), quick());
  EXPECT_STREQ(kernel->engine(), "interpreter");
  EXPECT_EQ(run_small(*kernel, 2.0f), 5.0f);
  std::atomic<bool> ready = false;
  std::vector<std::thread> users;
  for (int t = 0; t < 3; ++t) {
    users.emplace_back([&] {
      int rounds = 0;
      while (!ready || ++rounds < 100) ASSERT_EQ(run_small(*kernel, 2.0f), 5.0f);
    });
  }
  EXPECT_TRUE(kernel->wait());
  ready = true;
  for (std::thread& user : users) user.join();
  EXPECT_STREQ(kernel->engine(), "jit");
  EXPECT_EQ(kernel->lanes(), 4);
}

TEST(Service, EqualProgramsShareTheirCode) {
  const auto one = service(one_thread());
  Program renamed = small_program(1.0f);
  renamed.parameters[0].name = "other";
  const auto first = one->request_async(small_program(1.0f), quick());
  const auto second = one->request_async(renamed, quick());
  Diagnostics diagnostics;
  const auto third = one->request(small_program(1.0f), quick(), diagnostics);
  ASSERT_NE(third, nullptr);
  // One job: the same measurement, to the last digit.
  EXPECT_EQ(first->stats().codegen, third->stats().codegen);
  EXPECT_EQ(second->stats().codegen, third->stats().codegen);
  EXPECT_EQ(second->program().parameters[0].name, "other");
  EXPECT_EQ(third->program().parameters[0].name, "slope");
  const auto different = one->request(small_program(2.0f), quick(), diagnostics);
  EXPECT_NE(different->stats().codegen, third->stats().codegen);
}

TEST(Service, CancelledRequestIsNotCompiled) {
  const auto one = service(one_thread());
  const auto busy = one->request_async(large_program(), {});
  const auto kernel = one->request_async(small_program(1.0f), quick());
  kernel->cancel();
  EXPECT_FALSE(kernel->wait());
  EXPECT_EQ(kernel->state(), CompiledKernel::State::cancelled);
  EXPECT_EQ(run_small(*kernel, 2.0f), 5.0f);
  // Who wants it later gets it.
  Diagnostics diagnostics;
  EXPECT_NE(one->request(small_program(1.0f), quick(), diagnostics), nullptr);
}

TEST(Service, OneOfTwoMayCancel) {
  const auto one = service(one_thread());
  const auto busy = one->request_async(large_program(), {});
  const auto first = one->request_async(small_program(1.0f), quick());
  const auto second = one->request_async(small_program(1.0f), quick());
  first->cancel();
  EXPECT_TRUE(second->wait());
}

TEST(Service, EndingCancelsAndKernelsLiveOn) {
  auto one = service(one_thread());
  Diagnostics diagnostics;
  const auto ready = one->request(small_program(1.0f), quick(), diagnostics);
  const auto busy = one->request_async(large_program(), {});
  const auto waiting = one->request_async(small_program(2.0f), quick());
  one.reset();
  EXPECT_EQ(waiting->state(), CompiledKernel::State::cancelled);
  EXPECT_EQ(run_small(*waiting, 2.0f), 6.0f);
  EXPECT_EQ(run_small(*ready, 2.0f), 5.0f);
}

TEST(Service, FailureIsADiagnosticAndTheInterpreterAnswers) {
  const auto one = service();
  CodegenOptions options = quick();
  options.target = Target::named("no-such-cpu");
  Diagnostics diagnostics;
  EXPECT_EQ(one->request(small_program(1.0f), options, diagnostics), nullptr);
  EXPECT_EQ(diagnostics.error_count(), 1u);
  const auto kernel = one->request_async(small_program(1.0f), options);
  EXPECT_FALSE(kernel->wait());
  EXPECT_TRUE(kernel->diagnostics().has_errors());
  EXPECT_EQ(run_small(*kernel, 2.0f), 5.0f);
}

/// In a process that may not make memory executable.
[[noreturn]] void interpret_without_jit() {
  constexpr int set_mdwe = 65;  // PR_SET_MDWE, PR_MDWE_REFUSE_EXEC_GAIN: Linux 6.3.
  if (prctl(set_mdwe, 1ul, 0ul, 0ul, 0ul) != 0) _exit(2);
  Diagnostics diagnostics;
  const auto one = CompileService::create({}, diagnostics);
  const bool warned = diagnostics.warning_count() == 1 && diagnostics.error_count() == 0 &&
                      diagnostics.all().front().code == "no-jit";
  const auto kernel = one->request(small_program(1.0f), quick(), diagnostics);
  const bool runs = kernel != nullptr && run_small(*kernel, 2.0f) == 5.0f &&
                    std::string(kernel->engine()) == "interpreter";
  _exit(warned && runs ? 0 : 1);
}

TEST(Service, InterpretsWhereMemoryMayNotBecomeExecutable) {
  const pid_t child = fork();
  if (child == 0) interpret_without_jit();
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 2) GTEST_SKIP() << "this kernel has no PR_SET_MDWE";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

/// In a process that has no mapping left, so that no page can change its protection.
[[noreturn]] void interpret_without_memory_for_code() {
  Diagnostics diagnostics;
  const auto one = service(one_thread());
  const auto before = one->request(small_program(0.5f), quick(), diagnostics);
  if (before == nullptr || !diagnostics.all().empty()) _exit(3);
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  // Neighbours of other protection can't be one mapping.
  constexpr std::size_t pages = 140000;
  void* memory = mmap(nullptr, pages * page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) _exit(2);
  std::size_t k = 0;
  while (k < pages && mprotect(static_cast<char*>(memory) + k * page, page, PROT_READ) == 0) k += 2;
  if (k >= pages) _exit(2);
  const auto kernel = one->request(small_program(1.0f), quick(), diagnostics);
  const bool runs = kernel != nullptr && run_small(*kernel, 2.0f) == 5.0f &&
                    std::string(kernel->engine()) == "interpreter";
  const bool warned = diagnostics.warning_count() == 1 && diagnostics.error_count() == 0 &&
                      diagnostics.all().front().code == "code-memory";
  const auto later = one->request_async(small_program(2.0f), quick());
  const bool answers = !later->wait() && run_small(*later, 2.0f) == 6.0f;
  munmap(memory, pages * page);
  const auto after = one->request(small_program(3.0f), quick(), diagnostics);
  const bool again =
      after != nullptr && std::string(after->engine()) == "jit" && run_small(*before, 2.0f) == 4.5f;
  _exit(!runs ? 10 : !warned ? 11 : !answers ? 12 : !again ? 13 : 0);
}

TEST(Service, InterpretsWhereThereIsNoMemoryForCode) {
  if (is_sanitized) GTEST_SKIP() << "a sanitizer needs mappings of its own";
  const pid_t child = fork();
  if (child == 0) interpret_without_memory_for_code();
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 2) GTEST_SKIP() << "this system has no limit of mappings";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(Service, LanesThatThereAreNotAreADiagnostic) {
  const auto one = service(one_thread());
  for (const int lanes : {0, 2, 3, 32, -1}) {
    CodegenOptions options = quick();
    options.lanes = lanes;
    Diagnostics diagnostics;
    EXPECT_EQ(one->request(small_program(1.0f), options, diagnostics), nullptr);
    EXPECT_EQ(diagnostics.error_count(), 1u) << lanes;
    const auto kernel = one->request_async(small_program(1.0f), options);
    EXPECT_FALSE(kernel->wait());
    EXPECT_EQ(run_small(*kernel, 2.0f), 5.0f);
  }
}

TEST(Service, ThreadsThatThereAreNotAreDoneWithout) {
  for (const int threads : {100000, std::numeric_limits<int>::max(), -5}) {
    ServiceOptions options;
    options.threads = threads;
    const auto one = service(options);
    Diagnostics diagnostics;
    EXPECT_NE(one->request(small_program(1.0f), quick(), diagnostics), nullptr);
  }
}

TEST(Service, SecondRunComesFromTheCache) {
  std::string name = (fs::temp_directory_path() / "nacre-service-XXXXXX").string();
  ASSERT_NE(mkdtemp(name.data()), nullptr);
  const ServiceOptions options = one_thread(fs::path(name) / "kernels");
  Diagnostics diagnostics;
  const auto first = service(options)->request(small_program(1.0f), quick(), diagnostics);
  const auto second = service(options)->request(small_program(1.0f), quick(), diagnostics);
  ASSERT_TRUE(first && second);
  EXPECT_FALSE(first->stats().from_cache);
  EXPECT_TRUE(second->stats().from_cache);
  EXPECT_EQ(second->stats().codegen, 0.0);
  EXPECT_EQ(run_small(*second, 2.0f), 5.0f);
  EXPECT_EQ(diagnostics.to_string(), "");
  fs::remove_all(name);
}

TEST(Service, ManyThreadsAskForAFewPrograms) {
  const auto one = service();
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([&, t] {
      for (int k = 0; k < 20; ++k) {
        const float number = static_cast<float>((t + k) % 7);
        if (k % 2 == 0) {
          Diagnostics diagnostics;
          const auto kernel = one->request(small_program(number), quick(), diagnostics);
          ASSERT_NE(kernel, nullptr) << diagnostics.to_string();
          ASSERT_EQ(run_small(*kernel, 1.0f), 2.0f + number);
        } else {
          const auto kernel = one->request_async(small_program(number), quick());
          ASSERT_EQ(run_small(*kernel, 1.0f), 2.0f + number);
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace nacre
