#pragma once

#include <stdexcept>
#include <string>

namespace graph_image {

/// What is wrong with what was asked for, in the words that the library has for documents:
/// "FILE: error: MESSAGE; expected THIS, found THAT [code]".
class Wrong : public std::runtime_error {
 public:
  Wrong(const std::string& file, const std::string& code, const std::string& message,
        const std::string& expected = {}, const std::string& found = {})
      : std::runtime_error(file + ": error: " + message +
                           (expected.empty() ? "" : "; expected " + expected) +
                           (found.empty() ? "" : (expected.empty() ? "; found " : ", found ")) +
                           found + " [" + code + "]") {}
};

}  // namespace graph_image
