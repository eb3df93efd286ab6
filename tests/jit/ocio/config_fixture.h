#pragma once

#include <OpenColorIO/OpenColorIO.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "jit/shading/shading_system.h"
#include "tests/support/temporary_folder.h"

namespace nacre {

using Rgba = std::array<float, 4>;

/// A configuration of the test's own in a folder of its own, its spaces converted by
/// our engines and by OpenColorIO's processor for the CPU.
class Config : public ::testing::Test {
 protected:
  using Spaces = std::vector<std::pair<std::string, OCIO_NAMESPACE::ConstTransformRcPtr>>;

  /// Opens a configuration with a space "linear" and these, each by its transform to
  /// it; tables are files in the folder.
  void open(const Spaces& spaces);
  /// Opens the text of a configuration.
  void open_text(const std::string& text);

  /// Opaque colours for every component: special values against each other, then random
  /// ones over many orders of magnitude, and over [0, 1].
  static std::vector<Rgba> colors();

  /// The colours of one space in another as our engine has them, color4.
  std::vector<Rgba> convert(const std::vector<Rgba>& colors, const std::string& from,
                            const std::string& to, Backend backend);
  /// As OpenColorIO's processor for the CPU has them, without its approximations.
  std::vector<Rgba> oracle(const std::vector<Rgba>& colors, const std::string& from,
                           const std::string& to) const;

  /// The graph of a colour written in `from`, a live or frozen value, in space `to`.
  std::optional<Graph> graph_of(const std::string& type, const std::string& from,
                                const std::string& to);

  /// Compares all engines with the oracle. Errors count in units of the largest of 1 and
  /// the components of the expected colour and the colour given.
  void expect_agreement(const std::vector<Rgba>& colors, const std::string& from,
                        const std::string& to, double error);

  TemporaryFolder folder_;
  Diagnostics diagnostics_;
  std::unique_ptr<ShadingSystem> system_;
  OCIO_NAMESPACE::ConstConfigRcPtr config_;
};

}  // namespace nacre
