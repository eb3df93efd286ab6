#include "nodes/texture2d/image_file.h"

#include <algorithm>
#include <array>
#include <string>

namespace nacre {

namespace {

template <class E, std::size_t N>
E parse(NodeCall& call, std::string_view input, E otherwise,
        const std::array<std::string_view, N>& names) {
  const std::string& text = call.text(input);
  const auto found = std::ranges::find(names, text);
  if (found != names.end()) return static_cast<E>(found - names.begin());
  if (!text.empty()) {
    std::string expected;
    for (const std::string_view name : names) {
      expected += (expected.empty() ? "" : ", ") + std::string(name);
    }
    call.diagnostics().warning("unknown-value", call.where(),
                               "input '" + std::string(input) + "' has no such value", expected,
                               text);
  }
  return otherwise;
}

}  // namespace

TextureFilter parse_filter(NodeCall& call, std::string_view input) {
  return parse(call, input, TextureFilter::linear,
               std::array<std::string_view, 3>{"closest", "linear", "cubic"});
}

AddressMode parse_address_mode(NodeCall& call, std::string_view input) {
  // USD's word, which the data library's UsdUVTexture hands on.
  if (call.text(input) == "black") return AddressMode::constant;
  return parse(call, input, AddressMode::periodic,
               std::array<std::string_view, 4>{"constant", "clamp", "periodic", "mirror"});
}

TextureSources find_image(NodeCall& call) {
  if (call.textures() == nullptr) return {};
  return call.textures()->find(call.text("file"),
                               call.has("layer") ? call.text("layer") : std::string());
}

bool is_missing(const TextureSources& sources) {
  return std::ranges::all_of(sources.images, [](const TextureSource& image) {
    return image.state == TextureSource::State::missing;
  });
}

Float4 widened(const Recorded& value) {
  const auto part = [&](std::size_t i) {
    return i < value.parts.size() ? value.number(i) : Float(0.0f);
  };
  return {part(0), part(1), part(2), part(3)};
}

void set_components(NodeCall& call, const Float4& v) {
  std::vector<Ref> parts{v.x.ref(), v.y.ref(), v.z.ref(), v.w.ref()};
  parts.resize(static_cast<std::size_t>(component_count(call.out_type())));
  call.set(std::move(parts));
}

}  // namespace nacre
