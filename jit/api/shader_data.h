#pragma once

#include <nacre/nacre.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "jit/shading/shading_system.h"

namespace nacre::api {

/// A parameter that a shader's host may set.
struct ShaderParameter {
  Parameter about;
  Scalar number = Scalar::f32;
  int components = 1;
  /// Of its first number in ShaderData::block; the others follow. Also of what is varying, for
  /// whose values of the document there is no other place.
  std::uint32_t first = 0;
  bool is_varying = false;
  /// For a slider, as many numbers; empty: no limit.
  std::vector<std::uint32_t> minimum, maximum;
};

/// The kernels of a material, or of outputs, with one block of parameters for all of them: what
/// an instance has its own copy of. Never changed once made.
class ShaderData {
 public:
  explicit ShaderData(std::unique_ptr<MaterialKernels> kernels);
  explicit ShaderData(std::unique_ptr<OutputKernel> kernel);

  /// Null where there is nothing to compute.
  const BoundKernel* kernel(nacre_entry entry) const;
  const std::vector<std::uint32_t>& state() const { return state_; }
  bool has_back() const { return has_back_; }
  const std::vector<LobeInfo>& lobes() const { return lobes_; }
  /// What is left out, and whether that changes the picture.
  const std::vector<std::pair<std::string, bool>>& left_out() const { return left_out_; }
  const std::vector<FactUse>& facts() const { return facts_; }
  const std::vector<ShaderParameter>& parameters() const { return parameters_; }

  /// The block as the document has it.
  const std::vector<std::uint32_t>& block() const { return block_; }
  /// Place in the block of each slot of a kernel; `of_point` for those of point_channels().
  const std::vector<std::uint32_t>& slots(nacre_entry entry) const { return slots_[entry]; }
  static constexpr std::uint32_t of_point = ~std::uint32_t{0};
  /// The channels of the one point of NACRE_EVALUATE_AT, which are slots of its kernel.
  const std::vector<Channel>& point_channels() const { return point_channels_; }

 private:
  void add(nacre_entry entry, std::optional<BoundKernel> kernel);
  void lay_out(std::vector<Parameter> parameters);

  std::array<std::optional<BoundKernel>, NACRE_ENTRY_COUNT> kernels_;
  std::array<std::vector<std::uint32_t>, NACRE_ENTRY_COUNT> slots_;
  std::vector<Channel> point_channels_;
  std::vector<std::uint32_t> state_;
  std::vector<LobeInfo> lobes_;
  std::vector<std::pair<std::string, bool>> left_out_;
  std::vector<FactUse> facts_;
  std::vector<ShaderParameter> parameters_;
  std::vector<std::uint32_t> block_;
  bool has_back_ = false;
};

}  // namespace nacre::api
