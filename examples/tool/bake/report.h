#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "examples/bake/texel_statistics.h"
#include "examples/tool/bake/manifest.h"
#include "examples/tool/bake/texture_request.h"

namespace nacre::tool {

/// Seconds that have passed since it was made.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// A file that was baked.
struct BakedMap {
  std::string file;
  std::string output;  ///< The graph's output, or NODE.INPUT of a document.
  Type type = Type::none;
  TextureSettings texture;
  host::TexelStatistics statistics;
  double seconds = 0.0;      ///< To shade and to write it, without compiling.
  bool has_islands = false;  ///< What was baked need not fill it; statistics are of what it has.
  /// Whether this run wrote it, or found that another had.
  enum class State { written, skipped, merged } state = State::written;
};

/// Of an image that another run has baked: one found there, or merged. `has_islands`: see above.
BakedMap kept_map(const std::string& file, const BakedRecord& record,
                  const TextureSettings& texture, bool has_islands, bool is_merged);
/// What a manifest has of an image, but for what BakeLedger adds.
BakedRecord record_of(const BakedMap& map);

/// Something baked that is the same everywhere, and is no file.
struct BakedValue {
  std::string input;  ///< NODE.INPUT.
  std::vector<float> value;
  std::string colorspace;
};

/// What `nacre bake` tells of what it did, for people or for programs.
class BakeReport {
 public:
  enum class Form { none, text, json };

  explicit BakeReport(Form form) : form_(form) {}

  Form form() const { return form_; }
  void add(BakedMap map) { maps_.push_back(std::move(map)); }
  void add(BakedValue value) { values_.push_back(std::move(value)); }
  void set_document(std::string file) { document_ = std::move(file); }
  /// On standard output.
  void print() const;

 private:
  void print_text() const;
  void print_json() const;

  Form form_;
  Stopwatch watch_;
  std::vector<BakedMap> maps_;
  std::vector<BakedValue> values_;
  std::string document_;
};

}  // namespace nacre::tool
