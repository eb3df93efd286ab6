// Bytes as a HAIR file, read and rendered.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/scene_host.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  static const fuzz::MemoryFile file(".hair");
  file.write(fuzz::as_text(data, size));
  fuzz::render_scene(file.path());
  return 0;
}
