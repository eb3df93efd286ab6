#pragma once

#include "tests/fuzz/splice.h"

namespace nacre::fuzz {

/// One change of a document: which, where and with what is drawn.
struct Change {
  const Splicer& splicer;
  Tree& root;
  const Tree* donor;  ///< Null: any document.
  Random& random;

  void apply();

 private:
  Tree& element() const;
  /// An element with children, and a place among them.
  std::pair<Tree*, std::size_t> place() const;
  std::string some_name() const;

  void graft_attribute() const;
  void known_value() const;
  void odd_value() const;
  void remove_attribute() const;
  void rename_attribute() const;
  void insert_part() const;
  void replace_part() const;
  void remove_element() const;
  void repeat_element() const;
  void refer() const;
  void connect() const;
  void change_category() const;
  void steal_nodedef() const;
  void swap_values() const;
  void splice_text() const;
  void change_digit() const;
};

}  // namespace nacre::fuzz
