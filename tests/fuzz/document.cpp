// Text as a document: reading, building, recording, interpreting. Nothing may
// come of it but diagnostics and numbers.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "jit/document/read.h"
#include "tests/fuzz/host.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  Diagnostics diagnostics;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto document = read_document_text(text, "input.mtlx", fuzz::read_options(), diagnostics);
  if ((document == nullptr) != diagnostics.has_errors()) {
    fuzz::fail("a document is refused without a reason, or read with an error");
  }
  if (document != nullptr) fuzz::shade_everything(*document);
  return 0;
}
