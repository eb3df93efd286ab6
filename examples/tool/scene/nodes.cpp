#include "examples/tool/scene/nodes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nacre::tool {

namespace {

using host::SceneTexture;

const char* address_mode(SceneTexture::Wrap wrap) {
  switch (wrap) {
    case SceneTexture::Wrap::clamp: return "clamp";
    case SceneTexture::Wrap::mirror: return "mirror";
    case SceneTexture::Wrap::repeat: break;
  }
  return "periodic";
}

Port port(host::Vec2 v) { return {"vector2", "", fmt::format("{}, {}", v.x, v.y)}; }
Port port(int value) { return {"integer", "", fmt::format("{}", value)}; }
Port port(const char* value) { return {"string", "", value}; }

/// Whether each of its numbers is 1.
bool is_one(const Port& p) {
  return p.is_value() && (p.value == "1" || p.value == "1, 1, 1" || p.value == "1, 1, 1, 1");
}

}  // namespace

Port port(float value) { return {"float", "", fmt::format("{}", value)}; }
Port port(const std::array<float, 3>& c) {
  return {"color3", "", fmt::format("{}", fmt::join(c, ", "))};
}
Port port(const std::array<float, 4>& c) {
  return {"color4", "", fmt::format("{}", fmt::join(c, ", "))};
}

SceneNodes::SceneNodes(NewDocument& document, const std::vector<std::string>& files,
                       const std::string& name)
    : document_(document), files_(files), name_(name), graph_(document.make("nodegraph", name)) {}

void SceneNodes::connect(Element& node, std::string_view name, const Port& port) {
  Element& input = document_.add_input(node, name, port.type);
  document_.set(input, port.is_value() ? "value" : "nodename",
                port.is_value() ? port.value : port.node);
}

Element& SceneNodes::make(std::string_view category, const std::string& type,
                          const std::vector<std::pair<std::string_view, Port>>& inputs) {
  const int number = ++counts_[std::string(category)];
  const std::string name = fmt::format("{}{}", category, number);
  Element& node = document_.make(category, name, type);
  document_.append(graph_, node);
  for (const auto& [input, port] : inputs) connect(node, input, port);
  return node;
}

Port SceneNodes::add(std::string_view category, const std::string& type,
                     const std::vector<std::pair<std::string_view, Port>>& inputs) {
  return {type, std::string(make(category, type, inputs).name())};
}

Port SceneNodes::image(const SceneTexture& t, const std::string& type, bool is_srgb) {
  const std::string key =
      fmt::format("{} {} {} {} {} {} {} {} {} {} {} {}", type, is_srgb, t.image, t.set, t.offset.x,
                  t.offset.y, t.scale.x, t.scale.y, t.rotation, static_cast<int>(t.wrap_u),
                  static_cast<int>(t.wrap_v), t.is_closest);
  if (const auto found = images_.find(key); found != images_.end()) return found->second;
  std::vector<std::pair<std::string_view, Port>> inputs;
  inputs.emplace_back("file", Port{"filename", "", files_.at(t.image)});
  if (t.set != 0) {
    const Port uv = add("texcoord", "vector2", {{"index", port(static_cast<int>(t.set))}});
    inputs.emplace_back("texcoord", uv);
  }
  const bool is_moved = t.offset.x != 0.f || t.offset.y != 0.f || t.scale.x != 1.f ||
                        t.scale.y != 1.f || t.rotation != 0.f;
  if (is_moved) {
    constexpr float degrees = 57.29577951f;
    inputs.emplace_back("scale", port(t.scale));
    inputs.emplace_back("rotate", port(degrees * t.rotation));
    inputs.emplace_back("offset", port(t.offset));
  }
  // Of color4 the default is another: first the offset.
  inputs.emplace_back("operationorder", port(0));
  inputs.emplace_back("uaddressmode", port(address_mode(t.wrap_u)));
  inputs.emplace_back("vaddressmode", port(address_mode(t.wrap_v)));
  if (t.is_closest) inputs.emplace_back("filtertype", port("closest"));
  Element& node = make("gltf_image", type, inputs);
  if (is_srgb) document_.set(*Document::first_child(node), "colorspace", "srgb_texture");
  return images_[key] = {type, std::string(node.name())};
}

Port SceneNodes::extract(const Port& of, int index) {
  return add("extract", "float", {{"in", of}, {"index", port(index)}});
}

Port SceneNodes::multiply(const Port& a, const Port& b) {
  if (is_one(a)) return b;
  if (is_one(b)) return a;
  return add("multiply", a.type, {{"in1", a}, {"in2", b}});
}

Port SceneNodes::channel(const SceneTexture& texture, int index, float factor) {
  return multiply(extract(image(texture, "vector3", false), index), port(factor));
}

Port SceneNodes::alpha(const SceneTexture& texture, bool is_srgb, float factor) {
  return multiply(extract(image(texture, "color4", is_srgb), 3), port(factor));
}

void SceneNodes::feed(Element& node, std::string_view name, const Port& port) {
  if (port.is_value()) return connect(node, name, port);
  Element& output = document_.make("output", name, port.type);
  document_.set(output, "nodename", port.node);
  outputs_.push_back(&output);
  Element& input = document_.add_input(node, name, port.type);
  document_.set(input, "nodegraph", name_);
  document_.set(input, "output", name);
}

void SceneNodes::finish() {
  if (outputs_.empty()) return;
  for (Element* output : outputs_) document_.append(graph_, *output);
  document_.append(document_.root(), graph_);
}

}  // namespace nacre::tool
