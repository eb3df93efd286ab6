#include "jit/graph/color/color_transforms.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "jit/document/read.h"
#include "jit/graph/color/colorspace.h"
#include "runtime/near_names.h"

namespace nacre {

ColorTransforms::ColorTransforms(const Document& document, const Definitions& definitions,
                                 const GraphOptions& options, Complaints& complaints)
    : definitions_(definitions),
      config_(options.colors),
      complaints_(complaints),
      working_space_(find_working_space(options, document)) {}

std::string find_working_space(const GraphOptions& options, const Document& document) {
  std::string name = options.working_space.value_or("");
  if (name.empty() && options.working_space) name = document.root().attribute("colorspace");
  if (!name.empty()) return name;
  const auto has = [&](const char* space) {
    return options.colors != nullptr && options.colors->find(space).has_value();
  };
  const bool reaches_rec709 = has("lin_rec709") || has("aces_interchange");
  return !reaches_rec709 && has("scene_linear") ? "scene_linear" : "lin_rec709";
}

// From one space to another, by the host's configuration, by the data library, or by
// what the spaces are; null where nothing is to be done.
ColorTransforms::Conversion ColorTransforms::find(Type type, std::string_view from,
                                                  std::string_view to, const Element& user) {
  if (type != Type::color3 && type != Type::color4) return {};
  if (from.empty() || to.empty()) return {};
  auto spaces = config_spaces(from, to);
  if (!spaces) {
    const std::string_view known_from = canonical_colorspace(from);
    const std::string_view known_to = canonical_colorspace(to);
    if (known_from.empty() || known_to.empty() || known_from == known_to) return {};
    if (const NodeDef* def = find_built_in(known_from, known_to, type)) return {def, false};
    spaces = bridged_spaces(from, to);
    if (!spaces) {
      const bool is_input = to == working_space_;
      if (complaints_.is_lenient() && is_input) {
        complaints_.tolerates(
            "unknown-colorspace", user, "there is no transform from this colour space",
            "its numbers are taken as they are",
            fmt::format("a space with a transform to {}", canonical_colorspace(to)),
            fmt::format("'{}'", from), near_space(from));
        return {};
      }
      report_none(from, to, user);
      return {nullptr, true};
    }
  }
  if (!spaces->differ()) return {};
  const NodeDef* def = find_in_config(*spaces, type, user);
  return {def, def == nullptr};
}

void ColorTransforms::report_none(std::string_view from, std::string_view to, const Element& user) {
  const bool is_output = from == working_space_;
  if (config_ == nullptr) {
    complaints_.error(
        "unknown-colorspace", user,
        fmt::format("there is no transform {} this colour space", is_output ? "to" : "from"),
        is_output ? fmt::format("a space with a transform from {}", canonical_colorspace(from))
                  : fmt::format("a space with a transform to {}", canonical_colorspace(to)),
        fmt::format("'{}'", is_output ? to : from), near_space(is_output ? to : from));
    return;
  }
  complaints_.error(
      "unknown-colorspace", user, "there is no transform between these colour spaces",
      fmt::format("two of {}, two built in, or one of each and its role aces_interchange",
                  config_->name()),
      fmt::format("'{}' to '{}'", from, to), near_space(is_known(from) ? to : from));
}

bool ColorTransforms::is_known(std::string_view space) const {
  const auto built_in = colorspace_names();
  return std::ranges::find(built_in, canonical_colorspace(space)) != built_in.end() ||
         (config_ != nullptr && config_->find(space).has_value());
}

std::string ColorTransforms::near_space(std::string_view name) const {
  if (is_known(name)) return {};
  std::vector<std::string> known;
  for (const std::string_view each : colorspace_names()) known.emplace_back(each);
  if (config_ != nullptr) std::ranges::copy(config_->names(), std::back_inserter(known));
  return near_hint(complaints_.diagnostics(), name, known);
}

const Definitions* ColorTransforms::definitions_of(const Element& element) const {
  for (const auto& [name, transform] : transforms_) {
    if (transform.document.get() == &element.document()) return transform.definitions.get();
  }
  return nullptr;
}

// The library's transform, or one made from what the spaces are.
const NodeDef* ColorTransforms::find_built_in(std::string_view from, std::string_view to,
                                              Type type) {
  const std::string transform = fmt::format("{}_to_{}", from, to);
  const std::string name = fmt::format("ND_{}_{}", transform, type_name(type));
  if (const NodeDef* def = definitions_.nodedef(name)) {
    const bool fits = !def->inputs.empty() && def->inputs[0].type == type &&
                      def->outputs.size() == 1 && def->outputs[0].type == type;
    return fits ? def : nullptr;
  }
  const auto [place, is_new] = transforms_.try_emplace(transform);
  Transform& made = place->second;
  if (is_new) {
    const std::string text = color_transform_text(from, to);
    if (text.empty()) return nullptr;
    Diagnostics none;
    made.document = read_document_text(text, transform, {}, none);
    made.definitions = std::make_unique<Definitions>(*made.document, &definitions_, none);
  }
  return made.definitions == nullptr ? nullptr : made.definitions->nodedef(name);
}

}  // namespace nacre
