#include "examples/tool/bake/ledger.h"

#include <fmt/format.h>

#include "examples/common/atomic_file.h"
#include "examples/common/file_digest.h"
#include "examples/common/partial_file.h"
#include "examples/tool/paths.h"

namespace nacre::tool {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// A few of them.
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  if (names.size() > most) text += fmt::format(" and {} more", names.size() - most);
  return text;
}

std::string manifest_of(const ManifestRequest& request, const std::string& folder) {
  return request.shard ? request.part(folder, *request.shard) : request.whole(folder);
}

std::vector<BakedRecord> values_of(const std::map<std::string, BakedRecord>& records,
                                   const std::map<std::string, BakedRecord>& others) {
  std::map<std::string, const BakedRecord*> all;
  for (const auto& [name, record] : others) all[name] = &record;
  for (const auto& [name, record] : records) all[name] = &record;
  std::vector<BakedRecord> list;
  for (const auto& [name, record] : all) list.push_back(*record);
  return list;
}

}  // namespace

BakeLedger::BakeLedger(const ManifestRequest& request, std::string folder, std::string document,
                       BakeManifest head)
    : request_(request),
      folder_(std::move(folder)),
      manifest_(manifest_of(request, folder_)),
      document_folder_(fs::path(document).parent_path()),
      head_(std::move(head)) {
  head_.shard = request.shard;
}

bool BakeLedger::open(Diagnostics& diagnostics) {
  if (!is_recording()) return true;
  if (!host::prepare_output(manifest_, diagnostics)) return false;
  host::sweep_partial_files(folder_);
  const std::size_t errors = diagnostics.error_count();
  auto manifest = read_manifest(manifest_, diagnostics);
  if (manifest) take(std::move(*manifest));
  for (std::size_t part = 1; part <= request_.merge; ++part) read_part(part, diagnostics);
  return diagnostics.error_count() == errors;
}

void BakeLedger::take(BakeManifest manifest) {
  const std::string fault = difference(manifest, head_);
  for (BakedRecord& record : manifest.files) {
    const std::string name = record.file;
    if (fault.empty()) known_.try_emplace(name, std::move(record));
    if (!fault.empty()) outdated_.try_emplace(name, fault);
  }
  if (!fault.empty()) return;
  for (BakedRecord& record : manifest.values) {
    const std::string name = record.output;
    known_values_.try_emplace(name, std::move(record));
  }
}

void BakeLedger::read_part(std::size_t index, Diagnostics& diagnostics) {
  const Shard shard{index, request_.merge};
  const std::string path = request_.part(folder_, shard);
  auto manifest = read_manifest(path, diagnostics);
  if (!manifest) {
    part_faults_[index] = {false, fmt::format("there is no {}", path)};
    return;
  }
  std::string fault = difference(*manifest, head_);
  if (fault.empty() && manifest->shard != shard) fault = "it is of another shard";
  if (fault.empty()) return take(std::move(*manifest));
  part_faults_[index] = {true, fmt::format("{} is of another bake: {}", path, fault)};
}

BakeItem BakeLedger::item(std::string path, Facts settings) {
  const fs::path folder = absolute_path(manifest_).parent_path();
  BakeItem item{std::move(path), std::move(settings), items_++, {}};
  item.name = from_folder(absolute_path(item.path), folder);
  return item;
}

BakeStep BakeLedger::step(const BakeItem& item, Diagnostics& diagnostics) {
  if (!is_recording()) return BakeStep::bake;
  if (request_.shard && !request_.shard->owns(item.number)) return BakeStep::leave;
  const auto known = known_.find(item.name);
  if (known == known_.end()) {
    const auto outdated = outdated_.find(item.name);
    return refuse(item, outdated == outdated_.end() ? "" : outdated->second, diagnostics);
  }
  const std::string fault = fault_of(known->second, item);
  if (fault.empty()) {
    records_[item.name] = known->second;
    kept_.push_back(item.path);
    return BakeStep::keep;
  }
  known_.erase(known);
  return refuse(item, fault, diagnostics);
}

/// `fault`: why what is recorded of it does not count, or "".
BakeStep BakeLedger::refuse(const BakeItem& item, const std::string& fault,
                            Diagnostics& diagnostics) {
  if (is_merging()) {
    std::vector<std::string>& missing = missing_[Shard::of(item.number, request_.merge)];
    missing.push_back(fault.empty() ? item.path : fmt::format("{} ({})", item.path, fault));
    return BakeStep::leave;
  }
  if (!fault.empty()) {
    diagnostics.add({.severity = Severity::note,
                     .code = "baked-again",
                     .where = {item.path, 0, 0, {}},
                     .message = "the image is baked again",
                     .expected = {},
                     .found = fault});
  }
  return BakeStep::bake;
}

std::string BakeLedger::fault_of(const BakedRecord& record, const BakeItem& item) {
  std::string fault = fault_of_inputs(record, item.settings);
  if (!fault.empty() || !record.is_kept) return fault;
  std::error_code error;
  const bool is_there = fs::file_size(item.path, error) == record.bytes && !error;
  if (error) return "it is gone";
  const auto digest = is_there ? host::digest_of_file(item.path) : std::nullopt;
  return digest && to_hex(*digest) == record.digest ? "" : "it is not as it was written";
}

std::string BakeLedger::fault_of_inputs(const BakedRecord& record, const Facts& settings) {
  std::string fault = difference(record.settings, settings);
  if (!fault.empty()) return fault;
  for (const auto& [name, digest] : record.images) {
    const fs::path path = fs::path(name).is_absolute() ? fs::path(name) : document_folder_ / name;
    if (digests_.of(path.string()) != digest) return fmt::format("{} has changed", name);
  }
  return {};
}

const BakedRecord* BakeLedger::value(const BakeItem& first) {
  const std::string& output = first.settings.at("output");
  const auto known = known_values_.find(output);
  if (known == known_values_.end()) return nullptr;
  if (!fault_of_inputs(known->second, first.settings).empty()) return nullptr;
  return &(values_[output] = known->second);
}

bool BakeLedger::add_images(BakedRecord& record, const BoundKernel& kernel,
                            Diagnostics& diagnostics) {
  for (const auto& [path, then] : kernel.files()) {
    FileIdentity now;
    std::string digest = digests_.of(path, &now);
    if (now != then) {
      diagnostics.error("input-changed", {path, 0, 0, {}},
                        "the file was written while it was used: nothing is recorded");
      return false;
    }
    record.images[from_folder(path, document_folder_)] = std::move(digest);
  }
  return true;
}

bool BakeLedger::add(const BakeItem& item, BakedRecord record, const BoundKernel& kernel,
                     Diagnostics& diagnostics) {
  if (!is_recording()) return true;
  record.file = item.name;
  record.output = item.settings.at("output");
  record.settings = item.settings;
  const auto digest = host::digest_of_file(item.path);
  if (!digest) {
    diagnostics.error("cannot-read", {item.path, 0, 0, {}}, "what was written cannot be read");
    return false;
  }
  record.digest = to_hex(*digest);
  std::error_code ignored;
  record.bytes = fs::file_size(item.path, ignored);
  if (!add_images(record, kernel, diagnostics)) return false;
  records_[item.name] = std::move(record);
  write_sometimes(diagnostics);
  return true;
}

bool BakeLedger::add_value(const BakeItem& first, BakedRecord record, const BoundKernel& kernel,
                           Diagnostics& diagnostics) {
  if (!is_recording()) return true;
  record.output = first.settings.at("output");
  record.settings = first.settings;
  if (!add_images(record, kernel, diagnostics)) return false;
  values_[record.output] = std::move(record);
  return true;
}

void BakeLedger::drop(const BakeItem& item) {
  std::error_code ignored;
  fs::remove(item.path, ignored);
  records_[item.name].is_kept = false;
}

void BakeLedger::set_document(const std::string& path) {
  if (!is_recording()) return;
  head_.document = from_folder(absolute_path(path), absolute_path(manifest_).parent_path());
  const auto digest = host::digest_of_file(path);
  head_.document_digest = digest ? to_hex(*digest) : "";
}

/// What a killed run had finished is to count: so the manifest is written again and again, but
/// takes a twentieth of the time at most.
void BakeLedger::write_sometimes(Diagnostics& diagnostics) {
  const Clock::time_point start = Clock::now();
  if (start < next_write_) return;
  write(diagnostics);
  next_write_ = Clock::now() + 20 * (Clock::now() - start);
}

void BakeLedger::write(Diagnostics& diagnostics) {
  // Merged is what belongs to the whole alone.
  const std::map<std::string, BakedRecord> none;
  head_.files = values_of(records_, is_merging() ? none : known_);
  head_.values = values_of(values_, is_merging() ? none : known_values_);
  write_manifest(manifest_, head_, diagnostics);
}

void BakeLedger::say_missing(Diagnostics& diagnostics) const {
  for (const auto& [shard, images] : missing_) {
    const auto fault = part_faults_.find(shard);
    const bool has_part = fault == part_faults_.end();
    diagnostics.error(has_part                   ? "missing-image-file"
                      : fault->second.is_foreign ? "foreign-part"
                                                 : "missing-part",
                      {manifest_, 0, 0, {}},
                      fmt::format("{} images of shard {} of {} are not there{}", images.size(),
                                  shard, request_.merge, has_part ? "" : ": " + fault->second.text),
                      {}, listed(images));
  }
}

void BakeLedger::finish(Diagnostics& diagnostics) {
  if (!is_recording()) return;
  say_missing(diagnostics);
  if (!kept_.empty() && !is_merging()) {
    diagnostics.add({.severity = Severity::note,
                     .code = "already-there",
                     .where = {manifest_, 0, 0, {}},
                     .message = fmt::format("{} of {} images are there already and were not baked",
                                            kept_.size(), items_),
                     .expected = {},
                     .found = listed(kept_)});
  }
  if (!is_merging() || !diagnostics.has_errors()) write(diagnostics);
}

}  // namespace nacre::tool
