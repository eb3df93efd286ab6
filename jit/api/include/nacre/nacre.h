/* Nacre: MaterialX node graphs as native kernels over batches of shading points.
 *
 * The one interface of libnacre.so, in C99. <nacre/nacre.hpp> is the same for C++17.
 *
 * Conventions
 *  - A function that can fail returns a status and says why in the nacre_report it is given,
 *    which may be NULL. What it makes is written to its last argument, NULL where it failed.
 *  - Structures that a host fills in begin with their size, so that later versions can add to
 *    them, and mean by 0 or NULL what is usual:
 *    nacre_compile_options options = {.size = sizeof options};
 *  - Structures that are filled in for a host have a size that the host sets, too.
 *  - Text is UTF-8 with a 0 at its end. Text that is handed out lives as long as the object it
 *    was asked of, but a report's until it is cleared.
 *  - Objects are destroyed by their maker; NULL is ignored. What an object needs of others it
 *    keeps alive itself, so they may go in any order.
 *  - Everything may be used from any thread. An object that is being changed (a report, a binder,
 *    an instance's values) is used by one at a time.
 *  - The library never prints, exits or throws.
 */
#ifndef NACRE_NACRE_H
#define NACRE_NACRE_H

#include <nacre/channel.h>
#include <nacre/colors.h>
#include <nacre/document.h>
#include <nacre/fact.h>
#include <nacre/hooks.h>
#include <nacre/library.h>
#include <nacre/record.h>
#include <nacre/report.h>
#include <nacre/version.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* -- Systems: what documents share -------------------------------------------------------- */

typedef struct nacre_system_options {
  size_t size;
  /* Files or folders of nodedefs: the MaterialX data library, then node packs. None: the
     installed one, see nacre_data_library. */
  const char* const* libraries;
  size_t library_count;
  const char* ocio_config; /* An OpenColorIO configuration, for its colour spaces. */
  const char* cache;       /* Folder where compiled kernels are kept between runs. */
  int compile_threads;     /* 0: one a core. */
  int compile_apart;       /* 1: in processes of their own, so that a fault of LLVM's costs a kernel
                              its speed and not the host its life. */
  uint64_t texture_memory; /* Bytes of texels in memory. 0: 2 GiB. */
  /* Nodedefs of the libraries that the host implements (record.h), in place of whatever else does.
   */
  const nacre_body* bodies;
  size_t body_count;
  const nacre_colors* colors;    /* In place of ocio_config, or NULL. */
  int standard_texts;            /* 1: also the data library's own GLSL, for NACRE_TEXT. */
  uint64_t tile_memory;          /* Bytes of tiles of images that do not fit. 0: 256 MiB. */
  int max_image_size;            /* Of either side. 0: 16384, which is also the most. */
  uint64_t max_image_bytes;      /* Of decoded pixels. 0: 2 GiB. */
  uint64_t max_image_file_bytes; /* 0: 2 GiB. */
  int max_image_channels;        /* In the file. 0: 1024. */
  int max_image_layers;          /* Parts, pages or levels. 0: 1024. */
  uint64_t max_image_expansion;  /* Decoded bytes a byte of the file, of large ones. 0: 256. */
  uint64_t max_image_tiles;      /* Files that a name with <UDIM> stands for. 0: 10,000. */
  /* See hooks.h; each may be NULL. */
  const nacre_file_resolver* resolver; /* Of images; for includes see nacre_read_options. */
  const nacre_texture_system* textures;
  const nacre_executor* executor;
  const nacre_allocator* allocator;
} nacre_system_options;

NACRE_API nacre_status nacre_system_create(const nacre_system_options* options,
                                           nacre_report* report, nacre_system** system);
NACRE_API void nacre_system_destroy(nacre_system* system);

/* What a system's textures take, and have done since it was made. */
typedef struct nacre_texture_statistics {
  size_t size;
  uint64_t resident_bytes;      /* Of texels in memory, used or not. */
  uint64_t peak_resident_bytes; /* The most that there were at once. */
  uint64_t resident_textures;
  uint64_t tiled_textures; /* Those that did not fit, and are read by tiles. */
  uint64_t missing_textures;
  uint64_t loads;           /* Times an image was opened. */
  uint64_t hits;            /* Requests that found theirs loaded. */
  uint64_t evictions;       /* Unused ones dropped for room. */
  uint64_t replaced_texels; /* NaN and infinite samples, over all loads. */
  uint64_t read_failures;   /* Lookups of tiles that read 0 instead. */
} nacre_texture_statistics;

NACRE_API nacre_status nacre_system_texture_statistics(const nacre_system* system,
                                                       nacre_texture_statistics* statistics);
/* An image in memory by a name: documents that name it get it in place of a file. The pixels are
   copied. Set again, it is replaced in all shaders that have it, by an image of as many channels,
   which is kept in memory as the first one was; a batch that is running goes on with the old one.
 */
NACRE_API nacre_status nacre_system_set_image(nacre_system* system, const char* name,
                                              const nacre_image* image, nacre_report* report);
/* Shaders that have it keep it. */
NACRE_API void nacre_system_remove_image(nacre_system* system, const char* name);
/* Forgets all that no shader has. */
NACRE_API void nacre_system_drop_textures(nacre_system* system);

/* -- Shaders: compiled kernels ---------------------------------------------------------------- */

/* What is asked of a shader. NACRE_OUTPUTS is of nacre_compile_outputs, the others are of
   materials; each needs what its channels say. */
typedef enum nacre_entry {
  NACRE_OUTPUTS = 0,
  NACRE_BEGIN = 1,       /* Once a point: what depends on it alone, kept as the state. */
  NACRE_SAMPLE = 2,      /* State and u: a direction wi, its weight, pdf, lobe, flags. */
  NACRE_EVALUATE = 3,    /* State and wi: f, pdf. */
  NACRE_EVALUATE_AT = 4, /* The same for one point and many wi. */
  NACRE_ALBEDO = 5,
  NACRE_EMISSION = 6,
  NACRE_OPACITY = 7,
  NACRE_DISPLACEMENT = 8,
  NACRE_VOLUME = 9,
  NACRE_LIGHT = 10,
  NACRE_SHADE = 11,      /* Point, wi and u at once, without a state: f and pdf of wi; as "next.wi",
                            "next.weight", "next.pdf" the direction that u leads to. */
  NACRE_INTERIOR = 12,   /* What light that enters is in: eta over the outside; where there is a
                            medium its absorption and scattering per unit of length, anisotropy. */
  NACRE_SUBSURFACE = 13, /* What light is in below the surface; of_lobe: "lobe" of NACRE_SAMPLE:
                            absorption and scattering per unit of length, anisotropy; the albedo,
                            and the normal to leave about. Asked for, NACRE_EVALUATE leaves that
                            light out and NACRE_SAMPLE sends it there. */
  NACRE_SHADOW = 14,     /* Of light straight on through the point, unbent, presence *
                            opacity_color is held back. Smooth thin walls let light pass as
                            NACRE_SAMPLE does: a host that shades shadows by this counts such
                            light once. */
  NACRE_EMIT = 15,       /* Of a surface that shines, by u: a direction `emitted` that light leaves
                            along, on either side, its pdf, and as weight emission |cos emitted| /
                            pdf, by Ng. Reads no wo. Asked for, NACRE_EMISSION stores the pdf of wo
                            as well. Of a shader that has a back, what is on the other side than
                            its own is the other's: a host drops it. */
  NACRE_ENTRY_COUNT = 16
} nacre_entry;

/* Bits of the channel `flags` of NACRE_SAMPLE. */
enum {
  NACRE_SAMPLE_VALID = 1,        /* Else weight and densities are 0. */
  NACRE_SAMPLE_DELTA = 2,        /* pdf is a probability; NACRE_EVALUATE gives 0. */
  NACRE_SAMPLE_TRANSMISSION = 4, /* wi and wo are on different sides, by Ng. */
  /* Light goes on below the surface along wi, in the medium of NACRE_SUBSURFACE, and leaves where
     it meets the surface again, by the cosine to the normal. With NACRE_SAMPLE_DELTA. */
  NACRE_SAMPLE_SUBSURFACE = 8
};

/* What lobes are: the first four in nacre_compile_options::lobes and nacre_lobe_info::kinds; all in
   the channels `lobes_wanted` and `kinds`, where glossy is what is rough, and delta what is smooth
   and has finitely many directions. */
enum {
  NACRE_DIFFUSE_REFLECTION = 1,
  NACRE_GLOSSY_REFLECTION = 2,
  NACRE_DIFFUSE_TRANSMISSION = 4,
  NACRE_GLOSSY_TRANSMISSION = 8,
  NACRE_DELTA_REFLECTION = 16,
  NACRE_DELTA_TRANSMISSION = 32
};

/* What paths carry: the channel `transport`. */
enum {
  NACRE_RADIANCE = 0,  /* From the eye: refraction scales by the squares of the indices. */
  NACRE_IMPORTANCE = 1 /* From lights: shading normals ask for a correction. */
};

enum { NACRE_JIT = 0, NACRE_INTERPRETER = 1, NACRE_REFERENCE = 2 };
enum { NACRE_STANDARD = 0, NACRE_PRECISE = 1, NACRE_FAST = 2 };

/* Of facets, for light that is scattered between them several times, which their formulas leave
 * out. ALL: what does not absorb returns all light. REFLECTION: but for what transmits, rough glass
 * is darker. NOTHING: rough metals are darker, too, as many renderers have them. What is left out
 * costs nothing. */
enum { NACRE_COMPENSATE_ALL = 0, NACRE_COMPENSATE_REFLECTION = 1, NACRE_COMPENSATE_NOTHING = 2 };
enum { NACRE_FRONT = 0, NACRE_BACK = 1 };
enum { NACRE_BODY = 0, NACRE_GRAPH = 1, NACRE_TEXT = 2 };

/* Replaces "{name}" in the file names of images. */
typedef struct nacre_file_name_part {
  const char* name;
  const char* text;
} nacre_file_name_part;

typedef struct nacre_compile_options {
  size_t size;
  int engine;   /* NACRE_JIT: machine code. */
  int accuracy; /* NACRE_STANDARD */
  int lanes;    /* 1, 4, 8 or 16; 0: the widest that pays on this machine. */
  /* What may change without compiling: patterns of parameter paths ("SR_gold/base_color",
     "SR_gold/coat*", "*"), where * stands for any text and ? for a letter. All others are folded
     in. They may name inputs that the document leaves at their default. */
  const char* const* live;
  size_t live_count;
  /* Which of those, and of frame, time, object_to_world and world_to_object, come with each
     point, as channels of the slot's name. By their names and no pattern: "exterior_index", the
     index of refraction outside, which dielectrics' is divided by (without it vacuum's, 1), and
     "texture_u", a number in [0, 1) by which images give one of the texels that they filter. */
  const char* const* varying;
  size_t varying_count;
  int lobes;       /* Those that are modelled. 0: all. */
  int reverse_pdf; /* 1: NACRE_SAMPLE and NACRE_EVALUATE also store pdf_reverse. */
  int lobe_mask;   /* 1: a slot lobe_mask switches lobes off later. */
  int by_lobe;     /* 1: NACRE_SAMPLE, NACRE_EVALUATE and NACRE_SHADE also store the part of each
                      lobe: "f.lobe0", "weight.lobe0", ... */
  int min_alpha;   /* 1: a slot min_alpha raises the roughness of what is smoother, so that paths
                      behind rough bounces find no sharp lobes. NACRE_SAMPLE also stores `alpha`,
                      of the facets that were sampled: what is next on the path is at least as
                      rough. The slot may be `varying`. */
  /* Bits 1 << nacre_entry of those that are compiled, for rays that ask no more: a shadow ray needs
     NACRE_OPACITY. NACRE_BEGIN comes with what reads its state. 0: all but NACRE_EVALUATE_AT,
     NACRE_SHADE, NACRE_INTERIOR, NACRE_SUBSURFACE, NACRE_SHADOW and NACRE_EMIT. */
  uint32_t entries;
  /* What NACRE_BEGIN and NACRE_SHADE also store, so that nothing of a point is computed twice:
     "albedo", "emission", "opacity" (and transmission), "normal", "roughness", or a value of the
     graph by its path: "NG_marble/noise1", "NG_marble/separate1/outx", "SR_marble/base_color". */
  const char* const* with_begin;
  size_t with_begin_count;
  int side;           /* NACRE_BACK: what the back shows, see nacre_shader_has_back. */
  int background;     /* 1: return at once, and interpret until the code is there; the same bits. */
  int priority;       /* Of that: higher ones are compiled first. */
  double max_seconds; /* Of the call. 0: 60. */
  int max_anisotropy; /* Of footprints on images, at most 64. 0: 32. */
  int no_footprints;  /* 1: points have no extent: images are not filtered, and no channels as dPdx
                         are read. For rays of which nobody knows more. */
  const char* const* search_paths; /* Of images, after the document's own folder. */
  size_t search_path_count;
  int files_anywhere;      /* 1: images also from outside those folders. */
  int missing_images_pass; /* 1: an image that cannot be had is a warning and no error. */
  int lenient;             /* 1: take what other programs' exporters get wrong. */
  /* Of colours: the space that kernels compute in, NULL: what the document says, else lin_rec709;
     "none": nothing is converted. And the one that outputs are given in, NULL: the same. */
  const char* working_space;
  const char* output_space;
  const char* distance_unit; /* What one unit of scene length is. NULL: "meter". */
  /* What file names of images depend on. `geometry`: the full path of what is shaded, for its
     tokens; frame: of "{frame}", where has_frame is 1; `names`: values of other "{NAME}". */
  const char* geometry;
  int frame;
  int has_frame;
  const nacre_file_name_part* names;
  size_t name_count;
  /* Applied in order: where two set the same input, the last one counts. */
  const nacre_variant* variants;
  size_t variant_count;
  uint64_t max_nodes;        /* Of a graph, those within it too; more are an error. 0: 250,000. */
  uint64_t max_inputs;       /* Of a node; more are an error. 0: 1024. */
  uint64_t max_instructions; /* Of a kernel; more are an error. 0: 500,000. */
  uint64_t max_steps;        /* Of a pass of points through a kernel, roughly instructions: more are
                                NACRE_TOO_MANY_STEPS, or an error if known before. 0: 4,000,000. */
  const nacre_stop* stop;    /* NULL: never. */
  int prefer; /* Of several implementations of a nodedef: NACRE_BODY, NACRE_GRAPH, NACRE_TEXT. */
  int single_points;     /* 1: code for one point is made too, and taken by batches of one: the same
                            bits, at a fraction of the cost of a pass of many lanes. */
  int energy_conserving; /* 1: what the lobes give together is divided, in each channel, by what of
                            it exceeds the light that arrives: some models send back more. */
  int lobes_wanted; /* 1: NACRE_SAMPLE, NACRE_EVALUATE and NACRE_SHADE read a channel lobes_wanted:
                       bits of what shall scatter at that point. All else gives 0, and densities are
                       of what is wanted. They also store `kinds`: of what f or the sample is. */
  int transport; /* 1: they read a channel transport. Radiance is multiplied by (eta_o / eta_i)^2 at
                    refraction, importance by |wo.N wi.Ng| / |wo.Ng wi.N| (Veach 1997, 5.2, 5.3).
                    0: by neither. */
  int reserved;  /* Not read: what fills the structure that hosts of before were compiled with. */
  int live_footprints; /* 1: slots change footprints later, for rays behind a bounce that want less
                          of them: footprint_scale, 1 unless set, multiplies the changes along them,
                          as dPdx; at 0 points have no extent. max_anisotropy, an int, bounds that
                          of images from 1 to the one above, which it is unless set. */
  int compensation;    /* NACRE_COMPENSATE_ALL */
  const char* profile; /* What `nacre tune` wrote, the text: says accuracy, compensation,
                          max_anisotropy, fade_noise and whether points have footprints, in place of
                          the above, of materials and outputs that it names. NULL: none. */
  /* Greater than 0: the cheapest kernels whose numbers, but for one of a thousand, are off by no
     more than that, and each by no more than three times that, against double precision with
     everything exact. Found by measuring, which takes seconds, in place of what a profile says;
     nacre_shader_error and nacre_shader_profile tell what was found. Not with a profile. */
  double max_error;
  double error_floor;       /* Errors are shares of a number, or of so much of the largest number of
                               its channel where that is more. 0: 0.01. */
  int error_is_absolute;    /* 1: they are differences. */
  uint32_t error_points;    /* At how many points, 1,000 to 1,000,000. 0: 2048. */
  const char* error_record; /* What `nacre render --record-points` wrote, the text: of materials, to
                               measure where a scene shades them. NULL: at points of every kind. */
  int measure_error;        /* 1: nacre_shader_error is wanted of what is compiled as asked for. */
  const nacre_fact* facts;  /* Not of NACRE_REFERENCE. */
  size_t fact_count;
  int fade_noise;     /* 1: noise2d, noise3d and fractals fade where the footprint of a point covers
                         their cells; octaves of which nothing is left cost nothing. */
  int reserved_too;   /* As `reserved`. */
  int fit_parameters; /* 1: what depends on live parameters and one number is read from fits, made
                         when a call has new ones: each within 4e-5 (fast: 4e-3), or computed. */
} nacre_compile_options;

typedef struct nacre_shader nacre_shader;

NACRE_API nacre_status nacre_compile_material(nacre_system* system, const nacre_document* document,
                                              const char* material,
                                              const nacre_compile_options* options,
                                              nacre_report* report, nacre_shader** shader);
NACRE_API nacre_status nacre_compile_outputs(nacre_system* system, const nacre_document* document,
                                             const char* const* outputs, size_t output_count,
                                             const nacre_compile_options* options,
                                             nacre_report* report, nacre_shader** shader);
/* Several shaders of one material, for rays that ask different things of it (a camera's, a
   shadow's, those behind a bounce): each as nacre_compile_material makes it, with the same bits,
   but the graph is built once, and the kernels are made side by side. All options that say what the
   graph is (live, varying, with_begin, entries and how kernels are made do not) are the same in all
   of them; else NACRE_WRONG_ARGUMENTS. `shaders` gets `count` of them, or NULL `count` times. */
NACRE_API nacre_status nacre_compile_variants(nacre_system* system, const nacre_document* document,
                                              const char* material,
                                              const nacre_compile_options* const* variants,
                                              size_t count, nacre_report* report,
                                              nacre_shader** shaders);
NACRE_API void nacre_shader_destroy(nacre_shader* shader);
/* Says all that is wrong with a document: what has no errors compiles, every material and every
   output. `max_seconds` and others that say how kernels are made count as for compiling. */
NACRE_API nacre_status nacre_check(nacre_system* system, const nacre_document* document,
                                   const nacre_compile_options* options, nacre_report* report);

/* 1 if there is something to compute. A material that does not emit has no NACRE_EMISSION. */
NACRE_API int nacre_shader_has(const nacre_shader* shader, nacre_entry entry);
NACRE_API size_t nacre_shader_input_count(const nacre_shader* shader, nacre_entry entry);
NACRE_API nacre_status nacre_shader_input(const nacre_shader* shader, nacre_entry entry,
                                          size_t index, nacre_channel* channel);
NACRE_API size_t nacre_shader_result_count(const nacre_shader* shader, nacre_entry entry);
NACRE_API nacre_status nacre_shader_result(const nacre_shader* shader, nacre_entry entry,
                                           size_t index, nacre_channel* channel);
/* Numbers a point that NACRE_BEGIN stores and others read. */
NACRE_API size_t nacre_shader_state_count(const nacre_shader* shader);
/* 1 if the back shows another shader, to be compiled with NACRE_BACK and used where
   dot(Ng, wo) < 0. */
NACRE_API int nacre_shader_has_back(const nacre_shader* shader);
typedef struct nacre_lobe_info {
  size_t size;
  const char* name; /* Category of its node: "dielectric_bsdf". */
  const char* path; /* The node, "SR_gold/coat_bsdf": a label for light path expressions. */
  int kinds;        /* NACRE_DIFFUSE_REFLECTION and so on. */
} nacre_lobe_info;

/* The channel `lobe` counts in this order. */
NACRE_API size_t nacre_shader_lobe_count(const nacre_shader* shader);
NACRE_API nacre_status nacre_shader_lobe(const nacre_shader* shader, size_t index,
                                         nacre_lobe_info* info);
/* Lines that say what the kernels leave out; of those that change the picture `changes_picture`,
   which may be NULL, is 1. */
NACRE_API size_t nacre_shader_left_out_count(const nacre_shader* shader);
NACRE_API const char* nacre_shader_left_out(const nacre_shader* shader, size_t index,
                                            int* changes_picture);
/* nacre_compile_options::facts, in their order. */
NACRE_API size_t nacre_shader_fact_count(const nacre_shader* shader);
NACRE_API nacre_status nacre_shader_fact(const nacre_shader* shader, size_t index,
                                         nacre_fact_info* info);
/* Points so far that were computed as if nothing had been said, since facts were not true of them
   or of one beside them. */
NACRE_API uint64_t nacre_shader_points_outside_facts(const nacre_shader* shader);
/* How far a shader's numbers are from double precision with everything exact: f, albedo, emission,
   opacity and transmission, what media, displacement and lights are, or outputs. Measured at points
   by which nothing was chosen. */
typedef struct nacre_shader_error_info {
  size_t size;
  double mean;
  double p999; /* What one number of a thousand exceeds. */
  double maximum;
  const char* worst;  /* The channel of the maximum, "f.x". */
  double floor;       /* nacre_compile_options::error_floor */
  int is_absolute;    /* nacre_compile_options::error_is_absolute */
  const char* points; /* Where it was measured, for people. */
} nacre_shader_error_info;

/* NACRE_FAILED where neither max_error nor measure_error asked for it. */
NACRE_API nacre_status nacre_shader_error(const nacre_shader* shader,
                                          nacre_shader_error_info* info);
/* What max_error has chosen, for nacre_compile_options::profile of later runs, which need not
   measure again; NULL where it was not asked for. */
NACRE_API const char* nacre_shader_profile(const nacre_shader* shader);
/* 1 while code is made in the background and kernels are interpreted. */
NACRE_API int nacre_shader_is_pending(const nacre_shader* shader);
/* Withdraws what is pending: it stays interpreted. */
NACRE_API void nacre_shader_cancel(const nacre_shader* shader);
/* Calls once when nothing is pending: at once, or by a thread that compiles, which must not wait
   there for another. */
NACRE_API nacre_status nacre_shader_when_ready(const nacre_shader* shader, void (*call)(void* user),
                                               void* user);
/* Waits until nothing is pending. NACRE_FAILED, with the reasons, where an entry stays
   interpreted. */
NACRE_API nacre_status nacre_shader_wait(const nacre_shader* shader, nacre_report* report);

/* -- Parameters and instances --------------------------------------------------------------- */

/* What may change without compiling: values of the document, and frame, time and matrices where
   the graph reads them. */
typedef struct nacre_parameter {
  size_t size;
  const char* name; /* "SR_gold/base_color", "time" */
  const char* type; /* "color3", "matrix44" */
  int number_type;  /* NACRE_FLOAT, NACRE_INT or NACRE_BOOL. */
  int components;
  int is_varying;       /* 1: a channel of each point, not of an instance. */
  const void* value;    /* `components` numbers, as the document has them. */
  const void* minimum;  /* As many, or NULL: for a slider, no limit. */
  const void* maximum;  /* The same. */
  const char* label;    /* uiname, or "". */
  const char* folder;   /* uifolder, or "". */
  const char* unit;     /* Or "". */
  const char* document; /* What the nodedef says of it, or "". */
} nacre_parameter;

NACRE_API size_t nacre_shader_parameter_count(const nacre_shader* shader);
NACRE_API nacre_status nacre_shader_parameter(const nacre_shader* shader, size_t index,
                                              nacre_parameter* parameter);
/* The index of the one of that name, or SIZE_MAX. */
NACRE_API size_t nacre_shader_find_parameter(const nacre_shader* shader, const char* name);

/* The values of a shader's parameters: some hundred bytes, made in a microsecond. */
typedef struct nacre_instance nacre_instance;

/* With the document's values. */
NACRE_API nacre_status nacre_instance_create(const nacre_shader* shader, nacre_instance** instance);
NACRE_API void nacre_instance_destroy(nacre_instance* instance);
/* As many numbers of its number_type as the parameter has components. */
NACRE_API nacre_status nacre_instance_set(nacre_instance* instance, size_t parameter,
                                          const void* values);
NACRE_API nacre_status nacre_instance_get(const nacre_instance* instance, size_t parameter,
                                          void* values);

/* -- Binding: where a host has its numbers ---------------------------------------------------- */

/* Which element of an array belongs to the i-th point that is shaded. */
enum {
  NACRE_OF_POINT = 0,   /* Element points[i] of nacre_batch::points; i where there is no list. */
  NACRE_OF_PLACE = 1,   /* Element i: arrays that are as long as the list. Best for the state where
                           all entries are given the same list. */
  NACRE_OF_INSTANCE = 2 /* Element instances[points[i]], or instances[i]. */
};

/* Arrays of numbers that begin a multiple of 4096 bytes apart, as large ones do wherever a system
   allocates each of them, meet in the same sets of a processor's caches: shading takes up to 2.5
   times as long (bench/results/hosts.md, "a_page_apart"). 64 bytes more from one to the next are
   enough. */
typedef struct nacre_layout {
  size_t size;
  uint32_t array;             /* Which of nacre_batch::arrays. */
  int element;                /* NACRE_OF_POINT */
  ptrdiff_t offset;           /* Bytes from there to element 0. */
  ptrdiff_t stride;           /* Bytes from one element to the next; 0: one for all points. */
  ptrdiff_t component_stride; /* Bytes from x to y, and from one number of the state to the next. */
} nacre_layout;

/* What a host has, said once for all shaders: each takes what it needs. */
typedef struct nacre_binder nacre_binder;

NACRE_API nacre_status nacre_binder_create(nacre_binder** binder);
NACRE_API void nacre_binder_destroy(nacre_binder* binder);
/* Of a channel, "P.x", or a group, "P", "state". A channel's own counts before its group's. */
NACRE_API nacre_status nacre_binder_array(nacre_binder* binder, const char* name,
                                          const nacre_layout* layout);
/* The same four-byte numbers for all points, one a component; the others are 0. */
NACRE_API nacre_status nacre_binder_constant(nacre_binder* binder, const char* name,
                                             const void* values, size_t count);

typedef struct nacre_binding nacre_binding;

/* For all entries of a shader. NACRE_FAILED, with an error for each, where inputs have no place;
   results that have none are discarded. `entries`: bits 1 << nacre_entry of those that are wanted;
   0: all that there are. */
NACRE_API nacre_status nacre_binding_create(const nacre_binder* binder, const nacre_shader* shader,
                                            uint32_t entries, nacre_report* report,
                                            nacre_binding** binding);
NACRE_API void nacre_binding_destroy(nacre_binding* binding);

/* -- Running --------------------------------------------------------------------------------- */

typedef struct nacre_batch {
  size_t size;
  void* const* arrays; /* Where the arrays begin that layouts number. */
  size_t array_count;
  uint64_t count; /* Points to shade. */
  /* Which ones, `count` of them; NULL: the first. Picked fastest in ascending order. */
  const uint32_t* points;
  /* For every point of the arrays, the element of what is bound as NACRE_OF_INSTANCE. */
  const uint32_t* instances;
  /* Not 0: end within some milliseconds. May be written by any thread; NULL: never. */
  const volatile uint32_t* stop;
  /* Of NACRE_EVALUATE_AT: the element whose point the directions belong to; all else but wi and the
     results is read there. */
  uint32_t point;
} nacre_batch;

/* `instance` NULL: the document's values. An entry that the shader lacks computes nothing, and is
   NACRE_OK. Arrays that are read and written must not overlap. Touches no floating-point state of
   the caller's. */
NACRE_API nacre_status nacre_run(const nacre_binding* binding, nacre_entry entry,
                                 const nacre_instance* instance, const nacre_batch* batch);

#ifdef __cplusplus
}
#endif

#endif
