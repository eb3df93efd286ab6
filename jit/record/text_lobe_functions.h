#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "jit/glsl/module.h"
#include "jit/graph/graph.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// A function of a lobe in a text, with the values of the node's inputs as its parameters take
/// them. The types of values live as long as the module.
struct LobeFunction {
  const glsl::Function* function = nullptr;  ///< Null: the text does not have it.
  std::vector<glsl::Value> inputs;           ///< Kept; they follow what the kernel passes.
};

/// All of them. `f` stands for NodeText::function:
///
///   vec3  f_evaluate(vec3 wo, vec3 wi, INPUTS)
///   vec3  f_sample(vec3 wo, vec3 xi, INPUTS)      or vec2 xi
///   float f_pdf(vec3 wo, vec3 wi, INPUTS)
///   vec3  f_albedo(vec3 wo, INPUTS)
///   vec3  f_throughput(vec3 wo, INPUTS)           optional
///   float f_roughness(INPUTS)                     optional
///
/// INPUTS are those of the nodedef in its order, less those that is_for_kernel().
struct LobeFunctions {
  std::shared_ptr<const glsl::Module> module;  ///< Never null.
  LobeFunction evaluate, sample, pdf, albedo, throughput, roughness;
};

/// Whether an input is no business of the functions: `weight`, a float that scales what they give,
/// and `normal` and `tangent`, vectors that make the frame in which they see directions.
bool is_for_kernel(const NodeCall::Port& input);

/// Keeps the node's inputs. Nothing, with diagnostics for each, where a function is missing or
/// does not fit.
std::optional<LobeFunctions> find_lobe_functions(const NodeText& source,
                                                 std::shared_ptr<const glsl::Module> module,
                                                 NodeCall& call, Diagnostics& diagnostics);

}  // namespace nacre
