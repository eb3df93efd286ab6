#include "runtime/program/digest.h"

#include <bit>
#include <vector>

namespace nacre {

namespace {

/// A Program as words, so that different Programs give different words: every list is
/// preceded by its length.
class Words {
 public:
  void add(std::uint32_t word) { words_.push_back(word); }
  void add_count(std::size_t count) {
    add(static_cast<std::uint32_t>(count));
    add(static_cast<std::uint32_t>(std::uint64_t{count} >> 32));
  }
  void add(const std::string& text) {
    add_count(text.size());
    for (const char c : text) add(static_cast<unsigned char>(c));
  }
  void add(const std::vector<Scalar>& types) {
    add_count(types.size());
    for (const Scalar type : types) add(static_cast<std::uint32_t>(type));
  }
  void add(const std::vector<Channel>& channels) {
    add_count(channels.size());
    for (const Channel& channel : channels) {
      add(channel.name);
      add(static_cast<std::uint32_t>(channel.type));
    }
  }
  void add(std::span<const float> values) {
    add_count(values.size());
    for (const float value : values) add(std::bit_cast<std::uint32_t>(value));
  }
  void add(const Function& function, bool with_varying) {
    add(function.arguments);
    add(function.results);
    add_count(function.code.size());
    for (const Instruction& instruction : function.code) {
      const std::span<const ValueId> operands = function.operands(instruction);
      const bool varying = with_varying && instruction.varying;
      add(static_cast<std::uint32_t>(instruction.op) |
          static_cast<std::uint32_t>(instruction.type) << 8 |
          static_cast<std::uint32_t>(varying) << 16);
      add(instruction.imm);
      add(static_cast<std::uint32_t>(operands.size()));
      words_.insert(words_.end(), operands.begin(), operands.end());
    }
  }
  void reserve(std::size_t count) { words_.reserve(count); }

  Digest digest() const {
    return sha256({reinterpret_cast<const char*>(words_.data()), 4 * words_.size()});
  }

 private:
  std::vector<std::uint32_t> words_;
};

Digest digest(const Program& program, bool with_varying) {
  Words words;
  std::size_t instructions = 0;
  for (const Function& function : program.functions) instructions += function.code.size();
  words.reserve(6 * instructions + 1024);
  words.add_count(program.functions.size());
  for (const Function& function : program.functions) words.add(function, with_varying);
  words.add(program.inputs);
  words.add(program.outputs);
  words.add_count(program.parameters.size());
  for (const ParameterSlot& slot : program.parameters) {
    words.add(static_cast<std::uint32_t>(slot.type));
  }
  words.add_count(program.textures.size());
  words.add_count(program.tables.size());
  for (const Table& table : program.tables) words.add(table.values);
  return words.digest();
}

char letter(Scalar type) {
  switch (type) {
    case Scalar::none: return 'n';
    case Scalar::f32: return 'f';
    case Scalar::i32: return 'i';
    case Scalar::b1: return 'b';
  }
  return '?';
}

}  // namespace

Digest digest(const Program& program) { return digest(program, false); }

Digest code_digest(const Program& program) { return digest(program, true); }

Digest digest(std::span<const float> values) {
  Words words;
  words.reserve(values.size() + 2);
  words.add(values);
  return words.digest();
}

std::string interface_text(const Program& program) {
  std::string text;
  const auto add = [&](const auto& list) {
    for (const auto& each : list) text += letter(each.type);
    text += '/';
  };
  add(program.inputs);
  add(program.outputs);
  add(program.parameters);
  return text + std::to_string(program.textures.size());
}

}  // namespace nacre
