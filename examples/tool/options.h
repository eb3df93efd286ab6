#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "examples/tool/report.h"
#include "jit/document/document.h"
#include "jit/document/read.h"
#include "jit/shading/shading_system.h"
#include "jit/tune/profile.h"
#include "jit/worker/compiler.h"

namespace CLI {
class App;
}

namespace nacre::tool {

/// Exit statuses of every subcommand.
enum Status : int { status_ok = 0, status_problems = 1, status_usage = 2 };

/// What the subcommands share: the document, where things are found, and how
/// kernels are made.
struct CommonOptions {
  std::string file;
  std::vector<std::string> libraries;  ///< Node packs beside the data library.
  std::vector<std::string> search_paths;
  bool allow_outside = false;  ///< Files that the document names may lie anywhere.
  MissingImages missing_images = MissingImages::error;
  std::string accuracy = "standard";
  std::string profile;  ///< A file that `nacre tune` wrote; then that says the accuracy.
  Compensation compensation = Compensation::all;
  std::vector<Fact> facts;
  std::string backend = "jit";
  std::optional<std::string> working_space;
  std::string ocio;  ///< A file, or "env".
  int lanes = 0;
  int anisotropy = default_anisotropy;
  bool fade_noise = false;
  int threads = 0;
  bool no_cache = false;
  bool compile_here = false;
  bool begins_at_once = false;  ///< Rather than when all is compiled.
  std::string cache;
  bool strict = false;
  bool quiet = false;
  /// What a document, its graphs and its images may cost.
  ReadLimits read_limits;
  GraphOptions graph_limits;
  CompileOptions compile_limits;
  TextureOptions texture_limits;

  void add_document(CLI::App& command);
  /// add_exactness() and add_machine().
  void add_compile(CLI::App& command);
  /// How exact kernels are, and what runs them.
  void add_exactness(CLI::App& command);
  /// Where and how they are made, whatever they are.
  void add_machine(CLI::App& command);
  /// After add_compile() and add_lobes(), whose choices a profile makes.
  void add_profile(CLI::App& command);
  void add_lobes(CLI::App& command);
  /// For what can begin before all is compiled: it is interpreted until then.
  void add_waiting(CLI::App& command);

  Accuracy parsed_accuracy() const;
  Backend parsed_backend() const;
  ShaderOptions shader_options() const;
  ReadOptions read_options() const;
  /// What makes code for one who measures it: apart, as kernels are, unless asked otherwise.
  std::unique_ptr<Compiler> compiler() const;

 private:
  void add_limits(CLI::App& command);
};

/// A document with the system that compiles it. Empty pointers after an error.
struct Opened {
  std::unique_ptr<ShadingSystem> system;
  std::unique_ptr<Document> document;
  std::optional<Profile> profile;  ///< Of --profile.
  explicit operator bool() const { return system != nullptr && document != nullptr; }
};
Opened open(const CommonOptions& options, Diagnostics& diagnostics);

/// The file that --ocio names, "" for none. Nothing, with an error, where the environment is asked
/// and names no file.
std::optional<std::filesystem::path> ocio_config(const std::string& option,
                                                 Diagnostics& diagnostics);

/// The system alone, for who has a document in memory; null after an error. `resolver` is asked for
/// images before their folders are looked in.
Opened open_system(const CommonOptions& options, const FileResolver& resolver,
                   Diagnostics& diagnostics);

/// How a material, or else an output, is compiled: as the profile says, if there is one. One that
/// says nothing of it is warned of.
ShaderOptions with_profile(const Opened& opened, const std::string& name, bool is_material,
                           ShaderOptions options, Diagnostics& diagnostics);

/// With the same bytes whenever and however fast code is there: where the interpreter's bits are
/// others, as in `fast`, nothing is interpreted meanwhile.
ShaderOptions reproducible(ShaderOptions options);

/// Whether all that was made is right since there were so many errors: that there are no more,
/// and that all texels of images could be read.
bool is_sound(ShadingSystem& system, std::size_t errors, const Diagnostics& diagnostics);

/// Says what was taken for 0 in images that could be had: numbers that are none, and what
/// could no longer be read while it was looked up.
void report_texels(ShadingSystem& system, Diagnostics& diagnostics);

/// Adds what is to be said of code that was made while the kernel was used.
void report_code(const BoundKernel& kernel, const ShaderOptions& options, Diagnostics& diagnostics);

/// One line on standard error that is rewritten as work goes on; silent when
/// that is no terminal or `quiet`.
class ProgressLine {
 public:
  ProgressLine(std::string title, bool quiet);
  ~ProgressLine();
  void update(double share);

 private:
  std::string title_;
  bool active_;
  int shown_ = -1;
};

/// Each adds its subcommand; running it sets `status`.
void add_bake(CLI::App& app, int& status);
void add_check(CLI::App& app, int& status);
void add_convert(CLI::App& app, int& status);
void add_inspect(CLI::App& app, int& status);
void add_render(CLI::App& app, int& status);
void add_tune(CLI::App& app, int& status);

}  // namespace nacre::tool
