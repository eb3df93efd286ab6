// Every document below tests/documents/bad, but what stands in folders "include",
// has a NAME.expected beside it: one line for each diagnostic, in order,
//
//   severity code file:line:column path | text
//
// where `path` is "-" if there is none and `text` is part of what is said. Checking leniently
// finds no error in those that lenient.txt names.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "jit/graph/check/check.h"
#include "tests/support/standard_library.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> bad_documents() {
  const fs::path folder = source_folder() / "tests/documents/bad";
  std::vector<std::string> names;
  for (fs::recursive_directory_iterator at(folder), end; at != end; ++at) {
    if (at->path().filename() == "include") at.disable_recursion_pending();
    if (at->path().extension() != ".mtlx") continue;
    names.push_back(fs::path(at->path()).replace_extension().lexically_relative(folder).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::vector<std::string> lines;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string head_of(const Diagnostic& one, const fs::path& folder) {
  const std::string severity = one.severity == Severity::error ? "error" : "warning";
  return fmt::format("{} {} {}:{}:{} {} | ", severity, one.code,
                     fs::path(one.where.file).lexically_relative(folder).string(), one.where.line,
                     one.where.column, one.where.path.empty() ? "-" : printable(one.where.path));
}

class BadDocument : public ::testing::TestWithParam<std::string> {};

TEST_P(BadDocument, IsReportedWhereItIsWrong) {
  const fs::path file = source_folder() / "tests/documents/bad" / (GetParam() + ".mtlx");
  const fs::path folder = file.parent_path();
  Diagnostics diagnostics;
  const auto document = read_document(file, {}, diagnostics);
  if (document != nullptr) check_document(*document, standard_library(), {}, diagnostics);

  const std::vector<std::string> expected = lines_of(fs::path(file).replace_extension(".expected"));
  ASSERT_FALSE(expected.empty());
  ASSERT_EQ(diagnostics.all().size(), expected.size()) << diagnostics.to_string();
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Diagnostic& one = diagnostics.all()[i];
    const std::string head = head_of(one, folder);
    ASSERT_TRUE(expected[i].starts_with(head)) << expected[i] << "\n" << head << one.to_string();
    const std::string text = expected[i].substr(head.size());
    EXPECT_NE(one.to_string().find(text), std::string::npos) << text << "\n" << one.to_string();
  }
}

/// Whether something is said of that place.
bool is_said_at(const Diagnostics& diagnostics, const SourceLocation& where) {
  const auto& all = diagnostics.all();
  return std::any_of(all.begin(), all.end(), [&](const Diagnostic& one) {
    return one.where.file == where.file && one.where.line == where.line &&
           one.where.path == where.path;
  });
}

// What is tolerated is still said where it stands.
TEST(BadDocuments, AreToleratedWithAWarningOnly) {
  const fs::path folder = source_folder() / "tests/documents/bad";
  std::vector<std::string> tolerated;
  for (const std::string& name : bad_documents()) {
    SCOPED_TRACE(name);
    const fs::path file = folder / (name + ".mtlx");
    Diagnostics strict;
    const auto document = read_document(file, {}, strict);
    if (document == nullptr) continue;
    Diagnostics lenient = strict;
    check_document(*document, standard_library(), {}, strict);
    GraphOptions options;
    options.lenient = true;
    check_document(*document, standard_library(), options, lenient);
    for (const Diagnostic& one : strict.all()) {
      EXPECT_TRUE(is_said_at(lenient, one.where)) << one.to_string() << "\n" << lenient.to_string();
    }
    if (strict.has_errors() && !lenient.has_errors()) tolerated.push_back(name);
  }
  EXPECT_EQ(tolerated, lines_of(folder / "lenient.txt"));
}

INSTANTIATE_TEST_SUITE_P(All, BadDocument, ::testing::ValuesIn(bad_documents()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '/', '_');
                           return name;
                         });

}  // namespace
}  // namespace nacre
