#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "jit/llvm/codegen.h"
#include "jit/llvm/session.h"
#include "runtime/program/program.h"

namespace nacre {

/// Which instruction of a Program each machine instruction is for, of an object that was
/// compiled with CodegenOptions::line_tables.
class CodeMap {
 public:
  /// Function and instruction of the Program.
  struct Place {
    std::uint32_t function = 0;
    ValueId instruction = 0;
  };

  /// Of an object where it was loaded. Empty for one without lines.
  CodeMap(const ObjectCode& object, LoadedCode::Entry entry);

  bool is_empty() const { return ranges_.empty(); }
  /// Nothing for addresses outside the object, and for code of no instruction: the loop over
  /// batches, say.
  std::optional<Place> at(std::uintptr_t address) const;

 private:
  struct Range {
    std::uintptr_t begin, end;
    Place place;
  };
  std::vector<Range> ranges_;  ///< Ascending.
};

}  // namespace nacre
