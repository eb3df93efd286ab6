#include <bit>

#include "runtime/program/program.h"

namespace nacre {

namespace {

/// Two lanes of multiply-xorshift mixing (the finalizer of SplitMix64, Steele,
/// Lea and Flood, OOPSLA 2014) over 64-bit words.
class Mixer {
 public:
  void word(std::uint64_t value) {
    low_ = finalize(low_ ^ value);
    high_ = finalize(high_ + value * 0x9e3779b97f4a7c15ull + 1);
  }
  void text(const std::string& value) {
    word(value.size());
    for (const char c : value) word(static_cast<unsigned char>(c));
  }
  std::array<std::uint64_t, 2> result() const { return {low_, high_}; }

 private:
  static std::uint64_t finalize(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  std::uint64_t low_ = 0x243f6a8885a308d3ull;  // Digits of pi: nothing up the sleeve.
  std::uint64_t high_ = 0x13198a2e03707344ull;
};

void mix(Mixer& mixer, const Function& function) {
  mixer.word(function.arguments.size());
  mixer.word(function.code.size());
  for (const Instruction& instruction : function.code) {
    mixer.word(static_cast<std::uint64_t>(instruction.op) |
               static_cast<std::uint64_t>(instruction.type) << 8 |
               static_cast<std::uint64_t>(instruction.imm) << 16);
    for (const ValueId operand : function.operands(instruction)) mixer.word(operand);
  }
}

void mix(Mixer& mixer, std::span<const float> values) {
  mixer.word(values.size());
  for (const float value : values) mixer.word(std::bit_cast<std::uint32_t>(value));
}

}  // namespace

std::array<std::uint64_t, 2> hash(std::span<const float> values) {
  Mixer mixer;
  mix(mixer, values);
  return mixer.result();
}

std::array<std::uint64_t, 2> hash(const Program& program) {
  Mixer mixer;
  for (const Function& function : program.functions) mix(mixer, function);
  const auto channels = [&](const std::vector<Channel>& list) {
    mixer.word(list.size());
    for (const Channel& channel : list) {
      mixer.text(channel.name);
      mixer.word(static_cast<std::uint64_t>(channel.type));
    }
  };
  channels(program.inputs);
  channels(program.outputs);
  mixer.word(program.parameters.size());
  for (const ParameterSlot& slot : program.parameters) {
    mixer.word(static_cast<std::uint64_t>(slot.type));
  }
  mixer.word(program.textures.size());
  for (const Table& table : program.tables) mix(mixer, table.values);
  return mixer.result();
}

}  // namespace nacre
