#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "jit/record/bodies.h"
#include "nodes/nodes.h"
#include "tests/nodes/node_runner.h"
#include "tests/support/standard_library.h"

namespace nacre {
namespace {

bool is_value(Type type) { return is_numeric(type) || is_text(type); }

/// Nodedefs that compute values and read no images.
std::vector<const NodeDef*> value_nodedefs() {
  std::vector<const NodeDef*> defs;
  for (const NodeDef* def : standard_library().definitions().all()) {
    const bool values = std::ranges::all_of(
        def->outputs, [](const NodeDefOutput& output) { return is_value(output.type); });
    const bool images = std::ranges::any_of(def->inputs, [](const NodeDefInput& input) {
      return input.type == Type::filename && input.name == "file";
    });
    if (values && !images) defs.push_back(def);
  }
  return defs;
}

TEST(Library, EveryNodedefHasABodyOrAGraph) {
  const Bodies bodies(standard_library().definitions());
  for (const NodeDef* def : value_nodedefs()) {
    const bool graph = standard_library().definitions().graph_of(*def) != nullptr;
    EXPECT_TRUE(graph || bodies.contains(def->name)) << def->name;
  }
}

TEST(Library, BodiesSetEveryOutputOfEveryNodedef) {
  const Bodies bodies(standard_library().definitions());
  int checked = 0;
  for (const NodeDef* def : value_nodedefs()) {
    if (!bodies.contains(def->name)) continue;
    ++checked;
    NodeUnderTest node{def->category, {}, {}};
    for (const NodeDefInput& input : def->inputs) {
      node.inputs.push_back({std::string(input.name), input.type, "object"});
    }
    for (const NodeDefOutput& output : def->outputs) {
      node.outputs.push_back({std::string(output.name), output.type});
    }
    Recorder recorder;
    for (const NodeCall::Port& port : record_node(recorder, node)) {
      const Type type = port.value.type;
      ASSERT_EQ(static_cast<int>(port.value.parts.size()), component_count(type))
          << def->name << ' ' << port.name;
      const Scalar scalar = type == Type::integer   ? Scalar::i32
                            : type == Type::boolean ? Scalar::b1
                                                    : Scalar::f32;
      for (const Ref& part : port.value.parts) EXPECT_EQ(part.type, scalar) << def->name;
    }
    EXPECT_EQ(verify(node_program(node)), "") << def->name;
  }
  EXPECT_GT(checked, 400);
}

/// Values of everyday size for input `number`: every input gets its own order of
/// them, so zeros, equal ends and the like meet; 0 and 1 for whole numbers.
std::vector<float> everyday(Type type, std::size_t number) {
  std::vector<float> values;
  for (int i = -20; i <= 20; ++i) {
    values.push_back(static_cast<float>(i));
    values.push_back(static_cast<float>(i % 5) * 0.25f);
  }
  std::vector<float> column;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const bool whole = type == Type::integer || type == Type::boolean;
    column.push_back(whole ? static_cast<float>((k + number) % 2)
                           : values[(k * (2 * number + 1) + 7 * number) % values.size()]);
  }
  return column;
}

/// The nodes are total: no division by zero, root or logarithm gets through.
TEST(Library, FiniteInputsGiveFiniteOutputs) {
  const Bodies bodies(standard_library().definitions());
  for (const NodeDef* def : value_nodedefs()) {
    if (!bodies.contains(def->name) || is_text(def->outputs.front().type)) continue;
    NodeUnderTest node{def->category, {}, {}};
    Columns columns{{"P.x", everyday(Type::float_, 0)}};
    std::size_t number = 0;
    for (const NodeDefInput& input : def->inputs) {
      node.inputs.push_back({std::string(input.name), input.type, "object"});
      const int count = component_count(input.type);
      for (int i = 0; i < count; ++i) {
        columns[component_name(node.inputs.back().name, i, count)] = everyday(input.type, number++);
      }
    }
    for (const NodeDefOutput& output : def->outputs) {
      node.outputs.push_back({std::string(output.name), output.type});
    }
    for (const auto& [name, column] : run_node(node, columns)) {
      for (const double value : column) EXPECT_TRUE(std::isfinite(value)) << def->name;
    }
  }
}

}  // namespace
}  // namespace nacre
