#include "jit/llvm/line_table.h"

#include <llvm/BinaryFormat/Dwarf.h>

#include <string>

namespace nacre::codegen {

LineTable::LineTable(llvm::Module& module) : builder_(module) {
  module.addModuleFlag(llvm::Module::Warning, "Debug Info Version", llvm::DEBUG_METADATA_VERSION);
  module.addModuleFlag(llvm::Module::Warning, "Dwarf Version", 4);
  builder_.createCompileUnit(llvm::dwarf::DW_LANG_C, builder_.createFile("program", ""), "nacre",
                             /*isOptimized=*/true, /*Flags=*/"", /*RV=*/0, /*SplitName=*/"",
                             llvm::DICompileUnit::LineTablesOnly);
}

llvm::DISubprogram* LineTable::begin(llvm::Function& into, std::size_t index) {
  llvm::DIFile* file = builder_.createFile(std::to_string(index), "");
  llvm::DISubroutineType* type = builder_.createSubroutineType(builder_.getOrCreateTypeArray({}));
  llvm::DISubprogram* made =
      builder_.createFunction(file, into.getName(), into.getName(), file, 0, type, 0,
                              llvm::DINode::FlagZero, llvm::DISubprogram::SPFlagDefinition);
  into.setSubprogram(made);
  return made;
}

}  // namespace nacre::codegen
