#include "bench/textures/oiio.h"

#include <OpenImageIO/texture.h>

namespace nacre::bench {

struct OiioTexture::State {
  OIIO::TextureSystem* system = OIIO::TextureSystem::create(false);
  OIIO::TextureSystem::Perthread* thread = nullptr;
  OIIO::TextureSystem::TextureHandle* handle = nullptr;
  OIIO::TextureOpt options;

  ~State() { OIIO::TextureSystem::destroy(system); }
};

OiioTexture::OiioTexture(const std::string& path, Filter filter)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.system->attribute("max_memory_MB", 1024.0f);
  s.thread = s.system->get_perthread_info();
  s.handle = s.system->get_texture_handle(OIIO::ustring(path), s.thread);
  s.options.swrap = OIIO::TextureOpt::WrapPeriodic;
  s.options.twrap = OIIO::TextureOpt::WrapPeriodic;
  s.options.mipmode = filter == Filter::anisotropic ? OIIO::TextureOpt::MipModeAniso
                      : filter == Filter::trilinear ? OIIO::TextureOpt::MipModeTrilinear
                                                    : OIIO::TextureOpt::MipModeNoMIP;
  s.options.interpmode = filter == Filter::closest ? OIIO::TextureOpt::InterpClosest
                                                   : OIIO::TextureOpt::InterpBilinear;
}

OiioTexture::~OiioTexture() = default;

bool OiioTexture::look_up(const Lookups& points, std::size_t first, std::size_t count,
                          Rgba& rgba) const {
  State& s = *state_;
  const float d = points.footprint;
  bool good = true;
  for (std::size_t i = 0; i < count; ++i) {
    float texel[4];
    // Its t points down.
    good &=
        s.system->texture(s.handle, s.thread, s.options, points.u[first + i],
                          1.0f - points.v[first + i], points.aspect * d, 0.0f, 0.0f, -d, 4, texel);
    for (std::size_t c = 0; c < 4; ++c) rgba[c][i] = texel[c];
  }
  return good;
}

}  // namespace nacre::bench
