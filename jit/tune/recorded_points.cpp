#include "jit/tune/recorded_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

namespace nacre {

namespace {

using Json = nlohmann::ordered_json;

constexpr int version = 1;

/// Reads one document, and says what is wrong with it.
class Reader {
 public:
  Reader(const std::string& file, Diagnostics& diagnostics)
      : file_(file), diagnostics_(diagnostics) {}

  std::optional<PointsOfMaterial> material(const Json& json) {
    PointsOfMaterial made;
    const Json* const name = member(json, "material");
    if (name == nullptr || !name->is_string()) {
      return refuse({}, "points are of a material", "\"material\": \"NAME\"", found(name));
    }
    made.material = name->get<std::string>();
    const Json* const count = member(json, "count");
    if (count == nullptr || !count->is_number_unsigned() || *count == 0) {
      return refuse(made.material, "points have a number", "\"count\": N, at least 1",
                    found(count));
    }
    made.count = count->get<std::size_t>();
    const bool is_read =
        read_columns(
            member(json, "channels"), made, made.floats,
            [](const Json& x) { return x.is_number() && std::isfinite(x.get<float>()); }) &&
        read_columns(member(json, "integers"), made, made.integers, is_small_integer);
    if (!is_read) return std::nullopt;
    return made;
  }

  std::nullopt_t refuse(const std::string& path, const std::string& message,
                        const std::string& expected, const std::string& is) {
    diagnostics_.error("bad-points", {.file = file_, .path = path}, message, expected, is);
    return std::nullopt;
  }

  static const Json* member(const Json& json, const char* name) {
    if (!json.is_object()) return nullptr;
    const auto at = json.find(name);
    return at != json.end() ? &*at : nullptr;
  }
  static std::string found(const Json* json) { return json != nullptr ? json->dump() : "none"; }

 private:
  static bool is_small_integer(const Json& x) {
    if (!x.is_number_integer()) return false;
    const auto whole = x.get<std::int64_t>();
    return std::in_range<std::int32_t>(whole);
  }

  template <class T, class IsOne>
  bool read_columns(const Json* from, const PointsOfMaterial& of,
                    std::map<std::string, std::vector<T>>& to, IsOne&& is_one) {
    if (from == nullptr) return true;
    if (!from->is_object()) {
      refuse(of.material, "channels have names", "{\"P.x\": [...], ...}", from->type_name());
      return false;
    }
    for (const auto& [name, list] : from->items()) {
      const std::string path = of.material + '/' + name;
      if (!list.is_array() || list.size() != of.count) {
        refuse(path, "a channel has a number at each point", fmt::format("a list of {}", of.count),
               list.is_array() ? fmt::format("{}", list.size()) : list.type_name());
        return false;
      }
      if (const auto wrong = std::ranges::find_if_not(list, is_one); wrong != list.end()) {
        refuse(path, "a channel holds numbers of its kind",
               "finite numbers, or integers of 32 bits", wrong->dump());
        return false;
      }
      to[name] = list.template get<std::vector<T>>();
    }
    return true;
  }

  const std::string& file_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::optional<RecordedPoints> RecordedPoints::parse(std::string_view text, const std::string& file,
                                                    Diagnostics& diagnostics) {
  Reader reader(file, diagnostics);
  const Json json = Json::parse(text, nullptr, false);
  const Json* const said = Reader::member(json, "nacre_points");
  if (said == nullptr || *said != version) {
    return reader.refuse({}, "these are no recorded points that are known here",
                         fmt::format("an object with \"nacre_points\": {}", version),
                         said != nullptr ? said->dump() : json.type_name());
  }
  const Json* const list = Reader::member(json, "materials");
  if (list == nullptr || !list->is_array()) {
    return reader.refuse({}, "there is a list of materials", "\"materials\": [...]",
                         Reader::found(list));
  }
  RecordedPoints made;
  for (const Json& each : *list) {
    std::optional<PointsOfMaterial> points = reader.material(each);
    if (!points) return std::nullopt;
    if (made.find(points->material) != nullptr) {
      return reader.refuse(points->material, "a material is there once", "one of a name", "two");
    }
    made.add(std::move(*points));
  }
  return made;
}

const PointsOfMaterial* RecordedPoints::find(std::string_view material) const {
  const auto found = std::ranges::find(materials_, material, &PointsOfMaterial::material);
  return found != materials_.end() ? &*found : nullptr;
}

std::string RecordedPoints::text() const {
  Json list = Json::array();
  for (const PointsOfMaterial& each : materials_) {
    list.push_back({{"material", each.material},
                    {"count", each.count},
                    {"channels", each.floats},
                    {"integers", each.integers}});
  }
  const Json json{{"nacre_points", version}, {"materials", std::move(list)}};
  // Names come from documents, which may hold bytes that are no UTF-8.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace nacre
