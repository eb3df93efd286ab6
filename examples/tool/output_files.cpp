#include "examples/tool/output_files.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "jit/shading/bound_kernel.h"

namespace nacre::tool {

namespace {

namespace fs = std::filesystem;

bool is_same(const std::string& a, const std::string& b) {
  std::error_code error;
  if (a.empty() || b.empty()) return false;
  if (fs::exists(a, error) && !fs::is_regular_file(a, error)) return false;
  if (fs::equivalent(a, b, error)) return true;
  const fs::path first = fs::weakly_canonical(a, error);
  return !error && first == fs::weakly_canonical(b, error) && !error;
}

void report_input(const OutputFile& output, Diagnostics& diagnostics) {
  diagnostics.error("output-is-input", {output.file, 0, 0, {}},
                    fmt::format("{} would replace a file that is read", output.option),
                    "another name");
}

}  // namespace

bool check_outputs(std::span<const OutputFile> outputs, const std::vector<std::string>& read,
                   Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const OutputFile& output = outputs[i];
    for (const OutputFile& other : outputs.first(i)) {
      if (!is_same(output.file, other.file)) continue;
      diagnostics.error("one-name", {output.file, 0, 0, {}},
                        fmt::format("{} and {} would be one file", other.option, output.option),
                        "a name for each");
    }
    for (const std::string& file : read) {
      if (!is_same(output.file, file)) continue;
      report_input(output, diagnostics);
      break;
    }
  }
  return diagnostics.error_count() == errors;
}

bool check_output(const OutputFile& output, std::span<const BoundKernel* const> kernels,
                  Diagnostics& diagnostics) {
  for (const BoundKernel* kernel : kernels) {
    for (const auto& [file, then] : kernel->files()) {
      if (!is_same(output.file, file)) continue;
      report_input(output, diagnostics);
      return false;
    }
  }
  return true;
}

}  // namespace nacre::tool
