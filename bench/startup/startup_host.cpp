// A host that goes as far as it is told to, and says how many libraries it has then: for
// bench/startup.py.
//
//   startup_host version|system|texture DOCUMENT OUTPUT|colors CONFIG
#include <cstdio>
#include <fstream>
#include <nacre/nacre.hpp>
#include <set>
#include <string>
#include <string_view>

namespace {

std::size_t libraries() {
  std::ifstream maps("/proc/self/maps");
  std::set<std::string> files;
  for (std::string line; std::getline(maps, line);) {
    const std::size_t path = line.find('/');
    if (path != std::string::npos && line.find(".so", path) != std::string::npos) {
      files.insert(line.substr(path));
    }
  }
  return files.size();
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string_view step = argc > 1 ? argv[1] : "";
  if (step == "version" && argc == 2) {
    if (nacre_version() == 0) return 1;
  } else if (step == "system" && argc == 2) {
    const nacre::System system;
  } else if (step == "colors" && argc == 3) {
    nacre::SystemOptions options;
    options.ocio_config = argv[2];
    const nacre::System system(options);
  } else if (step == "texture" && argc == 4) {
    nacre::System system;
    const nacre::Document document = nacre::Document::read(argv[2]);
    const nacre::Shader shader = system.compile_outputs(document, {argv[3]});
    if (shader.results(NACRE_OUTPUTS).empty()) return 1;
  } else {
    return std::fprintf(stderr, "usage: startup_host version|system|texture FILE OUTPUT|...\n"), 2;
  }
  std::printf("%zu\n", libraries());
  return 0;
} catch (const nacre::Error& error) {
  return std::fprintf(stderr, "%s\n", error.what()), 1;
}
