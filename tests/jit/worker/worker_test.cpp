// Where code is made in a process apart, whatever happens to that process the host goes on,
// has its answers from the interpreter and knows why.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "jit/service/compile_service.h"
#include "runtime/program/digest.h"
#include "runtime/program/serialize.h"
#include "tests/support/random_program.h"
#include "tests/support/sanitizer.h"
#include "tests/support/small_program.h"

namespace nacre {
namespace {

std::unique_ptr<CompileService> service(const char* worker, const WorkerLimits& limits = {}) {
  ServiceOptions options;
  options.threads = 2;
  options.worker = worker;
  options.worker_limits = limits;
  Diagnostics diagnostics;
  auto made = CompileService::create(options, diagnostics);
  EXPECT_EQ(diagnostics.to_string(), "");
  return made;
}

CodegenOptions quick() {
  CodegenOptions options;
  options.tier = Tier::quick;
  options.lanes = 4;
  return options;
}

Program named_program(const std::string& name, float number = 1.0f) {
  Program program = small_program(number);
  program.name = name;
  return program;
}

/// Processes that this one has started and not waited for.
int children() {
  int count = 0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream file(task.path() / "children");
    for (int id = 0; file >> id;) ++count;
  }
  return count;
}

TEST(Worker, ProgramsSurviveTheWayThere) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const Program program = random_program(seed);
    const auto there = program_from_bytes(to_bytes(program));
    ASSERT_TRUE(there.has_value()) << seed;
    EXPECT_EQ(to_string(*there), to_string(program)) << seed;
    EXPECT_EQ(to_hex(code_digest(*there)), to_hex(code_digest(program))) << seed;
    EXPECT_TRUE(verify(*there).empty()) << seed;
  }
}

TEST(Worker, NoPartOfAProgramIsTakenForOne) {
  const std::string bytes = to_bytes(random_program(1));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(program_from_bytes(bytes.substr(0, size)).has_value()) << size;
  }
  EXPECT_FALSE(program_from_bytes(bytes + '\0').has_value());
}

TEST(Worker, MakesTheCodeThatIsMadeHere) {
  const auto apart = make_compiler_apart(WORKER);
  const auto here = make_compiler_here();
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    Program program = random_program(seed);
    mark_varying(program);
    CodegenOptions options = quick();
    options.lanes = seed % 2 == 0 ? 4 : 1;
    Diagnostics diagnostics;
    CompileStats stats;
    const auto theirs = apart->compile(program, options, diagnostics, stats, {});
    const auto ours = here->compile(program, options, diagnostics, stats, {});
    ASSERT_TRUE(theirs && ours) << diagnostics.to_string();
    EXPECT_EQ(theirs->bytes, ours->bytes) << seed;
    EXPECT_EQ(theirs->symbol, ours->symbol);
    EXPECT_EQ(theirs->interface, ours->interface);
  }
}

TEST(Worker, KernelsRunHere) {
  const auto one = service(WORKER);
  Diagnostics diagnostics;
  const auto kernel = one->request(small_program(1.0f), quick(), diagnostics);
  ASSERT_NE(kernel, nullptr) << diagnostics.to_string();
  EXPECT_STREQ(kernel->engine(), "jit");
  EXPECT_EQ(run_small(*kernel, 2.0f), 5.0f);
  EXPECT_GT(kernel->stats().codegen, 0.0);
  EXPECT_GT(kernel->stats().object_bytes, 0u);
}

TEST(Worker, ErrorsOfTheTargetComeBack) {
  const auto one = service(WORKER);
  CodegenOptions options = quick();
  options.target.cpu = "nonesuch";
  Diagnostics diagnostics;
  EXPECT_EQ(one->request(small_program(1.0f), options, diagnostics), nullptr);
  EXPECT_NE(diagnostics.to_string().find("unknown CPU 'nonesuch'"), std::string::npos)
      << diagnostics.to_string();
}

struct Fault {
  const char* name;
  const char* said;
  double seconds = 120;  ///< That the worker has: as many as a busy machine may need.
};

/// What `how` gives while LLVM fails in that way; then another kernel, which is compiled.
void expect_answers(const Fault& fault) {
  const auto one = service(FAULTY_WORKER, {.seconds = fault.seconds, .megabytes = 1024});
  for (int round = 0; round < 2; ++round) {
    Diagnostics diagnostics;
    const auto kernel = one->request(named_program(fault.name), quick(), diagnostics);
    ASSERT_NE(kernel, nullptr) << diagnostics.to_string();
    EXPECT_STREQ(kernel->engine(), "interpreter");
    EXPECT_EQ(run_small(*kernel, 2.0f), 5.0f);
    ASSERT_EQ(diagnostics.all().size(), 1u) << diagnostics.to_string();
    EXPECT_EQ(diagnostics.all().front().code, "compile-failed");
    EXPECT_EQ(diagnostics.all().front().severity, Severity::warning);
    EXPECT_NE(diagnostics.to_string().find(fault.said), std::string::npos)
        << diagnostics.to_string();

    Diagnostics none;
    const auto sound = one->request(named_program("sound", 3.0f), quick(), none);
    ASSERT_NE(sound, nullptr);
    EXPECT_EQ(none.to_string(), "");
    EXPECT_STREQ(sound->engine(), "jit");
    EXPECT_EQ(run_small(*sound, 2.0f), 7.0f);
  }
}

TEST(Worker, FatalErrorsOfLlvmLeaveTheInterpreter) {
  expect_answers({"fatal", "cannot select what was asked for"});
}
TEST(Worker, CrashesLeaveTheInterpreter) {
  // A sanitizer turns the signal into a status.
  expect_answers({"crash", address_sanitizer ? "ended with" : "Segmentation fault"});
}
TEST(Worker, HangsLeaveTheInterpreter) { expect_answers({"hang", "takes too long", 5}); }
TEST(Worker, MemoryThatIsShortLeavesTheInterpreter) {
  expect_answers({"memory", is_sanitized ? "ended" : "ran out of memory"});
}
TEST(Worker, AnswersToSomethingElseAreNotTaken) {
  expect_answers({"another", "to something else"});
}
TEST(Worker, NoProgramLeavesTheInterpreter) {
  const auto one = service("/nonesuch/worker");
  Diagnostics diagnostics;
  const auto kernel = one->request(small_program(1.0f), quick(), diagnostics);
  ASSERT_NE(kernel, nullptr);
  EXPECT_EQ(run_small(*kernel, 2.0f), 5.0f);
  EXPECT_NE(diagnostics.to_string().find("/nonesuch/worker"), std::string::npos);
}
TEST(Worker, AProgramThatIsNoneLeavesTheInterpreter) {
  const auto one = service("/bin/true");
  Diagnostics diagnostics;
  const auto kernel = one->request(small_program(1.0f), quick(), diagnostics);
  ASSERT_NE(kernel, nullptr);
  EXPECT_EQ(run_small(*kernel, 2.0f), 5.0f);
  EXPECT_NE(diagnostics.to_string().find("compile-failed"), std::string::npos);
}

TEST(Worker, AskedAsynchronouslyAKernelStaysInterpreted) {
  const auto one = service(FAULTY_WORKER, {.seconds = 120, .megabytes = 1024});
  const auto kernel = one->request_async(named_program("crash"), quick());
  ASSERT_NE(kernel, nullptr);
  EXPECT_EQ(run_small(*kernel, 2.0f), 5.0f);
  EXPECT_FALSE(kernel->wait());
  EXPECT_EQ(run_small(*kernel, 2.0f), 5.0f);
  EXPECT_NE(kernel->diagnostics().to_string().find("compile-failed"), std::string::npos);
}

/// Waits until `done`, at most some seconds.
template <class F>
void wait_until(F&& done) {
  for (int i = 0; i < 100 && !done(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

TEST(Worker, WhatNobodyWantsIsEnded) {
  const auto one = service(FAULTY_WORKER, {.seconds = 600, .megabytes = 1024});
  const int before = children();
  auto kernel = one->request_async(named_program("hang"), quick());
  wait_until([&] { return children() > before; });
  EXPECT_GT(children(), before);
  kernel.reset();
  wait_until([&] { return children() <= before; });
  EXPECT_LE(children(), before);
}

/// Where everything comes from the cache, or nothing is compiled, none is begun.
TEST(Worker, BeginsWhenThereIsSomethingToCompile) {
  const int before = children();
  const auto one = service(WORKER);
  EXPECT_EQ(children(), before);
  EXPECT_EQ(one->find(small_program(1.0f), "unknown", quick()), nullptr);
  EXPECT_GT(children(), before);
}

TEST(Worker, NoProcessIsLeft) {
  const int before = children();
  {
    const auto one = service(WORKER);
    std::vector<std::shared_ptr<CompiledKernel>> kernels;
    for (int i = 0; i < 8; ++i) {
      kernels.push_back(one->request_async(small_program(static_cast<float>(i)), quick()));
    }
    wait_until([&] { return children() > before; });
    EXPECT_GT(children(), before);
  }
  EXPECT_EQ(children(), before);
}

TEST(Worker, ChildrenOfForkHaveTheirOwn) {
  const auto one = service(WORKER);
  Diagnostics diagnostics;
  ASSERT_NE(one->request(small_program(1.0f), quick(), diagnostics), nullptr);
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);
    Diagnostics said;
    const auto kernel = one->request(small_program(5.0f), quick(), said);
    const bool right = kernel != nullptr && std::string(kernel->engine()) == "jit" &&
                       run_small(*kernel, 2.0f) == 9.0f;
    _exit(right ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  const auto after = one->request(small_program(6.0f), quick(), diagnostics);
  ASSERT_NE(after, nullptr);
  EXPECT_STREQ(after->engine(), "jit");
  EXPECT_EQ(diagnostics.to_string(), "");
}

/// Threads that compile, run and unload, with a fault every now and then.
TEST(Worker, EightThreadsAmongFaults) {
  ServiceOptions options;
  options.threads = 8;
  options.worker = FAULTY_WORKER;
  options.worker_limits = {.seconds = 60, .megabytes = 1024};
  Diagnostics none;
  const auto one = CompileService::create(options, none);
  std::atomic<int> compiled = 0;
  std::atomic<int> interpreted = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([&, t] {
      for (int k = 0; k < 12; ++k) {
        const bool is_faulty = (t + k) % 4 == 0;
        const auto number = static_cast<float>(100 * t + k);
        Diagnostics diagnostics;
        const auto kernel = one->request(
            named_program(is_faulty ? (k % 2 == 0 ? "crash" : "fatal") : "sound", number), quick(),
            diagnostics);
        ASSERT_NE(kernel, nullptr) << diagnostics.to_string();
        EXPECT_EQ(run_small(*kernel, 1.0f), 2.0f + number);
        EXPECT_EQ(std::string(kernel->engine()), is_faulty ? "interpreter" : "jit");
        ++(is_faulty ? interpreted : compiled);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(compiled, 72);
  EXPECT_EQ(interpreted, 24);
  EXPECT_LE(children(), 8);
}

/// A host that waits for any child takes the end of ours.
TEST(Worker, HostsMayTakeTheEndsOfChildren) {
  const auto one = service(FAULTY_WORKER, {.seconds = 5, .megabytes = 1024});
  std::signal(SIGCHLD, SIG_IGN);
  Diagnostics diagnostics;
  const auto kernel = one->request(named_program("crash"), quick(), diagnostics);
  std::signal(SIGCHLD, SIG_DFL);
  ASSERT_NE(kernel, nullptr);
  EXPECT_EQ(run_small(*kernel, 2.0f), 5.0f);
  EXPECT_NE(diagnostics.to_string().find("compile-failed"), std::string::npos);
}

}  // namespace
}  // namespace nacre
