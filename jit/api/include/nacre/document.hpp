/// \file
/// MaterialX documents: part of <nacre/nacre.hpp>.
#ifndef NACRE_DOCUMENT_HPP
#define NACRE_DOCUMENT_HPP

#include <cstddef>
#include <cstdint>
#include <nacre/diagnostic.hpp>
#include <nacre/hooks.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nacre {
inline namespace v0 {

struct ReadOptions {
  std::vector<std::string> search_paths;  ///< Of includes, after the including file's own folder.
  bool includes_anywhere = false;
  std::uint64_t max_file_bytes = 0;   ///< 0: 64 MiB.
  std::uint64_t max_total_bytes = 0;  ///< 0: 256 MiB.
  std::uint64_t max_elements = 0;
  int max_files = 0;
  int max_include_depth = 0;
  int max_xml_depth = 0;
  int max_inheritance = 0;
  const StopSource* stop = nullptr;
  FileResolver resolver;  ///< Of includes.
};

/// What a document says in one place; see nacre_element. Lives as long as the document.
struct Element {
  std::string_view category, name;
  std::size_t parent = SIZE_MAX;  ///< SIZE_MAX for the root.
  std::size_t end = 0;            ///< Behind the last element within it.
  std::vector<std::pair<std::string_view, std::string_view>> attributes;  ///< Name and value.
  std::string_view file;
  int line = 0, column = 0;
};

/// A variant of a set.
struct Variant {
  std::string set, variant;
};

/// What a look assigns to a geometry.
struct Assignment {
  std::string material;  ///< "": nothing.
  std::vector<Variant> variants;
};

/// A MaterialX document.
class Document {
 public:
  /// Throws Error; warnings go to `said`.
  static Document read(const std::string& file, const ReadOptions& options = {},
                       std::vector<Diagnostic>* said = nullptr) {
    return make(options, said,
                [&](const nacre_read_options* asked, nacre_report* report, nacre_document** made) {
                  return nacre_document_read(file.c_str(), asked, report, made);
                });
  }
  /// Of text in memory; the folder of `name` is where includes and images are looked for.
  static Document parse(std::string_view text, const std::string& name = "document.mtlx",
                        const ReadOptions& options = {}, std::vector<Diagnostic>* said = nullptr) {
    return make(options, said,
                [&](const nacre_read_options* asked, nacre_report* report, nacre_document** made) {
                  return nacre_document_parse(text.data(), text.size(), name.c_str(), asked, report,
                                              made);
                });
  }

  std::vector<std::string> materials() const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < nacre_document_material_count(get()); ++i) {
      names.emplace_back(nacre_document_material(get(), i));
    }
    return names;
  }
  /// Of the document and its node graphs, as System::compile_outputs takes them.
  std::vector<std::string> outputs() const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < nacre_document_output_count(get()); ++i) {
      names.emplace_back(nacre_document_output(get(), i));
    }
    return names;
  }

  /// Elements are numbered in the document's order, 0 being the root; their children are the one
  /// behind them, the `end` of that, and so on up to their own `end`.
  /// @{
  std::size_t element_count() const { return nacre_document_element_count(get()); }
  Element element(std::size_t index) const {
    nacre_element one{};
    one.size = sizeof one;
    detail::check(nacre_document_element(get(), index, &one));
    Element made{one.category, one.name, one.parent, one.end, {}, one.file, one.line, one.column};
    for (std::size_t i = 0; i < one.attribute_count; ++i) {
      const char* name = nullptr;
      const char* value = nullptr;
      detail::check(nacre_document_attribute(get(), index, i, &name, &value));
      made.attributes.emplace_back(name, value);
    }
    return made;
  }
  /// Of a path, "NG_marble/mix1/fg"; SIZE_MAX: none.
  std::size_t find_element(const std::string& path) const {
    return nacre_document_find_element(get(), path.c_str());
  }
  /// @}

  std::vector<std::string> looks() const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < nacre_document_look_count(get()); ++i) {
      names.emplace_back(nacre_document_look(get(), i));
    }
    return names;
  }
  /// What a look assigns to the geometry of a full path, "/house/door".
  Assignment assignment(std::size_t look, const std::string& geometry) const {
    nacre_assignment one{};
    one.size = sizeof one;
    detail::check(nacre_document_assignment(get(), look, geometry.c_str(), &one));
    Assignment made{one.material, {}};
    for (std::size_t i = 0; i < one.variant_count; ++i) {
      made.variants.push_back({one.variants[i].set, one.variants[i].variant});
    }
    return made;
  }
  /// Whether rays of a kind ("camera", "illumination", "shadow", "secondary"; "": any) that come
  /// from the geometry `viewer`, see it.
  bool is_visible(std::size_t look, const std::string& geometry, const std::string& rays = {},
                  const std::string& viewer = {}) const {
    return nacre_document_is_visible(get(), look, geometry.c_str(), rays.c_str(), viewer.c_str()) !=
           0;
  }
  nacre_document* get() const { return document_.get(); }

 private:
  template <class Make>
  static Document make(const ReadOptions& options, std::vector<Diagnostic>* said, Make&& call) {
    const detail::TextList paths(options.search_paths);
    nacre_read_options asked{};
    asked.size = sizeof asked;
    asked.search_paths = paths.data();
    asked.search_path_count = paths.size();
    asked.includes_anywhere = options.includes_anywhere;
    asked.max_file_bytes = options.max_file_bytes;
    asked.max_total_bytes = options.max_total_bytes;
    asked.max_elements = options.max_elements;
    asked.max_files = options.max_files;
    asked.max_include_depth = options.max_include_depth;
    asked.max_xml_depth = options.max_xml_depth;
    asked.max_inheritance = options.max_inheritance;
    asked.stop = options.stop != nullptr ? options.stop->get() : nullptr;
    nacre_file_resolver resolver{};
    if (options.resolver) {
      resolver = {sizeof resolver, const_cast<FileResolver*>(&options.resolver),
                  detail::resolve_file, nullptr};
      asked.resolver = &resolver;
    }
    const detail::Said report;
    nacre_document* made = nullptr;
    report.finish(call(&asked, report.get(), &made), said);
    Document document;
    document.document_.reset(made);
    return document;
  }

  detail::Owned<nacre_document, nacre_document_destroy> document_;
};

}  // namespace v0
}  // namespace nacre

#endif
