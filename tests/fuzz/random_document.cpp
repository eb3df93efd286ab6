#include "tests/fuzz/random_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "jit/document/definitions.h"
#include "tests/fuzz/host.h"

namespace nacre::fuzz {

namespace {

bool has_known_ports(const NodeDef& def) {
  const auto known = [](const auto& port) { return port.type != Type::none; };
  return !def.outputs.empty() && is_for_us(def.target) &&
         std::all_of(def.inputs.begin(), def.inputs.end(), known) &&
         std::all_of(def.outputs.begin(), def.outputs.end(), known);
}

const std::vector<const NodeDef*>& palette() {
  static const std::vector<const NodeDef*> defs = [] {
    std::vector<const NodeDef*> list = host().library().definitions().all();
    std::erase_if(list, [](const NodeDef* def) { return !has_known_ports(*def); });
    return list;
  }();
  return defs;
}

struct Producer {
  std::string node;
  std::string output;  ///< "" where the node has one only.
  Type type;
};

class Writer {
 public:
  explicit Writer(Bytes bytes) : bytes_(bytes), mutates_(bytes_.flip()) {}

  RandomDocument write() {
    text_ = "<materialx version=\"1.39\">\n";
    interface_count_ = bytes_.below(4);
    text_ += "<nodegraph name=\"G\">\n";
    for (std::uint32_t i = 0; i < interface_count_; ++i) {
      const Type type = interface_types[i];
      element("input", fmt::format("i{}", i), type_name(type),
              fmt::format("value=\"{}\"", value_of(type)));
    }
    const std::uint32_t nodes = 1 + bytes_.below(24);
    for (std::uint32_t i = 0; i < nodes; ++i) add_node(*pick_def(), fmt::format("n{}", i));
    write_outputs();
    text_ += "</nodegraph>\n";
    write_material();
    text_ += "</materialx>\n";
    return {text_, !mutated_};
  }

 private:
  static constexpr std::array interface_types{Type::float_, Type::color3, Type::vector2,
                                              Type::integer};

  const NodeDef* pick_def() {
    return palette()[bytes_.below(static_cast<std::uint32_t>(palette().size()))];
  }

  // One attribute list in eight comes out wrong, in a document that is to be.
  bool mutate() {
    const bool yes = mutates_ && bytes_.below(8) == 0;
    mutated_ = mutated_ || yes;
    return yes;
  }

  void element(std::string_view tag, std::string name, std::string_view type, std::string rest,
               bool closed = true) {
    std::string type_text(type);
    if (mutate()) break_something(name, type_text, rest);
    text_ += fmt::format("<{} name=\"{}\" type=\"{}\" {}{}>\n", tag, name, type_text, rest,
                         closed ? "/" : "");
  }

  void break_something(std::string& name, std::string& type, std::string& rest) {
    constexpr std::array<std::string_view, 8> values{"1e999", "",  "nan",  "1,2",
                                                     "\\,",   "-", "true", "&#x10FFFF;"};
    switch (bytes_.below(9)) {
      case 0: name = fmt::format("n{}", bytes_.below(8)); break;  // twice, perhaps
      case 1: name.clear(); break;
      case 2: type = "multioutput"; break;
      case 3: type = type_name(interface_types[bytes_.below(4)]); break;
      case 4: type = "surfaceshader"; break;
      case 5: rest = fmt::format("value=\"{}\"", values[bytes_.below(8)]); break;
      case 6: rest = fmt::format("nodename=\"n{}\"", bytes_.below(24)); break;  // a cycle, perhaps
      case 7: rest += fmt::format(" interfacename=\"i{}\"", bytes_.below(6)); break;
      default: rest = fmt::format("nodegraph=\"G\" output=\"o{}\"", bytes_.below(6)); break;
    }
  }

  void add_node(const NodeDef& def, const std::string& name) {
    element(def.category, name, def.instance_type(), fmt::format("nodedef=\"{}\"", def.name),
            false);
    for (const NodeDefInput& input : def.inputs) add_input(input);
    text_ += fmt::format("</{}>\n", def.category);
    const bool several = def.outputs.size() > 1;
    for (const NodeDefOutput& output : def.outputs) {
      producers_.push_back({name, several ? std::string(output.name) : "", output.type});
    }
  }

  void add_input(const NodeDefInput& input) {
    const std::uint32_t choice = bytes_.below(4);
    if (choice == 0) return;  // its default
    std::string binding;
    if (choice == 1 && !input.uniform) binding = interface_of(input.type);
    if (binding.empty() && choice >= 2 && !input.uniform) binding = connection_to(input.type);
    if (binding.empty()) {
      if (is_array(input.type) || !(is_numeric(input.type) || is_text(input.type))) return;
      binding = fmt::format("value=\"{}\"", input.enums.empty() || input.type != Type::string
                                                ? value_of(input.type)
                                                : std::string(pick(input.enums)));
    }
    element("input", std::string(input.name), input.type_text, binding);
  }

  std::string interface_of(Type type) {
    for (std::uint32_t i = 0; i < interface_count_; ++i) {
      if (interface_types[i] == type) return fmt::format("interfacename=\"i{}\"", i);
    }
    return {};
  }

  std::string connection_to(Type type) {
    std::vector<const Producer*> fitting;
    for (const Producer& producer : producers_) {
      if (producer.type == type) fitting.push_back(&producer);
    }
    if (fitting.empty()) return {};
    const Producer& source = *pick(fitting);
    std::string text = fmt::format("nodename=\"{}\"", source.node);
    if (!source.output.empty()) text += fmt::format(" output=\"{}\"", source.output);
    return text;
  }

  template <class T>
  const T& pick(const std::vector<T>& list) {
    return list[bytes_.below(static_cast<std::uint32_t>(list.size()))];
  }

  std::string value_of(Type type) {
    if (type == Type::boolean) return bytes_.flip() ? "true" : "false";
    if (type == Type::integer) return fmt::format("{}", static_cast<int>(bytes_.byte()) - 8);
    if (is_text(type)) return bytes_.flip() ? "" : "nowhere.png";
    std::string text;
    for (int i = 0; i < component_count(type); ++i) text += (i > 0 ? ", " : "") + number();
    return text;
  }

  std::string number() {
    constexpr std::array<std::string_view, 8> edges{"0",     "1",    "-1",     "0.5",
                                                    "1e-40", "3e38", "-1e-12", "65536.5"};
    const std::uint32_t byte = bytes_.byte();
    if (byte < edges.size()) return std::string(edges[byte]);
    return fmt::format("{}", static_cast<float>(byte) / 64.0f - 1.0f);
  }

  void write_outputs() {
    for (std::uint32_t i = 0; i < 4 && !producers_.empty(); ++i) {
      const Producer& source =
          producers_[bytes_.below(static_cast<std::uint32_t>(producers_.size()))];
      std::string rest = fmt::format("nodename=\"{}\"", source.node);
      if (!source.output.empty()) rest += fmt::format(" output=\"{}\"", source.output);
      element("output", fmt::format("o{}", i), type_name(source.type), rest);
      if (source.type == Type::surfaceshader) shader_ = fmt::format("o{}", i);
      if (source.type == Type::color3) colour_ = fmt::format("o{}", i);
    }
  }

  void write_material() {
    if (shader_.empty() && colour_.empty()) return;
    std::string from = fmt::format("nodegraph=\"G\" output=\"{}\"", shader_);
    if (shader_.empty()) {
      element("standard_surface", "S", "surfaceshader", "", false);
      element("input", "base_color", "color3",
              fmt::format("nodegraph=\"G\" output=\"{}\"", colour_));
      text_ += "</standard_surface>\n";
      from = "nodename=\"S\"";
    }
    element("surfacematerial", "M", "material", "", false);
    element("input", "surfaceshader", "surfaceshader", from);
    text_ += "</surfacematerial>\n";
  }

  Bytes bytes_;
  bool mutates_;
  bool mutated_ = false;
  std::uint32_t interface_count_ = 0;
  std::string text_;
  std::string shader_;
  std::string colour_;
  std::vector<Producer> producers_;
};

}  // namespace

RandomDocument random_document(Bytes bytes) { return Writer(bytes).write(); }

}  // namespace nacre::fuzz
