#include "examples/render/gltf_meshopt.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

namespace nacre::host {

namespace {

/// What the decoder takes; it asserts the rest.
bool is_form(const std::string& mode, const std::string& filter, std::size_t count,
             std::size_t stride) {
  if (mode == "ATTRIBUTES") {
    if (filter == "OCTAHEDRAL" && stride != 4 && stride != 8) return false;
    if (filter == "QUATERNION" && stride != 8) return false;
    return stride >= 4 && stride <= 256 && stride % 4 == 0;
  }
  const bool is_index = (stride == 2 || stride == 4) && filter == "NONE";
  return is_index && ((mode == "TRIANGLES" && count % 3 == 0) || mode == "INDICES");
}

bool decode(const std::string& mode, std::string& bytes, std::size_t count, std::size_t stride,
            std::string_view packed) {
  const auto* from = reinterpret_cast<const unsigned char*>(packed.data());
  if (mode == "ATTRIBUTES") {
    return meshopt_decodeVertexBuffer(bytes.data(), count, stride, from, packed.size()) == 0;
  }
  if (mode == "TRIANGLES") {
    return meshopt_decodeIndexBuffer(bytes.data(), count, stride, from, packed.size()) == 0;
  }
  return meshopt_decodeIndexSequence(bytes.data(), count, stride, from, packed.size()) == 0;
}

}  // namespace

std::optional<std::string> unpack_meshopt(const GltfValue& extension, std::string_view packed,
                                          std::size_t most_bytes) {
  const auto count = extension["count"].need("a number of elements").count();
  const auto stride = extension["byteStride"].need("bytes of an element").count();
  const std::string mode = extension["mode"].need("a mode").text().value_or("");
  const std::string filter = extension["filter"].text().value_or("NONE");
  if (!count || !stride) return {};
  const bool is_known = filter == "NONE" || filter == "OCTAHEDRAL" || filter == "QUATERNION" ||
                        filter == "EXPONENTIAL";
  if (!is_known || !is_form(mode, filter, *count, *stride)) {
    extension.error("the compressed buffer view has another form",
                    "as EXT_meshopt_compression has it",
                    fmt::format("{} elements of {} bytes, mode \"{}\", filter \"{}\"", *count,
                                *stride, mode, filter));
    return {};
  }
  if (*count > most_bytes / *stride) {
    extension.report().diagnostics.error(
        "file-too-large", extension.location(), "the files of the scene are too large",
        fmt::format("at most {} bytes more (--max-scene-file-size)", most_bytes),
        fmt::format("{} elements of {} bytes", *count, *stride));
    return {};
  }
  std::string bytes(*count * *stride, '\0');
  if (!decode(mode, bytes, *count, *stride, packed)) {
    extension.error("the compressed buffer view cannot be unpacked",
                    "a stream of EXT_meshopt_compression", fmt::format("{} bytes", packed.size()));
    return {};
  }
  if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes.data(), *count, *stride);
  if (filter == "QUATERNION") meshopt_decodeFilterQuat(bytes.data(), *count, *stride);
  if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes.data(), *count, *stride);
  return bytes;
}

}  // namespace nacre::host
