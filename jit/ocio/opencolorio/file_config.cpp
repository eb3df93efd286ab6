#include <algorithm>
#include <array>
#include <exception>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "jit/ocio/opencolorio/module.h"
#include "jit/ocio/opencolorio/read_config.h"

namespace nacre {

namespace {

/// Tetrahedral interpolation is worked out in the text, from texels read at their
/// centres.
TextTable::Filter filter_of(ocio::Interpolation interpolation) {
  const bool is_nearest =
      interpolation == ocio::INTERP_NEAREST || interpolation == ocio::INTERP_TETRAHEDRAL;
  return is_nearest ? TextTable::Filter::nearest : TextTable::Filter::linear;
}

TextTable make_table(const char* name, std::array<std::size_t, 3> size, std::size_t channels,
                     ocio::Interpolation interpolation, const float* values) {
  TextTable table{name, size, channels, filter_of(interpolation), nullptr};
  const std::size_t count = channels * size[0] * size[1] * size[2];
  table.values = std::make_shared<TableValues>(std::vector<float>(values, values + count));
  return table;
}

std::vector<TextTable> tables_of(const ocio::GpuShaderDesc& shader) {
  std::vector<TextTable> tables;
  const char* texture = nullptr;
  const char* sampler = nullptr;
  ocio::Interpolation interpolation = ocio::INTERP_LINEAR;
  const float* values = nullptr;
  for (unsigned i = 0; i < shader.getNumTextures(); ++i) {
    unsigned width = 0, height = 0;
    auto kind = ocio::GpuShaderDesc::TEXTURE_RGB_CHANNEL;
    shader.getTexture(i, texture, sampler, width, height, kind, interpolation);
    shader.getTextureValues(i, values);
    const std::size_t channels = kind == ocio::GpuShaderDesc::TEXTURE_RED_CHANNEL ? 1 : 3;
    tables.push_back(
        make_table(sampler, {width, std::max(height, 1u), 1}, channels, interpolation, values));
  }
  for (unsigned i = 0; i < shader.getNum3DTextures(); ++i) {
    unsigned edge = 0;
    shader.get3DTexture(i, texture, sampler, edge, interpolation);
    shader.get3DTextureValues(i, values);
    tables.push_back(make_table(sampler, {edge, edge, edge}, 3, interpolation, values));
  }
  return tables;
}

class FileConfig : public ColorConfig {
 public:
  FileConfig(std::string name, ocio::ConstConfigRcPtr config)
      : name_(std::move(name)), config_(std::move(config)) {}

  std::string name() const override { return name_; }

  std::optional<Space> find(std::string_view name) const override {
    const auto space = config_->getColorSpace(std::string(name).c_str());
    if (space == nullptr) return std::nullopt;
    return Space{space->getName(), space->isData()};
  }

  /// Of all spaces, and their other names.
  std::vector<std::string> names() const override {
    std::vector<std::string> all;
    for (int i = 0; i < config_->getNumColorSpaces(); ++i) {
      const auto space = config_->getColorSpace(config_->getColorSpaceNameByIndex(i));
      if (space == nullptr) continue;
      all.emplace_back(space->getName());
      for (std::size_t k = 0; k < space->getNumAliases(); ++k) all.emplace_back(space->getAlias(k));
    }
    for (int i = 0; i < config_->getNumRoles(); ++i) all.emplace_back(config_->getRoleName(i));
    return all;
  }

  std::shared_ptr<const ColorTransform> transform(const std::string& from, const std::string& to,
                                                  std::string& fault) const override {
    const std::lock_guard lock(mutex_);
    auto& known = transforms_[{from, to}];
    if (known == nullptr) known = make(from, to, fault);
    return known;
  }

 private:
  std::shared_ptr<const ColorTransform> make(const std::string& from, const std::string& to,
                                             std::string& fault) const {
    const Quiet quiet;
    try {
      const auto processor =
          config_->getProcessor(from.c_str(), to.c_str())
              ->getOptimizedGPUProcessor(static_cast<ocio::OptimizationFlags>(
                  ocio::OPTIMIZATION_LOSSLESS | ocio::OPTIMIZATION_NO_DYNAMIC_PROPERTIES));
      auto shader = ocio::GpuShaderDesc::CreateShaderDesc();
      shader->setLanguage(ocio::GPU_LANGUAGE_GLSL_4_0);
      shader->setFunctionName("color_transform");
      processor->extractGpuShaderInfo(shader);
      if (shader->getNumUniforms() != 0) {
        fault = "it has properties that change from frame to frame";
        return nullptr;
      }
      auto made = std::make_shared<ColorTransform>();
      made->text = shader->getShaderText();
      made->function = "color_transform";
      made->tables = tables_of(*shader);
      return made;
    } catch (const std::exception& exception) {
      fault = reason(exception);
      return nullptr;
    }
  }

  std::string name_;
  ocio::ConstConfigRcPtr config_;
  mutable std::mutex mutex_;
  mutable std::map<std::pair<std::string, std::string>, std::shared_ptr<const ColorTransform>>
      transforms_;
};

}  // namespace

std::shared_ptr<const ColorConfig> load_config(const std::string& path, std::string& fault) {
  const Quiet quiet;
  try {
    return std::make_shared<FileConfig>(path, read_config(path));
  } catch (const std::exception& exception) {
    fault = reason(exception);
    return nullptr;
  }
}

}  // namespace nacre
