#include "jit/passes/scale_footprints.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/channel/channel_name.h"

namespace nacre {

namespace {

constexpr std::string_view scale_name = "footprint_scale";

bool has_channel(const Program& program) {
  return std::ranges::find(program.inputs, scale_name, &Channel::name) != program.inputs.end();
}

void add_scale(Program& program, bool varying) {
  const std::string name(scale_name);
  if (varying) {
    program.inputs.push_back({name, Scalar::f32});
  } else {
    program.parameters.push_back({name, Scalar::f32, std::bit_cast<std::uint32_t>(1.0f)});
  }
}

bool is_change(const Channel& channel) {
  return parse_derivative(parse_channel(channel.name).group).has_value();
}

/// Records the entry of a Program again, with products behind some of its inputs.
class Scaler {
 public:
  explicit Scaler(const Program& program) : program_(program), made_(program) {
    made_.entry().code.clear();
  }

  Program run() {
    const ValueId scale = clamped_scale();
    const Function& entry = program_.entry();
    Function& made = made_.entry();
    std::vector<ValueId> places;  // New values by old ones.
    const auto moved = [&](ValueId id) { return id == no_value ? id : places[id]; };
    for (Instruction instruction : entry.code) {
      if (instruction.op == Op::call || instruction.op == Op::texture_call) {
        const std::size_t first = instruction.operands[0];
        for (std::size_t k = first; k < first + instruction.operands[1]; ++k) {
          made.pool[k] = moved(entry.pool[k]);
        }
      } else {
        std::ranges::transform(instruction.operands, instruction.operands.begin(), moved);
      }
      ValueId id = add(instruction);
      const bool is_scaled =
          instruction.op == Op::input && is_change(program_.inputs[instruction.imm]);
      if (is_scaled) id = add(operation(Op::mul, id, scale));
      places.push_back(id);
    }
    mark_varying(made_);
    assert(verify(made_).empty());
    return std::move(made_);
  }

 private:
  ValueId add(const Instruction& instruction) {
    made_.entry().code.push_back(instruction);
    return static_cast<ValueId>(made_.entry().code.size() - 1);
  }

  static Instruction operation(Op op, ValueId a, ValueId b) {
    Instruction made = bare_instruction(op, Scalar::f32, 0);
    made.count = 2;
    made.operands[0] = a;
    made.operands[1] = b;
    return made;
  }

  ValueId literal(float value) {
    return add(bare_instruction(Op::constant, Scalar::f32, std::bit_cast<std::uint32_t>(value)));
  }

  ValueId clamped_scale() {
    const bool varies = has_channel(program_);
    const auto place = [](const auto& list) {
      return static_cast<std::uint32_t>(
          std::ranges::find_if(list, [](const auto& each) { return each.name == scale_name; }) -
          list.begin());
    };
    const ValueId given =
        add(varies ? bare_instruction(Op::input, Scalar::f32, place(program_.inputs))
                   : bare_instruction(Op::parameter, Scalar::f32, place(program_.parameters)));
    const ValueId positive = add(operation(Op::max, given, literal(0.0f)));
    // The product with a change of 0 is 0.
    return add(operation(Op::min, positive, literal(1e6f)));
  }

  const Program& program_;
  Program made_;
};

}  // namespace

void offer_footprint_scale(Program& program, bool varying) {
  const bool has_ddx = std::ranges::any_of(program.functions, [](const Function& function) {
    return std::ranges::find(function.code, Op::ddx, &Instruction::op) != function.code.end();
  });
  if (has_ddx) add_scale(program, varying);
}

void keep_footprint_scale(const Program& program, Program& made) {
  if (!offers_footprint_scale(program) || offers_footprint_scale(made)) return;
  if (std::ranges::none_of(made.inputs, is_change)) return;
  add_scale(made, has_channel(program));
}

bool offers_footprint_scale(const Program& program) {
  return has_channel(program) ||
         std::ranges::find(program.parameters, scale_name, &ParameterSlot::name) !=
             program.parameters.end();
}

Program scale_footprints(const Program& program) {
  return offers_footprint_scale(program) ? Scaler(program).run() : program;
}

}  // namespace nacre
