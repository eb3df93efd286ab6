#include "runtime/node/geometry.h"

#include <bit>
#include <string>

#include "runtime/channel/channel_name.h"

namespace nacre {

Space parse_space(std::string_view name) { return name == "world" ? Space::world : Space::object; }

Ref channel(Recorder& recorder, std::string_view group, int component, Scalar type) {
  return recorder.input(channel_text(group, component), type);
}

Float3 channel3(Recorder& recorder, std::string_view group) {
  return {Float(channel(recorder, group, 0)), Float(channel(recorder, group, 1)),
          Float(channel(recorder, group, 2))};
}

Float3 position(Recorder& recorder, Space space) {
  return channel3(recorder, space == Space::world ? "P" : "Po");
}

Float3 normal(Recorder& recorder, Space space) {
  return channel3(recorder, space == Space::world ? "N" : "No");
}

Float3 tangent(Recorder& recorder, Space space) {
  return channel3(recorder, space == Space::world ? "T" : "To");
}

Float3 bitangent(Recorder& recorder, Space space) {
  return channel3(recorder, space == Space::world ? "B" : "Bo");
}

Float3 geometric_normal(Recorder& recorder) { return channel3(recorder, "Ng"); }

Float2 texcoord(Recorder& recorder, int set) {
  const std::string group = "uv" + std::to_string(set);
  return {Float(channel(recorder, group, 0)), Float(channel(recorder, group, 1))};
}

Float3 view_direction(Recorder& recorder) { return channel3(recorder, "wo"); }

Float uniform(Recorder& recorder, std::string_view name, float value) {
  return Float(recorder.parameter(name, Scalar::f32, std::bit_cast<std::uint32_t>(value)));
}

}  // namespace nacre
