#include "examples/image_input/graph_output.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include "examples/image_input/wrong.h"

namespace graph_image {

namespace {

namespace fs = std::filesystem;

/// Points of one call of the kernel: enough to be worth it, few enough that it soon sees that
/// there is compiled code, and that what they take in memory does not count.
constexpr int most_points = 16384;

bool is_numeric(std::string_view type) {
  constexpr std::array types =
      std::to_array<std::string_view>({"boolean", "integer", "float", "color3", "color4", "vector2",
                                       "vector3", "vector4", "matrix33", "matrix44"});
  return std::find(types.begin(), types.end(), type) != types.end();
}

/// An attribute of an element by its path; "" if there is none.
std::string attribute_of(const nacre::Document& document, const std::string& path,
                         const char* name) {
  const std::size_t element = document.find_element(path);
  if (element == SIZE_MAX) return {};
  const char* const value = nacre_document_find_attribute(document.get(), element, name);
  return value != nullptr ? value : "";
}

/// The output asked for, or the only numeric one.
std::string chosen_output(const nacre::Document& document, const Request& request) {
  if (!request.output.empty()) return request.output;
  std::vector<std::string> found;
  std::string list;
  for (const std::string& name : document.outputs()) {
    if (!is_numeric(attribute_of(document, name, "type"))) continue;
    found.push_back(name);
    list.append(list.empty() ? "" : ", ").append(name);
  }
  if (found.empty()) {
    throw Wrong(request.document, "no-output", "the document has no numeric output");
  }
  if (found.size() > 1) {
    throw Wrong(request.document, "no-output", "the document has several outputs",
                "'?output=' and one of " + list);
  }
  return found.front();
}

/// A number of texels that the document asks for.
int size_of(const nacre::Document& document, const std::string& output, const char* side) {
  constexpr int usual = 1024, most = 65536;
  const std::string text = attribute_of(document, output, side);
  const char* const end = text.data() + text.size();
  int size = 0;
  const auto [last, error] = std::from_chars(text.data(), end, size);
  return error == std::errc() && last == end && size >= 1 && size <= most ? size : usual;
}

std::string read_profile(const Request& request) {
  if (request.profile.empty()) return {};
  const fs::path file = fs::path(request.document).parent_path() / request.profile;
  std::ifstream stream(file, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(stream)), {});
  if (text.empty()) throw Wrong(file.string(), "cannot-read", "the profile cannot be read");
  return text;
}

int accuracy_of(Accuracy accuracy) {
  switch (accuracy) {
    case Accuracy::precise: return NACRE_PRECISE;
    case Accuracy::fast: return NACRE_FAST;
    case Accuracy::standard: break;
  }
  return NACRE_STANDARD;
}

nacre::CompileOptions options_of(const Request& request) {
  nacre::CompileOptions options;
  options.accuracy = accuracy_of(request.accuracy);
  options.max_anisotropy = request.anisotropy;
  options.background = request.accuracy != Accuracy::fast && request.profile.empty();
  options.lenient = true;
  options.frame = static_cast<int>(request.frame);
  options.profile = read_profile(request);
  return options;
}

/// The result as numbers of its own.
void to_floats(std::vector<float>& values) {
  for (float& value : values) {
    std::int32_t whole = 0;
    std::memcpy(&whole, &value, sizeof whole);
    value = static_cast<float>(whole);
  }
}

/// The mean of each texel's points, which lie row by row.
void add_means(const std::vector<float>& points, const Level& level, const Texels& texels,
               std::size_t components, std::vector<float>& means) {
  const auto width = static_cast<std::size_t>(texels.width);
  const auto samples_x = static_cast<std::size_t>(level.samples_x);
  const auto samples_y = static_cast<std::size_t>(level.samples_y);
  const double share = 1.0 / static_cast<double>(samples_x * samples_y);
  for (std::size_t y = 0; y < static_cast<std::size_t>(texels.height); ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      for (std::size_t c = 0; c < components; ++c) {
        double sum = 0;
        for (std::size_t j = y * samples_y; j < (y + 1) * samples_y; ++j) {
          for (std::size_t i = x * samples_x; i < (x + 1) * samples_x; ++i) {
            sum += static_cast<double>(points[(j * width * samples_x + i) * components + c]);
          }
        }
        means.push_back(static_cast<float>(sum * share));
      }
    }
  }
}

}  // namespace

GraphOutput::GraphOutput(nacre::System& system, const nacre::Document& document,
                         const Request& request, std::vector<nacre::Diagnostic>& said) {
  info_.output = chosen_output(document, request);
  info_.type = attribute_of(document, info_.output, "type");
  shader_ = std::make_unique<const nacre::Shader>(
      system.compile_outputs(document, {info_.output}, options_of(request), &said));
  const std::vector<nacre::Channel> results = shader_->results(NACRE_OUTPUTS);
  if (results.empty()) {
    throw Wrong(request.document, "no-output", "the output '" + info_.output + "' has no numbers",
                "one whose type is numeric", info_.type);
  }
  info_.components = static_cast<int>(results.size());
  info_.width = size_of(document, info_.output, "width");
  info_.height = size_of(document, info_.output, "height");
  is_float_ = results.front().type == NACRE_FLOAT;
  nacre::Binder binder;
  bind_plane(*shader_, binder);
  // One by one: a matrix has no group of channels.
  const auto stride = static_cast<std::ptrdiff_t>(results.size() * sizeof(float));
  for (std::size_t i = 0; i < results.size(); ++i) {
    const auto offset = static_cast<std::ptrdiff_t>(i * sizeof(float));
    binder.array(results[i].name, {array_result, offset, stride});
  }
  binding_ = std::make_unique<const nacre::Binding>(binder, *shader_);
}

nacre::Instance GraphOutput::instance(const Request& request) const {
  nacre::Instance made(*shader_);
  for (const nacre::Parameter& parameter : shader_->parameters()) {
    if (parameter.name == "frame") made.set("frame", request.frame);
    if (parameter.name == "time") made.set("time", request.time);
  }
  return made;
}

void GraphOutput::run(const nacre::Instance& instance, const PlaneGrid& grid, const Texels& points,
                      std::vector<float>& values) const {
  std::vector<float> u, v;
  u.reserve(points.count());
  v.reserve(points.count());
  for (int j = points.y; j < points.y + points.height; ++j) {
    for (int i = points.x; i < points.x + points.width; ++i) {
      u.push_back(grid.u(i));
      v.push_back(grid.v(j));
    }
  }
  values.resize(points.count() * static_cast<std::size_t>(info_.components));
  float change[2] = {grid.change()[0], grid.change()[1]};
  std::array<void*, array_count> arrays{};
  arrays[array_u] = u.data();
  arrays[array_v] = v.data();
  arrays[array_change] = change;
  arrays[array_result] = values.data();
  nacre::Batch batch;
  batch.count = points.count();
  binding_->run(NACRE_OUTPUTS, arrays, batch, &instance);
  points_ += points.count();
  if (!is_float_) to_floats(values);
}

std::vector<float> GraphOutput::shade(const nacre::Instance& instance, const PlaneGrid& grid,
                                      const Level& level, const Texels& texels) const {
  const auto components = static_cast<std::size_t>(info_.components);
  const int points_a_row = texels.width * level.samples_x * level.samples_y;
  const int rows = std::clamp(most_points / points_a_row, 1, texels.height);
  std::vector<float> all;
  all.reserve(texels.count() * components);
  std::vector<float> values;
  for (int first = 0; first < texels.height; first += rows) {
    const Texels strip{texels.x, texels.y + first, texels.width,
                       std::min(rows, texels.height - first)};
    run(instance, grid,
        {strip.x * level.samples_x, strip.y * level.samples_y, strip.width * level.samples_x,
         strip.height * level.samples_y},
        values);
    if (level.samples_x * level.samples_y == 1) {
      all.insert(all.end(), values.begin(), values.end());
    } else {
      add_means(values, level, strip, components, all);
    }
  }
  return all;
}

}  // namespace graph_image
