// The nodedefs of a system's libraries.
#include "jit/api/call.h"
#include "jit/api/handles.h"

using namespace nacre;
using namespace nacre::api;

namespace {

/// Null where there is no memory.
const NodeDefList* nodedefs_of(const nacre_system* system) {
  if (system == nullptr) return nullptr;
  const NodeDefList* made = nullptr;
  guarded([&] {
    made = &system->nodedefs.get(*system->system);
    return nacre_status{NACRE_OK};
  });
  return made;
}

const NodeDefList::Row* row_of(const nacre_system* system, size_t index) {
  const NodeDefList* nodedefs = nodedefs_of(system);
  return nodedefs != nullptr && index < nodedefs->rows().size() ? &nodedefs->rows()[index]
                                                                : nullptr;
}

nacre_status give_port(const std::vector<nacre_port>& ports, size_t index, nacre_port* port) {
  return index < ports.size() ? give(port, ports[index]) : nacre_status{NACRE_WRONG_ARGUMENTS};
}

}  // namespace

size_t nacre_system_nodedef_count(const nacre_system* system) {
  const NodeDefList* nodedefs = nodedefs_of(system);
  return nodedefs != nullptr ? nodedefs->rows().size() : 0;
}

nacre_status nacre_system_nodedef(const nacre_system* system, size_t index,
                                  nacre_nodedef* nodedef) {
  const NodeDefList::Row* row = row_of(system, index);
  return row != nullptr ? give(nodedef, row->about) : nacre_status{NACRE_WRONG_ARGUMENTS};
}

size_t nacre_system_find_nodedef(const nacre_system* system, const char* name) {
  const NodeDefList* nodedefs = nodedefs_of(system);
  return nodedefs != nullptr ? nodedefs->find(text_or_empty(name)) : SIZE_MAX;
}

nacre_status nacre_system_input(const nacre_system* system, size_t nodedef, size_t index,
                                nacre_port* port) {
  const NodeDefList::Row* row = row_of(system, nodedef);
  return row != nullptr ? give_port(row->inputs, index, port) : nacre_status{NACRE_WRONG_ARGUMENTS};
}

nacre_status nacre_system_output(const nacre_system* system, size_t nodedef, size_t index,
                                 nacre_port* port) {
  const NodeDefList::Row* row = row_of(system, nodedef);
  return row != nullptr ? give_port(row->outputs, index, port)
                        : nacre_status{NACRE_WRONG_ARGUMENTS};
}
