#include "jit/passes/structure.h"

#include <algorithm>
#include <bit>
#include <string_view>

#include "runtime/mix_bits.h"

namespace nacre {

namespace {

/// Of both numbers, in this order.
std::uint64_t mix(std::uint64_t a, std::uint64_t b) {
  return mix_bits(std::rotl(a, 23) + b + 0x9e3779b97f4a7c15u);
}

std::uint64_t digest_of(std::string_view name) {
  std::uint64_t digest = name.size();
  for (const char c : name) digest = mix(digest, static_cast<unsigned char>(c));
  return digest;
}

class Reader {
 public:
  Reader(const Program& program, const std::vector<Structure>& callees)
      : program_(program), callees_(callees) {}

  Structure run(const Function& function) {
    const std::size_t size = function.code.size();
    Structure made;
    made.depth.resize(size);
    made.digest.resize(size);
    for (std::size_t i = 0; i < size; ++i) {
      const Instruction& instruction = function.code[i];
      std::uint64_t digest = mix(static_cast<std::uint64_t>(instruction.op), meaning(instruction));
      std::uint32_t depth = 0;
      std::uint64_t both = 0;
      for (const ValueId operand : function.operands(instruction)) {
        depth = std::max(depth, made.depth[operand] + 1);
        const std::uint64_t part = made.digest[operand];
        if (info(instruction.op).commutes) {
          both += mix(part, 0);
        } else {
          digest = mix(digest, part);
        }
      }
      made.depth[i] = depth;
      made.digest[i] = mix(digest, both);
      follow(instruction, made.digest[i]);
      if (instruction.op == Op::give) made.whole = mix(made.whole, made.digest[i]);
    }
    return made;
  }

 private:
  /// What an instruction says beside its operands.
  std::uint64_t meaning(const Instruction& instruction) const {
    switch (instruction.op) {
      case Op::input: return digest_of(program_.inputs[instruction.imm].name);
      case Op::parameter: return digest_of(program_.parameters[instruction.imm].name);
      case Op::table: return digest_of(program_.tables[instruction.imm].name);
      case Op::call: return callees_[instruction.imm].whole;
      case Op::keep: return 0;  // Numbers of keeps follow the order.
      case Op::merge: return regions_.empty() ? 0 : regions_.back();
      case Op::carry: return mix(regions_.empty() ? 0 : regions_.back(), carries_.back());
      case Op::constant: return mix(static_cast<std::uint64_t>(instruction.type), instruction.imm);
      default: return instruction.imm;
    }
  }

  /// Which regions are open behind an instruction.
  void follow(const Instruction& instruction, std::uint64_t digest) {
    if (opens_region(instruction.op)) {
      regions_.push_back(digest);
      carries_.push_back(0);
    }
    if (instruction.op == Op::carry) ++carries_.back();
    if (closes_region(instruction.op)) {
      regions_.pop_back();
      carries_.pop_back();
    }
  }

  const Program& program_;
  const std::vector<Structure>& callees_;
  std::vector<std::uint64_t> regions_;  ///< Digests of what opened those that are open.
  std::vector<std::uint64_t> carries_;  ///< How many each has so far.
};

}  // namespace

std::vector<Structure> structures_of(const Program& program) {
  std::vector<Structure> structures(program.functions.size());
  for (std::size_t i = 1; i < program.functions.size(); ++i) {
    structures[i] = Reader(program, structures).run(program.functions[i]);
  }
  structures[0] = Reader(program, structures).run(program.entry());
  return structures;
}

}  // namespace nacre
