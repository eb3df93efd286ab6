#include "examples/tool/render_checkpoint.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <sstream>
#include <string_view>

#include "runtime/digest.h"

namespace nacre::tool {

std::string asked_of(const CLI::App& command) {
  constexpr std::string_view others[] = {
      "out",      "threads",      "time-limit",       "checkpoint", "quiet",
      "no-cache", "compile-here", "checkpoint-every", "cache",      "wait-for-code"};
  std::string text;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || std::ranges::any_of(others, [&](auto name) {
          return option->check_lname(std::string(name));
        })) {
      continue;
    }
    text += option->get_name() + '=';
    for (const std::string& each : option->results()) text += each + ' ';
    text += '\n';
  }
  return text;
}

std::optional<host::Checkpoint> checkpoint_of(const RenderOptions& options, const Opened& opened) {
  if (options.progress.checkpoint.empty()) return {};
  std::string key = options.asked + NACRE_TOOL_VERSION "\n";
  const auto add = [&](const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream bytes;
    bytes << in.rdbuf();
    key += file + '\n' + to_hex(sha256(bytes.view())) + '\n';
  };
  for (const std::string& file : opened.document->files()) add(file);
  for (const std::string& file : {options.scene, options.environment}) {
    if (!file.empty()) add(file);
  }
  return std::optional<host::Checkpoint>(std::in_place, options.progress.checkpoint, key,
                                         options.progress.checkpoint_every);
}

}  // namespace nacre::tool
