#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "examples/tool/bake/inputs.h"
#include "examples/tool/bake/item.h"
#include "examples/tool/bake/manifest.h"
#include "examples/tool/bake/manifest_request.h"
#include "jit/shading/bound_kernel.h"
#include "runtime/diagnostic.h"

namespace nacre::tool {

/// Keeps the manifest of a bake, so that runs know from one another what is finished: images that
/// are there with the digest recorded, made from what would be read now and as is asked for now.
/// Where no manifest was asked for all is to be baked and nothing is recorded.
class BakeLedger {
 public:
  /// `folder`: of the images. `document`: the file baked. `head`: version, inputs and options.
  BakeLedger(const ManifestRequest& request, std::string folder, std::string document,
             BakeManifest head);

  /// Reads what earlier runs and other shards recorded. False after an error.
  bool open(Diagnostics& diagnostics);
  bool is_recording() const { return request_.is_asked(); }
  bool is_merging() const { return request_.merge > 0; }

  /// The next image of the bake; all runs ask for the same ones in the same order.
  BakeItem item(std::string path, Facts settings);
  BakeStep step(const BakeItem& item, Diagnostics& diagnostics);
  /// Of an image to keep, or that was added.
  const BakedRecord& record(const BakeItem& item) const { return records_.at(item.name); }
  /// The value that stands for an output at all points, from a run of as many images; or null.
  const BakedRecord* value(const BakeItem& first);

  /// Records an image that was written; false, with an error, where what it was made from has
  /// changed meanwhile.
  bool add(const BakeItem& item, BakedRecord record, const BoundKernel& kernel,
           Diagnostics& diagnostics);
  bool add_value(const BakeItem& first, BakedRecord record, const BoundKernel& kernel,
                 Diagnostics& diagnostics);
  /// Of an image that there is no need of: all texels of its map are alike.
  void drop(const BakeItem& item);
  void set_document(const std::string& path);

  /// Says what was kept and what is missing, and writes the manifest.
  void finish(Diagnostics& diagnostics);

 private:
  void read_part(std::size_t index, Diagnostics& diagnostics);
  void take(BakeManifest manifest);
  BakeStep refuse(const BakeItem& item, const std::string& fault, Diagnostics& diagnostics);
  std::string fault_of(const BakedRecord& record, const BakeItem& item);
  std::string fault_of_inputs(const BakedRecord& record, const Facts& settings);
  bool add_images(BakedRecord& record, const BoundKernel& kernel, Diagnostics& diagnostics);
  void say_missing(Diagnostics& diagnostics) const;
  void write(Diagnostics& diagnostics);
  void write_sometimes(Diagnostics& diagnostics);

  const ManifestRequest& request_;
  const std::string folder_;
  const std::string manifest_;  ///< The file that this run writes.
  const std::filesystem::path document_folder_;
  BakeManifest head_;
  InputDigests digests_;
  std::map<std::string, BakedRecord> known_;         ///< By earlier runs, by name of the file.
  std::map<std::string, BakedRecord> known_values_;  ///< By name of the output.
  std::map<std::string, std::string> outdated_;      ///< Why what was known does not count.
  std::map<std::string, BakedRecord> records_;       ///< What counts.
  std::map<std::string, BakedRecord> values_;
  std::size_t items_ = 0;
  std::vector<std::string> kept_;
  /// Why a part counts for nothing.
  struct PartFault {
    bool is_foreign = false;  ///< It is of another bake; else there is none.
    std::string text;
  };
  std::map<std::size_t, PartFault> part_faults_;             ///< By shard.
  std::map<std::size_t, std::vector<std::string>> missing_;  ///< Images, by shard.
  std::chrono::steady_clock::time_point next_write_{};
};

}  // namespace nacre::tool
