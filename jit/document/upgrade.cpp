#include "jit/document/upgrade.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <optional>
#include <vector>

namespace nacre {

namespace {

constexpr int current_version = 139;

/// 1.38 is 138.
std::optional<int> parse_version(std::string_view text) {
  int major = 0;
  int minor = 0;
  const char* end = text.data() + text.size();
  const auto [dot, first_error] = std::from_chars(text.data(), end, major);
  if (first_error != std::errc{} || dot == end || *dot != '.') return std::nullopt;
  const auto [last, second_error] = std::from_chars(dot + 1, end, minor);
  if (second_error != std::errc{} || last != end) return std::nullopt;
  if (major < 0 || major > 1000 || minor < 0 || minor > 99) return std::nullopt;
  return major * 100 + minor;
}

// Categories whose meaning, name or ports changed in the step to `before`.
struct ChangedCategory {
  std::string_view category;
  int before;
};
constexpr std::array changed_categories = std::to_array<ChangedCategory>({
    {"arrayappend", 139},
    {"swizzle", 139},
    {"thin_film_bsdf", 139},
    {"atan2", 139},
    {"normalmap", 139},
    {"parameter", 138},
    {"shaderref", 138},
    {"bindinput", 138},
    {"bindparam", 138},
    {"bindtoken", 138},
    {"dielectric_brdf", 138},
    {"dielectric_btdf", 138},
    {"conductor_brdf", 138},
    {"sheen_brdf", 138},
    {"diffuse_brdf", 138},
    {"burley_diffuse_brdf", 138},
    {"diffuse_btdf", 138},
    {"subsurface_brdf", 138},
    {"generalized_schlick_brdf", 138},
    {"thin_film_brdf", 138},
    {"artistic_ior", 138},
    {"invert", 137},
    {"rotate", 137},
    {"compare", 137},
    {"transformpoint", 137},
    {"transformvector", 137},
    {"transformnormal", 137},
    {"combine", 137},
    {"separate", 137},
    {"geomattr", 137},
    {"geomattrvalue", 137},
    {"opgraph", 127},
    {"assign", 127},
});

std::optional<std::string> change_of_element(const Element& element, int version) {
  for (const ChangedCategory& changed : changed_categories) {
    if (element.category() == changed.category && version < changed.before) {
      return fmt::format("<{}>", element.category());
    }
  }
  if (version < 139 && element.has_attribute("channels")) return "attribute channels=";
  if (version < 139 && element.has_attribute("value") &&
      (element.has_attribute("nodename") || element.has_attribute("interfacename"))) {
    return "an input with both a value and a connection";
  }
  if (version < 139 && element.name() == "radius" && element.attribute("type") == "vector3" &&
      element.parent() != nullptr && element.parent()->category() == "subsurface_bsdf") {
    return "subsurface_bsdf radius of type vector3";
  }
  if (version < 138 && element.attribute("type") == "color2") return "type color2";
  if (version < 138 && element.category() == "material") return "<material>";
  if (version < 137 && element.category() == "nodedef" && element.has_attribute("type")) {
    return "nodedef with type=";
  }
  if (version < 136 && element.has_attribute("default")) return "attribute default=";
  if (version < 135 && element.attribute("type") == "matrix") return "type matrix";
  return std::nullopt;
}

// The element after this one in reading order, within `root`; null at the end.
const Element* next_in_order(const Element& root, const Element& element) {
  if (element.child_count() > 0) return &*element.children().begin();
  const Element* at = &element;
  while (at != &root && at->next() == nullptr) at = at->parent();
  return at == &root ? nullptr : at->next();
}

void report_changes(const Element& root, int version, std::string_view text,
                    Diagnostics& diagnostics) {
  for (const Element* at = &root; at != nullptr; at = next_in_order(root, *at)) {
    if (const auto change = change_of_element(*at, version)) {
      diagnostics.error("needs-upgrade", location(*at),
                        fmt::format("{} changed since version {} of the format", *change, text),
                        "a document of version 1.39");
    }
  }
}

}  // namespace

void upgrade(Document&, Element& root, Diagnostics& diagnostics) {
  const auto where = [&] { return location(root); };
  if (root.category() != "materialx") {
    diagnostics.error("not-materialx", where(), "this is not a MaterialX document",
                      "root element <materialx>", fmt::format("<{}>", root.category()));
    return;
  }
  const std::string_view text = root.attribute("version");
  if (text.empty()) {
    diagnostics.warning("missing-version", where(), "the document does not say its version",
                        "version=\"1.39\"");
    return;
  }
  const std::optional<int> version = parse_version(text);
  if (!version) {
    diagnostics.error("bad-version", where(), "the version cannot be understood",
                      "major.minor, such as 1.39", fmt::format("'{}'", text));
  } else if (*version > current_version) {
    diagnostics.warning("newer-version", where(),
                        "the document is of a version that is not known yet", "1.39 or older",
                        std::string(text));
  } else if (*version < current_version) {
    report_changes(root, *version, text, diagnostics);
  }
}

}  // namespace nacre
