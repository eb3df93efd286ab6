#include "examples/image_input/output_store.h"

#include <algorithm>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>

namespace graph_image {

namespace {

namespace fs = std::filesystem;

/// Of compiled outputs, some hundred kilobytes each, beside the images that they share.
constexpr std::size_t usual_most = 256;

using Key = std::tuple<std::string, std::string, std::string, Accuracy, int, int>;

/// What of a request the kernel depends on.
Key key_of(const Request& request) {
  std::error_code ignored;
  return {fs::absolute(request.document, ignored).string(),
          request.output,
          request.profile,
          request.accuracy,
          request.anisotropy,
          static_cast<int>(request.frame)};
}

/// Zeros for what is not there.
FileStamp stamp_of(const fs::path& file) {
  std::error_code error;
  FileStamp stamp{file, {}, 0};
  const auto modified = fs::last_write_time(file, error);
  if (!error) stamp.modified = modified;
  const std::uintmax_t bytes = fs::file_size(file, error);
  if (!error) stamp.bytes = bytes;
  return stamp;
}

bool are_current(const std::vector<FileStamp>& files) {
  return std::all_of(files.begin(), files.end(),
                     [](const FileStamp& stamp) { return stamp_of(stamp.file) == stamp; });
}

/// The files that elements of the document were written in.
std::set<std::string> files_of(const nacre::Document& document) {
  std::set<std::string> files;
  for (std::size_t i = 0; i < document.element_count(); ++i) {
    nacre_element element{};
    element.size = sizeof element;
    nacre::detail::check(nacre_document_element(document.get(), i, &element));
    files.insert(element.file);
  }
  return files;
}

std::shared_ptr<const ReadyOutput> make(nacre::System& system, const Request& request,
                                        std::vector<nacre::Diagnostic> said) {
  auto made = std::make_shared<ReadyOutput>();
  // Before it is read: who changes it meanwhile changes its stamp.
  const FileStamp itself = stamp_of(fs::absolute(request.document));
  const nacre::Document document = nacre::Document::read(request.document, {}, &said);
  made->files.push_back(itself);
  for (const std::string& file : files_of(document)) {
    const bool is_included = !file.empty() && file != request.document;
    if (is_included) made->files.push_back(stamp_of(fs::absolute(file)));
  }
  if (!request.profile.empty()) {
    made->files.push_back(
        stamp_of(fs::absolute(fs::path(request.document).parent_path() / request.profile)));
  }
  made->output = std::make_unique<const GraphOutput>(system, document, request, said);
  made->info = made->output->info();
  std::string& warnings = made->info.warnings;
  for (const nacre::Diagnostic& one : said) {
    if (one.severity == NACRE_NOTE) continue;
    warnings.append(warnings.empty() ? "" : "\n").append(one.text);
  }
  return made;
}

}  // namespace

struct OutputStore::Entry {
  explicit Entry(Key key_) : key(std::move(key_)) {}

  const Key key;
  std::mutex mutex;  ///< Held while it is made.
  std::shared_ptr<const ReadyOutput> ready;
};

nacre::System& OutputStore::system() {
  const std::lock_guard lock(system_mutex_);
  if (!system_) {
    nacre::SystemOptions options;
    options.compile_apart = true;  // A fault of the compiler does not end somebody's program.
    system_.emplace(options, &system_said_);
  }
  return *system_;
}

std::shared_ptr<OutputStore::Entry> OutputStore::entry_of(const Request& request) {
  const auto key = key_of(request);
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const auto& entry) { return entry->key == key; });
  if (found != entries_.end()) {
    entries_.splice(entries_.begin(), entries_, found);
  } else {
    entries_.push_front(std::make_shared<Entry>(key));
    if (entries_.size() > most_) entries_.pop_back();
  }
  return entries_.front();
}

std::shared_ptr<const ReadyOutput> OutputStore::get(const Request& request) {
  const std::shared_ptr<Entry> entry = entry_of(request);
  const std::lock_guard lock(entry->mutex);
  if (entry->ready == nullptr || !are_current(entry->ready->files)) {
    entry->ready = nullptr;
    nacre::System& compiler = system();
    entry->ready = make(compiler, request, system_said_);
  }
  return entry->ready;
}

OutputStore& shared_store() {
  static OutputStore store(usual_most);
  return store;
}

}  // namespace graph_image
