#include "tests/fuzz/changes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace nacre::fuzz {

namespace {

constexpr std::array<std::string_view, 32> odd_values{"",
                                                      " ",
                                                      "0",
                                                      "-1",
                                                      "1",
                                                      "2",
                                                      "0.5",
                                                      "1e-40",
                                                      "3.4e38",
                                                      "1e999",
                                                      "nan",
                                                      "inf",
                                                      "2147483647",
                                                      "-2147483649",
                                                      "99999999999999999999",
                                                      "true",
                                                      "false",
                                                      "0, 0, 0",
                                                      "1,2",
                                                      "1, 0, 0, 0",
                                                      "1,0,0,0,1,0,0,0,1",
                                                      "float",
                                                      "color3",
                                                      "surfaceshader",
                                                      "multioutput",
                                                      "material",
                                                      "none",
                                                      "../../../../etc/passwd",
                                                      "/dev/zero",
                                                      "&lt;UDIM&gt;",
                                                      "{{in}} + unknown",
                                                      "a/b/../c"};

constexpr std::array<std::string_view, 14> references{
    "nodename", "nodegraph", "output",   "interfacename",   "nodedef", "node",      "inherit",
    "name",     "implname",  "material", "defaultgeomprop", "target",  "lookgroup", "defaultinput"};

bool begins_word(std::string_view text, std::size_t at) {
  const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  return at == 0 || at == text.size() || is_word(text[at]) != is_word(text[at - 1]);
}

}  // namespace

Tree& Change::element() const {
  const auto elements = all_elements(root);
  // The root has attributes worth changing, but not every other time in a small document.
  return *elements[elements.size() > 1 && !random.one_in(30) ? 1 + random.below(elements.size() - 1)
                                                             : 0];
}

std::pair<Tree*, std::size_t> Change::place() const {
  std::vector<Tree*> parents = all_elements(root);
  std::erase_if(parents, [](const Tree* one) { return one->children.empty(); });
  if (parents.empty()) return {nullptr, 0};
  Tree* parent = random.pick(parents);
  return {parent, random.below(parent->children.size())};
}

std::string Change::some_name() const {
  const Tree& one = random.one_in(6) ? splicer.part(random, donor) : element();
  const std::string* name = one.find("name");
  return name != nullptr ? *name : one.category;
}

void Change::graft_attribute() const {
  Tree& target = element();
  const Tree& source = splicer.part_like(target.category, random, donor);
  if (source.attributes.empty()) return;
  const auto& [name, value] = random.pick(source.attributes);
  target.set(name, value);
}

void Change::known_value() const {
  Tree& target = element();
  if (target.attributes.empty()) return;
  auto& [name, value] = random.pick(target.attributes);
  const auto& values = splicer.values(name);
  value = random.pick(values);
}

void Change::odd_value() const {
  Tree& target = element();
  if (target.attributes.empty()) return;
  random.pick(target.attributes).second = random.pick(odd_values);
}

void Change::remove_attribute() const {
  Tree& target = element();
  if (target.attributes.empty()) return;
  target.attributes.erase(target.attributes.begin() +
                          static_cast<std::ptrdiff_t>(random.below(target.attributes.size())));
}

void Change::rename_attribute() const {
  Tree& target = element();
  if (target.attributes.empty()) return;
  const std::size_t i = random.below(target.attributes.size());
  const std::string& name = random.pick(splicer.attribute_names());
  if (target.find(name) == nullptr) target.attributes[i].first = name;
}

void Change::insert_part() const {
  const Tree part = splicer.part(random, donor);
  if (part.category == "materialx") {
    // All of a document: its definitions and what uses them.
    root.children.insert(root.children.end(), part.children.begin(), part.children.end());
    return;
  }
  auto [parent, at] = place();
  if (parent == nullptr || random.one_in(3)) parent = &root, at = root.children.size();
  parent->children.insert(parent->children.begin() + static_cast<std::ptrdiff_t>(at), part);
}

void Change::replace_part() const {
  const auto [parent, at] = place();
  if (parent == nullptr) return;
  Tree& old = parent->children[at];
  Tree fresh = splicer.part_like(old.category, random, donor);
  // Under the old name what refers to it goes on doing so.
  if (const std::string* name = old.find("name"); name != nullptr && !random.one_in(4)) {
    fresh.set("name", std::string(*name));
  }
  old = std::move(fresh);
}

void Change::remove_element() const {
  const auto [parent, at] = place();
  if (parent == nullptr) return;
  parent->children.erase(parent->children.begin() + static_cast<std::ptrdiff_t>(at));
}

void Change::repeat_element() const {
  const auto [from, at] = place();
  if (from == nullptr) return;
  Tree copy = from->children[at];
  if (!random.one_in(3)) copy.set("name", "copy" + std::to_string(random.below(4)));
  auto [to, where] = place();
  if (random.one_in(2)) to = from, where = at;
  to->children.insert(to->children.begin() + static_cast<std::ptrdiff_t>(where), std::move(copy));
}

void Change::refer() const {
  const std::string name = some_name();
  element().set(random.pick(references), name);
}

/// An input reads a node beside its own, of its own type: a document that goes on being right,
/// or has a circle.
void Change::connect() const {
  std::vector<std::pair<Tree*, Tree*>> inputs;  // scope and input
  for (Tree* scope : all_elements(root)) {
    for (Tree& node : scope->children) {
      for (Tree& input : node.children) {
        if (input.category == "input") inputs.emplace_back(scope, &input);
      }
    }
  }
  if (inputs.empty()) return;
  const auto [scope, input] = random.pick(inputs);
  const std::string* type = input->find("type");
  std::vector<const Tree*> fitting;
  for (const Tree& node : scope->children) {
    const std::string* other = node.find("type");
    if (type != nullptr && other != nullptr && *type == *other) fitting.push_back(&node);
  }
  const std::string* name = fitting.empty() ? nullptr : random.pick(fitting)->find("name");
  if (name == nullptr) return;
  std::erase_if(input->attributes, [](const auto& attribute) {
    return attribute.first == "value" || attribute.first == "interfacename" ||
           attribute.first == "nodegraph" || attribute.first == "output";
  });
  input->set("nodename", std::string(*name));
}

void Change::change_category() const {
  Tree& target = element();
  const auto& nodes = splicer.values("node");
  target.category = random.one_in(2) ? random.pick(splicer.categories()) : random.pick(nodes);
  if (target.category.empty() || !std::isalpha(static_cast<unsigned char>(target.category[0])) ||
      !std::all_of(target.category.begin(), target.category.end(), [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == ':';
      })) {
    target.category = "constant";
  }
}

/// A definition that takes the place of the library's, whole or with other ports.
void Change::steal_nodedef() const {
  if (splicer.library_nodedefs().empty()) return;
  const Tree& stolen = *random.pick(splicer.library_nodedefs());
  std::vector<Tree*> own = all_elements(root);
  std::erase_if(own, [](const Tree* one) {
    return one->category != "nodedef" && one->find("nodedef") == nullptr;
  });
  if (own.empty() || random.one_in(2)) {
    Tree copy = stolen;
    if (!copy.children.empty()) {
      Tree& port = random.pick(copy.children);
      const auto& types = splicer.values("type");
      if (random.one_in(2)) port.set("type", random.pick(types));
    }
    Tree use;
    use.category = stolen.find("node") != nullptr ? *stolen.find("node") : "constant";
    use.set("name", "stolen" + std::to_string(random.below(3)));
    const auto output = std::find_if(copy.children.begin(), copy.children.end(),
                                     [](const Tree& one) { return one.category == "output"; });
    const bool typed = output != copy.children.end() && output->find("type") != nullptr;
    use.set("type", typed ? *output->find("type") : "float");
    Tree out;
    out.category = "output";
    out.set("name", "stolen_out" + std::to_string(random.below(3)));
    out.set("type", *use.find("type"));
    out.set("nodename", *use.find("name"));
    root.children.push_back(std::move(copy));
    root.children.push_back(std::move(use));
    root.children.push_back(std::move(out));
    return;
  }
  Tree& definition = *random.pick(own);
  const std::string* name = stolen.find("name");
  const std::string* node = stolen.find("node");
  const bool is_nodedef = definition.category == "nodedef";
  if (name != nullptr) definition.set(is_nodedef ? "name" : "nodedef", *name);
  if (node != nullptr && is_nodedef && random.one_in(2)) definition.set("node", *node);
}

void Change::swap_values() const {
  Tree& a = element();
  Tree& b = element();
  if (a.attributes.empty() || b.attributes.empty()) return;
  auto& [name, value] = random.pick(a.attributes);
  for (auto& [other, old] : b.attributes) {
    if (other == name && &old != &value) return std::swap(old, value);
  }
  std::string& old = random.pick(b.attributes).second;
  if (&old != &value) std::swap(old, value);
}

/// The beginning of one text and the end of another, cut between words.
void Change::splice_text() const {
  std::vector<std::pair<const std::string*, std::string*>> texts;
  for (Tree* one : all_elements(root)) {
    for (auto& [name, value] : one->attributes) {
      const bool is_code = name == "sourcecode";
      if (is_code || value.size() > 4) texts.insert(texts.end(), is_code ? 20 : 1, {&name, &value});
    }
  }
  if (texts.empty()) return;
  const auto [name, text] = random.pick(texts);
  const auto& others = splicer.values(*name);
  const std::string& other = random.pick(others);
  std::size_t head = random.below(text->size() + 1);
  std::size_t tail = random.below(other.size() + 1);
  while (head > 0 && !begins_word(*text, head)) --head;
  while (tail < other.size() && !begins_word(other, tail)) ++tail;
  *text = text->substr(0, head) + other.substr(tail);
}

void Change::change_digit() const {
  Tree& target = element();
  for (auto& [name, value] : target.attributes) {
    if (name != "value" && name != "default" && name != "sourcecode") continue;
    std::vector<std::size_t> digits;
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (std::isdigit(static_cast<unsigned char>(value[i])) != 0) digits.push_back(i);
    }
    if (digits.empty()) continue;
    const std::size_t at = random.pick(digits);
    if (random.one_in(4)) value.insert(at, random.one_in(2) ? "e" : "99");
    value[at] = static_cast<char>('0' + random.below(10));
    return;
  }
}

void Change::apply() {
  switch (random.below(20)) {
    case 0:
    case 1: return graft_attribute();
    case 2:
    case 3: return known_value();
    case 4: return odd_value();
    case 5: return remove_attribute();
    case 6: return rename_attribute();
    case 7:
    case 8: return insert_part();
    case 9: return replace_part();
    case 10: return remove_element();
    case 11: return repeat_element();
    case 12:
    case 13: return refer();
    case 14: return connect();
    case 15: return change_category();
    case 16: return steal_nodedef();
    case 17: return swap_values();
    case 18: return splice_text();
    default: return change_digit();
  }
}

}  // namespace nacre::fuzz
