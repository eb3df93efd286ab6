// The bits that engines give on this CPU, as one SHA-256 for each engine: everywhere the same.
//
//   results LIBRARIES DOCUMENTS EXPECTED [RANDOM_PROGRAMS [WIDTH...]]
//
// Runs random Programs, outputs of documents and surfaces by the interpreter and by compiled code
// of these widths, or of all. Exit status 0 if every digest is the one that EXPECTED holds.
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "jit/document/read.h"
#include "jit/llvm/codegen.h"
#include "jit/llvm/session.h"
#include "jit/shading/shading_system.h"
#include "runtime/digest.h"
#include "runtime/interpreter/interpreter.h"
#include "tests/support/random.h"
#include "tests/support/random_program.h"

namespace {

using namespace nacre;

constexpr std::uint32_t points = 67;

/// Its x * x + x rounds up to the least normal number, 0x80800000. Where results below that
/// are flushed, x86 rounds first (Intel SDM vol. 1, 10.2.3.3) and QEMU, up to 10.0, does not.
constexpr std::uint64_t beyond_qemu = 2;

struct Subject {
  const char* file;
  const char* output;
};
constexpr Subject subjects[]{{"examples/documents/marble.mtlx", "NG_marble/base_color"},
                             {"examples/documents/cobbles.mtlx", "bumped"},
                             {"bench/documents/chain.mtlx", "NG_chain/out"}};

struct Material {
  const char* file;
  const char* name;
};
constexpr Material materials[]{{"bench/documents/standard_surface.mtlx", "standard_surface"},
                               {"tests/results/anisotropic.mtlx", "glass"},
                               {"tests/results/anisotropic.mtlx", "metal"}};

using Outputs = std::vector<std::vector<std::uint32_t>>;

void append(std::string& bytes, const Outputs& outputs) {
  for (const auto& channel : outputs) {
    bytes.append(reinterpret_cast<const char*>(channel.data()), 4 * channel.size());
  }
}

/// Numbers between -2 and 2 that hang on the name of a channel, not on its place in a list:
/// that is as the compiler of this program evaluates operands.
std::vector<float> numbers_of(const std::string& channel) {
  std::uint64_t seed = 20240611;
  for (const char c : channel) seed = 31 * seed + static_cast<unsigned char>(c);
  Random random(seed);
  std::vector<float> numbers(points);
  for (float& x : numbers) x = static_cast<float>(random.below(4096)) / 1024.0f - 2.0f;
  return numbers;
}

/// The same, but directions are unit and random numbers for sampling within [0, 1).
std::vector<std::uint32_t> values_of(const Channel& channel) {
  std::vector<float> numbers = numbers_of(channel.name);
  const std::string group = channel.name.substr(0, channel.name.find('.'));
  if (group == "u") {
    for (float& x : numbers) x = 0.25f * (x + 2.0f);
  }
  if (group == "wo" || group == "wi" || group == "N" || group == "Ng" || group == "T") {
    std::vector<double> squares(points, 0.0);
    for (const char* component : {".x", ".y", ".z"}) {
      const std::vector<float> other = numbers_of(group + component);
      for (std::size_t i = 0; i < points; ++i) squares[i] += double{other[i]} * double{other[i]};
    }
    for (std::size_t i = 0; i < points; ++i) {
      numbers[i] = static_cast<float>(double{numbers[i]} / std::sqrt(squares[i]));
    }
  }
  std::vector<std::uint32_t> values;
  for (const float x : numbers) values.push_back(std::bit_cast<std::uint32_t>(x));
  return values;
}

/// Programs of which each may read what those before it store.
using Chain = std::vector<Program>;
/// The kernel for a Program; null, with a diagnostic, if there is none.
using Make = std::function<std::shared_ptr<const Kernel>(const Program&)>;

/// All outputs but a material's state, whose numbers are no promise, by name. None if `make`
/// can't make a kernel.
Outputs run(const Chain& chain, const Make& make) {
  std::map<std::string, std::vector<std::uint32_t>> channels;
  std::map<std::string, std::vector<std::uint32_t>> results;
  for (const Program& program : chain) {
    const auto kernel = make(program);
    if (kernel == nullptr) return {};
    std::vector<const void*> in;
    for (const Channel& channel : program.inputs) {
      in.push_back(channels.try_emplace(channel.name, values_of(channel)).first->second.data());
    }
    std::vector<std::vector<std::uint32_t>> outputs(program.outputs.size(),
                                                    std::vector<std::uint32_t>(points));
    std::vector<void*> out;
    for (auto& output : outputs) out.push_back(output.data());
    std::vector<std::uint32_t> parameters;
    for (const ParameterSlot& slot : program.parameters) parameters.push_back(slot.value);
    kernel->run({.inputs = in.data(),
                 .outputs = out.data(),
                 .parameters = parameters.data(),
                 .textures = nullptr,
                 .texture_callback = nullptr,
                 .texture_user = nullptr,
                 .count = points});
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      const std::string& name = program.outputs[i].name;
      const bool is_state = name.starts_with("state.");
      if (is_state) {
        channels[name] = std::move(outputs[i]);
      } else {
        results[program.name + '/' + name] = std::move(outputs[i]);
      }
    }
  }
  Outputs all;
  for (const auto& [name, values] : results) all.push_back(values);
  return all;
}

/// The results of all Programs and chains by the kernels that `make` makes; "" with a
/// diagnostic if it can't make one.
std::string results(const std::vector<Program>& random_programs, const std::vector<Chain>& chains,
                    const Make& make) {
  std::vector<std::uint32_t> order(points);
  std::iota(order.begin(), order.end(), 0u);
  std::string bytes;
  for (std::size_t i = 0; i < random_programs.size(); ++i) {
    const auto kernel = make(random_programs[i]);
    if (kernel == nullptr) return {};
    append(bytes, RandomBatch(random_programs[i], i, order).run(*kernel, 0, points));
  }
  for (const Chain& chain : chains) {
    const Outputs outputs = run(chain, make);
    if (outputs.empty()) return {};
    append(bytes, outputs);
  }
  return to_hex(sha256(bytes));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4)
    return std::fputs("usage: results LIBRARIES SOURCE EXPECTED [COUNT [WIDTH...]]\n", stderr), 2;
  const std::string source = argv[2];
  std::string expected;
  std::ifstream(argv[3]) >> expected;
  const std::size_t count = argc > 4 ? std::strtoull(argv[4], nullptr, 10) : 8;
  std::vector<int> widths;
  for (int i = 5; i < argc; ++i) widths.push_back(std::atoi(argv[i]));
  if (widths.empty()) widths = {1, 4, 8, 16};

  Diagnostics diagnostics;
  const auto fail = [&] {
    std::fputs(diagnostics.to_string().c_str(), stderr);
    return 1;
  };
  std::vector<Program> programs;
  std::vector<Chain> chains;
  for (std::uint64_t seed = 0; programs.size() < count; ++seed) {
    if (seed != beyond_qemu) programs.push_back(random_program(seed));
  }
  const auto system = ShadingSystem::create({.libraries = {argv[1]}}, diagnostics);
  if (system == nullptr) return fail();
  ShaderOptions options;
  options.compile.backend = Backend::interpreter;
  for (const Subject& subject : subjects) {
    const auto document = read_document(source + '/' + subject.file, {}, diagnostics);
    if (document == nullptr) return fail();
    const auto made = system->compile_outputs(*document, {subject.output}, options, diagnostics);
    if (made == nullptr) return fail();
    chains.push_back({made->kernel.program()});
  }
  options.parameters = ParameterMode::live;
  for (const Material& material : materials) {
    const auto document = read_document(source + '/' + material.file, {}, diagnostics);
    if (document == nullptr) return fail();
    const auto made = system->compile_material(*document, material.name, options, diagnostics);
    if (made == nullptr) return fail();
    Chain& chain = chains.emplace_back();
    for (const auto* kernel : {&made->begin, &made->sample, &made->evaluate, &made->albedo}) {
      chain.push_back((*kernel)->program());
    }
  }

  const auto session = JitSession::create({}, diagnostics);
  if (session == nullptr) return fail();
  bool same = true;
  const auto report = [&](const std::string& engine, const std::string& found) {
    std::printf("%s %s\n", engine.c_str(), found.c_str());
    same = same && found == expected;
  };
  report("interpreter", results(programs, chains, [](const Program& program) {
           return std::shared_ptr<const Kernel>(make_interpreter(program));
         }));
  for (const int lanes : widths) {
    CodegenOptions code{.lanes = lanes};
    code.tier = Tier::quick;
    const auto make = [&](const Program& program) -> std::shared_ptr<const Kernel> {
      const auto object = compile_object(program, code, diagnostics);
      const auto loaded = object ? session->load(*object, diagnostics) : nullptr;
      return loaded == nullptr ? nullptr : make_jit_kernel(program, loaded, lanes);
    };
    report("W=" + std::to_string(lanes), results(programs, chains, make));
  }
  std::printf("%s: expected %s\n", Target::host().cpu.c_str(), expected.c_str());
  return same && !diagnostics.has_errors() ? 0 : fail();
}
