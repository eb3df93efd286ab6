#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <nacre/lobe_test/direction.hpp>
#include <nacre/nacre.hpp>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace nacre {

/// Numbers by channel, one for all points or one each; integers as their bits.
using Columns = std::map<std::string, std::vector<float>>;

inline float bits(std::int32_t x) { return std::bit_cast<float>(x); }
inline std::int32_t integer(float x) { return std::bit_cast<std::int32_t>(x); }

/// A document with a material M whose surface S has the BSDF b of `nodes`, and these inputs.
inline std::string surface_of(const std::string& nodes, const std::string& inputs = "") {
  return R"(<materialx version="1.39">)" + nodes +
         R"(<surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/>)" +
         inputs + R"(</surface><surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>)";
}

/// A lobe b with an input of that type and value.
inline std::string lobe(const std::string& category, const std::string& inputs = "",
                        const std::string& name = "b") {
  return "<" + category + " name=\"" + name + "\" type=\"BSDF\">" + inputs + "</" + category + ">";
}
inline std::string given(const std::string& name, const std::string& type,
                         const std::string& value) {
  return "<input name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>";
}
inline std::string facets(const std::string& alpha) {
  return given("roughness", "vector2", alpha + ", " + alpha);
}
inline std::string both(const std::string& fg, const std::string& bg, const std::string& mix,
                        const std::string& name = "b") {
  return "<mix name=\"" + name + R"(" type="BSDF"><input name="fg" type="BSDF" nodename=")" + fg +
         R"("/><input name="bg" type="BSDF" nodename=")" + bg + "\"/>" +
         given("mix", "float", mix) + "</mix>";
}

/// What a renderer written for the page does with Nacre.
class RixBxdfPage : public ::testing::Test {
 protected:
  /// Interpreted unless asked otherwise: the same bits.
  static Shader compile(const std::string& document, CompileOptions options = {},
                        int engine = NACRE_INTERPRETER) {
    static System system;
    options.no_footprints = true;
    options.engine = engine;
    return system.compile_material(Document::parse(document.c_str()), "M", options);
  }

  /// What an entry stores at `count` points, after NACRE_BEGIN at `points` of them where that is
  /// not 0. Of points that lie flat, are seen from above, and have what `in` says else.
  static Columns ask(const Shader& shader, nacre_entry entry, Columns in, std::size_t count = 1,
                     std::size_t points = 0, std::uint32_t point = 0,
                     const Instance* instance = nullptr) {
    if (entry != NACRE_BEGIN) {
      const std::size_t begun = points != 0 ? points : count;
      for (auto& [name, column] : ask(shader, NACRE_BEGIN, in, begun, 0, 0, instance)) {
        in[name] = column;
      }
    }
    Binder binder;
    for (const char* up : {"N", "No", "Ng", "wo", "wi"}) binder.constant(up, {0, 0, 1});
    for (const char* x : {"T", "To"}) binder.constant(x, {1, 0, 0});
    for (const char* y : {"B", "Bo"}) binder.constant(y, {0, 1, 0});
    for (const char* zero : {"P", "Po", "uv0", "u"}) binder.constant(zero, {0, 0, 0});
    std::vector<void*> arrays;
    const auto bind = [&](const std::string& name, std::vector<float>& column) {
      const bool is_one = column.size() == 1;
      binder.array(name, {static_cast<std::uint32_t>(arrays.size()), 0, is_one ? 0 : 4});
      arrays.push_back(column.data());
    };
    for (auto& [name, column] : in) bind(name, column);
    Columns out;
    for (const Channel& channel : shader.results(entry)) out[channel.name].assign(count, -1.0f);
    for (auto& [name, column] : out) {
      binder.array(name, {static_cast<std::uint32_t>(arrays.size())});
      arrays.push_back(column.data());
    }
    Batch batch;
    batch.count = count;
    batch.point = point;
    Binding(binder, shader, 1u << entry).run(entry, arrays, batch, instance);
    return out;
  }

  static void put(Columns& columns, const std::string& name, const std::vector<Direction>& w) {
    for (const char* component : {".x", ".y", ".z"}) columns[name + component].clear();
    for (const Direction& each : w) {
      columns[name + ".x"].push_back(each.x);
      columns[name + ".y"].push_back(each.y);
      columns[name + ".z"].push_back(each.z);
    }
  }
  static Columns directions(const std::vector<Direction>& wo, const std::vector<Direction>& wi) {
    Columns columns;
    put(columns, "wo", wo), put(columns, "wi", wi);
    return columns;
  }
  /// Seen along wo, with numbers for `sample`.
  static Columns random(Direction wo, std::size_t count) {
    Columns columns;
    put(columns, "wo", {wo});
    std::mt19937 generator(11);
    for (const char* u : {"u.x", "u.y", "u.z"}) {
      for (std::size_t i = 0; i < count; ++i) {
        columns[u].push_back(static_cast<float>(generator() >> 8) * 0x1p-24f);
      }
    }
    return columns;
  }
  /// All over the sphere, alike.
  static std::vector<Direction> sphere(std::size_t count) {
    std::vector<Direction> all;
    for (std::size_t i = 0; i < count; ++i) {
      // A spiral.
      const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
      const double r = std::sqrt(1 - z * z), phi = 2.399963229728653 * static_cast<double>(i);
      all.push_back({static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
                     static_cast<float>(z)});
    }
    return all;
  }
  static std::vector<Direction> sampled(const Columns& sample) {
    std::vector<Direction> all;
    for (std::size_t i = 0; i < sample.at("wi.x").size(); ++i) {
      all.push_back({sample.at("wi.x")[i], sample.at("wi.y")[i], sample.at("wi.z")[i]});
    }
    return all;
  }
  static bool is_valid(const Columns& sample, std::size_t i) {
    return (integer(sample.at("flags")[i]) & NACRE_SAMPLE_VALID) != 0;
  }
  static double mean(const std::vector<float>& column) {
    double sum = 0;
    for (const float x : column) sum += static_cast<double>(x);
    return sum / static_cast<double>(column.size());
  }
  static constexpr float pi = std::numbers::pi_v<float>;
};

}  // namespace nacre
