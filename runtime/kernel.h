#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "runtime/program/program.h"

namespace nacre {

/// A texture as a kernel sees it: one array of 32-bit words laid out as
/// runtime/texture/layout.h says.
struct TextureBinding {
  const std::uint32_t* words = nullptr;  ///< On a boundary of 64 bytes.
  std::uint64_t count = 0;               ///< Words; a fetch beyond them reads word 0.
};

/// Look-ups that a kernel leaves to the host: textures too large to be
/// resident. Arrays hold `lanes` floats; rgba holds 4 * lanes, r of all lanes first.
struct TextureCall {
  std::uint32_t slot;   ///< Index in Program::textures.
  std::uint32_t modes;  ///< As Op::texture_call's imm.
  std::uint32_t lanes;  ///< Points of the call.
  /// Coordinates as the node has them, before the address mode.
  /// @{
  const float* u;
  const float* v;
  /// @}
  /// How they change along the axes x and y of the footprint.
  /// @{
  const float* dudx;
  const float* dvdx;
  const float* dudy;
  const float* dvdy;
  /// @}
  /// The largest allowed, at least 1; null: that of the modes everywhere.
  const std::int32_t* max_anisotropy;
  float* rgba;  ///< To be filled in; 0 before.
};
/// Answers a call; may be called by all threads that run kernels. `user` is
/// KernelArguments::texture_user.
using TextureCallback = void (*)(void* user, const TextureCall* call);

/// What a kernel reads and writes: plain C layout, all memory the host's.
/// Element i of every array belongs to point i; elements are four bytes (float,
/// int32; booleans as int32 0 or 1). Arrays need only their natural alignment.
/// Inputs and outputs must not overlap.
struct KernelArguments {
  const void* const* inputs = nullptr;        ///< One array a Program::inputs entry.
  void* const* outputs = nullptr;             ///< One array a Program::outputs entry.
  const std::uint32_t* parameters = nullptr;  ///< One slot a Program::parameters entry.
  /// 16 numbers a row of Program::fitted_rows, on a boundary of 64 bytes. Null: nothing was fitted,
  /// and all is computed.
  const float* fitted = nullptr;
  const TextureBinding* textures = nullptr;    ///< One a Program::textures entry.
  TextureCallback texture_callback = nullptr;  ///< Null: such look-ups give 0.
  void* texture_user = nullptr;                ///< Handed to it as it is.
  std::uint64_t count = 0;                     ///< Points.
  /// Not 0: end soon. Looked at between passes, and after each round of loops that are
  /// counted, so within a few milliseconds. Must not go back to 0 during a run. Null: never.
  const std::atomic<std::uint32_t>* stop = nullptr;
};

/// How a run ended. After all but `done` the outputs hold anything.
enum class RunStatus : std::uint8_t {
  done,
  stopped,  ///< KernelArguments::stop was not 0.
  /// A pass took more steps than the kernel may (runtime/program/cost.h), or a loop that
  /// must end by itself did not within its rounds.
  too_many_steps,
  /// Not as many arrays as the Program has channels, or slots as it has parameters: nothing
  /// was run.
  wrong_arguments,
};

/// Compiled or interpreted code for one Program. Immutable and re-entrant: any
/// number of threads may run one kernel at once.
class Kernel {
 public:
  virtual ~Kernel() = default;
  /// Computes every output for points 0 ... count - 1. Touches no floating-point
  /// state of the caller's; never throws, never blocks, ends whatever the Program says.
  /// What counts against the limit of steps is a pass of lanes() points as a whole: its
  /// loops go on until the last point is done.
  virtual RunStatus run(const KernelArguments& arguments) const = 0;
  /// What to bind: its channel, slot and texture lists. Their order is that of
  /// the arrays in KernelArguments.
  virtual const Program& program() const = 0;
  /// Points one pass of the code works on: 1, 4, 8, 16; the interpreter's block.
  virtual int lanes() const = 0;
  /// "jit", "interpreter" or "reference".
  virtual const char* engine() const = 0;
};

}  // namespace nacre
