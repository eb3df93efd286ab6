#include "jit/llvm/code_map.h"

#include <llvm/DebugInfo/DWARF/DWARFContext.h>
#include <llvm/Object/ObjectFile.h>
#include <llvm/Support/MemoryBuffer.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace nacre {

namespace {

/// Where a symbol lies in its section.
std::optional<std::uint64_t> offset_of(const llvm::object::ObjectFile& object,
                                       const std::string& name) {
  for (const llvm::object::SymbolRef& symbol : object.symbols()) {
    llvm::Expected<llvm::StringRef> known = symbol.getName();
    llvm::Expected<std::uint64_t> value = symbol.getValue();
    const bool found = known && value && *known == name;
    if (found) return *value;
    llvm::consumeError(known.takeError());
    llvm::consumeError(value.takeError());
  }
  return std::nullopt;
}

}  // namespace

CodeMap::CodeMap(const ObjectCode& code, LoadedCode::Entry entry) {
  const llvm::MemoryBufferRef bytes(llvm::StringRef(code.bytes.data(), code.bytes.size()), "");
  auto object = llvm::object::ObjectFile::createObjectFile(bytes);
  if (!object) {
    llvm::consumeError(object.takeError());
    return;
  }
  const auto offset = offset_of(**object, code.symbol);
  if (!offset) return;
  // All code is in one section, which is loaded as it is.
  const std::uintptr_t base = reinterpret_cast<std::uintptr_t>(entry) - *offset;
  const auto dwarf = llvm::DWARFContext::create(**object);
  for (const auto& unit : dwarf->compile_units()) {
    const llvm::DWARFDebugLine::LineTable* table = dwarf->getLineTableForUnit(unit.get());
    if (table == nullptr) continue;
    for (std::size_t i = 0; i + 1 < table->Rows.size(); ++i) {
      const llvm::DWARFDebugLine::Row& row = table->Rows[i];
      std::string file;
      const bool is_ours =
          !row.EndSequence && row.Line > 0 &&
          table->getFileNameByIndex(row.File, {},
                                    llvm::DILineInfoSpecifier::FileLineInfoKind::RawValue, file);
      if (!is_ours) continue;
      const auto function = static_cast<std::uint32_t>(std::strtoul(file.c_str(), nullptr, 10));
      ranges_.push_back({base + row.Address.Address,
                         base + table->Rows[i + 1].Address.Address,
                         {function, row.Line - 1}});
    }
  }
  std::ranges::sort(ranges_, {}, &Range::begin);
}

std::optional<CodeMap::Place> CodeMap::at(std::uintptr_t address) const {
  const auto after = std::ranges::upper_bound(ranges_, address, {}, &Range::begin);
  if (after == ranges_.begin() || address >= std::prev(after)->end) return std::nullopt;
  return std::prev(after)->place;
}

}  // namespace nacre
