#pragma once

// Needs LLVM; for the .cpp files of this folder.

#include <optional>
#include <utility>
#include <vector>

#include "jit/llvm/module_emitter.h"
#include "jit/llvm/parts.h"
#include "jit/llvm/region.h"
#include "jit/llvm/rows.h"
#include "runtime/kernel.h"

namespace nacre::codegen {

/// Emits the instructions of one function of a Program. What differs from lane
/// to lane is a vector; what is uniform is a scalar, spread where it is used.
class FunctionEmitter {
 public:
  /// `lanes`: of varying values; 1 in a function's scalar instance.
  FunctionEmitter(ModuleEmitter& module, const Function& function, llvm::Function& into, int lanes);

  /// Cuts what is emitted from here on into parts, which have to live as long.
  void cut(const Parts& parts);
  /// Has what is emitted from here on read rows, which have to live as long, and makes those where
  /// there are as many points as they are worth. Not of an entry that is cut.
  void fill(const Rows& rows, llvm::Value* points);
  /// Emits instruction `id` where the builder stands, or in its part.
  void emit(ValueId id);
  /// The builder stands in the function itself again.
  void leave_part();

  const Function& function() const { return function_; }
  const Instruction& at(ValueId id) const { return function_.code[id]; }
  ModuleEmitter& module() { return module_; }
  Builder& builder() { return builder_; }
  int lanes() const { return lanes_; }

  /// A vector, rather than a scalar.
  bool is_wide(ValueId id) const { return lanes_ > 1 && at(id).varying; }
  int lanes_of(ValueId id) const { return is_wide(id) ? lanes_ : 1; }
  llvm::Type* type_of(ValueId id) { return module_.type(at(id).type, lanes_of(id)); }
  llvm::Type* stored_type_of(ValueId id) { return module_.stored_type(at(id).type, lanes_of(id)); }

  /// The value of `id` with that many lanes (1 or lanes()): spread if need be.
  llvm::Value* use(ValueId id, int lanes);
  llvm::Value* operand(const Instruction& instruction, std::size_t k, int lanes) {
    return use(instruction.operands[k], lanes);
  }
  /// use(), in the stored_type(): for phis, arguments and results.
  llvm::Value* stored(ValueId id, int lanes);
  /// To the stored_type(), and back to the type().
  llvm::Value* to_stored(llvm::Value* value);
  llvm::Value* from_stored(llvm::Value* value, Scalar scalar);
  /// Values are defined in their stored_type().
  void define(ValueId id, llvm::Value* value);
  /// In this part, or anywhere where there are none.
  llvm::Value* defined(ValueId id) const { return values_[id]; }
  /// Reads of neighbouring words that are emitted at once: see word_run.h.
  std::vector<ValueId> word_run(ValueId first) const;
  llvm::Value* spread(llvm::Value* scalar, int lanes);

  /// Whether any lane of a b1 is true, as a scalar.
  llvm::Value* any(llvm::Value* mask);

  llvm::Constant* i32(std::uint32_t value, int lanes = 1);
  llvm::Constant* f32_bits(std::uint32_t bits, int lanes = 1);
  /// An allocation in the function's first block.
  llvm::AllocaInst* scratch(llvm::Type* type, std::uint64_t count, const char* name);
  /// A load of memory that does not change while the kernel runs.
  llvm::LoadInst* load_invariant(llvm::Type* type, llvm::Value* from, const char* name = "");
  llvm::Value* byte_offset(llvm::Value* base, std::size_t bytes);
  /// RunState::steps_left, which loops change.
  llvm::Value* load_steps_left();
  void store_steps_left(llvm::Value* value);
  /// Whether KernelArguments::stop asks to end, as b1.
  llvm::Value* load_stop();

  /// x with denormals as zero, for f32 of unknown origin. Multiplying by one in
  /// a denormals-are-zero environment does that in one instruction that also
  /// loads; only LLVM must not see that it is one.
  llvm::Value* flush(llvm::Value* x);
  /// The bits of x with every NaN as 0x7fc00000.
  llvm::Value* canonical_bits(llvm::Value* x);

  /// The entry: loads what does not change from `arguments`, its RunState*.
  void begin_entry(llvm::Value* arguments);

  llvm::Value* kernel_arguments = nullptr;  ///< RunState*, which begins with them.
  llvm::Value* input_pointers = nullptr;    ///< In the entry: arrays by channel,
  llvm::Value* output_pointers = nullptr;
  llvm::Value* first_point = nullptr;  ///< and the batch's first index in them, if any.
  std::vector<llvm::Value*> gives;     ///< Results of an outlined function, by index.

  std::vector<Region> regions;  ///< Open ones, outermost first.

 private:
  /// What is the function's own while a part is emitted.
  struct Outside {
    llvm::Function* into;
    llvm::BasicBlock* block;
    llvm::DISubprogram* lines;
    llvm::Value *kernel_arguments, *input_pointers, *output_pointers, *first_point, *frame;
  };

  /// Of LineTable; 0: of no instruction.
  void say_line(std::uint32_t line);
  void enter_part(std::uint32_t part);
  /// A value as this part has it: from the frame if another one made it.
  llvm::Value* value_of(ValueId id);
  llvm::Value* place_of(ValueId id);
  llvm::Align align_of(ValueId id) const;

  void emit_group(const RowGroup& group);
  /// Rows of so many numbers each.
  void fill_alike(const Rows& rows, const std::vector<std::size_t>& alike, std::uint32_t count);
  /// Emits steps of rows, anew, of the index as it is defined now. Who calls sees to it that what
  /// was defined before is so again.
  void compute(const std::vector<ValueId>& steps);

  ModuleEmitter& module_;
  const Function& function_;
  llvm::Function* into_;
  int lanes_;
  llvm::DISubprogram* lines_;  ///< May be null.
  Builder builder_;
  std::vector<llvm::Value*> values_;
  const Parts* parts_ = nullptr;
  std::uint32_t part_ = 0;
  std::optional<Outside> outside_;
  llvm::Value* frame_ = nullptr;
  std::vector<ValueId> to_store_;  ///< Defined by what is being emitted, for other parts.
  const Rows* rows_ = nullptr;
  std::vector<llvm::Value*> row_arrays_;  ///< Of Rows::rows.
  llvm::Value* has_rows_ = nullptr;       ///< Whether they are filled.
};

/// Emits one instruction and returns its value, or null if it has none.
using EmitOp = llvm::Value* (*)(FunctionEmitter& emitter, ValueId id);

/// The function for an operation; null for those that passes remove before.
EmitOp emit_op(Op op);

}  // namespace nacre::codegen
