// Documents spliced from the project's own, each read, checked, compiled and run, with a
// budget of time and memory for each. Processes of their own do it, so that one that dies,
// or has to be ended, is kept and the rest go on.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>

#include "jit/document/read.h"
#include "tests/fuzz/host.h"
#include "tests/fuzz/minimize.h"
#include "tests/fuzz/splice.h"
#include "tests/fuzz/workers.h"

namespace {

using namespace nacre;

constexpr const char* usage =
    "usage: mutants [--count N] [--from N] [--jobs N] [--jit N] [--agreeing] [--keep FOLDER]\n"
    "       mutants --print N\n"
    "       mutants --minimize FILE [--agreeing]\n"
    "       mutants [--agreeing] FILE...\n"
    "\n"
    "Runs documents number FROM and on; what fails is kept in FOLDER (kept-mutants) with\n"
    "what was said. One in N (--jit, default 97, 0: none) goes through LLVM, the others through "
    "the\n"
    "interpreter. --agreeing: what checking finds nothing wrong with must compile. --print shows\n"
    "a document; --minimize leaves out of one what is not needed to fail alike, and prints the\n"
    "rest. FILEs are run in this process instead.\n";

struct Arguments {
  std::uint64_t count = 300;
  std::uint64_t from = 0;
  int jobs = 1;
  std::uint64_t jit = 97;
  bool agreeing = false;
  std::string keep = "kept-mutants";
  long long print = -1;
  std::string minimize;
  std::vector<std::string> files;
};

bool read_arguments(int argc, char** argv, Arguments& arguments) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--agreeing") {
      arguments.agreeing = true;
    } else if (word.substr(0, 2) != "--") {
      arguments.files.push_back(word);
    } else if (++i == argc) {
      return false;
    } else if (word == "--count") {
      arguments.count = std::strtoull(argv[i], nullptr, 10);
    } else if (word == "--from") {
      arguments.from = std::strtoull(argv[i], nullptr, 10);
    } else if (word == "--jobs") {
      arguments.jobs = std::max(1, std::atoi(argv[i]));
    } else if (word == "--jit") {
      arguments.jit = std::strtoull(argv[i], nullptr, 10);
    } else if (word == "--keep") {
      arguments.keep = argv[i];
    } else if (word == "--minimize") {
      arguments.minimize = argv[i];
    } else if (word == "--print") {
      arguments.print = std::atoll(argv[i]);
    } else {
      return false;
    }
  }
  return true;
}

fuzz::Result run(const std::string& text, const std::string& file, std::uint64_t number,
                 const Arguments& arguments) {
  fuzz::Result result;
  ShaderOptions options = fuzz::shader_options();
  if (arguments.jit != 0 && number % arguments.jit == arguments.jit - 1) {
    options.compile.backend = Backend::jit;
  }
  if (number % 5 == 4) options.parameters = ParameterMode::live;
  if (number % 7 == 6) options.graph.prefer = Preference::graph;
  options.graph.lenient = number % 3 == 2;
  Diagnostics diagnostics;
  const auto document = read_document_text(text, file, fuzz::read_options(), diagnostics);
  if ((document == nullptr) != diagnostics.has_errors()) {
    fuzz::fail("a document is refused without a reason, or read with an error");
  }
  if (document == nullptr) return result;
  const fuzz::Shaded shaded = fuzz::shade_everything(*document, options, arguments.agreeing);
  result.read = 1;
  result.clean = shaded.clean ? 1 : 0;
  result.ran = shaded.kernels > 0 ? 1 : 0;
  return result;
}

std::string contents(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

int run_files(const Arguments& arguments) {
  for (const std::string& file : arguments.files) {
    const std::string text = contents(file);
    const fuzz::Result result = run(text, file, 0, arguments);
    if (result.clean == 0) {
      Diagnostics diagnostics;
      const auto document = read_document_text(text, file, fuzz::read_options(), diagnostics);
      if (document != nullptr) fuzz::host().check(*document, fuzz::shader_options(), diagnostics);
      std::fputs(diagnostics.to_string().c_str(), stderr);
    }
    std::printf("%s:%s%s%s\n", file.c_str(), result.read != 0 ? " read" : " refused",
                result.clean != 0 ? ", clean" : "", result.ran != 0 ? ", run" : "");
    std::fflush(stdout);
  }
  return 0;
}

int minimize_file(const Arguments& arguments) {
  const auto tree = fuzz::read_tree(contents(arguments.minimize));
  if (!tree) return std::fputs("not XML\n", stderr), 2;
  fuzz::host();  // once, for all that follow
  const auto ending = [&](const fuzz::Tree& one) {
    return fuzz::ending([&] { run(fuzz::write_tree(one), arguments.minimize, 0, arguments); });
  };
  const std::string whole = ending(*tree);
  if (whole.empty()) return std::fputs("it does not fail\n", stderr), 1;
  const fuzz::Tree small =
      fuzz::minimize(*tree, [&](const fuzz::Tree& one) { return ending(one) == whole; });
  std::printf("%s<!-- %s -->\n", fuzz::write_tree(small).c_str(), whole.c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  if (!read_arguments(argc, argv, arguments)) {
    std::fputs(usage, stderr);
    return 2;
  }
  if (!arguments.files.empty()) return run_files(arguments);
  if (!arguments.minimize.empty()) return minimize_file(arguments);
  const fuzz::Splicer& splicer = fuzz::project_splicer();
  if (arguments.print >= 0) {
    const fuzz::Mutant mutant = splicer.mutant(static_cast<std::uint64_t>(arguments.print));
    std::printf("<!-- %s -->\n%s", mutant.file.c_str(), mutant.text.c_str());
    return 0;
  }
  fuzz::Work work;
  work.first = arguments.from;
  work.count = arguments.count;
  work.jobs = arguments.jobs;
  work.keep = arguments.keep;
  work.prepare = [] { fuzz::host(); };
  work.run = [&](std::uint64_t number) {
    const fuzz::Mutant mutant = splicer.mutant(number);
    return run(mutant.text, mutant.file.string(), number, arguments);
  };
  work.text = [&](std::uint64_t number) { return splicer.mutant(number).text; };
  const fuzz::Totals totals = fuzz::run_work(work);
  std::printf("%llu documents: %llu read, %llu clean, %llu run, %llu failed\n",
              static_cast<unsigned long long>(arguments.count),
              static_cast<unsigned long long>(totals.sum.read),
              static_cast<unsigned long long>(totals.sum.clean),
              static_cast<unsigned long long>(totals.sum.ran),
              static_cast<unsigned long long>(totals.failed));
  // A splicer whose documents are all refused at the door would find nothing.
  const bool weak = arguments.count >= 200 && totals.sum.ran * 5 < arguments.count;
  if (weak) std::puts("Too few of them ran to mean anything.");
  return totals.failed != 0 || weak ? 1 : 0;
}
