#pragma once

#include <OpenImageIO/filesystem.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace nacre::host {

/// A file that OpenImageIO writes through and that remembers what went wrong: its PNG
/// writer drops every error of the system (a full disk), OpenEXR's those while it closes.
class CheckedFile final : public OIIO::Filesystem::IOProxy {
 public:
  explicit CheckedFile(const std::string& path);
  ~CheckedFile() override;
  CheckedFile(const CheckedFile&) = delete;
  CheckedFile& operator=(const CheckedFile&) = delete;

  /// Ends the file: what went wrong first since it was opened, or "".
  std::string finish();

  // Of IOProxy.
  const char* proxytype() const override { return "checked_file"; }
  void close() override {}  // The writer's; `finish` is ours.
  std::size_t write(const void* bytes, std::size_t size) override;
  std::size_t pwrite(const void* bytes, std::size_t size, std::int64_t offset) override;
  std::size_t size() const override;

 private:
  int file_;
  std::string problem_;
};

}  // namespace nacre::host
