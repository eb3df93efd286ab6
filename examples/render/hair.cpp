#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <filesystem>

#include "examples/render/fibre.h"
#include "examples/render/load_scene.h"
#include "examples/render/scene_budget.h"
#include "examples/render/scene_file.h"

namespace nacre::host {

namespace {

static_assert(std::endian::native == std::endian::little, "the format is little-endian");

constexpr std::size_t header_bytes = 128;

/// What arrays follow the header.
enum Arrays : std::uint32_t {
  array_segments = 1u << 0,
  array_points = 1u << 1,
  array_thickness = 1u << 2,
  array_transparency = 1u << 3,
  array_colors = 1u << 4,
};

/// Yuksel, "HAIR Model Files": http://www.cemyuksel.com/research/hairmodels.
class HairReader {
 public:
  HairReader(const std::string& file, const std::string& bytes, const SceneLimits& limits,
             Diagnostics& diagnostics)
      : where_{file, 0, 0, {}},
        bytes_(bytes),
        diagnostics_(diagnostics),
        budget_(limits, diagnostics) {}

  Scene read() {
    if (bytes_.size() < header_bytes || bytes_.compare(0, 4, "HAIR") != 0) {
      error("this is not a HAIR file", "a header of 128 bytes that begins with \"HAIR\"",
            fmt::format("{} bytes", bytes_.size()));
      return {};
    }
    strands_ = at<std::uint32_t>(4);
    points_ = at<std::uint32_t>(8);
    arrays_ = at<std::uint32_t>(12);
    if (!is_complete()) return {};
    Mesh mesh;
    mesh.object_name = std::filesystem::path(where_.file).stem().string();
    mesh.mesh_name = mesh.object_name;
    if (!read_strands(mesh)) return {};
    read_points(mesh);
    if ((arrays_ & array_transparency) != 0 || at<float>(24) != 0.f) {
      diagnostics_.warning("not-rendered", where_,
                           "transparency of the fibres is not rendered: it is the material's");
    }
    Scene scene;
    if (finish_fibres(mesh, where_, diagnostics_)) scene.meshes.push_back(std::move(mesh));
    return scene;
  }

 private:
  template <class T>
  T at(std::size_t offset) const {
    T value;
    std::memcpy(&value, bytes_.data() + offset, sizeof value);
    return value;
  }

  void error(const std::string& message, const std::string& expected, const std::string& found) {
    diagnostics_.error("bad-hair", where_, message, expected, found);
  }

  /// Of the file, by its header; the numbers are below 2^32, so that nothing overflows.
  bool is_complete() {
    std::size_t wanted = header_bytes;
    if ((arrays_ & array_points) == 0) {
      return error("the file has no points", "bit 1 of its arrays", fmt::format("{:#x}", arrays_)),
             false;
    }
    if ((arrays_ & array_segments) != 0) wanted += std::size_t{2} * strands_;
    std::size_t floats = 3;
    for (const Arrays array : {array_thickness, array_transparency}) {
      if ((arrays_ & array) != 0) floats += 1;
    }
    if ((arrays_ & array_colors) != 0) floats += 3;
    wanted += 4 * floats * points_;
    if (bytes_.size() >= wanted) return true;
    error("the file ends early", fmt::format("{} bytes", wanted), fmt::format("{}", bytes_.size()));
    return false;
  }

  bool read_strands(Mesh& mesh) {
    const bool has_segments = (arrays_ & array_segments) != 0;
    std::vector<std::uint32_t> counts;
    std::size_t total = 0;
    // Without their array strands take no bytes: not more of them than points.
    if (strands_ > points_) {
      return error("there are more strands than points", fmt::format("at most {}", points_),
                   fmt::format("{}", strands_)),
             false;
    }
    counts.reserve(strands_);
    for (std::size_t i = 0; i < strands_; ++i) {
      const std::size_t segments =
          has_segments ? at<std::uint16_t>(header_bytes + 2 * i) : at<std::uint32_t>(16);
      total += segments + 1;
      if (total > points_) break;
      counts.push_back(static_cast<std::uint32_t>(segments + 1));
    }
    if (total != points_) {
      return error("the points are not those of the strands",
                   fmt::format("{}, one more for each strand than it has segments", total),
                   fmt::format("{}", points_)),
             false;
    }
    const std::size_t pieces = total - counts.size();
    // Radius, uv and a colour.
    if (!budget_.take(where_, points_, pieces, std::size_t{24} * points_)) return false;
    mesh.triangles = fibre_pieces(counts);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const float across = (static_cast<float>(i) + 0.5f) / static_cast<float>(counts.size());
      for (std::uint32_t k = 0; k < counts[i]; ++k) {
        const float last = static_cast<float>(std::max(counts[i], 2u) - 1u);
        mesh.uv.push_back({across, static_cast<float>(k) / last});
      }
    }
    return true;
  }

  void read_points(Mesh& mesh) {
    std::size_t offset =
        header_bytes + ((arrays_ & array_segments) != 0 ? std::size_t{2} * strands_ : 0);
    for (std::size_t i = 0; i < points_; ++i, offset += 12) {
      mesh.position.push_back({at<float>(offset), at<float>(offset + 4), at<float>(offset + 8)});
    }
    const float thickness = at<float>(20);
    mesh.radius.assign(points_, 0.5f * thickness);
    if ((arrays_ & array_thickness) != 0) {
      for (float& radius : mesh.radius) {
        radius = 0.5f * at<float>(offset);
        offset += 4;
      }
    }
    if ((arrays_ & array_transparency) != 0) offset += std::size_t{4} * points_;
    Primvar colour{"color0", 3, {}};
    for (std::size_t i = 0; i < std::size_t{3} * points_; ++i) {
      const bool each = (arrays_ & array_colors) != 0;
      colour.values.push_back(each ? at<float>(offset + 4 * i) : at<float>(28 + 4 * (i % 3)));
    }
    mesh.primvars.push_back(std::move(colour));
  }

  SourceLocation where_;
  const std::string& bytes_;
  Diagnostics& diagnostics_;
  SceneBudget budget_;
  std::uint32_t strands_ = 0, points_ = 0, arrays_ = 0;
};

}  // namespace

Scene load_hair(const std::string& path, const SceneLimits& limits, Diagnostics& diagnostics) {
  std::size_t file_bytes = limits.file_bytes;
  const auto bytes = read_scene_file(path, {path, 0, 0, {}}, file_bytes, diagnostics);
  return bytes ? HairReader(path, *bytes, limits, diagnostics).read() : Scene{};
}

}  // namespace nacre::host
