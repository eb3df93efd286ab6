#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "jit/document/upgrade/scope.h"
#include "jit/document/upgrade/steps.h"

namespace nacre::upgrading {

namespace {

struct Channels {
  std::string_view type;
  int count;
  std::string_view letters;  ///< In order; outputs of separate are called by them.
};

constexpr auto channel_types = std::to_array<Channels>({{"float", 1, "x"},
                                                        {"vector2", 2, "xy"},
                                                        {"vector3", 3, "xyz"},
                                                        {"vector4", 4, "xyzw"},
                                                        {"color3", 3, "rgb"},
                                                        {"color4", 4, "rgba"}});

const Channels* channels_of(std::string_view type) {
  for (const Channels& channels : channel_types) {
    if (channels.type == type) return &channels;
  }
  return nullptr;
}

bool is_constant(char letter) { return letter == '0' || letter == '1'; }

int index_of(char letter) {
  constexpr std::string_view colors = "rgba";
  constexpr std::string_view axes = "xyzw";
  const std::size_t at = std::min(colors.find(letter), axes.find(letter));
  return at == std::string_view::npos ? 0 : static_cast<int>(at);
}

/// One swizzle node on its way to what replaces it.
struct Swizzle {
  Element& node;
  Element* in;
  const Channels& from;
  const Channels& to;
  std::string letters;  ///< As many as `to` has; what was missing is the first channel.

  bool all_constant() const { return letters.find_first_not_of("01") == std::string::npos; }
  /// One number, or all channels in their order.
  bool is_conversion() const {
    if (&from == &to) return false;
    if (from.count == 1) {
      return letters.find_first_not_of("rx") == std::string::npos && !letters.empty();
    }
    return (letters.size() == 3 && (letters == "rgb" || letters == "xyz") && from.count >= 3) ||
           ((letters == "rgba" || letters == "xyzw") && from.count == 4);
  }
};

/// A value is rearranged here and now, unless a colour transform comes first.
bool can_fold(const Swizzle& swizzle) {
  if (swizzle.all_constant() || swizzle.in == nullptr) return true;
  if (is_connected(*swizzle.in)) return false;
  const bool is_color = swizzle.from.type.starts_with("color");
  const std::string_view space = swizzle.in->inherited_attribute("colorspace");
  return !is_color || space.empty() || space == "none" || space == "lin_rec709";
}

void set_node(const Upgrade& upgrade, const Swizzle& swizzle, const std::string& category,
              const std::string& nodedef) {
  rename_nodedef(upgrade, swizzle.node, nodedef);
  Document::set_category(swizzle.node, upgrade.document.intern(category));
}

/// Numbers stand between commas or blanks.
std::vector<std::string_view> split_numbers(std::string_view text) {
  constexpr std::string_view separators = ", \t\n\r";
  std::vector<std::string_view> numbers;
  std::size_t begin = text.find_first_not_of(separators);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    numbers.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(separators, end);
  }
  return numbers;
}

void make_constant(const Upgrade& upgrade, const Swizzle& swizzle) {
  const std::string_view text =
      swizzle.in != nullptr ? swizzle.in->attribute("value") : std::string_view();
  const std::vector<std::string_view> numbers = split_numbers(text);
  std::string value;
  for (char letter : swizzle.letters) {
    if (!value.empty()) value += ", ";
    const auto index = static_cast<std::size_t>(index_of(letter));
    if (is_constant(letter)) {
      value += letter;
    } else {
      value += index < numbers.size() ? numbers[index] : "0";
    }
  }
  Document& document = upgrade.document;
  set_node(upgrade, swizzle, "constant", fmt::format("ND_constant_{}", swizzle.to.type));
  Element& input = add_input(document, swizzle.node, "value", swizzle.to.type,
                             swizzle.in != nullptr ? *swizzle.in : swizzle.node);
  set_kept(document, input, "value", value);
  if (swizzle.in != nullptr) remove_child(document, swizzle.node, *swizzle.in);
}

void make_extract(const Upgrade& upgrade, const Swizzle& swizzle) {
  if (swizzle.from.count == 1) {
    set_node(upgrade, swizzle, "dot", "ND_dot_float");
    return;
  }
  set_node(upgrade, swizzle, "extract", fmt::format("ND_extract_{}", swizzle.from.type));
  Element& index = add_input(upgrade.document, swizzle.node, "index", "integer", swizzle.node);
  set_kept(upgrade.document, index, "value", std::to_string(index_of(swizzle.letters[0])));
}

Element& add_component(const Upgrade& upgrade, const Swizzle& swizzle, std::size_t index) {
  return add_input(upgrade.document, swizzle.node, fmt::format("in{}", index + 1), "float",
                   *swizzle.in);
}

void make_combine(const Upgrade& upgrade, const Swizzle& swizzle, Scope& scope) {
  Document& document = upgrade.document;
  const std::string category = fmt::format("combine{}", swizzle.to.count);
  set_node(upgrade, swizzle, category, fmt::format("ND_{}_{}", category, swizzle.to.type));
  Element* separate = nullptr;
  if (swizzle.from.count > 1) {
    separate = &scope.add_node(fmt::format("separate{}", swizzle.from.count), "separate",
                               "multioutput", swizzle.node);
    copy_binding(document, *swizzle.in,
                 add_input(document, *separate, "in", swizzle.from.type, *swizzle.in));
  }
  for (std::size_t i = 0; i < swizzle.letters.size(); ++i) {
    const char letter = swizzle.letters[i];
    Element& component = add_component(upgrade, swizzle, i);
    if (is_constant(letter)) {
      set_kept(document, component, "value", std::string(1, letter));
    } else if (separate == nullptr) {
      copy_binding(document, *swizzle.in, component);
    } else {
      const auto index = static_cast<std::size_t>(index_of(letter)) % swizzle.from.letters.size();
      document.set_attribute(component, "nodename", separate->name());
      set_kept(document, component, "output", std::string("out") + swizzle.from.letters[index]);
    }
  }
  remove_child(document, swizzle.node, *swizzle.in);
}

void replace(const Upgrade& upgrade, Scope& scope, Element& node) {
  Document& document = upgrade.document;
  Element* in = input_of(node, "in");
  Element* letters = input_of(node, "channels");
  const Channels* from = channels_of(in != nullptr ? in->attribute("type") : "float");
  const Channels* to = channels_of(node.attribute("type"));
  if (from == nullptr || to == nullptr) {
    cannot_upgrade(upgrade, node, "a swizzle between these types cannot be replaced",
                   "float, a vector or a colour");
    return;
  }
  if (letters != nullptr && is_connected(*letters)) {
    cannot_upgrade(upgrade, *letters, "the channels of a swizzle are not known beforehand",
                   "a value");
    return;
  }
  Swizzle swizzle{node, in, *from, *to,
                  std::string(letters != nullptr ? letters->attribute("value") : "")};
  swizzle.letters.resize(static_cast<std::size_t>(to->count), from->letters[0]);
  if (letters != nullptr) remove_child(document, node, *letters);
  if (can_fold(swizzle)) {
    make_constant(upgrade, swizzle);
  } else if (to->count == 1) {
    make_extract(upgrade, swizzle);
  } else if (swizzle.is_conversion()) {
    set_node(upgrade, swizzle, "convert", fmt::format("ND_convert_{}_{}", from->type, to->type));
  } else {
    make_combine(upgrade, swizzle, scope);
  }
}

}  // namespace

void replace_swizzle(const Upgrade& upgrade) {
  for (Element* graph : graphs_of(upgrade.root)) {
    Scope scope(upgrade.document, *graph);
    for (Element* node : scope.children()) {
      if (node->category() != "swizzle" || has_own_nodedef(upgrade, *node)) continue;
      replace(upgrade, scope, *node);
    }
    scope.finish();
  }
}

}  // namespace nacre::upgrading
