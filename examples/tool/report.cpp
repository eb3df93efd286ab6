#include "examples/tool/report.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "examples/tool/options.h"

namespace nacre::tool {

namespace {

using Json = nlohmann::ordered_json;

/// Set by the main thread while it reads the command line; read by any that ends the process.
std::atomic<ReportForm> the_form;

std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

/// What a list of diagnostics no longer holds.
std::string left_out(const Diagnostics& diagnostics) {
  std::size_t errors = diagnostics.error_count(), warnings = diagnostics.warning_count();
  for (const Diagnostic& each : diagnostics.all()) {
    if (each.severity == Severity::error) --errors;
    if (each.severity == Severity::warning) --warnings;
  }
  if (errors == 0 && warnings == 0) return {};
  Diagnostic said;
  said.severity = Severity::note;
  said.code = "more";
  said.message = fmt::format("{} more errors and {} more warnings", errors, warnings);
  return said_line(said);
}

std::string text_of(const Diagnostics& diagnostics) {
  if (!report_form().json) return diagnostics.to_string();
  std::string text;
  for (const Diagnostic& each : diagnostics.all()) text += said_line(each);
  return text + left_out(diagnostics);
}

}  // namespace

void set_report_form(ReportForm form) { the_form = form; }

ReportForm report_form() { return the_form; }

void add_report_options(CLI::App& command) {
  const CLI::Option* json = command.get_option("--json");
  const CLI::Option* strict = command.add_flag_callback(
      "--warnings-as-errors", [] {}, "Exit status 1 where a warning was said");
  command.parse_complete_callback(
      [=] { set_report_form({json->count() > 0, strict->count() > 0}); });
}

nlohmann::ordered_json json_of(const Diagnostic& said) {
  Json json{{"severity", severity_name(said.severity)}, {"code", said.code}};
  const auto add = [&](const char* name, const std::string& text) {
    if (!text.empty()) json[name] = text;
  };
  add("file", said.where.file);
  if (said.where.line > 0) json["line"] = said.where.line;
  if (said.where.line > 0 && said.where.column > 0) json["column"] = said.where.column;
  add("path", said.where.path);
  json["message"] = said.message;
  add("expected", said.expected);
  add("found", said.found);
  add("hint", said.hint);
  json["text"] = said.to_string();
  return json;
}

std::string said_line(const Diagnostic& said) {
  return report_form().json ? line_of(json_of(said)) : said.to_string() + '\n';
}

int report(const Diagnostics& diagnostics) {
  std::string text = text_of(diagnostics);
  const std::size_t warnings = diagnostics.warning_count();
  const bool counts = report_form().warnings_as_errors && warnings > 0;
  if (counts) {
    Diagnostic said;
    said.code = "warnings-as-errors";
    said.message = "warnings count as errors here";
    said.expected = "none";
    said.found = fmt::format("{}", warnings);
    text += said_line(said);
  }
  std::fputs(text.c_str(), stderr);
  return diagnostics.has_errors() || counts ? status_problems : status_ok;
}

void print_json(const nlohmann::ordered_json& document) {
  fmt::print("{}\n", document.dump(2, ' ', false, Json::error_handler_t::replace));
}

}  // namespace nacre::tool
