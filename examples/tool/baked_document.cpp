#include "examples/tool/baked_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "examples/tool/closure_source.h"
#include "jit/document/select.h"
#include "jit/document/write.h"

namespace nacre::tool {

namespace {

namespace fs = std::filesystem;

Type type_of(const Element& port) {
  return parse_type(port.attribute("type")).value_or(Type::none);
}

bool is_color(Type type) { return type == Type::color3 || type == Type::color4; }

/// A vector of the surface's frame, as the plane has it; null for other inputs.
const std::array<float, 3>* plane_axis(std::string_view geomprop) {
  static constexpr std::array<float, 3> tangent{1, 0, 0}, bitangent{0, 1, 0}, normal{0, 0, 1};
  if (geomprop == "Nworld") return &normal;
  if (geomprop == "Tworld") return &tangent;
  return geomprop == "Bworld" ? &bitangent : nullptr;
}

/// The inputs of a node and of those it inherits from, its own first.
std::vector<const Element*> inputs_of(const Element& node) {
  std::vector<const Element*> inputs;
  const Element* at = &node;
  const std::size_t most = node.document().max_inheritance();
  for (std::size_t depth = 0; at != nullptr && depth < most; ++depth) {
    for (const Element& child : at->children()) {
      const auto same = [&](const Element* one) { return one->name() == child.name(); };
      if (child.category() == "input" && std::none_of(inputs.begin(), inputs.end(), same)) {
        inputs.push_back(&child);
      }
    }
    const std::string_view base = at->attribute("inherit");
    at = base.empty() ? nullptr : at->parent()->child(base);
  }
  return inputs;
}

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

std::string plain_name(std::string_view name) {
  std::string plain(name);
  for (char& c : plain) {
    if (c == ':' || c == '/') c = '_';
  }
  return plain;
}

/// Root elements that define what nodes mean.
bool is_definition(const Element& element) {
  constexpr auto categories =
      std::to_array<std::string_view>({"attributedef", "geompropdef", "implementation", "nodedef",
                                       "targetdef", "typedef", "unitdef", "unittypedef"});
  return std::find(categories.begin(), categories.end(), element.category()) != categories.end();
}

}  // namespace

BakedDocument::BakedDocument(Document& source, const Definitions& definitions, std::string folder,
                             Diagnostics& diagnostics)
    : source_(source),
      definitions_(definitions),
      folder_(std::move(folder)),
      diagnostics_(diagnostics),
      root_(&document_.create("materialx",
                              document_.add_file("baked", std::make_unique<char[]>(1), 0), 0)) {
  document_.set_root(*root_);
  set(*root_, "version", "1.39");
  set(*root_, "colorspace", "lin_rec709");
}

bool BakedDocument::add_material(const std::string& name) {
  const std::size_t errors = diagnostics_.error_count();
  const Element* material = source_.root().child(name);
  if (material != nullptr) copy_node(*material);
  return diagnostics_.error_count() == errors;
}

Element* BakedDocument::copy_node(const Element& node) {
  const auto known = copies_.find(&node);
  if (known != copies_.end()) return known->second;
  const NodeDef* def = find_nodedef(node, definitions_, diagnostics_);
  if (def == nullptr) return nullptr;
  uses_own_definitions_ = uses_own_definitions_ || &def->element->document() == &source_;
  Element& copy = make(node.category(), free_name(plain_name(element_path(node))), "");
  copies_.emplace(&node, &copy);
  for (const Attribute& attribute : node.attributes()) {
    const bool is_here = attribute.name == "name" || attribute.name == "inherit";
    if (!is_here) set(copy, attribute.name, attribute.value);
  }
  for (const Element* input : inputs_of(node)) copy_input(*input, *def, copy);
  for (const Element& child : node.children()) {
    if (child.category() != "input") document_.append(copy, copy_tree(child));
  }
  nodes_.push_back(&copy);
  return &copy;
}

void BakedDocument::copy_input(const Element& input, const NodeDef& def, Element& copy) {
  const Element* port = bound_port(input);
  if (port == nullptr) return;  // Nothing is bound: the default stays.
  const Type type = type_of(input);
  if (!is_connected(*port)) {
    if (port->has_attribute("value")) copy_value(input, *port, copy);
  } else if (is_numeric(type)) {
    add_job(input, *port, def, copy);
  } else if (is_text(type) || is_array(type)) {
    diagnostics_.error("cannot-bake", location(input), "a texture holds no such value",
                       "a value, or a connection of a numeric type",
                       std::string(input.attribute("type")));
  } else {
    copy_closure(input, *port, copy);
  }
}

void BakedDocument::copy_value(const Element& input, const Element& port, Element& copy) {
  Element& value = add_input(copy, input.name(), input.attribute("type"));
  for (const Attribute& attribute : port.attributes()) {
    const bool counts =
        attribute.name == "value" || attribute.name == "unit" || attribute.name == "unittype";
    if (counts) set(value, attribute.name, attribute.value);
  }
  const Type type = type_of(input);
  if (type == Type::filename) set(value, "value", moved_file(port));
  // The copy has another root: what was inherited is said.
  const std::string_view space = port.inherited_attribute("colorspace");
  if ((is_color(type) || type == Type::filename) && !space.empty()) {
    set(value, "colorspace", space);
  }
}

void BakedDocument::copy_closure(const Element& input, const Element& port, Element& copy) {
  const Element* source = source_node(port);
  if (source == nullptr) {
    diagnostics_.error("cannot-bake", location(port), "this leads to no node");
    return;
  }
  Element* below = copy_node(*source);
  if (below == nullptr) return;
  Element& connection = add_input(copy, input.name(), input.attribute("type"));
  set(connection, "nodename", below->name());
  if (source->attribute("type") == "multioutput" && port.has_attribute("output")) {
    set(connection, "output", port.attribute("output"));
  }
}

void BakedDocument::add_job(const Element& input, const Element& port, const NodeDef& def,
                            Element& copy) {
  const Element& scope = scope_of(port);
  std::string name;
  int number = static_cast<int>(jobs_.size());
  do {
    name = fmt::format("baked_{}", number++);
  } while (scope.child(name) != nullptr);
  // An output of the source that gives what the input gets.
  Element& probe = source_.create_at("output", port);
  std::vector<Attribute> attributes{{"name", source_.keep(name)},
                                    {"type", input.attribute("type")}};
  for (std::string_view wanted : {"nodename", "nodegraph", "output"}) {
    if (port.has_attribute(wanted)) attributes.push_back({wanted, port.attribute(wanted)});
  }
  source_.set_attributes(probe, attributes);
  Document::set_name(probe, attributes[0].value);
  source_.append(const_cast<Element&>(scope), probe);

  Job& job = jobs_.emplace_back();
  job.request = element_path(probe);
  job.stem = fmt::format("{}.{}", copy.name(), input.name());
  job.output = output_of(port);
  job.type = type_of(input);
  const NodeDefInput* declared = def.input(input.name());
  const std::string_view geomprop = declared != nullptr ? declared->defaultgeomprop : "";
  if (plane_axis(geomprop) != nullptr) job.frame = geomprop;
  job.source = fmt::format("{}|{}|{}", element_path(scope), type_name(job.type), job.frame);
  for (std::size_t i = 2; i < attributes.size(); ++i) {
    job.source += fmt::format("|{}={}", attributes[i].name, attributes[i].value);
  }
  job.node = &copy;
  job.input = input.name();
}

void BakedDocument::finish_source() { source_.build_index(); }

void BakedDocument::set_value(const Job& job, std::span<const float> texel,
                              std::string_view colorspace) {
  if (const std::array<float, 3>* axis = plane_axis(job.frame)) {
    if (std::equal(axis->begin(), axis->end(), texel.begin())) return;  // It is the default.
    Element& normalmap = add_node(job, "normalmap", "_direction", "vector3");
    const std::array<float, 3> coded{0.5f * texel[0] + 0.5f, 0.5f * texel[1] + 0.5f,
                                     0.5f * texel[2] + 0.5f};
    set(add_input(normalmap, "in", "vector3"), "value", value_text(job.type, coded));
    return connect(job, normalmap);
  }
  Element& input = add_input(*job.node, job.input, type_name(job.type));
  set(input, "value", value_text(job.type, texel));
  // As computed is as the root says.
  const bool is_tagged = is_color(job.type) && !colorspace.empty() && colorspace != "none" &&
                         colorspace != root_->attribute("colorspace");
  if (is_tagged) set(input, "colorspace", colorspace);
}

void BakedDocument::set_texture(const Job& job, const std::vector<std::string>& files,
                                std::string_view colorspace) {
  if (job.type == Type::matrix33 || job.type == Type::matrix44) {
    const std::string_view row_type = job.type == Type::matrix33 ? "vector3" : "vector4";
    std::vector<const Element*> rows;
    for (std::size_t i = 0; i < files.size(); ++i) {
      rows.push_back(&add_image(job, fmt::format("_row{}", i + 1), row_type, files[i], {}));
    }
    Element& matrix = add_node(job, "creatematrix", "_matrix", type_name(job.type));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      set(add_input(matrix, fmt::format("in{}", i + 1), row_type), "nodename", rows[i]->name());
    }
    return connect(job, matrix);
  }
  const bool is_whole = job.type == Type::boolean || job.type == Type::integer;
  Element& image =
      add_image(job, "_image", is_whole ? "float" : type_name(job.type), files.front(), colorspace);
  if (is_whole) {
    // Between texels there is nothing; half an 8-bit step is nothing either.
    set(add_input(image, "filtertype", "string"), "value", "closest");
    const bool is_boolean = job.type == Type::boolean;
    Element& whole =
        add_node(job, is_boolean ? "ifgreater" : "round", "_whole", type_name(job.type));
    set(add_input(whole, is_boolean ? "value1" : "in", "float"), "nodename", image.name());
    if (is_boolean) set(add_input(whole, "value2", "float"), "value", "0.5");
    return connect(job, whole);
  }
  if (job.frame.empty()) return connect(job, image);
  Element& normalmap = add_node(job, "normalmap", "_direction", "vector3");
  set(add_input(normalmap, "in", "vector3"), "nodename", image.name());
  connect(job, normalmap);
}

/// A node in the job's graph, called by its input.
Element& BakedDocument::add_node(const Job& job, std::string_view category,
                                 const std::string& suffix, std::string_view type) {
  Element& node = make(category, job.input + suffix, type);
  document_.append(graph_of(job), node);
  return node;
}

Element& BakedDocument::add_image(const Job& job, const std::string& suffix, std::string_view type,
                                  const std::string& file, std::string_view colorspace) {
  Element& image = add_node(job, "image", suffix, type);
  Element& name = add_input(image, "file", "filename");
  set(name, "value", file);
  if (!colorspace.empty()) set(name, "colorspace", colorspace);
  return image;
}

/// Geometry Extensions, "Reserved GeomProp Names".
void BakedDocument::add_tiles() {
  std::string numbers;
  for (const UdimTile& tile : tiles_) {
    if (!numbers.empty()) numbers += ',';
    numbers += tile.number();
  }
  Element& info = make("geominfo", free_name("baked_tiles"), "");
  set(info, "geom", "/");
  Element& property = make("geomprop", "udimset", "stringarray");
  set(property, "value", numbers);
  document_.append(info, property);
  document_.append(*root_, info);
}

std::string BakedDocument::text() {
  document_.take_children(*root_);
  if (uses_own_definitions_) copy_definitions();
  if (!tiles_.empty()) add_tiles();
  for (Element* graph : graphs_) document_.append(*root_, *graph);
  for (Element* node : nodes_) document_.append(*root_, *node);
  return write_document(document_);
}

void BakedDocument::copy_definitions() {
  std::vector<std::string_view> implementing;
  for (const Element& child : source_.root().children()) {
    if (child.category() == "implementation") implementing.push_back(child.attribute("nodegraph"));
  }
  for (const Element& child : source_.root().children()) {
    const bool implements =
        child.category() == "nodegraph" &&
        (child.has_attribute("nodedef") ||
         std::find(implementing.begin(), implementing.end(), child.name()) != implementing.end());
    if (!is_definition(child) && !implements) continue;
    Element& copy = copy_tree(child);
    const std::string_view space = child.inherited_attribute("colorspace");
    if (!space.empty()) set(copy, "colorspace", space);
    std::error_code error;
    const fs::path from = fs::absolute(source_.file_of(child), error).lexically_normal();
    const std::string folder = from.parent_path().lexically_relative(folder_).generic_string();
    set(copy, "fileprefix",
        (folder == "." ? "" : folder + "/") + std::string(child.inherited_attribute("fileprefix")));
    document_.append(*root_, copy);
  }
}

Element& BakedDocument::copy_tree(const Element& element) {
  Element& copy = document_.create(document_.keep(element.category()), 0, 0);
  for (const Attribute& attribute : element.attributes()) {
    set(copy, attribute.name, attribute.name == "name" ? element.name() : attribute.value);
  }
  for (const Element& child : element.children()) document_.append(copy, copy_tree(child));
  return copy;
}

Element& BakedDocument::make(std::string_view category, const std::string& name,
                             std::string_view type) {
  Element& element = document_.create(document_.keep(category), 0, 0);
  set(element, "name", name);
  if (!type.empty()) set(element, "type", type);
  return element;
}

Element& BakedDocument::add_input(Element& node, std::string_view name, std::string_view type) {
  Element& input = document_.create("input", 0, 0);
  set(input, "name", name);
  set(input, "type", type);
  document_.append(node, input);
  return input;
}

void BakedDocument::set(Element& element, std::string_view name, std::string_view value) {
  const std::string_view kept = document_.keep(value);
  document_.set_attribute(element, document_.keep(name), kept);
  if (name == "name") Document::set_name(element, kept);
}

/// Makes an output of the job's graph, and the input read it.
void BakedDocument::connect(const Job& job, const Element& node) {
  Element& graph = graph_of(job);
  Element& output = document_.create("output", 0, 0);
  set(output, "name", job.input + "_output");
  set(output, "type", type_name(job.type));
  set(output, "nodename", node.name());
  document_.append(graph, output);
  Element& input = add_input(*job.node, job.input, type_name(job.type));
  set(input, "nodegraph", graph.name());
  set(input, "output", output.name());
}

Element& BakedDocument::graph_of(const Job& job) {
  Element*& graph = graph_of_node_[job.node];
  if (graph == nullptr) {
    graph = &make("nodegraph", free_name("NG_baked_" + std::string(job.node->name())), "");
    graphs_.push_back(graph);
  }
  return *graph;
}

std::string BakedDocument::free_name(const std::string& wanted) {
  const int count = names_[wanted]++;
  return count == 0 ? wanted : free_name(fmt::format("{}_{}", wanted, count + 1));
}

/// A file name as it reads from the folder of the baked document.
std::string BakedDocument::moved_file(const Element& input) const {
  const std::string name(input.attribute("value"));
  if (name.empty()) return name;
  const fs::path file(std::string(input.inherited_attribute("fileprefix")) + name);
  if (file.is_absolute()) return file.string();
  std::error_code error;
  const fs::path there =
      fs::absolute(fs::path(source_.file_of(input)).parent_path() / file, error).lexically_normal();
  return there.lexically_relative(folder_).generic_string();
}

}  // namespace nacre::tool
