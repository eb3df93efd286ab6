#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/diagnostic.h"

namespace nacre::host {

/// Where what a glTF file says wrong is put down.
struct GltfReport {
  std::string file;
  Diagnostics& diagnostics;

  void error(const std::string& path, std::string message, std::string expected,
             std::string found) const {
    diagnostics.error("bad-gltf", {file, 0, 0, path}, std::move(message), std::move(expected),
                      std::move(found));
  }
  void warning(const char* code, const std::string& path, std::string message,
               std::string expected = {}, std::string found = {}) const {
    diagnostics.warning(code, {file, 0, 0, path}, std::move(message), std::move(expected),
                        std::move(found));
  }
};

/// A value of a glTF file, or the lack of one, and its place: "nodes[3].mesh". Asking a
/// value for what it is not gives nothing and an error; asking one that is not there gives
/// nothing, and an error from those that `need` it.
class GltfValue {
 public:
  using Json = nlohmann::json;

  GltfValue(const Json* json, std::string path, const GltfReport& report)
      : json_(json), path_(std::move(path)), report_(&report) {}

  explicit operator bool() const { return json_ != nullptr; }
  const std::string& path() const { return path_; }
  const GltfReport& report() const { return *report_; }
  SourceLocation location() const { return {report_->file, 0, 0, path_}; }

  GltfValue operator[](const char* name) const;
  /// The element; not there when beyond the end.
  GltfValue operator[](std::size_t i) const;
  /// Of an array; 0 for what is not there.
  std::size_t size() const;
  /// Names of an object's members, in their alphabetical order.
  std::vector<std::string> names() const;

  /// A whole number of at least 0.
  std::optional<std::size_t> count() const;
  /// An index of the elements of `list`, which may be missing.
  std::optional<std::size_t> index_of(const GltfValue& list) const;
  /// A number that a float can hold.
  std::optional<double> number() const;
  /// A number in [low, high]; `otherwise` where it is not there; none after an error.
  std::optional<float> within(double low, double high, float otherwise) const;
  /// Exactly `n` of them.
  std::optional<std::vector<double>> numbers(std::size_t n) const;
  std::optional<std::string> text() const;
  std::optional<bool> boolean() const;
  /// Its member "name", or "". An error if that is longer than 1024 bytes, for paths
  /// repeat what stands above them.
  std::string name() const;

  /// This value; an error if it is not there.
  const GltfValue& need(const char* expected) const;

  void error(std::string message, std::string expected, std::string found) const {
    report_->error(path_, std::move(message), std::move(expected), std::move(found));
  }
  /// As a message shows it.
  std::string shown() const;

 private:
  void wrong(const char* expected) const;

  const Json* json_;
  std::string path_;
  const GltfReport* report_;
};

}  // namespace nacre::host
