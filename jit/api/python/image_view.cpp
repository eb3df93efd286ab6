#include "jit/api/python/image_view.h"

#include <array>
#include <limits>
#include <string_view>

#include "jit/api/python/errors.h"

namespace nacre::python {

namespace {

struct Samples {
  std::string_view type;
  int samples;
  std::ptrdiff_t bytes;
};

constexpr std::array sample_types{
    Samples{"uint8", NACRE_UINT8, 1}, Samples{"uint16", NACRE_UINT16, 2},
    Samples{"float16", NACRE_HALF, 2}, Samples{"float32", NACRE_FLOAT32, 4}};

const Samples* samples_of(const ArrayView& view) {
  for (const Samples& each : sample_types) {
    if (each.type == view.type) return &each;
  }
  return nullptr;
}

/// Whether the pixels of a row, and the channels of a pixel, lie side by side.
bool has_dense_rows(const ArrayView& view, std::ptrdiff_t channels, std::ptrdiff_t bytes) {
  const bool has_dense_pixels = view.shape.size() == 2 || channels == 1 || view.strides[2] == bytes;
  return has_dense_pixels && (view.shape[1] <= 1 || view.strides[1] == channels * bytes);
}

bool is_length(std::ptrdiff_t length) {
  return length > 0 && length <= std::numeric_limits<int>::max();
}

}  // namespace

ImageView::ImageView(nanobind::handle object, const std::string& name) {
  const std::string message = "'" + name + "' cannot be made of this";
  const char* const expected =
      "an array (height, width, 1 to 4 channels) of uint8, uint16, float16 or float32 with the "
      "pixels of a row side by side";
  std::optional<ArrayView> view = ArrayView::of(object);
  if (!view) refuse("bad-array", name, message, expected, Py_TYPE(object.ptr())->tp_name);
  const Samples* const samples = samples_of(*view);
  const std::size_t axes = view->shape.size();
  const std::ptrdiff_t channels = axes == 3 ? view->shape[2] : 1;
  const bool is_image = samples != nullptr && view->device == "cpu" && (axes == 2 || axes == 3) &&
                        channels >= 1 && channels <= 4 && is_length(view->shape[0]) &&
                        is_length(view->shape[1]) &&
                        has_dense_rows(*view, channels, samples->bytes);
  if (!is_image) refuse("bad-array", name, message, expected, view->text());
  image_ = {.width = static_cast<int>(view->shape[1]),
            .height = static_cast<int>(view->shape[0]),
            .channels = static_cast<int>(channels),
            .samples = samples->samples,
            .pixels = view->data,
            .row_bytes = view->shape[0] > 1 ? view->strides[0] : 0};
  view_ = std::move(*view);
}

}  // namespace nacre::python
