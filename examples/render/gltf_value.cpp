#include "examples/render/gltf_value.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace nacre::host {

std::string GltfValue::shown() const {
  if (json_ == nullptr) return "none";
  if (json_->is_array()) return fmt::format("an array of {}", json_->size());
  if (json_->is_object()) return "an object";
  if (json_->is_string()) return '"' + json_->get_ref<const std::string&>() + '"';
  return json_->dump();
}

void GltfValue::wrong(const char* expected) const {
  error("the value has another type", expected, shown());
}

const GltfValue& GltfValue::need(const char* expected) const {
  if (json_ == nullptr) error("a value is missing", expected, "none");
  return *this;
}

GltfValue GltfValue::operator[](const char* name) const {
  std::string path = path_.empty() ? name : path_ + '.' + name;
  if (json_ == nullptr) return {nullptr, std::move(path), *report_};
  if (!json_->is_object()) {
    wrong("an object");
    return {nullptr, std::move(path), *report_};
  }
  const auto found = json_->find(name);
  return {found == json_->end() ? nullptr : &*found, std::move(path), *report_};
}

GltfValue GltfValue::operator[](std::size_t i) const {
  const bool is_there = json_ != nullptr && json_->is_array() && i < json_->size();
  return {is_there ? &(*json_)[i] : nullptr, fmt::format("{}[{}]", path_, i), *report_};
}

std::size_t GltfValue::size() const {
  if (json_ == nullptr) return 0;
  if (json_->is_array()) return json_->size();
  wrong("an array");
  return 0;
}

std::vector<std::string> GltfValue::names() const {
  std::vector<std::string> list;
  if (json_ == nullptr) return list;
  if (!json_->is_object()) {
    wrong("an object");
    return list;
  }
  for (const auto& [name, value] : json_->items()) list.push_back(name);
  return list;
}

std::optional<std::size_t> GltfValue::count() const {
  if (json_ == nullptr) return {};
  if (json_->is_number_unsigned()) return json_->get<std::size_t>();
  // 3.0 is a JSON integer too.
  if (json_->is_number_float()) {
    const double value = json_->get<double>();
    if (value >= 0 && value < 0x1p53 && value == std::floor(value)) {
      return static_cast<std::size_t>(value);
    }
  }
  wrong("a whole number of at least 0");
  return {};
}

std::optional<std::size_t> GltfValue::index_of(const GltfValue& list) const {
  const auto index = count();
  if (!index || list[*index]) return index;
  error(fmt::format("{} has no such element", list.path()),
        list.size() == 0 ? "one that is there" : fmt::format("an index below {}", list.size()),
        shown());
  return {};
}

std::optional<double> GltfValue::number() const {
  if (json_ == nullptr) return {};
  if (json_->is_number()) {
    const double value = json_->get<double>();
    if (std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max())) return value;
  }
  wrong("a number that a float can hold");
  return {};
}

std::optional<float> GltfValue::within(double low, double high, float otherwise) const {
  if (json_ == nullptr) return otherwise;
  const auto value = number();
  if (!value) return {};
  if (*value >= low && *value <= high) return static_cast<float>(*value);
  error("a number is out of range", fmt::format("{:g} to {:g}", low, high), shown());
  return {};
}

std::optional<std::vector<double>> GltfValue::numbers(std::size_t n) const {
  if (json_ == nullptr) return {};
  if (!json_->is_array() || json_->size() != n) {
    error("the value has another type", fmt::format("{} numbers", n), shown());
    return {};
  }
  std::vector<double> list;
  for (std::size_t i = 0; i < n; ++i) {
    const auto value = (*this)[i].number();
    if (!value) return {};
    list.push_back(*value);
  }
  return list;
}

std::optional<std::string> GltfValue::text() const {
  if (json_ == nullptr) return {};
  if (json_->is_string()) return json_->get<std::string>();
  wrong("a text");
  return {};
}

std::string GltfValue::name() const {
  constexpr std::size_t longest = 1024;
  const GltfValue member = (*this)["name"];
  std::string name = member.text().value_or("");
  if (name.size() <= longest) return name;
  member.error("the name is too long", fmt::format("at most {} bytes", longest),
               fmt::format("{}", name.size()));
  return {};
}

std::optional<bool> GltfValue::boolean() const {
  if (json_ == nullptr) return {};
  if (json_->is_boolean()) return json_->get<bool>();
  wrong("true or false");
  return {};
}

}  // namespace nacre::host
