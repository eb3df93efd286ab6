// Machine code knows which instruction of the Program it is for, and is the same code.

#include "jit/llvm/code_map.h"

#include <gtest/gtest.h>
#include <llvm/Object/ObjectFile.h>

#include <set>
#include <string>

#include "tests/jit/llvm/engine.h"
#include "tests/support/random_program.h"

namespace nacre {
namespace {

CodegenOptions options_with(bool lines) {
  CodegenOptions options;
  options.lanes = 8;
  options.line_tables = lines;
  return options;
}

/// The bytes of the section that code is in.
std::string code_of(const ObjectCode& code) {
  const llvm::MemoryBufferRef bytes(llvm::StringRef(code.bytes.data(), code.bytes.size()), "");
  auto object = llvm::object::ObjectFile::createObjectFile(bytes);
  if (!object) return {};
  for (const llvm::object::SectionRef& section : (*object)->sections()) {
    if (!section.isText()) continue;
    auto contents = section.getContents();
    if (contents) return contents->str();
  }
  return {};
}

TEST(CodeMap, LinesChangeNoCode) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Program program = random_program(seed);
    Diagnostics diagnostics;
    const auto plain = compile_object(program, options_with(false), diagnostics);
    const auto lined = compile_object(program, options_with(true), diagnostics);
    ASSERT_TRUE(plain && lined) << diagnostics.to_string();
    ASSERT_FALSE(code_of(*plain).empty());
    EXPECT_EQ(code_of(*plain), code_of(*lined)) << "seed " << seed;
  }
}

TEST(CodeMap, PlacesAreInstructionsOfTheProgram) {
  std::set<Op> found;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Program program = random_program(seed);
    Diagnostics diagnostics;
    const auto object = compile_object(program, options_with(true), diagnostics);
    ASSERT_TRUE(object) << diagnostics.to_string();
    const auto code = session()->load(*object, diagnostics);
    ASSERT_NE(code, nullptr) << diagnostics.to_string();
    const CodeMap map(*object, code->entry());
    ASSERT_FALSE(map.is_empty());
    const auto start = reinterpret_cast<std::uintptr_t>(code->entry());
    for (std::uintptr_t i = 0; i < code_of(*object).size(); ++i) {
      const auto place = map.at(start + i);
      if (!place) continue;
      ASSERT_LT(place->function, program.functions.size());
      ASSERT_LT(place->instruction, program.functions[place->function].code.size());
      found.insert(program.functions[place->function].code[place->instruction].op);
    }
  }
  for (const Op op : {Op::add, Op::mul, Op::div, Op::store, Op::if_any}) {
    EXPECT_TRUE(found.contains(op)) << info(op).name;
  }
}

TEST(CodeMap, WithoutLinesNothingIsKnown) {
  const Program program = random_program(1);
  Diagnostics diagnostics;
  const auto object = compile_object(program, options_with(false), diagnostics);
  ASSERT_TRUE(object);
  const auto code = session()->load(*object, diagnostics);
  ASSERT_NE(code, nullptr);
  EXPECT_TRUE(CodeMap(*object, code->entry()).is_empty());
}

}  // namespace
}  // namespace nacre
