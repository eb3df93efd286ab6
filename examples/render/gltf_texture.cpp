#include "examples/render/gltf_texture.h"

#include <fmt/format.h>

#include <utility>

namespace nacre::host {

namespace {

using Wrap = SceneTexture::Wrap;

/// glTF 2.0, 5.26: numbers of OpenGL's.
enum Sampler : std::size_t {
  nearest = 9728,
  clamp_to_edge = 33071,
  mirrored_repeat = 33648,
  repeat = 10497,
};

Wrap wrap(const GltfValue& mode) {
  switch (mode.count().value_or(repeat)) {
    case clamp_to_edge: return Wrap::clamp;
    case mirrored_repeat: return Wrap::mirror;
    case repeat: return Wrap::repeat;
    default: mode.error("there is no such wrap mode", "33071, 33648 or 10497", mode.shown());
  }
  return Wrap::repeat;
}

Vec2 vec2(const GltfValue& value, Vec2 otherwise) {
  const auto list = value.numbers(2);
  if (!list) return otherwise;
  return {static_cast<float>((*list)[0]), static_cast<float>((*list)[1])};
}

/// The extension of a file of that format; "" if no reader has it.
std::string extension_of(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return ".png";
  if (bytes.starts_with("\xff\xd8")) return ".jpg";
  return {};
}

}  // namespace

std::optional<SceneTexture> GltfTextures::read(const GltfValue& info) {
  if (!info) return {};
  const GltfValue textures = root_["textures"];
  const auto number = info["index"].need("the index of a texture").index_of(textures);
  if (!number) return {};
  const GltfValue texture = textures[*number];
  SceneTexture result;
  const auto place = source(texture);
  if (!place) return {};
  result.image = *place;
  const GltfValue samplers = root_["samplers"];
  if (const auto chosen = texture["sampler"].index_of(samplers)) {
    const GltfValue sampler = samplers[*chosen];
    result.wrap_u = wrap(sampler["wrapS"]);
    result.wrap_v = wrap(sampler["wrapT"]);
    result.is_closest = sampler["magFilter"].count().value_or(0) == nearest;
  }
  const GltfValue transform = info["extensions"]["KHR_texture_transform"];
  const GltfValue own = transform["texCoord"];
  result.set = (own ? own : info["texCoord"]).count().value_or(0);
  result.offset = vec2(transform["offset"], result.offset);
  result.scale = vec2(transform["scale"], result.scale);
  result.rotation = static_cast<float>(transform["rotation"].number().value_or(0.0));
  return result;
}

/// Where the image of a texture is in `images_`.
std::optional<std::size_t> GltfTextures::source(const GltfValue& texture) {
  const GltfValue images = root_["images"];
  const GltfValue wanted = texture["source"];
  if (!wanted) {
    const auto names = texture["extensions"].names();
    dropped_.say("texture-not-rendered", texture, "a texture has no image that can be read",
                 "PNG or JPEG", names.empty() ? "none" : names.front());
    return {};
  }
  const auto number = wanted.index_of(images);
  return number ? image(*number) : std::nullopt;
}

std::optional<std::size_t> GltfTextures::image(std::size_t number) {
  const GltfValue images = root_["images"];
  if (places_.empty()) places_.resize(images.size());
  if (places_[number]) return places_[number];
  auto found = read_image(images[number]);
  if (!found) return {};
  places_[number] = images_.size();
  images_.push_back(std::move(*found));
  return places_[number];
}

std::optional<SceneImage> GltfTextures::read_image(const GltfValue& image) {
  SceneImage result;
  const GltfValue uri = image["uri"];
  const auto text = uri.text();
  if (text && !GltfBuffers::is_data(*text)) {
    result.file = GltfBuffers::file_name(*text);
    return result;
  }
  if (uri && !text) return {};
  std::optional<std::string> bytes;
  if (text) {
    bytes = GltfBuffers::data(uri);
  } else if (const auto view = buffers_.view(image["bufferView"])) {
    bytes.emplace(*view);
  }
  if (!bytes) return {};
  result.extension = extension_of(*bytes);
  result.bytes = std::make_shared<const std::string>(std::move(*bytes));
  if (!result.extension.empty()) return result;
  dropped_.say("texture-not-rendered", image, "a texture has no image that can be read",
               "PNG or JPEG", image["mimeType"].shown());
  return {};
}

}  // namespace nacre::host
