#include <gtest/gtest.h>
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/program/fold.h"
#include "runtime/program/slice.h"
#include "runtime/value/value.h"
#include "tests/jit/llvm/engine.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

/// No two entries alike, nor any two bytes of the words in one place; one of them a denormal.
std::vector<float> entries(int count) {
  std::vector<float> table;
  for (int i = 0; i < count; ++i) {
    const auto n = static_cast<std::uint32_t>(i);
    table.push_back(std::bit_cast<float>(0x3f800000u + n * 0x00010107u));
  }
  table[table.size() / 2] = std::bit_cast<float>(0x80000123u);
  return table;
}

/// Entry `index`, and entry `index & mask`.
Program look_up(const std::vector<float>& table, std::int32_t mask) {
  Recorder recorder;
  const Int index(recorder.input("index", Scalar::i32));
  const auto entry = [&](Int at) {
    const Ref ref = at.ref();
    return recorder.emit(Op::table, std::span(&ref, 1), recorder.table("table", table));
  };
  const std::vector<SliceOutput> outputs{{"clamped", entry(index)},
                                         {"masked", entry(index & Int(mask))}};
  return slice(recorder.program(), "look_up", outputs);
}

/// check(kernel, what) of a Program as code of all widths for all kinds of CPUs that this one is.
template <class Check>
void on_every_cpu(const Program& program, Check&& check) {
  for (const int lanes : {1, 4, 8, 16}) {
    // Of the last two LLVM says that gathers are slow, and that they are quick.
    for (const char* cpu :
         {"", "x86-64", "nehalem", "sandybridge", "haswell", "znver4", "sapphirerapids"}) {
      const Target target = *cpu == '\0' ? Target::host() : Target::named(cpu);
      if (widest_lanes(target) > widest_lanes(Target::host())) continue;
      if (std::string_view(cpu) == "haswell" && __builtin_cpu_supports("avx2") == 0) continue;
      const auto kernel = compiled(program, {.lanes = lanes, .target = target});
      ASSERT_NE(kernel, nullptr);
      check(*kernel, "W = " + std::to_string(lanes) + ", " + cpu);
    }
  }
}

// A table is permuted in registers, whole or by bytes, or loaded from memory, by CPU and size.
TEST(LookUp, GivesTheEntryOnEveryCpu) {
  // As floats that are whole: run() makes integers of them.
  Columns in{{"index", {0.0f, -1.0f, -0x1p31f, 0x1.fffffep30f}}};
  for (int i = 1; i < 300; ++i) {
    in["index"].push_back(static_cast<float>(i % 3 == 0 ? -i * 4097 : i));
  }
  std::vector<std::int32_t> indices;
  for (const float x : in["index"]) indices.push_back(static_cast<std::int32_t>(x));
  for (const int count : {1, 3, 8, 9, 16, 17, 32, 33, 64, 65, 200}) {
    const std::vector<float> table = entries(count);
    for (const std::int32_t mask : {count - 1, 5, 7, 255}) {
      on_every_cpu(look_up(table, mask), [&](const Kernel& kernel, const std::string& what) {
        const Columns out = run(kernel, in);
        const auto expected = [&](std::int32_t index) {
          const auto at = static_cast<std::size_t>(std::clamp(index, 0, count - 1));
          return flush_denormal(std::bit_cast<std::uint32_t>(table[at]));
        };
        for (std::size_t i = 0; i < indices.size(); ++i) {
          ASSERT_EQ(std::bit_cast<std::uint32_t>(out.at("clamped")[i]), expected(indices[i]))
              << count << " entries, " << what << ", " << indices[i];
          ASSERT_EQ(std::bit_cast<std::uint32_t>(out.at("masked")[i]), expected(indices[i] & mask))
              << count << " entries, & " << mask << ", " << what << ", " << indices[i];
        }
      });
    }
  }
}

// What was fitted is a row of sixteen, of which the index's low bits tell which.
TEST(LookUp, GivesTheFittedNumberOnEveryCpu) {
  constexpr std::uint32_t rows = 6, row = 4;
  Program interface;
  interface.fitted_rows = rows;
  Recorder recorder;
  recorder.adopt_interface(interface);
  const Ref index = recorder.input("index", Scalar::i32);
  const Ref third = Ref::literal(3);
  const std::vector<SliceOutput> outputs{
      {"varying", recorder.emit(Op::fitted, std::span(&index, 1), row)},
      {"uniform", recorder.emit(Op::fitted, std::span(&third, 1), row + 1)}};
  const Program program = slice(recorder.program(), "fitted", outputs);
  struct alignas(64) {
    std::array<float, rows * Fit::cells> numbers;
  } fitted;
  for (std::size_t i = 0; i < fitted.numbers.size(); ++i) {
    fitted.numbers[i] = 1.0f / (static_cast<float>(i) + 3.0f);
  }
  std::vector<std::int32_t> indices;
  for (std::int32_t i = 0; i < 50; ++i) indices.push_back(i % 3 == 0 ? -i * 4097 : i);
  on_every_cpu(program, [&](const Kernel& kernel, const std::string& what) {
    std::vector<float> varying(indices.size()), uniform(indices.size());
    const void* const input = indices.data();
    const std::array<void*, 2> columns{varying.data(), uniform.data()};
    KernelArguments arguments;
    arguments.inputs = &input;
    arguments.outputs = columns.data();
    arguments.fitted = fitted.numbers.data();
    arguments.count = indices.size();
    ASSERT_EQ(kernel.run(arguments), RunStatus::done);
    for (std::size_t i = 0; i < indices.size(); ++i) {
      const auto at = static_cast<std::size_t>(indices[i] & 15);
      ASSERT_EQ(varying[i], fitted.numbers[row * Fit::cells + at]) << what << ", " << indices[i];
      ASSERT_EQ(uniform[i], fitted.numbers[(row + 1) * Fit::cells + 3]) << what;
    }
  });
}

/// As many words as numbers of 31 bits reach, and some more, of which few are there.
class ManyWords {
 public:
  static constexpr std::uint64_t count = (std::uint64_t{1} << 31) + 1000;

  ManyWords()
      : words_(static_cast<std::uint32_t*>(
            mmap(nullptr, count * sizeof(std::uint32_t), PROT_READ | PROT_WRITE,
                 MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0))) {}
  ~ManyWords() { munmap(words_, count * sizeof(std::uint32_t)); }
  ManyWords(const ManyWords&) = delete;
  ManyWords& operator=(const ManyWords&) = delete;

  bool are_there() const { return words_ != MAP_FAILED; }
  std::uint32_t& operator[](std::uint32_t k) { return words_[k]; }
  TextureBinding binding() const { return {words_, count}; }

 private:
  std::uint32_t* words_;
};

// Numbers of words are unsigned, whatever the CPU's gathers take; two and four that lie next to
// each other are read together.
TEST(LookUp, GivesTheWordOnEveryCpu) {
  ManyWords words;
  if (!words.are_there()) GTEST_SKIP() << "the system has no addresses for 8 GiB";
  std::vector<std::uint32_t> numbers;
  for (const std::uint64_t around : {std::uint64_t{0}, std::uint64_t{1} << 31, words.count}) {
    for (std::uint64_t k = around < 20 ? 0 : around - 20; k < around + 20; ++k) {
      numbers.push_back(static_cast<std::uint32_t>(k));
      if (k < words.count) words[static_cast<std::uint32_t>(k)] = static_cast<std::uint32_t>(7 * k);
    }
  }
  numbers.push_back(~0u);
  words[0] = 12345;
  for (const std::uint32_t together : {1u, 2u, 4u}) {
    Recorder recorder;
    recorder.texture("words");
    const Ref first = recorder.input("word", Scalar::i32);
    std::vector<SliceOutput> outputs;
    for (std::uint32_t w = 0; w < together; ++w) {
      const std::array operands{first, Ref::literal(static_cast<std::int32_t>(w))};
      const std::array at{Ref::literal(0), recorder.emit(Op::iadd, operands)};
      outputs.push_back({std::to_string(w), recorder.emit(Op::texel, at)});
    }
    on_every_cpu(slice(recorder.program(), "words", outputs),
                 [&](const Kernel& kernel, const std::string& what) {
                   std::array<std::vector<std::uint32_t>, 4> results;
                   std::array<void*, 4> columns{};
                   for (std::uint32_t w = 0; w < together; ++w) {
                     results[w].resize(numbers.size());
                     columns[w] = results[w].data();
                   }
                   const void* const input = numbers.data();
                   const TextureBinding binding = words.binding();
                   KernelArguments arguments;
                   arguments.inputs = &input;
                   arguments.outputs = columns.data();
                   arguments.textures = &binding;
                   arguments.count = numbers.size();
                   ASSERT_EQ(kernel.run(arguments), RunStatus::done);
                   for (std::size_t i = 0; i < numbers.size(); ++i) {
                     for (std::uint32_t w = 0; w < together; ++w) {
                       const std::uint32_t number = numbers[i] + w;
                       ASSERT_EQ(results[w][i], words[number < words.count ? number : 0])
                           << numbers[i] << " + " << w << ", " << what;
                     }
                   }
                 });
  }
}

}  // namespace
}  // namespace nacre
