// Versions, stops and reports.

#include "jit/api/call.h"
#include "jit/api/handles.h"

namespace nacre::api {

std::vector<std::string> texts_of(const char* const* texts, std::size_t count) {
  std::vector<std::string> list;
  for (std::size_t i = 0; texts != nullptr && i < count; ++i) {
    if (texts[i] != nullptr) list.emplace_back(texts[i]);
  }
  return list;
}

namespace {

nacre_diagnostic diagnostic_of(const Diagnostic& one, const std::string& line) {
  return {.size = sizeof(nacre_diagnostic),
          .severity = static_cast<int>(one.severity),
          .code = one.code.c_str(),
          .file = one.where.file.c_str(),
          .line = one.where.line,
          .column = one.where.column,
          .path = one.where.path.c_str(),
          .message = one.message.c_str(),
          .expected = one.expected.c_str(),
          .found = one.found.c_str(),
          .text = line.c_str(),
          .hint = one.hint.c_str()};
}

}  // namespace

void tell_listener(const nacre_report* report, std::size_t first) noexcept {
  if (report == nullptr || report->listener == nullptr) return;
  try {
    const std::vector<Diagnostic>& all = report->said.all();
    for (std::size_t i = first; i < all.size(); ++i) {
      const std::string line = all[i].to_string();
      const nacre_diagnostic given = diagnostic_of(all[i], line);
      report->listener(report->listener_user, &given);
    }
  } catch (...) {  // There is no memory to say it in.
  }
}

void say_thrown(nacre_report* report, const char* what) noexcept {
  if (report == nullptr) return;
  try {
    Said said(report);
    said.diagnostics().error("unexpected", {}, "the library could not do that", {}, what);
  } catch (...) {  // There is no memory to say it in.
  }
}

}  // namespace nacre::api

using namespace nacre;
using namespace nacre::api;

uint32_t nacre_version(void) { return NACRE_VERSION; }

const char* nacre_version_text(void) {
#define NACRE_TEXT_OF(number) #number
#define NACRE_TEXT(number) NACRE_TEXT_OF(number)
  return NACRE_TEXT(NACRE_VERSION_MAJOR) "." NACRE_TEXT(NACRE_VERSION_MINOR) "." NACRE_TEXT(
      NACRE_VERSION_PATCH);
#undef NACRE_TEXT
#undef NACRE_TEXT_OF
}

nacre_status nacre_stop_create(nacre_stop** stop) {
  if (stop == nullptr) return NACRE_WRONG_ARGUMENTS;
  *stop = nullptr;
  return guarded([&] {
    *stop = new nacre_stop;
    return nacre_status{NACRE_OK};
  });
}

void nacre_stop_destroy(nacre_stop* stop) { delete stop; }

void nacre_stop_request(nacre_stop* stop) {
  if (stop != nullptr) stop->source.request_stop();
}

nacre_status nacre_report_create(nacre_report** report) {
  if (report == nullptr) return NACRE_WRONG_ARGUMENTS;
  *report = new (std::nothrow) nacre_report;
  return *report != nullptr ? NACRE_OK : NACRE_OUT_OF_MEMORY;
}

void nacre_report_destroy(nacre_report* report) { delete report; }

size_t nacre_report_count(const nacre_report* report) {
  return report != nullptr ? report->said.all().size() : 0;
}

size_t nacre_report_error_count(const nacre_report* report) {
  return report != nullptr ? report->said.error_count() : 0;
}

nacre_status nacre_report_get(const nacre_report* report, size_t index,
                              nacre_diagnostic* diagnostic) {
  if (index >= nacre_report_count(report)) return NACRE_WRONG_ARGUMENTS;
  return guarded([&] {
    const std::vector<Diagnostic>& all = report->said.all();
    report->lines.resize(all.size());
    const Diagnostic& one = all[index];
    std::string& line = report->lines[index];
    if (line.empty()) line = one.to_string();
    return give(diagnostic, diagnostic_of(one, line));
  });
}

void nacre_report_clear(nacre_report* report) {
  if (report == nullptr) return;
  report->said = {};
  report->lines.clear();
}

void nacre_report_listen(nacre_report* report,
                         void (*said)(void* user, const nacre_diagnostic* diagnostic), void* user) {
  if (report == nullptr) return;
  report->listener = said;
  report->listener_user = user;
}
