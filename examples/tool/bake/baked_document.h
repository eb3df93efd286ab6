#pragma once

#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "examples/tool/bake/baked_inputs.h"
#include "examples/tool/bake/udim.h"
#include "examples/tool/new_document.h"
#include "jit/document/definitions.h"
#include "jit/document/document.h"
#include "jit/graph/resolve/feed.h"
#include "runtime/diagnostic.h"

namespace nacre::tool {

/// A copy of materials in which textures stand for the graphs that feed them: of
/// each material node, the shaders and closures that it leads to, with values as
/// they are and every connected number an image of a graph NG_baked_<node>.
///
/// Inputs whose default is the surface's normal, tangent or bitangent hold a direction; it is
/// baked as the frame of the surface has it; the plane's is the identity.
class BakedDocument {
 public:
  /// One input to bake.
  struct Job : BakedInput {
    std::string request;  ///< The output of the source document that gives it.
    /// Equal for inputs that one port feeds in the same way: they get the same.
    std::string source;
    std::string stem;                 ///< A name for its file: "SR_marble.base_color".
    const Element* output = nullptr;  ///< The <output> it comes from, if there is one.
  };

  /// `source` gets an <output> for every job, and must outlive this; it is read as strictly
  /// as GraphOptions::lenient says.
  BakedDocument(Document& source, const Definitions& definitions, bool lenient, std::string folder,
                Diagnostics& diagnostics);

  /// Copies a material; false after an error.
  bool add_material(const std::string& name);
  /// Call after the last material, before the first job is compiled.
  void finish_source();
  const std::vector<Job>& jobs() const { return jobs_; }

  /// Finishes a job, see BakedInputs.
  void set_value(const Job& job, std::span<const float> texel, std::string_view colorspace) {
    inputs_.set_value(job, texel, colorspace);
  }
  void set_texture(const Job& job, const std::vector<std::string>& files,
                   std::string_view colorspace) {
    inputs_.set_texture(job, files, colorspace);
  }
  /// The tiles that textures with <UDIM> in their names have: the document's udimset.
  void set_tiles(const std::vector<UdimTile>& tiles) { tiles_ = tiles; }

  /// By which set of texture coordinates textures are read.
  void set_uv_set(int number) { inputs_.set_uv_set(number); }

  /// The XML, once all jobs are finished: to be asked for once.
  std::string text();

 private:
  /// A node whose copy has begun: `inputs` from `next` on are still to be copied.
  struct Open {
    const Element* node;
    const NodeDef* def;
    Element* copy;
    std::vector<const Element*> inputs;
    std::size_t next = 0;
  };

  void copy_tree(const Element& material);
  /// The copy of a node, begun here if it is the first time; null after an error.
  Element* copy_of(const Element& node);
  void copy_input(const Element& input, const NodeDef& def, Element& copy);
  void copy_value(const Element& input, const Element& port, Element& copy);
  void copy_closure(const Element& input, Element& copy);
  std::string source_of(const Feed& feed) const;
  void add_job(const Element& input, const Feed& feed, const NodeDef& def, Element& copy);
  void copy_definitions();
  void add_tiles();
  std::string moved_file(const Element& input) const;

  Document& source_;
  const Definitions& definitions_;
  std::string folder_;
  Complaints complaints_;
  NewDocument document_;
  BakedInputs inputs_;
  std::vector<Job> jobs_;
  std::vector<Open> open_;       ///< Each read by the one before it.
  std::vector<Element*> nodes_;  ///< Copies, sources before readers.
  std::unordered_map<const Element*, Element*> copies_;
  bool uses_own_definitions_ = false;
  std::vector<UdimTile> tiles_;
};

}  // namespace nacre::tool
