#include "examples/tool/render/varying_slots.h"

#include <cstddef>
#include <map>
#include <set>

namespace nacre::tool {

std::vector<std::string> varying_slots(const std::vector<const host::Mesh*>& meshes,
                                       bool is_shutter_open) {
  std::map<std::string, std::size_t> owners;
  for (const host::Mesh* mesh : meshes) {
    std::set<std::string> names;
    for (const host::Primvar& primvar : mesh->primvars) names.insert(primvar.name);
    for (const std::string& name : names) ++owners[name];
  }
  std::vector<std::string> slots = {"object_to_world", "world_to_object"};
  if (is_shutter_open) slots.insert(slots.end(), {"time", "frame"});
  for (const auto& [name, count] : owners) {
    if (count < meshes.size()) slots.push_back("geomprop." + name);
  }
  return slots;
}

}  // namespace nacre::tool
