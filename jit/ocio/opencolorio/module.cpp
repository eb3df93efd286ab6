#include "jit/ocio/opencolorio/module.h"

const nacre::ModuleHead* nacre_module() {
  static constexpr nacre::OcioModule module{
      {NACRE_BUILD_KEY, "nacre_colors"}, nacre::load_config, nacre::load_view};
  return &module;
}
