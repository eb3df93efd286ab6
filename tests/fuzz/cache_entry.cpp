// Bytes as a file of the kernel cache: what is taken must be what was written. First as they
// are, then as damage to a sound entry: pairs of a place and a change.
#include <cstddef>
#include <cstdint>
#include <string>

#include "jit/cache/entry_file.h"
#include "tests/fuzz/host.h"
#include "tests/fuzz/memory_file.h"

namespace {

using namespace nacre;

const std::string key = "program 1\ntarget x86_64\n";
const std::string secret(32, 's');

void read(std::string_view file) {
  const auto object = unpack(file, key, secret);
  if (object && pack(key, *object, secret) != file)
    fuzz::fail("an entry is taken that nobody wrote");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  read(fuzz::as_text(data, size));
  static const std::string sound = pack(
      key, {"nacre_0_f_w8", "ff/f/f/0", {'\x7f', 'E', 'L', 'F', '\x02', '\x01', '\x01'}}, secret);
  std::string damaged = sound;
  for (std::size_t i = 0; i + 1 < size && i < 16; i += 2) {
    damaged[data[i] % damaged.size()] ^= static_cast<char>(data[i + 1]);
  }
  if (size % 3 == 1) damaged.resize(damaged.size() - data[0] % damaged.size());
  read(damaged);
  return 0;
}
