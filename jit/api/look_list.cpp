#include "jit/api/look_list.h"

#include <utility>

namespace nacre::api {

LookList::LookList(const Document& document) : rules_(document, unsaid_) {
  for (Look& look : find_looks(document, unsaid_)) looks_.push_back({std::move(look), {}});
  // Only now do the texts stay where they are.
  for (Row& row : looks_) {
    for (const Assignment& assignment : row.look.assignments) {
      std::vector<nacre_variant>& applied = row.variants.emplace_back();
      for (const auto* choices : {&std::as_const(row).look.variants, &assignment.variants}) {
        for (const VariantChoice& choice : *choices) {
          applied.push_back({choice.variantset.c_str(), choice.variant.c_str()});
        }
      }
    }
  }
}

nacre_assignment LookList::assignment(std::size_t look, std::string_view geometry) const {
  const Row& row = looks_[look];
  nacre_assignment made{};
  made.material = "";
  const Assignment* found = rules_.material_of(row.look, geometry);
  if (found == nullptr) return made;
  const auto& variants =
      row.variants[static_cast<std::size_t>(found - row.look.assignments.data())];
  made.material = found->material.c_str();
  made.variants = variants.data();
  made.variant_count = variants.size();
  return made;
}

bool LookList::is_visible(std::size_t look, std::string_view geometry, std::string_view rays,
                          std::string_view viewer) const {
  return rules_.is_visible(looks_[look].look, geometry, rays, viewer);
}

}  // namespace nacre::api
