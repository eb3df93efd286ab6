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

#include <nacre/record.h>
#include <nacre/version.h>
#include <stddef.h>
#include <stdint.h>

#define NACRE_API __attribute__((visibility("default")))

#ifdef __cplusplus
extern "C" {
#endif

/* -- Status and version ----------------------------------------------------------------- */

typedef int nacre_status;
enum {
  NACRE_OK = 0,
  NACRE_FAILED = 1,          /* The report says why. */
  NACRE_WRONG_ARGUMENTS = 2, /* A call that cannot be meant: an object that is NULL, a size of 0,
                                fewer arrays than were bound. Nothing was done. */
  NACRE_OUT_OF_MEMORY = 3,
  NACRE_STOPPED = 4,       /* nacre_batch::stop was not 0. The outputs hold anything. */
  NACRE_TOO_MANY_STEPS = 5 /* A loop of the document does not end. The outputs hold anything. */
};

/* NACRE_VERSION of the library that is running. */
NACRE_API uint32_t nacre_version(void);
/* "0.1.0" */
NACRE_API const char* nacre_version_text(void);
/* The folder of the MaterialX data library that was installed with libnacre.so; "" if it is not
   there. The environment variable NACRE_MATERIALX_LIBRARIES counts before it. */
NACRE_API const char* nacre_data_library(void);

/* -- Reports: what there is to say ------------------------------------------------------- */

typedef struct nacre_report nacre_report;

enum { NACRE_NOTE = 0, NACRE_WARNING = 1, NACRE_ERROR = 2 };

typedef struct nacre_diagnostic {
  size_t size;
  int severity;         /* NACRE_ERROR: something is not there, or not right. */
  const char* code;     /* Stable, "unknown-node". */
  const char* file;     /* "" where no place is known. */
  int line;             /* 1-based; 0: unknown. */
  int column;           /* 1-based; 0: unknown. */
  const char* path;     /* Of the element: "NG_marble/mix1/fg". */
  const char* message;  /* One sentence. */
  const char* expected; /* What would have been right; may be "". */
  const char* found;    /* What was there; may be "". */
  const char* text;     /* All of it in one printable line. */
} nacre_diagnostic;

NACRE_API nacre_status nacre_report_create(nacre_report** report);
NACRE_API void nacre_report_destroy(nacre_report* report);
/* How many there are to get. */
NACRE_API size_t nacre_report_count(const nacre_report* report);
/* Errors of all that was said, those included that a long report no longer has. */
NACRE_API size_t nacre_report_error_count(const nacre_report* report);
NACRE_API nacre_status nacre_report_get(const nacre_report* report, size_t index,
                                        nacre_diagnostic* diagnostic);
NACRE_API void nacre_report_clear(nacre_report* report);

/* -- Channels: what kernels read and store ------------------------------------------------ */

/* Of a channel's numbers, four bytes each: float, int32, or int32 that is 0 or 1. */
enum { NACRE_FLOAT = 0, NACRE_INT = 1, NACRE_BOOL = 2 };

/* Who gives a channel its numbers. */
enum {
  NACRE_POINT = 0,     /* The host, of the shading point. */
  NACRE_DIRECTION = 1, /* The host, of what it asks about the point: wi, u. */
  NACRE_STATE = 2,     /* NACRE_BEGIN, for the other entries of a material. */
  NACRE_RESULT = 3,    /* A kernel, for the host. */
  NACRE_SLOT = 4,      /* An instance, for all points; or the host, if it is varying. */
  NACRE_VALUE = 5      /* A kernel: an output of a node graph. */
};

/* Channels of one meaning, "<name>.x", "<name>.y", ... */
typedef struct nacre_channel_group {
  size_t size;
  const char* name; /* "P"; "uv*", where * is a number, "geomprop.*", where it is a name. */
  int role;
  int components; /* 1: the name alone. */
  int type;
  const char* unit;    /* "scene units", "unit vector"; "": a bare number. */
  const char* meaning; /* One phrase. */
} nacre_channel_group;

NACRE_API size_t nacre_channel_group_count(void);
NACRE_API nacre_status nacre_channel_group_get(size_t index, nacre_channel_group* group);

/* A channel of one kernel. */
typedef struct nacre_channel {
  size_t size;
  const char* name; /* "P.x" */
  int component;    /* 0 to 3 for .x to .w; -1: none; of "state.<k>" its place in the state. */
  int type;
  int role;
  const char* unit;    /* Of the group, or "". */
  const char* meaning; /* Of the group, or "". */
} nacre_channel;

/* -- Systems: what documents share -------------------------------------------------------- */

typedef struct nacre_system nacre_system;

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
} nacre_system_options;

NACRE_API nacre_status nacre_system_create(const nacre_system_options* options,
                                           nacre_report* report, nacre_system** system);
NACRE_API void nacre_system_destroy(nacre_system* system);

/* -- Documents ------------------------------------------------------------------------------ */

typedef struct nacre_document nacre_document;

typedef struct nacre_read_options {
  size_t size;
  const char* const* search_paths; /* Of includes, after the including file's own folder. */
  size_t search_path_count;
  int includes_anywhere; /* 1: also outside the main file's folder and the search paths. */
} nacre_read_options;

NACRE_API nacre_status nacre_document_read(const char* file, const nacre_read_options* options,
                                           nacre_report* report, nacre_document** document);
/* Of text in memory, which need not end with 0. `name` stands for the file in diagnostics, and its
   folder is where includes and images are looked for. */
NACRE_API nacre_status nacre_document_parse(const char* text, size_t length, const char* name,
                                            const nacre_read_options* options, nacre_report* report,
                                            nacre_document** document);
NACRE_API void nacre_document_destroy(nacre_document* document);
/* Material nodes, in the document's order. */
NACRE_API size_t nacre_document_material_count(const nacre_document* document);
NACRE_API const char* nacre_document_material(const nacre_document* document, size_t index);
/* Outputs of the document and its node graphs that can be kernels: "NG_marble/out". */
NACRE_API size_t nacre_document_output_count(const nacre_document* document);
NACRE_API const char* nacre_document_output(const nacre_document* document, size_t index);

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
  NACRE_SHADE = 11, /* Point, wi and u at once, without a state: f and pdf of wi; as "next.wi",
                       "next.weight", "next.pdf" the direction that u leads to. */
  NACRE_ENTRY_COUNT = 12
} nacre_entry;

/* Bits of the channel `flags` of NACRE_SAMPLE. */
enum {
  NACRE_SAMPLE_VALID = 1,       /* Else weight and densities are 0. */
  NACRE_SAMPLE_DELTA = 2,       /* pdf is a probability; NACRE_EVALUATE gives 0. */
  NACRE_SAMPLE_TRANSMISSION = 4 /* wi and wo are on different sides, by Ng. */
};

/* Bits of nacre_compile_options::lobes. */
enum {
  NACRE_DIFFUSE_REFLECTION = 1,
  NACRE_GLOSSY_REFLECTION = 2,
  NACRE_DIFFUSE_TRANSMISSION = 4,
  NACRE_GLOSSY_TRANSMISSION = 8
};

enum { NACRE_JIT = 0, NACRE_INTERPRETER = 1, NACRE_REFERENCE = 2 };
enum { NACRE_STANDARD = 0, NACRE_PRECISE = 1, NACRE_FAST = 2 };
enum { NACRE_FRONT = 0, NACRE_BACK = 1 };

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
     point, as channels of the slot's name. */
  const char* const* varying;
  size_t varying_count;
  int lobes;       /* Those that are modelled. 0: all. */
  int reverse_pdf; /* 1: NACRE_SAMPLE and NACRE_EVALUATE also store pdf_reverse. */
  int lobe_mask;   /* 1: a slot lobe_mask switches lobes off later. */
  int by_lobe;     /* 1: NACRE_SAMPLE, NACRE_EVALUATE and NACRE_SHADE also store the part of each
                      lobe: "f.lobe0", "weight.lobe0", ... */
  int min_alpha;   /* 1: a slot min_alpha raises the roughness of what is smoother, so that paths
                      behind rough bounces find no sharp lobes. */
  /* Bits 1 << nacre_entry of those that are compiled, for rays that ask no more: a shadow ray needs
     NACRE_OPACITY. NACRE_BEGIN comes with what reads its state. 0: all but NACRE_EVALUATE_AT and
     NACRE_SHADE. */
  uint32_t entries;
  /* What NACRE_BEGIN and NACRE_SHADE also store, so that nothing of a point is computed twice:
     "albedo", "emission", "opacity" (and transmission), "normal", "roughness", or a value of the
     graph by its path: "NG_marble/noise1", "NG_marble/separate1/outx", "SR_marble/base_color". */
  const char* const* with_begin;
  size_t with_begin_count;
  int side;           /* NACRE_BACK: what the back shows, see nacre_shader_has_back. */
  int background;     /* 1: return at once, and interpret until the code is there; the same bits. */
  double max_seconds; /* Of the call. 0: 60. */
  int max_anisotropy; /* Of footprints on images. 0: 16. */
  int no_footprints;  /* 1: points have no extent: images are not filtered, and no channels as dPdx
                         are read. For rays of which nobody knows more. */
  const char* const* search_paths; /* Of images, after the document's own folder. */
  size_t search_path_count;
  int files_anywhere;      /* 1: images also from outside those folders. */
  int missing_images_pass; /* 1: an image that cannot be had is a warning and no error. */
  int lenient;             /* 1: take what other programs' exporters get wrong. */
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
NACRE_API void nacre_shader_destroy(nacre_shader* shader);

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
/* 1 while code is made in the background and kernels are interpreted. */
NACRE_API int nacre_shader_is_pending(const nacre_shader* shader);
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
