#pragma once

#include <array>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "examples/tool/new_document.h"
#include "runtime/type.h"

namespace nacre::tool {

/// An input of a node of a new document that is to get what was baked.
struct BakedInput {
  Element* node = nullptr;
  std::string input;
  Type type = Type::none;
  std::string_view frame;  ///< "Nworld", "Tworld" or "Bworld" for a direction.
};

/// A vector of the surface's frame, "Nworld" say, as the plane has it; null for other names.
const std::array<float, 3>* plane_axis(std::string_view geomprop);

/// Gives inputs what was baked: values, or images in graphs NG_baked_<node>. A direction
/// comes back through a normalmap node, so that it follows any surface's frame.
class BakedInputs {
 public:
  explicit BakedInputs(NewDocument& document) : document_(document) {}

  /// Texels that are all alike, colours in the space given.
  void set_value(const BakedInput& baked, std::span<const float> texel,
                 std::string_view colorspace);
  /// A texture, of a matrix one for every row, tagged with the colour space given, if any.
  /// Textures of booleans and integers are read texel by texel.
  void set_texture(const BakedInput& baked, const std::vector<std::string>& files,
                   std::string_view colorspace);
  /// By which set of texture coordinates textures are read, if not the first.
  void set_uv_set(int number) { uv_set_ = number; }
  /// In the order they were needed; they stand nowhere yet.
  const std::vector<Element*>& graphs() const { return graphs_; }

 private:
  Element& add_node(const BakedInput& baked, std::string_view category, const std::string& suffix,
                    std::string_view type);
  Element& add_image(const BakedInput& baked, const std::string& suffix, std::string_view type,
                     const std::string& file, std::string_view colorspace);
  void connect(const BakedInput& baked, const Element& node);
  Element& graph_of(const BakedInput& baked);

  NewDocument& document_;
  int uv_set_ = 0;
  std::vector<Element*> graphs_;
  std::unordered_map<const Element*, Element*> graph_of_node_;
};

}  // namespace nacre::tool
