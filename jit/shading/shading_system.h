#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "jit/compile/options.h"
#include "jit/compile/stage_report.h"
#include "jit/document/file_resolver.h"
#include "jit/document/library.h"
#include "jit/graph/build/build.h"
#include "jit/record/record.h"
#include "jit/service/threads.h"
#include "jit/shading/bound_kernel.h"
#include "pbs/kernels.h"
#include "runtime/texture/texture_store.h"

/// A ShadingSystem makes kernels of documents or graphs, and programs of ours run them. Hosts have
/// the same by jit/api/include/nacre.
namespace nacre {

/// A node implemented by the host: `record` reads the inputs of the call and
/// sets its outputs by recording, as the bodies in nodes/ do.
struct HostBody {
  std::string nodedef;  ///< "ND_my_noise_float", declared by one of the libraries.
  /// Called for each such node that is recorded, by any thread that compiles.
  std::function<void(NodeCall& call)> record;
};

/// What a ShadingSystem is made of.
struct SystemOptions {
  /// The MaterialX data library first, then node packs: files or folders.
  std::vector<std::filesystem::path> libraries;
  /// Used in place of whatever else implements those nodedefs.
  std::vector<HostBody> bodies = {};
  /// Read the data library's own GLSL too, so that GraphOptions::prefer can ask for
  /// it. Node packs' texts are always read.
  bool standard_texts = false;
  /// An OpenColorIO configuration, whose colour spaces documents may name (see
  /// load_ocio_config); empty: none. GraphOptions::colors counts before this.
  std::filesystem::path ocio_config = {};
  /// Colour spaces of the host's own, in place of a configuration; null: none.
  std::shared_ptr<const ColorConfig> colors = nullptr;
  TextureOptions textures = {};  ///< Limits of the one store that all kernels share.
  FileResolver resolver = {};    ///< Asked for images before they are looked for; null: none.
  /// Where compiled kernels are kept between runs; empty: nowhere.
  std::filesystem::path cache = {};
  int compile_threads = 0;  ///< 0: one a core.
  /// Runs what compiles, in place of threads of ours. Its threads need stacks of 16 MiB, or
  /// `compile_apart`; calls that compile wait for it, so they are not made by the last of them.
  std::shared_ptr<Executor> executor = nullptr;
  /// Compile in processes of their own, so that a fault of LLVM's (a crash, a hang, no
  /// memory) costs a kernel its speed and not the host its life; with a warning if there is
  /// no nacre-compile-worker.
  bool compile_apart = false;
};

/// Which side of a surface; the front is where the geometric normal points.
enum class Side { front, back };

/// How a material or outputs are compiled.
struct ShaderOptions {
  CompileOptions compile;                            ///< Engine, accuracy and limits.
  ParameterMode parameters = ParameterMode::frozen;  ///< Whether values may change later.
  /// Patterns of the paths of parameters that are live in any case, those included that the
  /// document leaves at their default: `*` stands for any text, `?` for one letter.
  std::vector<std::string> live;
  /// Patterns of slots (parameters that are live by then, "time", "object_to_world") that
  /// every point brings along: input channels of the same name, in place of slots. The name
  /// "exterior_index", and no pattern, makes dielectrics read that channel (pbs/exterior.h), and
  /// "texture_u" has look-ups of images draw one texel by it (runtime/node/drawn_texels.h): but for
  /// displacement, media and light shaders, for derivatives of what is looked up, and of images in
  /// tiles that are not resident. Limits count the whole filter as well.
  std::vector<std::string> varying;
  KernelRequest kernels;  ///< Of a material: which, and of what lobes.
  /// `is_native` and `stop` (that of `compile`) are filled in, and `colors` where it is null.
  GraphOptions graph;
  /// See RecordOptions.
  /// @{
  bool lazy = true;
  bool holds_lobes = true;
  /// @}
  /// Of footprints on images, 1 .. largest_anisotropy; see runtime/texture/sampling.h.
  int max_anisotropy = default_anisotropy;
  /// Whether images are filtered and derivatives taken by how channels change from sample to
  /// sample. False: points have no extent, and no such channels are read.
  bool footprints = true;
  /// Slots "footprint_scale" and "max_anisotropy", which change footprints later (see
  /// jit/passes/scale_footprints.h, runtime/node/live_anisotropy.h). Not where there are none.
  bool live_footprints = false;
  /// noise2d, noise3d and fractals fade where the footprint covers their cells, and octaves of
  /// which nothing is left are not computed: what is too small to be seen neither costs nor
  /// flickers. Without footprints nothing fades.
  bool fade_noise = false;
  /// What depends on live parameters of the document and one bounded number is read from
  /// polynomials that are fitted to their values (jit/passes/tabulate/fit_parameters.h). Bits are
  /// others then than of parameters that come with each point.
  bool fit_parameters = false;
  Side side = Side::front;  ///< Of a material; see MaterialKernels::has_back.
  /// Folders, beside the document's own, in which image files are looked for.
  std::vector<std::filesystem::path> search_paths;
  /// The images that a document names must lie below the folder of its main file, a search
  /// path or a library's folder, whatever ".." and symbolic links say, as its includes
  /// must (ReadOptions::includes_anywhere). True lifts that. A Graph that was made without
  /// a document names what its maker wants.
  bool files_anywhere = false;
  /// Whether an image that cannot be had is an error or a warning. The kernels are made in
  /// both cases, so that a host that shows pictures can go on showing them.
  MissingImages missing_images = MissingImages::error;
  /// Tiles of sets (<UDIM>, <UVTILE>) are not loaded with the kernel, which has black ones until
  /// BoundKernel::within loads those that are needed.
  bool defer_tiles = false;
};

/// Outputs of node graphs as one kernel: channel "<name>", or "<name>.x" ... for
/// types of several components, in the order asked for. A medium, displacement or light
/// has several channels, which follow the name and a dot:
///
///   VDF                 absorption.x .y .z, scattering.x .y .z, anisotropy
///   volumeshader        the same, and emission.x .y .z per unit of length, towards wo
///   displacementshader  offset.x .y .z, world space
///   lightshader         intensity.x .y .z; but for `light` direction.x .y .z; and
///                       distance, unless it is infinitely far away
struct OutputKernel {
  /// One of the outputs, and where its channels stand.
  struct Output {
    std::string name;               ///< "NG_marble/out"
    Type type = Type::none;         ///< Numeric, a medium, a displacement or a light.
    std::size_t first_channel = 0;  ///< In Program::outputs.
    std::size_t channels = 0;       ///< component_count(type) of a numeric type.
    SourceLocation where = {};      ///< Of the node that it is of.
  };
  BoundKernel kernel;                 ///< All outputs at once.
  std::vector<Output> outputs;        ///< In the order asked for.
  std::vector<Parameter> parameters;  ///< Those that are live.
  std::vector<FactUse> facts;         ///< CompileOptions::facts, in order.
  std::vector<StageReport> stages;    ///< Of all that was done, in order.
};

/// True for types that an output may have to be a kernel by itself: numbers, media,
/// displacements and lights. Others, as BSDF or string, are parts of kernels, and
/// compile_outputs refuses them ("not-numeric").
bool has_kernel(Type type);

/// The kernels of one material; see SurfaceKernels for the channels of its surface and
/// OutputKernel for the others. A kernel that has nothing to compute is absent; a
/// volumematerial has `volume` alone, a lightmaterial `light`, a surfacematerial without a
/// surface shader `displacement`.
struct MaterialKernels {
  bool has_surface = true;  ///< The material has a surface shader.
  bool has_light = false;   ///< It has a light shader: dark, where `light` is absent.
  bool has_volume = false;  ///< It has a volume shader: empty space, where `volume` is absent.
  /// The back shows another shader: to be compiled with ShaderOptions::side and used
  /// where dot(Ng, wo) < 0. Else these kernels are those of both sides (MaterialX PBS 1.39,
  /// "Surfaces").
  bool has_back = false;
  /// Stores the state channels "state.<k>" that sample and evaluate read.
  std::optional<BoundKernel> begin;  ///< Absent too where nothing needs a state.
  /// One question about the point each; SurfaceKernels lists what they read and store.
  /// @{
  std::optional<BoundKernel> sample, evaluate, albedo, emission, opacity;
  /// @}
  /// Only if requested: evaluate for one point and n directions. Its inputs are
  /// wi.*; every other channel of evaluate, state and geometry, is a slot of the
  /// parameter block under the channel's name, for the host to fill from the point.
  std::optional<BoundKernel> evaluate_at;
  std::vector<Channel> of_point;  ///< Those channels of evaluate that are its slots.
  /// Only if requested: all of a point at once, without a state. Reads what `begin` reads, wi and
  /// u; stores f and pdf of wi, "next.wi", "next.weight", "next.pdf", lobe and flags of the
  /// direction that u leads to, and what KernelRequest::with_begin names.
  std::optional<BoundKernel> shade;
  /// Channels as of the types displacementshader, volumeshader and lightshader in OutputKernel.
  /// @{
  std::optional<BoundKernel> displacement, volume, light;
  /// @}
  /// What `displacement` computes as it was recorded, before any pass: what is known of its results
  /// (jit/passes/range.h) is less of what passes make of it. Null where that is absent.
  std::shared_ptr<const Program> recorded_displacement;
  /// Only if requested: what the surface encloses, see SurfaceKernels. Then the manifest does not
  /// say that its medium is left out.
  std::optional<BoundKernel> interior;
  /// Only if requested: where light that goes below the surface is; likewise.
  std::optional<BoundKernel> subsurface;
  /// Only if requested: what a straight ray loses, see SurfaceKernels.
  std::optional<BoundKernel> shadow;
  /// Only if requested: a direction that light leaves along, see SurfaceKernels.
  std::optional<BoundKernel> emit;
  /// Numbers k of the state channels, ascending: the host gives each an array.
  std::vector<std::uint32_t> state;
  std::vector<LobeInfo> lobes;        ///< The channel `lobe` of sample counts in this order.
  std::vector<std::string> manifest;  ///< What was left out, and why.
  /// Those lines of it that a renderer would have to do itself, for the picture lacks them.
  std::vector<std::string> not_modelled;
  std::vector<Parameter> parameters;  ///< Those that are live; each kernel has slots of some.
  std::vector<FactUse> facts;         ///< CompileOptions::facts, in order, for all kernels.
  std::vector<StageReport> stages;    ///< Of all kernels, one after another.
};

struct SystemParts;

/// Everything that documents share: the data library, native bodies, textures
/// and the compiler. All members may be called from any thread.
class ShadingSystem {
 public:
  /// Null, with diagnostics, if the library or the colour configuration cannot be read.
  static std::unique_ptr<ShadingSystem> create(const SystemOptions& options,
                                               Diagnostics& diagnostics);
  ~ShadingSystem();
  ShadingSystem(const ShadingSystem&) = delete;
  ShadingSystem& operator=(const ShadingSystem&) = delete;

  /// The data library and node packs of SystemOptions::libraries.
  const Library& library() const;
  /// What to give build_graph or GraphBuilder for a Graph meant for this system.
  GraphOptions graph_options(const ShaderOptions& options) const;
  /// The images of all kernels, for statistics and to drop unused ones.
  TextureStore& textures();

  /// Graph outputs as build_graph names them, all in one kernel.
  std::unique_ptr<OutputKernel> compile_outputs(const Document& document,
                                                const std::vector<std::string>& outputs,
                                                const ShaderOptions& options,
                                                Diagnostics& diagnostics);

  /// A material node, or an output that leads to one.
  std::unique_ptr<MaterialKernels> compile_material(const Document& document,
                                                    const std::string& material,
                                                    const ShaderOptions& options,
                                                    Diagnostics& diagnostics);

  /// Several sets of kernels of one material, for rays that ask different things of it: each as
  /// compile_material would make it, to the bit, but the graph is built once, by
  /// ShaderOptions::graph of the first, and the kernels are made side by side. None, after an
  /// error, where one of them could not be made. Diagnostics that several have are said once.
  std::vector<std::unique_ptr<MaterialKernels>> compile_variants(
      const Document& document, const std::string& material,
      std::span<const ShaderOptions> variants, Diagnostics& diagnostics);

  /// All diagnostics of a document. What has none compiles without any: every output
  /// that `has_kernel` and every material is recorded as for compiling, and goes through
  /// every stage but the last, machine code.
  void check(const Document& document, const ShaderOptions& options, Diagnostics& diagnostics);

  /// The same from a Graph that no document was needed for: all its outputs.
  std::unique_ptr<OutputKernel> compile_outputs(const Graph& graph, const ShaderOptions& options,
                                                Diagnostics& diagnostics);
  /// The same from a Graph whose outputs are shaders, named as GraphRequest::material has them.
  std::unique_ptr<MaterialKernels> compile_material(const Graph& graph,
                                                    const ShaderOptions& options,
                                                    Diagnostics& diagnostics);

 private:
  explicit ShadingSystem(std::unique_ptr<SystemParts> parts);

  std::unique_ptr<SystemParts> parts_;
};

}  // namespace nacre
