#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "jit/document/document.h"
#include "runtime/diagnostic.h"
#include "runtime/type.h"
#include "runtime/value.h"

// What a document says about geometry: MaterialX 1.39 Geometry Extensions.

namespace nacre {

/// Whom something is said of: geometry name expressions, geomprefix applied, joined
/// by commas; or a `<collection>`.
struct GeometryTarget {
  std::string geom;        ///< "/a/*, /b"; "" if only a collection is named.
  std::string collection;  ///< Name; "" if none is named.
};

/// One choice of a variant, for GraphOptions::variants.
struct VariantChoice {
  std::string variantset;  ///< Name of the set.
  std::string variant;     ///< Name of one of its variants.
};

/// A `<materialassign>`.
struct Assignment : GeometryTarget {
  std::string material;   ///< Name of a material node.
  bool exclusive = true;  ///< No other material shows through; see GeometryRules::materials_of.
  std::vector<VariantChoice> variants;  ///< For this material only.
};

/// A `<visibility>`: who can see the geometries, or not.
struct VisibilityAssignment : GeometryTarget {
  GeometryTarget viewer;  ///< Both empty: all viewers.
  std::string vistype;    ///< "camera", "illumination", "shadow", "secondary"; "" for all.
  bool visible = true;    ///< False hides them.
};

/// A `<propertyassign>`, or one `<property>` of an assigned `<propertyset>`.
struct PropertyAssignment : GeometryTarget {
  std::string property;  ///< "twosided", "matte", ...
  std::string target;    ///< "" for all renderers.
  Value value;           ///< Type none if it does not fit its type.
  std::string text;      ///< Type and value as the document has them: "integer '2'".
  SourceLocation where;  ///< Of the property.
};

/// Each list has inherited ones first, and then the order of the document: where
/// two say something of the same path, the later one wins.
struct Look {
  std::string name;                                ///< Of the look's element.
  std::vector<Assignment> assignments;             ///< What material is where.
  std::vector<VariantChoice> variants;             ///< For all its materials.
  std::vector<VisibilityAssignment> visibilities;  ///< What is hidden from whom.
  std::vector<PropertyAssignment> properties;      ///< What renderers are told besides.
};

/// All looks with what they inherit. Reports looks that inherit from nowhere or
/// in a circle.
std::vector<Look> find_looks(const Document& document, Diagnostics& diagnostics);

/// A `<lookgroup>`.
struct LookGroup {
  std::string name;                ///< Of its element.
  std::vector<std::string> looks;  ///< Groups within it resolved to their looks.
  std::string default_look;        ///< "" if it names none.
};
/// All groups, in document order. Looks that do not exist are left out.
std::vector<LookGroup> find_look_groups(const Document& document);

/// A `<variantset>`.
struct VariantSet {
  std::string name;  ///< As VariantChoice has it.
  /// What it is restricted to; "" if not.
  /// @{
  std::string node, nodedef;
  /// @}
  std::vector<std::string> variants;  ///< Names, in document order.
};
/// All sets, in document order.
std::vector<VariantSet> find_variant_sets(const Document& document);

/// A value that a `<geominfo>` gives a geometry.
struct GeometryValue {
  std::string name;  ///< Of the geometric property.
  Value value;       ///< Type none if it does not fit its type.
};

/// Answers what a document says of one geometry, by its full name "/a/b/c". What is
/// said of a path holds below it too, unless something is said of a place nearer to
/// the geometry. The document must outlive it.
class GeometryRules {
 public:
  /// Reports collections that include themselves.
  GeometryRules(const Document& document, Diagnostics& diagnostics);

  /// Length of the longest path, the geometry's own or one above, that is meant;
  /// nothing if none is. What is nearest to the geometry counts for more.
  std::optional<std::size_t> reach(const GeometryTarget& target, std::string_view geometry) const;

  /// The material on a geometry, or null. (Several that are not exclusive: the last.)
  const Assignment* material_of(const Look& look, std::string_view geometry) const;
  /// The same, and behind it those that it and the ones between, not being exclusive,
  /// let through for shaders that they lack.
  std::vector<const Assignment*> materials_of(const Look& look, std::string_view geometry) const;
  /// Whether the geometry is seen in rays of a `vistype`, as VisibilityAssignment has it, from the
  /// geometry `viewer`; "" is nobody in particular. What nothing is said of is visible.
  bool is_visible(const Look& look, std::string_view geometry, std::string_view vistype,
                  std::string_view viewer = {}) const;
  /// Who says it for this renderer, or null. `target`: its name, for target-specific ones.
  const PropertyAssignment* property_of(const Look& look, std::string_view geometry,
                                        std::string_view property,
                                        std::string_view target = {}) const;

  /// For GraphOptions::geometry_tokens: tokens of the geometry, and tokendefaults.
  std::map<std::string, std::string, std::less<>> tokens_of(std::string_view geometry) const;
  /// Uniform geometric properties of the geometry.
  std::vector<GeometryValue> geomprops_of(std::string_view geometry) const;

 private:
  struct Collection {
    std::string include, exclude;  ///< Expressions, geomprefix applied.
    std::vector<std::string> collections;
  };
  std::optional<std::size_t> reach_of_list(std::string_view list, std::string_view geometry) const;
  std::optional<std::size_t> reach_of_collection(const std::string& name, std::string_view geometry,
                                                 int depth) const;
  void check_circles(Diagnostics& diagnostics) const;

  const Document& document_;
  std::unordered_map<std::string, Collection> collections_;
  std::vector<std::pair<GeometryTarget, const Element*>> infos_;
};

}  // namespace nacre
