#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "examples/common/atomic_file.h"
#include "examples/tool/options.h"
#include "examples/tool/process.h"
#include "examples/tool/stop.h"
#include "jit/document/read.h"
#include "jit/document/write.h"

namespace nacre::tool {

namespace {

namespace fs = std::filesystem;

struct ConvertOptions {
  std::string file;
  std::string out;
  std::vector<std::string> search_paths;
  bool flatten = false;
  bool quiet = false;
  bool json = false;
};

bool is_relative(std::string_view name) { return !name.empty() && fs::path(name).is_relative(); }

bool names_relative_files(const Element& element) {
  if (element.attribute("type") == "filename" && is_relative(element.attribute("value"))) {
    return true;
  }
  const ElementRange children = element.children();
  return std::any_of(children.begin(), children.end(), names_relative_files);
}

/// Relative names of images and includes count from the document's folder.
void warn_of_other_folder(const ConvertOptions& options, const Document& document,
                          Diagnostics& diagnostics) {
  const bool includes = !options.flatten && document.files().size() > 1;
  if (!includes && !names_relative_files(document.root())) return;
  std::error_code error;
  const fs::path from = fs::weakly_canonical(fs::absolute(options.file, error), error);
  const fs::path to = fs::weakly_canonical(fs::absolute(options.out, error), error);
  if (from.parent_path() == to.parent_path()) return;
  diagnostics.warning("other-folder", {options.out, 0, 0, {}},
                      "relative names of images and includes now count from another folder",
                      from.parent_path().string(), to.parent_path().string());
}

/// Whether the document is written.
bool convert(const ConvertOptions& options, Diagnostics& diagnostics) {
  ReadOptions read;
  read.keep_comments = true;
  read.stop = stop();
  for (const std::string& path : options.search_paths) read.search_paths.emplace_back(path);
  const auto document = read_document(options.file, read, diagnostics);
  if (document == nullptr) return false;
  const std::string text = write_document(*document, {.flatten = options.flatten});
  promise_files({options.out});
  const bool written = host::prepare_output(options.out, diagnostics) &&
                       host::write_text_atomically(options.out, text, diagnostics);
  warn_of_other_folder(options, *document, diagnostics);
  if (written) file_is_written(options.out, options.quiet || options.json);
  return written;
}

int run(const ConvertOptions& options) {
  Diagnostics diagnostics;
  const bool written = convert(options, diagnostics);
  if (options.json) {
    print_json({{"document", options.file},
                {"file", options.out},
                {"written", written},
                {"flattened", options.flatten}});
  }
  return report(diagnostics);
}

}  // namespace

void add_convert(CLI::App& app, int& status) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App& command = *app.add_subcommand("convert", "Write a document as one of version 1.39");
  command.add_option("FILE", options->file, "MaterialX document, of version 1.22 or later")
      ->required()
      ->type_name("FILE.mtlx");
  command.add_option("--out", options->out, "The document to write")
      ->required()
      ->type_name("FILE.mtlx");
  command.add_flag("--flatten", options->flatten, "Write included elements in place of includes");
  command
      .add_option("--library,--search-path", options->search_paths,
                  "Where includes are looked for too; may be repeated")
      ->type_name("DIR");
  command.add_flag("-q,--quiet", options->quiet, "Do not print the name of the file");
  command.add_flag("--json", options->json,
                   "For programs to read: an object that says what was written");
  command.footer(
      "Elements, attributes and comments stay, unknown ones too; what changed since the document's "
      "version is rewritten.");
  command.callback(
      [options, &status] { status = guarded(options->file, [&] { return run(*options); }); });
}

}  // namespace nacre::tool
