// How libFuzzer varies documents: as XML, by exchanging parts with other documents, and
// now and then as bytes.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "tests/fuzz/splice.h"

extern "C" {

// Of libFuzzer, which has no header for them; the names of ours are its own too.
// NOLINTBEGIN(readability-identifier-naming)
std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

static std::size_t give(const std::string& text, std::uint8_t* out, std::size_t max_size) {
  if (text.size() > max_size) return 0;
  std::memcpy(out, text.data(), text.size());
  return text.size();
}

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                    unsigned int seed) {
  using namespace nacre::fuzz;
  Random random(seed);
  auto tree = read_tree({reinterpret_cast<const char*>(data), size});
  if (!tree && random.one_in(2)) tree = random.pick(project_splicer().sources()).tree;
  if (!tree || random.one_in(10)) return LLVMFuzzerMutate(data, size, max_size);
  project_splicer().mutate(*tree, random, 1 + static_cast<int>(random.below(4)));
  const std::size_t made = give(write_tree(*tree), data, max_size);
  return made != 0 ? made : LLVMFuzzerMutate(data, size, max_size);
}

std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* data1, std::size_t size1,
                                      const std::uint8_t* data2, std::size_t size2,
                                      std::uint8_t* out, std::size_t max_size, unsigned int seed) {
  using namespace nacre::fuzz;
  Random random(seed);
  auto tree = read_tree({reinterpret_cast<const char*>(data1), size1});
  const auto donor = read_tree({reinterpret_cast<const char*>(data2), size2});
  if (!tree || !donor) return 0;
  project_splicer().mutate(*tree, random, 1 + static_cast<int>(random.below(6)), &*donor);
  return give(write_tree(*tree), out, max_size);
}
// NOLINTEND(readability-identifier-naming)

}  // extern "C"
