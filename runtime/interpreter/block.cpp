#include "runtime/interpreter/block.h"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "runtime/program/fold.h"

namespace nacre {

void Block::load_constant(Register& to, const Instruction& constant) const {
  switch (constant.type) {
    case Scalar::f32: to.fill(flush_denormal(constant.imm)); break;
    case Scalar::i32: to.fill(constant.imm); break;
    default: to.fill(constant.imm != 0 ? all_ones : 0u); break;
  }
}

void Block::load_parameter(Register& to, const Instruction& parameter) const {
  Instruction constant = parameter;
  constant.imm = arguments.parameters[parameter.imm];
  load_constant(to, constant);
}

void Block::load_input(Register& to, const Instruction& input) const {
  const auto* source = static_cast<const std::uint32_t*>(arguments.inputs[input.imm]) + first;
  std::copy_n(source, lanes, to.begin());
  std::fill(to.begin() + lanes, to.end(), source[lanes - 1]);
  // One loop each, which compilers make vectors of.
  if (input.type == Scalar::f32) {
    for (std::uint32_t& bits : to) bits = flush_denormal(bits);
  } else if (input.type == Scalar::b1) {
    for (std::uint32_t& bits : to) bits = bits != 0 ? all_ones : 0u;
  }
}

void Block::load_table(Register& to, const Instruction& table, const Register& index) const {
  const std::vector<std::uint32_t>& words = tables[table.imm];
  const auto last = static_cast<std::int32_t>(words.size() - 1);
  lane_ops().look_up(to.data(), index.data(), words.data(), last);
}

void Block::load_fitted(Register& to, const Instruction& fitted, const Register& index) const {
  const float* const row =
      arguments.fitted != nullptr ? arguments.fitted + Fit::cells * fitted.imm : nullptr;
  for (int k = 0; k < block_lanes; ++k) {
    const float number = row != nullptr ? row[index[k] % Fit::cells] : 0.0f;
    to[k] = flush_denormal(std::bit_cast<std::uint32_t>(number));
  }
}

void Block::load_texel(Register& to, const Register& slot, const Register& word) const {
  for (int k = 0; k < block_lanes; ++k) {
    const std::uint32_t number = slot[k] < program.textures.size() ? slot[k] : 0u;
    const TextureBinding& texture = arguments.textures[number];
    to[k] = texture.words[word[k] < texture.count ? word[k] : 0u];
  }
}

void Block::call_texture(std::span<Register, 4> to, const Instruction& call,
                         std::span<const Register* const> from) const {
  const auto floats = [&](std::size_t k) {
    return reinterpret_cast<const float*>(from[k]->data());
  };
  const auto* const limits =
      from.size() > 7 ? reinterpret_cast<const std::int32_t*>(from[7]->data()) : nullptr;
  std::array<float, 4 * block_lanes> rgba{};
  const TextureCall request{.slot = (*from[0])[0],
                            .modes = call.imm,
                            .lanes = block_lanes,
                            .u = floats(1),
                            .v = floats(2),
                            .dudx = floats(3),
                            .dvdx = floats(4),
                            .dudy = floats(5),
                            .dvdy = floats(6),
                            .max_anisotropy = limits,
                            .rgba = rgba.data()};
  if (arguments.texture_callback != nullptr) {
    arguments.texture_callback(arguments.texture_user, &request);
  }
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t k = 0; k < block_lanes; ++k) {
      to[c][k] = flush_denormal(std::bit_cast<std::uint32_t>(rgba[c * block_lanes + k]));
    }
  }
}

void Block::store(const Register& value, const Instruction& output) const {
  const Scalar type = program.outputs[output.imm].type;
  auto* to = static_cast<std::uint32_t*>(arguments.outputs[output.imm]) + first;
  for (int k = 0; k < lanes; ++k) {
    std::uint32_t bits = value[k];
    if (type == Scalar::f32 && (bits & 0x7fffffffu) > 0x7f800000u) bits = canonical_nan;
    if (type == Scalar::b1) bits &= 1u;
    to[k] = bits;
  }
}

}  // namespace nacre
