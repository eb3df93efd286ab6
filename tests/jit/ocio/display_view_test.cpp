// Views of a configuration's displays, against what its transforms say.
#include "jit/ocio/display_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace nacre {
namespace {

constexpr const char* displays = R"(
displays:
  Monitor:
    - !<View> {name: Raw, colorspace: light}
    - !<View> {name: Film, colorspace: film}
  Wall:
    - !<View> {name: Square, colorspace: square}
active_displays: [Monitor, Wall]
active_views: [Film, Raw, Square]
)";

constexpr const char* spaces = R"(
  - !<ColorSpace>
    name: film
    from_scene_reference: !<LogTransform> {base: 10}
  - !<ColorSpace>
    name: square
    from_scene_reference: !<ExponentTransform> {value: [2, 2, 2, 1]}
)";

class Views : public ::testing::Test {
 protected:
  /// A configuration whose space of the reference has further names and roles.
  std::string config(const std::string& roles, const std::string& names) {
    return folder_.write("config.ocio",
                         "ocio_profile_version: 2\nroles:\n  default: light\n" + roles + displays +
                             "colorspaces:\n  - !<ColorSpace>\n    name: light\n" + names + spaces);
  }
  std::string rec709() { return config("", "    aliases: [lin_rec709]\n"); }

  std::vector<float> seen(const std::string& file, const DisplayView::Names& names,
                          std::vector<float> rgb) {
    const auto view = load_display_view(file, names, diagnostics_);
    EXPECT_NE(view, nullptr) << diagnostics_.to_string();
    if (view != nullptr) view->apply(rgb);
    return rgb;
  }

  /// The code of the first error.
  std::string code(const std::string& file, const DisplayView::Names& names) {
    diagnostics_ = {};
    EXPECT_EQ(load_display_view(file, names, diagnostics_), nullptr);
    return diagnostics_.all().empty() ? "" : diagnostics_.all()[0].code;
  }

  TemporaryFolder folder_;
  Diagnostics diagnostics_;
};

void expect_near(const std::vector<float>& found, const std::vector<double>& expected,
                 double error) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], error) << i;
}

TEST_F(Views, AreWhatTheirTransformsSay) {
  const std::string file = rec709();
  const std::vector<float> rgb{0.001f, 0.18f, 1.f, 10.f, 1000.f, 0.5f};
  expect_near(seen(file, {"Monitor", "Raw"}, rgb), {0.001f, 0.18f, 1, 10, 1000, 0.5}, 0);
  expect_near(seen(file, {"Monitor", "Film"}, rgb),
              {-3, std::log10(0.18), 0, 1, 3, std::log10(0.5)}, 1e-5);
  expect_near(seen(file, {"Wall", "Square"}, {0.5f, 0.25f, 3.f}), {0.25, 0.0625, 9}, 1e-6);
  EXPECT_TRUE(seen(file, {"Wall", "Square"}, {}).empty());
}

TEST_F(Views, HaveDefaults) {
  const std::string file = rec709();
  const auto view = load_display_view(file, {}, diagnostics_);
  ASSERT_NE(view, nullptr) << diagnostics_.to_string();
  EXPECT_EQ(view->names().display, "Monitor");
  EXPECT_EQ(view->names().view, "Film");  // The first of active_views.
  const auto wall = load_display_view(file, {"Wall", ""}, diagnostics_);
  ASSERT_NE(wall, nullptr) << diagnostics_.to_string();
  EXPECT_EQ(wall->names().view, "Square");
}

// Linear Rec. 709 in ACES 2065-1, as the ACES configurations of OpenColorIO have it (their
// "sRGB to AP0", Bradford): columns of red, green and blue.
TEST_F(Views, ComeByTheRoleOfAces) {
  const std::string file = config("  aces_interchange: light\n  scene_linear: square\n", "");
  expect_near(seen(file, {"Monitor", "Raw"}, {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}),
              {0.439633, 0.089776, 0.017541, 0.382989, 0.813439, 0.111547, 0.177378, 0.096784,
               0.870912, 1, 1, 1},
              2e-5);
}

TEST_F(Views, ComeFromTheSceneWhereNothingElseIsSaid) {
  const std::string file = config("  scene_linear: light\n", "");
  expect_near(seen(file, {"Wall", "Square"}, {0.5f, 0.25f, 3.f}), {0.25, 0.0625, 9}, 1e-6);
}

TEST_F(Views, ThatThereAreNotAreErrors) {
  const std::string file = rec709();
  EXPECT_EQ(code(file, {"monitor", ""}), "unknown-display");
  EXPECT_EQ(diagnostics_.all()[0].expected, "'Monitor', 'Wall'");
  EXPECT_EQ(diagnostics_.all()[0].hint, "it differs only in case from 'Monitor'");
  EXPECT_EQ(code(file, {"", "Flim"}), "unknown-view");
  EXPECT_EQ(diagnostics_.all()[0].hint, "did you mean 'Film'?");
  EXPECT_EQ(code(file, {"Wall", "Film"}), "unknown-view");
  EXPECT_EQ(code(folder_.file("nowhere.ocio"), {}), "bad-color-config");
  EXPECT_EQ(code(folder_.write("bad.ocio", "ocio_profile_version: 2\ncolorspaces: x\n"), {}),
            "bad-color-config");
  EXPECT_EQ(code(config("", ""), {"Monitor", "Film"}), "no-view");
}

}  // namespace
}  // namespace nacre
