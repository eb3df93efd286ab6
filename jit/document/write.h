#pragma once

#include <string>
#include <string_view>

#include "jit/document/document.h"

namespace nacre {

/// How a document is written.
struct WriteOptions {
  /// Write what other files gave as the document's own; otherwise their elements
  /// are left out and the <xi:include>s stay. Where such an element names files,
  /// its `fileprefix` leads from the first file's folder to its own.
  bool flatten = false;
};

/// The XML of a document read by `read_document`, of version 1.39 if it was older:
/// all elements and attributes in their order, unknown ones too, and, if it was
/// read with `keep_comments`, what stood between them. Indented by two blanks;
/// characters that XML reserves are written as references. Reading the text from
/// the folder of the first file gives an equal document; a local element that an
/// include's hides is not in it.
std::string write_document(const Document& document, const WriteOptions& options = {});

/// A text as XML has it between the quotes of an attribute, or between tags.
std::string xml_text(std::string_view text);

}  // namespace nacre
