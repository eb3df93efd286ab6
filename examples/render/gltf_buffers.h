#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "examples/render/gltf_value.h"

namespace nacre::host {

/// The buffers of a glTF file, read when somebody asks: the BIN chunk, data URIs in
/// base64, and files of the scene's own folder or below.
class GltfBuffers {
 public:
  /// `binary` is the BIN chunk, if any; `file_bytes` what files may still be read.
  GltfBuffers(const GltfValue& root, std::optional<std::string> binary, std::size_t file_bytes);

  /// The bytes of buffers[index], which must be there; nothing after an error, which is
  /// given once.
  std::optional<std::string_view> bytes(std::size_t index);
  /// Those of the buffer view that `index` names; nothing after an error.
  std::optional<std::string_view> view(const GltfValue& index);

  /// Whether a URI holds its data,
  static bool is_data(std::string_view uri);
  /// which those are, in base64; nothing after an error.
  static std::optional<std::string> data(const GltfValue& uri);
  /// Of another: "%20" is a blank.
  static std::string file_name(std::string_view uri);

 private:
  struct Buffer {
    bool is_read = false;
    std::optional<std::string> bytes;
  };

  std::optional<std::string> read(std::size_t index, const GltfValue& buffer);
  std::optional<std::string> read_file(const GltfValue& uri, const std::string& name);

  GltfValue root_;
  std::optional<std::string> binary_;
  std::size_t file_bytes_;
  std::filesystem::path folder_;
  std::vector<Buffer> buffers_;
  std::map<std::size_t, std::string> unpacked_;  ///< Of buffer views.
};

}  // namespace nacre::host
