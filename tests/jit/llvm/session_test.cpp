// Loading and unloading: no leak, no page both writable and executable, errors
// as diagnostics.

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/jit/llvm/engine.h"
#include "tests/support/sanitizer.h"
#include "tests/support/small_program.h"

namespace nacre {
namespace {

CodegenOptions quick() {
  CodegenOptions options;
  options.tier = Tier::quick;
  options.lanes = 4;
  return options;
}

/// Bytes of memory in use by this process.
std::size_t resident() {
  std::size_t size = 0;
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> size >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// Mappings that are writable and executable at once.
std::vector<std::string> writable_code() {
  std::vector<std::string> found;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    if (line.find(" rwx") != std::string::npos) found.push_back(line);
  }
  return found;
}

std::size_t mappings() {
  std::size_t count = 0;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) ++count;
  return count;
}

TEST(Session, UnloadedCodeLeavesNothing) {
  const int cycles = std::getenv("NACRE_TEST_FULL") != nullptr ? 10000 : 1000;
  const auto cycle = [](int k) {
    const auto kernel = compiled(small_program(static_cast<float>(k)), quick());
    ASSERT_NE(kernel, nullptr);
    ASSERT_EQ(run_small(*kernel, 3.0f), 6.0f + static_cast<float>(k));
  };
  for (int k = 0; k < cycles / 5; ++k) cycle(k);
  const std::size_t before = resident();
  const std::size_t mapped = mappings();
  for (int k = 0; k < cycles; ++k) cycle(k);
  if (address_sanitizer) return;
  EXPECT_LT(static_cast<double>(resident()), 1.01 * static_cast<double>(before));
  EXPECT_LE(mappings(), mapped + 4);
}

/// Linux allows a process 65,530 mappings.
TEST(Session, ThousandsOfKernelsAreAFewMappings) {
  const std::size_t count = std::getenv("NACRE_TEST_FULL") != nullptr ? 100000 : 3000;
  Diagnostics diagnostics;
  const auto own = JitSession::create({}, diagnostics);
  const Program program = small_program(1.0f);
  const auto object = compile_object(program, quick(), diagnostics);
  ASSERT_TRUE(object.has_value());
  const std::size_t before = mappings();
  std::vector<std::shared_ptr<const LoadedCode>> kernels(count);
  for (auto& kernel : kernels) {
    kernel = own->load(*object, diagnostics);
    ASSERT_NE(kernel, nullptr) << diagnostics.to_string();
  }
  // Two for a slab of some 1,000 kernels, and what the heap may want; a sanitizer's, which
  // keeps what was freed, wants more.
  const std::size_t heap = is_sanitized ? 64 : 8;
  const std::size_t most = before + 4 * (count / 1000) + heap;
  EXPECT_LE(mappings(), most);
  // Nor do holes become mappings.
  for (std::size_t k = 0; k < count; k += 2) kernels[k] = nullptr;
  EXPECT_LE(mappings(), most);
  for (std::size_t k = 0; k < count; k += 2) kernels[k] = own->load(*object, diagnostics);
  EXPECT_LE(mappings(), most);
  for (const std::size_t k : {std::size_t{0}, count / 2, count - 1}) {
    ASSERT_NE(kernels[k], nullptr) << diagnostics.to_string();
    EXPECT_EQ(run_small(*make_jit_kernel(program, kernels[k], quick().lanes), 1.0f), 3.0f);
  }
  EXPECT_TRUE(writable_code().empty());
  kernels.clear();
  EXPECT_LE(mappings(), before + heap);
}

TEST(Session, NoPageIsWritableAndExecutable) {
  std::atomic<bool> done = false;
  std::atomic<int> seen = 0;
  std::thread watcher([&] {
    while (!done) seen += static_cast<int>(writable_code().size());
  });
  std::vector<std::thread> workers;
  for (int t = 0; t < 3; ++t) {
    workers.emplace_back([t] {
      std::vector<std::shared_ptr<const Kernel>> held;
      for (int k = 0; k < 40; ++k) {
        const float number = static_cast<float>(1000 * t + k);
        held.push_back(compiled(small_program(number), quick()));
        ASSERT_EQ(run_small(*held.back(), 1.0f), 2.0f + number);
        if (held.size() > 10) held.erase(held.begin());
      }
    });
  }
  for (std::thread& worker : workers) worker.join();
  done = true;
  watcher.join();
  EXPECT_EQ(seen, 0);
}

TEST(Session, CodeOutlivesItsSession) {
  Diagnostics diagnostics;
  auto own = JitSession::create({}, diagnostics);
  const Program program = small_program(5.0f);
  const auto object = compile_object(program, quick(), diagnostics);
  ASSERT_TRUE(object.has_value());
  const auto kernel = make_jit_kernel(program, own->load(*object, diagnostics), quick().lanes);
  own.reset();
  EXPECT_EQ(run_small(*kernel, 1.0f), 7.0f);
}

TEST(Session, PerfGetsADumpFile) {
  namespace fs = std::filesystem;
  std::string folder = (fs::temp_directory_path() / "nacre-perf-XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  setenv("JITDUMPDIR", folder.c_str(), 1);
  {
    Diagnostics diagnostics;
    SessionOptions options;
    options.perf = true;
    const auto own = JitSession::create(options, diagnostics);
    ASSERT_NE(own, nullptr) << diagnostics.to_string();
    const Program program = small_program(1.0f);
    const auto code = own->load(*compile_object(program, quick(), diagnostics), diagnostics);
    ASSERT_NE(code, nullptr) << diagnostics.to_string();
    EXPECT_EQ(run_small(*make_jit_kernel(program, code, quick().lanes), 1.0f), 3.0f);
  }
  std::string dump;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    dump.assign(std::istreambuf_iterator<char>(stream), {});
  }
  EXPECT_EQ(dump.substr(0, 4), "DTiJ");  // The magic of a jitdump file, little-endian.
  EXPECT_NE(dump.find("_small_w4"), std::string::npos);
  fs::remove_all(folder);
}

TEST(Session, DebuggerKnowsTheCode) {
  Diagnostics diagnostics;
  SessionOptions options;
  options.debugger = true;
  const auto own = JitSession::create(options, diagnostics);
  ASSERT_NE(own, nullptr) << diagnostics.to_string();
  const Program program = small_program(1.0f);
  const auto code = own->load(*compile_object(program, quick(), diagnostics), diagnostics);
  ASSERT_NE(code, nullptr) << diagnostics.to_string();
  // The list that GDB walks ("JIT Compilation Interface" in its manual).
  struct Entry {
    Entry* next;
    Entry* previous;
    const char* file;
    std::uint64_t size;
  };
  struct Descriptor {
    std::uint32_t version;
    std::uint32_t action;
    Entry* relevant;
    Entry* first;
  };
  const auto* list = static_cast<const Descriptor*>(dlsym(RTLD_DEFAULT, "__jit_debug_descriptor"));
  ASSERT_NE(list, nullptr);
  ASSERT_NE(list->first, nullptr);
  const std::string object(list->first->file, list->first->size);
  EXPECT_NE(object.find("_small_w4"), std::string::npos);
}

TEST(Session, SameObjectLoadsTwice) {
  Diagnostics diagnostics;
  const Program program = small_program(6.0f);
  const auto object = compile_object(program, quick(), diagnostics);
  const auto first = session()->load(*object, diagnostics);
  const auto second = session()->load(*object, diagnostics);
  ASSERT_NE(first, nullptr);
  ASSERT_NE(second, nullptr);
  EXPECT_NE(first->entry(), second->entry());
}

TEST(Session, UnsoundObjectIsADiagnostic) {
  Diagnostics diagnostics;
  const auto object = compile_object(small_program(7.0f), quick(), diagnostics);
  ASSERT_TRUE(object.has_value());
  ObjectCode cut = *object;
  cut.bytes.resize(cut.bytes.size() / 2);
  EXPECT_EQ(session()->load(cut, diagnostics), nullptr);
  EXPECT_EQ(diagnostics.error_count(), 1u);
  ObjectCode other = *object;
  other.symbol = "no_such_entry";
  EXPECT_EQ(session()->load(other, diagnostics), nullptr);
  EXPECT_EQ(diagnostics.error_count(), 2u);
  EXPECT_EQ(diagnostics.all().back().code, "link");
  EXPECT_NE(session()->load(*object, diagnostics), nullptr);
}

TEST(Codegen, UnknownCpuIsADiagnostic) {
  Diagnostics diagnostics;
  CodegenOptions options = quick();
  options.target = Target::named("no-such-cpu");
  EXPECT_FALSE(compile_object(small_program(1.0f), options, diagnostics).has_value());
  ASSERT_EQ(diagnostics.error_count(), 1u);
  EXPECT_EQ(diagnostics.all().front().code, "codegen");
}

TEST(Codegen, LanesThatThereAreNotAreADiagnostic) {
  for (const int lanes : {0, 2, 3, 32, -1}) {
    Diagnostics diagnostics;
    CodegenOptions options = quick();
    options.lanes = lanes;
    EXPECT_FALSE(compile_object(small_program(1.0f), options, diagnostics).has_value());
    EXPECT_EQ(dump_ir(small_program(1.0f), options, diagnostics), "");
    EXPECT_EQ(dump_assembly(small_program(1.0f), options, diagnostics), "");
    EXPECT_EQ(diagnostics.error_count(), 3u) << lanes;
  }
}

TEST(Codegen, ObjectHoldsNoAddresses) {
  // The same Program compiled twice, with other things in memory meanwhile.
  Diagnostics diagnostics;
  const auto first = compile_object(small_program(2.0f), quick(), diagnostics);
  const auto kept = compiled(small_program(3.0f), quick());
  const auto second = compile_object(small_program(2.0f), quick(), diagnostics);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->bytes, second->bytes);
}

TEST(Codegen, DumpsNameTheEntry) {
  Diagnostics diagnostics;
  const Program program = small_program(2.0f);
  const std::string symbol = entry_symbol(program, quick());
  EXPECT_TRUE(symbol.starts_with("nacre_"));
  EXPECT_TRUE(symbol.ends_with("_small_w4"));
  EXPECT_NE(dump_ir(program, quick(), diagnostics).find("define void @" + symbol),
            std::string::npos);
  EXPECT_NE(dump_assembly(program, quick(), diagnostics).find(symbol + ":"), std::string::npos);
}

TEST(Codegen, OnlyFastGivesLlvmFreedomAndNeverOverNan) {
  Diagnostics diagnostics;
  CodegenOptions options = quick();
  const Program program = small_program(2.0f);
  for (const Accuracy accuracy : {Accuracy::precise, Accuracy::standard, Accuracy::fast}) {
    options.accuracy = accuracy;
    const std::string ir = dump_ir(program, options, diagnostics);
    const bool is_fast = accuracy == Accuracy::fast;
    EXPECT_EQ(ir.find("fmul reassoc nsz arcp contract <4 x float>") != std::string::npos, is_fast);
    EXPECT_EQ(ir.find("contract") != std::string::npos, is_fast);
    for (const char* never : {" fast ", "nnan", "ninf", "afn"}) {
      EXPECT_EQ(ir.find(never), std::string::npos) << never;
    }
  }
}

TEST(Codegen, KeyTellsWhatChangesTheCode) {
  CodegenOptions options = quick();
  Program program = small_program(2.0f);
  const std::string key = code_key(program, options);
  EXPECT_EQ(key, code_key(small_program(2.0f), options));
  EXPECT_NE(key, code_key(small_program(2.5f), options));
  options.lanes = 8;
  EXPECT_NE(key, code_key(program, options));
  options = quick();
  options.accuracy = Accuracy::fast;
  EXPECT_NE(key, code_key(program, options));
  options = quick();
  options.target = Target::named("x86-64-v3");
  EXPECT_NE(key, code_key(program, options));
  mark_varying(program, true);
  EXPECT_NE(key, code_key(program, quick()));
}

}  // namespace
}  // namespace nacre
