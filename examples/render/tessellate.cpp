#include "examples/render/tessellate.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace nacre::host {

namespace {

constexpr std::uint32_t whole = ~0u;

/// One round: edges that are too long get a vertex in their middle.
class Round {
 public:
  Round(Mesh& mesh, const std::function<bool(Vec3, Vec3)>& is_too_long)
      : mesh_(mesh), is_too_long_(is_too_long) {}

  /// Edges to split; what the triangles become is one more for each time they are met.
  std::size_t find() {
    std::size_t more = 0;
    for (const Triangle& t : mesh_.triangles) {
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t a = t.v[c], b = t.v[(c + 1) % 3];
        const auto [place, is_new] = middles_.try_emplace(key(a, b), whole);
        if (is_new && is_too_long_(mesh_.position[a], mesh_.position[b])) {
          place->second = static_cast<std::uint32_t>(mesh_.position.size() + ends_.size());
          ends_.emplace_back(a, b);
        }
        if (place->second != whole) ++more;
      }
    }
    return more;
  }

  void split() {
    add_vertices();
    std::vector<Triangle> triangles;
    for (const Triangle& t : mesh_.triangles) split(t, triangles);
    mesh_.triangles = std::move(triangles);
  }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  }
  std::uint32_t middle(std::uint32_t a, std::uint32_t b) const { return middles_.at(key(a, b)); }

  /// Sums of two do not depend on their order, so that seams keep together.
  void add_vertices() {
    for (const auto& [a, b] : ends_) {
      add(mesh_.position, 0.5f * mesh_.position[a] + 0.5f * mesh_.position[b]);
      if (!mesh_.position_object.empty()) {
        add(mesh_.position_object,
            0.5f * mesh_.position_object[a] + 0.5f * mesh_.position_object[b]);
      }
      if (!mesh_.normal.empty()) {
        add(mesh_.normal, normalize_or(mesh_.normal[a] + mesh_.normal[b], mesh_.normal[a]));
      }
      if (!mesh_.tangent.empty()) {
        const Tangent &s = mesh_.tangent[a], &t = mesh_.tangent[b];
        add(mesh_.tangent, {normalize_or(s.direction + t.direction, s.direction), s.sign});
      }
      if (!mesh_.uv.empty())
        add(mesh_.uv,
            {0.5f * (mesh_.uv[a].x + mesh_.uv[b].x), 0.5f * (mesh_.uv[a].y + mesh_.uv[b].y)});
      for (Primvar& primvar : mesh_.primvars) {
        const auto n = static_cast<std::size_t>(primvar.components);
        for (std::size_t c = 0; c < n; ++c) {
          const float sum = primvar.values[a * n + c] + primvar.values[b * n + c];
          primvar.values.push_back(0.5f * sum);
        }
      }
    }
  }
  template <class T>
  static void add(std::vector<T>& values, T value) {
    values.push_back(value);
  }

  void split(const Triangle& t, std::vector<Triangle>& out) const {
    std::uint32_t m[3];
    int count = 0;
    for (int c = 0; c < 3; ++c) {
      m[c] = middle(t.v[c], t.v[(c + 1) % 3]);
      count += m[c] != whole ? 1 : 0;
    }
    if (count == 0) return out.push_back(t);
    if (count == 3) {
      for (int c = 0; c < 3; ++c) out.push_back({{t.v[c], m[c], m[(c + 2) % 3]}});
      return out.push_back({{m[0], m[1], m[2]}});
    }
    // Turned so that the edge from v0 to v1 is split, and the one from v2 to v0 is not.
    int first = 0;
    while (m[first] == whole || m[(first + 2) % 3] != whole) ++first;
    const std::uint32_t v0 = t.v[first], v1 = t.v[(first + 1) % 3], v2 = t.v[(first + 2) % 3];
    const std::uint32_t a = m[first], b = m[(first + 1) % 3];
    if (b == whole) {
      out.push_back({{v0, a, v2}});
      return out.push_back({{a, v1, v2}});
    }
    out.push_back({{a, v1, b}});
    out.push_back({{v0, a, b}});
    out.push_back({{v0, b, v2}});
  }

  Mesh& mesh_;
  const std::function<bool(Vec3, Vec3)>& is_too_long_;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;  ///< By edge; `whole`: none.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ends_;
};

}  // namespace

bool tessellate(Mesh& mesh, const std::function<bool(Vec3, Vec3)>& is_too_long, std::size_t most) {
  while (true) {
    Round round(mesh, is_too_long);
    const std::size_t more = round.find();
    if (more == 0) return true;
    if (mesh.triangles.size() + more > most) return false;
    round.split();
  }
}

}  // namespace nacre::host
