#include "jit/llvm/module_emitter.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>

#include "jit/llvm/entry.h"
#include "jit/llvm/function_emitter.h"
#include "jit/llvm/target.h"
#include "runtime/program/fold.h"

namespace nacre::codegen {

ModuleEmitter::ModuleEmitter(const Program& program, const CodegenOptions& options,
                             const Features& features, llvm::Module& module)
    : program_(program),
      options_(options),
      features_(features),
      module_(module),
      limit_(program, options.max_steps),
      tables_(program.tables.size(), nullptr) {
  if (limit_.is_counted()) costs_ = function_costs(program);
  if (options.line_tables) lines_.emplace(module);
  for (const Function& function : program.functions) {
    uniform_arguments_.push_back(uniform_arguments(function));
  }
}

std::int64_t ModuleEmitter::steps_of_round(const Function& function, ValueId open) const {
  const auto index = static_cast<std::size_t>(&function - program_.functions.data());
  // More than every limit, and a long way from where the counter would wrap.
  return static_cast<std::int64_t>(std::min(costs_[index].rounds.at(open), 1e15));
}

void ModuleEmitter::emit(const std::string& symbol) {
  auto* type = llvm::FunctionType::get(llvm::Type::getVoidTy(context()),
                                       {llvm::PointerType::getUnqual(context())}, false);
  auto* entry = llvm::Function::Create(type, llvm::GlobalValue::ExternalLinkage, symbol, module_);
  set_attributes(*entry);
  emit_entry(*this, *entry);
  if (lines_) lines_->finish();
}

llvm::DISubprogram* ModuleEmitter::lines_of(const Function& function, llvm::Function& into) {
  const auto index = static_cast<std::size_t>(&function - program_.functions.data());
  const bool is_ours = index < program_.functions.size();  // Helpers come from nowhere.
  return lines_ && is_ours ? lines_->begin(into, index) : nullptr;
}

llvm::Type* ModuleEmitter::scalar_type(Scalar scalar) {
  switch (scalar) {
    case Scalar::f32: return llvm::Type::getFloatTy(context());
    case Scalar::i32: return llvm::Type::getInt32Ty(context());
    case Scalar::b1: return llvm::Type::getInt1Ty(context());
    case Scalar::none: break;
  }
  assert(false && "a value without a type");
  return nullptr;
}

llvm::Type* ModuleEmitter::type(Scalar scalar, int lanes) {
  llvm::Type* one = scalar_type(scalar);
  return lanes == 1 ? one : llvm::FixedVectorType::get(one, static_cast<unsigned>(lanes));
}

llvm::Type* ModuleEmitter::stored_type(Scalar scalar, int lanes) {
  const bool as_words = scalar == Scalar::b1 && lanes > 1 && !features_.avx512;
  return type(as_words ? Scalar::i32 : scalar, lanes);
}

llvm::Function* ModuleEmitter::instance(std::uint32_t index, int lanes) {
  llvm::Function*& known = instances_[{index, lanes}];
  if (known != nullptr) return known;
  const Function& function = program_.functions[index];
  std::vector<llvm::Type*> arguments{llvm::PointerType::getUnqual(context())};
  const std::vector<bool>& uniform = uniform_arguments_[index];
  for (std::size_t i = 0; i < uniform.size(); ++i) {
    arguments.push_back(stored_type(function.arguments[i], uniform[i] ? 1 : lanes));
  }
  std::vector<llvm::Type*> results;
  for (const Scalar result : function.results) results.push_back(stored_type(result, lanes));
  llvm::StructType* result = llvm::StructType::get(context(), results);
  llvm::Function* made = add_function(fmt::format("{}.{}.w{}", function.name, index, lanes),
                                      llvm::FunctionType::get(result, arguments, false));
  known = made;

  FunctionEmitter emitter(*this, function, *made, lanes);
  emitter.kernel_arguments = made->getArg(0);
  for (std::size_t i = 0; i < function.code.size(); ++i) emitter.emit(static_cast<ValueId>(i));
  llvm::Value* all = llvm::PoisonValue::get(result);
  for (unsigned i = 0; i < emitter.gives.size(); ++i) {
    all = emitter.builder().CreateInsertValue(all, emitter.gives[i], i);
  }
  emitter.builder().CreateRet(all);
  return made;
}

llvm::Function* ModuleEmitter::add_function(const std::string& name, llvm::FunctionType* type) {
  auto* made = llvm::Function::Create(type, llvm::GlobalValue::InternalLinkage, name, module_);
  made->setCallingConv(llvm::CallingConv::Fast);
  made->addFnAttr(llvm::Attribute::NoInline);
  set_attributes(*made);
  return made;
}

llvm::GlobalVariable* ModuleEmitter::table_data(std::uint32_t index) {
  llvm::GlobalVariable*& known = tables_[index];
  if (known != nullptr) return known;
  std::vector<std::uint32_t> bits;
  for (const float value : program_.tables[index].values) {
    bits.push_back(flush_denormal(std::bit_cast<std::uint32_t>(value)));
  }
  bits.insert(bits.begin(), table_margin, bits.front());
  bits.insert(bits.end(), table_margin, bits.back());
  llvm::Constant* data = llvm::ConstantDataArray::getFP(llvm::Type::getFloatTy(context()), bits);
  known = new llvm::GlobalVariable(module_, data->getType(), /*isConstant=*/true,
                                   llvm::GlobalValue::PrivateLinkage, data,
                                   fmt::format("table.{}", index));
  known->setAlignment(llvm::Align(64));
  return known;
}

llvm::GlobalVariable* ModuleEmitter::opaque_one() {
  if (one_ != nullptr) return one_;
  llvm::Type* type = llvm::Type::getFloatTy(context());
  one_ = new llvm::GlobalVariable(module_, type, /*isConstant=*/true,
                                  llvm::GlobalValue::InternalLinkage,
                                  llvm::ConstantFP::get(type, 1.0), "one");
  // "Initialized elsewhere": so the value in it is not taken for granted.
  one_->setExternallyInitialized(true);
  return one_;
}

void ModuleEmitter::set_attributes(llvm::Function& function) {
  function.addFnAttr(llvm::Attribute::NoUnwind);
  function.addFnAttr("denormal-fp-math", "preserve-sign,preserve-sign");
  // Both are needed, or LLVM splits 16 lanes into halves on some CPUs
  // (X86Subtarget::useAVX512Regs).
  const char* width = lanes() == 16 ? "512" : "256";
  function.addFnAttr("prefer-vector-width", width);
  function.addFnAttr("min-legal-vector-width", width);
  function.addFnAttr("target-cpu", baseline_cpu);
  function.addFnAttr("tune-cpu", options_.target.cpu);
  function.addFnAttr("target-features", features_.all);
  if (!function.hasInternalLinkage()) function.addParamAttr(0, llvm::Attribute::NonNull);
}

}  // namespace nacre::codegen
