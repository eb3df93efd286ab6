#include <elf.h>
#include <fmt/format.h>
#include <link.h>
#include <llvm-c/Core.h>

#include <cstring>
#include <string>

#include "jit/llvm/codegen.h"
#include "runtime/program/digest.h"

namespace nacre {

namespace {

/// To be raised when what kernels do or expect changes and no build id tells.
constexpr int version = 4;

/// The object file that is loaded at an address, and the id its linker gave it.
struct BuildId {
  std::uintptr_t address;
  std::string id;
};

/// Reads the notes of a program header (System V ABI, "Note Section").
std::string find_build_id(const char* notes, std::size_t size) {
  const auto padded = [](std::size_t bytes) { return (bytes + 3) / 4 * 4; };
  std::string id;
  while (size >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) note;
    std::memcpy(&note, notes, sizeof note);
    const std::size_t whole = sizeof note + padded(note.n_namesz) + padded(note.n_descsz);
    if (whole > size) break;
    if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == 4 &&
        std::memcmp(notes + sizeof note, "GNU", 4) == 0) {
      const char* bytes = notes + sizeof note + 4;
      for (std::size_t k = 0; k < note.n_descsz; ++k) {
        id += fmt::format("{:02x}", static_cast<unsigned char>(bytes[k]));
      }
    }
    notes += whole;
    size -= whole;
  }
  return id;
}

int visit(dl_phdr_info* object, std::size_t, void* data) {
  auto& wanted = *static_cast<BuildId*>(data);
  bool holds_address = false;
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& header = object->dlpi_phdr[i];
    const std::uintptr_t start = object->dlpi_addr + header.p_vaddr;
    if (header.p_type == PT_LOAD && wanted.address >= start &&
        wanted.address < start + header.p_memsz) {
      holds_address = true;
    }
  }
  if (!holds_address) return 0;
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& header = object->dlpi_phdr[i];
    if (header.p_type != PT_NOTE) continue;
    const auto* notes = reinterpret_cast<const char*>(object->dlpi_addr + header.p_vaddr);
    const std::string id = find_build_id(notes, header.p_memsz);
    if (!id.empty()) wanted.id = id;
  }
  return 1;
}

/// Of the library or program that this code was linked into.
const std::string& build_id() {
  static const std::string id = [] {
    BuildId wanted{reinterpret_cast<std::uintptr_t>(&visit), "none"};
    dl_iterate_phdr(&visit, &wanted);
    return wanted.id;
  }();
  return id;
}

std::string llvm_version() {
  unsigned major = 0;
  unsigned minor = 0;
  unsigned patch = 0;
  LLVMGetVersion(&major, &minor, &patch);
  return fmt::format("{}.{}.{}", major, minor, patch);
}

}  // namespace

std::string code_version() {
  return fmt::format("nacre kernel {} of {} operations, llvm {}", version, op_count,
                     llvm_version());
}

std::string code_key(const Program& program, const CodegenOptions& options, std::string_view then) {
  // The name last: it may be any text.
  return fmt::format("{} build {}\n{}\n{} steps {}\n{}\n{}", code_version(), build_id(),
                     to_hex(code_digest(program)), options.key(), options.max_steps, then,
                     program.name);
}

}  // namespace nacre
