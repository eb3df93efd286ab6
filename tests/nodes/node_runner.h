#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "runtime/node/node_call.h"
#include "tests/support/run_kernel.h"

namespace nacre {

struct NodePort {
  std::string name;
  Type type = Type::float_;
  std::string text = {};  ///< Of string and filename inputs.
};

/// A node of the standard library on its own. Numeric inputs are channels of
/// their names: "in1" for one component, else "in1.x" ... "in1.w" or, beyond four,
/// "in1.0" ...; outputs are named alike. Inputs have derivatives over the footprint
/// ("din1dx", "din1dx.x"), 0 where the columns have none.
struct NodeUnderTest {
  std::string category;
  std::vector<NodePort> inputs;
  std::vector<NodePort> outputs = {{"out"}};
};

/// The ports after the body ran.
std::vector<NodeCall::Port> record_node(Recorder& recorder, const NodeUnderTest& node);
/// Component `i` of `count` of a port, as a channel.
std::string component_name(const std::string& port, int i, int count);
/// The body's Program, derivatives expanded.
Program node_program(const NodeUnderTest& node);
/// Runs it by the reference engine.
DoubleColumns run_node(const NodeUnderTest& node, const Columns& inputs);

/// An input of one value.
struct Arg {
  std::string name;
  Type type;
  std::vector<float> values;
  std::string text = {};
};

/// The components of the first output for one set of inputs.
std::vector<double> call_node(const std::string& category, const std::vector<Arg>& args, Type out);
/// Floats in, a float out.
double call_scalar(const std::string& category,
                   const std::vector<std::pair<std::string, float>>& args);

/// Numbers from -20 to 20, small and large ones, zeros, denormals, infinities, NaN.
std::vector<float> hostile_floats();

}  // namespace nacre
