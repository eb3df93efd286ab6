#include "jit/record/textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "runtime/read_file.h"
#include "runtime/texture/similar_name.h"
#include "runtime/texture/tile_set.h"

namespace nacre {

std::string RecordedTextures::accept(const ResolvedFile& file) {
  if (file.bytes == nullptr) {
    given_[file.path] = {file.path, nullptr};
    return file.path;
  }
  auto contents = store_.keep_file(*file.bytes);
  // Without room for it a place that leads nowhere: a file of the disk must not stand in for it.
  const std::string path = contents != nullptr ? contents->path() : MemoryFile::nowhere;
  given_[path] = {file.path, std::move(contents)};
  return path;
}

bool RecordedTextures::may_read(const std::string& path) const {
  return !access_.may_read || given_.contains(path) || access_.may_read(path);
}

TextureSource RecordedTextures::add(Slot bound, const std::string& key) {
  const bool may_change = bound.image != nullptr;
  const TextureHandle texture = may_change ? bound.image->get() : bound.texture;
  TextureSource source;
  source.slot = Int(recorder_.texture(key));
  const auto slot = static_cast<std::size_t>(source.slot.constant());
  if (slots_.size() <= slot) slots_.resize(slot + 1);
  slots_[slot] = std::move(bound);
  const auto words = texture->words();
  source.state = texture->missing()    ? TextureSource::State::missing
                 : texture->resident() ? TextureSource::State::resident
                                       : TextureSource::State::by_call;
  source.format = static_cast<texture_layout::TexelFormat>(words[texture_layout::word_format]);
  source.channels = static_cast<int>(words[texture_layout::word_channels]);
  source.single = words[texture_layout::word_level_count] == 1;
  if (!may_change && !deferred_.contains(texture)) source.uniform = texture->uniform();
  return source;
}

void RecordedTextures::complain(const Diagnostics& problems) {
  for (Diagnostic problem : problems.all()) {
    if (access_.missing == MissingImages::use_default) {
      problem.severity = std::min(problem.severity, Severity::warning);
    }
    problem.message += "; the node's default is used";
    if (problem.code == "missing-image" && !has_tile_token(problem.where.file)) {
      const std::string other = find_other_case(problem.where.file);
      const bool may_say = !other.empty() && may_read(other);
      if (may_say) problem.expected = "a file of this name; there is '" + other + "'";
    }
    if (!where_.file.empty() || !where_.path.empty()) {
      if (!problem.found.empty()) problem.found += " in ";
      problem.found.append("'").append(problem.where.file).append("'");
      problem.where = where_;
    }
    if (problem.severity == Severity::error) ++errors_;
    diagnostics_.add(std::move(problem));
  }
}

/// A file outside is refused in the same words whether it is there or not.
TextureHandle RecordedTextures::acquire(const TextureKey& key, Diagnostics& problems) {
  if (may_read(key.path)) return acquire_allowed(key, problems);
  Diagnostic problem;
  problem.code = "image-outside";
  problem.where.file = key.path;
  problem.message = "the image is outside the allowed folders";
  problem.expected = "a file below the document's folder or a search path";
  problems.add(problem);
  return std::make_shared<Texture>(std::move(problem));
}

TextureSet RecordedTextures::acquire_tiles(const TextureKey& pattern, Diagnostics& problems) {
  // Nothing is listed outside, and a link in a folder may lead there.
  if (!may_read(pattern.path)) {
    acquire(pattern, problems);
    return {};
  }
  const bool is_given = given_.contains(pattern.path);
  if (!is_given) files_.emplace(pattern.path, FileIdentity{});
  return acquire_set(store_, pattern, problems, [&](const TextureKey& tile) {
    return is_given ? acquire_allowed(tile, problems) : acquire_tile(tile, problems);
  });
}

/// Now, or what stands for it until it is wanted.
TextureHandle RecordedTextures::acquire_tile(const TextureKey& key, Diagnostics& problems) {
  if (access_.defers_tiles && may_read(key.path)) {
    TextureHandle stand_in = store_.stand_in(key, access_.stop);
    if (stand_in != nullptr) {
      deferred_.emplace(stand_in, key);
      return stand_in;
    }
  }
  return acquire(key, problems);
}

/// What is called otherwise is complained of by that name.
TextureHandle RecordedTextures::acquire_allowed(const TextureKey& key, Diagnostics& problems) {
  const auto given = given_.find(key.path);
  if (given == given_.end()) {
    files_.emplace(key.path, identify(key.path));
    return store_.acquire(key, problems, access_.stop);
  }
  Diagnostics said;
  TextureHandle texture = store_.acquire(key, said, access_.stop);
  for (Diagnostic problem : said.all()) {
    problem.where.file = given->second.name;
    problems.add(std::move(problem));
  }
  return texture;
}

/// Of the host's images in memory, of its texture system, or a file.
TextureSource RecordedTextures::find_image(const std::string& name, const std::string& layer,
                                           const std::string& key, Diagnostics& problems) {
  if (auto image = store_.image(name)) return add({nullptr, std::move(image)}, key);
  return add({acquire({.path = name, .layer = layer}, problems), nullptr}, key);
}

TextureSources RecordedTextures::find(const std::string& name, const std::string& layer) {
  const std::string key = name + '|' + layer;
  if (const auto known = found_.find(key); known != found_.end()) return known->second;
  TextureSources sources;
  sources.max_anisotropy = max_anisotropy_;
  Diagnostics problems;
  TextureSystem* const system = store_.options().system.get();
  std::optional<TextureSystem::Opened> opened;
  if (system != nullptr && !name.empty()) opened = system->open(name, layer);
  if (name.empty()) {
    // No file named: the node's default, without a complaint.
  } else if (opened) {
    sources.images.push_back(add(
        {std::make_shared<Texture>(std::move(opened->sampler), opened->width, opened->height), {}},
        key));
  } else if (has_tile_token(name)) {
    const TextureSet set = acquire_tiles({.path = name, .layer = layer}, problems);
    sources.directory = set.directory;
    for (std::size_t i = 0; i < set.textures.size(); ++i) {
      sources.images.push_back(add({set.textures[i], nullptr}, key + '#' + std::to_string(i)));
    }
  } else {
    sources.images.push_back(find_image(name, layer, key, problems));
  }
  complain(problems);
  found_.emplace(key, sources);
  return sources;
}

std::vector<std::string> RecordedTextures::uniform_texels() const {
  std::vector<std::string> lines;
  for (const auto& [key, sources] : found_) {
    // Of tiles a point may see another one, or none: nothing is left out for their sake.
    if (sources.images.size() != 1 || !sources.directory.empty()) continue;
    const TextureSource& image = sources.images.front();
    std::string known;
    for (std::size_t c = 0; c < image.uniform.size(); ++c) {
      if (!image.uniform[c]) continue;
      const float value = *image.uniform[c] / texture_layout::step_of_one(image.format);
      known += fmt::format("{}{} is {}", known.empty() ? "" : ", ", "rgba"[c], value);
    }
    const std::string name = key.substr(0, key.rfind('|'));
    if (!known.empty()) lines.push_back(fmt::format("image {}: {} everywhere", name, known));
  }
  return lines;
}

std::optional<std::string> RecordedTextures::read(const std::string& name) {
  constexpr std::uint64_t most_bytes = std::uint64_t{16} << 20;
  Diagnostics problems;
  std::optional<std::string> bytes;
  if (may_read(name)) {
    if (!given_.contains(name)) files_.emplace(name, identify(name));
    bytes = read_file(name, most_bytes, problems);
  } else {
    problems.error("file-outside", {name, 0, 0, {}}, "the file is outside the allowed folders",
                   "a file below the document's folder or a search path");
  }
  complain(problems);
  return bytes;
}

RecordedTextures::Snapshot RecordedTextures::snapshot() const {
  Snapshot now;
  for (const Slot& slot : slots_) {
    const TextureHandle& texture =
        now.textures.emplace_back(slot.image != nullptr ? slot.image->get() : slot.texture);
    now.bindings.push_back({texture->words().data(), texture->words().size()});
  }
  return now;
}

namespace {

/// Code made for one texture can read the other.
bool is_alike(const Texture& a, const Texture& b) {
  using namespace texture_layout;
  const auto is_single = [](const Texture& texture) {
    return texture.words()[word_level_count] == 1;
  };
  return b.resident() && a.words()[word_format] == b.words()[word_format] &&
         a.words()[word_channels] == b.words()[word_channels] && is_single(a) == is_single(b);
}

}  // namespace

RecordedTextures::Snapshot RecordedTextures::load_tiles(const std::vector<bool>& wanted,
                                                        std::map<std::string, FileIdentity>& files,
                                                        Diagnostics& diagnostics) const {
  Snapshot now = snapshot();
  const Stop stop(access_.stop.token());  // Its deadline was that of compiling, long ago.
  for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
    const auto deferred = deferred_.find(now.textures[slot]);
    if (deferred == deferred_.end() || !wanted[slot]) continue;
    const std::string& path = deferred->second.path;
    files.emplace(path, identify(path));
    const TextureHandle texture = store_.acquire(deferred->second, diagnostics, stop);
    if (texture->missing()) continue;  // That is said.
    if (!is_alike(*now.textures[slot], *texture)) {
      diagnostics.error(
          "tile-changed", {path, 0, 0, {}},
          texture->resident() ? "the tile is another than when its set was found"
                              : "there is no room for the tile beside the others",
          texture->resident() ? "as many channels of the same type" : "more memory for textures");
      continue;
    }
    now.bindings[slot] = {texture->words().data(), texture->words().size()};
    now.textures[slot] = texture;
  }
  return now;
}

bool RecordedTextures::may_change() const {
  return std::ranges::any_of(slots_, [](const Slot& slot) { return slot.image != nullptr; });
}

namespace {

/// Points `first` to `end` of a call, with an anisotropy of their own.
void look_up_lanes(const TextureSampler& sampler, const TextureCall& call, std::uint32_t first,
                   std::uint32_t end, int max_anisotropy) {
  const TextureModes modes = unpack_modes(call.modes);
  const TextureLookup lookup{.count = static_cast<int>(end - first),
                             .u = call.u + first,
                             .v = call.v + first,
                             .dudx = call.dudx + first,
                             .dvdx = call.dvdx + first,
                             .dudy = call.dudy + first,
                             .dvdy = call.dvdy + first,
                             .filter = modes.filter,
                             .u_mode = modes.u,
                             .v_mode = modes.v,
                             .max_anisotropy = max_anisotropy};
  float* const rgba = call.rgba + first;
  const std::size_t lanes = call.lanes;
  sampler.lookup(lookup, {rgba, rgba + lanes, rgba + 2 * lanes, rgba + 3 * lanes});
}

}  // namespace

void RecordedTextures::look_up(void* user, const TextureCall* call) {
  const auto* self = static_cast<const RecordedTextures*>(user);
  if (call->slot >= self->slots_.size()) return;
  // What is looked up by calls is never replaced.
  const Texture* texture = self->slots_[call->slot].texture.get();
  if (texture == nullptr || texture->sampler() == nullptr) return;
  const std::int32_t* const limits = call->max_anisotropy;
  if (limits == nullptr) {
    const int most = unpack_modes(call->modes).max_anisotropy;
    return look_up_lanes(*texture->sampler(), *call, 0, call->lanes, most);
  }
  // One call where all points have one limit, as mostly.
  for (std::uint32_t first = 0, end = 0; first < call->lanes; first = end) {
    while (end < call->lanes && limits[end] == limits[first]) ++end;
    look_up_lanes(*texture->sampler(), *call, first, end, limits[first]);
  }
}

}  // namespace nacre
