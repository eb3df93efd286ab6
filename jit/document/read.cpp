#include "jit/document/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <unordered_map>

#include "jit/document/file_roots.h"
#include "jit/document/names.h"
#include "jit/document/same_content.h"
#include "jit/document/upgrade.h"
#include "jit/document/xml.h"
#include "runtime/float_environment.h"
#include "runtime/report_stop.h"

namespace nacre {

namespace fs = std::filesystem;

namespace {

// What an included document's root says goes to each child that does not say
// it itself, because the child will have another root.
constexpr std::array<std::string_view, 4> pushed_attributes{"fileprefix", "geomprefix",
                                                            "colorspace", "namespace"};

class FileReader {
 public:
  FileReader(Document& document, const ReadOptions& options, Diagnostics& diagnostics)
      : document_(document), options_(options), diagnostics_(diagnostics) {
    for (const fs::path& path : options.search_paths) roots_.add(path);
  }

  void add_folder(const fs::path& path) { roots_.add(path); }

  /// Root of the file with what it includes in front of its own children.
  Element* read(const fs::path& path, const SourceLocation& asked_by) {
    std::optional<std::string> text = load(path, asked_by);
    if (!text) return nullptr;
    open_.push_back(canonical_path(path));
    Element* root = parse(*text, path.string(), path.parent_path());
    open_.pop_back();
    return root;
  }

  Element* parse(std::string_view text, const std::string& name, const fs::path& folder) {
    auto buffer = std::make_unique<char[]>(text.size() + 1);
    std::memcpy(buffer.get(), text.data(), text.size());
    const std::uint16_t file = document_.add_file(name, std::move(buffer), text.size());
    Element* root = parse_xml(document_, file, text, options_, diagnostics_);
    if (root == nullptr) return nullptr;
    const std::size_t errors = diagnostics_.error_count();
    check_names(document_, *root, diagnostics_);  // Before the includes come in.
    upgrade(document_, *root, diagnostics_);
    merge_includes(*root, folder);
    return diagnostics_.error_count() == errors ? root : nullptr;
  }

  /// Moves the children of an included root behind those of `root`; of one name
  /// the first stays.
  using Names = std::unordered_map<std::string_view, const Element*>;
  void import(Element& root, Element& included, Names& names) {
    Element* child = document_.take_children(included);
    while (child != nullptr) {
      Element* next = Document::next_sibling(*child);
      for (std::string_view attribute : pushed_attributes) {
        if (included.has_attribute(attribute) && !child->has_attribute(attribute)) {
          document_.set_attribute(*child, attribute, included.attribute(attribute));
        }
      }
      const std::string name = child->name().empty() ? "" : own_qualified_name(*child);
      if (name != child->name()) Document::set_name(*child, document_.intern(name));
      const auto known = names.find(child->name());
      if (child->name().empty() || known == names.end()) {
        if (!child->name().empty()) names.emplace(child->name(), child);
        document_.append(root, *child);
      } else {
        warn_of_shadow(*child, *known->second);
      }
      child = next;
    }
  }

 private:
  static std::string own_qualified_name(const Element& child) {
    const std::string_view space = child.attribute("namespace");
    const std::string_view name = child.name();
    if (space.empty()) return std::string(name);
    const std::string prefix = std::string(space) + ':';
    return name.starts_with(prefix) ? std::string(name) : prefix + std::string(name);
  }

  std::optional<std::string> load(const fs::path& path, const SourceLocation& asked_by) {
    SourceLocation where = asked_by;
    if (where.file.empty()) where.file = path.string();
    std::error_code error;
    if (!fs::is_regular_file(path, error)) {
      const bool is_there = fs::exists(path, error);
      diagnostics_.error("cannot-read", where,
                         is_there ? "this is no regular file" : "there is no such file", "a file",
                         path.string());
      return std::nullopt;
    }
    const std::size_t size = fs::file_size(path, error);
    if (!count(error ? SIZE_MAX : size, where)) return std::nullopt;
    std::string text(size, '\0');
    std::ifstream stream(path, std::ios::binary);
    if (!stream || !stream.read(text.data(), static_cast<std::streamsize>(size))) {
      diagnostics_.error("cannot-read", where, "the file cannot be read", "", path.string());
      return std::nullopt;
    }
    return text;
  }

  /// One more file of that size; false, with an error, where that is beyond a limit.
  bool count(std::size_t size, const SourceLocation& where) {
    if (size > options_.limits.file_bytes) {
      diagnostics_.error("file-too-large", where, "the file is too large",
                         fmt::format("at most {} bytes", options_.limits.file_bytes),
                         fmt::format("{} bytes", size));
      return false;
    }
    if (report_if_due(options_.stop, "reading", where, diagnostics_)) return false;
    total_bytes_ += size;
    if (++file_count_ > options_.limits.files || total_bytes_ > options_.limits.total_bytes) {
      diagnostics_.error("too-many-includes", where, "the document includes too much",
                         fmt::format("at most {} files and {} bytes", options_.limits.files,
                                     options_.limits.total_bytes));
      return false;
    }
    return true;
  }

  void merge_includes(Element& root, const fs::path& folder) {
    Element* own = document_.take_children(root);
    keep_places(own);
    Names names;
    for (Element* child = own; child != nullptr; child = Document::next_sibling(*child)) {
      if (child->category() != "xi:include") continue;
      if (Element* included = include(*child, folder)) import(root, *included, names);
    }
    for (Element* child = own; child != nullptr;) {
      Element* next = Document::next_sibling(*child);
      const bool is_include = child->category() == "xi:include";
      const auto known =
          child->name().empty() || is_include ? names.end() : names.find(child->name());
      if (known != names.end()) warn_of_shadow(*child, *known->second);
      if (!is_include && known == names.end()) {
        document_.append(root, *child);
      } else {
        document_.move_notes(*child, next, root);
      }
      child = next;
    }
  }

  /// Of two root elements of one name the first counts, which the second may have meant.
  void warn_of_shadow(const Element& second, const Element& first) {
    if (same_content(second, first)) return;
    diagnostics_.warning("shadowed-name", location(second),
                         "a file read before has this name, which is used instead",
                         "a name of its own",
                         fmt::format("'{}' in {}:{}", first.name().substr(0, 100),
                                     document_.file_of(first), document_.line_of(first)));
  }

  /// Notes where the includes of a file stood.
  void keep_places(Element* first) {
    for (Element* child = first; child != nullptr; child = Document::next_sibling(*child)) {
      if (child->category() != "xi:include") continue;
      const std::span<const Note> before = document_.notes_before(*child);
      std::vector<Note> notes(before.begin(), before.end());
      notes.push_back({.kind = Note::Kind::include, .include = child});
      document_.set_notes_before(*child, std::move(notes));
    }
  }

  Element* include(const Element& element, const fs::path& folder) {
    const std::string_view href = element.attribute("href");
    SourceLocation where = location(element);
    where.path = "xi:include";
    if (href.empty()) {
      diagnostics_.error("bad-include", where, "the include names no file", "href=\"FILE.mtlx\"");
      return nullptr;
    }
    if (options_.resolver) {
      const auto given =
          options_.resolver(std::string(href), document_.file_of(element), FileKind::include);
      if (given) return include_given(*given, href, where);
    }
    const std::optional<fs::path> file = find(href, folder);
    // The same for files that are there and that are not: a document is not to learn it.
    if (!file && !is_allowed(folder / fs::path(href))) {
      diagnostics_.error(
          "include-outside", where, "the included file is outside the allowed folders",
          "a file below the document's folder or a search path", fmt::format("'{}'", href));
      return nullptr;
    }
    if (!file) {
      diagnostics_.error("include-not-found", where, "the included file cannot be found",
                         "a file beside this one or in a search path", fmt::format("'{}'", href));
      return nullptr;
    }
    return may_open(canonical_path(*file), href, where) ? read(*file, where) : nullptr;
  }

  /// Neither one that is being read, nor too deep.
  bool may_open(const fs::path& canonical, std::string_view href, const SourceLocation& where) {
    if (std::find(open_.begin(), open_.end(), canonical) != open_.end()) {
      diagnostics_.error("include-cycle", where, "the file includes itself, directly or not", "",
                         fmt::format("'{}'", href));
      return false;
    }
    if (open_.size() >= static_cast<std::size_t>(options_.limits.include_depth)) {
      diagnostics_.error("include-depth", where, "includes are nested too deeply",
                         fmt::format("at most {} levels", options_.limits.include_depth));
      return false;
    }
    return true;
  }

  /// What the host's resolver gave for an include.
  Element* include_given(const ResolvedFile& file, std::string_view href,
                         const SourceLocation& where) {
    const fs::path path(file.path);
    if (file.bytes == nullptr) {
      return may_open(canonical_path(path), href, where) ? read(path, where) : nullptr;
    }
    if (!may_open(path, href, where) || !count(file.bytes->size(), where)) return nullptr;
    open_.push_back(path);
    Element* root = parse(*file.bytes, file.path, path.parent_path());
    open_.pop_back();
    return root;
  }

  /// The first that is there of those that may be read, without "..": it is opened by the
  /// name that was looked at.
  std::optional<fs::path> find(std::string_view href, const fs::path& folder) const {
    std::error_code error;
    const fs::path named(href);
    std::vector<fs::path> folders{folder};
    folders.insert(folders.end(), options_.search_paths.begin(), options_.search_paths.end());
    for (const fs::path& place : folders) {
      const fs::path file = (place / named).lexically_normal();
      if (is_allowed(file) && fs::is_regular_file(file, error)) return file;
    }
    return std::nullopt;
  }

  bool is_allowed(const fs::path& file) const {
    return options_.includes_anywhere || roots_.hold(file);
  }

  Document& document_;
  const ReadOptions& options_;
  Diagnostics& diagnostics_;
  FileRoots roots_;
  std::vector<fs::path> open_;
  std::size_t total_bytes_ = 0;
  int file_count_ = 0;
};

std::unique_ptr<Document> finish(std::unique_ptr<Document> document, Element* root) {
  if (root == nullptr) return nullptr;
  document->set_root(*root);
  document->build_index();
  return document;
}

std::unique_ptr<Document> empty_document(const ReadOptions& options) {
  auto document = std::make_unique<Document>();
  document->set_max_inheritance(options.limits.inheritance);
  return document;
}

}  // namespace

std::unique_ptr<Document> read_document(const fs::path& file, const ReadOptions& options,
                                        Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  auto document = empty_document(options);
  FileReader reader(*document, options, diagnostics);
  reader.add_folder(file.has_parent_path() ? file.parent_path() : fs::path("."));
  Element* root = reader.read(file, {});
  return finish(std::move(document), root);
}

std::unique_ptr<Document> read_document_text(std::string_view text, const std::string& name,
                                             const ReadOptions& options, Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  auto document = empty_document(options);
  FileReader reader(*document, options, diagnostics);
  if (text.size() > options.limits.file_bytes) {
    diagnostics.error("file-too-large", {name, 0, 0, ""}, "the text is too large",
                      fmt::format("at most {} bytes", options.limits.file_bytes));
    return nullptr;
  }
  if (report_if_due(options.stop, "reading", {name, 0, 0, ""}, diagnostics)) return nullptr;
  const fs::path folder = fs::path(name).parent_path();
  reader.add_folder(folder.empty() ? fs::path(".") : folder);
  return finish(std::move(document), reader.parse(text, name, folder));
}

std::unique_ptr<Document> read_documents(
    const std::vector<fs::path>& files,
    const std::vector<std::pair<std::string_view, std::string_view>>& texts,
    const ReadOptions& options, Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  auto document = empty_document(options);
  FileReader reader(*document, options, diagnostics);
  auto empty = std::make_unique<char[]>(1);
  Element& root = document->create("materialx", document->add_file("", std::move(empty), 0), 0);
  FileReader::Names names;
  const std::size_t errors = diagnostics.error_count();
  for (const fs::path& file : files) {
    reader.add_folder(file.parent_path());
    if (Element* one = reader.read(file, {})) reader.import(root, *one, names);
  }
  for (const auto& [name, text] : texts) {
    if (Element* one = reader.parse(text, std::string(name), {})) reader.import(root, *one, names);
  }
  return finish(std::move(document), diagnostics.error_count() == errors ? &root : nullptr);
}

}  // namespace nacre
