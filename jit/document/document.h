#pragma once

#include <cstddef>
#include <memory>
#include <memory_resource>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "jit/document/element.h"

namespace nacre {

/// What an XML file holds beside elements, for writing it again: it stands before
/// an element, or at the end of its parent.
struct Note {
  /// What it is; `include` is an `<xi:include>`, `instruction` a processing instruction.
  enum class Kind { comment, instruction, text, cdata, blank_line, include };
  Kind kind = Kind::comment;         ///< Says which of the others count.
  std::string_view text = {};        ///< Without what encloses it.
  const Element* include = nullptr;  ///< The <xi:include> that was followed.
};

/// What one or several .mtlx files say: a tree of elements, each knowing where
/// it was written. Read one with `read_document`; reading checks structure
/// (names, nesting, limits), not meaning. Once read it is never changed and may
/// be shared between threads.
class Document {
 public:
  Document();
  ~Document();
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  /// The element "materialx" that holds all others.
  const Element& root() const { return *root_; }
  /// For those who still build the document.
  Element& root() { return *root_; }

  /// The files it was read from, the main one first.
  const std::vector<std::string>& files() const { return file_names_; }
  /// The file an element was written in.
  const std::string& file_of(const Element& element) const;
  /// Of its tag, in its file; 1-based.
  int line_of(const Element& element) const;
  /// Bytes from the start of the line; 1-based.
  int column_of(const Element& element) const;

  /// Nodedefs, instances, looks and types are at most so many that inherit from one
  /// another; what refers to more is refused. See ReadLimits.
  std::size_t max_inheritance() const { return max_inheritance_; }

  // For the reader and for version upgrades, before anyone else sees the tree.

  /// See max_inheritance().
  void set_max_inheritance(std::size_t most) { max_inheritance_ = most; }
  /// Text that lives as long as the document.
  std::string_view intern(std::string_view text);
  /// Takes a file's text; `offset`s of its elements count from its start.
  std::uint16_t add_file(std::string name, std::unique_ptr<char[]> text, std::size_t size);
  /// The text of a file, still to be parsed: parsing may overwrite it.
  char* text(std::uint16_t file) { return texts_[file].get(); }

  /// A new element without parent, written at byte `offset` of the file. The text of `category`
  /// must be kept.
  Element& create(std::string_view category, std::uint16_t file, std::uint32_t offset);
  /// A new element that stands where `place` was written.
  Element& create_at(std::string_view category, const Element& place);
  /// Makes `child`, which stands nowhere, the last child.
  void append(Element& parent, Element& child);
  /// Takes the children from an element and returns the first of their chain.
  Element* take_children(Element& parent);
  /// Of a chain of children; null at its end.
  static Element* next_sibling(Element& element) { return element.next_; }
  /// Null if it has none.
  static Element* first_child(Element& element) { return element.first_child_; }
  /// Must be kept text. The attribute `name` stays as it is.
  static void set_name(Element& element, std::string_view name) { element.name_ = name; }
  /// Must be kept text.
  static void set_category(Element& element, std::string_view category) {
    element.category_ = category;
  }
  /// Replaces all attributes. The list is copied, the texts must be kept.
  void set_attributes(Element& element, std::span<const Attribute> attributes);
  /// Adds an attribute or replaces its value. Both texts must be kept.
  void set_attribute(Element& element, std::string_view name, std::string_view value);
  /// Does nothing if it is not there.
  void remove_attribute(Element& element, std::string_view name);

  /// What stands before an element; with `keep_comments` of ReadOptions all that
  /// the file had there, otherwise the includes of the main file.
  std::span<const Note> notes_before(const Element& element) const;
  /// What stands behind the last child of an element.
  std::span<const Note> notes_at_end(const Element& parent) const;
  /// What stands behind the root element.
  std::span<const Note> notes_behind() const { return behind_; }
  /// Replaces what stands before an element, unless `notes` is empty.
  void set_notes_before(const Element& element, std::vector<Note> notes);
  /// Replaces what stands behind the last child, unless `notes` is empty.
  void set_notes_at_end(const Element& parent, std::vector<Note> notes);
  /// Replaces what stands behind the root element.
  void set_notes_behind(std::vector<Note> notes) { behind_ = std::move(notes); }
  /// Puts the notes before `from` in front of those before `to`, or of those at
  /// the end of `parent` if `to` is null.
  void move_notes(const Element& from, const Element* to, const Element& parent);

  /// Before anything else asks for the root.
  void set_root(Element& element) { root_ = &element; }
  /// Builds the name tables. Call after the last change.
  void build_index();

 private:
  friend class Element;
  using NoteTable = std::unordered_map<const Element*, std::vector<Note>>;
  using NameTable = std::unordered_map<std::string_view, const Element*>;

  std::pmr::monotonic_buffer_resource arena_{1 << 16};
  std::vector<std::unique_ptr<char[]>> texts_;
  std::vector<std::string> file_names_;
  std::vector<std::vector<std::uint32_t>> line_starts_;
  std::unordered_map<const Element*, NameTable> tables_;
  NoteTable before_;
  NoteTable at_end_;
  std::vector<Note> behind_;
  Element* root_ = nullptr;
  std::size_t max_inheritance_ = 64;
};

}  // namespace nacre
