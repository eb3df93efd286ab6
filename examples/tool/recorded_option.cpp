#include "examples/tool/recorded_option.h"

#include <cstdint>
#include <utility>

#include "runtime/read_file.h"

namespace nacre::tool {

namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 30;

}  // namespace

void RecordedOption::add(CLI::App& command) {
  command
      .add_option("--recorded", file,
                  "Measure errors of materials where a scene shades them, as nacre render "
                  "--record-points has written; nothing is promised anywhere else")
      ->type_name("FILE.json");
}

bool RecordedOption::read(std::shared_ptr<const RecordedPoints>& points,
                          Diagnostics& diagnostics) const {
  if (file.empty()) return true;
  const auto text = read_file(file, most_bytes, diagnostics);
  if (!text) return false;
  auto parsed = RecordedPoints::parse(*text, file, diagnostics);
  if (!parsed) return false;
  points = std::make_shared<const RecordedPoints>(std::move(*parsed));
  return true;
}

}  // namespace nacre::tool
