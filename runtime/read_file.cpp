#include "runtime/read_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

namespace nacre {

std::optional<std::string> read_file(const std::string& path, std::uint64_t most_bytes,
                                     Diagnostics& diagnostics) {
  const SourceLocation where{path, 0, 0, {}};
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::is_regular_file(status)) {
    diagnostics.error(
        "cannot-read", where,
        std::filesystem::exists(status) ? "this is no regular file" : "there is no such file");
    return std::nullopt;
  }
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error && size > most_bytes) {
    diagnostics.error("file-too-large", where, "the file is too large",
                      fmt::format("at most {} bytes", most_bytes), fmt::format("{} bytes", size));
    return std::nullopt;
  }
  std::ifstream stream(path, std::ios::binary);
  // What grows meanwhile is not read beyond what it was.
  std::string bytes(error ? 0 : size, '\0');
  if (!stream || !stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
    diagnostics.error("cannot-read", where, "the file cannot be read");
    return std::nullopt;
  }
  return bytes;
}

}  // namespace nacre
