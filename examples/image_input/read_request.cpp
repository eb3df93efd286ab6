#include "examples/image_input/read_request.h"

#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>

#include "examples/image_input/image_name.h"
#include "examples/image_input/wrong.h"

namespace graph_image {

namespace {

constexpr std::string_view config_prefix = "mtlx:";

/// True where all of the text is one whole number of that range.
bool read_whole(std::string_view text, int least, int most, int& value) {
  int number = 0;
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || last != end || number < least || number > most) return false;
  value = number;
  return true;
}

/// The same of any number as far as every whole one is a float.
bool read_number(std::string_view text, float& value) {
  constexpr float most = 1 << 24;
  float number = 0;
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || last != end || !(std::abs(number) <= most)) return false;
  value = number;
  return true;
}

bool read_size(std::string_view text, Request& request) {
  constexpr int most = 65536;
  const std::size_t cross = text.find('x');
  if (cross == std::string_view::npos) {
    return read_whole(text, 1, most, request.width) && read_whole(text, 1, most, request.height);
  }
  return read_whole(text.substr(0, cross), 1, most, request.width) &&
         read_whole(text.substr(cross + 1), 1, most, request.height);
}

bool read_udim(std::string_view text, Request& request) {
  int number = 0;
  if (!read_whole(text, 1001, 9999, number)) return false;
  request.corner_u = (number - 1001) % 10;
  request.corner_v = (number - 1001) / 10;
  // Beyond its edges are other tiles, not itself again.
  if (request.wrap.empty()) request.wrap = "clamp";
  return true;
}

bool read_accuracy(std::string_view text, Request& request) {
  if (text == "precise") request.accuracy = Accuracy::precise;
  if (text == "standard") request.accuracy = Accuracy::standard;
  if (text == "fast") request.accuracy = Accuracy::fast;
  return text == "precise" || text == "standard" || text == "fast";
}

bool read_format(std::string_view text, Request& request) {
  request.is_half = text == "half";
  return text == "half" || text == "float";
}

bool read_wrap(std::string_view text, Request& request) {
  request.wrap = text;
  return text == "black" || text == "clamp" || text == "periodic" || text == "mirror";
}

bool read_text(std::string_view text, std::string& value) {
  value = text;
  return !text.empty();
}

/// A key, what it may be, and how that is read.
struct Key {
  std::string_view name;
  std::string_view expected;
  bool (*read)(std::string_view text, Request& request);
};

constexpr std::array keys = std::to_array<Key>({
    {"accuracy", "precise, standard or fast", read_accuracy},
    {"anisotropy", "1 to 64",
     [](std::string_view text, Request& request) {
       return read_whole(text, 1, 64, request.anisotropy);
     }},
    {"format", "float or half", read_format},
    {"frame", "a number",
     [](std::string_view text, Request& request) { return read_number(text, request.frame); }},
    {"output", "GRAPH/NAME",
     [](std::string_view text, Request& request) { return read_text(text, request.output); }},
    {"profile", "a file that 'nacre tune' wrote",
     [](std::string_view text, Request& request) { return read_text(text, request.profile); }},
    {"samples", "1 to 64 points on a side of a texel",
     [](std::string_view text, Request& request) {
       return read_whole(text, 1, 64, request.samples);
     }},
    {"size", "N or WxH with 1 to 65536 texels", read_size},
    {"time", "a number of seconds",
     [](std::string_view text, Request& request) { return read_number(text, request.time); }},
    {"udim", "the number of a tile, 1001 to 9999", read_udim},
    {"wrap", "black, clamp, mirror or periodic", read_wrap},
});

std::string names_of_keys() {
  std::string names;
  for (const Key& key : keys) names.append(names.empty() ? "" : ", ").append(key.name);
  return names;
}

/// What a configuration says and the name does not.
void add_config(const OIIO::ImageSpec& config, std::map<std::string, std::string>& values) {
  for (const OIIO::ParamValue& attribute : config.extra_attribs) {
    const std::string name = attribute.name().string();
    if (!name.starts_with(config_prefix)) continue;  // Of other readers, or OpenImageIO's own.
    values.emplace(name.substr(config_prefix.size()), attribute.get_string());
  }
}

}  // namespace

Request read_request(const std::string& name, const OIIO::ImageSpec* config) {
  ImageName asked = follow(split_name(name));
  if (config != nullptr) add_config(*config, asked.values);
  Request request;
  request.document = asked.file;
  // In the order of the table: "wrap" counts before what "udim" means by itself.
  std::map<std::string, std::string> left = asked.values;
  for (const Key& key : keys) {
    const auto given = left.find(std::string(key.name));
    if (given == left.end()) continue;
    if (!key.read(given->second, request)) {
      throw Wrong(asked.file, "bad-query", '\'' + given->first + "' cannot be that",
                  std::string(key.expected), '\'' + given->second + '\'');
    }
    left.erase(given);
  }
  if (!left.empty()) {
    throw Wrong(asked.file, "bad-query", "nothing of an image is called so", names_of_keys(),
                '\'' + left.begin()->first + '\'');
  }
  if (request.wrap.empty()) request.wrap = "periodic";
  return request;
}

}  // namespace graph_image
