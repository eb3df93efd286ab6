#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "jit/document/definitions.h"
#include "jit/graph/color/color_config.h"
#include "jit/graph/complaints.h"
#include "jit/graph/graph.h"
#include "jit/graph/options.h"
#include "runtime/type.h"

namespace nacre {

/// Finds the nodedefs that turn colours of one space into those of another: by the host's
/// configuration, by the data library, or made here from what the spaces are (Specification,
/// "Color Spaces and Color Management Systems").
class ColorTransforms {
 public:
  /// All must outlive it.
  ColorTransforms(const Document& document, const Definitions& definitions,
                  const GraphOptions& options, Complaints& complaints);

  /// Whether it is the standard's or the configuration's.
  bool is_known(std::string_view space) const;
  /// What will have been meant by a space that is not known.
  std::string near_space(std::string_view name) const;

  /// See find_working_space.
  const std::string& working_space() const { return working_space_; }

  struct Conversion {
    const NodeDef* nodedef = nullptr;  ///< Null: nothing is to be done, or it failed.
    bool failed = false;               ///< Said of `user`.
  };
  Conversion find(Type type, std::string_view from, std::string_view to, const Element& user);

  /// Definitions of the document that an element is in, if that was made here; else null.
  const Definitions* definitions_of(const Element& element) const;
  /// The text that implements a nodedef of the configuration's; nothing for another.
  std::optional<NodeText> text_of(const NodeDef& def) const;
  bool has_source(const NodeDef& def) const { return transform_of(def) != nullptr; }

 private:
  struct ConfigSpaces {
    ColorConfig::Space from, to;
    /// Built-in spaces on the other side of `from` or of `to`, which then is the space
    /// of ACES 2065-1; "": none.
    std::string before, after;

    bool differ() const;
  };
  /// A document made here, with the nodedefs of one transform.
  struct Transform {
    std::unique_ptr<Document> document;
    std::unique_ptr<Definitions> definitions;
    std::shared_ptr<const ColorTransform> color;  ///< Of a configuration; null: see `fault`.
    ConfigSpaces spaces;
    std::string name;
    std::string fault;
    SourceLocation where;
  };

  const NodeDef* find_built_in(std::string_view from, std::string_view to, Type type);
  // Of the host's configuration (config_transform.cpp).
  std::optional<ConfigSpaces> config_spaces(std::string_view from, std::string_view to) const;
  std::optional<ConfigSpaces> bridged_spaces(std::string_view from, std::string_view to) const;
  const NodeDef* find_in_config(const ConfigSpaces& spaces, Type type, const Element& user);
  const Transform* transform_of(const NodeDef& def) const;
  void report_none(std::string_view from, std::string_view to, const Element& user);

  const Definitions& definitions_;
  const std::shared_ptr<const ColorConfig> config_;
  Complaints& complaints_;
  const std::string working_space_;
  /// By "from_to_to"; without a document: not known. Those of the configuration by
  /// "before\nfrom\nto\nafter".
  std::map<std::string, Transform, std::less<>> transforms_;
};

/// The working space that the options mean for a document, by the name that says so.
std::string find_working_space(const GraphOptions& options, const Document& document);

}  // namespace nacre
