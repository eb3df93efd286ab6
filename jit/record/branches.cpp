#include "jit/record/branches.h"

#include <algorithm>
#include <string_view>

namespace nacre {

namespace {

// Deep enough for a switch (10) within a few others, and what bounds the walk that
// finds the branch two readers share.
constexpr std::uint32_t max_depth = 64;

bool chooses(const GraphNode& node) {
  const std::string_view category = node.category;
  return (category == "ifgreater" || category == "ifgreatereq" || category == "ifequal") &&
         node.input("in1") != nullptr && node.input("in2") != nullptr && node.outputs.size() == 1 &&
         is_numeric(node.outputs[0].type);
}

bool is_numeric_node(const GraphNode& node) {
  return std::all_of(node.outputs.begin(), node.outputs.end(),
                     [](const GraphNodeOutput& output) { return is_numeric(output.type); });
}

class Planner {
 public:
  explicit Planner(const Graph& graph) : graph_(graph), home_(graph.nodes.size(), unread) {
    plan_.branches.emplace_back();
    plan_.of_node.resize(graph.nodes.size());
  }

  BranchPlan run() {
    for (const GraphOutput& output : graph_.outputs) read(output.source, BranchPlan::whole);
    // Links point backwards, so every reader comes before what it reads.
    for (std::size_t i = graph_.nodes.size(); i-- > 0;) place(static_cast<std::uint32_t>(i));
    for (BranchPlan::Branch& branch : plan_.branches) {
      std::reverse(branch.nodes.begin(), branch.nodes.end());
    }
    return std::move(plan_);
  }

 private:
  static constexpr std::uint32_t unread = ~0u;

  void place(std::uint32_t number) {
    const GraphNode& node = graph_.nodes[number];
    std::uint32_t& home = home_[number];
    if (home == unread || !is_numeric_node(node)) home = BranchPlan::whole;
    plan_.branches[home].nodes.push_back(number);
    if (chooses(node) && plan_.branches[home].depth < max_depth) {
      plan_.of_node[number] = {open_branch(home), open_branch(home)};
    }
    for (const GraphInput& input : node.inputs) {
      const std::uint32_t branch = input.name == "in1"   ? plan_.of_node[number][0]
                                   : input.name == "in2" ? plan_.of_node[number][1]
                                                         : BranchPlan::whole;
      read(input.source, branch == BranchPlan::whole ? home : branch);
    }
  }

  std::uint32_t open_branch(std::uint32_t parent) {
    const auto number = static_cast<std::uint32_t>(plan_.branches.size());
    const std::uint32_t depth = plan_.branches[parent].depth + 1;
    plan_.branches.push_back({parent, depth, {}});
    return number;
  }

  void read(const Source& source, std::uint32_t branch) {
    if (source.kind != Source::Kind::link) return;
    std::uint32_t& home = home_[source.node];
    home = home == unread ? branch : shared(home, branch);
  }

  std::uint32_t shared(std::uint32_t a, std::uint32_t b) const {
    while (a != b) {
      std::uint32_t& deeper = plan_.branches[a].depth > plan_.branches[b].depth ? a : b;
      deeper = plan_.branches[deeper].parent;
    }
    return a;
  }

  const Graph& graph_;
  BranchPlan plan_;
  std::vector<std::uint32_t> home_;  ///< By node.
};

}  // namespace

BranchPlan plan_branches(const Graph& graph) { return Planner(graph).run(); }

}  // namespace nacre
