#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "examples/tool/help/option_text.h"

namespace nacre::tool {

/// --help, which fits a screen, and --help-all. CLI11 asks an application's formatter for both.
class Help : public CLI::FormatterBase {
 public:
  explicit Help(HelpTexts texts) : texts_(std::move(texts)) {}

  const HelpTexts& texts() const { return texts_; }
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;

 private:
  HelpTexts texts_;
};

}  // namespace nacre::tool
