#include "examples/tool/bake/baked_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "jit/document/inheritance.h"
#include "jit/document/select.h"
#include "jit/graph/resolve/lenient.h"

namespace nacre::tool {

namespace {

namespace fs = std::filesystem;

Type type_of(const Element& port) {
  return parse_type(port.attribute("type")).value_or(Type::none);
}

bool is_color(Type type) { return type == Type::color3 || type == Type::color4; }

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

BakedDocument::BakedDocument(Document& source, const Definitions& definitions, bool lenient,
                             std::string folder, Diagnostics& diagnostics)
    : source_(source),
      definitions_(definitions),
      folder_(std::move(folder)),
      complaints_(diagnostics, lenient),
      inputs_(document_) {}

bool BakedDocument::add_material(const std::string& name) {
  const std::size_t errors = complaints_.diagnostics().error_count();
  const Element* material = source_.root().child(name);
  if (material != nullptr) copy_tree(*material);
  return complaints_.diagnostics().error_count() == errors;
}

/// Depth first, with a stack of its own: chains of closures are as long as documents.
void BakedDocument::copy_tree(const Element& material) {
  copy_of(material);
  while (!open_.empty()) {
    Open& open = open_.back();
    if (open.next < open.inputs.size()) {
      const Element& input = *open.inputs[open.next++];
      copy_input(input, *open.def, *open.copy);  // May open another.
      continue;
    }
    for (const Element& child : open.node->children()) {
      if (child.category() != "input") document_.append(*open.copy, document_.copy_of(child));
    }
    nodes_.push_back(open.copy);
    open_.pop_back();
  }
}

Element* BakedDocument::copy_of(const Element& node) {
  const auto known = copies_.find(&node);
  if (known != copies_.end()) return known->second;
  const NodeDef* def = find_nodedef(node, definitions_, complaints_.diagnostics(),
                                    complaints_.is_lenient() ? stands_for : nullptr);
  if (def == nullptr) return nullptr;
  uses_own_definitions_ = uses_own_definitions_ || &def->element->document() == &source_;
  Element& copy =
      document_.make(node.category(), document_.free_name(plain_name(element_path(node))));
  copies_.emplace(&node, &copy);
  for (const Attribute& attribute : node.attributes()) {
    const bool is_here = attribute.name == "name" || attribute.name == "inherit";
    if (!is_here) document_.set(copy, attribute.name, attribute.value);
  }
  open_.push_back({&node, def, &copy, find_inputs(node, complaints_.diagnostics())});
  return &copy;
}

void BakedDocument::copy_input(const Element& input, const NodeDef& def, Element& copy) {
  using Kind = Connection::Kind;
  Diagnostics said;
  Complaints complaints(said, complaints_.is_lenient());
  const Feed feed = find_feed(input, definitions_, complaints);
  const Kind kind = feed.connection.kind;
  const bool is_connected = kind == Kind::node || kind == Kind::output;
  // An interface without a value is no default of the node's.
  const bool is_open = kind == Kind::none && feed.port != &input;
  const Type type = type_of(input);
  if (is_numeric(type) && (is_connected || is_open)) {
    return add_job(input, feed, def, copy);  // Compiling it says what there is to say.
  }
  complaints_.add(said, input);
  if (is_open && is_text(type)) {
    document_.set(document_.add_input(copy, input.name(), type_name(type)), "value", "");
  }
  if (kind == Kind::value) return copy_value(input, *feed.port, copy);
  if (!is_connected) return;
  if (is_text(type) || is_array(type)) {
    complaints_.error("cannot-bake", input, "a texture holds no such value",
                      "a value, or a connection of a numeric type",
                      std::string(input.attribute("type")));
  } else {
    copy_closure(input, copy);
  }
}

void BakedDocument::copy_value(const Element& input, const Element& port, Element& copy) {
  Element& value = document_.add_input(copy, input.name(), input.attribute("type"));
  for (const Attribute& attribute : port.attributes()) {
    const bool counts =
        attribute.name == "value" || attribute.name == "unit" || attribute.name == "unittype";
    if (counts) document_.set(value, attribute.name, attribute.value);
  }
  const Type type = type_of(input);
  if (type == Type::filename) document_.set(value, "value", moved_file(port));
  // The copy has another root: what was inherited is said.
  const std::string_view space = port.inherited_attribute("colorspace");
  if ((is_color(type) || type == Type::filename) && !space.empty()) {
    document_.set(value, "colorspace", space);
  }
}

void BakedDocument::copy_closure(const Element& input, Element& copy) {
  const Feed feed = find_source_node(input, definitions_, complaints_);
  if (feed.connection.kind == Connection::Kind::invalid) return;
  if (feed.connection.kind != Connection::Kind::node) {
    complaints_.error("cannot-bake", *feed.port, "this leads to no node");
    return;
  }
  const Element& source = *feed.connection.target;
  const Element* below = copy_of(source);
  if (below == nullptr) return;
  Element& connection = document_.add_input(copy, input.name(), input.attribute("type"));
  document_.set(connection, "nodename", below->name());
  if (source.attribute("type") == "multioutput" && !feed.connection.output.empty()) {
    document_.set(connection, "output", feed.connection.output);
  }
}

void BakedDocument::add_job(const Element& input, const Feed& feed, const NodeDef& def,
                            Element& copy) {
  const bool is_open = feed.connection.kind == Connection::Kind::none;
  const Element& port = is_open ? *feed.reader : *feed.port;
  const Element& scope = scope_of(port);
  std::string name;
  int number = static_cast<int>(jobs_.size());
  do {
    name = fmt::format("baked_{}", number++);
  } while (scope.child(name) != nullptr);
  // An output of the source that gives what the input gets.
  Element& probe = source_.create_at("output", port);
  std::vector<Attribute> attributes{{"name", source_.intern(name)},
                                    {"type", input.attribute("type")}};
  for (std::string_view wanted : {"nodename", "nodegraph", "interfacename", "output"}) {
    if (port.has_attribute(wanted)) attributes.push_back({wanted, port.attribute(wanted)});
  }
  source_.set_attributes(probe, attributes);
  Document::set_name(probe, attributes[0].value);
  source_.append(const_cast<Element&>(scope), probe);

  Job& job = jobs_.emplace_back();
  job.request = element_path(probe);
  job.stem = fmt::format("{}.{}", copy.name(), input.name());
  if (feed.connection.kind == Connection::Kind::output) job.output = feed.connection.target;
  job.type = type_of(input);
  const NodeDefInput* declared = def.input(input.name());
  const std::string_view geomprop = declared != nullptr ? declared->defaultgeomprop : "";
  if (plane_axis(geomprop) != nullptr) job.frame = geomprop;
  job.source = fmt::format("{}|{}|{}", source_of(feed), type_name(job.type), job.frame);
  if (is_open) {
    for (std::size_t i = 2; i < attributes.size(); ++i) {
      job.source += fmt::format("|{}={}", attributes[i].name, attributes[i].value);
    }
  }
  job.node = &copy;
  job.input = input.name();
}

/// Names where a feed begins: an output that says what its texture is to be, else the node behind
/// it, else the graph that lacks what is asked for.
std::string BakedDocument::source_of(const Feed& feed) const {
  using Kind = Connection::Kind;
  const Connection* connection = &feed.connection;
  Feed behind;
  if (connection->kind == Kind::output) {
    const Element& output = *connection->target;
    for (const std::string_view said : {"width", "height", "bitdepth", "colorspace"}) {
      if (output.has_attribute(said)) return element_path(output);
    }
    Diagnostics ignored;
    Complaints complaints(ignored, complaints_.is_lenient());
    behind = find_feed(output, definitions_, complaints);
    if (behind.connection.kind != Kind::node) return element_path(output);
    connection = &behind.connection;
  }
  if (connection->kind == Kind::none) return element_path(scope_of(*feed.reader));
  return fmt::format("{}.{}", element_path(*connection->target), connection->output);
}

void BakedDocument::finish_source() { source_.build_index(); }

/// Geometry Extensions, "Reserved GeomProp Names".
void BakedDocument::add_tiles() {
  std::string numbers;
  for (const UdimTile& tile : tiles_) {
    if (!numbers.empty()) numbers += ',';
    numbers += tile.number();
  }
  Element& info = document_.make("geominfo", document_.free_name("baked_tiles"));
  document_.set(info, "geom", "/");
  Element& property = document_.make("geomprop", "udimset", "stringarray");
  document_.set(property, "value", numbers);
  document_.append(info, property);
  document_.append(document_.root(), info);
}

std::string BakedDocument::text() {
  if (uses_own_definitions_) copy_definitions();
  if (!tiles_.empty()) add_tiles();
  for (Element* graph : inputs_.graphs()) document_.append(document_.root(), *graph);
  for (Element* node : nodes_) document_.append(document_.root(), *node);
  return document_.text();
}

void BakedDocument::copy_definitions() {
  for (const Element& child : source_.root().children()) {
    if (!is_definition(child) && definitions_.implemented_by(child) == nullptr) continue;
    Element& copy = document_.copy_of(child);
    const std::string_view space = child.inherited_attribute("colorspace");
    if (!space.empty()) document_.set(copy, "colorspace", space);
    std::error_code error;
    const fs::path from = fs::absolute(source_.file_of(child), error).lexically_normal();
    const std::string folder = from.parent_path().lexically_relative(folder_).generic_string();
    document_.set(
        copy, "fileprefix",
        (folder == "." ? "" : folder + "/") + std::string(child.inherited_attribute("fileprefix")));
    document_.append(document_.root(), copy);
  }
}

/// A file name as it reads from the folder of the baked document.
std::string BakedDocument::moved_file(const Element& input) const {
  const std::string name(input.attribute("value"));
  if (name.empty()) return name;
  const fs::path file(std::string(input.inherited_attribute("fileprefix")) + name);
  if (file.is_absolute()) return file.string();
  std::error_code error;
  const fs::path there =
      fs::absolute(fs::path(input.document().file_of(input)).parent_path() / file, error)
          .lexically_normal();
  return there.lexically_relative(folder_).generic_string();
}

}  // namespace nacre::tool
