#include "examples/tool/render/crop_option.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace nacre::tool {

void add_crop(CLI::App& command, host::RenderSettings& settings) {
  command
      .add_option_function<std::vector<int>>(
          "--crop",
          [&settings](const std::vector<int>& at) {
            settings.crop = host::PixelWindow{at[0], at[1], at[2], at[3]};
          },
          "Trace these pixels alone, with the bits that they have in the whole picture: columns X0 "
          "to X1 - 1, rows Y0 to Y1 - 1, from the upper left. The .exr has them as its data window "
          "within the display window, the .png has nothing else")
      ->expected(4)
      ->type_name("X0 Y0 X1 Y1");
}

void check_crop(const host::RenderSettings& settings, Diagnostics& diagnostics) {
  if (!settings.crop) return;
  const host::PixelWindow& crop = *settings.crop;
  const host::PixelWindow whole{0, 0, settings.width, settings.height};
  if (!crop.empty() && host::both(crop, whole) == crop) return;
  diagnostics.error(
      "bad-crop", {}, "the picture has no such window",
      fmt::format("0 <= X0 < X1 <= {} and 0 <= Y0 < Y1 <= {}", settings.width, settings.height),
      fmt::format("--crop {} {} {} {}", crop.x0, crop.y0, crop.x1, crop.y1));
}

void report_crop(const host::RenderSettings& settings, const std::string& file,
                 Diagnostics& diagnostics) {
  if (!settings.crop || file.ends_with(".exr")) return;
  Diagnostic said;
  said.severity = Severity::note;
  said.code = "crop-alone";
  said.where.file = file;
  said.message = fmt::format(
      "the image is the crop alone, {} by {} pixels; an .exr says where in "
      "the picture it is",
      settings.crop->width(), settings.crop->height());
  diagnostics.add(said);
}

}  // namespace nacre::tool
