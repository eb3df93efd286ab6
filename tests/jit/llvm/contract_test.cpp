// What runtime/kernel.h promises to a host: nothing beyond the arrays is touched,
// and its floating-point environment stays as it was.

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>
#include <xmmintrin.h>

#include <bit>
#include <cstring>
#include <vector>

#include "tests/jit/llvm/engine.h"
#include "tests/support/small_program.h"

namespace nacre {
namespace {

/// Memory of one page between two that can't be touched.
class Guarded {
 public:
  Guarded() : page_(static_cast<std::size_t>(sysconf(_SC_PAGESIZE))) {
    void* all = mmap(nullptr, 3 * page_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    base_ = static_cast<char*>(all);
    mprotect(base_ + page_, page_, PROT_READ | PROT_WRITE);
  }
  ~Guarded() { munmap(base_, 3 * page_); }
  Guarded(const Guarded&) = delete;
  Guarded& operator=(const Guarded&) = delete;

  /// `count` floats that begin, or end, where the memory does.
  float* at_start() { return reinterpret_cast<float*>(base_ + page_); }
  float* at_end(std::size_t count) { return reinterpret_cast<float*>(base_ + 2 * page_) - count; }

 private:
  std::size_t page_;
  char* base_;
};

CodegenOptions of_lanes(int lanes) {
  CodegenOptions options;
  options.lanes = lanes;
  return options;
}

TEST(Contract, TouchesNothingBeyondTheArrays) {
  const std::uint32_t slope = 0x40000000u;
  for (const int lanes : {1, 4, 8, 16}) {
    const auto kernel = compiled(small_program(1.0f), of_lanes(lanes));
    Guarded in;
    Guarded out;
    for (std::size_t count = 1; count <= 3 * static_cast<std::size_t>(lanes) + 1; ++count) {
      for (const bool end : {false, true}) {
        float* x = end ? in.at_end(count) : in.at_start();
        float* y = end ? out.at_end(count) : out.at_start();
        for (std::size_t k = 0; k < count; ++k) x[k] = static_cast<float>(k);
        const void* inputs[]{x};
        void* outputs[]{y};
        kernel->run({.inputs = inputs,
                     .outputs = outputs,
                     .parameters = &slope,
                     .textures = nullptr,
                     .texture_callback = nullptr,
                     .texture_user = nullptr,
                     .count = count});
        for (std::size_t k = 0; k < count; ++k) {
          ASSERT_EQ(y[k], 2.0f * static_cast<float>(k) + 1.0f) << lanes << " " << count;
        }
      }
    }
  }
}

TEST(Contract, NoPointsTouchNothing) {
  const auto kernel = compiled(small_program(1.0f), of_lanes(16));
  const std::uint32_t slope = 0;
  KernelArguments arguments;
  arguments.parameters = &slope;
  kernel->run(arguments);
}

TEST(Contract, HostsFloatEnvironmentNeitherMattersNorChanges) {
  Recorder recorder;
  const Float x(recorder.input("x", Scalar::f32));
  // Rounding, a denormal, a division by zero and an invalid operation.
  const std::vector<SliceOutput> outputs{{"third", (x / Float(3.0f)).ref()},
                                         {"tiny", (x * Float(0x1p-140f)).ref()},
                                         {"infinite", (x / (x - x)).ref()},
                                         {"root", sqrt(Float(0.0f) - x).ref()}};
  const Program program = slice(recorder.program(), "test", outputs);
  const auto kernel = compiled(program, of_lanes(8));
  const std::vector<float> ones(11, 1.0f);
  const std::uint32_t before = _mm_getcsr();
  for (const std::uint32_t rounding : {0x0000u, 0x2000u, 0x4000u, 0x6000u}) {
    for (const std::uint32_t mode : {0x1f80u, 0x9fc0u, 0x0000u}) {  // 0: every exception traps.
      std::vector<std::vector<float>> results(4, std::vector<float>(11));
      const void* inputs[]{ones.data()};
      void* outs[]{results[0].data(), results[1].data(), results[2].data(), results[3].data()};
      KernelArguments arguments;
      arguments.inputs = inputs;
      arguments.outputs = outs;
      arguments.count = 11;
      _mm_setcsr(rounding | mode);
      kernel->run(arguments);
      const std::uint32_t after = _mm_getcsr();
      _mm_setcsr(before);
      EXPECT_EQ(after, rounding | mode);
      for (int k = 0; k < 11; ++k) {
        EXPECT_EQ(std::bit_cast<std::uint32_t>(results[0][k]), 0x3eaaaaabu);
        EXPECT_EQ(std::bit_cast<std::uint32_t>(results[1][k]), 0u);
        EXPECT_EQ(std::bit_cast<std::uint32_t>(results[2][k]), 0x7f800000u);
        EXPECT_EQ(std::bit_cast<std::uint32_t>(results[3][k]), 0x7fc00000u);
      }
    }
  }
}

}  // namespace
}  // namespace nacre
