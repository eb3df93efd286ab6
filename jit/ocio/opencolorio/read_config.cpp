#include "jit/ocio/opencolorio/read_config.h"

#include <algorithm>

namespace nacre {

ocio::ConstConfigRcPtr read_config(const std::string& path) {
  // OpenColorIO keeps tables by their files' names, however old; one that is opened
  // again has what its files hold now.
  ocio::ClearAllCaches();
  return ocio::Config::CreateFromFile(path.c_str());
}

std::string reason(const std::exception& exception) {
  std::string text = exception.what();
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text.empty() ? "no reason given by OpenColorIO" : text;
}

}  // namespace nacre
