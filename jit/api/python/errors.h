#pragma once

#include <nanobind/nanobind.h>

#include <nacre/nacre.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace nacre::python {

/// As Python has it. Names come from documents, which may hold bytes that are no UTF-8.
nanobind::str text(std::string_view utf8);
nanobind::list texts(const std::vector<std::string>& list);

/// Throws an Error of one diagnostic, for what a caller gave that is not right: `name` says which.
[[noreturn]] void refuse(const std::string& code, const std::string& name,
                         const std::string& message, const std::string& expected,
                         const std::string& found, const std::string& hint = {});

/// "did you mean 'uv0'?", of the names that there are; "" where none is near. By Python's difflib.
std::string near_hint(const std::string& wanted, const std::vector<std::string>& known);

/// A list of nacre.Diagnostic.
nanobind::list diagnostics_of(const std::vector<Diagnostic>& said);

/// Warnings become Python's, of category nacre.DiagnosticWarning; notes go to the logger "nacre".
/// Throws what a user's filter makes of them. Needs the GIL.
void warn(const std::vector<Diagnostic>& said);

}  // namespace nacre::python
