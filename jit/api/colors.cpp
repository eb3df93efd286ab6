#include "jit/api/colors.h"

#include <string>
#include <utility>
#include <vector>

#include "jit/api/call.h"

namespace nacre::api {

namespace {

/// Of a table; see is_whole().
constexpr std::size_t most_numbers = std::size_t{1} << 28;

/// Whether all extents are there and the numbers can be counted.
bool is_meant(const nacre_color_table& table) {
  if (table.values == nullptr || table.channels < 1 || table.channels > 4) return false;
  std::size_t count = table.channels;
  for (const std::size_t extent : table.extent) {
    if (extent == 0 || extent > most_numbers / count) return false;
    count *= extent;
  }
  return true;
}

TextTable table_of(const nacre_color_table& given) {
  TextTable table;
  table.name = text_or_empty(given.name);
  table.size = {given.extent[0], given.extent[1], given.extent[2]};
  table.channels = given.channels;
  table.filter = given.is_nearest != 0 ? TextTable::Filter::nearest : TextTable::Filter::linear;
  const std::size_t count = given.extent[0] * given.extent[1] * given.extent[2] * given.channels;
  table.values =
      std::make_shared<TableValues>(std::vector<float>(given.values, given.values + count));
  return table;
}

class HostColors : public ColorConfig {
 public:
  explicit HostColors(const nacre_colors& given)
      : name_(text_or_empty(given.name)),
        find_(given.find),
        transform_(given.transform),
        user_(given.user, [destroy = given.destroy](void* user) {
          if (destroy != nullptr) destroy(user);
        }) {}

  std::string name() const override { return name_; }

  std::optional<Space> find(std::string_view name) const override {
    nacre_color_space space{};
    space.size = sizeof space;
    if (find_ == nullptr || find_(user_.get(), std::string(name).c_str(), &space) == 0) return {};
    return Space{text_or_empty(space.name), space.is_data != 0};
  }

  std::shared_ptr<const ColorTransform> transform(const std::string& from, const std::string& to,
                                                  std::string& fault) const override {
    nacre_color_transform given{};
    given.size = sizeof given;
    if (transform_ == nullptr || transform_(user_.get(), from.c_str(), to.c_str(), &given) == 0) {
      fault = "the host has none";
      return nullptr;
    }
    auto made = std::make_shared<ColorTransform>();
    made->text = text_or_empty(given.text);
    made->function = text_or_empty(given.function);
    const auto* tables = reinterpret_cast<const std::byte*>(given.tables);
    for (std::size_t i = 0; tables != nullptr && i < given.table_count; ++i) {
      // As far apart as the host's version of them is long.
      const nacre_color_table table =
          options_of(reinterpret_cast<const nacre_color_table*>(tables + i * given.tables->size));
      if (!has_size(given.tables) || !is_meant(table)) {
        fault = "the host's table '" + std::string(text_or_empty(table.name)) +
                "' has no size, no texels or more than it can have";
        return nullptr;
      }
      made->tables.push_back(table_of(table));
    }
    return made;
  }

 private:
  std::string name_;
  decltype(nacre_colors::find) find_;
  decltype(nacre_colors::transform) transform_;
  std::shared_ptr<void> user_;
};

}  // namespace

std::shared_ptr<const ColorConfig> host_colors(const nacre_colors& given) {
  return std::make_shared<HostColors>(options_of(&given));
}

}  // namespace nacre::api
