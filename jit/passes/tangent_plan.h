#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string_view>
#include <tuple>
#include <vector>

#include "runtime/program/program.h"

namespace nacre {

/// What is known of a value's tangent, a set of:
using TangentBits = std::uint8_t;
inline constexpr TangentBits tangent_x = 1;      ///< May be non-zero along the footprint's x.
inline constexpr TangentBits tangent_y = 2;      ///< Likewise along y.
inline constexpr TangentBits tangent_later = 4;  ///< Depends on the tangent of a ddx.
inline constexpr TangentBits tangent_axes = tangent_x | tangent_y;
inline TangentBits axis_bit(std::uint32_t axis) { return axis == 0 ? tangent_x : tangent_y; }

/// Which tangents one variant of a function computes. A variant is chosen by
/// the tangents its arguments can have and the results whose tangents are wanted.
struct TangentPlan {
  std::uint32_t function = 0;
  std::vector<TangentBits> active;            ///< By value: what it can have.
  std::vector<TangentBits> needed;            ///< By value: axes to compute.
  std::vector<const TangentPlan*> callee;     ///< By value: of a call.
  std::vector<TangentBits> arguments_needed;  ///< Tangent arguments the variant takes.
  std::vector<TangentBits> results_needed;    ///< Tangent results it returns.

  /// A ddx that can be replaced now: no tangent of another ddx is in its way.
  bool is_ready(const Function& body, ValueId ddx) const {
    return (active[body.code[ddx].operands[0]] & tangent_later) == 0;
  }
};

/// Which operands a value's tangent comes from by its operation's rule: at the
/// index of the operand (of TangentStep::x), or no_value. For from_bits, index
/// 0 is the float whose bits it is with at most the sign changed.
std::array<ValueId, 3> tangent_operands(const Function& function, ValueId id);

/// Makes plans: activity flows forward from the inputs, need backward from the
/// ddx operations; both to a fixed point around loops.
class TangentPlanner {
 public:
  /// `force`: every ddx is ready, and its own tangent is taken to be 0.
  TangentPlanner(const Program& program, std::span<const std::string_view> more, bool force);

  const TangentPlan& entry();

 private:
  using Bits = std::vector<TangentBits>;
  struct Activity {
    Bits values;
    Bits results;
  };

  const Activity& activity(std::uint32_t function, const Bits& arguments);
  bool flow_forward(const Function& function, const Bits& arguments, Activity& found);
  TangentBits bits_of(const Function& function, ValueId id, const Bits& arguments,
                      const Activity& found);
  TangentBits call_result_bits(const Function& function, ValueId id, const Activity& found);

  const TangentPlan& plan(std::uint32_t function, const Bits& arguments, const Bits& results);
  void flow_backward(TangentPlan& plan);
  bool sweep_backward(TangentPlan& plan);
  bool need(TangentPlan& plan, ValueId id, TangentBits bits) const;
  bool need_call(TangentPlan& plan, ValueId id);
  Bits argument_bits(const Function& function, ValueId call, const Bits& active) const;

  const Program& program_;
  std::span<const std::string_view> more_;
  bool force_;
  std::vector<bool> has_ddx_;  ///< By function: in it or what it calls.
  std::map<std::pair<std::uint32_t, Bits>, std::unique_ptr<Activity>> activities_;
  std::map<std::tuple<std::uint32_t, Bits, Bits>, std::unique_ptr<TangentPlan>> plans_;
};

}  // namespace nacre
