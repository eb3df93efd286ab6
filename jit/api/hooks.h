#pragma once

#include <nacre/nacre.h>

#include <memory>

#include "jit/document/file_resolver.h"
#include "jit/service/threads.h"
#include "runtime/block_memory.h"
#include "runtime/texture/texture_system.h"

// What a host does in place of the library, as the library's own interfaces. Each is of a structure
// that has a size.

namespace nacre::api {

FileResolver host_resolver(const nacre_file_resolver& given);
std::shared_ptr<TextureSystem> host_texture_system(const nacre_texture_system& given);
std::shared_ptr<Executor> host_executor(const nacre_executor& given);
std::shared_ptr<BlockMemory> host_memory(const nacre_allocator& given);

}  // namespace nacre::api
