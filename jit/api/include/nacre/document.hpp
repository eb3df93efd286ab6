/// \file
/// MaterialX documents: part of <nacre/nacre.hpp>.
#ifndef NACRE_DOCUMENT_HPP
#define NACRE_DOCUMENT_HPP

#include <cstddef>
#include <nacre/diagnostic.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nacre {
inline namespace v0 {

/// The folder of the installed MaterialX data library; "" if it is not there.
inline std::string data_library() { return nacre_data_library(); }

struct ReadOptions {
  std::vector<std::string> search_paths;  ///< Of includes, after the including file's own folder.
  bool includes_anywhere = false;
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
