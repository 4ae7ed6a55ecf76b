/* clang-format off */
/*
 * sgm.h: the C interface of the SG+M runtime, and its manual.
 *
 * A shape grammar with morphing (a text in the SG+M language) describes an endless world of caves, clouds or buildings.
 * The runtime compiles the text, derives the shapes near a place, evaluates them as an implicit field and meshes the
 * field. The same grammar, parameters, seed and cell size give the same bytes on every machine, backend and thread
 * count.
 *
 * Valid as C99 and as C++20. MIT licence.
 *
 * Order of calls
 *   sgm_runtime_create -> sgm_grammar_compile -> sgm_field_create -> sgm_mesh_chunks -> sgm_mesh_get_view
 *
 * Conventions of all declarations, unless a declaration says otherwise
 *   Space      Right-handed, Y up. World positions are int32_t in units of 1/1024 m on each axis (SGM_UNITS_PER_METRE),
 *              about +-2,097 km. Positions of type double are also in units, and may lie between units. Lengths (a
 *              radius, a distance, a height) of type double or float are in metres.
 *   Solid      The field is negative inside the solid. Normals point out of the solid; front faces run
 *              counter-clockwise seen from the void (as in glTF and Godot).
 *   Handles    Opaque. A function that creates a handle writes it through its `out` parameter, or NULL if it fails. The
 *              caller owns the handle and passes it to the one function that destroys it, which accepts NULL. A handle
 *              keeps alive what it was made from (a field keeps its grammar), so handles may be destroyed in any order;
 *              only the runtime must outlive all of them.
 *              Destroying a handle twice is logged, does nothing else and returns SGM_ERR_INVALID_ARGUMENT; if two
 *              threads destroy a handle concurrently, one succeeds. A runtime remembers the last 1,024 destroyed
 *              handles: destroying an older one again, or any other use of a destroyed handle, is undefined.
 *   Structs    Every struct that may grow begins with { uint32_t struct_size; const void* next; } (void* next if the
 *              library fills the struct) and has an _INIT macro with its defaults. Always start from the macro, also
 *              for structs that the library fills. A struct_size other than this header's is SGM_ERR_STRUCT_SIZE.
 *              `next` is for later extensions, each beginning with sgm_chain; this version has none and refuses a
 *              `next` other than NULL with SGM_ERR_UNSUPPORTED.
 *   Arrays     Elements that may grow lie a stride of bytes apart, which is passed or returned beside the array: at
 *              least the element's size, a multiple of its alignment; 0 means the size of this header's element.
 *   Text       UTF-8. Texts from the library are null-terminated and live as long as the handle that they came from.
 *   Errors     Functions that can fail return sgm_result: 0 is success, below 0 failure, above 0 partial success. Most
 *              take an sgm_error, which may be NULL, and fill it if they fail (and only then). Bad input never aborts,
 *              and no C++ exception leaves the library. Any function may also return SGM_ERR_OUT_OF_MEMORY.
 *   Threads    Functions may be called from any thread at any time, also on shared handles, with two exceptions: only
 *              one thread may use sgm_parameters while they are being changed, and a function that destroys a handle
 *              must not run concurrently with other calls on the handle (except another that destroys it).
 *   Memory     The library has no process-wide state. Bulk data (derived cells, samples, meshes, handles) comes from
 *              the runtime's allocator; small bookkeeping data and message texts may come from the C++ heap.
 */
/* clang-format on */
#ifndef SGM_SGM_H
#define SGM_SGM_H

#include <stddef.h>
#include <stdint.h>

#define SGM_VERSION_MAJOR 0
#define SGM_VERSION_MINOR 2
#define SGM_VERSION_PATCH 0

/* This header's version as one number; sgm_version() returns the library's. */
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
#define SGM_MESSAGE_SIZE 500 /* bytes of sgm_error.message, including the final 0 */
#define SGM_NAME_SIZE 256    /* bytes of each text in sgm_backend_info, including the final 0 */

/* ------------------------------------------------------------------------------------------------ results, errors */

typedef enum sgm_result {
  SGM_OK = 0,
  SGM_INCOMPLETE = 1, /* an array was too small: it holds what fits, or nothing if so stated; the count is complete */

  SGM_ERR_INVALID_ARGUMENT = -1, /* a required value is NULL, a number is NaN, or a value is out of its stated range */
  SGM_ERR_STRUCT_SIZE = -2,      /* struct_size is not this library's: start from the _INIT macro, or rebuild */
  SGM_ERR_VERSION = -3,          /* header and library have incompatible versions */
  SGM_ERR_OUT_OF_MEMORY = -4,    /* the allocator returned NULL, or memory_limit was reached */
  SGM_ERR_GRAMMAR = -5,          /* the grammar text is wrong; line and column locate the error */
  SGM_ERR_LIMIT = -6,            /* a limit on counts, depth, time or threads was reached; the message names it. If
                                    deriving the grammar reached it, line and column locate the statement */
  SGM_ERR_RANGE = -7,            /* outside the integer grid: a world of +-2^31 units, cells of 2^22 units at most */
  SGM_ERR_IO = -8,               /* a file could not be read or written */
  SGM_ERR_UNSUPPORTED = -9,      /* this backend, device or extension is not available here */
  SGM_ERR_CANCELLED = -10,       /* the caller's progress callback asked to stop */
  SGM_ERR_BUSY = -11,            /* in use, for example by handles that were made from it and still exist */
  SGM_ERR_NOT_FOUND = -12,       /* no entry has this name or index */
  SGM_ERR_INTERNAL = -13,        /* a bug in the library; please report it */
  SGM_ERR_DATA = -14,            /* external bytes or files are damaged, or of another version or another world */
  SGM_ERR_DEVICE_LOST = -15,     /* the GPU failed; its contents are lost, and everything else continues to work */
  SGM_RESULT_FORCE_32_BIT = 0x7FFFFFFF
} sgm_result;

/* Returns the name of a result, for example "SGM_ERR_RANGE"; "unknown" if this library does not know the value. Static,
 * never NULL. */
SGM_API const char* sgm_result_name(sgm_result result);

/* An error, in the caller's memory. The message is one line that says what is wrong and what to do. */
typedef struct sgm_error {
  sgm_result code;                /* the function's result */
  int32_t line;                   /* in the grammar text, from 1; 0 if the error has no position in a text */
  int32_t column;                 /* in bytes, from 1; 0 if line is 0 */
  char message[SGM_MESSAGE_SIZE]; /* null-terminated; a longer message is cut off at a whole character */
} sgm_error;

#define SGM_ERROR_INIT  \
  {                     \
    SGM_OK, 0, 0, { 0 } \
  }

/* The first members of every struct that a later version may chain to a `next` pointer. */
typedef struct sgm_chain {
  uint32_t struct_size;
  uint32_t kind;
  const void* next;
} sgm_chain;

/* -------------------------------------------------------------------------------------------------- version, build */

/* Returns the library's version, in the form of SGM_API_VERSION. */
SGM_API uint32_t sgm_version(void);

/* Returns the library's version as a text, "0.2.0". Static. */
SGM_API const char* sgm_version_string(void);

/* Returns one line on the build: version, compiler, instruction sets, backends, checks. Static. */
SGM_API const char* sgm_build_info(void);

/* -------------------------------------------------------------------------------------------------------- runtime */

/* Owns what all other handles share: allocator, job system, log sink, limits. */
typedef struct sgm_runtime sgm_runtime;

/* An allocator of the caller. Any thread may call both functions concurrently, also after the library call that
 * allocated has returned, until sgm_runtime_destroy returns. */
typedef struct sgm_allocator {
  /* Returns `size` bytes (at least 1) at a multiple of `alignment` (a power of two), or NULL. */
  void* (*allocate)(void* user, size_t size, size_t alignment);
  /* Frees memory from allocate, with the size and alignment that were requested. Never called with NULL. */
  void (*release)(void* user, void* memory, size_t size, size_t alignment);
  void* user;
} sgm_allocator;

/* A job system of the caller. It must run every accepted job exactly once, on any thread, at any time, in any order; a
 * system without threads may run its jobs in help alone. The calling thread works too, and does all the work if no job
 * begins: a call waits only for those of its jobs that have begun, and calls help repeatedly while it waits (so it may
 * do part of another call's work). A job that begins after its call has returned finds nothing to do;
 * sgm_runtime_destroy waits for the last of these jobs, and calls help too. Jobs never throw C++ exceptions. The
 * functions may be called from any thread, also inside a job. */
typedef struct sgm_job_system {
  /* Returns how many threads may work on one call concurrently, at least 1: the calling thread and those that run
   * jobs. */
  uint32_t (*concurrency)(void* user);
  /* Accepts a job (returns non-zero) or refuses it (returns 0); a refused job runs at once on the submitting thread.
   * Jobs of a higher priority should run earlier; the usual priority is 0. */
  int32_t (*submit)(void* user, void (*function)(void* argument), void* argument, int32_t priority);
  /* Runs one waiting job on the calling thread and returns non-zero, or returns 0 if none waits. May be NULL. */
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

/* Receives messages. Called from any thread, also concurrently; the message (one line, no newline) is valid during the
 * call. The function must not call the library.
 * Warnings tell what a field leaves out while it derives cells (a shape beyond its layer's reach, a morph between
 * shapes that do not match), with line and column in the grammar: each position once per field, for the first 64
 * positions. */
typedef struct sgm_log_sink {
  void (*write)(void* user, sgm_log_level level, const char* message);
  void* user;
} sgm_log_sink;

/* The engine's profiler (Tracy, Superluminal, PIX, Unreal's or Godot's). It receives zones, which nest on each thread
 * and end on the thread where they began, even if the work fails. Called from any thread, also concurrently, about ten
 * times per chunk. The functions must not call the library or throw C++ exceptions.
 * Names are static, and each is one pointer while the library is loaded, so that a table of source locations, colours
 * or ids may be keyed by it. Any zone may lie in any other, also in one of its own name: layers use layers, and a
 * waiting thread works for other calls.
 *   sgm.derive   one cell of a grammar layer becomes shapes
 *   sgm.compile  shapes near a chunk become its field program; cells that it needs are derived in it, or waited for
 *   sgm.mesh     a field program becomes samples and triangles; with a device, the CPU's part of that
 *   sgm.shaders  a device's shaders are prepared, on a separate thread if a world would have to wait
 *   sgm.pack     triangles become the data of sgm_mesh_get_view
 *   sgm.plan     a job decides what a world draws and meshes next
 *   sgm.update   sgm_world_update
 *   sgm.poll     sgm_world_poll
 *   sgm.region   sgm_surface_from_region
 * At the end of each sgm_world_update these members of sgm_world_stats are plotted:
 *   sgm.queued, sgm.in_work, sgm.mesh_bytes */
typedef struct sgm_profiler {
  uint64_t (*begin)(void* user, const char* zone); /* returns any value: an index, a pointer, the bytes of a small
                                                      struct */
  void (*end)(void* user, uint64_t begun);         /* ends the thread's latest open zone; takes the value from begin */
  /* Called once on each thread that the runtime starts, before the thread works; the name ("sgm worker 1") is valid
   * during the call. May be NULL; the engine itself names the threads of its sgm_job_system. */
  void (*thread)(void* user, const char* name);
  void (*plot)(void* user, const char* name, double value); /* may be NULL */
  void* user;
} sgm_profiler;

/* The four tables are copied; the objects behind their `user` pointers must outlive the runtime. */
typedef struct sgm_runtime_desc {
  uint32_t struct_size;
  const void* next;
  uint32_t api_version;           /* SGM_API_VERSION of the header in use; the _INIT macro sets it */
  uint32_t threads;               /* if jobs is NULL: threads that may work on one call concurrently, including the
                                     calling one; 1 to 1,024; 0: one per processor. If the machine starts fewer, those
                                     work and a warning is logged */
  const sgm_allocator* allocator; /* NULL: malloc and free; up to 128 MiB of released blocks are kept for reuse, and
                                     count neither for sgm_runtime_memory nor for memory_limit */
  const sgm_job_system* jobs;     /* NULL: a thread pool of the runtime */
  const sgm_log_sink* log;        /* NULL: no messages */
  uint64_t memory_limit;          /* most bytes to hold from the allocator; 0: no limit */
  const sgm_profiler* profiler;   /* NULL: no profiler */
  const char* pipeline_folder;    /* UTF-8 path of a folder that keeps a Vulkan driver's compiled shaders between runs,
                                     because compiling them may take many seconds: one file per device and driver, for
                                     any number of concurrent runtimes, processes and programs. The folder is created if
                                     missing. All files may be deleted at any time, and missing or damaged ones are made
                                     again. Drivers trust intact files, so give write access only to users whose
                                     programs you would run. If the folder is not writable, this is logged and nothing
                                     fails. Copied. NULL: shaders are not kept */
} sgm_runtime_desc;

#define SGM_RUNTIME_DESC_INIT \
  { SGM_SIZEOF(sgm_runtime_desc), SGM_NULL, SGM_API_VERSION, 0, SGM_NULL, SGM_NULL, SGM_NULL, 0, SGM_NULL, SGM_NULL }

/* Creates a runtime. desc may be NULL: all defaults. SGM_ERR_VERSION: the program was built with another major version
 * or a newer minor version (while the major version is 0: any other minor version). SGM_ERR_LIMIT: the machine cannot
 * start any thread. */
SGM_API sgm_result sgm_runtime_create(const sgm_runtime_desc* desc, sgm_runtime** out, sgm_error* error);

/* Destroys a runtime, after waiting for jobs that the job system has accepted but not run. NULL is SGM_OK.
 * SGM_ERR_BUSY, and nothing happens, while a handle made from this runtime exists. A second call is undefined: the list
 * of destroyed handles is freed with the runtime. */
SGM_API sgm_result sgm_runtime_destroy(sgm_runtime* runtime);

/* Returns the bytes held from the allocator now (live) and their maximum so far (peak). Either pointer may be NULL. The
 * list of destroyed handles, at most 512 KiB, counts for peak and memory_limit, but not for live. */
SGM_API sgm_result sgm_runtime_memory(const sgm_runtime* runtime, uint64_t* live, uint64_t* peak);

/* ------------------------------------------------------------------------------------------------------- backends */

typedef enum sgm_backend {
  SGM_BACKEND_AUTO = 0, /* the first of CUDA, a hardware Vulkan device and the CPU that is usable here */
  SGM_BACKEND_CPU = 1,
  SGM_BACKEND_VULKAN = 2,
  SGM_BACKEND_CUDA = 3,
  SGM_BACKEND_FORCE_32_BIT = 0x7FFFFFFF
} sgm_backend;

/* Filled by sgm_backend_query. */
typedef struct sgm_backend_info {
  uint32_t struct_size;
  void* next;
  sgm_backend backend;        /* the requested backend; for AUTO the chosen one */
  int32_t usable;             /* 1: the backend can be used here; 0: `reason` says why not */
  int32_t exact;              /* 1: follows the arithmetic contract, so gives the same bytes as every other exact
                                 backend */
  uint32_t concurrency;       /* chunks of one call that are processed concurrently, if usable */
  char name[SGM_NAME_SIZE];   /* "cpu", "vulkan", "cuda" */
  char device[SGM_NAME_SIZE]; /* device or instruction set in use, for example "AVX2"; empty if not usable */
  char reason[SGM_NAME_SIZE]; /* empty if usable */
  /* Counts of a device since it was first used; all fields of a runtime share it. 0 for the CPU. */
  uint64_t chunks;        /* meshed chunks */
  uint64_t chunks_on_cpu; /* of these, chunks meshed by the CPU instead: too large for the device, while the device
                             failed, or, in a world, before its shaders were ready (logged with SGM_LOG_INFO if that
                             takes long) */
  uint64_t losses;        /* times that the device was lost */
  uint64_t resident;      /* bytes of meshes that are on the device now (SGM_WORLD_RESIDENT) */
} sgm_backend_info;

#define SGM_BACKEND_INFO_INIT \
  { SGM_SIZEOF(sgm_backend_info), SGM_NULL, SGM_BACKEND_AUTO, 0, 0, 0, {0}, {0}, {0}, 0, 0, 0, 0 }

/* Finds out whether a backend can be used here, and if not, why. For an unusable backend returns SGM_OK with
 * usable = 0. SGM_ERR_INVALID_ARGUMENT: backend is not a valid sgm_backend. */
SGM_API sgm_result sgm_backend_query(sgm_runtime* runtime, sgm_backend backend, sgm_backend_info* info,
                                     sgm_error* error);

/* ------------------------------------------------------------------------------------------------------- grammars */

/* A compiled grammar. Immutable; threads may share it freely. */
typedef struct sgm_grammar sgm_grammar;

/* The errors and warnings of one compilation, in text order. */
typedef struct sgm_diagnostics sgm_diagnostics;

/* Finds the text of `import "path" as name;`, or the bytes of an asset if the path ends in ".glb". `path` is the
 * written path, made relative to the root: segments joined by '/', never absolute, never with "..". Returns non-zero
 * and sets text and size (bytes), or returns 0 if there is no such text. The text must stay unchanged until
 * sgm_grammar_compile returns. Called only on the compiling thread. Paths that begin with "std/" are built in and never
 * requested. */
typedef int32_t (*sgm_import_function)(void* user, const char* path, const char** text, size_t* size);

typedef struct sgm_grammar_desc {
  uint32_t struct_size;
  const void* next;
  const char* text;                /* need not be null-terminated; copied */
  size_t text_size;                /* bytes; SIZE_MAX: text is null-terminated */
  const char* name;                /* file name for messages; NULL: "grammar" */
  const char* import_folder;       /* folder from which imports are read, never from outside it; or NULL */
  sgm_import_function import_text; /* called before import_folder is searched; or NULL. If both are NULL, only std/ can
                                      be imported */
  void* import_user;
} sgm_grammar_desc;

#define SGM_GRAMMAR_DESC_INIT \
  { SGM_SIZEOF(sgm_grammar_desc), SGM_NULL, SGM_NULL, SIZE_MAX, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL }

/* Compiles a grammar. The text is untrusted: its size, depth, counts and compile time are limited.
 * diagnostics may be NULL. Otherwise it receives the list of all messages, whether the compilation succeeds (then all
 * of them are warnings) or not, and the caller must destroy it with sgm_diagnostics_destroy in both cases. It is NULL
 * only if the call failed before it read the text (a wrong argument, no memory).
 * SGM_ERR_GRAMMAR: the text is wrong, reaches a limit, or imports a file that cannot be read; error holds the first
 * error, which warnings may precede in the list. For an error in an import the message names the file, and line and
 * column are positions in that file. */
SGM_API sgm_result sgm_grammar_compile(sgm_runtime* runtime, const sgm_grammar_desc* desc, sgm_grammar** out,
                                       sgm_diagnostics** diagnostics, sgm_error* error);
SGM_API sgm_result sgm_grammar_destroy(sgm_grammar* grammar);

/* Returns a hash of the meaning-bearing text, imports included: equal on every machine. 0 for NULL. */
SGM_API uint64_t sgm_grammar_hash(const sgm_grammar* grammar);

typedef struct sgm_diagnostic {
  uint32_t struct_size;
  void* next;
  sgm_log_level severity;  /* SGM_LOG_ERROR or SGM_LOG_WARNING */
  int32_t line, column;    /* from 1; columns count bytes */
  int32_t length;          /* bytes that the message is about, from column; at least 1 */
  const char* file;        /* name of the text: the grammar's own, or an import's path */
  const char* message;     /* one line, without the position */
  const char* hint;        /* a suggestion of what was meant, or "" */
  const char* source_line; /* the line of text, without its newline, or "" */
} sgm_diagnostic;

#define SGM_DIAGNOSTIC_INIT \
  { SGM_SIZEOF(sgm_diagnostic), SGM_NULL, SGM_LOG_ERROR, 0, 0, 0, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL }

SGM_API sgm_result sgm_diagnostics_destroy(sgm_diagnostics* diagnostics);
SGM_API uint32_t sgm_diagnostics_count(const sgm_diagnostics* diagnostics); /* 0 for NULL */
/* Returns one message; its texts live as long as diagnostics. SGM_ERR_NOT_FOUND: no such index. */
SGM_API sgm_result sgm_diagnostics_get(const sgm_diagnostics* diagnostics, uint32_t index, sgm_diagnostic* out);

/* A grammar's materials and tags, by their index in vertices. Index 0 is the default material ("" if the grammar names
 * none), and no tag. A name lives as long as the grammar; NULL if the index is too large or the grammar is NULL. */
SGM_API uint32_t sgm_grammar_material_count(const sgm_grammar* grammar);
SGM_API const char* sgm_grammar_material(const sgm_grammar* grammar, uint32_t index);
SGM_API uint32_t sgm_grammar_tag_count(const sgm_grammar* grammar);
SGM_API const char* sgm_grammar_tag(const sgm_grammar* grammar, uint32_t index);
/* Names of anchor kinds and anchors, by the indices in sgm_anchor. */
SGM_API uint32_t sgm_grammar_name_count(const sgm_grammar* grammar);
SGM_API const char* sgm_grammar_name(const sgm_grammar* grammar, uint32_t index);

/* The extent of a grammar's world, and its state where no shape is. */
typedef struct sgm_domain_info {
  uint32_t struct_size;
  void* next;
  int32_t infinite;               /* 1: the world has no end; 0: it is the box below */
  int32_t solid;                  /* 1: solid where no shape is, like rock; 0: void */
  int32_t density;                /* 1: the grammar has `output density`: its solid is meant as fog, not as a wall */
  uint32_t material;              /* of a solid domain; index for sgm_grammar_material */
  int32_t cut[3];                 /* infinite: 1 for axes that are cut into cells, along which the world never ends; 0
                                     for the others, and if finite */
  int32_t minimum[3], maximum[3]; /* finite: the box to mesh, minimum <= p < maximum, units; infinite: all 0 */
  float density_edge;             /* metres below the surface at which the fog has its full density: `output density
                                     edge 20m`, 10 m by default; 0 if density is 0 */
} sgm_domain_info;

#define SGM_DOMAIN_INFO_INIT \
  { SGM_SIZEOF(sgm_domain_info), SGM_NULL, 0, 0, 0, 0, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0.0f }

SGM_API sgm_result sgm_grammar_domain(const sgm_grammar* grammar, sgm_domain_info* out);

/* A layer of the grammar: an endless lattice of cells, each derived independently. A layer uses only earlier layers. */
typedef struct sgm_layer_info {
  uint32_t struct_size;
  void* next;
  const char* name;      /* lives as long as the grammar */
  int32_t cell_units[3]; /* cell edges; 0 along an axis that is not cut into cells */
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
  SGM_QUANTITY_OTHER = 3,  /* any other dimension (an area, a density), in powers of metres */
  SGM_QUANTITY_FORCE_32_BIT = 0x7FFFFFFF
} sgm_quantity;

typedef struct sgm_parameter_info {
  uint32_t struct_size;
  void* next;
  const char* name; /* texts live as long as the grammar */
  const char* doc;  /* the grammar's documentation of the parameter, or "" */
  sgm_quantity quantity;
  int32_t whole;           /* 1: only whole numbers */
  double default_value;    /* in the quantity's unit */
  double minimum, maximum; /* inclusive; -infinity and infinity if the grammar gives no range */
  int32_t animated;  /* 1: meant to be animated through its range while the world is shown (sgm_world_set_field) */
  uint32_t reserved; /* 0 */
} sgm_parameter_info;

#define SGM_PARAMETER_INFO_INIT \
  { SGM_SIZEOF(sgm_parameter_info), SGM_NULL, SGM_NULL, SGM_NULL, SGM_QUANTITY_NUMBER, 0, 0.0, 0.0, 0.0, 0, 0 }

SGM_API uint32_t sgm_grammar_parameter_count(const sgm_grammar* grammar); /* 0 for NULL */
/* SGM_ERR_NOT_FOUND: no such index. */
SGM_API sgm_result sgm_grammar_parameter(const sgm_grammar* grammar, uint32_t index, sgm_parameter_info* out);

/* A value for every parameter of one grammar, initially the defaults. A field copies the values when it is created, so
 * give a world a new field to show other values (sgm_world_set_field); what does not depend on them stays unchanged:
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
/* Sets a parameter. SGM_ERR_NOT_FOUND: no such parameter (the message suggests the nearest name).
 * SGM_ERR_INVALID_ARGUMENT: not finite, not whole although required, or outside the parameter's range. On failure
 * nothing changes. */
SGM_API sgm_result sgm_parameters_set(sgm_parameters* parameters, const char* name, double value, sgm_error* error);
/* Sets a parameter from a text in the language's form, "0.3", "50%", "12m"; a length without a unit is in the grammar's
 * `units`, if the grammar has that line. SGM_ERR_GRAMMAR: not a number, or a wrong unit. Other errors as above. */
SGM_API sgm_result sgm_parameters_set_text(sgm_parameters* parameters, const char* name, const char* text,
                                           sgm_error* error);
SGM_API sgm_result sgm_parameters_get(const sgm_parameters* parameters, const char* name, double* value,
                                      sgm_error* error);

/* ---------------------------------------------------------------------------------------------------------- fields */

/* A grammar with parameters, seed and finest cell: everything that the world depends on. Its answers never change; it
 * keeps a cache of derived cells. */
typedef struct sgm_field sgm_field;

/* Points of a host field that are requested together: origin + spacing * (x, y, z), in units, all of them in the world.
 * The value of (x, y, z) goes to index (z * count[1] + y) * count[0] + x. */
typedef struct sgm_host_lattice {
  int32_t origin[3]; /* units */
  int32_t spacing;   /* units: the cell edge of the level that is meshed. Leave out finer detail */
  uint32_t count[3]; /* at least 1; 2^25 points at most, usually 36^3 */
} sgm_host_lattice;

/* Writes the field in metres at each point, solid below 0, and returns SGM_OK. Any other result fails the call or chunk
 * that needs the points, with SGM_ERR_INVALID_ARGUMENT, LIMIT, RANGE or IO if that was the result, else with
 * SGM_ERR_UNSUPPORTED. A value that is not finite fails it too. A world requests a failed chunk again only after an
 * edit or another field has changed it: wait for data that is still loading, or leave it out. Called from any thread,
 * also concurrently; must not call the library or throw C++ exceptions. */
typedef sgm_result (*sgm_host_sample)(void* user, const sgm_host_lattice* lattice, float* values);

typedef enum sgm_host_flag {
  SGM_HOST_CUT = 1, /* removes its solid from the world; without this flag it adds its solid */
  SGM_HOST_FLAG_FORCE_32_BIT = 0x7FFFFFFF
} sgm_host_flag;

/* A field of the host beside the grammar's: a terrain, or rooms from another program. It is meshed, streamed, queried
 * and edited like everything else, also outside a finite domain. The grammar's own rules do not see it.
 * Its values are rounded to 1/1024 unit and interpolated linearly between the points of each level, with normals from
 * differences over two cells. For neighbouring chunks to match, a point must have the same value whenever it is
 * requested at the same spacing; for all machines to match, it must be computed in the same way on each.
 * Ray casts and closest-point queries request all cells that they come near: SGM_ERR_LIMIT if these are more than
 * 2^25. */
typedef struct sgm_host_field {
  uint32_t struct_size;
  const void* next;
  sgm_host_sample sample;
  void* user;         /* must outlive the field and everything made from it */
  uint64_t identity;  /* identifies the sampled values: use another number if any value differs. Data on disk (cache and
                         journal) under another identity counts as another world's. 0: nothing can be kept on disk */
  int32_t minimum[3]; /* units. Its solid must lie within this box. The field is sampled up to four cells and the
                         blend's width beyond it; solid there is cut off, at a distance that depends on the level's
                         cells */
  int32_t maximum[3];
  float steepness;   /* the most that the value changes per metre, 0 to 1000; 1 for a distance. If given, chunks far
                        from the surface request a single point, and values beyond both 16 m and the change over two
                        cells count as far away: wider blends of edits end there. A chunk whose values change by more
                        fails. 0: not known */
  uint32_t flags;    /* bits of sgm_host_flag */
  uint16_t material; /* index for sgm_grammar_material; 0: the default. For a cut, the material of the cut surface; 0:
                        that of the solid */
  uint16_t tag;      /* index for sgm_grammar_tag */
  int32_t smooth;    /* width of the blend with the rest of the world, 0 to 16,384 units; 0: none */
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
  uint64_t seed;                    /* combined with the grammar's own `seed` */
  int32_t cell_units;               /* edge of a level-0 cell, 1 to 2^20 units; see sgm_cell_from_metres */
  sgm_backend backend;              /* SGM_ERR_UNSUPPORTED if it is not usable here */
  uint64_t cache_bytes;             /* approximate size of the cache of derived cells; 0: 64 MiB */
  const sgm_host_field* hosts;      /* on top of everything that the grammar derives, in this order; copied. NULL:
                                       none */
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
 * SGM_ERR_INVALID_ARGUMENT: not a number, below half a unit (which would round to 0), or above 2^20 units. */
SGM_API sgm_result sgm_cell_from_metres(double metres, int32_t* units, sgm_error* error);

/* The results of a sample point go to the point's index in each array that is not NULL. */
typedef struct sgm_sample_desc {
  uint32_t struct_size;
  const void* next;
  const int32_t* points; /* x y z in units */
  size_t point_stride;   /* bytes from one point to the next, a multiple of 4; 0: 12 */
  size_t count;          /* points; 0 is SGM_OK */
  int32_t level;         /* 0 to SGM_MAX_LEVEL: detail that coarse chunks leave out is left out here too */
  int32_t* q;            /* quantised field, from which meshes are made: floor(field * 1024 / finest cell + 0.5),
                            clamped to +-2^22; solid below 0 */
  float* values;         /* field in metres, negative inside the solid: a distance near a surface, and a constant of
                            +-10^30 units (9.8 * 10^26 m) with gradient 0 if no shape is within a cell or two */
  float* gradients;      /* 3 per point: the field's gradient per metre; points out of the solid */
  uint16_t* materials;   /* of the shape whose surface is nearest there */
  uint16_t* tags;
} sgm_sample_desc;

#define SGM_SAMPLE_DESC_INIT \
  { SGM_SIZEOF(sgm_sample_desc), SGM_NULL, SGM_NULL, 0, 0, 0, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL }

/* Evaluates the field at points, exactly as meshing does. Blocks; uses the job system. On failure the arrays' contents
 * are unspecified. SGM_ERR_LIMIT: deriving a cell reached a limit of the language (line and column locate the
 * statement), or more than 2^20 cells of a layer reach into one chunk. SGM_ERR_RANGE: the level's cells are larger than
 * 2^22 units. */
SGM_API sgm_result sgm_field_sample(sgm_field* field, const sgm_sample_desc* desc, sgm_error* error);

/* An oriented point for the game (a spawn place, a door), placed by the grammar. */
typedef struct sgm_anchor {
  int32_t position[3]; /* units */
  float rotation[9];   /* row-major, orthonormal: maps a world direction to the anchor's local direction */
  uint16_t kind;       /* index for sgm_grammar_name */
  uint16_t name;       /* index for sgm_grammar_name */
  uint16_t tag;        /* index for sgm_grammar_tag */
  uint16_t reserved;   /* 0 */
  uint64_t key;        /* identifies the anchor: the same in every run, and unique */
} sgm_anchor;

/* Returns the anchors at minimum <= p < maximum (units, per axis), ordered by layer, cell and key; derives cells that
 * are not cached on the calling thread. *count is the capacity of anchors, and returns the number of anchors. If
 * anchors is NULL, only *count is set. SGM_INCOMPLETE: the array was too small; it holds the first ones. SGM_ERR_LIMIT:
 * as sgm_field_sample, or more than 2^24 cells of a layer reach into the box. */
SGM_API sgm_result sgm_field_anchors(sgm_field* field, const int32_t minimum[3], const int32_t maximum[3],
                                     sgm_anchor* anchors, size_t anchor_stride, size_t* count, sgm_error* error);

/* --------------------------------------------------------------------------------------------- queries of the field */

/* Queries of the field itself at level 0, which need no mesh: what a ray hits, which surface is nearest, where a walker
 * can stand. All of them block, derive cells that are not cached, and work on the calling thread; many threads may call
 * them concurrently. The answers are the same on every machine, and at any distance from the origin.
 * Positions are in units, as double, and may lie between units. Common errors, each with a message that names the
 * cause: SGM_ERR_INVALID_ARGUMENT (not finite, or out of its stated range), SGM_ERR_RANGE (a position outside the
 * world), SGM_ERR_LIMIT (farther or larger than stated, or as sgm_field_sample). On failure `out` is unchanged. */

/* A place on the surface. Filled by sgm_field_ray_cast and sgm_field_closest_point. */
typedef struct sgm_surface_point {
  uint32_t struct_size;
  void* next;
  int32_t found;      /* 0: there is none, and all members below are 0 */
  int32_t inside;     /* 1: the queried position lies inside the solid */
  double position[3]; /* units */
  double normal[3];   /* unit length, out of the solid */
  double distance;    /* from the queried position, metres */
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
  double length;       /* metres, 0 to the larger of 4,096 m and 8,192 cells */
} sgm_ray_desc;

#define SGM_RAY_DESC_INIT \
  { SGM_SIZEOF(sgm_ray_desc), SGM_NULL, {0.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, 1.0 }

/* Finds the first solid on a ray. A ray that starts in the solid hits it at once (inside). The search misses no solid
 * that the ray crosses for at least a sixteenth of a cell, or a unit if that is more; so it misses no wall as thick as
 * a cell. The hit lies on the void's side, less than a unit from the solid. A ray ends at the world's border. */
SGM_API sgm_result sgm_field_ray_cast(sgm_field* field, const sgm_ray_desc* desc, sgm_surface_point* out,
                                      sgm_error* error);

typedef struct sgm_closest_desc {
  uint32_t struct_size;
  const void* next;
  double position[3];  /* units, in the world */
  double max_distance; /* metres, 0 to the larger of 64 m and 256 cells */
} sgm_closest_desc;

#define SGM_CLOSEST_DESC_INIT \
  { SGM_SIZEOF(sgm_closest_desc), SGM_NULL, {0.0, 0.0, 0.0}, 1.0 }

/* Finds the surface nearest to a position in the void or in the solid. Searches all of the surface that the samples of
 * level 0 show: no part of it is nearer than the answer by more than a quarter of a cell plus 1/64 of the distance;
 * usually the answer is exact to a unit. The work grows with the square of the distance found. */
SGM_API sgm_result sgm_field_closest_point(sgm_field* field, const sgm_closest_desc* desc, sgm_surface_point* out,
                                           sgm_error* error);

/* A box, and a walker: an upright cylinder. Lengths in metres. */
typedef struct sgm_walk_desc {
  uint32_t struct_size;
  const void* next;
  int32_t minimum[3], maximum[3]; /* units, minimum < maximum: floors at minimum <= p < maximum count. With the walker's
                                     size around it, at most 4,096 chunks of 32 cells, all in the world */
  double radius;                  /* 0 to 64 cells */
  double height;                  /* above 0, to 256 cells */
  double step;                    /* climbs and drops this much from one place to the next; 0 to below height */
  double slope;                   /* smallest y of a floor's normal: the cosine of the steepest angle, 0 to 1 */
  double area;                    /* square metres of connected floor that make the box walkable; 0 or more */
} sgm_walk_desc;

#define SGM_WALK_DESC_INIT \
  { SGM_SIZEOF(sgm_walk_desc), SGM_NULL, {0, 0, 0}, {0, 0, 0}, 0.3, 1.8, 0.4, 0.7071067811865476, 1.0 }

/* Filled by sgm_field_is_walkable. Areas in square metres, seen from above, in steps of a cell. */
typedef struct sgm_walkable {
  uint32_t struct_size;
  void* next;
  int32_t walkable; /* 1: largest is above 0 and at least the walker's area */
  uint32_t sides;   /* side faces of the box that the largest part touches, bit (1u << sgm_face): a walker can pass
                       through a passage if both its ends are among them */
  double standing;  /* floor on which the walker can stand */
  double largest;   /* its largest connected part */
} sgm_walkable;

#define SGM_WALKABLE_INIT \
  { SGM_SIZEOF(sgm_walkable), SGM_NULL, 0, 0, 0.0, 0.0 }

/* Finds out where a walker can stand in a box, and how far it can walk. Uses the samples of level 0, a cell apart. A
 * place to stand is a column of samples with a floor in the box: solid under void, with a normal within the slope, the
 * walker's height free above it, and no solid within the walker's radius that is higher than its step (plus the slope's
 * rise up to there) and lower than its head. Neighbouring places are connected if their floors differ by at most the
 * step plus the slope's rise over a cell. */
SGM_API sgm_result sgm_field_is_walkable(sgm_field* field, const sgm_walk_desc* desc, sgm_walkable* out,
                                         sgm_error* error);

/* ---------------------------------------------------------------------------------------------------- chunk meshes */

/* The mesh of one chunk, packed for drawing. Immutable and reference-counted. */
typedef struct sgm_mesh sgm_mesh;

/* Identifies a chunk. Its edge is 32 cells of its level, its cell edge is the field's cell_units << level, and its
 * lowest corner is (x, y, z) times its edge. */
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
  uint32_t seams;       /* faces that need seams: those whose neighbour may be drawn one level coarser. A seam lies in
                           its face's plane and does not change the body; edges and corners of the chunk need no seams.
                           Its triangles may be flat, so seams are closed and manifold by vertex identity, but not if
                           vertices are welded by position alone */
  uint32_t coarser;     /* which of the 26 chunk-sized blocks around the chunk belong to coarser chunks: bit (dx + 1) +
                           3 * (dy + 1) + 9 * (dz + 1) for the block at offset (dx, dy, dz), each -1 to 1. 0: exactly
                           those across the faces in seams, which always count as coarser. The mask distinguishes
                           vertices where seams meet in an edge or a corner, for callers that weld them; in this version
                           sgm_mesh_get_view does not depend on it */
  uint32_t reserved[2]; /* 0 */
} sgm_chunk_request;

#define SGM_CHUNK_REQUEST_INIT   \
  {                              \
    {0, 0, 0, 0}, 0, 0, { 0, 0 } \
  }

/* Reports the progress of long work: called after every chunk, with done rising by one to total. Called on any thread,
 * one call at a time (work on other chunks continues meanwhile, so it should be short); must not call the library.
 * Returns 0 to continue; any other value stops the work with SGM_ERR_CANCELLED, except in the last call
 * (done == total): remaining work, for example texture coordinates, is then finished. Stopping is not immediate: chunks
 * that have begun are finished, and up to 64 chunks are derived before the first of them is meshed. */
typedef int32_t (*sgm_progress_function)(void* user, uint64_t done, uint64_t total);

/* Optional contents of meshes. Worlds have flags of their own: sgm_world_flag. */
typedef enum sgm_meshing_flag {
  SGM_MESHING_TEXTURE = 1, /* texture coordinates and blends of materials: wedges, in views of meshes and surfaces */
  SGM_MESHING_SHARP = 2,   /* sharp edges and corners: feature vertices from the field's gradients, one for each side of
                              a crease, with that side's normal, at the same position. A cell keeps its triangles if its
                              surface bends by less than 26 degrees, or if its features would fold, cut or coincide.
                              Chunks still agree on their faces. Seams join sharp chunks to sharp ones, so request all
                              chunks of a surface alike */
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
  uint32_t flags;    /* bits of sgm_meshing_flag */
  uint32_t reserved; /* 0 */
} sgm_chunks_desc;

#define SGM_CHUNKS_DESC_INIT \
  { SGM_SIZEOF(sgm_chunks_desc), SGM_NULL, SGM_NULL, 0, 0, SGM_NULL, SGM_NULL, 0, 0 }

/* Meshes chunks; meshes[i] is the mesh of requests[i], empty if no surface crosses the chunk. Blocks; uses the job
 * system. Pass many chunks in one call. All or nothing: on failure all desc->count entries of meshes are NULL, except
 * if meshes is NULL or desc itself is refused (NULL, SGM_ERR_STRUCT_SIZE, SGM_ERR_UNSUPPORTED), when nothing is
 * written. SGM_ERR_RANGE: a chunk does not lie completely in the world, or its level's cells are larger than 2^22
 * units. SGM_ERR_LIMIT: count is above 2^20, deriving a cell reached a limit of the language (line and column locate
 * the statement), or more than 2^20 cells of a layer reach into one chunk. */
SGM_API sgm_result sgm_mesh_chunks(sgm_field* field, const sgm_chunks_desc* desc, sgm_mesh** meshes, sgm_error* error);

/* Adds or removes an owner. Removing the last owner destroys the mesh; both functions then refuse it, like a function
 * that destroys a handle. Both accept NULL. */
SGM_API sgm_result sgm_mesh_acquire(sgm_mesh* mesh);
SGM_API sgm_result sgm_mesh_release(sgm_mesh* mesh);

/* What a vertex stands for: an edge of a grid of samples that the surface crosses. Vertices are the same if their edges
 * are the same, also in different chunks. Each has a key, by which meshes are welded and checked without a tolerance.
 * The key is { corner, level, axis, fan }. With positions in units (possibly fractional) and each level's cell edge:
 *   own      level is the chunk's own; axis the one coordinate that is not a multiple of its cell; corner the position
 *            rounded down to multiples of that cell; fan 0
 *   coarser  the same with level + 1 and its cell
 *   lateral  level is the chunk's own; axis 3; corner the position itself, a multiple of the cell of level + 1. fan
 *            distinguishes the vertices at one corner, each of which joins seams that meet in an edge or a corner of
 *            the chunk. Around the corner lie 8 blocks, one per octant, and between octants that share a face lie 12
 *            quarter planes, numbered 4 * (axis of the normal) + (high side on the lower of the other axes) + 2 * (on
 *            the higher one). A quarter plane with a block of the chunk's size on one side and a coarser chunk on the
 *            other carries a seam, and seams that touch in a half axis from the corner share the vertex: fan is the
 *            lowest number of those joined to this vertex's own seam. sgm_chunk_request.coarser says which blocks are
 *            coarser.
 *   feature  with sharp features: a point of an edge or a corner of the surface, in a face of the grid or in a cell. A
 *            body has it once for each side of its crease, a seam once; vertices with equal keys are one. level is the
 *            chunk's own, or the one above if bit 13 of kind is set (only in seams); axis is 7 in a cell (bit 14), else
 *            4 + bits 6 and 7. fan is bits 6 to 9 in a cell, else bits 8 to 11. corner is, on each axis, the position
 *            rounded down to multiples of the level's cell, minus (b - 1) of these cells, where b is the two bits from
 *            2 * axis: a feature may lie up to a cell beyond its face or cell, but no feature of a body lies beyond its
 *            chunk */
typedef enum sgm_vertex_kind {
  SGM_VERTEX_OWN = 0,          /* on an edge of the chunk's own level; every vertex of a body except features */
  SGM_VERTEX_COARSER = 1,      /* on an edge of the level above; only in seams */
  SGM_VERTEX_LATERAL = 2,      /* on a corner, joins the two levels; only in seams */
  SGM_VERTEX_FEATURE = 0x8000, /* a flag: the other bits identify the feature */
  SGM_VERTEX_KIND_FORCE_32_BIT = 0x7FFFFFFF
} sgm_vertex_kind;

/* A packed vertex, 16 bytes, the same on every backend. */
typedef struct sgm_vertex {
  int16_t x, y, z;            /* in 1/256 of the chunk's cell edge, from the chunk's origin: 0 to 8,192; features of the
                                 coarser level: -400 to 8,592 */
  uint16_t material;          /* index for sgm_grammar_material */
  int16_t normal_x, normal_y; /* octahedral, +-32,767: with n = normal / 32767 and w = 1 - |n.x| - |n.y|, the normal is
                                 (n.x, n.y, w) if w >= 0, else ((1 - |n.y|) * sign(n.x), (1 - |n.x|) * sign(n.y), w),
                                 scaled to unit length; sign(0) is 1 */
  uint16_t tag;               /* index for sgm_grammar_tag */
  uint16_t kind;              /* an sgm_vertex_kind, with the bits of a feature */
} sgm_vertex;

/* The body of a chunk or one of its seams. Draw the body always, and a seam if the neighbour across its face is one
 * level coarser. */
typedef struct sgm_mesh_range {
  uint32_t first_vertex, vertex_count;
  uint32_t first_index, index_count;
  uint64_t hash; /* of the range's vertices and triangles, equal on every machine */
} sgm_mesh_range;

/* Consecutive anchors of one kind and name in a mesh: copies of one object, for engines that draw instances. */
typedef struct sgm_instance_batch {
  uint16_t kind, name;   /* indices for sgm_grammar_name */
  uint32_t first, count; /* range in the mesh's anchors and transforms */
} sgm_instance_batch;

/* A vertex in one texture chart with one pair of materials. Coordinates count tiles of 1 m, for repeating textures:
 * u x v points out of the solid, so nothing is mirrored. Whole tiles may be omitted, so that floats hold coordinates to
 * 1/4,096 wherever a shape lies: adjacent chunks agree on coordinates up to whole tiles, and on shares to the bit. A
 * seam's vertices on edges of the coarser level are textured like the coarser chunks, unless the two levels have
 * different shapes there. */
typedef struct sgm_wedge {
  uint32_t vertex; /* index of the mesh's vertex */
  float u, v;
  uint16_t materials[2];   /* the two main materials of its triangles, ascending; a single one appears twice. The same
                              at all corners of a triangle */
  uint8_t share;           /* weight of the second material here, in 1/255, for a blend over about two cells */
  uint8_t plane_shares[3]; /* if no shape has coordinates for the triangle, so that u and v follow the world's axes: the
                              weights of three textures (triplanar mapping), 255 in total; else all 0. The textures lie
                              across x at (-s z, y), across y at (s x, -z), across z at (s x, y), in metres from the
                              world's origin, where s is the sign of the normal along that axis; u and v are those of
                              the axis that the triangle faces most */
} sgm_wedge;

/* Pointers into a mesh, valid until the mesh is destroyed. */
typedef struct sgm_mesh_view {
  uint32_t struct_size;
  void* next;
  sgm_chunk_key key;
  int32_t origin[3];     /* lowest corner, units */
  int32_t cell_units;    /* cell edge of this chunk: the field's cell_units << level */
  int32_t bounds_min[3]; /* bounds of all vertices, seams included, units; all 0 if there are none */
  int32_t bounds_max[3];
  const sgm_vertex* vertices;           /* body first, then the seams by face */
  const uint32_t* indices;              /* into vertices (not relative to the range), three per triangle */
  uint32_t vertex_count, vertex_stride; /* stride in bytes */
  uint32_t index_count, index_stride;
  sgm_mesh_range body;
  sgm_mesh_range seams[6];   /* by sgm_face; empty if not requested */
  uint64_t hash;             /* of body and seams together */
  const sgm_anchor* anchors; /* in this chunk, including its low faces but not its high ones; by kind, name and key */
  uint32_t anchor_count, anchor_stride;
  const uint16_t* tags; /* tags of its vertices, ascending, without 0 */
  uint32_t tag_count;
  uint32_t batch_count;
  const sgm_instance_batch* batches; /* of the anchors */
  const float* transforms; /* 12 per anchor, row-major 3 x 4: from its own axes to the chunk's, metres from origin */
  const int16_t* morphs; /* 3 per vertex, in 1/256 of the chunk's cell edge, to +-1,024: from the vertex to the surface
                            of the next coarser level. NULL except in worlds with SGM_WORLD_MORPH. An engine shows no
                            pop if it draws vertices at position + b * morph and lets b rise from 0 to 1 before a
                            coarser chunk replaces this one. Chunks of one level give a shared vertex the same offset,
                            and seam vertices that belong to the coarser level or join the two have offset 0. So no gap
                            opens if b depends only on place and level, and is 0 where a chunk meets a finer one: b
                            rises from 0 at the near end of a level's range to 1 at its far end */
  const sgm_wedge* wedges; /* texture coordinates in the axes of the shape that makes the surface (along and around a
                              passage, over the faces of a box), or in the world's axes if no shape of the grammar does.
                              A vertex where charts meet has several. NULL if there are none, or without
                              SGM_WORLD_TEXTURE or SGM_MESHING_TEXTURE */
  const uint32_t* wedge_indices; /* index_count indices into wedges, for the same triangles as indices. An engine with
                                    textures draws wedges by these, each with its vertex's position and normal */
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

/* Copies a mesh into the caller's memory. On entry the counts are the arrays' capacities (in elements), on return the
 * mesh's counts. Either array may be NULL: then only its count is set. SGM_INCOMPLETE: an array was too small; nothing
 * was written to that one. Counts must not be NULL. */
SGM_API sgm_result sgm_mesh_copy(const sgm_mesh* mesh, sgm_vertex* vertices, size_t vertex_stride, size_t* vertex_count,
                                 uint32_t* indices, size_t index_stride, size_t* index_count, sgm_error* error);

/* ------------------------------------------------------------------------------- surfaces: welded, for tools */

/* A welded mesh in floats, each vertex once: of a region of many chunks, or of a grid of the caller. Immutable. */
typedef struct sgm_surface sgm_surface;

typedef struct sgm_region_desc {
  uint32_t struct_size;
  const void* next;
  int32_t minimum[3], maximum[3]; /* units, minimum < maximum; extended to whole chunks of the level */
  int32_t level;                  /* 0 to SGM_MAX_LEVEL */
  uint32_t flags;                 /* bits of sgm_meshing_flag */
  uint64_t max_chunks;            /* SGM_ERR_LIMIT if the region has more; 0: 65,536; at most 2^24 */
  sgm_progress_function progress; /* or NULL; counts meshed chunks, but not the work after meshing */
  void* progress_user;
} sgm_region_desc;

#define SGM_REGION_DESC_INIT \
  { SGM_SIZEOF(sgm_region_desc), SGM_NULL, {0, 0, 0}, {0, 0, 0}, 0, 0, 0, SGM_NULL, SGM_NULL }

/* Meshes a region and welds its chunks by exact keys. The surface has open edges only where the region's outer faces
 * cut the solid. Blocks; uses the job system. SGM_ERR_RANGE: the extended region leaves the world, or the level's cells
 * are larger than 2^22 units. SGM_ERR_LIMIT: too many chunks, more vertices than 32-bit indices can address, or as
 * sgm_mesh_chunks. */
SGM_API sgm_result sgm_surface_from_region(sgm_field* field, const sgm_region_desc* desc, sgm_surface** out,
                                           sgm_error* error);

/* Samples of the caller. Value (i, j, k) is values[i + j * stride_y + k * stride_z] and lies at (i, j, k) * cell. */
typedef struct sgm_grid_desc {
  uint32_t struct_size;
  const void* next;
  const float* values; /* distance-like values in the unit of `cell`, negative inside the solid; finite. Quantised to
                          cell / 1024 and clamped to +-4,096 cells, like fields */
  uint32_t size[3];    /* samples on x, y, z: 2 to 16,384 each, 2^33 in total */
  uint32_t reserved;   /* 0 */
  size_t stride_y;     /* in floats, at least size[0]; 0: size[0] */
  size_t stride_z;     /* in floats, at least size[1] * stride_y; 0: that minimum */
  double cell;         /* cell edge in any unit, above 0, finite: positions have the same unit */
  int32_t normals;     /* 1: normals from the grid's gradient (central differences, one-sided at the border); 0: none */
  int32_t reserved2;   /* 0 */
} sgm_grid_desc;

#define SGM_GRID_DESC_INIT \
  { SGM_SIZEOF(sgm_grid_desc), SGM_NULL, SGM_NULL, {0, 0, 0}, 0, 0, 0, 1.0, 1, 0 }

/* Meshes a grid of samples. The surface is open only where the grid's border cuts the solid. Blocks; uses the job
 * system. */
SGM_API sgm_result sgm_surface_from_grid(sgm_runtime* runtime, const sgm_grid_desc* desc, sgm_surface** out,
                                         sgm_error* error);

SGM_API sgm_result sgm_surface_destroy(sgm_surface* surface);

/* Pointers into a surface, valid until it is destroyed. */
typedef struct sgm_surface_view {
  uint32_t struct_size;
  void* next;
  int32_t origin[3];     /* units; positions are relative to it: the world's origin if the region lies within 4,096 m of
                            it, else the region's lowest corner. All 0 for a grid */
  int32_t cell_units;    /* cell edge; 0 for a grid */
  int32_t extent_min[3]; /* the region extended to whole chunks, units; all 0 for a grid */
  int32_t extent_max[3];
  uint64_t vertex_count, index_count;
  const float* positions;    /* 3 per vertex, metres from origin (a grid: in the unit of its cell) */
  const float* normals;      /* 3 per vertex, unit length; NULL if not requested */
  const uint16_t* materials; /* NULL for a grid */
  const uint16_t* tags;      /* NULL for a grid */
  const uint32_t* indices;   /* three per triangle */
  uint32_t position_stride, normal_stride, material_stride, tag_stride; /* bytes */
  float bounds_min[3], bounds_max[3]; /* bounds of the positions; all 0 if there are none */
  uint64_t chunk_count;               /* chunks meshed; 1 for a grid */
  const sgm_wedge* wedges; /* texture coordinates and blends of materials as in sgm_mesh_view.wedges, in one system for
                              the whole region. NULL without SGM_MESHING_TEXTURE */
  const uint32_t* wedge_indices; /* index_count indices into wedges, for the same triangles as indices */
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

/* Returns a hash. Of a region: of the set of its chunks' meshes, equal on every machine and in any order of work. Of a
 * grid: of its positions, normals and triangles, computed in each call. 0 for NULL. */
SGM_API uint64_t sgm_surface_hash(const sgm_surface* surface);

/* ---------------------------------------------------------------------------- voids: is there a path from A to B? */

/* Whether an agent, a ball, can move from one place to another through the void of a region, and on which path. The
 * test uses the samples of level 0, a cell apart: a sample is free for the agent if no solid sample lies within its
 * radius; with radius 0 all of the void is free. Free samples are joined along the axes and across the diagonals of
 * faces, as meshes join their voids. So a path is accurate to within a few cells: between two of its places solid
 * samples may be nearer by 0.71 cells, and the surface lies up to 1.74 cells before them, usually less than one. A
 * place stands for the nearest of the eight samples around it that are void; if none is, the place is in rock. */

typedef enum sgm_way_verdict {
  SGM_WAY_FOUND = 0,
  SGM_WAY_FROM_IN_ROCK = 1,
  SGM_WAY_TO_IN_ROCK = 2,
  SGM_WAY_FROM_TOO_NARROW = 3, /* `from` is in the void, but the agent does not fit there */
  SGM_WAY_TO_TOO_NARROW = 4,
  SGM_WAY_APART = 5, /* the agent fits at both, but no path in the region joins them */
  SGM_WAY_VERDICT_FORCE_32_BIT = 0x7FFFFFFF
} sgm_way_verdict;

typedef enum sgm_way_flag {
  SGM_WAY_WIDEST = 1, /* also find the largest agent that has a path; takes up to three times as long */
  SGM_WAY_FLAG_FORCE_32_BIT = 0x7FFFFFFF
} sgm_way_flag;

typedef struct sgm_way_desc {
  uint32_t struct_size;
  const void* next;
  double from[3], to[3];          /* positions in units (metres times SGM_UNITS_PER_METRE), not in metres like `radius`;
                                     in the region */
  int32_t minimum[3], maximum[3]; /* units, minimum < maximum; the region, extended to whole chunks. Paths stay inside
                                     it. Solid beyond it counts, so the region with one chunk around it must lie in the
                                     world */
  double radius;                  /* of the agent, metres: 0 to less than 32 cells */
  uint32_t flags;                 /* bits of sgm_way_flag */
  uint32_t reserved;              /* 0 */
  uint64_t max_chunks;            /* SGM_ERR_LIMIT if the region has more; 0: 65,536; at most 2^24 */
  int32_t* places;                /* receives the path's places, x y z each, in units; or NULL */
  size_t place_room;              /* capacity of places, in places */
  sgm_progress_function progress; /* or NULL; counts chunks: those of the region, from 1 again in each pass over it;
                                     then those of the path, if there is one, from 1 with their own total */
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
  uint64_t place_count;  /* of the path; 0 if there is none */
  double length;         /* of the path */
  double from_clearance; /* from each end's sample to the nearest solid one, at most 32 cells; 0 in rock. It is the
                            smallest radius that does not fit there */
  double to_clearance;
  double widest;      /* with SGM_WAY_WIDEST, else 0: a path exists for every radius below this, and for none from it on
                         (itself included). 32 cells also stand for anything larger; 0: no agent has a path */
  double from_volume; /* of the voids that contain the ends, for this radius; 0 if an end is not free */
  double to_volume;
  double largest_volume; /* of the region's voids */
  uint64_t void_count;   /* separate voids of the region, for this radius */
  uint64_t sealed_count; /* of these, voids that do not touch the region's border */
} sgm_way;

#define SGM_WAY_INIT \
  { SGM_SIZEOF(sgm_way), SGM_NULL, 0, 0, 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0, 0 }

/* Finds a path. Its places are samples of level 0, each joined with the previous one, from the sample of `from` to that
 * of `to`: a short path, though not always the shortest. The search goes through the region along its longest axis.
 * Memory: the signs of the samples of about two layers of chunks across that axis, with one chunk around them (8.7 KB
 * per chunk that the surface crosses); the faces of one layer (2.2 KB for each that a void touches, 17 times that with
 * SGM_WAY_WIDEST); for the whole region about 300 bytes for each void of each chunk (450 with SGM_WAY_WIDEST), and the
 * field's cache of derived cells; for the path 12 bytes per place, up to 300 per chunk, and up to 20 MB during its
 * search. The answer is the same on every machine and with any number of threads. Blocks; uses the job system. Returns
 * SGM_OK also if there is no path: the verdict says why. SGM_INCOMPLETE: places was too small; it holds the first ones.
 * SGM_ERR_RANGE: the region, with one chunk around it, leaves the world. On failure `out` is unchanged. */
SGM_API sgm_result sgm_field_find_way(sgm_field* field, const sgm_way_desc* desc, sgm_way* out, sgm_error* error);

/* ------------------------------------------------------------------------------------------ measures: of any mesh */

/* The histogram of dihedral angles, section 7.4 of the paper: an edge e from V1 to V2 with outward unit normals n1, n2
 * has d = acos(e.n2) - acos(e.n1), below 0 where the surface is convex. Normals are those of the welded triangles,
 * averaged at each point by area. */
typedef enum sgm_histogram_mode {
  SGM_HISTOGRAM_CORRECTED = 0, /* v = 1/2 - d / (2 pi): flat at 1/2, convex above */
  SGM_HISTOGRAM_PRINTED = 1,   /* v = d / (2 (pi + 1)), as equation 13 is printed: many bins have a number of 0 or
                                  less */
  SGM_HISTOGRAM_CURVATURE = 2, /* v = 1/2 - atan(L d / |e|) / pi: does not narrow as the mesh becomes finer */
  SGM_HISTOGRAM_MODE_FORCE_32_BIT = 0x7FFFFFFF
} sgm_histogram_mode;

typedef enum sgm_measure_flag {
  SGM_MEASURE_UNIQUE_EDGES = 1,          /* the histogram counts each edge once, not once per triangle as in the
                                            paper */
  SGM_MEASURE_NO_SELF_INTERSECTIONS = 2, /* skips self-intersections, about half of the work */
  SGM_MEASURE_FLAG_FORCE_32_BIT = 0x7FFFFFFF
} sgm_measure_flag;

/* A triangle mesh of the caller, in any unit: areas come in its square, volumes in its cube. */
typedef struct sgm_measure_desc {
  uint32_t struct_size;
  const void* next;
  const float* positions;         /* three per point, may be infinite or NaN; or NULL, if positions_double is given */
  const double* positions_double; /* three per point; or NULL, if positions is given */
  uint64_t position_count;        /* at most 2^32 - 1 */
  uint64_t position_stride;       /* bytes from one point to the next; 0: three numbers */
  const uint32_t* indices;        /* three per triangle, counter-clockwise seen from outside, below position_count */
  uint64_t index_count;           /* a multiple of 3, at most 2^32 - 1 */
  double weld;                    /* points at most this far apart are merged; 0: those with equal coordinates.
                                     Finite */
  double cubes;                   /* edge of the cubes of equation 8; 0: no cubes */
  int32_t histogram_mode;         /* an sgm_histogram_mode */
  uint32_t histogram_bins;        /* R: 1 to 4,096; an odd number keeps flat edges in one bin */
  double curvature_length;        /* L, above 0: a ball of radius L is at 3/4 */
  uint32_t flags;                 /* bits of sgm_measure_flag */
  uint32_t histogram_capacity;    /* capacity of histogram */
  double* histogram;              /* or NULL: receives the share of the edges in each bin, from histogram_first on */
} sgm_measure_desc;

#define SGM_MEASURE_DESC_INIT                                                                                         \
  {                                                                                                                   \
    SGM_SIZEOF(sgm_measure_desc), SGM_NULL, SGM_NULL, SGM_NULL, 0, 0, SGM_NULL, 0, 0.0, 0.0, SGM_HISTOGRAM_CORRECTED, \
        33, 1.0, 0, 0, SGM_NULL                                                                                       \
  }

typedef struct sgm_measures {
  uint32_t struct_size;
  void* next;
  int32_t watertight; /* 1: every edge has two triangles that go along it in opposite directions, every point has one
                         fan, and no triangle is a duplicate or has a corner twice; also without any triangle */
  int32_t valid;      /* 1: watertight and facing outward, no volume covered twice, no triangle without area, no
                         self-intersection (if these were searched), and all searches complete */
  uint64_t triangles, points;
  uint64_t welded_points;        /* merged with others */
  uint64_t non_finite_triangles; /* with a corner beyond 1e37 or NaN; excluded from all counts below */
  double area;                   /* equation 7 */
  double volume;                 /* by the divergence theorem, about the centre of the bounds: for a closed mesh */
  double area_vector[3];         /* 0 for a closed mesh, up to rounding */
  double bounds_min[3], bounds_max[3];
  uint64_t objects; /* section 7.3: parts connected through points */
  uint64_t shells;  /* parts connected across edges */
  int64_t euler;    /* Euler characteristic, summed over shells; a point of several fans counts once in each */
  int64_t genus;    /* summed over shells; -1 if a shell is non-manifold or one-sided */
  uint64_t edges, open_edges;    /* open: with one triangle only */
  uint64_t turned_edges;         /* misoriented: their triangles face different ways */
  uint64_t nonmanifold_edges;    /* with three triangles or more */
  uint64_t nonmanifold_vertices; /* that join several fans */
  uint64_t degenerate_triangles; /* with two corners at one position; flat_triangles have no area either */
  uint64_t duplicate_triangles;
  uint64_t sliver_triangles;           /* 4 sqrt(3) area / (sum of squared edges) below 0.05 */
  uint64_t inside_out_shells;          /* closed, facing inward, not in a solid */
  uint64_t cavity_shells;              /* closed, facing inward, in a solid */
  uint64_t nested_shells;              /* closed, facing outward, in a solid: their contents count twice */
  uint64_t self_intersections;         /* pairs of triangles that meet outside common corners and edges, exactly,
                                          without folded_triangles; a lower bound if the next member is 0 */
  int32_t self_intersections_complete; /* 0: not searched, or too many triangles lie close together: there may be
                                          more */
  int32_t histogram_first;             /* number of the first bin by equation 14: 1, or less in mode PRINTED */
  uint64_t histogram_bins;             /* number of bins; SGM_INCOMPLETE if histogram is given but too small */
  uint64_t histogram_edges;            /* counted in the histogram */
  uint64_t histogram_left_out;         /* left out of it: without length or normal */
  double flat, convex, concave;        /* shares of the edges */
  /* Equation 8: volume by all corners, by any corner, by the centre. 0 if cubes is 0. */
  double cubes_all, cubes_any, cubes_centre;
  uint64_t flat_triangles;   /* whose corners lie on one line, exactly */
  uint64_t folded_triangles; /* pairs that share an edge and overlap, exactly; a lower bound if self_intersections is
                                one */
} sgm_measures;

#define SGM_MEASURES_INIT                                                                                              \
  {                                                                                                                    \
    SGM_SIZEOF(sgm_measures), SGM_NULL, 0, 0, 0, 0, 0, 0, 0.0, 0.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, \
        0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0, 0              \
  }

/* Measures any mesh, and decides whether it is the closed surface of a solid. Blocks; uses the job system; the results
 * do not depend on the number of threads. Takes about 200 bytes per triangle of a closed mesh from the runtime's
 * allocator while it works, and 500 if triangles share no points. Exact for coordinates that are 0 or of 1e-70 to 1e37.
 * Defects of the mesh are reported in `out`, and are not errors. SGM_INCOMPLETE: the histogram holds what fits,
 * everything else is complete. SGM_ERR_INVALID_ARGUMENT also for an index that is not below position_count.
 * SGM_ERR_LIMIT: more than 2^30 cubes, or triangles over more than 2^27 columns of them. */
SGM_API sgm_result sgm_measure(sgm_runtime* runtime, const sgm_measure_desc* desc, sgm_measures* out, sgm_error* error);

/* ---------------------------------------------------------------------------------------------- volumes: density */

/* For renderers of fog: clouds, smoke, whatever a grammar with `output density` (sgm_domain_info) describes.
 * shaders/volume has a working renderer, and cites the papers that it follows. */

typedef enum sgm_density_format {
  SGM_DENSITY_UNORM8 = 0, /* uint8_t, to the nearest 1/255, like textures of the format R8_UNORM */
  SGM_DENSITY_FLOAT32 = 1,
  SGM_DENSITY_FORMAT_FORCE_32_BIT = 0x7FFFFFFF
} sgm_density_format;

/* The points origin + spacing * (x, y, z), 0 <= x < size[0] and so on: the texel centres of a 3D texture. Adjacent
 * volumes that share their border points are one for a linear filter.
 * Density is 0 exactly where sgm_sample_desc.q is not below 0, so it begins at the mesh of the same level; from there
 * it rises with depth and never falls. With t = depth / edge, where depth is -q in units, it is 2 t^2 up to t = 1/2,
 * then 1 - 2 (1 - t)^2, and 1 from t = 1 on (shaders/common/density.h). Depth is the field's value: a distance near a
 * surface. A host field with a steepness counts as infinitely deep from 16 m on, or from the change that the steepness
 * allows over two cells if that is more. */
typedef struct sgm_density_desc {
  uint32_t struct_size;
  const void* next;
  int32_t origin[3];         /* units */
  int32_t spacing;           /* units, at least 1: from point to point on each axis */
  uint32_t size[3];          /* points on x, y, z: 1 to 16,384 each, 2^33 in total */
  int32_t level;             /* 0 to SGM_MAX_LEVEL: detail that coarse chunks leave out is left out here too. For a
                                distant volume, a level whose cells are about as large as the spacing */
  double edge;               /* metres from the surface to density 1, from a unit to 4,096 cells of level 0. 0: the
                                grammar's own (sgm_domain_info.density_edge; 10 m if it has none) */
  sgm_density_format format; /* of values */
  uint32_t reserved;         /* 0 */
  void* values;              /* of the first point; x varies fastest, then y, then z */
  size_t row_pitch;          /* bytes from (x, y, z) to (x, y + 1, z), as for a texture upload: a multiple of the
                                value's size, at least size[0] values; 0: that minimum */
  size_t slice_pitch;        /* bytes from (x, y, z) to (x, y, z + 1): a multiple of the value's size, at least size[1]
                                times row_pitch; 0: that minimum */
  sgm_progress_function progress; /* or NULL. Counts blocks of 32^3 points (8^3 if the field has hosts) */
  void* progress_user;
} sgm_density_desc;

#define SGM_DENSITY_DESC_INIT                                                                                         \
  {                                                                                                                   \
    SGM_SIZEOF(sgm_density_desc), SGM_NULL, {0, 0, 0}, SGM_UNITS_PER_METRE, {0, 0, 0}, 0, 0.0, SGM_DENSITY_UNORM8, 0, \
        SGM_NULL, 0, 0, SGM_NULL, SGM_NULL                                                                            \
  }

/* Samples the density at points of a lattice, for any grammar. Blocks; uses the job system, but not the field's
 * backend. The values are the same on every machine, however a lattice is cut into volumes; bytes between the rows are
 * not written. On failure the array's contents are unspecified. SGM_ERR_RANGE: a point outside the world, or as
 * sgm_field_sample. SGM_ERR_LIMIT: as sgm_field_sample. SGM_ERR_CANCELLED: progress requested it. */
SGM_API sgm_result sgm_field_sample_density(sgm_field* field, const sgm_density_desc* desc, sgm_error* error);

/* ---------------------------------------------------------------------------------------------- worlds: streaming */

/* A streamed field: chunks of every level of detail around moving viewers, meshed on the job system and handed over
 * frame by frame. The drawn chunks form one closed surface at all times: seams join finer to coarser detail, the outer
 * faces are closed against the domain's own state (solid or void), and chunks stay drawn until everything that replaces
 * them is ready.
 *
 * A frame of the engine
 *   sgm_world_set_viewers     sets the cameras
 *   sgm_world_update          takes over finished work and starts more; never waits
 *   sgm_world_poll            returns the changes, until there are none; then draw
 *
 * Worlds can be dug and built on (sgm_world_edit). A frame shows one state of the edits, closed: an edit is drawn with
 * the next frame of changes or the one after it. */
typedef struct sgm_world sgm_world;
/* The collision mesh of one chunk, for a physics engine. Immutable and reference-counted. */
typedef struct sgm_collider sgm_collider;

typedef enum sgm_world_flag {
  SGM_WORLD_BY_DISTANCE = 1, /* level 0 wherever it is near enough. Without this flag, only where the void leads from a
                                viewer: near chunks behind rock stay one level coarser, and are never seen */
  SGM_WORLD_MORPH = 2,       /* meshes have morph offsets: sgm_mesh_view.morphs */
  SGM_WORLD_RESIDENT = 4,    /* meshes also lie on the engine's external device, which draws them from there:
                                sgm_vulkan.h, sgm_cuda.h. That memory (about as much again, on Vulkan in blocks of 64
                                MiB and more) counts for the mesh_bytes of the device, not of the world */
  SGM_WORLD_TEXTURE = 8,     /* meshes have texture coordinates: sgm_mesh_view.wedges. About twice the memory per mesh,
                                counted in mesh_bytes; not on the device */
  SGM_WORLD_SHARP = 16, /* sharp edges and corners, as SGM_MESHING_SHARP, at every level, closed in every frame. Meshing
                           a chunk takes hardly longer in a cave, up to seven times as long if edges are everywhere, and
                           ten times on noise as fine as the cells. Reserves twice the memory for each chunk in work */
  SGM_WORLD_MEASURE = 32, /* every chunk is measured in the job that meshes it or reads it from cache_folder:
                             sgm_world_get_measures, sgm_mesh_get_measures. On the CPU this takes 2 to 12 % of the
                             meshing time; for a GPU's chunks it takes as long, which is a larger share */
  SGM_WORLD_FLAG_FORCE_32_BIT = 0x7FFFFFFF
} sgm_world_flag;

typedef struct sgm_world_desc {
  uint32_t struct_size;
  const void* next;
  int32_t top_level; /* coarsest level, 0 to SGM_MAX_LEVEL. Its chunks surround what is drawn, so they should not be
                        much larger than view_distance */
  uint32_t flags;    /* bits of sgm_world_flag */
  double finest_distance;   /* metres from a viewer within which level 0 is drawn; each coarser level reaches twice as
                               far. On a screen of h pixels with a vertical field of view v, a cell then appears no
                               larger than p = 2 * cell * h / (2 tan(v / 2)) / finest_distance pixels. If a layer's
                               `detail` leaves out a passage of width w, the passage ends in a wall of p * w / c pixels
                               at most, where c is the edge of the first cell that is wider than the detail. This holds
                               in the middle of the picture, for a viewer of weight 1, for no more viewers than can be
                               planned for, in an idle world where no chunk has failed and the statistics' detail is
                               1 */
  double view_distance;     /* metres within which chunks are drawn, above 0 */
  uint64_t mesh_bytes;      /* hard limit on the bytes of all meshes (including the engine's and those in work), of the
                               chunks' colliders, and of the records of chunks. If it does not suffice, detail is drawn
                               only nearer. 0: 256 MiB */
  double collider_distance; /* metres from a viewer within which drawn chunks have a collider, at whatever level; 0: no
                               colliders */
  const char* journal;      /* UTF-8 path of the file that keeps the edits; created if missing. A process that is
                               killed, at any moment, loses at most the edits of the last second if it calls
                               sgm_world_update regularly; sgm_world_flush_edits writes them at once. NULL: edits are
                               not kept */
  const char* cache_folder; /* UTF-8 path of a folder that keeps meshed chunks between runs, for any number of
                               concurrent worlds and processes; created if missing. Chunks are meshed again if they are
                               damaged, or if the grammar, its parameters, the seed, the host fields, an edit or this
                               library's version change them. NULL: chunks are not kept */
  uint64_t cache_bytes;     /* maximum bytes of its files; 0: 1 GiB */
  uint64_t author; /* author of the edits made here: worlds that exchange edits need different authors, and a number
                      must not be reused if edits may have been lost. 0: a random author */
  const char* const* stores; /* Baked worlds (sgm bake): UTF-8 paths of folders, or http:// and https:// addresses of
                                such folders on any web server with range requests, read through libcurl; NULL if there
                                are none. They are searched in their order, folders before servers. If all are folders,
                                they are searched before cache_folder; if one is on a server, after it, and chunks from
                                servers are then kept in cache_folder. Chunks that a store has of this world (grammar,
                                parameters, seed, cells, SGM_WORLD_SHARP, the library's meshing) are read instead of
                                derived, with the same bytes; edits lie on top. Chunks that are missing or damaged there
                                are derived: damage is logged the first time, and so is a store without anything of this
                                world. Servers are first contacted when chunks are wanted, on four threads of the world,
                                which also submit jobs. No job waits for a server, and the engine only when it destroys
                                the world, at most a second; a chunk that has not arrived 0.2 s after its turn is
                                derived, and if a server blocks all threads for so long, so are all other chunks. Chunks
                                that were found but not used yet, 64 at most, count in addition to mesh_bytes.
                                A server that does not answer is logged and left alone for a while. Without libcurl,
                                chunks are derived too. 32 MiB of each server's data are cached in memory */
  uint32_t store_count;
  uint32_t max_colliders; /* maximum number of COLLIDER events per update, nearest first: a physics engine needs time
                             for each. 0: 4 */
} sgm_world_desc;

#define SGM_WORLD_DESC_INIT \
  { SGM_SIZEOF(sgm_world_desc), SGM_NULL, 8, 0, 24.0, 1000.0, 0, 0.0, SGM_NULL, SGM_NULL, 0, 0, SGM_NULL, 0, 0 }

/* Creates a world. Reads its journal; damage that could be repaired is logged. SGM_ERR_LIMIT: mesh_bytes is too small
 * to stream with, or the distances need more chunks than can be planned for (the message says what would do); the
 * journal is in use, or too large. SGM_ERR_RANGE: the cells of top_level are larger than 2^22 units.
 * SGM_ERR_INVALID_ARGUMENT: top_level is out of range, or a distance is not finite and above 0 (collider_distance:
 * below 0); a journal, a cache_folder or a store with a host field whose identity is 0.
 * SGM_ERR_DATA: the journal belongs to another world (grammar, parameters, seed, cell, host fields) or is not an edit
 * journal: it stays unchanged; a folder is not a store, or a store of another version.
 * SGM_ERR_IO: the journal or the folder can be neither read nor created. SGM_ERR_UNSUPPORTED: built without a disk
 * cache; SGM_WORLD_RESIDENT, but the field's backend is not on an external device. */
SGM_API sgm_result sgm_world_create(sgm_field* field, const sgm_world_desc* desc, sgm_world** out, sgm_error* error);

/* Destroys a world. Waits for its running jobs, each a plan, a chunk or a batch, and writes the journal. Starts no more
 * jobs of this world, but plans of other worlds may start. Meshes stay valid until the engine releases them. */
SGM_API sgm_result sgm_world_destroy(sgm_world* world);

/* A camera, or another place around which the world is streamed. */
typedef struct sgm_viewer {
  double position[3]; /* metres, inside the world */
  float direction[3]; /* view direction, of any length; chunks in view come first. All 0: all directions */
  float velocity[3];  /* metres per second, at most 10,000: the surroundings of its position in half a second are
                         streamed too */
  float fov;          /* vertical field of view in radians, to 3: a narrower one sees detail from farther away. 0: 70
                         degrees, for which the world's distances hold */
  float weight;       /* 0.01 to 100: factor on the world's distances for this viewer, as far as can be planned for */
} sgm_viewer;

#define SGM_VIEWER_INIT \
  { {0.0, 0.0, 0.0}, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0.0f, 1.0f }

/* Replaces all viewers. Without viewers (count 0) the drawn chunks stay and nothing is meshed.
 * SGM_ERR_INVALID_ARGUMENT: a value is not finite, or out of its range; SGM_ERR_RANGE: a viewer is outside the world,
 * or too fast; SGM_ERR_LIMIT: more than 256. On failure the viewers are unchanged. Never waits. */
SGM_API sgm_result sgm_world_set_viewers(sgm_world* world, const sgm_viewer* viewers, size_t viewer_stride,
                                         size_t count, sgm_error* error);

/* Takes over finished work and starts more on the job system. Waits for no job and no device (a job that the job system
 * refuses runs here, at once). Hands over at most max_bytes of vertices and indices; a larger frame takes several
 * updates, and the drawn chunks change with the last of them. A small max_bytes delays, but loses nothing: a mesh that
 * does not fit is handed over as the first of an update, and its excess is subtracted from the updates that follow. So
 * any k updates hand over at most the sum of their max_bytes and one mesh. All worlds of a runtime plan in turn, in a
 * quarter of the workers' time while there is enough to mesh: more frequent updates, or more worlds, do not keep the
 * workers from meshing. SGM_INCOMPLETE, and nothing changes: events of the previous update have not all been polled.
 * SGM_ERR_INVALID_ARGUMENT: max_bytes is 0. */
SGM_API sgm_result sgm_world_update(sgm_world* world, uint64_t max_bytes, sgm_error* error);

typedef enum sgm_event_kind {
  SGM_EVENT_READY = 0,    /* take over `mesh`: the engine owns it now and must release it. Do not draw it yet */
  SGM_EVENT_SHOWN = 1,    /* draw the chunk: the body of its mesh, and the seams in `seams` */
  SGM_EVENT_REPLACED = 2, /* draw the mesh of the latest READY instead of the previous one. If the hash of its body is
                             equal, the body's bytes and place are the same: seams were added or, after another field
                             was set, anchors, morph offsets or texture coordinates have changed */
  SGM_EVENT_SEAMS = 3,    /* draw other seams of the same mesh; or only `coarser` has changed */
  SGM_EVENT_REMOVED = 4,  /* stop drawing the chunk; release its meshes. Also for a mesh that was READY and never
                             shown */
  SGM_EVENT_FAILED = 5,   /* the chunk cannot be made; `result` says why and the log says more. Coarser chunks stay in
                             its place. If edits had changed it, the world is drawn without them until a further edit,
                             for example an undo; if another field had, with the previous field */
  SGM_EVENT_COLLIDER = 6, /* collide with `collider` instead of the chunk's previous one: the engine owns it now and
                             must release it. Follows soon after a change of the drawn chunk, at most
                             sgm_world_desc.max_colliders per update, and not if the collider is equal to the previous
                             one; not counted in max_bytes */
  SGM_EVENT_COLLIDER_REMOVED = 7, /* stop colliding with the chunk. If chunks of another level take its place, this
                                     event comes after their colliders */
  SGM_EVENT_KIND_FORCE_32_BIT = 0x7FFFFFFF
} sgm_event_kind;

/* One change. Chunks without triangles and anchors have no events; those with anchors alone have a mesh without
 * triangles. */
typedef struct sgm_world_event {
  sgm_event_kind kind;
  sgm_result result; /* for FAILED; else SGM_OK */
  sgm_chunk_key key;
  sgm_mesh* mesh;         /* for READY; else NULL */
  sgm_collider* collider; /* for COLLIDER; else NULL */
  uint32_t seams;         /* for SHOWN, REPLACED and SEAMS: mask of sgm_face */
  uint32_t coarser; /* for the same events: blocks around that belong to coarser chunks, as sgm_chunk_request.coarser; 0
                       if no seam is drawn */
  uint64_t frame;   /* number of the event's frame; 0 for READY, FAILED and colliders */
} sgm_world_event;

/* Returns the next events, in order. *count is the array's capacity, and returns the number of events written; 0 if
 * none is left. All changes of a frame come between two updates: draw only when all are polled. On failure nothing was
 * delivered, and *count is 0: the event that could not be delivered (out of memory) comes first the next time. */
SGM_API sgm_result sgm_world_poll(sgm_world* world, sgm_world_event* events, size_t event_stride, size_t* count,
                                  sgm_error* error);

/* Adds or removes an owner. Removing the last owner destroys the collider; both functions then refuse it, like a
 * function that destroys a handle. Both accept NULL. */
SGM_API sgm_result sgm_collider_acquire(sgm_collider* collider);
SGM_API sgm_result sgm_collider_release(sgm_collider* collider);

/* Pointers into a collider, valid until it is destroyed. Its triangles are those of the chunk's body and drawn seams,
 * without triangles of no area; colliders of neighbouring chunks meet exactly. */
typedef struct sgm_collider_view {
  uint32_t struct_size;
  void* next;
  sgm_chunk_key key;
  int32_t origin[3]; /* of the chunk, units: positions are relative to it */
  uint32_t vertex_count;
  uint32_t index_count;
  const float* positions;    /* 3 per vertex, metres */
  const uint32_t* indices;   /* three per triangle, counter-clockwise seen from the void */
  const uint16_t* materials; /* one per triangle: index for sgm_grammar_material */
  uint64_t hash;             /* of the three arrays: equal for equal colliders of a chunk, in every run */
} sgm_collider_view;

#define SGM_COLLIDER_VIEW_INIT \
  { SGM_SIZEOF(sgm_collider_view), SGM_NULL, {0, 0, 0, 0}, {0, 0, 0}, 0, 0, SGM_NULL, SGM_NULL, SGM_NULL, 0 }

SGM_API sgm_result sgm_collider_get_view(const sgm_collider* collider, sgm_collider_view* view, sgm_error* error);

/* A drawn chunk that has triangles or anchors. */
typedef struct sgm_drawn_chunk {
  sgm_chunk_key key;
  sgm_mesh* mesh; /* an additional owner: release it */
  uint32_t seams, coarser;
} sgm_drawn_chunk;

/* Returns all drawn chunks, ordered by key: for code that starts after their events. *count is the capacity of chunks,
 * and returns the number of chunks. If chunks is NULL, only *count is set. SGM_INCOMPLETE: the array was too small;
 * nothing was written. */
SGM_API sgm_result sgm_world_get_drawn(sgm_world* world, sgm_drawn_chunk* chunks, size_t chunk_stride, size_t* count,
                                       sgm_error* error);

/* Blocks until everything that the viewers want is drawn, as far as it can be made (see SGM_EVENT_FAILED and the
 * statistics' chunks_failed): for loading screens, tools and tests. The calling thread works too. Updates without a
 * byte limit meanwhile, so events accumulate, to be polled afterwards. progress (or NULL) is called now and then with
 * the number of meshed chunks and of all chunks known to be wanted; any result other than 0 ends the wait with
 * SGM_ERR_CANCELLED. SGM_ERR_LIMIT: memory does not suffice. */
SGM_API sgm_result sgm_world_wait_idle(sgm_world* world, sgm_progress_function progress, void* progress_user,
                                       sgm_error* error);

/* Replaces the world's field: by one with other parameters, of an edited grammar (hot reload), or with other host
 * fields. Jobs find the differences; only chunks that these reach are meshed again (sgm_world_stats.chunks_outdated
 * counts them), and all of them are drawn in one frame of changes. Never waits, so that a parameter can be set ten
 * times a second: if fields come faster than they can be drawn, all but the last are skipped, and half of the jobs'
 * time remains for new chunks of the viewers. Without viewers the field waits for its turn. If one of its chunks cannot
 * be made (SGM_EVENT_FAILED), the world goes back to the previous field.
 *
 * sgm_world_stats.field_drawn tells which of these fields is drawn: until then the names of materials, tags and anchors
 * are those of the previous grammar. Edits stay, and their materials and tags keep their numbers; a number that the new
 * grammar lacks has no name there. The world keeps the backend that it was created with, and each field for as long as
 * it needs it; up to five may exist at the same time, each with a cache (sgm_field_desc.cache_bytes), and they share
 * equal derived cells. Everything that host fields use must live as long as the world, which may go back, and their
 * values must not change under one identity; host fields of identity 0 count as changed.
 *
 * A journal belongs to the field that the world was created with: create the world with that field again, then set the
 * other. The disk cache keeps chunks of every field: use none for a world whose parameters change all the time.
 *
 * SGM_ERR_INVALID_ARGUMENT: the field is of another runtime or has other cell_units; or it has a host field of identity
 * 0, and the world keeps anything on disk. */
SGM_API sgm_result sgm_world_set_field(sgm_world* world, sgm_field* field, sgm_error* error);

/* Drops all chunks that wait to be meshed; chunks in work are dropped when they are finished. Drawn chunks stay. The
 * next update starts again for the current viewers: remove them first to stop. */
SGM_API void sgm_world_cancel(sgm_world* world);

typedef enum sgm_brush_shape {
  SGM_BRUSH_SPHERE = 0,
  SGM_BRUSH_BOX = 1,
  SGM_BRUSH_CAPSULE = 2,
  SGM_BRUSH_SHAPE_FORCE_32_BIT = 0x7FFFFFFF
} sgm_brush_shape;

/* A shape to dig out or to add. Whole units, so that it is the same on every machine; each length 1 to 2^20. Members
 * that the shape does not use may have any value. */
typedef struct sgm_brush {
  sgm_brush_shape shape;
  int32_t cut;       /* 1: removes its shape; 0: adds it */
  uint16_t material; /* index for sgm_grammar_material. 0: a cut keeps the material that it cuts, an addition has the
                        default */
  uint16_t tag;      /* index for sgm_grammar_tag; 0 as for material */
  int32_t from[3];   /* centre of a sphere or a box, one end of a capsule */
  int32_t to[3];     /* other end of a capsule */
  int32_t half[3];   /* half extents of a box along its own axes */
  float turn[4];     /* quaternion x y z w, of any length, from a box's axes to the world's */
  int32_t radius;    /* of a sphere or a capsule */
  int32_t smooth;    /* width of the blend with the world; 0: none */
} sgm_brush;

#define SGM_BRUSH_INIT \
  { SGM_BRUSH_SPHERE, 1, 0, 0, {0, 0, 0}, {0, 0, 0}, {1024, 1024, 1024}, {0.0f, 0.0f, 0.0f, 1.0f}, 1024, 0 }

/* Identifies an edit in all worlds that exchange edits. Both 0: no edit. */
typedef struct sgm_edit_id {
  uint64_t author, number;
} sgm_edit_id;

/* Lays a brush on top of the grammar's shapes and of earlier edits. It shows at every level of detail whose cells are
 * no larger than the brush is thick. Never waits for a job or the disk. id (or NULL) receives the edit's id, for undo.
 * SGM_ERR_INVALID_ARGUMENT: a length out of its range, a turn without direction, no such material or tag.
 * SGM_ERR_RANGE: the brush leaves the world. SGM_ERR_LIMIT: more than 2^20 edits. */
SGM_API sgm_result sgm_world_edit(sgm_world* world, const sgm_brush* brush, sgm_edit_id* id, sgm_error* error);

/* Undoes an edit of any author; redoes it if the edit is an undo. undone (or NULL) receives the undo's id.
 * SGM_ERR_NOT_FOUND: the edit is not known here. */
SGM_API sgm_result sgm_world_undo(sgm_world* world, const sgm_edit_id* id, sgm_edit_id* undone, sgm_error* error);

/* Returns the edits in order of arrival, without the first `since`, as bytes for another world of the same grammar,
 * parameters, seed and cell; or, if a game's grammar has changed and its journals are refused, for a world of the new
 * grammar, if the places still suit it. *count is the capacity of bytes, and returns the number of bytes. If bytes is
 * NULL, only *count is set. SGM_INCOMPLETE: the bytes did not fit; nothing was written. sgm_world_stats.edits is the
 * number of known edits: those sent before need not be sent again. */
SGM_API sgm_result sgm_world_export_edits(sgm_world* world, uint64_t since, void* bytes, size_t* count,
                                          sgm_error* error);

/* Takes over the edits of another world, all or none; known edits change nothing. Worlds that have exchanged all their
 * edits, in any order, are equal. SGM_ERR_DATA: the bytes do not come from sgm_world_export_edits, or contradict known
 * edits. SGM_ERR_LIMIT: more than 2^20 edits. */
SGM_API sgm_result sgm_world_import_edits(sgm_world* world, const void* bytes, size_t count, sgm_error* error);

/* Blocks until all edits so far are in the journal on disk: for a save. SGM_ERR_IO: it could not be written; nothing is
 * lost, the world tries again a second later, and the message says how many edits are not on disk. */
SGM_API sgm_result sgm_world_flush_edits(sgm_world* world, sgm_error* error);

/* Returns a hash of the set of edits; equal in worlds that know the same edits. 0 for NULL. */
SGM_API uint64_t sgm_world_edits_hash(const sgm_world* world);

/* The same queries as those of a field (sgm_field_ray_cast, sgm_field_closest_point, sgm_field_is_walkable,
 * sgm_field_find_way), for the world with its edits. The latest edits count, drawn or not. */
SGM_API sgm_result sgm_world_ray_cast(sgm_world* world, const sgm_ray_desc* desc, sgm_surface_point* out,
                                      sgm_error* error);
SGM_API sgm_result sgm_world_closest_point(sgm_world* world, const sgm_closest_desc* desc, sgm_surface_point* out,
                                           sgm_error* error);
SGM_API sgm_result sgm_world_is_walkable(sgm_world* world, const sgm_walk_desc* desc, sgm_walkable* out,
                                         sgm_error* error);
SGM_API sgm_result sgm_world_find_way(sgm_world* world, const sgm_way_desc* desc, sgm_way* out, sgm_error* error);

/* As sgm_field_sample_density, for the world with its edits: clouds are clear where they were dug out. */
SGM_API sgm_result sgm_world_sample_density(sgm_world* world, const sgm_density_desc* desc, sgm_error* error);

/* Returns the hash of the set of chunk bodies of a level in a region, extended to whole chunks: equal to
 * sgm_surface_hash of the same region if nothing was edited, on every machine, whatever was streamed before. Uses drawn
 * chunks and meshes the rest; blocks. Errors: as sgm_surface_from_region. */
SGM_API sgm_result sgm_world_hash(sgm_world* world, const int32_t minimum[3], const int32_t maximum[3], int32_t level,
                                  uint64_t* hash, sgm_error* error);

/* Statistics of a world, filled by sgm_world_get_stats. Counts are since creation unless they say "now". */
typedef struct sgm_world_stats {
  uint32_t struct_size;
  void* next;
  uint64_t frame;          /* number of the frame drawn now; rises, not always by one */
  uint64_t plans;          /* number of plans made */
  uint64_t chunks_meshed;  /* bodies, including those read from stores and cache_folder */
  uint64_t finest_meshed;  /* of these, bodies of level 0 */
  uint64_t seam_jobs;      /* chunks that received more seams later */
  uint64_t chunks_in_vain; /* meshed, never drawn and no longer wanted */
  uint64_t chunks_failed;
  uint64_t stale;      /* chunks that wait or are being meshed now, planned for previous viewers */
  uint64_t queued;     /* chunks that wait to be meshed, now */
  uint64_t in_work;    /* chunks being meshed now */
  uint64_t drawn;      /* chunks drawn now that have triangles or anchors */
  uint64_t kept;       /* chunks known now, drawn or not, empty or not: at rest at most twice those wanted, plus
                          1,024 */
  uint64_t mesh_bytes; /* of all meshes now, including the engine's */
  uint64_t peak_mesh_bytes;
  double detail;            /* factor on the distances of detail: below 1 if memory is scarce */
  int32_t idle;             /* 1: what the viewers want is drawn, as far as it can be made, including edits and
                               colliders */
  uint32_t reserved;        /* 0 */
  uint64_t fields_set;      /* calls of sgm_world_set_field */
  uint64_t field_drawn;     /* number of the call, from 1, whose field is drawn now; 0: the field at creation */
  uint64_t chunks_outdated; /* chunks that an edit or another field caused to be meshed again */
  uint64_t collider_bytes;  /* of the chunks' colliders now */
  uint64_t edits;           /* known: brushes, undos and redos */
  uint64_t edits_state;     /* rises with every change of the world by edits or another field */
  uint64_t edits_drawn;     /* the edits_state that is drawn now */
  uint64_t cache_hits;      /* parts of chunks found in cache_folder */
  uint64_t cache_misses;    /* parts not found there, including those proven to be empty, which are not kept */
  uint64_t cache_damaged;   /* of the misses, parts whose data could not be trusted */
  uint64_t cache_bytes;     /* of the folder's files, as far as they were examined */
  uint64_t store_hits;      /* parts of chunks found in stores; from slow servers some come too late to be used */
  uint64_t store_misses;    /* parts not found there, or not in time */
  uint64_t store_damaged;   /* of the misses, parts whose data could not be trusted */
  uint64_t store_bytes;     /* read for the hits */
  uint64_t rounded_cells;   /* with SGM_WORLD_SHARP: cells of chunks_meshed that keep rounded edges, because sharp ones
                               would fold or cut the surface there; chunks from stores and cache_folder are not
                               counted */
} sgm_world_stats;

#define SGM_WORLD_STATS_INIT                                                                                         \
  {                                                                                                                  \
    SGM_SIZEOF(sgm_world_stats), SGM_NULL, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1.0, 0, 0, 0, 0, 0, 0, 0, 0, 0, \
        0, 0, 0, 0, 0, 0, 0, 0, 0                                                                                    \
  }

SGM_API sgm_result sgm_world_get_stats(const sgm_world* world, sgm_world_stats* stats, sgm_error* error);

/* Filled by sgm_world_get_info: the world's settings and resources. Only the counts in `backend` change. */
typedef struct sgm_world_info {
  uint32_t struct_size;
  void* next;
  sgm_backend_info backend; /* the world's backend, as sgm_backend_query would fill it now. Of a device's memory only
                               `resident` is known, not the memory of the driver or the device's scratch memory */
  int32_t cell_units;       /* of level 0 */
  int32_t top_level;
  uint32_t flags;                                           /* bits of sgm_world_flag */
  uint32_t threads;                                         /* that may work for it concurrently */
  double finest_distance, view_distance, collider_distance; /* metres */
  uint64_t mesh_bytes;                                      /* the limit, never 0 */
} sgm_world_info;

#define SGM_WORLD_INFO_INIT \
  { SGM_SIZEOF(sgm_world_info), SGM_NULL, SGM_BACKEND_INFO_INIT, 0, 0, 0, 0, 0.0, 0.0, 0.0, 0 }

/* Never waits for a job or a device. */
SGM_API sgm_result sgm_world_get_info(const sgm_world* world, sgm_world_info* info, sgm_error* error);

/* Returns the viewers of the last sgm_world_set_viewers; *count and SGM_INCOMPLETE as in sgm_world_get_drawn. Never
 * waits for a job. */
SGM_API sgm_result sgm_world_get_viewers(const sgm_world* world, sgm_viewer* viewers, size_t viewer_stride,
                                         size_t* count, sgm_error* error);

#define SGM_TIME_BUCKETS 21
#define SGM_TIME_FIRST_EXPONENT (-16) /* counts[0] counts times up to 2^-16 s */

/* Wall-clock times of an operation since the world's creation. counts[i] counts those above 2^(i - 17) s and up to
 * 2^(i - 16) s; the first also counts shorter times, the last all times above 8 s. */
typedef struct sgm_time_histogram {
  uint64_t counts[SGM_TIME_BUCKETS];
  double sum;     /* seconds in total */
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
  sgm_time_histogram read;                    /* bodies read from cache_folder or stores, on any thread */
  sgm_time_histogram mesh[SGM_MAX_LEVEL + 1]; /* by level: bodies that jobs meshed, from the grammar to the data of
                                                 sgm_mesh_get_view. Bodies that a device meshed together have equal
                                                 shares of the time */
  double clock_seconds;                       /* in which jobs meshed or read chunks up to now, including seams alone */
  double job_seconds; /* the same times the number of these jobs: divided by clock_seconds, the average number of
                         concurrent jobs. A job that helps another one while it waits counts for both */
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

/* Returns the times of a world's work. They are always measured: two clock reads per call and per chunk, and a lock per
 * call that is held only to move pointers. Never waits for a job. */
SGM_API sgm_result sgm_world_get_times(const sgm_world* world, sgm_world_times* times, sgm_error* error);

/* Possible defects of a chunk. A count other than 0 means a bug in the library, or a fault of the memory or the driver.
 * All except the first two and SGM_DEFECT_DEGENERATE are of bodies alone: seams lie flat in their faces, and close with
 * their neighbours. */
typedef enum sgm_defect {
  SGM_DEFECT_INDEX = 0,       /* triangles with an index beyond the vertices: excluded from all counts below */
  SGM_DEFECT_OUTSIDE = 1,     /* vertices beyond the chunk, feature vertices beyond a cell around it; their triangles
                                 are excluded from all counts below */
  SGM_DEFECT_MISPLACED = 2,   /* vertices on no edge of the sample grid, on one that already has a vertex, or out of
                                 order */
  SGM_DEFECT_SAMPLES = 3,     /* vertices on an edge whose samples have equal signs, and edges with different signs but
                                 no vertex: level 0, if the chunk was meshed, not read; not with
                                 SGM_WORLD_BY_DISTANCE */
  SGM_DEFECT_DEGENERATE = 4,  /* triangles with two corners of one index (excluded from the counts below) or at one
                                 position; in a seam, corners of its two levels may share a position */
  SGM_DEFECT_FLAT = 5,        /* triangles whose corners lie on one line */
  SGM_DEFECT_DUPLICATE = 6,   /* triangles with the same corners as another */
  SGM_DEFECT_OPEN_EDGE = 7,   /* edges of one triangle that do not lie in a face of the chunk */
  SGM_DEFECT_TURNED_EDGE = 8, /* misoriented edges: two triangles use them in the same direction */
  SGM_DEFECT_NONMANIFOLD_EDGE = 9,   /* edges of more than two triangles */
  SGM_DEFECT_PINCHED_VERTEX = 10,    /* non-manifold vertices: their triangles are more than one fan */
  SGM_DEFECT_FOLDED = 11,            /* pairs of triangles that share an edge and overlap */
  SGM_DEFECT_SELF_INTERSECTION = 12, /* pairs of triangles that meet outside common corners and edges */
  SGM_DEFECT_FORCE_32_BIT = 0x7FFFFFFF
} sgm_defect;

/* Measures of bodies and seams together. Each part's come from integers: a chunk gives the same bits with every
 * backend, instruction set and number of threads. They are added in the order of the frame's chunks; in another order
 * the doubles may differ in their last bits. */
typedef struct sgm_chunk_sums {
  uint64_t bodies, seams; /* with triangles */
  uint64_t triangles;
  uint64_t bytes;            /* of vertices and indices */
  uint64_t sliver_triangles; /* of quality below 0.05, as sgm_measures.sliver_triangles; not a defect */
  uint64_t against_normals;  /* triangles of bodies that do not face along their corners' normals (the field's
                                gradient); not a defect if a surface is as rough as the cells */
  uint64_t border_edges;     /* of bodies: edges of one triangle in a face of their chunk */
  uint64_t compared;         /* vertices that were checked for SGM_DEFECT_SAMPLES */
  uint64_t defects[16];      /* by sgm_defect; the rest is 0 */
  double area;               /* square metres */
  double area_vector[3];     /* square metres; 0 for a closed surface, up to rounding */
  double flux;               /* cubic metres: a third of the flux of the position, in metres from the world's origin,
                                through the surface. For a closed one the volume of the solid inside; below 0 if void is
                                inside, as in a cave in endless rock */
} sgm_chunk_sums;

/* Filled by sgm_world_get_measures. */
typedef struct sgm_world_measures {
  uint32_t struct_size;
  void* next;
  sgm_chunk_sums drawn;     /* of what is drawn now: bodies and their drawn seams, which together are one closed
                               surface */
  sgm_chunk_sums made;      /* of every body and seam, once each time that it was meshed or read, since creation. Its
                               area and flux belong to no actual surface */
  double measuring_seconds; /* wall-clock time over all jobs to measure what was made */
  double meshing_seconds;   /* the same to mesh, read and pack it; jobs that wait for each other count more than once */
} sgm_world_measures;

#define SGM_CHUNK_SUMS_INIT \
  { 0, 0, 0, 0, 0, 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0.0, {0.0, 0.0, 0.0}, 0.0 }
#define SGM_WORLD_MEASURES_INIT \
  { SGM_SIZEOF(sgm_world_measures), SGM_NULL, SGM_CHUNK_SUMS_INIT, SGM_CHUNK_SUMS_INIT, 0.0, 0.0 }

/* Returns the measures of a world. Takes some microseconds per hundred drawn chunks, and waits for no job.
 * SGM_ERR_UNSUPPORTED: the world was created without SGM_WORLD_MEASURE. */
SGM_API sgm_result sgm_world_get_measures(const sgm_world* world, sgm_world_measures* measures, sgm_error* error);

/* Filled by sgm_mesh_get_measures. */
typedef struct sgm_mesh_measures {
  uint32_t struct_size;
  void* next;
  sgm_chunk_sums sums;      /* of the body and the requested seams */
  uint64_t vertices, edges; /* of the body; vertices that a crease has split count once */
  int64_t euler;            /* of the body, which is open at the chunk's faces: vertices - edges + triangles */
  uint64_t border_edges[6]; /* of the body, by sgm_face */
} sgm_mesh_measures;

#define SGM_MESH_MEASURES_INIT                                                                  \
  {                                                                                             \
    SGM_SIZEOF(sgm_mesh_measures), SGM_NULL, SGM_CHUNK_SUMS_INIT, 0, 0, 0, { 0, 0, 0, 0, 0, 0 } \
  }

/* Returns the measures of one chunk from a world with SGM_WORLD_MEASURE. seams: bit (1 << sgm_face) of the seams to
 * add, as in sgm_drawn_chunk.seams; seams that the mesh lacks add nothing. Any thread. SGM_ERR_UNSUPPORTED: the mesh is
 * from a world without that flag, or from sgm_mesh_chunks. SGM_ERR_INVALID_ARGUMENT: seams has unknown bits. */
SGM_API sgm_result sgm_mesh_get_measures(const sgm_mesh* mesh, uint32_t seams, sgm_mesh_measures* measures,
                                         sgm_error* error);

#ifdef __cplusplus
}
#endif

#endif
