#include "jit/llvm/run_code.h"

#include <array>
#include <cstring>
#include <memory>

#include "runtime/float_environment.h"

namespace nacre {

namespace {

/// Copies of a batch's channels, a row of `lanes` words each, inputs first.
struct Copies {
  std::uint32_t* words;
  void** rows;
};

void run_tail(LoadedCode::Entry entry, const Program& program, std::size_t lanes,
              const KernelArguments& arguments, std::uint64_t first, Copies copies) {
  const std::size_t inputs = program.inputs.size();
  const std::size_t outputs = program.outputs.size();
  const std::size_t bytes = 4 * static_cast<std::size_t>(arguments.count - first);
  std::memset(copies.words, 0, 4 * inputs * lanes);
  for (std::size_t k = 0; k < inputs + outputs; ++k) copies.rows[k] = copies.words + k * lanes;
  for (std::size_t k = 0; k < inputs; ++k) {
    std::memcpy(copies.rows[k], static_cast<const char*>(arguments.inputs[k]) + 4 * first, bytes);
  }
  KernelArguments whole = arguments;
  whole.inputs = copies.rows;
  whole.outputs = copies.rows + inputs;
  whole.count = lanes;
  entry(&whole);
  for (std::size_t k = 0; k < outputs; ++k) {
    std::memcpy(static_cast<char*>(arguments.outputs[k]) + 4 * first, copies.rows[inputs + k],
                bytes);
  }
}

}  // namespace

void run_code(LoadedCode::Entry entry, const Program& program, int lanes,
              const KernelArguments& arguments) {
  const ScopedFloatEnvironment environment;
  const auto width = static_cast<std::size_t>(lanes);
  KernelArguments whole = arguments;
  whole.count -= whole.count % width;
  if (whole.count != 0) entry(&whole);
  if (whole.count == arguments.count) return;

  // Enough for 256 channels of 16 lanes; what needs more pays for memory.
  constexpr std::size_t usual = 256;
  const std::size_t channels = program.inputs.size() + program.outputs.size();
  if (channels <= usual) {
    std::array<std::uint32_t, usual * 16> words;
    std::array<void*, usual> rows;
    run_tail(entry, program, width, arguments, whole.count, {words.data(), rows.data()});
  } else {
    const auto words = std::make_unique_for_overwrite<std::uint32_t[]>(channels * width);
    const auto rows = std::make_unique_for_overwrite<void*[]>(channels);
    run_tail(entry, program, width, arguments, whole.count, {words.get(), rows.get()});
  }
}

}  // namespace nacre
