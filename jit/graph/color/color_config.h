#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "jit/graph/text_table.h"

namespace nacre {

/// How colours of one space become those of another.
struct ColorTransform {
  /// In the GLSL subset of jit/glsl; defines `vec4 function(vec4 rgba)`. A colour
  /// without alpha is transformed with alpha 1.
  std::string text;
  std::string function;           ///< Its name in the text.
  std::vector<TextTable> tables;  ///< What the text declares as uniform samplers.
};

/// Colour spaces that somebody else defines: an OpenColorIO configuration
/// (jit/ocio/ocio_config.h) or a host's own. Members may be called from any thread.
class ColorConfig {
 public:
  /// One colour space.
  struct Space {
    std::string name;      ///< The space's own, for whatever name it was found by.
    bool is_data = false;  ///< Numbers that are no colours; they are never converted.
  };

  virtual ~ColorConfig() = default;

  /// For diagnostics: the file's name.
  virtual std::string name() const = 0;
  /// The space of that name, alias or role. Asked for by us, not by documents, are
  /// "lin_rec709", "scene_linear" and "aces_interchange", which is to be ACES 2065-1.
  virtual std::optional<Space> find(std::string_view name) const = 0;
  /// Names of spaces, for hints; none where they are not known.
  virtual std::vector<std::string> names() const { return {}; }
  /// Between two spaces' own names. Null, with the reason in `fault`, where there is
  /// none or it cannot be had.
  virtual std::shared_ptr<const ColorTransform> transform(const std::string& from,
                                                          const std::string& to,
                                                          std::string& fault) const = 0;
};

}  // namespace nacre
