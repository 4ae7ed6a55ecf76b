/* clang-format off */
/*
 * sgm.h: the C interface of the SG+M runtime, and its manual.
 *
 * A shape grammar with morphing (a text in the SG+M language) describes an endless world of caves, clouds or
 * buildings. The runtime compiles the text, derives the shapes near a place, evaluates them as an implicit field and
 * meshes it. The same grammar, parameters, seed and cell size give the same bytes on every machine, backend and
 * thread count.
 *
 * Valid as C99 and as C++20. MIT licence.
 *
 * The way through it
 *   sgm_runtime_create -> sgm_grammar_compile -> sgm_field_create -> sgm_mesh_chunks -> sgm_mesh_get_view
 *
 * Conventions, true of every declaration unless it says otherwise
 *   Space      Right-handed, Y up. World positions are int32_t in units of 1/1024 m on each axis
 *              (SGM_UNITS_PER_METRE), about +-2,097 km; so are those given as double, which may also lie between
 *              units. Lengths (a radius, a distance, a height) given as double or float are metres.
 *   Solid      The field is negative inside the solid. Normals point out of the solid; front faces run
 *              counter-clockwise seen from the void (as in glTF and Godot).
 *   Handles    Opaque. A function that makes one writes it through its `out` parameter, and writes NULL there when it
 *              fails. The caller owns it and hands it back to the one function that ends it; all of those accept
 *              NULL. A handle keeps alive whatever it was made from (a field keeps its grammar), so the order in
 *              which handles end does not matter; only the runtime must outlive them all.
 *              To end a handle that has ended does nothing but tell the log, and is SGM_ERR_INVALID_ARGUMENT; of two
 *              threads that end one at one time, one does. A runtime remembers the 1,024 handles that ended last: to
 *              end an older one again, and any other use of a handle that has ended, is undefined.
 *   Structs    Every struct that may grow begins { uint32_t struct_size; const void* next; } (void* next where the
 *              library fills it) and has an _INIT macro with its defaults: start from it always, those that the
 *              library fills included. A struct_size that differs from this header's is SGM_ERR_STRUCT_SIZE. `next` is
 *              for later extensions, each beginning with sgm_chain; this version knows none and refuses a `next` that
 *              is not NULL with SGM_ERR_UNSUPPORTED.
 *   Arrays     Elements that may grow lie a stride of bytes apart, which is given or returned beside the array: at
 *              least the element's size, a multiple of its alignment; 0 for the size of this header's element.
 *   Text       UTF-8. Texts that the library returns end in 0 and live as long as the handle they came from.
 *   Errors     Functions that can fail return sgm_result: 0 done, below 0 failed, above 0 done in part. They take an
 *              sgm_error, which may be NULL, and fill it when they fail (and only then). Bad input never aborts, and
 *              no C++ exception leaves the library. Any function may also return SGM_ERR_OUT_OF_MEMORY.
 *   Threads    Functions may be called from any thread at any time, on shared handles too, but for sgm_parameters,
 *              which only one thread may use while it is being changed, and for functions that end a handle, which no
 *              call on that handle may accompany but another that ends it.
 *   Memory     The library keeps no process-wide state. Bulk data (derived cells, samples, meshes, handles) comes
 *              from the runtime's allocator; small bookkeeping and message texts may come from the C++ heap.
 */
/* clang-format on */
#ifndef SGM_SGM_H
#define SGM_SGM_H

#include <stddef.h>
#include <stdint.h>

#define SGM_VERSION_MAJOR 0
#define SGM_VERSION_MINOR 2
#define SGM_VERSION_PATCH 0

/* One number for the header that a program was built with; sgm_version() is the library's. */
#define SGM_API_VERSION (SGM_VERSION_MAJOR * 1000000u + SGM_VERSION_MINOR * 1000u + SGM_VERSION_PATCH)

#if defined(SGM_STATIC)
#define SGM_API
#elif defined(_WIN32)
#if defined(SGM_BUILDING_LIBRARY)
#define SGM_API __declspec(dllexport)
#else
#define SGM_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define SGM_API __attribute__((visibility("default")))
#else
#define SGM_API
#endif

#if defined(__cplusplus)
#define SGM_NULL nullptr
#define SGM_SIZEOF(type) static_cast<uint32_t>(sizeof(type))
extern "C" {
#else
#define SGM_NULL NULL
#define SGM_SIZEOF(type) ((uint32_t)sizeof(type))
#endif

#define SGM_UNITS_PER_METRE 1024
#define SGM_CHUNK_CELLS 32   /* cells on each axis of a chunk */
#define SGM_SUBCELL 256      /* packed vertex positions are 1/256 of the chunk's cell edge */
#define SGM_MAX_LEVEL 16     /* coarsest level of detail; a level's cell edge is twice that of the level below */
#define SGM_MESSAGE_SIZE 500 /* bytes of sgm_error.message, its ending 0 included */
#define SGM_NAME_SIZE 256    /* bytes of the texts in sgm_backend_info, their ending 0 included */

/* ------------------------------------------------------------------------------------------------ results, errors */

typedef enum sgm_result {
  SGM_OK = 0,
  SGM_INCOMPLETE = 1, /* an array was too small: it holds what fits, or nothing where so said, and the count is whole */

  SGM_ERR_INVALID_ARGUMENT = -1, /* NULL where a value is needed, not a number, a value out of its stated range */
  SGM_ERR_STRUCT_SIZE = -2,      /* struct_size is not this library's: start from the _INIT macro, or rebuild */
  SGM_ERR_VERSION = -3,          /* header and library do not belong together */
  SGM_ERR_OUT_OF_MEMORY = -4,    /* the allocator returned NULL, or memory_limit was reached */
  SGM_ERR_GRAMMAR = -5,          /* the grammar text is wrong; line and column say where */
  SGM_ERR_LIMIT = -6,            /* a cap on counts, depth, time or threads was reached; the message names it. Where
                                    deriving the grammar reached it, line and column say at which of its statements */
  SGM_ERR_RANGE = -7,            /* leaves the integer grid: a world of +-2^31 units, cells of 2^22 units at most */
  SGM_ERR_IO = -8,               /* a file could not be read or written */
  SGM_ERR_UNSUPPORTED = -9,      /* no such backend, device or extension here */
  SGM_ERR_CANCELLED = -10,       /* the caller's progress callback asked to stop */
  SGM_ERR_BUSY = -11,            /* in use, as by handles that were made from it and are still alive */
  SGM_ERR_NOT_FOUND = -12,       /* no entry of that name or index */
  SGM_ERR_INTERNAL = -13,        /* a fault of the library's own; please report it */
  SGM_ERR_DATA = -14,            /* bytes or a file from elsewhere are damaged, of another version or another world's */
  SGM_ERR_DEVICE_LOST = -15,     /* the GPU has failed; what lies on it is lost, and everything else goes on */
  SGM_RESULT_FORCE_32_BIT = 0x7FFFFFFF
} sgm_result;

/* The name of a result, "SGM_ERR_RANGE"; "unknown" for a value that this library does not know. Never NULL. Static. */
SGM_API const char* sgm_result_name(sgm_result result);

/* What went wrong, in the caller's memory. The message is one line that says what to do. */
typedef struct sgm_error {
  sgm_result code;                /* what the function returned */
  int32_t line;                   /* in the grammar text, from 1; 0 where the error has no place in a text */
  int32_t column;                 /* in bytes, from 1; 0 as line */
  char message[SGM_MESSAGE_SIZE]; /* ends in 0; cut off at a whole character where it was longer */
} sgm_error;

#define SGM_ERROR_INIT  \
  {                     \
    SGM_OK, 0, 0, { 0 } \
  }

/* The beginning of every struct that a later version may hang on a `next` pointer. */
typedef struct sgm_chain {
  uint32_t struct_size;
  uint32_t kind;
  const void* next;
} sgm_chain;

/* -------------------------------------------------------------------------------------------------- version, build */

/* The library's version, to compare with SGM_API_VERSION. */
SGM_API uint32_t sgm_version(void);

/* "0.2.0". Static. */
SGM_API const char* sgm_version_string(void);

/* One line on how the library was built: version, compiler, instruction sets, backends, checks. Static. */
SGM_API const char* sgm_build_info(void);

/* -------------------------------------------------------------------------------------------------------- runtime */

/* Owns nothing but what every other handle shares: allocator, job system, log sink, limits. */
typedef struct sgm_runtime sgm_runtime;

/* Memory from the caller. Both functions may be called from any thread at one time, also after the call of ours that
 * allocated has returned, up to the end of sgm_runtime_destroy. */
typedef struct sgm_allocator {
  /* Returns `size` bytes (at least 1) at a multiple of `alignment` (a power of two), or NULL. */
  void* (*allocate)(void* user, size_t size, size_t alignment);
  /* Takes back what allocate returned; size and alignment are those it was asked for. Never called with NULL. */
  void (*release)(void* user, void* memory, size_t size, size_t alignment);
  void* user;
} sgm_allocator;

/* Threads from the caller. An accepted job must run exactly once, on any thread, at any time, in any order; a system
 * without threads of its own may run its jobs in help alone. The thread that makes a call works too, and does all of it
 * where no job is begun: a call waits only for those of its jobs that have begun, and runs help, again and again, while
 * it waits (so it may do a share of another call's work). A job that begins after its call has returned finds nothing
 * to do; sgm_runtime_destroy waits for the last of those, and runs help too. A job lets no C++ exception out. The
 * functions may be called from any thread, inside a job too. */
typedef struct sgm_job_system {
  /* How many threads may work on one call at one time, at least 1: its own one, and jobs for the others. */
  uint32_t (*concurrency)(void* user);
  /* Accepts a job (returns non-zero) or refuses it (returns 0): then it runs at once on the submitting thread.
   * A higher priority should run earlier; 0 is usual. */
  int32_t (*submit)(void* user, void (*function)(void* argument), void* argument, int32_t priority);
  /* Runs one waiting job on the calling thread and returns non-zero, or returns 0 where none waits. May be NULL. */
  int32_t (*help)(void* user);
  void* user;
} sgm_job_system;

typedef enum sgm_log_level {
  SGM_LOG_DEBUG = 0,
  SGM_LOG_INFO = 1,
  SGM_LOG_WARNING = 2,
  SGM_LOG_ERROR = 3,
  SGM_LOG_LEVEL_FORCE_32_BIT = 0x7FFFFFFF
} sgm_log_level;

/* Where messages go. Called from any thread, several at one time; the message (one line, no newline) lives for the
 * call. It must not call back into the library.
 * Warnings tell what a field leaves out as it derives cells (a shape that passes its layer's reach, a morph between
 * shapes that do not fit), with line and column in the grammar: each place once a field, for the first 64 places. */
typedef struct sgm_log_sink {
  void (*write)(void* user, sgm_log_level level, const char* message);
  void* user;
} sgm_log_sink;

/* The engine's own profiler (Tracy, Superluminal, PIX, Unreal's or Godot's): zones, which nest on each thread and end
 * there, whatever becomes of the work. Called from any thread, several at one time, some ten times a chunk. The
 * functions must not call back into the library and let no C++ exception out.
 * Names are static, and each is one pointer for as long as the library is loaded: a table of source locations, colours
 * or ids may be kept by it. Any zone may lie in any other, of its own name too: layers use layers, and a thread that
 * waits works for other calls meanwhile.
 *   sgm.derive   one cell of a layer of the grammar becomes shapes
 *   sgm.compile  shapes near a chunk become its field program: cells that it needs are derived in it, or waited for
 *   sgm.mesh     a field program becomes samples and triangles; of a device, what the CPU has to do with that
 *   sgm.shaders  a device's shaders are made ready, on a thread of its own where a world would have to wait
 *   sgm.pack     triangles become what sgm_mesh_get_view shows
 *   sgm.plan     what a world draws and meshes next is decided, in a job
 *   sgm.update   sgm_world_update
 *   sgm.poll     sgm_world_poll
 *   sgm.region   sgm_surface_from_region
 * Plots come at the end of each sgm_world_update; they are those members of sgm_world_stats:
 *   sgm.queued, sgm.in_work, sgm.mesh_bytes */
typedef struct sgm_profiler {
  uint64_t (*begin)(void* user, const char* zone); /* returns anything: an index, a pointer, a small struct's bytes */
  void (*end)(void* user, uint64_t begun); /* ends the thread's zone that began last; takes what begin returned */
  /* Called once on each thread that the runtime starts, before it works; the name ("sgm worker 1") lives for the call.
   * May be NULL; threads of an sgm_job_system are the engine's to name. */
  void (*thread)(void* user, const char* name);
  void (*plot)(void* user, const char* name, double value); /* may be NULL */
  void* user;
} sgm_profiler;

/* The four tables are copied; what their `user` points to must outlive the runtime. */
typedef struct sgm_runtime_desc {
  uint32_t struct_size;
  const void* next;
  uint32_t api_version;           /* SGM_API_VERSION of the header in use; the _INIT macro sets it */
  uint32_t threads;               /* where jobs is NULL: threads that may work on one call at one time, the calling one
                                     among them; 1 to 1,024; 0: one a processor. What the machine does not let start is
                                     done without, and logged as a warning */
  const sgm_allocator* allocator; /* NULL: malloc and free, with up to 128 MiB of released blocks kept for the next
                                     ones: those count neither for sgm_runtime_memory nor for memory_limit */
  const sgm_job_system* jobs;     /* NULL: a thread pool of the runtime's own */
  const sgm_log_sink* log;        /* NULL: no messages */
  uint64_t memory_limit;          /* most bytes to hold from the allocator at one time; 0: no limit */
  const sgm_profiler* profiler;   /* NULL: no profiler */
  const char* pipeline_folder;    /* UTF-8 path of a folder that keeps what a Vulkan device's driver makes of the
                                     library's shaders, which may take it many seconds, from one run to the next: a
                                     file for each device and driver, for any number of runtimes, processes and programs
                                     at one time; made where there is none. All of it may be deleted at any time, and is
                                     made anew where it is missing or damaged; but drivers trust what is whole, so let
                                     nobody write there whose programs you would not run. Where it cannot be written the
                                     log is told, and nothing fails. Copied. NULL: none is kept */
} sgm_runtime_desc;

#define SGM_RUNTIME_DESC_INIT \
  { SGM_SIZEOF(sgm_runtime_desc), SGM_NULL, SGM_API_VERSION, 0, SGM_NULL, SGM_NULL, SGM_NULL, 0, SGM_NULL, SGM_NULL }

/* desc may be NULL: all defaults. A program built with another major version, or with a newer minor one (while the
 * major version is 0: with any other minor one) is refused with SGM_ERR_VERSION. SGM_ERR_LIMIT: the machine lets not
 * one thread start. */
SGM_API sgm_result sgm_runtime_create(const sgm_runtime_desc* desc, sgm_runtime** out, sgm_error* error);

/* SGM_ERR_BUSY, and nothing happens, while a handle made from this runtime lives. Waits for jobs that the job system
 * has accepted and not run. NULL is SGM_OK. A second call is undefined: what a runtime remembers ends with it. */
SGM_API sgm_result sgm_runtime_destroy(sgm_runtime* runtime);

/* Bytes held from the allocator now, and the most at any one time. Either pointer may be NULL. What is remembered of
 * ended handles, at most 512 KiB, counts for peak and memory_limit, and not for live. */
SGM_API sgm_result sgm_runtime_memory(const sgm_runtime* runtime, uint64_t* live, uint64_t* peak);

/* ------------------------------------------------------------------------------------------------------- backends */

typedef enum sgm_backend {
  SGM_BACKEND_AUTO = 0, /* CUDA, then a hardware Vulkan device, then the CPU: the first that is usable here */
  SGM_BACKEND_CPU = 1,
  SGM_BACKEND_VULKAN = 2,
  SGM_BACKEND_CUDA = 3,
  SGM_BACKEND_FORCE_32_BIT = 0x7FFFFFFF
} sgm_backend;

/* Filled by sgm_backend_query. */
typedef struct sgm_backend_info {
  uint32_t struct_size;
  void* next;
  sgm_backend backend;        /* the one asked for; for AUTO the one chosen */
  int32_t usable;             /* 1: work can be given to it here; 0: `reason` says why not */
  int32_t exact;              /* 1: follows the arithmetic contract, so gives the same bytes as every other exact one */
  uint32_t concurrency;       /* chunks of one call worked on at one time, where usable */
  char name[SGM_NAME_SIZE];   /* "cpu", "vulkan", "cuda" */
  char device[SGM_NAME_SIZE]; /* device or instruction set in use, "AVX2"; empty where not usable */
  char reason[SGM_NAME_SIZE]; /* empty where usable */
  /* Of a device, which all fields of a runtime share: since it was first used. 0 for the CPU. */
  uint64_t chunks;        /* that have become meshes */
  uint64_t chunks_on_cpu; /* of these, meshed by the CPU instead: too large for the device, while it failed, or, of a
                           * world, while its shaders were not ready (SGM_LOG_INFO says so where it takes long) */
  uint64_t losses;        /* how often the device was lost */
  uint64_t resident;      /* bytes of meshes that lie on the device at this moment (SGM_WORLD_RESIDENT) */
} sgm_backend_info;

#define SGM_BACKEND_INFO_INIT \
  { SGM_SIZEOF(sgm_backend_info), SGM_NULL, SGM_BACKEND_AUTO, 0, 0, 0, {0}, {0}, {0}, 0, 0, 0, 0 }

/* Says whether a backend can be used here, and why not. A backend that is not usable is SGM_OK with usable = 0; a
 * number that is no backend is SGM_ERR_INVALID_ARGUMENT. */
SGM_API sgm_result sgm_backend_query(sgm_runtime* runtime, sgm_backend backend, sgm_backend_info* info,
                                     sgm_error* error);

/* ------------------------------------------------------------------------------------------------------- grammars */

/* A compiled grammar: immutable, shared freely between threads. */
typedef struct sgm_grammar sgm_grammar;

/* The messages of one compilation, errors and warnings, in text order. */
typedef struct sgm_diagnostics sgm_diagnostics;

/* Finds the text of `import "path" as name;`, or the bytes of an asset where the path ends in ".glb". `path` is as
 * written, made relative to the root: segments joined by '/', never absolute, never with "..". Returns non-zero and
 * sets text and size (bytes), or returns 0 where there is no such text. The text must stay as it is until
 * sgm_grammar_compile returns. Called on the compiling thread only. Paths that begin with "std/" are built in and never
 * asked for. */
typedef int32_t (*sgm_import_function)(void* user, const char* path, const char** text, size_t* size);

typedef struct sgm_grammar_desc {
  uint32_t struct_size;
  const void* next;
  const char* text;                /* need not end in 0; copied */
  size_t text_size;                /* bytes; SIZE_MAX: text ends in 0 */
  const char* name;                /* file name for messages; NULL: "grammar" */
  const char* import_folder;       /* imports are read from files in this folder, and never from outside it; or NULL */
  sgm_import_function import_text; /* asked before import_folder; or NULL. With neither, only std/ can be imported */
  void* import_user;
} sgm_grammar_desc;

#define SGM_GRAMMAR_DESC_INIT \
  { SGM_SIZEOF(sgm_grammar_desc), SGM_NULL, SGM_NULL, SIZE_MAX, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL }

/* Compiles a grammar. The text is untrusted: its size, depth, counts and the time it takes are capped.
 * diagnostics may be NULL; else it receives a list of every message, whether the grammar compiled (then all of them are
 * warnings) or not, and the caller ends it with sgm_diagnostics_destroy in both cases. It is NULL only where the call
 * failed before it read the text (a wrong argument, no memory).
 * SGM_ERR_GRAMMAR: the text is wrong, reaches a cap, or imports what cannot be read; error holds the first error,
 * which a warning may stand before in the list (of an error inside an import the message names the file, and line and
 * column are places in it). */
SGM_API sgm_result sgm_grammar_compile(sgm_runtime* runtime, const sgm_grammar_desc* desc, sgm_grammar** out,
                                       sgm_diagnostics** diagnostics, sgm_error* error);
SGM_API sgm_result sgm_grammar_destroy(sgm_grammar* grammar);

/* A hash of the meaning-bearing text, imports included: equal on every machine. 0 for NULL. */
SGM_API uint64_t sgm_grammar_hash(const sgm_grammar* grammar);

typedef struct sgm_diagnostic {
  uint32_t struct_size;
  void* next;
  sgm_log_level severity;  /* SGM_LOG_ERROR or SGM_LOG_WARNING */
  int32_t line, column;    /* from 1; columns count bytes */
  int32_t length;          /* bytes from column that the message is about, at least 1 */
  const char* file;        /* name of the text that it is in: the grammar's own, or an import's path */
  const char* message;     /* one line, without place */
  const char* hint;        /* what might have been meant, or "" */
  const char* source_line; /* the line of text, without its newline, or "" */
} sgm_diagnostic;

#define SGM_DIAGNOSTIC_INIT \
  { SGM_SIZEOF(sgm_diagnostic), SGM_NULL, SGM_LOG_ERROR, 0, 0, 0, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL }

SGM_API sgm_result sgm_diagnostics_destroy(sgm_diagnostics* diagnostics);
SGM_API uint32_t sgm_diagnostics_count(const sgm_diagnostics* diagnostics); /* 0 for NULL */
/* Texts in out live as long as diagnostics. SGM_ERR_NOT_FOUND: no such index. */
SGM_API sgm_result sgm_diagnostics_get(const sgm_diagnostics* diagnostics, uint32_t index, sgm_diagnostic* out);

/* A grammar's materials and tags, by the index that vertices carry. Index 0 is the default material ("" where the
 * grammar names none), and no tag. The name lives as long as the grammar; NULL for no such index or a NULL grammar. */
SGM_API uint32_t sgm_grammar_material_count(const sgm_grammar* grammar);
SGM_API const char* sgm_grammar_material(const sgm_grammar* grammar, uint32_t index);
SGM_API uint32_t sgm_grammar_tag_count(const sgm_grammar* grammar);
SGM_API const char* sgm_grammar_tag(const sgm_grammar* grammar, uint32_t index);
/* Names of anchor kinds and anchors, by the indices in sgm_anchor. */
SGM_API uint32_t sgm_grammar_name_count(const sgm_grammar* grammar);
SGM_API const char* sgm_grammar_name(const sgm_grammar* grammar, uint32_t index);

/* Where the grammar's world lies, and what is there without any shape. */
typedef struct sgm_domain_info {
  uint32_t struct_size;
  void* next;
  int32_t infinite;               /* 1: the world has no end; 0: it is the box below */
  int32_t solid;                  /* 1: solid where no shape is, as rock; 0: void */
  int32_t density;                /* 1: the grammar says `output density`: its solid is meant as fog, not as a wall */
  uint32_t material;              /* of a solid domain; index for sgm_grammar_material */
  int32_t cut[3];                 /* infinite: 1 along axes that are cut into cells, so that the world goes on and on
                                     there; 0 along the others, and where finite */
  int32_t minimum[3], maximum[3]; /* finite: what to mesh, minimum <= p < maximum, units; infinite: all 0 */
  float density_edge;             /* how far below its surface the fog is thick, metres: `output density edge 20m`, or
                                     10 m where that is not written; 0 where density is 0 */
} sgm_domain_info;

#define SGM_DOMAIN_INFO_INIT \
  { SGM_SIZEOF(sgm_domain_info), SGM_NULL, 0, 0, 0, 0, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0.0f }

SGM_API sgm_result sgm_grammar_domain(const sgm_grammar* grammar, sgm_domain_info* out);

/* A layer of the grammar: an endless lattice of cells, each derived on its own. A layer uses only layers before it. */
typedef struct sgm_layer_info {
  uint32_t struct_size;
  void* next;
  const char* name;      /* lives as long as the grammar */
  int32_t cell_units[3]; /* edges of a cell; 0 along an axis that is not cut into cells */
  int32_t reach_units;   /* how far from its cell a shape may reach */
} sgm_layer_info;

#define SGM_LAYER_INFO_INIT \
  { SGM_SIZEOF(sgm_layer_info), SGM_NULL, SGM_NULL, {0, 0, 0}, 0 }

SGM_API uint32_t sgm_grammar_layer_count(const sgm_grammar* grammar);
/* SGM_ERR_NOT_FOUND: no such index. */
SGM_API sgm_result sgm_grammar_layer(const sgm_grammar* grammar, uint32_t index, sgm_layer_info* out);

/* ----------------------------------------------------------------------------------------------------- parameters */

typedef enum sgm_quantity {
  SGM_QUANTITY_NUMBER = 0, /* no unit; 50% is 0.5 */
  SGM_QUANTITY_LENGTH = 1, /* metres */
  SGM_QUANTITY_ANGLE = 2,  /* radians */
  SGM_QUANTITY_OTHER = 3,  /* any other dimension (an area, a density): powers of metres */
  SGM_QUANTITY_FORCE_32_BIT = 0x7FFFFFFF
} sgm_quantity;

typedef struct sgm_parameter_info {
  uint32_t struct_size;
  void* next;
  const char* name; /* texts live as long as the grammar */
  const char* doc;  /* what the grammar says of it, or "" */
  sgm_quantity quantity;
  int32_t whole;           /* 1: only whole numbers */
  double default_value;    /* in the quantity's unit */
  double minimum, maximum; /* both allowed; -infinity and infinity where the grammar gives no range */
  int32_t animated;  /* 1: meant to be driven through its range while the world is watched (sgm_world_set_field) */
  uint32_t reserved; /* 0 */
} sgm_parameter_info;

#define SGM_PARAMETER_INFO_INIT \
  { SGM_SIZEOF(sgm_parameter_info), SGM_NULL, SGM_NULL, SGM_NULL, SGM_QUANTITY_NUMBER, 0, 0.0, 0.0, 0.0, 0, 0 }

SGM_API uint32_t sgm_grammar_parameter_count(const sgm_grammar* grammar); /* 0 for NULL */
/* SGM_ERR_NOT_FOUND: no such index. */
SGM_API sgm_result sgm_grammar_parameter(const sgm_grammar* grammar, uint32_t index, sgm_parameter_info* out);

/* A value for every parameter of one grammar, at first the defaults. A field copies it when it is made, so that a world
 * is given a new field to show other values (sgm_world_set_field); what does not depend on them stays as it is:
 *
 *   sgm_parameters_set(parameters, "wet", 0.7, &error);
 *   field_desc.parameters = parameters;
 *   sgm_field_create(runtime, &field_desc, &field, &error);
 *   sgm_world_set_field(world, field, &error);
 *   sgm_field_destroy(field);    the world keeps it for as long as it needs it
 */
typedef struct sgm_parameters sgm_parameters;

SGM_API sgm_result sgm_parameters_create(const sgm_grammar* grammar, sgm_parameters** out, sgm_error* error);
SGM_API sgm_result sgm_parameters_destroy(sgm_parameters* parameters);
/* SGM_ERR_NOT_FOUND: no such parameter (the message offers the nearest name). SGM_ERR_INVALID_ARGUMENT: not finite, not
 * whole where it must be, or outside the parameter's range. On failure nothing changes. */
SGM_API sgm_result sgm_parameters_set(sgm_parameters* parameters, const char* name, double value, sgm_error* error);
/* As above from a text as the language writes it, "0.3", "50%", "12m"; a length without a unit is in the grammar's
 * `units`, where it has such a line. SGM_ERR_GRAMMAR where it is no number or its unit is wrong. */
SGM_API sgm_result sgm_parameters_set_text(sgm_parameters* parameters, const char* name, const char* text,
                                           sgm_error* error);
SGM_API sgm_result sgm_parameters_get(const sgm_parameters* parameters, const char* name, double* value,
                                      sgm_error* error);

/* ---------------------------------------------------------------------------------------------------------- fields */

/* A grammar with its parameters, its seed and its finest cell: everything that the world depends on. Immutable in what
 * it answers; keeps a cache of derived cells inside. */
typedef struct sgm_field sgm_field;

/* Points of a host's field that are asked for together: origin + spacing * (x, y, z), in units, each whole point of the
 * world. The value of (x, y, z) goes to index (z * count[1] + y) * count[0] + x. */
typedef struct sgm_host_lattice {
  int32_t origin[3]; /* units */
  int32_t spacing;   /* units: the edge of a cell of the level that is meshed. Leave out what is finer */
  uint32_t count[3]; /* at least 1; 2^25 points at most, as a rule 36^3 */
} sgm_host_lattice;

/* Writes the field in metres at each point, solid below 0, and returns SGM_OK; anything else fails the call, or the
 * chunk, that needs it, with SGM_ERR_INVALID_ARGUMENT, LIMIT, RANGE or IO where it is that, else SGM_ERR_UNSUPPORTED. A
 * value that is not finite fails it too. A world does not ask again for a chunk that has failed until an edit or
 * another field changes it: what is still to be loaded must be waited for, or left out. Called from any thread, several
 * at one time; must not call back into the library and lets no C++ exception out. */
typedef sgm_result (*sgm_host_sample)(void* user, const sgm_host_lattice* lattice, float* values);

typedef enum sgm_host_flag {
  SGM_HOST_CUT = 1, /* takes its solid away from what is there; without this flag it adds it */
  SGM_HOST_FLAG_FORCE_32_BIT = 0x7FFFFFFF
} sgm_host_flag;

/* A field of the host's own beside the grammar's: a terrain, or rooms that another program made. Meshed, streamed and
 * asked about like everything else, and dug into by edits; also outside of a finite domain. The grammar's own rules
 * know nothing of it.
 * Its values are rounded to 1/1024 unit, and read linearly between the points of each level, normals from differences
 * over two cells. So that neighbouring chunks fit, a value must be the same whenever its point is asked for at one
 * spacing; so that it is on every machine, it must be computed alike there.
 * Rays and nearest points ask for all cells that they come near: SGM_ERR_LIMIT where these are more than 2^25. */
typedef struct sgm_host_field {
  uint32_t struct_size;
  const void* next;
  sgm_host_sample sample;
  void* user;         /* must live as long as the field and all that is made from it */
  uint64_t identity;  /* of what it samples: another number wherever a value differs. What is kept on disk (cache and
                         journal) counts as another world's under another one. 0: nothing can be kept there */
  int32_t minimum[3]; /* units. Its solid must lie within this box: three cells outside of it, and the blend's width,
                         nothing more is asked for, and what is solid there ends where a level's cells say so */
  int32_t maximum[3];
  float steepness;   /* the most that the value changes over a metre of way, from 0 to 1000; 1 of a distance. Then
                        chunks far from the surface ask for a single point, and a value counts as far that is over 16 m
                        and over what it changes by in two cells: wider blends of edits end there. Values farther apart
                        than this allows fail a chunk. 0: not known */
  uint32_t flags;    /* of sgm_host_flag */
  uint16_t material; /* index for sgm_grammar_material; 0: the default. Of a cut: what it leaves on the surface, 0:
                        what was there */
  uint16_t tag;      /* index for sgm_grammar_tag */
  int32_t smooth;    /* width of the blend with what is there, 0 to 16,384 units; 0: none */
} sgm_host_field;

#define SGM_HOST_FIELD_INIT                                                                         \
  {                                                                                                 \
    SGM_SIZEOF(sgm_host_field), SGM_NULL, SGM_NULL, SGM_NULL, 0, {INT32_MIN, INT32_MIN, INT32_MIN}, \
        {INT32_MAX, INT32_MAX, INT32_MAX}, 0.0f, 0, 0, 0, 0                                         \
  }

typedef struct sgm_field_desc {
  uint32_t struct_size;
  const void* next;
  const sgm_grammar* grammar;       /* kept alive by the field */
  const sgm_parameters* parameters; /* of this grammar; copied. NULL: defaults */
  uint64_t seed;                    /* mixed with the grammar's own `seed` */
  int32_t cell_units;               /* edge of a level-0 cell, 1 to 2^20 units; see sgm_cell_from_metres */
  sgm_backend backend;              /* SGM_ERR_UNSUPPORTED where it is not usable here */
  uint64_t cache_bytes;             /* derived cells to keep, about; 0: 64 MiB */
  const sgm_host_field* hosts;      /* above all that the grammar derives, in this order; copied. NULL: none */
  size_t host_stride;               /* bytes; 0: sizeof(sgm_host_field) */
  size_t host_count;                /* at most 16 */
} sgm_field_desc;

#define SGM_FIELD_DESC_INIT                                                                                    \
  {                                                                                                            \
    SGM_SIZEOF(sgm_field_desc), SGM_NULL, SGM_NULL, SGM_NULL, 0, SGM_UNITS_PER_METRE / 2, SGM_BACKEND_AUTO, 0, \
        SGM_NULL, 0, 0                                                                                         \
  }

SGM_API sgm_result sgm_field_create(sgm_runtime* runtime, const sgm_field_desc* desc, sgm_field** out,
                                    sgm_error* error);
SGM_API sgm_result sgm_field_destroy(sgm_field* field);

/* Rounds a cell edge in metres to the nearest whole number of units (0.1 m becomes 102 units, 0.099609375 m).
 * SGM_ERR_INVALID_ARGUMENT: not a number, below half a unit (it would round to 0), or above 2^20 units. */
SGM_API sgm_result sgm_cell_from_metres(double metres, int32_t* units, sgm_error* error);

/* One sample point's results go to the same index of each array that is not NULL. */
typedef struct sgm_sample_desc {
  uint32_t struct_size;
  const void* next;
  const int32_t* points; /* x y z in units */
  size_t point_stride;   /* bytes from one point to the next, a multiple of 4; 0: 12 */
  size_t count;          /* points; 0 is SGM_OK */
  int32_t level;         /* 0 to SGM_MAX_LEVEL: what coarse chunks leave out is left out here too */
  int32_t* q;            /* quantised field, what meshes are made of: floor(field * 1024 / finest cell + 0.5),
                            clamped to +-2^22; solid below 0 */
  float* values;         /* field in metres, negative inside the solid: a distance near a surface, and a constant
                            of +-10^30 units (9.8 * 10^26 m) with gradient 0 where no shape is
                            within a cell or two */
  float* gradients;      /* 3 a point: the field's gradient over metres; points out of the solid */
  uint16_t* materials;   /* of the shape that is nearest to its surface there */
  uint16_t* tags;
} sgm_sample_desc;

#define SGM_SAMPLE_DESC_INIT \
  { SGM_SIZEOF(sgm_sample_desc), SGM_NULL, SGM_NULL, 0, 0, 0, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL }

/* Evaluates the field at points, exactly as meshing does. Blocks; uses the job system. On failure the arrays hold
 * anything. SGM_ERR_LIMIT: deriving a cell reached a cap of the language's (line and column say where), or more than
 * 2^20 cells of a layer reach into one chunk. SGM_ERR_RANGE: the cells of the level are larger than 2^22 units. */
SGM_API sgm_result sgm_field_sample(sgm_field* field, const sgm_sample_desc* desc, sgm_error* error);

/* An oriented point for the game (a spawn place, a door), given by the grammar. */
typedef struct sgm_anchor {
  int32_t position[3]; /* units */
  float rotation[9];   /* row-major, orthonormal: world direction to the anchor's local direction */
  uint16_t kind;       /* index for sgm_grammar_name */
  uint16_t name;       /* index for sgm_grammar_name */
  uint16_t tag;        /* index for sgm_grammar_tag */
  uint16_t reserved;   /* 0 */
  uint64_t key;        /* the same for this anchor in every run; differs from every other anchor's */
} sgm_anchor;

/* Writes the anchors at minimum <= p < maximum (units, per axis), by layer, cell and key; derives the cells there that
 * are not in the cache, on the calling thread. *count takes the anchors array's room, and returns how many there are.
 * anchors may be NULL: then only that is asked. SGM_INCOMPLETE: they did not all fit; the first ones were written.
 * SGM_ERR_LIMIT: as sgm_field_sample, or more than 2^24 cells of a layer reach into the box. */
SGM_API sgm_result sgm_field_anchors(sgm_field* field, const int32_t minimum[3], const int32_t maximum[3],
                                     sgm_anchor* anchors, size_t anchor_stride, size_t* count, sgm_error* error);

/* ------------------------------------------------------------------------------------------- questions to the field */

/* Answered by the field itself at level 0, where no mesh need be: what a ray hits, what surface is nearest, where one
 * can stand. All of them block, derive the cells there that are not in the cache, and work on the calling thread: ask
 * from many threads at once. The answers are the same on every machine, and at any distance from the origin.
 * Positions are in units, as double: also between them. Errors common to all, each with a message that says which:
 * SGM_ERR_INVALID_ARGUMENT (not finite, or out of its stated range), SGM_ERR_RANGE (a position outside of the world),
 * SGM_ERR_LIMIT (farther or larger than stated, or as sgm_field_sample). On failure `out` stays as it was. */

/* A place on the surface. Filled by sgm_field_ray_cast and sgm_field_closest_point. */
typedef struct sgm_surface_point {
  uint32_t struct_size;
  void* next;
  int32_t found;      /* 0: there is none, and all below is 0 */
  int32_t inside;     /* 1: the place that was asked about lies in the solid itself */
  double position[3]; /* units */
  double normal[3];   /* one long, out of the solid */
  double distance;    /* from the place that was asked about, metres */
  uint16_t material;  /* index for sgm_grammar_material */
  uint16_t tag;       /* index for sgm_grammar_tag */
  uint32_t reserved;  /* 0 */
} sgm_surface_point;

#define SGM_SURFACE_POINT_INIT \
  { SGM_SIZEOF(sgm_surface_point), SGM_NULL, 0, 0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 0.0, 0, 0, 0 }

typedef struct sgm_ray_desc {
  uint32_t struct_size;
  const void* next;
  double from[3];      /* units, in the world */
  double direction[3]; /* any length but 0 */
  double length;       /* metres, 0 to 4,096 m or 8,192 cells, whichever is more */
} sgm_ray_desc;

#define SGM_RAY_DESC_INIT \
  { SGM_SIZEOF(sgm_ray_desc), SGM_NULL, {0.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, 1.0 }

/* The first solid on a ray. One that starts in the solid hits it at once (inside). Nothing solid is stepped over that
 * the ray passes through for a sixteenth of a cell, or for a unit where that is more; so no wall as thick as a cell.
 * The hit lies on the void's side, less than a unit from the solid. A ray ends where the world does. */
SGM_API sgm_result sgm_field_ray_cast(sgm_field* field, const sgm_ray_desc* desc, sgm_surface_point* out,
                                      sgm_error* error);

typedef struct sgm_closest_desc {
  uint32_t struct_size;
  const void* next;
  double position[3];  /* units, in the world */
  double max_distance; /* metres, 0 to 64 m or 256 cells, whichever is more */
} sgm_closest_desc;

#define SGM_CLOSEST_DESC_INIT \
  { SGM_SIZEOF(sgm_closest_desc), SGM_NULL, {0.0, 0.0, 0.0}, 1.0 }

/* The surface nearest to a place, from the void or from inside the solid. Looks at all of the surface that the samples
 * of level 0 show: none of that is nearer than the answer by more than a quarter of a cell and a sixty-fourth of the
 * distance; as a rule the answer is exact to a unit. Work grows with the square of the distance found. */
SGM_API sgm_result sgm_field_closest_point(sgm_field* field, const sgm_closest_desc* desc, sgm_surface_point* out,
                                           sgm_error* error);

/* A box, and an upright cylinder that is to stand and walk in it. Lengths in metres. */
typedef struct sgm_walk_desc {
  uint32_t struct_size;
  const void* next;
  int32_t minimum[3], maximum[3]; /* units, minimum < maximum: floors at minimum <= p < maximum count. With the walker's
                                     room around it at most 4,096 chunks of 32 cells, all in the world */
  double radius;                  /* 0 to 64 cells */
  double height;                  /* above 0, to 256 cells */
  double step;                    /* climbs and drops this much from one place to the next; 0 to below height */
  double slope;                   /* least y of a floor's normal: the cosine of the steepest angle, 0 to 1 */
  double area;                    /* square metres of connected floor that make a box walkable; 0 or more */
} sgm_walk_desc;

#define SGM_WALK_DESC_INIT \
  { SGM_SIZEOF(sgm_walk_desc), SGM_NULL, {0, 0, 0}, {0, 0, 0}, 0.3, 1.8, 0.4, 0.7071067811865476, 1.0 }

/* Filled by sgm_field_is_walkable. Areas in square metres, seen from above, in steps of a cell. */
typedef struct sgm_walkable {
  uint32_t struct_size;
  void* next;
  int32_t walkable; /* 1: largest is above 0, and is at least the walker's area */
  uint32_t sides;   /* side faces of the box that the largest part comes to, bit (1u << sgm_face): with both ends of a
                       passage among them it can be walked through */
  double standing;  /* floor that the walker can stand on */
  double largest;   /* of that the largest connected part */
} sgm_walkable;

#define SGM_WALKABLE_INIT \
  { SGM_SIZEOF(sgm_walkable), SGM_NULL, 0, 0, 0.0, 0.0 }

/* Where in a box one can stand, and how far walk. Judged on the samples of level 0, a cell apart. A place to stand is a
 * column of samples with a floor in the box: solid under void, its normal up to the slope, with the walker's height
 * free above it, and no solid within the walker's radius that is higher than its step and lower than its head (higher
 * by what the slope rises on the way there). Places side by side are connected where their floors differ by no more
 * than the step and what the slope rises in a cell. */
SGM_API sgm_result sgm_field_is_walkable(sgm_field* field, const sgm_walk_desc* desc, sgm_walkable* out,
                                         sgm_error* error);

/* ---------------------------------------------------------------------------------------------------- chunk meshes */

/* The mesh of one chunk, packed for drawing. Immutable and counted by reference. */
typedef struct sgm_mesh sgm_mesh;

/* Names a chunk. Its edge is 32 cells of its level, its cell edge is the field's cell_units << level, and its lowest
 * corner is (x, y, z) times its edge. */
typedef struct sgm_chunk_key {
  int32_t level; /* 0 to SGM_MAX_LEVEL */
  int32_t x, y, z;
} sgm_chunk_key;

/* Faces of a chunk. A mask has bit (1u << face). */
typedef enum sgm_face {
  SGM_FACE_X_LOW = 0,
  SGM_FACE_X_HIGH = 1,
  SGM_FACE_Y_LOW = 2,
  SGM_FACE_Y_HIGH = 3,
  SGM_FACE_Z_LOW = 4,
  SGM_FACE_Z_HIGH = 5,
  SGM_FACE_COUNT = 6,
  SGM_FACE_FORCE_32_BIT = 0x7FFFFFFF
} sgm_face;

typedef struct sgm_chunk_request {
  sgm_chunk_key key;
  uint32_t seams;       /* faces to make seams for: those whose neighbour may be drawn one level coarser. A seam lies
                           in its face's plane, and asking for it does not change the body; edges and corners of the
                           chunk need none. Its triangles may be flat, so that seams are closed and manifold by vertex
                           identity, not where vertices are joined by place alone */
  uint32_t coarser;     /* which of the 26 blocks of the chunk's size around it belong to coarser chunks: bit
                           (dx + 1) + 3 * (dy + 1) + 9 * (dz + 1) for the one at offset (dx, dy, dz), each -1 to 1.
                           0: exactly those across the faces in seams, which always count as such. It tells apart the
                           vertices where seams meet in an edge or a corner, for who joins them; what
                           sgm_mesh_get_view shows does not depend on it in this version */
  uint32_t reserved[2]; /* 0 */
} sgm_chunk_request;

#define SGM_CHUNK_REQUEST_INIT   \
  {                              \
    {0, 0, 0, 0}, 0, 0, { 0, 0 } \
  }

/* Long work says how far it is: after every chunk, with done rising by one to total. Called on any thread, one call at
 * a time (work on other chunks goes on meanwhile, so it should be short); must not call back into the library. Returns
 * 0 to go on; anything else stops the work with SGM_ERR_CANCELLED, but for the last call (done == total): what is left
 * then, texture coordinates say, is finished. Chunks that have begun are finished first, and up to 64 are derived
 * before the first of them is meshed, so a stop is not at once. */
typedef int32_t (*sgm_progress_function)(void* user, uint64_t done, uint64_t total);

/* What meshes have beside their triangles. Worlds have flags of their own: sgm_world_flag. */
typedef enum sgm_meshing_flag {
  SGM_MESHING_TEXTURE = 1, /* texture coordinates and blends of materials: wedges, in views of meshes and of surfaces */
  SGM_MESHING_SHARP = 2,   /* crisp edges and corners: feature vertices from the field's gradients, once for each side
                              of their crease with that side's normal, at the same position. Where a surface
                              bends less than 26 degrees within a cell it keeps its triangles, and so does a cell
                              whose features would fold, cut or coincide. Chunks agree on their faces, as without;
                              seams join sharp chunks to sharp ones, so that all chunks of one surface are to be asked
                              for alike */
  SGM_MESHING_FLAG_FORCE_32_BIT = 0x7FFFFFFF
} sgm_meshing_flag;

typedef struct sgm_chunks_desc {
  uint32_t struct_size;
  const void* next;
  const sgm_chunk_request* requests;
  size_t request_stride;          /* bytes; 0: sizeof(sgm_chunk_request) */
  size_t count;                   /* requests, 1 to 2^20 */
  sgm_progress_function progress; /* or NULL */
  void* progress_user;
  uint32_t flags;    /* of sgm_meshing_flag, joined by | */
  uint32_t reserved; /* 0 */
} sgm_chunks_desc;

#define SGM_CHUNKS_DESC_INIT \
  { SGM_SIZEOF(sgm_chunks_desc), SGM_NULL, SGM_NULL, 0, 0, SGM_NULL, SGM_NULL, 0, 0 }

/* Meshes chunks; meshes[i] is the one of requests[i], an empty mesh where no surface crosses it. Blocks; uses the job
 * system. Give it many chunks at once. All or nothing: on every failure all desc->count entries of meshes are NULL,
 * except where meshes is NULL or desc itself is refused (NULL, SGM_ERR_STRUCT_SIZE, SGM_ERR_UNSUPPORTED), when nothing
 * is written. SGM_ERR_RANGE: a chunk does not lie inside the world wholly, or the cells of its level are larger than
 * 2^22 units. SGM_ERR_LIMIT: count is above 2^20, deriving a cell reached a cap of the language's (line and column say
 * where), or more than 2^20 cells of a layer reach into one chunk. */
SGM_API sgm_result sgm_mesh_chunks(sgm_field* field, const sgm_chunks_desc* desc, sgm_mesh** meshes, sgm_error* error);

/* One more owner, and one less. A mesh ends with its last owner; both then refuse it, as functions that end a handle
 * do. Both accept NULL. */
SGM_API sgm_result sgm_mesh_acquire(sgm_mesh* mesh);
SGM_API sgm_result sgm_mesh_release(sgm_mesh* mesh);

/* What a vertex stands for: one edge of a grid of samples that the surface crosses. Vertices are the same where their
 * edges are the same, in whatever chunks: each has a key, so that meshes are welded and checked without a tolerance.
 * The key is { corner, level, axis, fan }. With positions in units (which may be fractions of one) and levels' cells:
 *   own      level is the chunk's own; axis the one coordinate that is no multiple of its cell; corner the position
 *            rounded down to multiples of that cell; fan 0
 *   coarser  the same with level + 1 and its cell
 *   lateral  level is the chunk's own; axis 3; corner the position itself, a multiple of the cell of level + 1. fan
 *            tells apart the vertices of one corner, which joins seams that meet in an edge or a corner of the chunk:
 *            around the corner lie 8 blocks, one to an octant, and between octants that share a face 12 quarter planes,
 *            numbered 4 * (axis of the normal) + (high side on the lower of the other axes) + 2 * (on the higher one).
 *            Those with a block of the chunk's size on one side and a coarser chunk on the other carry seams, and seams
 *            that touch in a half axis from the corner share the vertex: fan is the lowest number of those joined to
 *            this vertex's own seam. Which blocks are coarser is what sgm_chunk_request.coarser says.
 *   feature  where sharp features were asked for: a point of an edge or a corner of the surface, in a face of the
 *            grid or in a cell. A body has it once for each side of its crease, a seam once: those with equal keys are
 *            one vertex. level is the chunk's own, or with bit 13 of kind, in seams alone, that above; axis is 7 in a
 *            cell (bit 14), else 4 + bits 6 and 7. fan is bits 6 to 9 in a cell, else bits 8 to 11. corner is, on each
 *            axis, the position rounded down to multiples of the level's cell, less (b - 1) of these cells, b being the
 *            two bits from 2 * axis: a feature may lie up to a cell beyond its face or cell, but no feature of a body
 *            lies beyond its chunk */
typedef enum sgm_vertex_kind {
  SGM_VERTEX_OWN = 0,          /* on an edge of the chunk's own level; every vertex of a body that is no feature */
  SGM_VERTEX_COARSER = 1,      /* on an edge of the level above; in seams alone */
  SGM_VERTEX_LATERAL = 2,      /* on a corner, joins the two levels; in seams alone */
  SGM_VERTEX_FEATURE = 0x8000, /* a bit: the others say which feature */
  SGM_VERTEX_KIND_FORCE_32_BIT = 0x7FFFFFFF
} sgm_vertex_kind;

/* A packed vertex, 16 bytes, the same on every backend. */
typedef struct sgm_vertex {
  int16_t x, y, z;            /* 0 to 8,192 in 1/256 of the chunk's cell edge, from the chunk's origin; of features
                                 of the coarser level -400 to 8,592 */
  uint16_t material;          /* index for sgm_grammar_material */
  int16_t normal_x, normal_y; /* octahedral, +-32,767: with n = normal / 32767 and w = 1 - |n.x| - |n.y|, the normal is
                                 (n.x, n.y, w) where w >= 0, else ((1 - |n.y|) * sign(n.x), (1 - |n.x|) * sign(n.y), w),
                                 then made one long; sign(0) is 1 */
  uint16_t tag;               /* index for sgm_grammar_tag */
  uint16_t kind;              /* an sgm_vertex_kind, with the bits of a feature */
} sgm_vertex;

/* The body of a chunk or one of its seams: draw the body always, and a seam where the neighbour across its face is one
 * level coarser. */
typedef struct sgm_mesh_range {
  uint32_t first_vertex, vertex_count;
  uint32_t first_index, index_count;
  uint64_t hash; /* of this range's vertices and triangles, equal on every machine */
} sgm_mesh_range;

/* Anchors of one kind and name in a mesh, behind each other: copies of one thing, for an engine that draws instances.
 */
typedef struct sgm_instance_batch {
  uint16_t kind, name;   /* indices for sgm_grammar_name */
  uint32_t first, count; /* of the mesh's anchors and transforms */
} sgm_instance_batch;

/* A vertex as one chart of a texture and one pair of materials sees it. Coordinates count tiles of 1 m, for textures
 * that repeat: u x v points out of the solid, so that nothing is mirrored. Whole tiles may be left out, so that floats
 * hold coordinates to a 4,096th wherever a shape lies: chunks that meet agree on coordinates up to whole tiles. They
 * agree on shares to the bit. A seam's vertices on edges of the coarser level are textured as the coarser chunks are,
 * but where the two levels have other shapes there. */
typedef struct sgm_wedge {
  uint32_t vertex; /* of the mesh's vertices */
  float u, v;
  uint16_t materials[2];   /* the two that its triangles show most of, rising; one alone stands twice. The same at all
                              corners of a triangle */
  uint8_t share;           /* of the second here, in 255ths: to blend by, over about two cells */
  uint8_t plane_shares[3]; /* where no shape has coordinates for the triangle, so that u and v are by the world's axes:
                              how much of three textures to show here (triplanar mapping), together 255; else all 0.
                              They lie across x at (-s z, y), across y at (s x, -z), across z at (s x, y), in metres
                              from the world's origin, s being the sign of the normal along that axis; u and v are those
                              of the axis that the triangle faces most */
} sgm_wedge;

/* Pointers into a mesh, good until the mesh ends. */
typedef struct sgm_mesh_view {
  uint32_t struct_size;
  void* next;
  sgm_chunk_key key;
  int32_t origin[3];     /* lowest corner, units */
  int32_t cell_units;    /* cell edge of this chunk: the field's << level */
  int32_t bounds_min[3]; /* holds every vertex, seams included, units; all 0 where there is none */
  int32_t bounds_max[3];
  const sgm_vertex* vertices;           /* body first, then the seams by face */
  const uint32_t* indices;              /* into vertices (not from the range's first), three a triangle */
  uint32_t vertex_count, vertex_stride; /* stride in bytes */
  uint32_t index_count, index_stride;
  sgm_mesh_range body;
  sgm_mesh_range seams[6];   /* by sgm_face; empty where not asked for */
  uint64_t hash;             /* of body and seams together */
  const sgm_anchor* anchors; /* in this chunk: low faces belong to it, high ones do not. By kind, name and key */
  uint32_t anchor_count, anchor_stride;
  const uint16_t* tags; /* tags that its vertices carry, rising, 0 left out */
  uint32_t tag_count;
  uint32_t batch_count;
  const sgm_instance_batch* batches; /* of the anchors */
  const float* transforms; /* 12 an anchor, row-major 3 x 4: from its own axes to the chunk's, metres from origin */
  const int16_t* morphs; /* 3 a vertex, in 1/256 of the chunk's cell edge, to +-1,024: from the vertex to the surface of
                            the next coarser level. NULL but in worlds with SGM_WORLD_MORPH. An engine that draws
                            vertices at position + b * morph and lets b rise from 0 to 1 before a chunk gives way to a
                            coarser one shows no pop. Chunks of a level give a vertex that they share the same offset,
                            and in seams those vertices have 0 that are the coarser level's or join the two. So nothing
                            opens where b depends on place and level alone, and is 0 where a chunk meets a finer one: it
                            rises from 0 at the near end of a level's range to 1 at its far end */
  const sgm_wedge* wedges; /* texture coordinates by the own axes of the shape that makes the surface: along and around
                              a passage, over the faces of a box; by the world's axes where no shape of the grammar
                              does. Where charts meet a vertex has several. NULL where there are none, or they were not
                              asked for: SGM_WORLD_TEXTURE, SGM_MESHING_TEXTURE */
  const uint32_t* wedge_indices; /* index_count of them, into wedges: of the same triangles as indices. An engine that
                                    draws textures draws wedges by these, each with its vertex's position and normal */
  uint32_t wedge_count, wedge_stride;
} sgm_mesh_view;

#define SGM_MESH_RANGE_INIT \
  { 0, 0, 0, 0, 0 }
#define SGM_MESH_VIEW_INIT                                                                                           \
  {                                                                                                                  \
    SGM_SIZEOF(sgm_mesh_view), SGM_NULL, {0, 0, 0, 0}, {0, 0, 0}, 0, {0, 0, 0}, {0, 0, 0}, SGM_NULL, SGM_NULL, 0, 0, \
        0, 0, SGM_MESH_RANGE_INIT, {SGM_MESH_RANGE_INIT, SGM_MESH_RANGE_INIT, SGM_MESH_RANGE_INIT,                   \
                                    SGM_MESH_RANGE_INIT, SGM_MESH_RANGE_INIT, SGM_MESH_RANGE_INIT},                  \
        0, SGM_NULL, 0, 0, SGM_NULL, 0, 0, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL, 0, 0                    \
  }

SGM_API sgm_result sgm_mesh_get_view(const sgm_mesh* mesh, sgm_mesh_view* view, sgm_error* error);

/* Copies into the caller's memory. Counts come in as the arrays' room (in elements) and go out as what the mesh has.
 * Either array may be NULL: it is not written, and its count only asks. SGM_INCOMPLETE: an array was too small; nothing
 * was written to that one. Counts must not be NULL. */
SGM_API sgm_result sgm_mesh_copy(const sgm_mesh* mesh, sgm_vertex* vertices, size_t vertex_stride, size_t* vertex_count,
                                 uint32_t* indices, size_t index_stride, size_t* index_count, sgm_error* error);

/* ------------------------------------------------------------------------------- surfaces: welded, for tools */

/* One mesh in floats, each vertex once: of a region of many chunks, or of a grid of the caller's. Immutable. */
typedef struct sgm_surface sgm_surface;

typedef struct sgm_region_desc {
  uint32_t struct_size;
  const void* next;
  int32_t minimum[3], maximum[3]; /* units, minimum < maximum; grown outward to whole chunks of the level */
  int32_t level;                  /* 0 to SGM_MAX_LEVEL */
  uint32_t flags;                 /* of sgm_meshing_flag, joined by | */
  uint64_t max_chunks;            /* SGM_ERR_LIMIT where the region has more; 0: 65,536; never more than 2^24 */
  sgm_progress_function progress; /* or NULL; counts chunks as they are meshed: what comes after is not counted */
  void* progress_user;
} sgm_region_desc;

#define SGM_REGION_DESC_INIT \
  { SGM_SIZEOF(sgm_region_desc), SGM_NULL, {0, 0, 0}, {0, 0, 0}, 0, 0, 0, SGM_NULL, SGM_NULL }

/* Meshes a region and welds its chunks by exact keys: no open edge inside the region, open only where its outer faces
 * cut the solid. Blocks; uses the job system. SGM_ERR_RANGE: the grown region leaves the world, or the cells of the
 * level are larger than 2^22 units. SGM_ERR_LIMIT: too many chunks, more vertices than 32-bit indices can name, or as
 * sgm_mesh_chunks. */
SGM_API sgm_result sgm_surface_from_region(sgm_field* field, const sgm_region_desc* desc, sgm_surface** out,
                                           sgm_error* error);

/* Samples that the caller has. Value (i, j, k) is values[i + j * stride_y + k * stride_z] and lies at (i, j, k) * cell.
 */
typedef struct sgm_grid_desc {
  uint32_t struct_size;
  const void* next;
  const float* values; /* a length like a distance, in the unit of `cell`, negative inside the solid; finite. Quantised
                          to cell / 1024 and clamped to +-4,096 cells, as fields are */
  uint32_t size[3];    /* samples on x, y, z: 2 to 16,384 each; 2^33 together */
  uint32_t reserved;   /* 0 */
  size_t stride_y;     /* in floats, at least size[0]; 0: size[0] */
  size_t stride_z;     /* in floats, at least size[1] * stride_y; 0: that */
  double cell;         /* edge of a cell, above 0, finite, any unit: positions come out in it */
  int32_t normals;     /* 1: normals from the grid's gradient (central differences, one-sided at the border); 0: none */
  int32_t reserved2;   /* 0 */
} sgm_grid_desc;

#define SGM_GRID_DESC_INIT \
  { SGM_SIZEOF(sgm_grid_desc), SGM_NULL, SGM_NULL, {0, 0, 0}, 0, 0, 0, 1.0, 1, 0 }

/* Meshes a grid of samples. Open only where the grid's border cuts the solid. Blocks; uses the job system. */
SGM_API sgm_result sgm_surface_from_grid(sgm_runtime* runtime, const sgm_grid_desc* desc, sgm_surface** out,
                                         sgm_error* error);

SGM_API sgm_result sgm_surface_destroy(sgm_surface* surface);

/* Pointers into a surface, good until it ends. */
typedef struct sgm_surface_view {
  uint32_t struct_size;
  void* next;
  int32_t origin[3];     /* units; positions count from here: the world's origin where the region lies within 4,096 m
                            of it, else the region's lowest corner. All 0 for a grid */
  int32_t cell_units;    /* cell edge; 0 for a grid */
  int32_t extent_min[3]; /* the region grown to whole chunks, units; all 0 for a grid */
  int32_t extent_max[3];
  uint64_t vertex_count, index_count;
  const float* positions;    /* 3 a vertex, metres from origin (a grid: in the unit of its cell) */
  const float* normals;      /* 3 a vertex, one long; NULL where not asked for */
  const uint16_t* materials; /* NULL for a grid */
  const uint16_t* tags;      /* NULL for a grid */
  const uint32_t* indices;   /* three a triangle */
  uint32_t position_stride, normal_stride, material_stride, tag_stride; /* bytes */
  float bounds_min[3], bounds_max[3]; /* of the positions; all 0 where there is none */
  uint64_t chunk_count;               /* chunks meshed; 1 for a grid */
  const sgm_wedge* wedges; /* texture coordinates and blends of materials, as sgm_mesh_view.wedges says, in one system
                              for the whole region. NULL where SGM_MESHING_TEXTURE was not asked for */
  const uint32_t* wedge_indices; /* index_count of them, into wedges: of the same triangles as indices */
  uint64_t wedge_count;
  uint32_t wedge_stride; /* bytes */
  uint32_t reserved;     /* 0 */
} sgm_surface_view;

#define SGM_SURFACE_VIEW_INIT                                                                                       \
  {                                                                                                                 \
    SGM_SIZEOF(sgm_surface_view), SGM_NULL, {0, 0, 0}, 0, {0, 0, 0}, {0, 0, 0}, 0, 0, SGM_NULL, SGM_NULL, SGM_NULL, \
        SGM_NULL, SGM_NULL, 0, 0, 0, 0, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0, SGM_NULL, SGM_NULL, 0, 0, 0      \
  }

SGM_API sgm_result sgm_surface_get_view(const sgm_surface* surface, sgm_surface_view* view, sgm_error* error);

/* Of a region: the hash of the set of its chunks' meshes, equal on every machine and in any order of work. Of a grid:
 * of its positions, normals and triangles, worked out at each call. 0 for NULL. */
SGM_API uint64_t sgm_surface_hash(const sgm_surface* surface);

/* ----------------------------------------------------------------------------- voids: is there a way from A to B? */

/* Whether an agent, a ball, comes from one place to another through the void of a region, and how. What counts is the
 * samples of level 0, a cell apart: one is free for the agent where no solid sample is as near as its radius or nearer;
 * with radius 0 all of the void is free. Free samples join along the axes and across the diagonals of faces, as meshes
 * join their voids. So a way stands for the ball to within cells: between two of its places solid samples may be nearer
 * by 0.71 cells, and the surface lies up to 1.74 cells before them, as a rule less than one. A place stands for the
 * nearest of the eight samples around it that are void; with none it lies in rock. */

typedef enum sgm_way_verdict {
  SGM_WAY_FOUND = 0,
  SGM_WAY_FROM_IN_ROCK = 1,
  SGM_WAY_TO_IN_ROCK = 2,
  SGM_WAY_FROM_TOO_NARROW = 3, /* `from` is in the void, but the agent does not fit there */
  SGM_WAY_TO_TOO_NARROW = 4,
  SGM_WAY_APART = 5, /* the agent fits at both, and there is no way between them in the region */
  SGM_WAY_VERDICT_FORCE_32_BIT = 0x7FFFFFFF
} sgm_way_verdict;

typedef enum sgm_way_flag {
  SGM_WAY_WIDEST = 1, /* also find how large an agent may be: takes up to three times as long */
  SGM_WAY_FLAG_FORCE_32_BIT = 0x7FFFFFFF
} sgm_way_flag;

typedef struct sgm_way_desc {
  uint32_t struct_size;
  const void* next;
  double from[3], to[3];          /* positions: units (metres times SGM_UNITS_PER_METRE), not metres as `radius` is; in
                                     the region */
  int32_t minimum[3], maximum[3]; /* units, minimum < maximum; the region, grown outward to whole chunks. Ways do not
                                     leave it; what is solid beyond it counts, so that with one chunk around it, it must
                                     lie in the world */
  double radius;                  /* of the agent, metres: 0 to less than 32 cells */
  uint32_t flags;                 /* of sgm_way_flag, joined by | */
  uint32_t reserved;              /* 0 */
  uint64_t max_chunks;            /* SGM_ERR_LIMIT where the region has more; 0: 65,536; never more than 2^24 */
  int32_t* places;                /* takes the way's places, x y z each, in units; or NULL */
  size_t place_room;              /* places that it has room for */
  sgm_progress_function progress; /* or NULL; counts chunks: of the region, from 1 on again each time that it is looked
                                     at; and of the way, where there is one, from 1 on with a total of its own */
  void* progress_user;
} sgm_way_desc;

#define SGM_WAY_DESC_INIT                                                                                     \
  {                                                                                                           \
    SGM_SIZEOF(sgm_way_desc), SGM_NULL, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0, 0, 0}, {0, 0, 0}, 0.3, 0, 0, 0, \
        SGM_NULL, 0, SGM_NULL, SGM_NULL                                                                       \
  }

/* Filled by sgm_field_find_way. Lengths in metres, volumes in cubic metres. */
typedef struct sgm_way {
  uint32_t struct_size;
  void* next;
  int32_t verdict;       /* an sgm_way_verdict */
  uint32_t reserved;     /* 0 */
  uint64_t place_count;  /* of the way; 0 where there is none */
  double length;         /* of the way */
  double from_clearance; /* from each end's sample to the nearest solid one, at most 32 cells; 0 in rock. As a radius
                            it is the least that does not fit there */
  double to_clearance;
  double widest;      /* with SGM_WAY_WIDEST, else 0: there is a way for every radius below this, and for none from
                         it on, itself included; 32 cells stand for all that is larger; 0: for no agent at all */
  double from_volume; /* of the voids that the ends lie in, for this radius; 0 where an end is not free */
  double to_volume;
  double largest_volume; /* of the region's voids */
  uint64_t void_count;   /* separate voids of the region, for this radius */
  uint64_t sealed_count; /* of those the ones that do not touch the region's border */
} sgm_way;

#define SGM_WAY_INIT \
  { SGM_SIZEOF(sgm_way), SGM_NULL, 0, 0, 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0, 0 }

/* The way's places are samples of level 0, the next always joined with the one before, from the sample of `from` to
 * that of `to`: a short way, though not always the shortest. The region is looked at across its longest axis. Memory:
 * of about two layers of chunks across that axis, with one chunk around them, the signs of the samples (8.7 KB a chunk
 * that the surface crosses); of one layer the faces (2.2 KB each that a void touches, 17 times that with
 * SGM_WAY_WIDEST); of the whole region some 300 bytes for each void of each chunk (450 with SGM_WAY_WIDEST), and what
 * the field keeps of what it derived; of the way 12 bytes a place and up to 300 a chunk, and up to 20 MB while it is
 * walked. The same answer on every machine and with any number of threads. Blocks; uses the job system. SGM_OK also
 * where there is no way: the verdict says why. SGM_INCOMPLETE: the places did not all fit; the first ones were written.
 * SGM_ERR_RANGE: the region, with one chunk around it, leaves the world. On failure `out` stays as it was. */
SGM_API sgm_result sgm_field_find_way(sgm_field* field, const sgm_way_desc* desc, sgm_way* out, sgm_error* error);

/* ------------------------------------------------------------------------------------------ measures: of any mesh */

/* The histogram of bends along edges, section 7.4 of the paper: an edge from V1 to V2 with outward unit normals n1, n2
 * has d = acos(e.n2) - acos(e.n1), below 0 where the surface is convex. Normals are those of the welded triangles,
 * averaged at each point by area. */
typedef enum sgm_histogram_mode {
  SGM_HISTOGRAM_CORRECTED = 0, /* v = 1/2 - d / (2 pi): flat at 1/2, convex above */
  SGM_HISTOGRAM_PRINTED = 1,   /* v = d / (2 (pi + 1)), as equation 13 has it: bins of number 0 and less are many */
  SGM_HISTOGRAM_CURVATURE = 2, /* v = 1/2 - atan(L d / |e|) / pi: does not narrow as the mesh becomes finer */
  SGM_HISTOGRAM_MODE_FORCE_32_BIT = 0x7FFFFFFF
} sgm_histogram_mode;

typedef enum sgm_measure_flag {
  SGM_MEASURE_UNIQUE_EDGES = 1,          /* the histogram counts each edge once, not once a triangle as the paper */
  SGM_MEASURE_NO_SELF_INTERSECTIONS = 2, /* they are about half of the work */
  SGM_MEASURE_FLAG_FORCE_32_BIT = 0x7FFFFFFF
} sgm_measure_flag;

/* Triangles of the caller's, in any unit: areas come in its square, volumes in its cube. */
typedef struct sgm_measure_desc {
  uint32_t struct_size;
  const void* next;
  const float* positions;         /* three a point; or NULL, and positions_double. May be infinite or not a number */
  const double* positions_double; /* three a point; or NULL, and positions */
  uint64_t position_count;        /* at most 2^32 - 1 */
  uint64_t position_stride;       /* bytes from one point to the next; 0: three numbers */
  const uint32_t* indices;        /* three a triangle, counter-clockwise seen from outside, below position_count */
  uint64_t index_count;           /* a multiple of 3, at most 2^32 - 1 */
  double weld;                    /* points at most so far apart are one; 0: those with equal coordinates. Finite */
  double cubes;                   /* edge of the cubes that are counted (equation 8); 0: none are */
  int32_t histogram_mode;         /* sgm_histogram_mode */
  uint32_t histogram_bins;        /* R: 1 to 4,096; an odd number keeps flat edges in one bin */
  double curvature_length;        /* L, above 0: a ball of that radius is at 3/4 */
  uint32_t flags;                 /* of sgm_measure_flag, joined by | */
  uint32_t histogram_capacity;    /* elements of histogram */
  double* histogram;              /* or NULL: the shares of the edges by bin, from histogram_first on */
} sgm_measure_desc;

#define SGM_MEASURE_DESC_INIT                                                                                         \
  {                                                                                                                   \
    SGM_SIZEOF(sgm_measure_desc), SGM_NULL, SGM_NULL, SGM_NULL, 0, 0, SGM_NULL, 0, 0.0, 0.0, SGM_HISTOGRAM_CORRECTED, \
        33, 1.0, 0, 0, SGM_NULL                                                                                       \
  }

typedef struct sgm_measures {
  uint32_t struct_size;
  void* next;
  int32_t watertight; /* 1: every edge has two triangles that go along it in opposite directions, every point one fan,
                         and no triangle is there twice or has a corner twice; also without any triangle */
  int32_t valid;      /* 1: and it faces outward, covers nothing twice, no triangle is without area or (where that was
                         looked for) cuts another, and all of it was looked at */
  uint64_t triangles, points;
  uint64_t welded_points;        /* that fell on others */
  uint64_t non_finite_triangles; /* with a corner beyond 1e37 or not a number: left out of all that follows */
  double area;                   /* equation 7 */
  double volume;                 /* by the divergence theorem, about the middle of the bounds: of a closed mesh */
  double area_vector[3];         /* 0 for a closed mesh, up to rounding */
  double bounds_min[3], bounds_max[3];
  uint64_t objects; /* section 7.3: connected through points */
  uint64_t shells;  /* connected across edges */
  int64_t euler;    /* Euler characteristic, summed over shells; a point of several fans counts once in each */
  int64_t genus;    /* likewise; -1 where a shell is no manifold, or has one side alone */
  uint64_t edges, open_edges;    /* open: of one triangle alone */
  uint64_t turned_edges;         /* whose triangles face different ways */
  uint64_t nonmanifold_edges;    /* of three triangles or more */
  uint64_t nonmanifold_vertices; /* that hang several fans together */
  uint64_t degenerate_triangles; /* with two corners in one place; flat_triangles are without area too */
  uint64_t duplicate_triangles;
  uint64_t sliver_triangles;           /* 4 sqrt(3) area / (sum of squared edges) below 0.05 */
  uint64_t inside_out_shells;          /* closed, facing inward, in no solid */
  uint64_t cavity_shells;              /* closed, facing inward, in a solid */
  uint64_t nested_shells;              /* closed, facing outward, in a solid: what they hold counts twice */
  uint64_t self_intersections;         /* pairs of triangles that meet beside common corners and edges, exactly, but for
                                          folded_triangles; at least so many where the next is 0 */
  int32_t self_intersections_complete; /* 0: not looked for, or too many lie close together: there may be more */
  int32_t histogram_first;             /* number of the first bin by equation 14: 1, in mode PRINTED less */
  uint64_t histogram_bins;             /* that there are; SGM_INCOMPLETE where histogram_capacity is less */
  uint64_t histogram_edges;            /* counted */
  uint64_t histogram_left_out;         /* without length or normal */
  double flat, convex, concave;        /* shares of the edges */
  /* Equation 8: volume by all corners, by any corner, by the centre. 0 where cubes were not asked for. */
  double cubes_all, cubes_any, cubes_centre;
  uint64_t flat_triangles;   /* whose corners are three places on a line, exactly */
  uint64_t folded_triangles; /* pairs that share an edge and lie upon each other, exactly; as self_intersections */
} sgm_measures;

#define SGM_MEASURES_INIT                                                                                              \
  {                                                                                                                    \
    SGM_SIZEOF(sgm_measures), SGM_NULL, 0, 0, 0, 0, 0, 0, 0.0, 0.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, \
        0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0, 0              \
  }

/* Measures any mesh, and judges whether it is the closed surface of a solid. Blocks; uses the job system; the same
 * numbers for any number of threads. Takes some 200 bytes a triangle of a closed mesh from the runtime's allocator
 * while it works, and 500 where triangles share no points. Exact for coordinates that are 0 or of 1e-70 to 1e37.
 * Whatever is wrong with the mesh is in `out`, not an error. SGM_INCOMPLETE: the histogram holds what fits, all else is
 * whole. SGM_ERR_INVALID_ARGUMENT also for an index that is not below position_count. SGM_ERR_LIMIT: more than 2^30
 * cubes, or triangles over more than 2^27 columns of them. */
SGM_API sgm_result sgm_measure(sgm_runtime* runtime, const sgm_measure_desc* desc, sgm_measures* out, sgm_error* error);

/* ---------------------------------------------------------------------------------------------- volumes: density */

/* For a renderer of fog: clouds, smoke, whatever a grammar with `output density` (sgm_domain_info) describes.
 * shaders/volume has one that works, and says which papers it follows. */

typedef enum sgm_density_format {
  SGM_DENSITY_UNORM8 = 0, /* uint8_t, to the nearest 255th, as textures of the format R8_UNORM hold it */
  SGM_DENSITY_FLOAT32 = 1,
  SGM_DENSITY_FORMAT_FORCE_32_BIT = 0x7FFFFFFF
} sgm_density_format;

/* The points origin + spacing * (x, y, z), 0 <= x < size[0] and so on: the texels of a 3D texture, each at its centre.
 * Volumes side by side that share their last and first points are one to a linear filter.
 * Density is 0 exactly where sgm_sample_desc.q is not below 0, so that a mesh of the same level stands where it begins;
 * from there it rises with depth and never falls. With t = the depth, -q in units, by the edge: 2 t^2 up to t = 1/2,
 * then 1 - 2 (1 - t)^2, then 1 from t = 1 on (shaders/common/density.h). Depth is what the field says: a distance near
 * a surface. A host's field with a steepness counts as deep as can be from 16 m on, or from two cells where these are
 * more. */
typedef struct sgm_density_desc {
  uint32_t struct_size;
  const void* next;
  int32_t origin[3];         /* units */
  int32_t spacing;           /* units, at least 1: from point to point on each axis */
  uint32_t size[3];          /* points on x, y, z: 1 to 16,384 each; 2^33 together */
  int32_t level;             /* 0 to SGM_MAX_LEVEL, for a world 0: what coarse chunks leave out is left out here too.
                                For a volume far away, one whose cells are about as large as the spacing */
  double edge;               /* metres from the surface to density 1, from a unit to 4,096 cells of level 0. 0: the
                                grammar's own (sgm_domain_info.density_edge; 10 m where it has none) */
  sgm_density_format format; /* of values */
  uint32_t reserved;         /* 0 */
  void* values;              /* the first point's; x by x, then y by y, then z by z */
  size_t row_pitch;          /* bytes from (x, y, z) to (x, y + 1, z), as a texture's upload wants it: a multiple of the
                                value's size, at least size[0] of them; 0: that */
  size_t slice_pitch;        /* bytes from (x, y, z) to (x, y, z + 1): likewise, at least size[1] * row_pitch;
                                0: that */
  sgm_progress_function progress; /* or NULL. Told of blocks of 32^3 points (8^3 where the field has hosts) */
  void* progress_user;
} sgm_density_desc;

#define SGM_DENSITY_DESC_INIT                                                                                         \
  {                                                                                                                   \
    SGM_SIZEOF(sgm_density_desc), SGM_NULL, {0, 0, 0}, SGM_UNITS_PER_METRE, {0, 0, 0}, 0, 0.0, SGM_DENSITY_UNORM8, 0, \
        SGM_NULL, 0, 0, SGM_NULL, SGM_NULL                                                                            \
  }

/* Samples the density at points of a lattice, of any grammar. Blocks; uses the job system, and not the field's backend.
 * The same values on every machine, however a lattice is cut into volumes; what lies between the rows is not written.
 * On failure the array holds anything. SGM_ERR_RANGE: a point outside of the world, or as sgm_field_sample.
 * SGM_ERR_LIMIT: as sgm_field_sample. SGM_ERR_CANCELLED: progress asked for it. */
SGM_API sgm_result sgm_field_sample_density(sgm_field* field, const sgm_density_desc* desc, sgm_error* error);

/* ---------------------------------------------------------------------------------------------- worlds: streaming */

/* A field, streamed: chunks of every level of detail around moving viewers, meshed on the job system and handed over
 * frame by frame. What is drawn is one closed surface at all times: where detail meets coarser detail a seam joins
 * them, the outer faces are closed against the domain's own state (solid or void), and what is drawn stays until
 * everything that replaces it is there.
 *
 * A frame of the engine
 *   sgm_world_set_viewers     where the cameras are
 *   sgm_world_update          takes over what is finished, has more work begun; never waits
 *   sgm_world_poll            what has changed, until it is empty; then draw
 *
 * Worlds can be dug and built on (sgm_world_edit). A frame shows one state of the edits, closed: a dig is drawn with
 * the next frame of changes or the one after it. */
typedef struct sgm_world sgm_world;
/* What a physics engine collides with in one chunk: immutable, counted by reference. */
typedef struct sgm_collider sgm_collider;

typedef enum sgm_world_flag {
  SGM_WORLD_BY_DISTANCE = 1, /* level 0 wherever it is near enough. Without this flag only where a viewer's void leads
                                to: what is near but behind rock stays one level coarser, and is never seen */
  SGM_WORLD_MORPH = 2,       /* meshes have morph offsets: sgm_mesh_view.morphs */
  SGM_WORLD_RESIDENT = 4,    /* meshes also lie on the device that the engine lent, which draws them from there:
                                sgm_vulkan.h, sgm_cuda.h. That memory, about as much again, on Vulkan in blocks of 64 MiB
                                and more, counts for mesh_bytes of what was lent, and not for the world's */
  SGM_WORLD_TEXTURE = 8,     /* meshes have texture coordinates: sgm_mesh_view.wedges. About twice the memory a mesh, in
                                mesh_bytes; not on the device */
  SGM_WORLD_SHARP = 16, /* crisp edges and corners: as SGM_MESHING_SHARP, at every level, closed in every frame. A chunk
                           takes longer: hardly in a cave, up to seven times as long where edges are everywhere, and
                           ten times on noise as fine as the cells. Twice the room is set aside for each that is in work */
  SGM_WORLD_MEASURE = 32, /* every chunk is measured as soon as it is meshed or read from cache_folder, in the same job:
                             sgm_world_get_measures, sgm_mesh_get_measures. On the CPU that takes 2 to 12 % of the time
                             of meshing; on a GPU's chunks as long, which is more of what a GPU takes */
  SGM_WORLD_FLAG_FORCE_32_BIT = 0x7FFFFFFF
} sgm_world_flag;

typedef struct sgm_world_desc {
  uint32_t struct_size;
  const void* next;
  int32_t top_level; /* coarsest level, 0 to SGM_MAX_LEVEL. Its chunks surround what is drawn, so a chunk of it should
                        not be much larger than view_distance */
  uint32_t flags;    /* of sgm_world_flag, joined by | */
  double finest_distance;   /* metres from a viewer within which level 0 is drawn; each coarser level reaches twice as
                               far. With a screen of h pixels and a vertical field of view v a cell then looks no larger
                               than p = 2 * cell * h / (2 tan(v / 2)) / finest_distance pixels. Where a layer's
                               `detail` leaves out a passage of a width w this ends in a wall of p * w / c pixels at
                               most, c being the edge of the first cell that is wider than the detail. All of this in
                               the middle of the picture of a viewer of weight 1, one of no more than can be planned
                               for, in a world that is idle, where no chunk has failed and the statistics' detail
                               is 1 */
  double view_distance;     /* metres within which something is drawn, above 0 */
  uint64_t mesh_bytes;      /* the most bytes of meshes at one time, those that the engine holds and those in work
                               included, of the chunks' colliders, and of what is remembered of chunks: a hard cap. Where
                               it does not suffice detail is drawn nearer. 0: 256 MiB */
  double collider_distance; /* metres from a viewer within which chunks have a collider: of what is drawn there, at
                               whatever level; 0: none has one */
  const char* journal;      /* UTF-8 path of the file that keeps the edits; made where there is none. A process that is
                               killed, at any moment, loses the last second's edits at most, as long as it calls
                               sgm_world_update; sgm_world_flush_edits writes them at once. NULL: they are not kept */
  const char* cache_folder; /* UTF-8 path of a folder that keeps meshed chunks from one run to the next, for any number
                               of worlds and processes at one time; made where there is none. What the grammar, its
                               parameters, the seed, the host's fields, an edit or this library's version change is
                               meshed anew, as is what is damaged. NULL: none is kept */
  uint64_t cache_bytes;     /* the most bytes of its files; 0: 1 GiB */
  uint64_t author; /* whose edits are made here: in worlds that exchange edits no two may have the same, nor may
                      a number be used again where edits may have been lost. 0: drawn at random */
  const char* const* stores; /* Worlds that were baked (sgm bake): UTF-8 paths of folders, or http:// and https://
                                addresses of such folders on any web server with range requests, read through libcurl;
                                NULL where there are none. They are looked into in their order, folders first, before
                                cache_folder, but after it where one is on a server; what came from there is then kept
                                in cache_folder. Chunks that a store has of this world (grammar, parameters, seed,
                                cells, SGM_WORLD_SHARP, the library's meshing) are read instead of being derived, with
                                the same bytes; edits lie on top. What it does not have, or is damaged there, is
                                derived: damage is told to the log the first time, and so is a store that has nothing
                                of this world. Servers are first asked when chunks are wanted, on four threads of the
                                world's own, which also submit jobs. No job waits for a server, nor does the engine but
                                to destroy the world, a second at most; a chunk that has not come 0.2 s after its turn
                                is derived, and where a server keeps all threads for so long, so are all others. What
                                was found and not used yet, 64 chunks at most, counts beside mesh_bytes.
                                One that does not answer is told to the log and left alone for a while; so is the world
                                derived where there is no libcurl. 32 MiB of what each sent are kept in memory */
  uint32_t store_count;
  uint32_t max_colliders; /* the most COLLIDER events of one update, the nearest first: a physics engine takes its time
                             for each. 0: 4 */
} sgm_world_desc;

#define SGM_WORLD_DESC_INIT \
  { SGM_SIZEOF(sgm_world_desc), SGM_NULL, 8, 0, 24.0, 1000.0, 0, 0.0, SGM_NULL, SGM_NULL, 0, 0, SGM_NULL, 0, 0 }

/* Reads the journal; what is wrong with it and could be mended is told to the log. SGM_ERR_LIMIT: mesh_bytes is too
 * small to stream with, or the distances take more chunks than can be planned for (the message says what would do); the
 * journal is in use, or too large. SGM_ERR_RANGE: the cells of top_level are larger than 2^22 units.
 * SGM_ERR_INVALID_ARGUMENT: top_level, or a distance that is not finite and above 0 (collider_distance: below 0); a
 * journal, a cache_folder or a store with a host's field whose identity is 0.
 * SGM_ERR_DATA: the journal is of another world (grammar, parameters, seed, cell, host's fields), or none: it stays as
 * it is; a folder is no store, or one of another version.
 * SGM_ERR_IO: the journal or the folder can be neither read nor made. SGM_ERR_UNSUPPORTED: built without a disk cache;
 * SGM_WORLD_RESIDENT, and the field's backend is not on a lent device. */
SGM_API sgm_result sgm_world_create(sgm_field* field, const sgm_world_desc* desc, sgm_world** out, sgm_error* error);

/* Waits for the world's running jobs, each a plan, a chunk or a batch, and writes the journal. It starts no other job of
 * this world; plans of other worlds may start. Meshes stay valid until the engine releases them. */
SGM_API sgm_result sgm_world_destroy(sgm_world* world);

/* A camera, or anything else that the world is there for. */
typedef struct sgm_viewer {
  double position[3]; /* metres, inside the world */
  float direction[3]; /* where it looks, of any length: that comes first. All 0: everywhere */
  float velocity[3];  /* metres a second, at most 10,000: where it will be in half a second is streamed too */
  float fov;          /* vertical field of view in radians, to 3: a narrower one sees detail from farther away. 0: 70
                         degrees, which the world's distances hold for */
  float weight;       /* 0.01 to 100: factor on the world's distances for this viewer, as far as can be planned for */
} sgm_viewer;

#define SGM_VIEWER_INIT \
  { {0.0, 0.0, 0.0}, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0.0f, 1.0f }

/* Replaces all viewers. With none (count 0) what is drawn stays and nothing is meshed. SGM_ERR_INVALID_ARGUMENT: a
 * value that is not finite, or out of its range; SGM_ERR_RANGE: a viewer outside the world, or too fast; SGM_ERR_LIMIT:
 * more than 256. On failure the viewers are as before. Never waits. */
SGM_API sgm_result sgm_world_set_viewers(sgm_world* world, const sgm_viewer* viewers, size_t viewer_stride,
                                         size_t count, sgm_error* error);

/* Takes over what is finished and has more work begun, on the job system. Waits for no job and no device (where the job
 * system refuses a job that job runs here, at once). At most max_bytes of vertices and indices are handed over; a frame
 * with more comes over several updates, and what is drawn changes with the last of them. A small max_bytes delays, and
 * loses nothing: a mesh that does not fit is handed over as the first of an update, and what it has too much is taken
 * off the updates that follow. So any k updates hand over at most the sum of their max_bytes and one mesh. All worlds
 * of a runtime plan in turn, in a quarter of the workers' time while there is enough to mesh: to update more often, or
 * more worlds, does not keep the workers from meshing. SGM_INCOMPLETE, and nothing changes: events of the previous
 * update have not all been polled. SGM_ERR_INVALID_ARGUMENT: max_bytes is 0. */
SGM_API sgm_result sgm_world_update(sgm_world* world, uint64_t max_bytes, sgm_error* error);

typedef enum sgm_event_kind {
  SGM_EVENT_READY = 0,    /* take over `mesh`: it belongs to the engine now, which releases it. Not drawn yet */
  SGM_EVENT_SHOWN = 1,    /* draw the chunk: the body of its mesh, and those of its seams that `seams` names */
  SGM_EVENT_REPLACED = 2, /* draw the mesh that was READY last instead of the one before. Where its body's hash is equal
                             the body's bytes are the same, at the same place: seams were added or, after another field
                             was set, anchors, morph offsets or texture coordinates are others */
  SGM_EVENT_SEAMS = 3,    /* draw other seams of the same mesh; or nothing has changed but `coarser` */
  SGM_EVENT_REMOVED = 4,  /* draw it no more; release its meshes. Also for a mesh that was READY and never shown */
  SGM_EVENT_FAILED = 5,   /* the chunk cannot be made; `result` says why and the log tells more. What is coarser stays
                             in its place. Where edits had changed it, the world is drawn as before them until a
                             further edit, an undo for instance; where another field had, as before that field */
  SGM_EVENT_COLLIDER = 6, /* collide with `collider` instead of the chunk's earlier one: it belongs to the engine now,
                             which releases it. Comes soon after what is drawn there has changed, at most
                             sgm_world_desc.max_colliders an update, and not for a collider equal to the earlier one;
                             not counted in max_bytes */
  SGM_EVENT_COLLIDER_REMOVED = 7, /* collide with the chunk no more. Where chunks of another level take its place, it
                                     comes once these have their colliders */
  SGM_EVENT_KIND_FORCE_32_BIT = 0x7FFFFFFF
} sgm_event_kind;

/* One change. Chunks without triangles and anchors are never told of; those of anchors alone have a mesh without
 * triangles. */
typedef struct sgm_world_event {
  sgm_event_kind kind;
  sgm_result result; /* of FAILED; else SGM_OK */
  sgm_chunk_key key;
  sgm_mesh* mesh;         /* of READY; else NULL */
  sgm_collider* collider; /* of COLLIDER; else NULL */
  uint32_t seams;         /* of SHOWN, REPLACED and SEAMS: mask of sgm_face */
  uint32_t coarser; /* likewise: the blocks around that belong to coarser chunks, as sgm_chunk_request.coarser; 0 where
                       no seam is drawn */
  uint64_t frame;   /* number of the frame that it belongs to; 0 for READY, FAILED and those of colliders */
} sgm_world_event;

/* The next events, in order. *count takes the array's room and returns how many were written; 0 when none is left. All
 * changes of a frame come between two updates: draw only when all are polled. On failure nothing was delivered, and
 * *count is 0: the event that could not be (out of memory) comes first the next time. */
SGM_API sgm_result sgm_world_poll(sgm_world* world, sgm_world_event* events, size_t event_stride, size_t* count,
                                  sgm_error* error);

/* One more owner, and one less. A collider ends with its last owner; both then refuse it, as functions that end a
 * handle do. Both accept NULL. */
SGM_API sgm_result sgm_collider_acquire(sgm_collider* collider);
SGM_API sgm_result sgm_collider_release(sgm_collider* collider);

/* Pointers into a collider, good until it ends. Its triangles are those of the chunk's body and of the seams that are
 * drawn, without those that have no area; colliders of neighbours meet exactly. */
typedef struct sgm_collider_view {
  uint32_t struct_size;
  void* next;
  sgm_chunk_key key;
  int32_t origin[3]; /* of the chunk, units: positions count from here */
  uint32_t vertex_count;
  uint32_t index_count;
  const float* positions;    /* 3 a vertex, metres */
  const uint32_t* indices;   /* three a triangle, counter-clockwise seen from the void */
  const uint16_t* materials; /* one a triangle: index for sgm_grammar_material */
  uint64_t hash;             /* of the three arrays: equal where a chunk's colliders are, in every run */
} sgm_collider_view;

#define SGM_COLLIDER_VIEW_INIT \
  { SGM_SIZEOF(sgm_collider_view), SGM_NULL, {0, 0, 0, 0}, {0, 0, 0}, 0, 0, SGM_NULL, SGM_NULL, SGM_NULL, 0 }

SGM_API sgm_result sgm_collider_get_view(const sgm_collider* collider, sgm_collider_view* view, sgm_error* error);

/* A chunk that is drawn, and has triangles or anchors. */
typedef struct sgm_drawn_chunk {
  sgm_chunk_key key;
  sgm_mesh* mesh; /* one more owner: release it */
  uint32_t seams, coarser;
} sgm_drawn_chunk;

/* Everything that is drawn, by key: for who comes later than its events. *count takes the array's room and returns how
 * many there are. chunks may be NULL: then only that is asked. SGM_INCOMPLETE: they did not all fit; nothing was
 * written. */
SGM_API sgm_result sgm_world_get_drawn(sgm_world* world, sgm_drawn_chunk* chunks, size_t chunk_stride, size_t* count,
                                       sgm_error* error);

/* Blocks until everything that the viewers want is drawn, as far as it can be made (SGM_EVENT_FAILED and the
 * statistics' chunks_failed tell of the rest): for loading screens, tools and tests. Works along. Updates without a
 * limit of bytes meanwhile, so that events gather, to be polled after. progress (or NULL) is told now and then how many
 * chunks are meshed of those known to be wanted; what it returns other than 0 ends the wait with SGM_ERR_CANCELLED.
 * SGM_ERR_LIMIT: memory does not suffice. */
SGM_API sgm_result sgm_world_wait_idle(sgm_world* world, sgm_progress_function progress, void* progress_user,
                                       sgm_error* error);

/* Puts another field in the place of the world's own: with other parameters, or of a grammar that was edited (hot
 * reload), or with other fields of the engine's. What differs is found on the jobs; only chunks that it reaches are
 * meshed again (sgm_world_stats.chunks_outdated counts them), and all of them are drawn in one frame of changes. Never
 * waits, so that a parameter can be set ten times a second: fields that come faster than they can be drawn are passed
 * over, but for the last, and half of the jobs' time stays with what the viewers come to see. While there are no
 * viewers it waits for its turn. Where a chunk of it cannot be made (SGM_EVENT_FAILED) the world goes back to the field
 * before.
 *
 * sgm_world_stats.field_drawn tells which of the fields that were set is drawn: until then the names of materials, tags
 * and anchors are those of the grammar before. Edits stay, and their materials and tags keep their numbers; one that
 * the new grammar does not have has no name there. The world keeps the backend that it was created with, and the field
 * for as long as it needs it; up to five may live at one time, each with a cache (sgm_field_desc.cache_bytes) that
 * shares what they derive alike. What the engine's own fields need must live as long as the world, which may go back,
 * and what they sample must not change under one identity; those of identity 0 count as changed.
 *
 * A journal is of the field that the world was created with: create it with the same one again, then set the other. The
 * disk cache keeps chunks of every field: give a world none whose parameters are driven all the time.
 *
 * SGM_ERR_INVALID_ARGUMENT: a field of another runtime or with other cell_units; one of identity 0 where the world
 * keeps anything on disk. */
SGM_API sgm_result sgm_world_set_field(sgm_world* world, sgm_field* field, sgm_error* error);

/* Drops everything that waits to be meshed; what is being meshed is dropped when it comes back. What is drawn stays.
 * The next update begins anew for the viewers there are: take them away first to stop. */
SGM_API void sgm_world_cancel(sgm_world* world);

typedef enum sgm_brush_shape {
  SGM_BRUSH_SPHERE = 0,
  SGM_BRUSH_BOX = 1,
  SGM_BRUSH_CAPSULE = 2,
  SGM_BRUSH_SHAPE_FORCE_32_BIT = 0x7FFFFFFF
} sgm_brush_shape;

/* What is dug away or built on. Whole units, so that it is the same on every machine; each length 1 to 2^20. What a
 * shape does not use may be anything. */
typedef struct sgm_brush {
  sgm_brush_shape shape;
  int32_t cut;       /* 1: takes its shape away; 0: adds it */
  uint16_t material; /* index for sgm_grammar_material. 0: a cut leaves what it was cut into, an add has the default */
  uint16_t tag;      /* index for sgm_grammar_tag; likewise */
  int32_t from[3];   /* centre of a sphere or a box, one end of a capsule */
  int32_t to[3];     /* other end of a capsule */
  int32_t half[3];   /* half extents of a box along its own axes */
  float turn[4];     /* quaternion x y z w, of any length, that turns a box's axes to the world's */
  int32_t radius;    /* of a sphere or a capsule */
  int32_t smooth;    /* width of the blend with what is there; 0: none */
} sgm_brush;

#define SGM_BRUSH_INIT \
  { SGM_BRUSH_SPHERE, 1, 0, 0, {0, 0, 0}, {0, 0, 0}, {1024, 1024, 1024}, {0.0f, 0.0f, 0.0f, 1.0f}, 1024, 0 }

/* Names an edit in all worlds that exchange theirs. Both 0 name none. */
typedef struct sgm_edit_id {
  uint64_t author, number;
} sgm_edit_id;

/* Lays a brush on top of all that the grammar derives and of earlier edits. Shows at every level of detail whose cells
 * are no larger than the brush is thick. Never waits for a job or the disk. id (or NULL) names the edit, for undo.
 * SGM_ERR_INVALID_ARGUMENT: a length out of its range, a turn without direction, no such material or tag.
 * SGM_ERR_RANGE: it leaves the world. SGM_ERR_LIMIT: more than 2^20 edits. */
SGM_API sgm_result sgm_world_edit(sgm_world* world, const sgm_brush* brush, sgm_edit_id* id, sgm_error* error);

/* Undoes an edit, of whatever author; of an undo, redoes it. undone (or NULL) names the undo. SGM_ERR_NOT_FOUND: no
 * such edit is known here. */
SGM_API sgm_result sgm_world_undo(sgm_world* world, const sgm_edit_id* id, sgm_edit_id* undone, sgm_error* error);

/* The edits, but the first `since` of them in the order in which they were learned here, as bytes for another world of
 * the same grammar, parameters, seed and cell; or, when a game's grammar has changed and its journals are refused, for
 * a world of the new one, if the places still suit it. *count takes the array's room and returns how many bytes there
 * are. bytes may be NULL: then only that is asked. SGM_INCOMPLETE: they did not fit; nothing was written. How many
 * edits are known is sgm_world_stats.edits: what was sent before need not be sent again. */
SGM_API sgm_result sgm_world_export_edits(sgm_world* world, uint64_t since, void* bytes, size_t* count,
                                          sgm_error* error);

/* Takes over the edits of another world, all or none; those that are known already change nothing. Worlds that have
 * exchanged all their edits, in whatever order, are equal. SGM_ERR_DATA: bytes that no world has exported, or edits
 * that contradict those known here. SGM_ERR_LIMIT: more than 2^20 edits. */
SGM_API sgm_result sgm_world_import_edits(sgm_world* world, const void* bytes, size_t count, sgm_error* error);

/* Returns when the journal has every edit made before, on the disk: for a save. Blocks. SGM_ERR_IO: it could not be
 * written; nothing is lost, the next second tries again, and the message says how many edits the disk does not have. */
SGM_API sgm_result sgm_world_flush_edits(sgm_world* world, sgm_error* error);

/* Of the set of edits; equal in worlds that know the same ones. 0 for NULL. */
SGM_API uint64_t sgm_world_edits_hash(const sgm_world* world);

/* As the queries of a field, asked of the world with its edits: sgm_field_ray_cast, sgm_field_closest_point,
 * sgm_field_is_walkable, sgm_field_find_way. Edits that were just made count, drawn or not. */
SGM_API sgm_result sgm_world_ray_cast(sgm_world* world, const sgm_ray_desc* desc, sgm_surface_point* out,
                                      sgm_error* error);
SGM_API sgm_result sgm_world_closest_point(sgm_world* world, const sgm_closest_desc* desc, sgm_surface_point* out,
                                           sgm_error* error);
SGM_API sgm_result sgm_world_is_walkable(sgm_world* world, const sgm_walk_desc* desc, sgm_walkable* out,
                                         sgm_error* error);
SGM_API sgm_result sgm_world_find_way(sgm_world* world, const sgm_way_desc* desc, sgm_way* out, sgm_error* error);

/* As sgm_field_sample_density, of the world with its edits: what is dug out of a cloud is clear. */
SGM_API sgm_result sgm_world_sample_density(sgm_world* world, const sgm_density_desc* desc, sgm_error* error);

/* The hash of the set of chunk bodies of a level in a region, grown outward to whole chunks: as sgm_surface_hash of the
 * same region where nothing was edited, equal on every machine and whatever was streamed before. Reads what is drawn
 * and meshes the rest; blocks. Errors: as sgm_surface_from_region. */
SGM_API sgm_result sgm_world_hash(sgm_world* world, const int32_t minimum[3], const int32_t maximum[3], int32_t level,
                                  uint64_t* hash, sgm_error* error);

/* Figures of a world, filled by sgm_world_get_stats. Counts are since creation unless they say "now". */
typedef struct sgm_world_stats {
  uint32_t struct_size;
  void* next;
  uint64_t frame;          /* number of the frame that is drawn now; rises, not always by one */
  uint64_t plans;          /* times that the work was planned */
  uint64_t chunks_meshed;  /* bodies, those that were read from stores and cache_folder included */
  uint64_t finest_meshed;  /* of these, those of level 0 */
  uint64_t seam_jobs;      /* chunks that were given further seams afterwards */
  uint64_t chunks_in_vain; /* meshed, never drawn and not wanted any more */
  uint64_t chunks_failed;
  uint64_t stale;      /* chunks that wait or are being meshed now, planned for viewers of before */
  uint64_t queued;     /* chunks that wait to be meshed, now */
  uint64_t in_work;    /* chunks being meshed now */
  uint64_t drawn;      /* chunks drawn now that have triangles or anchors */
  uint64_t kept;       /* chunks known now, drawn or not, empty or not: at rest twice those wanted and 1,024 at most */
  uint64_t mesh_bytes; /* of all meshes now, the engine's included */
  uint64_t peak_mesh_bytes;
  double detail;            /* factor on the distances of detail: below 1 where memory is scarce */
  int32_t idle;             /* 1: what the viewers want is drawn, as far as it can be made, edits and colliders
                               included */
  uint32_t reserved;        /* 0 */
  uint64_t fields_set;      /* calls of sgm_world_set_field */
  uint64_t field_drawn;     /* the one of them, counted from 1, whose field is drawn now; 0: the one of creation */
  uint64_t chunks_outdated; /* that were there, and that an edit or another field had meshed again */
  uint64_t collider_bytes;  /* of the colliders that chunks have now */
  uint64_t edits;           /* known: brushes, undos and redos */
  uint64_t edits_state;     /* rises with every change that edits, or another field, make to the world */
  uint64_t edits_drawn;     /* the edits_state that is drawn now */
  uint64_t cache_hits;      /* parts of chunks that came from cache_folder */
  uint64_t cache_misses;    /* parts that are proven to be empty among them: these are not kept */
  uint64_t cache_damaged;   /* of the misses, those where what was there could not be trusted */
  uint64_t cache_bytes;     /* of the folder's files, as far as they were looked at */
  uint64_t store_hits;      /* parts of chunks that came from stores; of slow servers some came too late to be used */
  uint64_t store_misses;    /* parts that were looked for there, and are not, or did not come in time */
  uint64_t store_damaged;   /* of the misses, those where what was there could not be trusted */
  uint64_t store_bytes;     /* read for the hits */
  uint64_t rounded_cells;   /* of SGM_WORLD_SHARP: cells of chunks_meshed that keep rounded edges, since sharp ones would
                               fold or cut the surface there; those of chunks from stores and cache_folder not counted */
} sgm_world_stats;

#define SGM_WORLD_STATS_INIT                                                                                         \
  {                                                                                                                  \
    SGM_SIZEOF(sgm_world_stats), SGM_NULL, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1.0, 0, 0, 0, 0, 0, 0, 0, 0, 0, \
        0, 0, 0, 0, 0, 0, 0, 0, 0                                                                                    \
  }

SGM_API sgm_result sgm_world_get_stats(const sgm_world* world, sgm_world_stats* stats, sgm_error* error);

/* Filled by sgm_world_get_info: what a world was created with, and what works for it. Of all that, only the counts in
 * `backend` change. */
typedef struct sgm_world_info {
  uint32_t struct_size;
  void* next;
  sgm_backend_info backend; /* the world's own, as sgm_backend_query would fill it at this moment. Of a device's memory
                               it knows `resident`; what the driver and the device's scratch take is not known */
  int32_t cell_units;       /* of level 0 */
  int32_t top_level;
  uint32_t flags;                                           /* of sgm_world_flag */
  uint32_t threads;                                         /* that may work for it at one time */
  double finest_distance, view_distance, collider_distance; /* metres */
  uint64_t mesh_bytes;                                      /* the cap, which is never 0 */
} sgm_world_info;

#define SGM_WORLD_INFO_INIT \
  { SGM_SIZEOF(sgm_world_info), SGM_NULL, SGM_BACKEND_INFO_INIT, 0, 0, 0, 0, 0.0, 0.0, 0.0, 0 }

/* Never waits for a job or a device. */
SGM_API sgm_result sgm_world_get_info(const sgm_world* world, sgm_world_info* info, sgm_error* error);

/* The viewers that sgm_world_set_viewers was given last; *count and SGM_INCOMPLETE as sgm_world_get_drawn has them.
 * Never waits for a job. */
SGM_API sgm_result sgm_world_get_viewers(const sgm_world* world, sgm_viewer* viewers, size_t viewer_stride,
                                         size_t* count, sgm_error* error);

#define SGM_TIME_BUCKETS 21
#define SGM_TIME_FIRST_EXPONENT (-16) /* counts[0] is of times up to 2^-16 s */

/* How long something took, on the wall, each time since the world's creation. counts[i] are those above
 * 2^(i - 17) s and up to 2^(i - 16) s; the first ones also what took less, the last ones what took more than 8 s. */
typedef struct sgm_time_histogram {
  uint64_t counts[SGM_TIME_BUCKETS];
  double sum;     /* seconds, all together */
  double longest; /* seconds */
} sgm_time_histogram;

#define SGM_TIME_HISTOGRAM_INIT \
  { {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0.0, 0.0 }

/* Filled by sgm_world_get_times. */
typedef struct sgm_world_times {
  uint32_t struct_size;
  void* next;
  sgm_time_histogram update;                  /* of sgm_world_update, on the engine's thread */
  sgm_time_histogram poll;                    /* of sgm_world_poll */
  sgm_time_histogram read;                    /* bodies that came from cache_folder or stores, on any thread */
  sgm_time_histogram mesh[SGM_MAX_LEVEL + 1]; /* by level: bodies that were meshed, in jobs, from the grammar to what
                                                 sgm_mesh_get_view shows. Of those that a device meshed together each
                                                 has an equal share of the time */
  double clock_seconds;                       /* up to now, in which jobs meshed or read chunks, seams alone included */
  double job_seconds; /* likewise, times how many jobs they were: divided by clock_seconds, how many worked at one time
                         on average. A job that waits and helps another one counts for both */
} sgm_world_times;

#define SGM_WORLD_TIMES_INIT                                                                                          \
  {                                                                                                                   \
    SGM_SIZEOF(sgm_world_times), SGM_NULL, SGM_TIME_HISTOGRAM_INIT, SGM_TIME_HISTOGRAM_INIT, SGM_TIME_HISTOGRAM_INIT, \
        {SGM_TIME_HISTOGRAM_INIT, SGM_TIME_HISTOGRAM_INIT, SGM_TIME_HISTOGRAM_INIT, SGM_TIME_HISTOGRAM_INIT,          \
         SGM_TIME_HISTOGRAM_INIT, SGM_TIME_HISTOGRAM_INIT, SGM_TIME_HISTOGRAM_INIT, SGM_TIME_HISTOGRAM_INIT,          \
         SGM_TIME_HISTOGRAM_INIT, SGM_TIME_HISTOGRAM_INIT, SGM_TIME_HISTOGRAM_INIT, SGM_TIME_HISTOGRAM_INIT,          \
         SGM_TIME_HISTOGRAM_INIT, SGM_TIME_HISTOGRAM_INIT, SGM_TIME_HISTOGRAM_INIT, SGM_TIME_HISTOGRAM_INIT,          \
         SGM_TIME_HISTOGRAM_INIT},                                                                                    \
        0.0, 0.0                                                                                                      \
  }

/* Always counted: it costs two looks at the clock a call and a chunk, and a lock a call that is held for the moving of
 * pointers alone. Never waits for a job. */
SGM_API sgm_result sgm_world_get_times(const sgm_world* world, sgm_world_times* times, sgm_error* error);

/* What can be wrong with a chunk. All counts are expected to be 0: another is a fault of this library, or of the memory
 * or the driver that it ran on. All but the first two, and SGM_DEFECT_DEGENERATE, are of bodies alone: seams lie flat
 * in their faces, and close with their neighbours. */
typedef enum sgm_defect {
  SGM_DEFECT_INDEX = 0,       /* triangles with an index beyond the vertices: left out of all that follows */
  SGM_DEFECT_OUTSIDE = 1,     /* vertices beyond the chunk, feature vertices beyond a cell around it; their triangles
                                 are left out of all that follows */
  SGM_DEFECT_MISPLACED = 2,   /* vertices on no edge of the grid of samples, on one that has another, or out of order */
  SGM_DEFECT_SAMPLES = 3,     /* vertices on an edge whose samples do not differ in sign, edges without one whose
                                 samples do: level 0, where the chunk was meshed, not read; not with
                                 SGM_WORLD_BY_DISTANCE */
  SGM_DEFECT_DEGENERATE = 4,  /* triangles with two corners in one, by number (left out of what follows) or by place;
                                 of a seam not where one is of each of its levels */
  SGM_DEFECT_FLAT = 5,        /* triangles whose corners are three places on a line */
  SGM_DEFECT_DUPLICATE = 6,   /* triangles with the corners of another */
  SGM_DEFECT_OPEN_EDGE = 7,   /* edges of one triangle that do not lie in a face of the chunk */
  SGM_DEFECT_TURNED_EDGE = 8, /* edges that two triangles pass in one direction */
  SGM_DEFECT_NONMANIFOLD_EDGE = 9,   /* edges of more than two triangles */
  SGM_DEFECT_PINCHED_VERTEX = 10,    /* vertices whose triangles are more than one fan */
  SGM_DEFECT_FOLDED = 11,            /* pairs of triangles that share an edge and lie upon each other */
  SGM_DEFECT_SELF_INTERSECTION = 12, /* pairs of triangles that meet elsewhere beside common corners and edges */
  SGM_DEFECT_FORCE_32_BIT = 0x7FFFFFFF
} sgm_defect;

/* Measures of bodies and seams together. Those of each come from integers: the same bits of the same chunk, whatever
 * backend, instruction set and number of threads meshed it. They are added in the order of the frame's chunks; in
 * another order the doubles may differ in their last bits. */
typedef struct sgm_chunk_sums {
  uint64_t bodies, seams; /* with triangles */
  uint64_t triangles;
  uint64_t bytes;            /* of vertices and indices */
  uint64_t sliver_triangles; /* of quality below 0.05, as sgm_measures.sliver_triangles: no defect */
  uint64_t against_normals;  /* triangles of bodies that do not face along their corners' normals, which are the field's
                                gradient: where a surface is as rough as the cells, no defect */
  uint64_t border_edges;     /* of bodies: edges of one triangle in a face of their chunk */
  uint64_t compared;         /* vertices that SGM_DEFECT_SAMPLES was looked for at */
  uint64_t defects[16];      /* by sgm_defect; the rest 0 */
  double area;               /* square metres */
  double area_vector[3];     /* likewise; 0 for a closed surface, up to rounding */
  double flux;               /* cubic metres: a third of the flux of the position, in metres from the world's origin,
                                through the surface. Of a closed one the volume of the solid inside; below 0 where it
                                is void, as in a cave whose rock goes on outside */
} sgm_chunk_sums;

/* Filled by sgm_world_get_measures. */
typedef struct sgm_world_measures {
  uint32_t struct_size;
  void* next;
  sgm_chunk_sums drawn;     /* of what is drawn now: bodies, and the seams that are drawn with them, which together are
                               one closed surface */
  sgm_chunk_sums made;      /* of every body and seam once each time that it was meshed or read, since creation. Its
                               area and flux are of no surface that is anywhere */
  double measuring_seconds; /* on the wall, added up over jobs, to measure what was made */
  double meshing_seconds; /* likewise, to mesh, read and pack it; jobs that wait for each other count more than once */
} sgm_world_measures;

#define SGM_CHUNK_SUMS_INIT \
  { 0, 0, 0, 0, 0, 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0.0, {0.0, 0.0, 0.0}, 0.0 }
#define SGM_WORLD_MEASURES_INIT \
  { SGM_SIZEOF(sgm_world_measures), SGM_NULL, SGM_CHUNK_SUMS_INIT, SGM_CHUNK_SUMS_INIT, 0.0, 0.0 }

/* Takes some microseconds a hundred drawn chunks, and waits for no job. SGM_ERR_UNSUPPORTED: a world without
 * SGM_WORLD_MEASURE. */
SGM_API sgm_result sgm_world_get_measures(const sgm_world* world, sgm_world_measures* measures, sgm_error* error);

/* Filled by sgm_mesh_get_measures. */
typedef struct sgm_mesh_measures {
  uint32_t struct_size;
  void* next;
  sgm_chunk_sums sums;      /* of the body and the seams that were asked for */
  uint64_t vertices, edges; /* of the body, as triangles have them: vertices that a crease has split are one */
  int64_t euler;            /* of the body, which is open in the chunk's faces: vertices - edges + triangles */
  uint64_t border_edges[6]; /* of the body, by sgm_face */
} sgm_mesh_measures;

#define SGM_MESH_MEASURES_INIT                                                                  \
  {                                                                                             \
    SGM_SIZEOF(sgm_mesh_measures), SGM_NULL, SGM_CHUNK_SUMS_INIT, 0, 0, 0, { 0, 0, 0, 0, 0, 0 } \
  }

/* Of one chunk that a world with SGM_WORLD_MEASURE has handed over. seams: bit (1 << sgm_face) of those to add, as
 * sgm_drawn_chunk.seams; what the mesh does not have adds nothing. Any thread. SGM_ERR_UNSUPPORTED: the mesh is of
 * another world, or of sgm_mesh_chunks. SGM_ERR_INVALID_ARGUMENT: seams has bits that are no face's. */
SGM_API sgm_result sgm_mesh_get_measures(const sgm_mesh* mesh, uint32_t seams, sgm_mesh_measures* measures,
                                         sgm_error* error);

#ifdef __cplusplus
}
#endif

#endif
