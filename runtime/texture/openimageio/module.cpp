#include "runtime/texture/image_module.h"
#include "runtime/texture/openimageio/image_decoder.h"
#include "runtime/texture/openimageio/tile_cache.h"

const nacre::ModuleHead* nacre_module() {
  static constexpr nacre::ImageModule module{
      {NACRE_BUILD_KEY, "nacre_images"}, nacre::make_image_decoder, nacre::make_image_cache};
  return &module;
}
