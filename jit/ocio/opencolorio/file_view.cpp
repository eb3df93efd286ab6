#include <algorithm>
#include <array>
#include <exception>
#include <utility>

#include "jit/ocio/opencolorio/module.h"
#include "jit/ocio/opencolorio/read_config.h"

namespace nacre {

namespace {

class FileView : public DisplayView {
 public:
  FileView(Names names, ocio::ConstCPUProcessorRcPtr processor)
      : names_(std::move(names)), processor_(std::move(processor)) {}

  const Names& names() const override { return names_; }

  void apply(std::span<float> rgb) const override {
    const auto pixels = static_cast<long>(rgb.size() / 3);
    if (pixels == 0) return;
    ocio::PackedImageDesc image(rgb.data(), pixels, 1, 3);
    processor_->apply(image);
  }

 private:
  Names names_;
  ocio::ConstCPUProcessorRcPtr processor_;
};

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

/// False, with the fault, where there is none of a name.
bool complete(const ocio::Config& config, DisplayView::Names& names, ViewFault& fault) {
  const auto refuse = [&](const char* code, std::vector<std::string> known) {
    fault = {code, {}, std::move(known)};
    return false;
  };
  std::vector<std::string> displays, views;
  for (int i = 0; i < config.getNumDisplays(); ++i) displays.emplace_back(config.getDisplay(i));
  if (names.display.empty()) names.display = config.getDefaultDisplay();
  if (!has(displays, names.display)) return refuse("unknown-display", std::move(displays));
  const char* const display = names.display.c_str();
  for (int i = 0; i < config.getNumViews(display); ++i) {
    views.emplace_back(config.getView(display, i));
  }
  if (names.view.empty()) names.view = config.getDefaultView(display);
  if (!has(views, names.view)) return refuse("unknown-view", std::move(views));
  return true;
}

/// Rows of ours are for row vectors; OpenColorIO's are for columns, with a fourth of alpha.
ocio::MatrixTransformRcPtr matrix_of(const ColorMatrix& m) {
  std::array<double, 16> columns{};
  columns[15] = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) columns[4 * i + k] = m[k][i];
  }
  auto transform = ocio::MatrixTransform::Create();
  transform->setMatrix(columns.data());
  return transform;
}

ocio::ConstTransformRcPtr way_to(const ocio::Config& config, const DisplayView::Names& names,
                                 const ColorMatrix& to_aces) {
  const auto knows = [&](const char* space) { return config.getColorSpace(space) != nullptr; };
  const bool is_bridged = !knows("lin_rec709") && knows("aces_interchange");
  auto view = ocio::DisplayViewTransform::Create();
  view->setDisplay(names.display.c_str());
  view->setView(names.view.c_str());
  view->setSrc(knows("lin_rec709") ? "lin_rec709"
               : is_bridged        ? "aces_interchange"
                                   : "scene_linear");
  auto way = ocio::GroupTransform::Create();
  if (is_bridged) way->appendTransform(matrix_of(to_aces));
  way->appendTransform(view);
  return way;
}

}  // namespace

std::unique_ptr<DisplayView> load_view(const std::string& path, const DisplayView::Names& names,
                                       const ColorMatrix& to_aces, ViewFault& fault) {
  const Quiet quiet;
  fault.code = "bad-color-config";
  try {
    const ocio::ConstConfigRcPtr config = read_config(path);
    DisplayView::Names completed = names;
    if (!complete(*config, completed, fault)) return nullptr;
    fault.code = "no-view";
    const ocio::ConstProcessorRcPtr processor =
        config->getProcessor(way_to(*config, completed, to_aces), ocio::TRANSFORM_DIR_FORWARD);
    return std::make_unique<FileView>(
        std::move(completed), processor->getOptimizedCPUProcessor(ocio::OPTIMIZATION_LOSSLESS));
  } catch (const std::exception& exception) {
    fault.reason = reason(exception);
    return nullptr;
  }
}

}  // namespace nacre
