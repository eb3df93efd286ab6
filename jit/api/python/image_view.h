#pragma once

#include <nanobind/nanobind.h>

#include <nacre/nacre.hpp>
#include <string>

#include "jit/api/python/array_view.h"

namespace nacre::python {

/// An array as an image: (height, width) or (height, width, 1 to 4 channels), row 0 on top, of
/// uint8, uint16, float16 or float32. Rows may lie anywhere, pixels of a row side by side.
/// Throws Error for anything else.
class ImageView {
 public:
  ImageView(nanobind::handle object, const std::string& name);
  const Image& image() const { return image_; }

 private:
  ArrayView view_;
  Image image_;
};

}  // namespace nacre::python
