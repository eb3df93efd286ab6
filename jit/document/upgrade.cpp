#include "jit/document/upgrade.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <optional>

#include "jit/document/upgrade/steps.h"

namespace nacre {

namespace {

constexpr int oldest_version = 122;
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

struct Step {
  int to;
  void (*apply)(const upgrading::Upgrade& upgrade);
};

constexpr auto steps = std::to_array<Step>({{123, upgrading::upgrade_to_1_23},
                                            {124, upgrading::upgrade_to_1_24},
                                            {125, upgrading::upgrade_to_1_25},
                                            {126, upgrading::upgrade_to_1_26},
                                            {134, upgrading::upgrade_to_1_34},
                                            {135, upgrading::upgrade_to_1_35},
                                            {136, upgrading::upgrade_to_1_36},
                                            {137, upgrading::upgrade_to_1_37},
                                            {138, upgrading::upgrade_to_1_38},
                                            {139, upgrading::upgrade_to_1_39}});

void apply_steps(Document& document, Element& root, int version, Diagnostics& diagnostics) {
  upgrading::Upgrade upgrade(document, root, diagnostics);
  for (const Step& step : steps) {
    if (version >= step.to) continue;
    upgrade.find_nodedefs();
    step.apply(upgrade);
  }
  document.set_attribute(root, "version", "1.39");
}

}  // namespace

void upgrade(Document& document, Element& root, Diagnostics& diagnostics) {
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
  } else if (*version < oldest_version) {
    diagnostics.error("cannot-upgrade", where(), "the document is of a version that is too old",
                      "1.22 to 1.39", std::string(text));
  } else if (*version < current_version) {
    apply_steps(document, root, *version, diagnostics);
  }
}

}  // namespace nacre
