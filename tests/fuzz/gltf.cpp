// Bytes as a glTF scene, binary where they begin so, read and rendered.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/scene_host.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  static const fuzz::MemoryFile binary(".glb");
  static const fuzz::MemoryFile text(".gltf");
  const std::string_view bytes = fuzz::as_text(data, size);
  const fuzz::MemoryFile& file = bytes.starts_with("glTF") ? binary : text;
  file.write(bytes);
  fuzz::render_scene(file.path());
  return 0;
}
