#include "tests/support/closure.h"

#include <cassert>
#include <vector>

#include "pbs/closure_nodes.h"
#include "runtime/node/geometry.h"

namespace nacre {

namespace {

/// All nodes' defaults; a body asks only for its own.
Ports defaults(Recorder& recorder) {
  return {{"weight", number(1.0f)},
          {"tint", colour(1.0f)},
          {"ior", number(1.5f)},
          {"extinction", {Type::color3, Color3(3.424f, 2.346f, 1.770f)}},
          {"color0", colour(1.0f)},
          {"color82", colour(1.0f)},
          {"color90", colour(1.0f)},
          {"exponent", number(5.0f)},
          {"roughness", roughness(0.05f, 0.05f)},
          {"retroreflective", {Type::boolean, Bool(false)}},
          {"thinfilm_thickness", number(0.0f)},
          {"thinfilm_ior", number(1.5f)},
          {"normal", {Type::vector3, normal(recorder, Space::world)}},
          {"tangent", {Type::vector3, tangent(recorder, Space::world)}},
          {"cuticle_angle", number(0.5f)},
          {"absorption_coefficient", colour(0.0f)},
          {"curve_direction", {Type::vector3, tangent(recorder, Space::world)}},
          {"distribution", text("ggx")},
          {"scatter_mode", text("R")}};
}

}  // namespace

BsdfPtr microfacet_bsdf(Recorder& recorder, std::string_view category, Ports ports,
                        Accuracy accuracy) {
  Ports all = defaults(recorder);
  if (category == "conductor_bsdf") {
    all["ior"] = {Type::color3, Color3(0.183f, 0.421f, 1.373f)};
  }
  for (auto& [name, value] : ports) all[name] = value;
  std::vector<NodeCall::Port> inputs;
  for (const auto& [name, value] : all) inputs.push_back({name, value});
  std::vector<NodeCall::Port> outputs{{"out", Recorded(Type::bsdf, ClosurePtr())}};
  Diagnostics diagnostics;
  NodeCall call(recorder, category, "", std::move(inputs), std::move(outputs), accuracy, nullptr,
                diagnostics, {});
  for (const NodeBody& body : closure_nodes()) {
    if (body.category == category) body.record(call);
  }
  return as_bsdf(call.outputs().front().value.closure);
}

}  // namespace nacre
