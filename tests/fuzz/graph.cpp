// Bytes as the choices by which a document is put together from nodes of the
// data library; what has no fault put in must build, record and run.
#include <cstddef>
#include <cstdint>

#include "jit/document/read.h"
#include "jit/graph/check/check.h"
#include "tests/fuzz/host.h"
#include "tests/fuzz/random_document.h"

namespace {

using namespace nacre;

// A valid document may still be larger than what fuzzing allows itself.
void require_no_errors(const Document& document, const std::string& text) {
  Diagnostics diagnostics;
  const GraphOptions options = fuzz::host().graph_options(fuzz::shader_options());
  check_document(document, fuzz::host().library(), options, diagnostics);
  for (const Diagnostic& one : diagnostics.all()) {
    if (one.severity == Severity::error && one.code != "too-many-nodes") {
      fuzz::fail("a valid document is refused\n" + one.to_string() + '\n' + text);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::RandomDocument random = fuzz::random_document(fuzz::Bytes({data, size}));
  Diagnostics diagnostics;
  const auto document =
      read_document_text(random.text, "input.mtlx", fuzz::read_options(), diagnostics);
  if (document == nullptr && random.valid) {
    fuzz::fail("a valid document is not read\n" + diagnostics.to_string() + '\n' + random.text);
  }
  if (document == nullptr) return 0;
  if (random.valid) require_no_errors(*document, random.text);
  fuzz::shade_everything(*document);
  return 0;
}
