#pragma once

#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "examples/tool/udim.h"
#include "jit/document/definitions.h"
#include "jit/document/document.h"
#include "runtime/diagnostic.h"

namespace nacre::tool {

/// A copy of materials in which textures stand for the graphs that feed them: of
/// each material node, the shaders and closures that it leads to, with values as
/// they are and every connected number an image of a graph NG_baked_<node>.
///
/// Inputs whose default is the surface's normal, tangent or bitangent hold a
/// direction; it is baked on the plane, whose frame is the identity, and comes
/// back through a normalmap node, so that it follows any other surface's frame.
class BakedDocument {
 public:
  /// One input to bake.
  struct Job {
    std::string request;  ///< The output of the source document that gives it.
    /// Equal for inputs that one port feeds in the same way: they get the same.
    std::string source;
    std::string stem;                 ///< A name for its file: "SR_marble.base_color".
    const Element* output = nullptr;  ///< The <output> it comes from, if there is one.
    Type type = Type::none;
    /// "Nworld", "Tworld" or "Bworld" for a direction.
    std::string_view frame;
    Element* node = nullptr;  ///< The copy that has the input.
    std::string input;
  };

  /// `source` gets an <output> for every job, and must outlive this.
  BakedDocument(Document& source, const Definitions& definitions, std::string folder,
                Diagnostics& diagnostics);

  /// Copies a material; false after an error.
  bool add_material(const std::string& name);
  /// Call after the last material, before the first job is compiled.
  void finish_source();
  const std::vector<Job>& jobs() const { return jobs_; }

  /// Finishes a job whose texels are all alike, colours in the space given.
  void set_value(const Job& job, std::span<const float> texel, std::string_view colorspace);
  /// Finishes a job with a texture, of a matrix one for every row, tagged with the colour
  /// space given, if any. Textures of booleans and integers are read texel by texel.
  void set_texture(const Job& job, const std::vector<std::string>& files,
                   std::string_view colorspace);
  /// The tiles that textures with <UDIM> in their names have: the document's udimset.
  void set_tiles(const std::vector<UdimTile>& tiles) { tiles_ = tiles; }

  /// The XML, once all jobs are finished.
  std::string text();

 private:
  Element* copy_node(const Element& node);
  void copy_input(const Element& input, const NodeDef& def, Element& copy);
  void copy_value(const Element& input, const Element& port, Element& copy);
  void copy_closure(const Element& input, const Element& port, Element& copy);
  void add_job(const Element& input, const Element& port, const NodeDef& def, Element& copy);
  void copy_definitions();
  Element& copy_tree(const Element& element);

  Element& make(std::string_view category, const std::string& name, std::string_view type);
  Element& add_input(Element& node, std::string_view name, std::string_view type);
  void set(Element& element, std::string_view name, std::string_view value);
  Element& add_node(const Job& job, std::string_view category, const std::string& suffix,
                    std::string_view type);
  Element& add_image(const Job& job, const std::string& suffix, std::string_view type,
                     const std::string& file, std::string_view colorspace);
  void add_tiles();
  void connect(const Job& job, const Element& node);
  Element& graph_of(const Job& job);
  std::string free_name(const std::string& wanted);
  std::string moved_file(const Element& input) const;

  Document& source_;
  const Definitions& definitions_;
  std::string folder_;
  Diagnostics& diagnostics_;
  Document document_;
  Element* root_;
  std::vector<Job> jobs_;
  std::vector<Element*> nodes_;  ///< Copies, sources before readers.
  std::vector<Element*> graphs_;
  std::unordered_map<const Element*, Element*> copies_;
  std::unordered_map<const Element*, Element*> graph_of_node_;
  std::unordered_map<std::string, int> names_;
  bool uses_own_definitions_ = false;
  std::vector<UdimTile> tiles_;
};

}  // namespace nacre::tool
