#pragma once

// Needs LLVM; for the .cpp files of this folder.

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "jit/llvm/features.h"
#include "jit/llvm/line_table.h"
#include "jit/llvm/llvm.h"
#include "jit/llvm/options.h"
#include "runtime/program/cost.h"
#include "runtime/program/program.h"

namespace nacre::codegen {

/// Constants are folded by the Recorder and, knowing how denormals behave, by
/// LLVM's passes; never by the builder, which does not know.
using Builder = llvm::IRBuilder<llvm::NoFolder>;

/// Turns one Program into one module: what its functions share.
class ModuleEmitter {
 public:
  ModuleEmitter(const Program& program, const CodegenOptions& options, const Features& features,
                llvm::Module& module);

  /// Emits the entry, `void symbol(RunState*)`, and all it calls. Once.
  void emit(const std::string& symbol);

  const Program& program() const { return program_; }
  const Features& features() const { return features_; }
  llvm::Module& module() { return module_; }
  llvm::LLVMContext& context() { return module_.getContext(); }
  const CodegenOptions& options() const { return options_; }
  int lanes() const { return options_.lanes; }
  const StepLimit& limit() const { return limit_; }
  /// Steps of a round of the loop that instruction `open` of a function opens; only where
  /// they are counted.
  std::int64_t steps_of_round(const Function& function, ValueId open) const;
  bool is_fast() const { return options_.accuracy == Accuracy::fast; }

  llvm::Type* scalar_type(Scalar scalar);
  /// The type of a value: a vector where `lanes` > 1.
  llvm::Type* type(Scalar scalar, int lanes);

  /// The type in which a value is stored from its definition to its uses. As type(),
  /// but for masks where the CPU has no mask registers: there a vector of b1 is
  /// words of all ones or zeros, as comparisons give them, since LLVM would pack it
  /// into other forms and back on the way.
  llvm::Type* stored_type(Scalar scalar, int lanes);

  /// The outlined function `index` for vectors of `lanes`, or for scalars at
  /// lanes = 1. Emitted when first asked for.
  llvm::Function* instance(std::uint32_t index, int lanes);

  /// What the lines of `into` are in, which is made of a function of the Program; null if
  /// nobody asks for lines.
  llvm::DISubprogram* lines_of(const Function& function, llvm::Function& into);

  /// uniform_arguments() of the outlined function `index`.
  const std::vector<bool>& uniform_arguments_of(std::uint32_t index) const {
    return uniform_arguments_[index];
  }

  /// A function that only this module calls, by the fast convention; never inlined.
  llvm::Function* add_function(const std::string& name, llvm::FunctionType* type);

  /// A read-only array that loads may index: table_margin copies of the table's
  /// first entry, the table, as many copies of the last.
  llvm::GlobalVariable* table_data(std::uint32_t index);
  static constexpr std::uint32_t table_margin = 3;
  /// 1.0, but LLVM must not know. See flush() in function_emitter.h.
  llvm::GlobalVariable* opaque_one();

 private:
  void set_attributes(llvm::Function& function);

  const Program& program_;
  const CodegenOptions& options_;
  const Features& features_;
  llvm::Module& module_;
  std::optional<LineTable> lines_;
  StepLimit limit_;
  std::vector<FunctionCost> costs_;  ///< Where they are counted.
  std::vector<std::vector<bool>> uniform_arguments_;
  std::map<std::pair<std::uint32_t, int>, llvm::Function*> instances_;
  std::vector<llvm::GlobalVariable*> tables_;
  llvm::GlobalVariable* one_ = nullptr;
};

}  // namespace nacre::codegen
