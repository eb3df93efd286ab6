#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "examples/render/scene_material.h"
#include "examples/tool/new_document.h"

namespace nacre::tool {

/// What an input of a node is: a node of the same graph, or a value.
struct Port {
  std::string type;
  std::string node;  ///< Empty: `value`.
  std::string value = {};

  bool is_value() const { return node.empty(); }
};

Port port(float value);
Port port(const std::array<float, 3>& color);
Port port(const std::array<float, 4>& color);

/// The nodes of one material in the making: a nodegraph, in which equal images are one node.
class SceneNodes {
 public:
  /// `files`: what each image of the scene is called in the document.
  SceneNodes(NewDocument& document, const std::vector<std::string>& files, const std::string& name);

  Port add(std::string_view category, const std::string& type,
           const std::vector<std::pair<std::string_view, Port>>& inputs);
  /// The texture as a color3, color4 or vector3; colours of "srgb_texture" or, if !is_srgb, as
  /// they are.
  Port image(const host::SceneTexture& texture, const std::string& type, bool is_srgb);
  /// A channel of what an image has beside colours, times a number.
  Port channel(const host::SceneTexture& texture, int index, float factor);
  /// The fourth channel of an image, times a number.
  Port alpha(const host::SceneTexture& texture, bool is_srgb, float factor);
  /// a b; what is 1 leaves the other.
  Port multiply(const Port& a, const Port& b);
  Port extract(const Port& of, int index);

  /// Makes a port an input of a node beside the graph.
  void feed(Element& node, std::string_view name, const Port& port);

  /// Puts the graph into the document, if anything is in it.
  void finish();

 private:
  Element& make(std::string_view category, const std::string& type,
                const std::vector<std::pair<std::string_view, Port>>& inputs);
  void connect(Element& node, std::string_view name, const Port& port);

  NewDocument& document_;
  const std::vector<std::string>& files_;
  std::string name_;
  Element& graph_;
  std::map<std::string, Port> images_;
  std::map<std::string, int> counts_;
  std::vector<Element*> outputs_;
};

}  // namespace nacre::tool
