#pragma once

#include <gtest/gtest.h>

#include <string>

#include "examples/render/load_scene.h"
#include "tests/examples/render/scene_samples.h"
#include "tests/support/temporary_folder.h"

namespace nacre::host {

/// Reads cards (scene_samples.h) from a folder of its own.
class Card : public ::testing::Test {
 protected:
  /// `data`: the file "card.bin".
  Scene load(const std::string& text, const std::string& data, const Shutter& shutter = {},
             const SceneLimits& limits = {}, const SceneLooks& looks = {}) {
    folder_.write("card.bin", data);
    diagnostics_ = {};
    return load_scene(folder_.write("a.gltf", text), limits, diagnostics_, shutter, looks);
  }
  /// Code and path of what was said first.
  std::string first() const {
    if (diagnostics_.all().empty()) return "";
    const Diagnostic& d = diagnostics_.all().front();
    return d.code + ' ' + d.where.path;
  }

  TemporaryFolder folder_;
  Diagnostics diagnostics_;
};

inline void expect_at(Vec3 a, Vec3 b) {
  EXPECT_LT(length(a - b), 1e-5f) << a.x << ' ' << a.y << ' ' << a.z;
}

}  // namespace nacre::host
