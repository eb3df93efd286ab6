#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/diagnostic.h"

namespace CLI {
class App;
}

namespace nacre::tool {

/// How a process says things, of which it has one standard error.
struct ReportForm {
  bool json = false;  ///< A JSON object a line.
  bool warnings_as_errors = false;
};

/// Before anything is said; from then on for whatever says something.
void set_report_form(ReportForm form);
ReportForm report_form();

/// Adds --warnings-as-errors to a subcommand; asking for that, or for the --json that it has, sets
/// the form.
void add_report_options(CLI::App& command);

/// One thing said, as its line with a line feed, in the form asked for.
std::string said_line(const Diagnostic& said);

/// The members severity, code and message, and those of file, line, column, path, expected, found
/// and hint that are known; text: all of it as a person reads it.
nlohmann::ordered_json json_of(const Diagnostic& said);

/// Prints diagnostics on standard error; the status they mean. Warnings mean problems where they
/// count as errors, which is said too.
int report(const Diagnostics& diagnostics);

/// Prints a JSON document on standard output. Names in it come from documents, which may hold
/// bytes that are no UTF-8; those are replaced.
void print_json(const nlohmann::ordered_json& document);

}  // namespace nacre::tool
