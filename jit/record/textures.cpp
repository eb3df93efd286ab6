#include "jit/record/textures.h"

#include <algorithm>
#include <array>
#include <utility>

#include "runtime/texture/tile_set.h"

namespace nacre {

TextureSource RecordedTextures::add(const TextureHandle& texture, const std::string& key) {
  TextureSource source;
  source.slot = Int(recorder_.texture(key));
  const auto slot = static_cast<std::size_t>(source.slot.constant());
  if (slots_.size() <= slot) slots_.resize(slot + 1);
  slots_[slot] = texture;
  const auto words = texture->words();
  source.state = texture->missing()    ? TextureSource::State::missing
                 : texture->resident() ? TextureSource::State::resident
                                       : TextureSource::State::on_host;
  source.format = static_cast<texture_layout::TexelFormat>(words[texture_layout::word_format]);
  source.channels = static_cast<int>(words[texture_layout::word_channels]);
  source.single = words[texture_layout::word_level_count] == 1;
  return source;
}

void RecordedTextures::warn(const Diagnostics& problems) {
  for (Diagnostic problem : problems.all()) {
    problem.severity = std::min(problem.severity, Severity::warning);
    problem.message += "; the node's default is used";
    if (!where_.file.empty() || !where_.path.empty()) {
      if (!problem.found.empty()) problem.found += " in ";
      problem.found.append("'").append(problem.where.file).append("'");
      problem.where = where_;
    }
    diagnostics_.add(std::move(problem));
  }
}

TextureSources RecordedTextures::find(const std::string& name, const std::string& layer) {
  const std::string key = name + '|' + layer;
  if (const auto known = found_.find(key); known != found_.end()) return known->second;
  TextureSources sources;
  sources.max_anisotropy = max_anisotropy_;
  Diagnostics problems;
  if (name.empty()) {
    // No file named: the node's default, without a complaint.
  } else if (has_tile_token(name)) {
    const TextureSet set = acquire_set(store_, {.path = name, .layer = layer}, problems);
    sources.directory = set.directory;
    for (std::size_t i = 0; i < set.textures.size(); ++i) {
      sources.images.push_back(add(set.textures[i], key + '#' + std::to_string(i)));
    }
  } else {
    sources.images.push_back(add(store_.acquire({.path = name, .layer = layer}, problems), key));
  }
  warn(problems);
  found_.emplace(key, sources);
  return sources;
}

std::vector<TextureBinding> RecordedTextures::bindings() const {
  std::vector<TextureBinding> bindings;
  for (const TextureHandle& texture : slots_) {
    bindings.push_back({texture->words().data(), texture->words().size()});
  }
  return bindings;
}

void RecordedTextures::look_up(void* user, const TextureCall* call) {
  const auto* self = static_cast<const RecordedTextures*>(user);
  if (call->slot >= self->slots_.size() || self->slots_[call->slot]->host() == nullptr) return;
  const auto lanes = static_cast<std::size_t>(call->lanes);
  const TextureModes modes = unpack_modes(call->modes);
  const HostLookup lookup{.count = static_cast<int>(call->lanes),
                          .u = call->u,
                          .v = call->v,
                          .dudx = call->dudx,
                          .dvdx = call->dvdx,
                          .dudy = call->dudy,
                          .dvdy = call->dvdy,
                          .filter = modes.filter,
                          .u_mode = modes.u,
                          .v_mode = modes.v,
                          .max_anisotropy = modes.max_anisotropy};
  self->slots_[call->slot]->host()->lookup(
      lookup, {call->rgba, call->rgba + lanes, call->rgba + 2 * lanes, call->rgba + 3 * lanes});
}

}  // namespace nacre
