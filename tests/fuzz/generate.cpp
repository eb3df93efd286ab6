#include "tests/fuzz/generate.h"

#include <string_view>

namespace nacre::fuzz {

namespace {

std::string attribute(const Tree& tree, std::string_view name) {
  const std::string* value = tree.find(name);
  return value != nullptr ? *value : std::string();
}

Tree port(const std::string& category, const std::string& name, const std::string& type) {
  return {category, {{"name", name}, {"type", type}}, {}};
}

struct Producer {
  std::string node;
  std::string output;  ///< "" where the node has one only.
  std::string type;
};

void read_from(Tree& reader, const Producer& producer) {
  reader.set("nodename", producer.node);
  if (!producer.output.empty()) reader.set("output", producer.output);
}

class Generator {
 public:
  Generator(const std::vector<const Tree*>& nodedefs, Random& random)
      : nodedefs_(nodedefs), random_(random) {}

  Tree run() {
    Tree root{"materialx", {{"version", "1.39"}}, {}};
    const bool in_graph = random_.one_in(2);
    Tree graph{"nodegraph", {{"name", "G"}}, {}};
    const std::size_t nodes = 1 + random_.below(6);
    for (std::size_t i = 0; i < nodes; ++i) {
      Tree node = add_node(*random_.pick(nodedefs_), "n" + std::to_string(i));
      // What shows a surface stays outside: materials don't look into graphs in all documents.
      (in_graph ? graph : root).children.push_back(std::move(node));
    }
    add_outputs(in_graph ? graph : root);
    if (in_graph) root.children.push_back(std::move(graph));
    add_material(root, in_graph);
    return root;
  }

 private:
  Tree add_node(const Tree& nodedef, const std::string& name) {
    std::vector<Producer> made;
    Tree node{attribute(nodedef, "node"), {{"name", name}}, {}};
    for (const Tree& child : nodedef.children) {
      if (child.category == "output") {
        made.push_back({name, attribute(child, "name"), attribute(child, "type")});
      } else if (child.category == "input" && !random_.one_in(4)) {
        add_input(child, node);
      }
    }
    if (made.size() == 1) made[0].output.clear();
    node.set("type", made.size() == 1 ? made[0].type : "multioutput");
    if (random_.one_in(3)) node.set("nodedef", attribute(nodedef, "name"));
    producers_.insert(producers_.end(), made.begin(), made.end());
    return node;
  }

  void add_input(const Tree& declared, Tree& node) {
    const std::string type = attribute(declared, "type");
    Tree input = port("input", attribute(declared, "name"), type);
    std::vector<const Producer*> fitting;
    for (const Producer& one : producers_) {
      if (one.type == type) fitting.push_back(&one);
    }
    const std::string* value = declared.find("value");
    if (!fitting.empty() && attribute(declared, "uniform") != "true" && !random_.one_in(4)) {
      read_from(input, *random_.pick(fitting));
    } else if (value != nullptr && !value->empty()) {
      input.set("value", *value);
    } else {
      return;
    }
    node.children.push_back(std::move(input));
  }

  void add_outputs(Tree& scope) {
    for (std::size_t i = 0; i < 3 && i < producers_.size(); ++i) {
      const Producer& producer = producers_[producers_.size() - 1 - i];
      Tree output = port("output", "o" + std::to_string(i), producer.type);
      read_from(output, producer);
      if (producer.type == "surfaceshader") surface_ = producer, surface_output_ = i;
      scope.children.push_back(std::move(output));
    }
  }

  void add_material(Tree& root, bool in_graph) const {
    if (surface_.type.empty()) return;
    Tree material{"surfacematerial", {{"name", "M"}, {"type", "material"}}, {}};
    Tree input = port("input", "surfaceshader", "surfaceshader");
    if (in_graph) {
      input.set("nodegraph", "G");
      input.set("output", "o" + std::to_string(surface_output_));
    } else {
      read_from(input, surface_);
    }
    material.children.push_back(std::move(input));
    root.children.push_back(std::move(material));
  }

  const std::vector<const Tree*>& nodedefs_;
  Random& random_;
  std::vector<Producer> producers_;
  Producer surface_;
  std::size_t surface_output_ = 0;
};

}  // namespace

Tree generate(const std::vector<const Tree*>& nodedefs, Random& random) {
  return Generator(nodedefs, random).run();
}

}  // namespace nacre::fuzz
