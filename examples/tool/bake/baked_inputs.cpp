#include "examples/tool/bake/baked_inputs.h"

#include <fmt/format.h>

#include <algorithm>

namespace nacre::tool {

namespace {

bool is_color(Type type) { return type == Type::color3 || type == Type::color4; }

std::string value_text(Type type, std::span<const float> texel) {
  if (type == Type::boolean) return texel[0] != 0.0f ? "true" : "false";
  if (type == Type::integer) return std::to_string(static_cast<long>(texel[0]));
  std::string text;
  for (const float number : texel) {
    if (!text.empty()) text += ", ";
    text += fmt::format("{}", number);
  }
  return text;
}

}  // namespace

const std::array<float, 3>* plane_axis(std::string_view geomprop) {
  static constexpr std::array<float, 3> tangent{1, 0, 0}, bitangent{0, 1, 0}, normal{0, 0, 1};
  if (geomprop == "Nworld") return &normal;
  if (geomprop == "Tworld") return &tangent;
  return geomprop == "Bworld" ? &bitangent : nullptr;
}

void BakedInputs::set_value(const BakedInput& baked, std::span<const float> texel,
                            std::string_view colorspace) {
  if (const std::array<float, 3>* axis = plane_axis(baked.frame)) {
    if (std::equal(axis->begin(), axis->end(), texel.begin())) return;  // It is the default.
    Element& normalmap = add_node(baked, "normalmap", "_direction", "vector3");
    const std::array<float, 3> coded{0.5f * texel[0] + 0.5f, 0.5f * texel[1] + 0.5f,
                                     0.5f * texel[2] + 0.5f};
    document_.set(document_.add_input(normalmap, "in", "vector3"), "value",
                  value_text(baked.type, coded));
    return connect(baked, normalmap);
  }
  Element& input = document_.add_input(*baked.node, baked.input, type_name(baked.type));
  document_.set(input, "value", value_text(baked.type, texel));
  // As computed is as the root says.
  const bool is_tagged = is_color(baked.type) && !colorspace.empty() && colorspace != "none" &&
                         colorspace != document_.root().attribute("colorspace");
  if (is_tagged) document_.set(input, "colorspace", colorspace);
}

void BakedInputs::set_texture(const BakedInput& baked, const std::vector<std::string>& files,
                              std::string_view colorspace) {
  if (baked.type == Type::matrix33 || baked.type == Type::matrix44) {
    const std::string_view row_type = baked.type == Type::matrix33 ? "vector3" : "vector4";
    std::vector<const Element*> rows;
    for (std::size_t i = 0; i < files.size(); ++i) {
      rows.push_back(&add_image(baked, fmt::format("_row{}", i + 1), row_type, files[i], {}));
    }
    Element& matrix = add_node(baked, "creatematrix", "_matrix", type_name(baked.type));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      document_.set(document_.add_input(matrix, fmt::format("in{}", i + 1), row_type), "nodename",
                    rows[i]->name());
    }
    return connect(baked, matrix);
  }
  const bool is_whole = baked.type == Type::boolean || baked.type == Type::integer;
  Element& image = add_image(baked, "_image", is_whole ? "float" : type_name(baked.type),
                             files.front(), colorspace);
  if (is_whole) {
    // Between texels there is nothing; half an 8-bit step is nothing either.
    document_.set(document_.add_input(image, "filtertype", "string"), "value", "closest");
    const bool is_boolean = baked.type == Type::boolean;
    Element& whole =
        add_node(baked, is_boolean ? "ifgreater" : "round", "_whole", type_name(baked.type));
    document_.set(document_.add_input(whole, is_boolean ? "value1" : "in", "float"), "nodename",
                  image.name());
    if (is_boolean) {
      document_.set(document_.add_input(whole, "value2", "float"), "value", "0.5");
    }
    return connect(baked, whole);
  }
  if (baked.frame.empty()) return connect(baked, image);
  Element& normalmap = add_node(baked, "normalmap", "_direction", "vector3");
  document_.set(document_.add_input(normalmap, "in", "vector3"), "nodename", image.name());
  connect(baked, normalmap);
}

/// A node in the input's graph, called by it.
Element& BakedInputs::add_node(const BakedInput& baked, std::string_view category,
                               const std::string& suffix, std::string_view type) {
  Element& node = document_.make(category, baked.input + suffix, type);
  document_.append(graph_of(baked), node);
  return node;
}

Element& BakedInputs::add_image(const BakedInput& baked, const std::string& suffix,
                                std::string_view type, const std::string& file,
                                std::string_view colorspace) {
  Element& image = add_node(baked, "image", suffix, type);
  Element& name = document_.add_input(image, "file", "filename");
  document_.set(name, "value", file);
  if (!colorspace.empty()) document_.set(name, "colorspace", colorspace);
  if (uv_set_ != 0) {
    Element& uv = add_node(baked, "texcoord", suffix + "_uv", "vector2");
    document_.set(document_.add_input(uv, "index", "integer"), "value", std::to_string(uv_set_));
    document_.set(document_.add_input(image, "texcoord", "vector2"), "nodename", uv.name());
  }
  return image;
}

/// Makes an output of the graph, and the input read it.
void BakedInputs::connect(const BakedInput& baked, const Element& node) {
  Element& graph = graph_of(baked);
  Element& output = document_.make("output", baked.input + "_output", type_name(baked.type));
  document_.set(output, "nodename", node.name());
  document_.append(graph, output);
  Element& input = document_.add_input(*baked.node, baked.input, type_name(baked.type));
  document_.set(input, "nodegraph", graph.name());
  document_.set(input, "output", output.name());
}

Element& BakedInputs::graph_of(const BakedInput& baked) {
  Element*& graph = graph_of_node_[baked.node];
  if (graph == nullptr) {
    graph = &document_.make("nodegraph",
                            document_.free_name("NG_baked_" + std::string(baked.node->name())));
    graphs_.push_back(graph);
  }
  return *graph;
}

}  // namespace nacre::tool
