#include "tests/pbs/battery/closure_points.h"

#include <fmt/format.h>

#include <bit>
#include <string_view>

#include "runtime/channel/channel_name.h"
#include "tests/pbs/battery/hostile_numbers.h"

namespace nacre {

namespace {

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }

class Drawing {
 public:
  Drawing(std::uint64_t seed, std::size_t count)
      : random_(seed * 0x9e3779b97f4a7c15ull + 1), hostility_(hostilities(random_, count)) {}

  void add(const ClosureInput& input) {
    const int components = component_count(input.type);
    if (input.type == Type::boolean || input.type == Type::integer) {
      for (std::uint32_t& x : array(input.name)) x = whole(input.type == Type::boolean);
    } else if (input.meaning == Meaning::direction && components == 3) {
      const bool is_tangent = input.name.find("angent") != std::string::npos;
      add_direction(input.name, is_tangent ? 0 : 2, 0.5);
    } else if (components == 1) {
      add_numbers(input.name, input.meaning);
    } else {
      for (int k = 0; k < components; ++k) {
        add_numbers(channel_text(input.name, k), input.meaning);
      }
    }
  }

  void add_point() {
    for (const char* name : {"N", "Ng", "No"}) add_frame(name, 2);
    for (const char* name : {"T", "To"}) add_frame(name, 0);
    for (const char* name : {"B", "Bo"}) add_frame(name, 1);
    for (const char* name : {"P.x", "P.y", "P.z", "Po.x", "Po.y", "Po.z"}) {
      add_numbers(name, Meaning::position);
    }
    for (const char* name : {"uv0.x", "uv0.y"}) add_numbers(name, Meaning::any);
    add_direction("wo", 2, 0.05);
    add_wi();
    for (const char* name : {"u.x", "u.y", "u.z"}) {
      for (std::uint32_t& x : array(name)) x = bits(hostile_unit(random_));
    }
  }

  void add_slots() {
    add_numbers("min_alpha", Meaning::alpha);
    add_numbers("exterior_index", Meaning::index);
    for (const char* name : {"lobe_mask", "lobes_wanted"}) {
      for (std::uint32_t& x : array(name)) {
        x = random_.chance(0.5) ? ~0u : static_cast<std::uint32_t>(random_.word() >> 32);
      }
    }
    for (std::uint32_t& x : array("transport")) x = random_.below(2);
    for (const char* name : {"time", "frame"}) add_numbers(name, Meaning::any);
    for (const char* name : {"object_to_world", "world_to_object"}) {
      for (int k = 0; k < 16; ++k) {
        // Slots of several numbers are named as parameters are.
        auto& column = array(fmt::format("{}.{}", name, k));
        for (std::size_t i = 0; i < column.size(); ++i) {
          column[i] = bits(k % 5 == 0 ? 1.0f : 0.0f);
        }
      }
    }
  }

  Arrays take() { return std::move(arrays_); }

 private:
  std::vector<std::uint32_t>& array(const std::string& name) {
    auto& made = arrays_[name];
    made.resize(hostility_.size());
    return made;
  }

  std::uint32_t whole(bool is_truth) {
    if (is_truth) return random_.below(2);
    return random_.chance(0.8) ? random_.below(4)
                               : static_cast<std::uint32_t>(random_.word() >> 32);
  }

  void add_numbers(const std::string& name, Meaning meaning) {
    auto& column = array(name);
    for (std::size_t i = 0; i < column.size(); ++i) {
      column[i] = bits(hostile_number(random_, meaning, hostility_[i]));
    }
  }

  /// The components' arrays.
  struct Vectors {
    std::vector<std::uint32_t>&x, &y, &z;

    void set(std::size_t i, const float (&v)[3]) {
      x[i] = bits(v[0]);
      y[i] = bits(v[1]);
      z[i] = bits(v[2]);
    }
  };

  Vectors vectors(const std::string& name) {
    return {array(channel_text(name, 0)), array(channel_text(name, 1)),
            array(channel_text(name, 2))};
  }

  void add_direction(const std::string& name, int axis, double along) {
    Vectors out = vectors(name);
    for (std::size_t i = 0; i < hostility_.size(); ++i) {
      float v[3];
      hostile_direction(random_, hostility_[i], axis, along, v);
      out.set(i, v);
    }
  }

  /// Normals are unit, whatever else is not; tangents may be anything where meshes have none.
  void add_frame(const std::string& name, int axis) {
    Vectors out = vectors(name);
    for (std::size_t i = 0; i < hostility_.size(); ++i) {
      float v[3] = {};
      v[axis] = 1.0f;
      if (hostility_[i] != Hostility::plausible && axis != 1 && random_.chance(0.3)) {
        const Hostility hostility = axis == 2 ? Hostility::plausible : hostility_[i];
        hostile_direction(random_, hostility, axis, 0.0, v);
      }
      out.set(i, v);
    }
  }

  void add_wi() {
    const Vectors wo = vectors("wo");
    Vectors wi = vectors("wi");
    for (std::size_t i = 0; i < hostility_.size(); ++i) {
      float v[3];
      hostile_direction(random_, hostility_[i], 2, 0.0, v);
      const std::uint32_t kind = random_.below(12);
      if (kind < 4) {
        v[0] = std::bit_cast<float>(wo.x[i]);
        v[1] = std::bit_cast<float>(wo.y[i]);
        v[2] = std::bit_cast<float>(wo.z[i]);
        if (kind != 3) v[0] = -v[0], v[1] = -v[1];
        if (kind == 1) v[2] = -v[2];
        // Near the mirror direction.
        if (kind == 2) v[0] += 1e-3f * (hostile_unit(random_) - 0.5f);
      }
      wi.set(i, v);
    }
  }

  Random random_;
  std::vector<Hostility> hostility_;
  Arrays arrays_;
};

}  // namespace

Arrays hostile_points(const std::vector<ClosureInput>& inputs, std::uint64_t seed,
                      std::size_t count) {
  Drawing drawing(seed, count);
  for (const ClosureInput& input : inputs) drawing.add(input);
  drawing.add_point();
  drawing.add_slots();
  return drawing.take();
}

std::string describe_point(const Arrays& points, std::size_t index) {
  std::string text;
  for (const auto& [name, column] : points) {
    if (name.starts_with("object_to_world") || name.starts_with("world_to_object")) continue;
    const std::uint32_t word = column[index];
    text += fmt::format("  {} = {} (0x{:08x})\n", name, std::bit_cast<float>(word), word);
  }
  return text;
}

}  // namespace nacre
