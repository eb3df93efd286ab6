#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "examples/render/load_scene.h"
#include "examples/render/mesh.h"
#include "examples/render/scene_budget.h"
#include "examples/render/scene_file.h"
#include "runtime/mix_bits.h"

namespace nacre::host {

namespace {

/// Words of a line, separated by blanks.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}
  std::string_view next() {
    const std::size_t first = rest_.find_first_not_of(" \t\r");
    if (first == rest_.npos) return rest_ = {};
    rest_.remove_prefix(first);
    const std::string_view word = rest_.substr(0, rest_.find_first_of(" \t\r"));
    rest_.remove_prefix(word.size());
    return word;
  }
  bool at_end() const { return rest_.find_first_not_of(" \t\r") == rest_.npos; }
  std::string_view remainder() {
    const std::size_t first = rest_.find_first_not_of(" \t");
    if (first == rest_.npos) return {};
    const std::size_t last = rest_.find_last_not_of(" \t\r");
    return rest_.substr(first, last - first + 1);
  }

 private:
  std::string_view rest_;
};

template <class T>
std::optional<T> number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  T value{};
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (status != std::errc() || end != word.data() + word.size()) return {};
  return value;
}

/// 0-based indices; -1: absent.
struct Corner {
  long long v = -1, vt = -1, vn = -1;
  bool operator==(const Corner&) const = default;
};

/// From a number that no file can know: corners that were chosen to fall into one bucket do not.
struct CornerHash {
  std::uint64_t secret = (std::uint64_t{std::random_device()()} << 32) | std::random_device()();

  std::size_t operator()(const Corner& c) const {
    std::uint64_t h = secret;
    for (const long long index : {c.v, c.vt, c.vn}) {
      h = mix_bits(h ^ static_cast<std::uint64_t>(index));
    }
    return static_cast<std::size_t>(h);
  }
};

/// Of the table of corners, for each vertex while a mesh is read.
constexpr std::size_t corner_bytes = 64;

class ObjReader {
 public:
  ObjReader(const std::string& file, const SceneLimits& limits, Diagnostics& diagnostics)
      : file_(file), diagnostics_(diagnostics), budget_(limits, diagnostics) {}

  Scene read(std::string_view text) {
    const std::size_t errors = diagnostics_.error_count();
    while (!text.empty() && diagnostics_.error_count() == errors) {
      const std::string_view line = text.substr(0, text.find('\n'));
      text.remove_prefix(std::min(text.size(), line.size() + 1));
      ++line_;
      read_line(line);
    }
    if (diagnostics_.error_count() == errors) flush();
    if (diagnostics_.error_count() == errors && scene_.meshes.empty()) {
      error("the file has nothing to draw", "faces", "none");
    }
    if (diagnostics_.error_count() != errors) return {};
    return std::move(scene_);
  }

 private:
  void error(const char* message, std::string expected, std::string_view found) {
    diagnostics_.error("bad-obj", {file_, line_, 0, {}}, message, std::move(expected),
                       std::string(found));
  }

  /// A warning at the first line that has such a thing.
  void say(const char* code, const char* message, std::string_view found = {}) {
    constexpr std::size_t most = 32;  // Kinds; beyond that it is no OBJ.
    if (said_.size() == most || !said_.insert(code + std::string(found)).second) return;
    diagnostics_.warning(code, {file_, line_, 0, {}}, message, {}, std::string(found));
  }

  void read_line(std::string_view line) {
    Words words(line);
    const std::string_view key = words.next();
    if (key == "v") {
      read_position(words);
    } else if (key == "vn") {
      float f[3];
      if (floats(words, f, 3) && is_end(words)) normal_.push_back({f[0], f[1], f[2]});
    } else if (key == "vt") {
      read_uv(words);
    } else if (key == "f") {
      face(words);
    } else if (key == "o" || key == "g") {
      flush();
      (key == "o" ? object_ : group_) = words.remainder();
    } else if (key == "usemtl") {
      flush();
      material_ = words.remainder();
    } else if (key == "s") {
      smoothing_ = smoothing_ == 0 ? line_ : smoothing_;
    } else if (key == "mtllib") {
      say("scene-materials-not-rendered",
          "the scene's own materials are not rendered; only their names count");
    } else if (key == "l" || key == "p") {
      say("not-triangles", "points and lines are left out");
    } else if (!key.empty() && !key.starts_with('#')) {
      say("not-rendered", "this kind of line is not supported and left out", key);
    }
  }

  /// v x y z, then a weight, a colour, or both.
  void read_position(Words& words) {
    float f[3];
    if (!floats(words, f, 3)) return;
    position_.push_back({f[0], f[1], f[2]});
    int more = 0;
    for (float ignored; !words.at_end(); ++more) {
      if (!floats(words, &ignored, 1)) return;
    }
    if (more == 3 || more == 4) say("not-rendered", "colours of vertices are left out");
    if (more == 1) say("not-rendered", "weights of vertices are left out");
    if (more == 2 || more > 4)
      error("a vertex with too many numbers", "3, 4, 6 or 7", fmt::format("{}", 3 + more));
  }

  /// vt u [v [w]]
  void read_uv(Words& words) {
    float f[3] = {};
    int count = 0;
    for (; count < 3 && (count == 0 || !words.at_end()); ++count) {
      if (!floats(words, f + count, 1)) return;
    }
    if (is_end(words)) uv_.push_back({f[0], f[1]});
  }

  bool is_end(Words& words) {
    if (words.at_end()) return true;
    error("a line that is too long", "its end", words.remainder());
    return false;
  }

  bool floats(Words& words, float* out, int count) {
    for (int i = 0; i < count; ++i) {
      const std::string_view word = words.next();
      const std::optional<float> value = number<float>(word);
      if (!value || !std::isfinite(*value)) {
        error("not a number", count == 1 ? "a number" : fmt::format("{} numbers", count), word);
        return false;
      }
      out[i] = *value;
    }
    return true;
  }

  /// One of the up to three indices of a corner; -1 when left out.
  bool index(std::string_view word, std::size_t size, long long& out) {
    out = -1;
    if (word.empty()) return true;
    const std::optional<long long> i = number<long long>(word);
    const auto count = static_cast<long long>(size);
    if (i && *i > 0 && *i <= count) out = *i - 1;
    if (i && *i < 0 && *i >= -count) out = count + *i;
    if (out >= 0) return true;
    error("not an index of an earlier element", fmt::format("±1 to ±{}", size), word);
    return false;
  }

  bool corner(std::string_view word, Corner& c) {
    std::string_view part[3];
    for (std::string_view& p : part) {
      p = word.substr(0, word.find('/'));
      word.remove_prefix(std::min(word.size(), p.size() + 1));
    }
    if (part[0].empty()) {
      error("a corner without a position", "v, v/vt, v//vn or v/vt/vn", part[0]);
      return false;
    }
    return index(part[0], position_.size(), c.v) && index(part[1], uv_.size(), c.vt) &&
           index(part[2], normal_.size(), c.vn);
  }

  void face(Words& words) {
    std::vector<std::uint32_t> polygon;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      Corner c;
      if (!corner(word, c)) return;
      polygon.push_back(vertex(c));
    }
    if (polygon.size() < 3) return error("a face with too few corners", "three or more", {});
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      mesh_.triangles.push_back({{polygon[0], polygon[i - 1], polygon[i]}});
    }
    const std::size_t vertices = mesh_.position.size(), triangles = mesh_.triangles.size();
    if (budget_.fits(vertices, triangles, corner_bytes * vertices)) return;
    budget_.take({file_, line_, 0, {}}, vertices, triangles, corner_bytes * vertices);
  }

  std::uint32_t vertex(const Corner& c) {
    const auto [slot, fresh] =
        corners_.try_emplace(c, static_cast<std::uint32_t>(mesh_.position.size()));
    if (!fresh) return slot->second;
    mesh_.position.push_back(position_[static_cast<std::size_t>(c.v)]);
    mesh_.uv.push_back(c.vt < 0 ? Vec2{} : uv_[static_cast<std::size_t>(c.vt)]);
    mesh_.normal.push_back(c.vn < 0 ? Vec3{} : normal_[static_cast<std::size_t>(c.vn)]);
    has_uv_ = has_uv_ || c.vt >= 0;
    lacks_normal_ = lacks_normal_ || c.vn < 0;
    return slot->second;
  }

  /// Ends the mesh that was being read.
  void flush() {
    Mesh mesh = std::exchange(mesh_, {});
    corners_.clear();
    if (!std::exchange(has_uv_, false)) mesh.uv.clear();
    if (std::exchange(lacks_normal_, false)) mesh.normal.clear();
    if (mesh.triangles.empty()) return;
    const SourceLocation where{file_, line_, 0, {}};
    if (!budget_.take(where, mesh.position.size(), mesh.triangles.size(),
                      object_.size() + group_.size() + material_.size())) {
      return;
    }
    if (mesh.normal.empty() && smoothing_ != 0) {
      say("smoothing-not-rendered",
          "smoothing groups do not count: all faces without normals are smooth");
    }
    mesh.object_name = !object_.empty() ? object_ : group_;
    mesh.mesh_name = !group_.empty() ? group_ : mesh.object_name;
    mesh.material_name = material_;
    if (finish_mesh(mesh, where, diagnostics_)) scene_.meshes.push_back(std::move(mesh));
  }

  const std::string& file_;
  Diagnostics& diagnostics_;
  SceneBudget budget_;
  std::set<std::string> said_;
  int line_ = 0;
  int smoothing_ = 0;  ///< The first line with a smoothing group; 0: none yet.
  std::vector<Vec3> position_, normal_;
  std::vector<Vec2> uv_;
  std::string object_, group_, material_;
  Mesh mesh_;
  std::unordered_map<Corner, std::uint32_t, CornerHash> corners_;
  bool has_uv_ = false, lacks_normal_ = false;
  Scene scene_;
};

}  // namespace

Scene load_obj(const std::string& path, const SceneLimits& limits, Diagnostics& diagnostics) {
  std::size_t file_bytes = limits.file_bytes;
  const auto text = read_scene_file(path, {path, 0, 0, {}}, file_bytes, diagnostics);
  return text ? ObjReader(path, limits, diagnostics).read(*text) : Scene{};
}

}  // namespace nacre::host
