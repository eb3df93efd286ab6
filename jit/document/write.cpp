#include "jit/document/write.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "runtime/float_environment.h"

namespace nacre {

namespace {

void append_escaped(std::string& text, std::string_view value, bool in_attribute) {
  for (const char c : value) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '&') {
      text += "&amp;";
    } else if (c == '<') {
      text += "&lt;";
    } else if (c == '>' && !in_attribute) {
      text += "&gt;";
    } else if (c == '"' && in_attribute) {
      text += "&quot;";
    } else if (code < 0x20 && (in_attribute || (c != '\n' && c != '\t'))) {
      text += fmt::format("&#{};", code);
    } else {
      text += c;
    }
  }
}

class Writer {
 public:
  Writer(const Document& document, const WriteOptions& options)
      : document_(document), options_(options) {}

  std::string write() {
    const Element& root = document_.root();
    const std::span<const Note> before = document_.notes_before(root);
    const bool declares = std::any_of(before.begin(), before.end(), [](const Note& note) {
      return note.kind == Note::Kind::instruction && note.text.starts_with("xml ");
    });
    if (!declares) text_ += "<?xml version=\"1.0\"?>\n";
    write_notes(before, 0);
    write_element(root, 0);
    write_notes(document_.notes_behind(), 0);
    return std::move(text_);
  }

 private:
  void indent(int level) { text_.append(static_cast<std::size_t>(2 * level), ' '); }

  void write_notes(std::span<const Note> notes, int level) {
    for (const Note& note : notes) write_note(note, level);
  }

  void write_note(const Note& note, int level) {
    if (note.kind == Note::Kind::blank_line) {
      text_ += '\n';
      return;
    }
    if (note.kind == Note::Kind::include) {
      if (!options_.flatten) write_element(*note.include, level);
      return;
    }
    indent(level);
    write_inline(note);
    text_ += '\n';
  }

  void write_inline(const Note& note) {
    switch (note.kind) {
      case Note::Kind::comment: text_ += fmt::format("<!--{}-->", note.text); break;
      case Note::Kind::instruction: text_ += fmt::format("<?{}?>", note.text); break;
      case Note::Kind::cdata: text_ += fmt::format("<![CDATA[{}]]>", note.text); break;
      case Note::Kind::text: append_escaped(text_, note.text, false); break;
      default: break;
    }
  }

  void write_attribute(std::string_view name, std::string_view value) {
    text_ += fmt::format(" {}=\"", name);
    append_escaped(text_, value, true);
    text_ += '"';
  }

  void write_start(const Element& element) {
    text_ += '<';
    text_ += element.category();
    for (const Attribute& attribute : element.attributes()) {
      // What came through an include may be called otherwise than it was written.
      if (attribute.name == "name") {
        write_attribute("name", element.name());
      } else if (attribute.name == "fileprefix") {
        write_attribute("fileprefix", rebase_ + std::string(attribute.value));
      } else {
        write_attribute(attribute.name, attribute.value);
      }
    }
    const bool is_top = element.parent() == &document_.root();
    if (is_top && !rebase_.empty() && !element.has_attribute("fileprefix")) {
      write_attribute("fileprefix",
                      rebase_ + std::string(element.inherited_attribute("fileprefix")));
    }
  }

  /// What leads from the folder of the document to that of an element's file, if
  /// the element names files: relative names counted from there.
  std::string rebase_of(const Element& child) const {
    if (!names_files(child)) return {};
    const std::filesystem::path main(document_.file_of(document_.root()));
    const std::filesystem::path own(document_.file_of(child));
    const std::string folder =
        own.parent_path().lexically_relative(main.parent_path()).generic_string();
    return folder.empty() || folder == "." ? std::string() : folder + "/";
  }

  static bool names_files(const Element& element) {
    if (element.attribute("type") == "filename") return true;
    const ElementRange children = element.children();
    return std::any_of(children.begin(), children.end(), names_files);
  }

  bool is_written(const Element& child) const {
    return options_.flatten || child.parent() != &document_.root() ||
           &document_.file_of(child) == &document_.file_of(document_.root());
  }

  static bool is_text(std::span<const Note> notes) {
    return std::any_of(notes.begin(), notes.end(), [](const Note& note) {
      return note.kind == Note::Kind::text || note.kind == Note::Kind::cdata;
    });
  }

  /// Text between elements counts as it is: nothing may be added to it.
  bool holds_text(const Element& element) const {
    if (is_text(document_.notes_at_end(element))) return true;
    const ElementRange children = element.children();
    return std::any_of(children.begin(), children.end(), [&](const Element& child) {
      return is_text(document_.notes_before(child));
    });
  }

  void write_element(const Element& element, int level) {
    indent(level);
    write_start(element);
    if (element.child_count() == 0 && document_.notes_at_end(element).empty()) {
      text_ += " />\n";
      return;
    }
    text_ += '>';
    if (holds_text(element)) {
      write_mixed(element);
    } else {
      text_ += '\n';
      for (const Element& child : element.children()) {
        if (!is_written(child)) continue;
        write_notes(document_.notes_before(child), level + 1);
        if (level == 0) rebase_ = rebase_of(child);
        write_element(child, level + 1);
      }
      if (level == 0) rebase_.clear();
      write_notes(document_.notes_at_end(element), level + 1);
      indent(level);
    }
    text_ += fmt::format("</{}>\n", element.category());
  }

  void write_mixed(const Element& element) {
    for (const Element& child : element.children()) {
      for (const Note& note : document_.notes_before(child)) write_inline(note);
      write_element(child, 0);
      text_.pop_back();  // The end of the line.
    }
    for (const Note& note : document_.notes_at_end(element)) write_inline(note);
  }

  const Document& document_;
  const WriteOptions& options_;
  std::string text_;
  std::string rebase_;  ///< Goes before `fileprefix` within the current child of the root.
};

}  // namespace

std::string write_document(const Document& document, const WriteOptions& options) {
  const ScopedDefaultFloatEnvironment environment;
  return Writer(document, options).write();
}

std::string xml_text(std::string_view text) {
  std::string safe;
  append_escaped(safe, text, true);
  return safe;
}

}  // namespace nacre
