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
 *              keeps the objects alive that it was made from (a field keeps its grammar), so handles may be destroyed
 *              in any order; only the runtime must outlive all of them.
 *              Destroying a handle twice is logged, does nothing else and returns SGM_ERR_INVALID_ARGUMENT; if two
 *              threads destroy a handle concurrently, one succeeds. A runtime remembers the last 1,024 destroyed
 *              handles: destroying an older one again, or any other use of a destroyed handle, is undefined.
 *   Structs    Every struct that may grow begins with { uint32_t struct_size; const void* next; } (void* next if the
 *              library fills the struct) and has an _INIT macro with its defaults. Always start from the macro, also
 *              for structs that the library fills. A struct_size that differs from this library's is an error
 *              (SGM_ERR_STRUCT_SIZE). `next` is for later extensions, each beginning with sgm_chain; this version has
 *              none and refuses a `next` other than NULL with SGM_ERR_UNSUPPORTED.
 *   Arrays     Elements that may grow in later versions lie `stride` bytes apart, which is passed or returned with the
 *              array: at least the element's size, and a multiple of its alignment; 0 means the size of this header's
 *              element.
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
  SGM_INCOMPLETE = 1, /* an array was too small: it holds as many elements as fit, or none if the function says so; the
                         returned count is the total */

  SGM_ERR_INVALID_ARGUMENT = -1, /* a required value is NULL, a number is NaN, or a value is out of its stated range */
  SGM_ERR_STRUCT_SIZE = -2,      /* struct_size is not this library's: start from the _INIT macro, or rebuild */
  SGM_ERR_VERSION = -3,          /* header and library have incompatible versions */
  SGM_ERR_OUT_OF_MEMORY = -4,    /* the allocator returned NULL, or memory_limit was reached */
  SGM_ERR_GRAMMAR = -5,          /* the grammar text is wrong; line and column locate the error */
  SGM_ERR_LIMIT = -6,            /* a limit on counts, depth, time or threads was reached; the message names it. If it
                                    was reached while the grammar was derived, line and column locate the statement */
  SGM_ERR_RANGE = -7,            /* a position outside the world (+-2^31 units), or a cell larger than 2^22 units */
  SGM_ERR_IO = -8,               /* a file could not be read or written */
  SGM_ERR_UNSUPPORTED = -9,      /* this backend, device or extension is not available on this machine or in this
                                    build */
  SGM_ERR_CANCELLED = -10,       /* the caller's progress callback asked to stop */
  SGM_ERR_BUSY = -11,            /* the object is in use, for example by handles that were made from it and still
                                    exist */
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
  sgm_result code;                /* result of the function */
  int32_t line;                   /* line in the grammar text, from 1; 0 if the error has no position in a text */
  int32_t column;                 /* column in that line in bytes, from 1; 0 if line is 0 */
  char message[SGM_MESSAGE_SIZE]; /* null-terminated; a longer message is cut off at a whole character */
} sgm_error;

#define SGM_ERROR_INIT  \
  {                     \
    SGM_OK, 0, 0, { 0 } \
  }

/* The first members of every extension struct. This version has no such structs; a later version may define some, to
 * which the `next` of other structs may point. */
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

/* Returns one line that describes the build: version, compiler, instruction sets, backends, checks. Static. */
SGM_API const char* sgm_build_info(void);

/* -------------------------------------------------------------------------------------------------------- runtime */

/* The runtime owns what all other handles share: allocator, job system, log sink, limits. */
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

/* A job system of the caller. It must run every accepted job exactly once, on any thread, at any time, in any order. A
 * system without threads may run its jobs only in `help`.
 * The thread that calls a library function takes part in the work, and does all of it if no job starts. The call waits
 * only for those of its jobs that have started; while it waits, it calls `help` repeatedly (so it may run jobs of
 * another call). A job that starts after its call has returned finds nothing to do; sgm_runtime_destroy waits for these
 * jobs, and calls `help` too. Jobs never throw C++ exceptions. The functions may be called from any thread, also inside
 * a job. */
typedef struct sgm_job_system {
  /* Returns how many threads may work on one call concurrently, at least 1: the calling thread and those that run
   * jobs. */
  uint32_t (*concurrency)(void* user);
  /* Accepts a job (returns non-zero) or refuses it (returns 0); a refused job runs at once on the submitting thread.
   * Jobs of a higher priority should run earlier; the usual priority is 0. */
  int32_t (*submit)(void* user, void (*function)(void* argument), void* argument, int32_t priority);
  /* Runs one queued job on the calling thread and returns non-zero, or returns 0 if no job is queued. May be NULL. */
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

/* Receives log messages. Called from any thread, also concurrently; the message (one line, no newline) is valid during
 * the call. The function must not call the library.
 * Warnings report what a field leaves out while it derives cells (a shape beyond its layer's reach, a morph between
 * shapes that do not match), with line and column in the grammar. Each position is reported once per field, for the
 * first 64 positions. */
typedef struct sgm_log_sink {
  void (*write)(void* user, sgm_log_level level, const char* message);
  void* user;
} sgm_log_sink;

/* The engine's profiler (Tracy, Superluminal, PIX, Unreal's or Godot's). It receives zones, which nest on each thread
 * and end on the thread where they began, even if the work fails. Called from any thread, also concurrently, about ten
 * times per chunk. The functions must not call the library or throw C++ exceptions.
 * Zone names are static strings. Each name is always passed as the same pointer while the library is loaded, so that a
 * table of source locations, colours or ids may use it as the key. A zone may be nested in any other zone, also in one
 * of the same name: a layer derives cells of other layers, and a waiting thread works for other calls.
 *   sgm.derive   derives the shapes in one cell of a grammar layer
 *   sgm.compile  compiles the shapes near a chunk into a field program; derives missing cells, or waits for them
 *   sgm.mesh     evaluates a field program at samples and makes triangles; for a device, only the work on the CPU
 *   sgm.shaders  prepares a device's shaders; on a separate thread if a world would have to wait
 *   sgm.pack     converts triangles to the data of sgm_mesh_get_view
 *   sgm.plan     decides which chunks a world draws and meshes next
 *   sgm.update   sgm_world_update
 *   sgm.poll     sgm_world_poll
 *   sgm.region   sgm_surface_from_region
 * At the end of each sgm_world_update, these members of sgm_world_stats are plotted:
 *   sgm.queued, sgm.in_work, sgm.mesh_bytes */
typedef struct sgm_profiler {
  uint64_t (*begin)(void* user, const char* zone); /* returns any value: an index, a pointer, the bytes of a small
                                                      struct */
  void (*end)(void* user, uint64_t begun);         /* ends the latest open zone of the thread; `begun` is the value that
                                                      begin returned */
  /* Called once on each thread that the runtime starts, before the thread works; the name ("sgm worker 1") is valid
   * during the call. May be NULL; the engine itself names the threads of its sgm_job_system. */
  void (*thread)(void* user, const char* name);
  void (*plot)(void* user, const char* name, double value); /* may be NULL */
  void* user;
} sgm_profiler;

/* The structs behind the four pointers (allocator, jobs, log, profiler) are copied; the objects behind their `user`
 * pointers must outlive the runtime. */
typedef struct sgm_runtime_desc {
  uint32_t struct_size;
  const void* next;
  uint32_t api_version;           /* SGM_API_VERSION of the header in use; the _INIT macro sets it */
  uint32_t threads;               /* if jobs is NULL: number of threads that may work on one call concurrently,
                                     including the calling thread; 1 to 1,024; 0: one per processor. If the machine
                                     cannot start as many, the runtime uses fewer and logs a warning */
  const sgm_allocator* allocator; /* NULL: the C++ heap; up to 128 MiB of released blocks are kept for reuse, and
                                     count neither for sgm_runtime_memory nor for memory_limit */
  const sgm_job_system* jobs;     /* NULL: a thread pool of the runtime */
  const sgm_log_sink* log;        /* NULL: messages are discarded */
  uint64_t memory_limit;          /* maximum number of bytes to hold from the allocator; 0: no limit */
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

/* Creates a runtime. desc may be NULL, which means all defaults. SGM_ERR_VERSION: the program was built with another
 * major version or a newer minor version (while the major version is 0: any other minor version). SGM_ERR_LIMIT: the
 * machine cannot start any thread. */
SGM_API sgm_result sgm_runtime_create(const sgm_runtime_desc* desc, sgm_runtime** out, sgm_error* error);

/* Destroys a runtime, after waiting for jobs that the job system has accepted but not yet run. NULL is allowed and
 * returns SGM_OK. SGM_ERR_BUSY, without any effect: a handle made from this runtime still exists. A second call on the
 * same runtime is undefined, because the list of destroyed handles is freed with the runtime. */
SGM_API sgm_result sgm_runtime_destroy(sgm_runtime* runtime);

/* Returns how many bytes the runtime holds from the allocator now (live), and the maximum so far (peak). Either pointer
 * may be NULL. The list of destroyed handles, at most 512 KiB, counts for peak and memory_limit, but not for live. */
SGM_API sgm_result sgm_runtime_memory(const sgm_runtime* runtime, uint64_t* live, uint64_t* peak);

/* ------------------------------------------------------------------------------------------------------- backends */

typedef enum sgm_backend {
  SGM_BACKEND_AUTO = 0, /* the first usable backend of: CUDA, a hardware Vulkan device, the CPU */
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
  int32_t exact;              /* 1: results are bit-identical to those of every other exact backend */
  uint32_t concurrency;       /* number of chunks that one call processes concurrently, if usable */
  char name[SGM_NAME_SIZE];   /* "cpu", "vulkan", "cuda" */
  char device[SGM_NAME_SIZE]; /* device or instruction set in use, for example "AVX2"; empty if not usable */
  char reason[SGM_NAME_SIZE]; /* why the backend is not usable; empty if it is */
  /* Counters of a device since it was first used, over all fields of the runtime. 0 for the CPU. */
  uint64_t chunks;        /* number of chunks that were meshed */
  uint64_t chunks_on_cpu; /* number of these chunks that were meshed on the CPU instead: too large for the device, while
                             the device failed, or, in a world, before its shaders were ready (logged with SGM_LOG_INFO
                             if that takes long) */
  uint64_t losses;        /* number of times that the device was lost */
  uint64_t resident;      /* bytes of meshes that are on the device now (SGM_WORLD_RESIDENT) */
} sgm_backend_info;

#define SGM_BACKEND_INFO_INIT \
  { SGM_SIZEOF(sgm_backend_info), SGM_NULL, SGM_BACKEND_AUTO, 0, 0, 0, {0}, {0}, {0}, 0, 0, 0, 0 }

/* Finds out whether a backend can be used on this machine, and if not, why. For an unusable backend returns SGM_OK with
 * usable = 0. SGM_ERR_INVALID_ARGUMENT: backend is not a valid sgm_backend. */
SGM_API sgm_result sgm_backend_query(sgm_runtime* runtime, sgm_backend backend, sgm_backend_info* info,
                                     sgm_error* error);

/* ------------------------------------------------------------------------------------------------------- grammars */

/* A compiled grammar. Immutable, so threads may share it without locks. */
typedef struct sgm_grammar sgm_grammar;

/* The errors and warnings of one compilation, in the order of their positions in the text. */
typedef struct sgm_diagnostics sgm_diagnostics;

/* Returns the text of an `import "path" as name;`, or the bytes of an asset if the path ends in ".glb". `path` is the
 * path in the import statement, made relative to the root folder: segments joined by '/', never absolute, never with
 * "..". The function sets text and size (bytes) and returns non-zero; or returns 0 if there is no such text. The text
 * must stay unchanged until sgm_grammar_compile returns. Called only on the thread that calls sgm_grammar_compile.
 * Paths that begin with "std/" are built in and never requested. */
typedef int32_t (*sgm_import_function)(void* user, const char* path, const char** text, size_t* size);

typedef struct sgm_grammar_desc {
  uint32_t struct_size;
  const void* next;
  const char* text;                /* need not be null-terminated; copied */
  size_t text_size;                /* length of text in bytes; SIZE_MAX: text is null-terminated */
  const char* name;                /* file name for messages; NULL: "grammar" */
  const char* import_folder;       /* folder from which imports are read, never from outside it; or NULL */
  sgm_import_function import_text; /* called before import_folder is searched; or NULL. If both are NULL, only std/ can
                                      be imported */
  void* import_user;
} sgm_grammar_desc;

#define SGM_GRAMMAR_DESC_INIT \
  { SGM_SIZEOF(sgm_grammar_desc), SGM_NULL, SGM_NULL, SIZE_MAX, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL }

/* Compiles a grammar. The text may be untrusted: its size, depth, counts and compile time are limited.
 * diagnostics may be NULL. Otherwise it receives the list of all errors and warnings, also if the compilation succeeds
 * (then there are only warnings), and the caller must destroy it with sgm_diagnostics_destroy in both cases. It is NULL
 * only if the call failed before it read the text (a wrong argument, no memory).
 * SGM_ERR_GRAMMAR: the text is wrong, reaches a limit, or imports a file that cannot be read. `error` receives the
 * first error; warnings may precede it in the list. For an error in an imported file, the message names the file, and
 * line and column are positions in that file. */
SGM_API sgm_result sgm_grammar_compile(sgm_runtime* runtime, const sgm_grammar_desc* desc, sgm_grammar** out,
                                       sgm_diagnostics** diagnostics, sgm_error* error);
SGM_API sgm_result sgm_grammar_destroy(sgm_grammar* grammar);

/* Returns a hash of the grammar's meaning, imports included: comments, layout and redundant parentheses do not affect
 * it. Equal on every machine. 0 for NULL. */
SGM_API uint64_t sgm_grammar_hash(const sgm_grammar* grammar);

typedef struct sgm_diagnostic {
  uint32_t struct_size;
  void* next;
  sgm_log_level severity;  /* SGM_LOG_ERROR or SGM_LOG_WARNING */
  int32_t line, column;    /* from 1; columns count bytes */
  int32_t length;          /* number of bytes that the message is about, starting at column; at least 1 */
  const char* file;        /* name of the text: the grammar's own, or an import's path */
  const char* message;     /* the message in one line, without the position */
  const char* hint;        /* a suggestion of what was meant, or "" */
  const char* source_line; /* the line of text, without its newline, or "" */
} sgm_diagnostic;

#define SGM_DIAGNOSTIC_INIT \
  { SGM_SIZEOF(sgm_diagnostic), SGM_NULL, SGM_LOG_ERROR, 0, 0, 0, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL }

SGM_API sgm_result sgm_diagnostics_destroy(sgm_diagnostics* diagnostics);
SGM_API uint32_t sgm_diagnostics_count(const sgm_diagnostics* diagnostics); /* 0 for NULL */
/* Returns one error or warning; its texts live as long as diagnostics. SGM_ERR_NOT_FOUND: index is too large. */
SGM_API sgm_result sgm_diagnostics_get(const sgm_diagnostics* diagnostics, uint32_t index, sgm_diagnostic* out);

/* Names of a grammar's materials and tags. Vertices refer to them by index. Material 0 is the default material ("" if
 * the grammar names none); tag 0 means no tag. A name lives as long as the grammar; NULL if the index is too large or
 * the grammar is NULL. */
SGM_API uint32_t sgm_grammar_material_count(const sgm_grammar* grammar);
SGM_API const char* sgm_grammar_material(const sgm_grammar* grammar, uint32_t index);
SGM_API uint32_t sgm_grammar_tag_count(const sgm_grammar* grammar);
SGM_API const char* sgm_grammar_tag(const sgm_grammar* grammar, uint32_t index);
/* Names of anchor kinds and of anchors. sgm_anchor refers to them by index. */
SGM_API uint32_t sgm_grammar_name_count(const sgm_grammar* grammar);
SGM_API const char* sgm_grammar_name(const sgm_grammar* grammar, uint32_t index);

/* The extent of a grammar's world, and its state outside all shapes. */
typedef struct sgm_domain_info {
  uint32_t struct_size;
  void* next;
  int32_t infinite;               /* 1: the world has no end; 0: it is the box below */
  int32_t solid;                  /* state where no shape is: 1: solid, like rock; 0: void */
  int32_t density;                /* 1: the grammar has `output density`: its solid describes fog, not walls */
  uint32_t material;              /* material of a solid domain; index for sgm_grammar_material */
  int32_t cut[3];                 /* if infinite: 1 for each axis that is divided into cells, along which the world is
                                     endless; 0 for other axes, and for a finite world */
  int32_t minimum[3], maximum[3]; /* if finite: the box to mesh, minimum <= p < maximum, in units; if infinite: all 0 */
  float density_edge;             /* metres below the surface at which the fog has its full density: `output density
                                     edge 20m`, 10 m by default; 0 if density is 0 */
} sgm_domain_info;

#define SGM_DOMAIN_INFO_INIT \
  { SGM_SIZEOF(sgm_domain_info), SGM_NULL, 0, 0, 0, 0, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0.0f }

SGM_API sgm_result sgm_grammar_domain(const sgm_grammar* grammar, sgm_domain_info* out);

/* A layer of the grammar: an endless lattice of cells, each derived independently. A layer can refer only to layers
 * that the grammar defines before it. */
typedef struct sgm_layer_info {
  uint32_t struct_size;
  void* next;
  const char* name;      /* lives as long as the grammar */
  int32_t cell_units[3]; /* cell edge on each axis, in units; 0 along an axis that is not divided into cells */
  int32_t reach_units;   /* maximum distance by which a shape may extend beyond its cell, in units */
} sgm_layer_info;

#define SGM_LAYER_INFO_INIT \
  { SGM_SIZEOF(sgm_layer_info), SGM_NULL, SGM_NULL, {0, 0, 0}, 0 }

SGM_API uint32_t sgm_grammar_layer_count(const sgm_grammar* grammar);
/* SGM_ERR_NOT_FOUND: index is too large. */
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
  int32_t whole;           /* 1: the value must be a whole number */
  double default_value;    /* in the unit of the quantity */
  double minimum, maximum; /* inclusive; -infinity and infinity if the grammar gives no range */
  int32_t animated;  /* 1: meant to be animated through its range while the world is shown (sgm_world_set_field) */
  uint32_t reserved; /* 0 */
} sgm_parameter_info;

#define SGM_PARAMETER_INFO_INIT \
  { SGM_SIZEOF(sgm_parameter_info), SGM_NULL, SGM_NULL, SGM_NULL, SGM_QUANTITY_NUMBER, 0, 0.0, 0.0, 0.0, 0, 0 }

SGM_API uint32_t sgm_grammar_parameter_count(const sgm_grammar* grammar); /* 0 for NULL */
/* SGM_ERR_NOT_FOUND: index is too large. */
SGM_API sgm_result sgm_grammar_parameter(const sgm_grammar* grammar, uint32_t index, sgm_parameter_info* out);

/* Values for all parameters of one grammar, initially the defaults. A field copies the values when it is created. To
 * show other values in a world, create another field and pass it to the world (sgm_world_set_field); chunks that do not
 * depend on the changed values stay unchanged:
 *   sgm_parameters_set(parameters, "wet", 0.7, &error);
 *   field_desc.parameters = parameters;
 *   sgm_field_create(runtime, &field_desc, &field, &error);
 *   sgm_world_set_field(world, field, &error);
 *   sgm_field_destroy(field);    the world keeps the field alive while it needs it */
typedef struct sgm_parameters sgm_parameters;

SGM_API sgm_result sgm_parameters_create(const sgm_grammar* grammar, sgm_parameters** out, sgm_error* error);
SGM_API sgm_result sgm_parameters_destroy(sgm_parameters* parameters);
/* Sets a parameter. SGM_ERR_NOT_FOUND: the grammar has no such parameter (the message suggests the most similar name).
 * SGM_ERR_INVALID_ARGUMENT: the value is not finite, not a whole number although required, or outside the parameter's
 * range. On failure nothing changes. */
SGM_API sgm_result sgm_parameters_set(sgm_parameters* parameters, const char* name, double value, sgm_error* error);
/* Sets a parameter from a text in the syntax of the language, such as "0.3", "50%" or "12m". A length without a unit is
 * in the grammar's `units`, if the grammar has that line. SGM_ERR_GRAMMAR: the text is not a number, or has a wrong
 * unit. Other errors: those of sgm_parameters_set. */
SGM_API sgm_result sgm_parameters_set_text(sgm_parameters* parameters, const char* name, const char* text,
                                           sgm_error* error);
SGM_API sgm_result sgm_parameters_get(const sgm_parameters* parameters, const char* name, double* value,
                                      sgm_error* error);

/* ---------------------------------------------------------------------------------------------------------- fields */

/* A field: a grammar with parameters, seed and finest cell size, which together determine the world. Its results never
 * change; it has a cache of derived cells. */
typedef struct sgm_field sgm_field;

/* A lattice of points at which a host field is sampled in one call: origin + spacing * (x, y, z), in units, all of them
 * in the world. The value of point (x, y, z) is stored at index (z * count[1] + y) * count[0] + x. */
typedef struct sgm_host_lattice {
  int32_t origin[3]; /* units */
  int32_t spacing;   /* distance between points in units: the cell edge of the level that is meshed. Omit detail finer
                        than this */
  uint32_t count[3]; /* number of points on each axis, at least 1; in total at most 2^25, usually 36^3 */
} sgm_host_lattice;

/* Samples a host field: writes its value in metres at each point, negative in the solid, and returns SGM_OK. With any
 * other result, the library call or chunk that needs the points fails: with the same code if it is
 * SGM_ERR_INVALID_ARGUMENT, LIMIT, RANGE or IO, otherwise with SGM_ERR_UNSUPPORTED. A value that is not finite is also
 * a failure. A world does not request a failed chunk again until an edit or another field has changed it. So if data is
 * still loading, wait for it, or return values without it. Called from any thread, also concurrently; must not call the
 * library or throw C++ exceptions. */
typedef sgm_result (*sgm_host_sample)(void* user, const sgm_host_lattice* lattice, float* values);

typedef enum sgm_host_flag {
  SGM_HOST_CUT = 1, /* subtracts the host field's solid from the world; without this flag, its solid is added */
  SGM_HOST_FLAG_FORCE_32_BIT = 0x7FFFFFFF
} sgm_host_flag;

/* A host field: a field that the engine computes, in addition to the grammar's, such as a terrain, or rooms from
 * another program. It is meshed, streamed, queried and edited like everything else, also outside a finite domain. The
 * grammar's rules do not take it into account.
 * Its values are rounded to 1/1024 unit and interpolated linearly between the sample points of each level; normals come
 * from differences over two cells. For neighbouring chunks to match, a point must have the same value whenever it is
 * sampled with the same spacing; for all machines to match, all must compute it in the same way.
 * Ray casts and closest-point queries sample all cells that they come near: SGM_ERR_LIMIT if there are more than
 * 2^25. */
typedef struct sgm_host_field {
  uint32_t struct_size;
  const void* next;
  sgm_host_sample sample;
  void* user;         /* must outlive the field and everything made from it */
  uint64_t identity;  /* identifies the sampled values: use another number if any value differs. Files of the cache and
                         the journal that were written under another identity count as those of another world. 0:
                         nothing can be kept on disk */
  int32_t minimum[3]; /* in units: the host field's solid must lie within this box. The field is sampled up to four
                         cells and the blend's width beyond it; solid there is cut off, at a distance that depends on
                         the level's cells */
  int32_t maximum[3];
  float steepness;   /* maximum change of the value per metre, 0 to 1000; 1 for a distance. If given, chunks far from
                        the surface sample the host field at a single point, and values beyond both 16 m and the change
                        over two cells count as far away, which also limits wide blends of edits. A chunk fails if its
                        values change faster than that. 0: unknown */
  uint32_t flags;    /* bits of sgm_host_flag */
  uint16_t material; /* index for sgm_grammar_material; 0: the default material. With SGM_HOST_CUT: the material of the
                        cut surface; 0: the material of the solid that is cut */
  uint16_t tag;      /* index for sgm_grammar_tag */
  int32_t smooth;    /* width of the blend with the rest of the world, 0 to 16,384 units; 0: no blend */
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
  const sgm_parameters* parameters; /* values for the parameters of this grammar; copied. NULL: defaults */
  uint64_t seed;                    /* combined with the grammar's own `seed` */
  int32_t cell_units;               /* edge of a level-0 cell, 1 to 2^20 units; see sgm_cell_from_metres */
  sgm_backend backend;              /* SGM_ERR_UNSUPPORTED if it is not usable here */
  uint64_t cache_bytes;             /* approximate size of the cache of derived cells; 0: 64 MiB */
  const sgm_host_field* hosts;      /* host fields, combined with what the grammar derives, in this order; copied. NULL:
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

/* Rounds a cell edge in metres to the nearest whole number of units (0.1 m becomes 102 units, which is 0.099609375 m).
 * SGM_ERR_INVALID_ARGUMENT: not a number, below half a unit (which would round to 0), or above 2^20 units. */
SGM_API sgm_result sgm_cell_from_metres(double metres, int32_t* units, sgm_error* error);

/* Points at which to sample a field, and arrays for the results. Results of point i are written to element i of each
 * array that is not NULL. */
typedef struct sgm_sample_desc {
  uint32_t struct_size;
  const void* next;
  const int32_t* points; /* x y z in units */
  size_t point_stride;   /* bytes from one point to the next, a multiple of 4; 0: 12 */
  size_t count;          /* number of points; 0 is allowed */
  int32_t level;         /* level of detail, 0 to SGM_MAX_LEVEL: detail that chunks of this level omit is omitted here
                            too */
  int32_t* q;            /* quantised field, from which meshes are made: floor(field * 1024 / finest cell + 0.5),
                            clamped to +-2^22; negative in the solid */
  float* values;         /* field in metres, negative in the solid: a distance near a surface; if no shape is within a
                            cell or two, a constant of +-10^30 units (9.8 * 10^26 m) with gradient 0 */
  float* gradients;      /* 3 per point: gradient of the field per metre; points out of the solid */
  uint16_t* materials;   /* material of the shape whose surface is nearest to the point */
  uint16_t* tags;
} sgm_sample_desc;

#define SGM_SAMPLE_DESC_INIT \
  { SGM_SIZEOF(sgm_sample_desc), SGM_NULL, SGM_NULL, 0, 0, 0, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL }

/* Evaluates the field at points, exactly as meshing does. Blocks; uses the job system. On failure the arrays' contents
 * are unspecified. SGM_ERR_LIMIT: deriving a cell reached a limit of the language (line and column locate the
 * statement), or more than 2^20 cells of a layer have shapes that can reach one chunk. SGM_ERR_RANGE: the level's cells
 * are larger than 2^22 units. */
SGM_API sgm_result sgm_field_sample(sgm_field* field, const sgm_sample_desc* desc, sgm_error* error);

/* An anchor: an oriented point for the game, such as a spawn point or a door, placed by the grammar. */
typedef struct sgm_anchor {
  int32_t position[3]; /* units */
  float rotation[9];   /* row-major, orthonormal: maps a world direction to the anchor's local direction */
  uint16_t kind;       /* index for sgm_grammar_name */
  uint16_t name;       /* index for sgm_grammar_name */
  uint16_t tag;        /* index for sgm_grammar_tag */
  uint16_t reserved;   /* 0 */
  uint64_t key;        /* unique number of the anchor, the same in every run */
} sgm_anchor;

/* Returns the anchors in the box minimum <= p < maximum (units), ordered by layer, cell and key. Derives cells that are
 * not cached, on the calling thread. *count is the capacity of `anchors` on entry, and the number of anchors in the box
 * on return. If anchors is NULL, only *count is set. SGM_INCOMPLETE: the array was too small, and holds the first
 * anchors. SGM_ERR_LIMIT: same as for sgm_field_sample, or more than 2^24 cells of a layer have shapes that can reach
 * the box. */
SGM_API sgm_result sgm_field_anchors(sgm_field* field, const int32_t minimum[3], const int32_t maximum[3],
                                     sgm_anchor* anchors, size_t anchor_stride, size_t* count, sgm_error* error);

/* --------------------------------------------------------------------------------------------- queries of the field */

/* Queries of the field itself at level 0, which need no mesh: what a ray hits, which surface is nearest, where a walker
 * can stand. All of them block, derive cells that are not cached, and work on the calling thread; many threads may call
 * them concurrently. The results are the same on every machine, and equally exact at any distance from the origin.
 * Positions are in units, as double, and may lie between units. Common errors, each with a message that names the
 * cause: SGM_ERR_INVALID_ARGUMENT (a value is not finite, or out of its range), SGM_ERR_RANGE (a position outside the
 * world), SGM_ERR_LIMIT (a distance or size above the documented limit, or same as for sgm_field_sample). On failure
 * `out` is unchanged. */

/* A point on the surface. Filled by sgm_field_ray_cast and sgm_field_closest_point. */
typedef struct sgm_surface_point {
  uint32_t struct_size;
  void* next;
  int32_t found;      /* 0: no surface was found, and all members below are 0 */
  int32_t inside;     /* 1: the queried position lies inside the solid */
  double position[3]; /* units */
  double normal[3];   /* unit normal, points out of the solid */
  double distance;    /* distance from the queried position, in metres */
  uint16_t material;  /* index for sgm_grammar_material */
  uint16_t tag;       /* index for sgm_grammar_tag */
  uint32_t reserved;  /* 0 */
} sgm_surface_point;

#define SGM_SURFACE_POINT_INIT \
  { SGM_SIZEOF(sgm_surface_point), SGM_NULL, 0, 0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 0.0, 0, 0, 0 }

typedef struct sgm_ray_desc {
  uint32_t struct_size;
  const void* next;
  double from[3];      /* start of the ray in units; must lie in the world */
  double direction[3]; /* direction, of any length except 0 */
  double length;       /* length of the ray in metres: 0 to the larger of 4,096 m and 8,192 cells */
} sgm_ray_desc;

#define SGM_RAY_DESC_INIT \
  { SGM_SIZEOF(sgm_ray_desc), SGM_NULL, {0.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, 1.0 }

/* Finds the first point where a ray hits the solid. A ray that starts in the solid hits it immediately (`inside`). The
 * search misses no solid that the ray crosses over a length of at least a sixteenth of a cell and at least one unit; so
 * it misses no wall as thick as a cell. The point lies on the void's side, less than a unit from the solid. The ray
 * ends at the world's border. */
SGM_API sgm_result sgm_field_ray_cast(sgm_field* field, const sgm_ray_desc* desc, sgm_surface_point* out,
                                      sgm_error* error);

typedef struct sgm_closest_desc {
  uint32_t struct_size;
  const void* next;
  double position[3];  /* position in units; must lie in the world */
  double max_distance; /* search radius in metres: 0 to the larger of 64 m and 256 cells */
} sgm_closest_desc;

#define SGM_CLOSEST_DESC_INIT \
  { SGM_SIZEOF(sgm_closest_desc), SGM_NULL, {0.0, 0.0, 0.0}, 1.0 }

/* Finds the surface point nearest to a position in the void or in the solid. Searches the surface that the samples of
 * level 0 show. The result is farther away than the nearest point of this surface by at most a quarter of a cell plus
 * 1/64 of the distance; usually it is exact to a unit. The work grows with the square of the distance found. */
SGM_API sgm_result sgm_field_closest_point(sgm_field* field, const sgm_closest_desc* desc, sgm_surface_point* out,
                                           sgm_error* error);

/* A box to search, and a walker, which is an upright cylinder. Lengths are in metres. */
typedef struct sgm_walk_desc {
  uint32_t struct_size;
  const void* next;
  int32_t minimum[3], maximum[3]; /* search box in units, minimum < maximum: floors at minimum <= p < maximum count.
                                     Extended by the walker's size, it may cover at most 4,096 chunks of 32 cells, all
                                     in the world */
  double radius;                  /* radius of the walker: 0 to 64 cells */
  double height;                  /* height of the walker: above 0, at most 256 cells */
  double step;                    /* maximum height difference to a neighbouring place that the walker can climb or
                                     drop; at least 0, below height */
  double slope;                   /* minimum y component of a floor's normal: the cosine of the steepest angle, 0 to
                                     1 */
  double area;                    /* minimum area of connected floor for the box to count as walkable, in square metres;
                                     0 or more */
} sgm_walk_desc;

#define SGM_WALK_DESC_INIT \
  { SGM_SIZEOF(sgm_walk_desc), SGM_NULL, {0, 0, 0}, {0, 0, 0}, 0.3, 1.8, 0.4, 0.7071067811865476, 1.0 }

/* Filled by sgm_field_is_walkable. Areas are in square metres, seen from above, in multiples of a cell's area. */
typedef struct sgm_walkable {
  uint32_t struct_size;
  void* next;
  int32_t walkable; /* 1: `largest` is above 0 and at least sgm_walk_desc.area */
  uint32_t sides;   /* side faces of the box that the largest connected floor touches, bit (1u << sgm_face): a walker
                       can cross a passage if both of its ends are among them */
  double standing;  /* area of all floor on which the walker can stand */
  double largest;   /* area of the largest connected part of that floor */
} sgm_walkable;

#define SGM_WALKABLE_INIT \
  { SGM_SIZEOF(sgm_walkable), SGM_NULL, 0, 0, 0.0, 0.0 }

/* Finds out where a walker can stand in a box, and how large the largest connected floor is. Uses the samples of level
 * 0, which are a cell apart. The walker can stand on a column of samples under three conditions: there is a floor in
 * the box (solid below void) whose normal is within the slope; there is only void from the floor up to the walker's
 * height; and within the walker's radius no solid lies above the height of its step (plus the rise of the slope up to
 * there) and below its head. Neighbouring columns are connected if their floors differ in height by at most the step
 * plus the rise of the slope over a cell. */
SGM_API sgm_result sgm_field_is_walkable(sgm_field* field, const sgm_walk_desc* desc, sgm_walkable* out,
                                         sgm_error* error);

/* ---------------------------------------------------------------------------------------------------- chunk meshes */

/* The mesh of one chunk, packed for drawing. Immutable and reference-counted. */
typedef struct sgm_mesh sgm_mesh;

/* Identifies a chunk, a cube of 32 x 32 x 32 cells of its level. The cell edge is the field's cell_units << level, and
 * the lowest corner is (x, y, z) times the chunk's edge. */
typedef struct sgm_chunk_key {
  int32_t level; /* 0 to SGM_MAX_LEVEL */
  int32_t x, y, z;
} sgm_chunk_key;

/* Faces of a chunk. In a mask, a face is the bit (1u << face). */
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

/* Reports the progress of a long operation. Called after every chunk: `done` rises by one each time, up to `total`.
 * Called on any thread, but never concurrently; other chunks continue in the meantime, so the function should be short.
 * It must not call the library.
 * Returns 0 to continue; any other value stops the operation with SGM_ERR_CANCELLED. In the last call (done == total)
 * the value is ignored, and remaining work, for example texture coordinates, is finished. Stopping is not immediate:
 * chunks that have begun are finished, and up to 64 chunks are derived before the first of them is meshed. */
typedef int32_t (*sgm_progress_function)(void* user, uint64_t done, uint64_t total);

/* Flags for optional contents of meshes. Streamed worlds have their own flags: sgm_world_flag. */
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
  size_t count;                   /* number of requests, 1 to 2^20 */
  sgm_progress_function progress; /* or NULL */
  void* progress_user;
  uint32_t flags;    /* bits of sgm_meshing_flag */
  uint32_t reserved; /* 0 */
} sgm_chunks_desc;

#define SGM_CHUNKS_DESC_INIT \
  { SGM_SIZEOF(sgm_chunks_desc), SGM_NULL, SGM_NULL, 0, 0, SGM_NULL, SGM_NULL, 0, 0 }

/* Meshes chunks: meshes[i] receives the mesh of requests[i], empty if no surface crosses the chunk. Blocks; uses the
 * job system. Pass many chunks in one call. On any failure all desc->count entries of `meshes` are NULL; nothing is
 * written if `meshes` is NULL, or `desc` itself is refused (NULL, SGM_ERR_STRUCT_SIZE, SGM_ERR_UNSUPPORTED).
 * SGM_ERR_RANGE: a chunk does not lie completely in the world, or its level's cells are larger than 2^22 units.
 * SGM_ERR_LIMIT: count is above 2^20, deriving a cell reached a limit of the language (line and column locate the
 * statement), or more than 2^20 cells of a layer have shapes that can reach one chunk. */
SGM_API sgm_result sgm_mesh_chunks(sgm_field* field, const sgm_chunks_desc* desc, sgm_mesh** meshes, sgm_error* error);

/* Adds or removes an owner (reference) of a mesh. Removing the last owner destroys the mesh; afterwards both functions
 * return SGM_ERR_INVALID_ARGUMENT for it, like a function that destroys a handle twice. Both accept NULL. */
SGM_API sgm_result sgm_mesh_acquire(sgm_mesh* mesh);
SGM_API sgm_result sgm_mesh_release(sgm_mesh* mesh);

/* What a vertex stands for: an edge of a grid of samples that the surface crosses. Vertices are the same if their edges
 * are the same, also in different chunks. Each has a key, by which meshes are welded and checked without a tolerance.
 * The key is { corner, level, axis, fan }. With positions in units (possibly fractional) and each level's cell edge:
 *   own      level is the chunk's own; axis the one coordinate that is not a multiple of its cell; corner the position
 *            rounded down to multiples of that cell; fan 0
 *   coarser  as own, but with level + 1 and the cell of that level
 *   lateral  level is the chunk's own; axis 3; corner the position itself, a multiple of the cell of level + 1. fan
 *            distinguishes the vertices at one corner, each of which joins seams that meet in an edge or a corner of
 *            the chunk. Around the corner lie 8 blocks, one per octant, and between octants that share a face lie 12
 *            quarter planes, numbered 4 * (axis of the normal) + (high side on the lower of the other axes) + 2 * (on
 *            the higher one). A quarter plane with a block of the chunk's size on one side and a coarser chunk on the
 *            other carries a seam, and seams that touch in a half axis from the corner share the vertex: fan is the
 *            lowest number of those joined to this vertex's own seam. sgm_chunk_request.coarser says which blocks are
 *            coarser.
 *   feature  with sharp features: a point of an edge or a corner of the surface, in a face of the grid or in a cell. A
 *            body has a copy of the vertex for each side of the crease, a seam has one; vertices with equal keys count
 *            as one vertex. level is the chunk's own, or the one above if bit 13 of kind is set (only in seams). axis
 *            is 7 in a cell (bit 14), else 4 + bits 6 and 7. fan is bits 6 to 9 in a cell, else bits 8 to 11. corner
 *            is, on each axis, the position rounded down to multiples of the level's cell, minus (b - 1) of these
 *            cells, where b is the number in the two bits of kind that begin at bit 2 * axis: a feature may lie up to a
 *            cell beyond its face or cell, but no feature of a body lies beyond its chunk */
typedef enum sgm_vertex_kind {
  SGM_VERTEX_OWN = 0,          /* on an edge of the chunk's own level; every vertex of a body, except feature
                                  vertices */
  SGM_VERTEX_COARSER = 1,      /* on an edge of the next coarser level; only in seams */
  SGM_VERTEX_LATERAL = 2,      /* on a corner, where the two levels meet; only in seams */
  SGM_VERTEX_FEATURE = 0x8000, /* a flag for feature vertices; the other bits identify the feature */
  SGM_VERTEX_KIND_FORCE_32_BIT = 0x7FFFFFFF
} sgm_vertex_kind;

/* A packed vertex, 16 bytes, the same on every backend. */
typedef struct sgm_vertex {
  int16_t x, y, z;            /* in 1/256 of the chunk's cell edge, relative to the chunk's origin: 0 to 8,192; feature
                                 vertices of the coarser level: -400 to 8,592 */
  uint16_t material;          /* index for sgm_grammar_material */
  int16_t normal_x, normal_y; /* octahedral, +-32,767: with n = normal / 32767 and w = 1 - |n.x| - |n.y|, the normal is
                                 (n.x, n.y, w) if w >= 0, else ((1 - |n.y|) * sign(n.x), (1 - |n.x|) * sign(n.y), w),
                                 scaled to unit length; sign(0) is 1 */
  uint16_t tag;               /* index for sgm_grammar_tag */
  uint16_t kind;              /* an sgm_vertex_kind; for a feature vertex, also bits that identify the feature */
} sgm_vertex;

/* A range of a chunk's mesh: its body or one of its seams. Always draw the body; draw a seam if the neighbour across
 * its face is drawn one level coarser. */
typedef struct sgm_mesh_range {
  uint32_t first_vertex, vertex_count;
  uint32_t first_index, index_count;
  uint64_t hash; /* hash of the range's vertices and triangles, equal on every machine */
} sgm_mesh_range;

/* Consecutive anchors of a mesh that have the same kind and name: instances of one object, for engines that draw
 * instanced. */
typedef struct sgm_instance_batch {
  uint16_t kind, name;   /* indices for sgm_grammar_name */
  uint32_t first, count; /* range in the arrays `anchors` and `transforms` of the mesh */
} sgm_instance_batch;

/* A vertex with texture coordinates in one texture chart, and with one pair of materials. Coordinates count tiles of 1
 * m, for repeating textures: u x v points out of the solid, so textures are never mirrored. Whole tiles may be
 * subtracted from coordinates, so that floats are precise to 1/4,096 at any distance from the origin: in adjacent
 * chunks, the coordinates of the same point may differ by whole tiles; shares are equal. A seam's vertices on edges of
 * the coarser level are textured like the coarser chunks, unless the two levels have different shapes there. */
typedef struct sgm_wedge {
  uint32_t vertex; /* index of the vertex in the mesh */
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

/* Pointers to the data of a mesh, valid until the mesh is destroyed. */
typedef struct sgm_mesh_view {
  uint32_t struct_size;
  void* next;
  sgm_chunk_key key;
  int32_t origin[3];     /* lowest corner of the chunk, in units */
  int32_t cell_units;    /* cell edge of this chunk: the field's cell_units << level */
  int32_t bounds_min[3]; /* bounds of all vertices including seams, in units; all 0 if there are no vertices */
  int32_t bounds_max[3];
  const sgm_vertex* vertices;           /* vertices of the body, then of the seams in the order of their faces */
  const uint32_t* indices;              /* into vertices (not relative to the range), three per triangle */
  uint32_t vertex_count, vertex_stride; /* stride in bytes */
  uint32_t index_count, index_stride;
  sgm_mesh_range body;
  sgm_mesh_range seams[6];   /* ranges of the seams, by sgm_face; empty if not requested */
  uint64_t hash;             /* hash of body and seams together */
  const sgm_anchor* anchors; /* anchors in this chunk, including its low faces but not its high faces; ordered by kind,
                                name and key */
  uint32_t anchor_count, anchor_stride;
  const uint16_t* tags; /* tags that occur in the vertices, ascending, without 0 */
  uint32_t tag_count;
  uint32_t batch_count;
  const sgm_instance_batch* batches; /* batches of the anchors */
  const float* transforms; /* 12 per anchor, a row-major 3 x 4 matrix: from the anchor's axes to the chunk's, in metres
                              from origin */
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

/* Copies a mesh into the caller's memory. On entry the counts are the capacities of the arrays (in elements), on return
 * the counts of the mesh. If an array is NULL, only its count is set. SGM_INCOMPLETE: an array was too small, and
 * nothing was written to it. The counts must not be NULL. */
SGM_API sgm_result sgm_mesh_copy(const sgm_mesh* mesh, sgm_vertex* vertices, size_t vertex_stride, size_t* vertex_count,
                                 uint32_t* indices, size_t index_stride, size_t* index_count, sgm_error* error);

/* ------------------------------------------------------------------------------- surfaces: welded, for tools */

/* A mesh with float positions and without duplicate vertices, made from a region of many chunks, or from a grid of the
 * caller. Immutable. */
typedef struct sgm_surface sgm_surface;

typedef struct sgm_region_desc {
  uint32_t struct_size;
  const void* next;
  int32_t minimum[3], maximum[3]; /* units, minimum < maximum; extended to whole chunks of the level */
  int32_t level;                  /* 0 to SGM_MAX_LEVEL */
  uint32_t flags;                 /* bits of sgm_meshing_flag */
  uint64_t max_chunks;            /* SGM_ERR_LIMIT if the region has more; 0: 65,536; at most 2^24 */
  sgm_progress_function progress; /* progress callback, or NULL; counts meshed chunks, but not the work after meshing */
  void* progress_user;
} sgm_region_desc;

#define SGM_REGION_DESC_INIT \
  { SGM_SIZEOF(sgm_region_desc), SGM_NULL, {0, 0, 0}, {0, 0, 0}, 0, 0, 0, SGM_NULL, SGM_NULL }

/* Meshes a region, and welds its chunks by the vertices' keys, without a tolerance. The surface has open edges only
 * where the region's outer faces cut the solid. Blocks; uses the job system. SGM_ERR_RANGE: the region, extended to
 * whole chunks, leaves the world, or the level's cells are larger than 2^22 units. SGM_ERR_LIMIT: more than max_chunks
 * chunks, more vertices than 32-bit indices can address, or same as for sgm_mesh_chunks. */
SGM_API sgm_result sgm_surface_from_region(sgm_field* field, const sgm_region_desc* desc, sgm_surface** out,
                                           sgm_error* error);

/* A grid of samples that the caller provides. Sample (i, j, k) has the value values[i + j * stride_y + k * stride_z]
 * and the position (i * cell, j * cell, k * cell). */
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

/* Meshes a grid of samples. The surface has open edges only where the grid's border cuts the solid. Blocks; uses the
 * job system. */
SGM_API sgm_result sgm_surface_from_grid(sgm_runtime* runtime, const sgm_grid_desc* desc, sgm_surface** out,
                                         sgm_error* error);

SGM_API sgm_result sgm_surface_destroy(sgm_surface* surface);

/* Pointers to the data of a surface, valid until the surface is destroyed. */
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
  uint64_t chunk_count;               /* number of meshed chunks; 1 for a grid */
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

/* Returns a hash. For a surface of a region, it is the hash of the set of its chunks' meshes, equal on every machine
 * and in any order of work. For a grid, it is the hash of positions, normals and triangles, computed in each call. 0
 * for NULL. */
SGM_API uint64_t sgm_surface_hash(const sgm_surface* surface);

/* ---------------------------------------------------------------------------- voids: is there a path from A to B? */

/* Path search: can an agent (a ball) move from one place to another through the void of a region, and on which path?
 * The search uses the samples of level 0, which are a cell apart. A sample is free for the agent if no solid sample
 * lies within the agent's radius of it; with radius 0 all of the void is free. Free samples are connected along the
 * axes and across the diagonals of cell faces, in the same way as meshes connect voids. So a path is accurate to within
 * a few cells: between two successive samples of the path, solid samples may be nearer than the radius by up to 0.71
 * cells, and the surface lies up to 1.74 cells before a solid sample, usually less than one. A given position is
 * replaced by the nearest void sample of the eight around it; if none of them is void, the position is in rock. */

typedef enum sgm_way_verdict {
  SGM_WAY_FOUND = 0,
  SGM_WAY_FROM_IN_ROCK = 1,
  SGM_WAY_TO_IN_ROCK = 2,
  SGM_WAY_FROM_TOO_NARROW = 3, /* `from` is in the void, but the agent does not fit there */
  SGM_WAY_TO_TOO_NARROW = 4,
  SGM_WAY_APART = 5, /* the agent fits at both ends, but no path in the region connects them */
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
  double radius;                  /* radius of the agent in metres: 0 to less than 32 cells */
  uint32_t flags;                 /* bits of sgm_way_flag */
  uint32_t reserved;              /* 0 */
  uint64_t max_chunks;            /* SGM_ERR_LIMIT if the region has more; 0: 65,536; at most 2^24 */
  int32_t* places;                /* receives the path's places, x y z each, in units; or NULL */
  size_t place_room;              /* capacity of places, in places */
  sgm_progress_function progress; /* progress callback, or NULL. It counts chunks: those of the region, from 1 again in
                                     each pass over it; then those of the path, if there is one, from 1 with their own
                                     total */
  void* progress_user;
} sgm_way_desc;

#define SGM_WAY_DESC_INIT                                                                                     \
  {                                                                                                           \
    SGM_SIZEOF(sgm_way_desc), SGM_NULL, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0, 0, 0}, {0, 0, 0}, 0.3, 0, 0, 0, \
        SGM_NULL, 0, SGM_NULL, SGM_NULL                                                                       \
  }

/* The result of sgm_field_find_way. Lengths are in metres, volumes in cubic metres. */
typedef struct sgm_way {
  uint32_t struct_size;
  void* next;
  int32_t verdict;       /* an sgm_way_verdict */
  uint32_t reserved;     /* 0 */
  uint64_t place_count;  /* number of places on the path; 0 if there is no path */
  double length;         /* length of the path in metres */
  double from_clearance; /* distance from the start's sample to the nearest solid sample, at most 32 cells; 0 in rock.
                            It is the smallest radius that does not fit there; to_clearance is the same for the end */
  double to_clearance;
  double widest;      /* with SGM_WAY_WIDEST: a path exists for every radius below this value, and for no radius from
                         this value on. 32 cells also stand for anything larger; 0: no agent has a path. Without the
                         flag: 0 */
  double from_volume; /* volumes of the voids that contain the start (from) and the end (to), for this radius; 0 if the
                         agent does not fit there */
  double to_volume;
  double largest_volume; /* volume of the region's largest void */
  uint64_t void_count;   /* number of separate voids in the region, for this radius */
  uint64_t sealed_count; /* number of these voids that do not touch the region's border */
} sgm_way;

#define SGM_WAY_INIT \
  { SGM_SIZEOF(sgm_way), SGM_NULL, 0, 0, 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0, 0 }

/* Finds a path. Its places are samples of level 0, each joined with the previous one, from the sample of `from` to that
 * of `to`: a short path, though not always the shortest. The search goes through the region along its longest axis.
 * Memory: the signs of the samples of about two layers of chunks perpendicular to that axis, and of one more chunk on
 * every side (8.7 KB per chunk that the surface crosses); the faces of one layer (2.2 KB for each that a void touches,
 * 17 times that with SGM_WAY_WIDEST); for the whole region about 300 bytes for each void of each chunk (450 with
 * SGM_WAY_WIDEST), and the field's cache of derived cells; for the path 12 bytes per place, up to 300 per chunk, and up
 * to 20 MB during its search. The answer is the same on every machine and with any number of threads. Blocks; uses the
 * job system. Returns SGM_OK also if there is no path: the verdict says why. SGM_INCOMPLETE: places was too small; it
 * holds the first ones. SGM_ERR_RANGE: the region, with one chunk around it, leaves the world. On failure `out` is
 * unchanged. */
SGM_API sgm_result sgm_field_find_way(sgm_field* field, const sgm_way_desc* desc, sgm_way* out, sgm_error* error);

/* ------------------------------------------------------------------------------------------ measures: of any mesh */

/* The histogram of dihedral angles, section 7.4 of the paper: an edge e from V1 to V2 with outward unit normals n1, n2
 * has d = acos(e.n2) - acos(e.n1), below 0 where the surface is convex. Normals are those of the welded triangles,
 * averaged at each point by area. */
typedef enum sgm_histogram_mode {
  SGM_HISTOGRAM_CORRECTED = 0, /* v = 1/2 - d / (2 pi): flat at 1/2, convex above */
  SGM_HISTOGRAM_PRINTED = 1,   /* v = d / (2 (pi + 1)), as equation 13 of the paper is printed: the numbers of many bins
                                  are 0 or negative */
  SGM_HISTOGRAM_CURVATURE = 2, /* v = 1/2 - atan(L d / |e|) / pi, with L = curvature_length: the histogram does not
                                  narrow as the mesh becomes finer */
  SGM_HISTOGRAM_MODE_FORCE_32_BIT = 0x7FFFFFFF
} sgm_histogram_mode;

typedef enum sgm_measure_flag {
  SGM_MEASURE_UNIQUE_EDGES = 1,          /* the histogram counts each edge once, not once per triangle as in the
                                            paper */
  SGM_MEASURE_NO_SELF_INTERSECTIONS = 2, /* skips self-intersections, about half of the work */
  SGM_MEASURE_FLAG_FORCE_32_BIT = 0x7FFFFFFF
} sgm_measure_flag;

/* A triangle mesh of the caller, in any unit of length: resulting areas are in its square, volumes in its cube. */
typedef struct sgm_measure_desc {
  uint32_t struct_size;
  const void* next;
  const float* positions;         /* three per point, may be infinite or NaN; or NULL, if positions_double is given */
  const double* positions_double; /* three per point; or NULL, if positions is given */
  uint64_t position_count;        /* at most 2^32 - 1 */
  uint64_t position_stride;       /* bytes from one point to the next; 0: three numbers */
  const uint32_t* indices;        /* three per triangle, counter-clockwise seen from outside, below position_count */
  uint64_t index_count;           /* a multiple of 3, at most 2^32 - 1 */
  double weld;                    /* points at most this far apart are merged; 0: only points with equal coordinates
                                     are. Finite */
  double cubes;                   /* edge length of the cubes for the volume by equation 8 of the paper; 0: no cubes */
  int32_t histogram_mode;         /* an sgm_histogram_mode */
  uint32_t histogram_bins;        /* number of bins (R in the paper), 1 to 4,096; if it is odd, all flat edges are in
                                     one bin */
  double curvature_length;        /* length L of SGM_HISTOGRAM_CURVATURE, above 0: a ball of radius L has v = 3/4 at
                                     every edge */
  uint32_t flags;                 /* bits of sgm_measure_flag */
  uint32_t histogram_capacity;    /* capacity of histogram */
  double* histogram;              /* array that receives the share of the edges in each bin, starting with bin
                                     histogram_first; or NULL */
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
  uint64_t welded_points;        /* number of points that were merged with others */
  uint64_t non_finite_triangles; /* triangles with a corner that is NaN or beyond 1e37; excluded from all counts
                                    below */
  double area;                   /* surface area by equation 7 of the paper */
  double volume;                 /* volume of a closed mesh, by the divergence theorem, relative to the centre of the
                                    bounds */
  double area_vector[3];         /* sum of the area vectors of all triangles: 0 for a closed mesh, up to rounding */
  double bounds_min[3], bounds_max[3];
  uint64_t objects; /* number of parts connected through points (section 7.3 of the paper) */
  uint64_t shells;  /* number of parts connected across edges */
  int64_t euler;    /* sum of the Euler characteristics of all shells; a point with several fans counts once in each */
  int64_t genus;    /* sum of the genera of all shells; -1 if a shell is non-manifold or one-sided */
  uint64_t edges, open_edges;    /* number of all edges, and of boundary edges, which have only one triangle */
  uint64_t turned_edges;         /* misoriented edges: their two triangles face different ways */
  uint64_t nonmanifold_edges;    /* edges with three triangles or more */
  uint64_t nonmanifold_vertices; /* vertices that join several fans of triangles */
  uint64_t degenerate_triangles; /* triangles with two corners at one position; flat_triangles have no area either */
  uint64_t duplicate_triangles;
  uint64_t sliver_triangles;           /* triangles for which 4 sqrt(3) area / (sum of squared edges) is below 0.05 */
  uint64_t inside_out_shells;          /* closed shells that face inward and are not in a solid */
  uint64_t cavity_shells;              /* closed shells that face inward and are in a solid */
  uint64_t nested_shells;              /* closed shells that face outward and are in a solid: their contents count
                                          twice */
  uint64_t self_intersections;         /* pairs of triangles that intersect outside common corners and edges, computed
                                          exactly, without folded_triangles; a lower bound if
                                          self_intersections_complete is 0 */
  int32_t self_intersections_complete; /* 0: self-intersections were not searched, or too many triangles lie close
                                          together, so that there may be more */
  int32_t histogram_first;             /* number of the first bin by equation 14: 1; in mode PRINTED it may be less */
  uint64_t histogram_bins;             /* number of bins; SGM_INCOMPLETE if histogram is given but too small */
  uint64_t histogram_edges;            /* number of edges that the histogram counts */
  uint64_t histogram_left_out;         /* number of edges that the histogram omits, because they have no length or no
                                          normal */
  double flat, convex, concave;        /* shares of flat, convex and concave edges, 0..1 */
  /* Volumes by equation 8 of the paper: of all cubes with all corners inside, with any corner inside, and with the
   * centre inside. 0 if `cubes` is 0. */
  double cubes_all, cubes_any, cubes_centre;
  uint64_t flat_triangles;   /* triangles whose corners lie on one line, computed exactly */
  uint64_t folded_triangles; /* pairs of triangles that share an edge and overlap, computed exactly; a lower bound if
                                self_intersections is one */
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

/* The density volume is for renderers of fog: clouds, smoke, or anything that a grammar with `output density`
 * (sgm_domain_info) describes. shaders/volume has a working renderer, and cites the papers that it follows. */

typedef enum sgm_density_format {
  SGM_DENSITY_UNORM8 = 0, /* uint8_t, to the nearest 1/255, like textures of the format R8_UNORM */
  SGM_DENSITY_FLOAT32 = 1,
  SGM_DENSITY_FORMAT_FORCE_32_BIT = 0x7FFFFFFF
} sgm_density_format;

/* A lattice of points origin + spacing * (x, y, z), 0 <= x < size[0] and so on: the texel centres of a 3D texture. Two
 * volumes that share their border points filter linearly without a visible border.
 * Density is 0 exactly where sgm_sample_desc.q is 0 or positive, so it begins at the mesh of the same level; from there
 * it increases with depth and never decreases. With t = depth / edge, where depth is -q in units, density is 2 t^2 up
 * to t = 1/2, then 1 - 2 (1 - t)^2, and 1 from t = 1 on (shaders/common/density.h). Depth is the value of the field,
 * which is a distance near a surface. The depth in a host field with a steepness counts as infinite from 16 m on, or
 * from the change that the steepness allows over two cells if that is more. */
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
  sgm_density_format format; /* format of the values */
  uint32_t reserved;         /* 0 */
  void* values;              /* address of the first point's value; x varies fastest, then y, then z */
  size_t row_pitch;          /* bytes from (x, y, z) to (x, y + 1, z), as for a texture upload: a multiple of the
                                value's size, at least size[0] values; 0: that minimum */
  size_t slice_pitch;        /* bytes from (x, y, z) to (x, y, z + 1): a multiple of the value's size, at least size[1]
                                times row_pitch; 0: that minimum */
  sgm_progress_function progress; /* progress callback, or NULL; counts blocks of 32^3 points (8^3 if the field has host
                                     fields) */
  void* progress_user;
} sgm_density_desc;

#define SGM_DENSITY_DESC_INIT                                                                                         \
  {                                                                                                                   \
    SGM_SIZEOF(sgm_density_desc), SGM_NULL, {0, 0, 0}, SGM_UNITS_PER_METRE, {0, 0, 0}, 0, 0.0, SGM_DENSITY_UNORM8, 0, \
        SGM_NULL, 0, 0, SGM_NULL, SGM_NULL                                                                            \
  }

/* Samples the density of any grammar at points of a lattice. Blocks; uses the job system, but not the field's backend.
 * The values are the same on every machine, and do not depend on how a lattice is divided into volumes; padding bytes
 * between rows are not written. On failure the array's contents are unspecified. SGM_ERR_RANGE: a point outside the
 * world, or same as for sgm_field_sample. SGM_ERR_LIMIT: same as for sgm_field_sample. SGM_ERR_CANCELLED: progress
 * requested it. */
SGM_API sgm_result sgm_field_sample_density(sgm_field* field, const sgm_density_desc* desc, sgm_error* error);

/* ---------------------------------------------------------------------------------------------- worlds: streaming */

/* A streamed field: chunks of every level of detail around moving viewers, meshed on the job system and delivered frame
 * by frame. The drawn chunks form one closed surface at all times: seams connect finer to coarser chunks, the outer
 * faces of the world are closed against the domain's own state (solid or void), and chunks stay drawn until everything
 * that replaces them is ready.
 * Calls in each frame of the engine
 *   sgm_world_set_viewers     sets the cameras
 *   sgm_world_update          collects finished work and starts more; never waits
 *   sgm_world_poll            returns the changes; call it until there are none, then draw
 * Worlds can be dug into and built on (sgm_world_edit). Each frame shows one consistent state of the edits, with a
 * closed surface: an edit is drawn with the next frame of changes or the one after it. */
typedef struct sgm_world sgm_world;
/* The collision mesh of one chunk, for a physics engine. Immutable and reference-counted. */
typedef struct sgm_collider sgm_collider;

typedef enum sgm_world_flag {
  SGM_WORLD_BY_DISTANCE = 1, /* level 0 is drawn wherever a viewer is near enough. Without this flag, only where also a
                                path through the void leads there from a viewer: near chunks behind rock stay one level
                                coarser, and are never seen */
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
                             meshing time; for chunks that a GPU meshes it takes the same time, which is a larger share
                             */
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
  uint64_t cache_bytes;     /* maximum total size of the files in cache_folder; 0: 1 GiB */
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
 * for streaming, or the distances need more chunks than can be planned for (the message suggests values); the journal
 * is in use, or too large. SGM_ERR_RANGE: the cells of top_level are larger than 2^22 units. SGM_ERR_INVALID_ARGUMENT:
 * top_level is out of range; a distance is not finite, or not above 0 (collider_distance: below 0); a journal, a
 * cache_folder or a store is used with a host field whose identity is 0.
 * SGM_ERR_DATA: the journal belongs to another world (grammar, parameters, seed, cell, host fields) or is not an edit
 * journal (the file stays unchanged); a folder is not a store, or a store of another version.
 * SGM_ERR_IO: the journal or the folder can be neither read nor created. SGM_ERR_UNSUPPORTED: built without a disk
 * cache; or SGM_WORLD_RESIDENT, but the field's backend does not use an external device. */
SGM_API sgm_result sgm_world_create(sgm_field* field, const sgm_world_desc* desc, sgm_world** out, sgm_error* error);

/* Destroys a world. Waits for its running jobs (each plans, or meshes a chunk or a batch), and writes the journal. No
 * more jobs of this world are started, but other worlds may continue to plan. Meshes stay valid until the engine
 * releases them. */
SGM_API sgm_result sgm_world_destroy(sgm_world* world);

/* A camera, or another place around which the world is streamed. */
typedef struct sgm_viewer {
  double position[3]; /* metres, inside the world */
  float direction[3]; /* view direction, of any length; chunks in view come first. All 0: all directions */
  float velocity[3];  /* metres per second, at most 10,000: the surroundings of its position in half a second are
                         streamed too */
  float fov;          /* vertical field of view in radians, at most 3; a narrower one shows detail from farther away. 0:
                         70 degrees, for which the world's distances hold */
  float weight;       /* factor on the world's distances for this viewer, 0.01 to 100, limited by the number of chunks
                         that can be planned for */
} sgm_viewer;

#define SGM_VIEWER_INIT \
  { {0.0, 0.0, 0.0}, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0.0f, 1.0f }

/* Replaces all viewers. Without viewers (count 0) the drawn chunks stay, and nothing is meshed.
 * SGM_ERR_INVALID_ARGUMENT: a value is not finite, or out of its range; SGM_ERR_RANGE: a viewer is outside the world,
 * or too fast; SGM_ERR_LIMIT: more than 256 viewers. On failure the viewers are unchanged. Never waits. */
SGM_API sgm_result sgm_world_set_viewers(sgm_world* world, const sgm_viewer* viewers, size_t viewer_stride,
                                         size_t count, sgm_error* error);

/* Collects finished work, and starts more on the job system. Does not wait for jobs or devices (but a job that the job
 * system refuses runs immediately in this call). Delivers at most max_bytes of vertices and indices; a larger frame of
 * changes takes several updates, and the drawn chunks change with the last of them.
 * A small max_bytes delays meshes, but loses none: a mesh larger than max_bytes is delivered as the first one of an
 * update, and its excess is subtracted from the max_bytes of the following updates. So any k updates deliver at most
 * the sum of their max_bytes plus one mesh.
 * All worlds of a runtime take turns in planning, which uses a quarter of the workers' time while there is enough to
 * mesh: more frequent updates, or more worlds, do not keep the workers from meshing. SGM_INCOMPLETE, without any
 * effect: events of the previous update have not all been polled. SGM_ERR_INVALID_ARGUMENT: max_bytes is 0. */
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
                             its place. If edits had changed the chunk, the world is drawn without them until a further
                             edit, for example an undo; if a new field had changed it, the previous field is drawn */
  SGM_EVENT_COLLIDER = 6, /* collide with `collider` instead of the chunk's previous one: the engine owns it now and
                             must release it. Follows soon after a change of the drawn chunk, at most
                             sgm_world_desc.max_colliders per update, and not if the collider is equal to the previous
                             one; not counted in max_bytes */
  SGM_EVENT_COLLIDER_REMOVED = 7, /* stop colliding with the chunk. If chunks of another level take its place, this
                                     event comes after their colliders */
  SGM_EVENT_KIND_FORCE_32_BIT = 0x7FFFFFFF
} sgm_event_kind;

/* One change of the drawn world. Chunks without triangles and anchors have no events; a chunk that has only anchors has
 * a mesh without triangles. */
typedef struct sgm_world_event {
  sgm_event_kind kind;
  sgm_result result; /* for FAILED; else SGM_OK */
  sgm_chunk_key key;
  sgm_mesh* mesh;         /* for READY; else NULL */
  sgm_collider* collider; /* for COLLIDER; else NULL */
  uint32_t seams;         /* for SHOWN, REPLACED and SEAMS: mask of sgm_face */
  uint32_t coarser;       /* for the same events: blocks around the chunk that belong to coarser chunks, as in
                             sgm_chunk_request.coarser; 0 if no seam is drawn */
  uint64_t frame; /* number of the frame of changes that the event belongs to; 0 for READY, FAILED and colliders */
} sgm_world_event;

/* Returns the next events, in order. *count is the array's capacity on entry, and the number of events written on
 * return; 0 if no event is left. All changes of a frame are delivered between two updates: draw only after all of them
 * are polled. On failure nothing was delivered, and *count is 0; the event that could not be delivered (out of memory)
 * is the first one of the next call. */
SGM_API sgm_result sgm_world_poll(sgm_world* world, sgm_world_event* events, size_t event_stride, size_t* count,
                                  sgm_error* error);

/* Adds or removes an owner (reference) of a collider. Removing the last owner destroys the collider; afterwards both
 * functions return SGM_ERR_INVALID_ARGUMENT for it, like a function that destroys a handle twice. Both accept NULL. */
SGM_API sgm_result sgm_collider_acquire(sgm_collider* collider);
SGM_API sgm_result sgm_collider_release(sgm_collider* collider);

/* Pointers to the data of a collider, valid until the collider is destroyed. Its triangles are those of the chunk's
 * body and drawn seams, except triangles of area 0. Colliders of neighbouring chunks meet without gaps. */
typedef struct sgm_collider_view {
  uint32_t struct_size;
  void* next;
  sgm_chunk_key key;
  int32_t origin[3]; /* origin of the chunk in units; positions are relative to it */
  uint32_t vertex_count;
  uint32_t index_count;
  const float* positions;    /* 3 per vertex, metres */
  const uint32_t* indices;   /* three per triangle, counter-clockwise seen from the void */
  const uint16_t* materials; /* one per triangle: index for sgm_grammar_material */
  uint64_t hash;             /* hash of the three arrays: equal for equal colliders of a chunk, in every run */
} sgm_collider_view;

#define SGM_COLLIDER_VIEW_INIT \
  { SGM_SIZEOF(sgm_collider_view), SGM_NULL, {0, 0, 0, 0}, {0, 0, 0}, 0, 0, SGM_NULL, SGM_NULL, SGM_NULL, 0 }

SGM_API sgm_result sgm_collider_get_view(const sgm_collider* collider, sgm_collider_view* view, sgm_error* error);

/* A drawn chunk that has triangles or anchors. */
typedef struct sgm_drawn_chunk {
  sgm_chunk_key key;
  sgm_mesh* mesh; /* the caller becomes an additional owner: release it */
  uint32_t seams, coarser;
} sgm_drawn_chunk;

/* Returns all drawn chunks, ordered by key, for code that starts after their events were delivered. *count is the
 * capacity of `chunks` on entry, and the number of drawn chunks on return. If chunks is NULL, only *count is set.
 * SGM_INCOMPLETE: the array was too small; nothing was written. */
SGM_API sgm_result sgm_world_get_drawn(sgm_world* world, sgm_drawn_chunk* chunks, size_t chunk_stride, size_t* count,
                                       sgm_error* error);

/* Blocks until everything that the viewers request is drawn, as far as possible (see SGM_EVENT_FAILED and
 * sgm_world_stats.chunks_failed): for loading screens, tools and tests. The calling thread takes part in the work.
 * Performs updates without a byte limit, so events accumulate and must be polled afterwards. progress (or NULL) is
 * called from time to time with the number of meshed chunks, and of all chunks known to be needed; any result other
 * than 0 ends the wait with SGM_ERR_CANCELLED. SGM_ERR_LIMIT: mesh_bytes does not suffice. */
SGM_API sgm_result sgm_world_wait_idle(sgm_world* world, sgm_progress_function progress, void* progress_user,
                                       sgm_error* error);

/* Replaces the world's field by a field with other parameters, of an edited grammar (hot reload), or with other host
 * fields. Jobs find the differences; only chunks that the differences affect are meshed again (counted by
 * sgm_world_stats.chunks_outdated), and all of them are replaced in one frame of changes. Never waits, so a parameter
 * can be set ten times a second: if fields are set faster than they can be drawn, all but the last are skipped, and
 * half of the jobs' time remains for new chunks around the viewers. Without viewers the field is not drawn until there
 * are some. If a chunk of the new field cannot be made (SGM_EVENT_FAILED), the world returns to the previous field.
 * sgm_world_stats.field_drawn tells which of these fields is drawn; until the new field is drawn, the names of
 * materials, tags and anchors are those of the previous grammar. Edits stay, and keep the numbers of their materials
 * and tags; a number that the new grammar lacks has no name there. The world keeps the backend that it was created
 * with, and keeps each field alive while it needs the field. Up to five fields may exist at the same time, each with a
 * cache (sgm_field_desc.cache_bytes); they share equal derived cells. Everything that host fields use must live as long
 * as the world, which may return to a previous field. Values of a host field must not change without a change of its
 * identity; host fields of identity 0 always count as changed.
 * A journal belongs to the field with which the world was created: to open it again, create the world with that field,
 * then set the other field. The disk cache keeps chunks of every field: use none for a world whose parameters change
 * all the time.
 * SGM_ERR_INVALID_ARGUMENT: the field is of another runtime or has other cell_units; or it has a host field of identity
 * 0, and the world keeps data on disk. */
SGM_API sgm_result sgm_world_set_field(sgm_world* world, sgm_field* field, sgm_error* error);

/* Discards all chunks that wait to be meshed; chunks that are being meshed are discarded when they are finished. Drawn
 * chunks stay. The next update plans again for the current viewers: to stop streaming, first set no viewers. */
SGM_API void sgm_world_cancel(sgm_world* world);

typedef enum sgm_brush_shape {
  SGM_BRUSH_SPHERE = 0,
  SGM_BRUSH_BOX = 1,
  SGM_BRUSH_CAPSULE = 2,
  SGM_BRUSH_SHAPE_FORCE_32_BIT = 0x7FFFFFFF
} sgm_brush_shape;

/* A shape to dig out or to add. All lengths are in whole units, 1 to 2^20, so that the result is the same on every
 * machine. Members that the shape does not use are ignored. */
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
  int32_t radius;    /* radius of a sphere or a capsule */
  int32_t smooth;    /* width of the blend with the world; 0: none */
} sgm_brush;

#define SGM_BRUSH_INIT \
  { SGM_BRUSH_SPHERE, 1, 0, 0, {0, 0, 0}, {0, 0, 0}, {1024, 1024, 1024}, {0.0f, 0.0f, 0.0f, 1.0f}, 1024, 0 }

/* Identifies an edit in all worlds that exchange edits. If both members are 0: no edit. */
typedef struct sgm_edit_id {
  uint64_t author, number;
} sgm_edit_id;

/* Applies a brush on top of the grammar's shapes and of earlier edits. The brush is visible at every level of detail
 * whose cells are no larger than its thickness. Never waits for a job or the disk. id (or NULL) receives the edit's id,
 * for sgm_world_undo. SGM_ERR_INVALID_ARGUMENT: a length is out of its range, `turn` is 0, or the material or tag does
 * not exist. SGM_ERR_RANGE: the brush leaves the world. SGM_ERR_LIMIT: more than 2^20 edits. */
SGM_API sgm_result sgm_world_edit(sgm_world* world, const sgm_brush* brush, sgm_edit_id* id, sgm_error* error);

/* Undoes an edit of any author; if the edit is itself an undo, redoes what it undid. undone (or NULL) receives the id
 * of this undo. SGM_ERR_NOT_FOUND: this world does not know the edit. */
SGM_API sgm_result sgm_world_undo(sgm_world* world, const sgm_edit_id* id, sgm_edit_id* undone, sgm_error* error);

/* Returns the known edits in their order of arrival, except for the first `since`, as bytes for another world with the
 * same grammar, parameters, seed and cell. The other world may also have a new version of the grammar if the edited
 * places still suit it (such a world would refuse the journals of the previous version). *count is the capacity of
 * `bytes` on entry, and the number of bytes on return. If bytes is NULL, only *count is set. SGM_INCOMPLETE: the bytes
 * did not fit; nothing was written. sgm_world_stats.edits is the number of known edits: pass its value at the previous
 * export as `since`, to export only newer edits. */
SGM_API sgm_result sgm_world_export_edits(sgm_world* world, uint64_t since, void* bytes, size_t* count,
                                          sgm_error* error);

/* Adds the edits of another world, either all or none; edits that are already known have no effect. Worlds that have
 * exchanged all their edits, in any order, are equal. SGM_ERR_DATA: the bytes do not come from sgm_world_export_edits,
 * or contradict known edits. SGM_ERR_LIMIT: more than 2^20 edits. */
SGM_API sgm_result sgm_world_import_edits(sgm_world* world, const void* bytes, size_t count, sgm_error* error);

/* Blocks until all edits so far are in the journal on disk: call it when the game saves. SGM_ERR_IO: the journal could
 * not be written. No edit is lost: the world tries again a second later, and the message says how many edits are not on
 * disk. */
SGM_API sgm_result sgm_world_flush_edits(sgm_world* world, sgm_error* error);

/* Returns a hash of the set of edits; equal in worlds that know the same edits. 0 for NULL. */
SGM_API uint64_t sgm_world_edits_hash(const sgm_world* world);

/* The same queries as for a field (sgm_field_ray_cast, sgm_field_closest_point, sgm_field_is_walkable,
 * sgm_field_find_way), for the world with its edits. All edits count, even if they are not drawn yet. */
SGM_API sgm_result sgm_world_ray_cast(sgm_world* world, const sgm_ray_desc* desc, sgm_surface_point* out,
                                      sgm_error* error);
SGM_API sgm_result sgm_world_closest_point(sgm_world* world, const sgm_closest_desc* desc, sgm_surface_point* out,
                                           sgm_error* error);
SGM_API sgm_result sgm_world_is_walkable(sgm_world* world, const sgm_walk_desc* desc, sgm_walkable* out,
                                         sgm_error* error);
SGM_API sgm_result sgm_world_find_way(sgm_world* world, const sgm_way_desc* desc, sgm_way* out, sgm_error* error);

/* Same as sgm_field_sample_density, for the world with its edits: fog is removed where it was dug out. */
SGM_API sgm_result sgm_world_sample_density(sgm_world* world, const sgm_density_desc* desc, sgm_error* error);

/* Returns the hash of the set of chunk bodies of a level in a region, extended to whole chunks. If nothing was edited,
 * it equals sgm_surface_hash of the same region, on every machine, whatever was streamed before. Uses drawn chunks and
 * meshes the others; blocks. Errors: those of sgm_surface_from_region. */
SGM_API sgm_result sgm_world_hash(sgm_world* world, const int32_t minimum[3], const int32_t maximum[3], int32_t level,
                                  uint64_t* hash, sgm_error* error);

/* Statistics of a world, filled by sgm_world_get_stats. Counters count since the world's creation, unless their
 * description says "now". */
typedef struct sgm_world_stats {
  uint32_t struct_size;
  void* next;
  uint64_t frame;          /* number of the frame drawn now; rises, not always by one */
  uint64_t plans;          /* number of plans made */
  uint64_t chunks_meshed;  /* chunk bodies that were meshed, or read from stores and cache_folder */
  uint64_t finest_meshed;  /* number of these bodies at level 0 */
  uint64_t seam_jobs;      /* number of chunks to which seams were added later */
  uint64_t chunks_in_vain; /* chunks that were meshed but never drawn, and are no longer needed */
  uint64_t chunks_failed;
  uint64_t stale;      /* chunks now waiting or being meshed that were planned for previous viewers */
  uint64_t queued;     /* chunks that wait to be meshed now */
  uint64_t in_work;    /* chunks being meshed now */
  uint64_t drawn;      /* chunks drawn now that have triangles or anchors */
  uint64_t kept;       /* chunks known now, whether drawn or empty or not: in an idle world at most twice the needed
                          chunks, plus 1,024 */
  uint64_t mesh_bytes; /* size of all meshes now, including those that the engine owns, in bytes */
  uint64_t peak_mesh_bytes;
  double detail;            /* factor on the distances of levels of detail: below 1 if mesh_bytes does not suffice */
  int32_t idle;             /* 1: everything that the viewers request is drawn, as far as possible, including edits and
                               colliders */
  uint32_t reserved;        /* 0 */
  uint64_t fields_set;      /* number of calls of sgm_world_set_field */
  uint64_t field_drawn;     /* number, counted from 1, of the call of sgm_world_set_field whose field is drawn now; 0:
                               the field at creation */
  uint64_t chunks_outdated; /* chunks that an edit or another field caused to be meshed again */
  uint64_t collider_bytes;  /* size of the chunks' colliders now, in bytes */
  uint64_t edits;           /* number of known edits: brushes, undos and redos */
  uint64_t edits_state;     /* number of the world's current state; rises with every change by edits or another field */
  uint64_t edits_drawn;     /* number of the state (edits_state) that is drawn now */
  uint64_t cache_hits;      /* chunk parts (bodies and seams) that were found in cache_folder */
  uint64_t cache_misses;    /* chunk parts that were not found in cache_folder, including parts proven to be empty,
                               which are not stored */
  uint64_t cache_damaged;   /* of the cache misses, chunk parts whose data was invalid */
  uint64_t cache_bytes;     /* total size of the files in cache_folder, as far as they were examined */
  uint64_t store_hits;      /* chunk parts found in stores; parts from a slow server may arrive too late to be used */
  uint64_t store_misses;    /* chunk parts that were not found in stores, or did not arrive in time */
  uint64_t store_damaged;   /* of the store misses, chunk parts whose data was invalid */
  uint64_t store_bytes;     /* bytes read from stores for the hits */
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

/* The settings and resources of a world, filled by sgm_world_get_info. Only the counters in `backend` change. */
typedef struct sgm_world_info {
  uint32_t struct_size;
  void* next;
  sgm_backend_info backend; /* the world's backend, as sgm_backend_query would fill it now. Of a device's memory only
                               `resident` is known, not the memory of the driver or the device's scratch memory */
  int32_t cell_units;       /* cell edge at level 0, in units */
  int32_t top_level;
  uint32_t flags;                                           /* bits of sgm_world_flag */
  uint32_t threads;                                         /* number of threads that may work for the world
                                                               concurrently */
  double finest_distance, view_distance, collider_distance; /* metres */
  uint64_t mesh_bytes;                                      /* limit of the mesh memory in bytes, never 0 */
} sgm_world_info;

#define SGM_WORLD_INFO_INIT \
  { SGM_SIZEOF(sgm_world_info), SGM_NULL, SGM_BACKEND_INFO_INIT, 0, 0, 0, 0, 0.0, 0.0, 0.0, 0 }

/* Returns a world's settings and resources. Never waits for a job or a device. */
SGM_API sgm_result sgm_world_get_info(const sgm_world* world, sgm_world_info* info, sgm_error* error);

/* Returns the viewers of the last sgm_world_set_viewers. *count and SGM_INCOMPLETE work in the same way as in
 * sgm_world_get_drawn. Never waits for a job. */
SGM_API sgm_result sgm_world_get_viewers(const sgm_world* world, sgm_viewer* viewers, size_t viewer_stride,
                                         size_t* count, sgm_error* error);

#define SGM_TIME_BUCKETS 21
#define SGM_TIME_FIRST_EXPONENT (-16) /* counts[0] counts times up to 2^-16 s */

/* A histogram of the wall-clock times of an operation since the world's creation. counts[i] counts times above 2^(i -
 * 17) s and up to 2^(i - 16) s; the first element also counts shorter times, the last all times above 8 s. */
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
  sgm_time_histogram update;                  /* times of sgm_world_update, on the engine's thread */
  sgm_time_histogram poll;                    /* times of sgm_world_poll */
  sgm_time_histogram read;                    /* times to read a chunk body from cache_folder or stores, on any
                                                 thread */
  sgm_time_histogram mesh[SGM_MAX_LEVEL + 1]; /* by level: times to mesh a chunk body in a job, from the grammar to the
                                                 data of sgm_mesh_get_view. The time of bodies that a device meshes
                                                 together is divided equally */
  double clock_seconds;                       /* total wall-clock time in which at least one job meshed or read chunks,
                                                 including jobs for seams alone */
  double job_seconds; /* total time of these jobs: divided by clock_seconds, the average number of concurrent jobs. If a
                         job runs another one while it waits, the time counts for both */
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

/* Returns how long a world's operations took. The times are always measured, which costs two clock reads per call and
 * per chunk, and a lock per call that is held only to copy pointers. Never waits for a job. */
SGM_API sgm_result sgm_world_get_times(const sgm_world* world, sgm_world_times* times, sgm_error* error);

/* Possible defects of a chunk's mesh. A count other than 0 means a bug in the library, or a fault of the memory or the
 * driver. All except the first two and SGM_DEFECT_DEGENERATE are counted only for bodies: seams lie flat in their
 * faces, and are closed only together with their neighbours. */
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
  SGM_DEFECT_DUPLICATE = 6,   /* triangles with the same corners as another triangle */
  SGM_DEFECT_OPEN_EDGE = 7,   /* boundary edges (with only one triangle) that do not lie in a face of the chunk */
  SGM_DEFECT_TURNED_EDGE = 8, /* misoriented edges: two triangles use them in the same direction */
  SGM_DEFECT_NONMANIFOLD_EDGE = 9,   /* edges with more than two triangles */
  SGM_DEFECT_PINCHED_VERTEX = 10,    /* non-manifold vertices: their triangles form more than one fan */
  SGM_DEFECT_FOLDED = 11,            /* pairs of triangles that share an edge and overlap */
  SGM_DEFECT_SELF_INTERSECTION = 12, /* pairs of triangles that intersect outside common corners and edges */
  SGM_DEFECT_FORCE_32_BIT = 0x7FFFFFFF
} sgm_defect;

/* Measures of several bodies and seams, added up. The measures of each part are computed from integers, so a chunk has
 * bit-identical values with every backend, instruction set and number of threads. They are added in the order of the
 * frame's chunks; in another order the doubles may differ in their last bits. */
typedef struct sgm_chunk_sums {
  uint64_t bodies, seams; /* number of bodies and seams that have triangles */
  uint64_t triangles;
  uint64_t bytes;            /* size of vertices and indices */
  uint64_t sliver_triangles; /* triangles of poor shape, defined as for sgm_measures.sliver_triangles; not a defect */
  uint64_t against_normals;  /* triangles of bodies that do not face along their corners' normals (the field's
                                gradient); not a defect if a surface is as rough as the cells */
  uint64_t border_edges;     /* boundary edges of bodies in a face of their chunk: edges of one triangle */
  uint64_t compared;         /* number of vertices that were checked for SGM_DEFECT_SAMPLES */
  uint64_t defects[16];      /* number of defects, by sgm_defect; other elements are 0 */
  double area;               /* surface area in square metres */
  double area_vector[3];     /* square metres; 0 for a closed surface, up to rounding */
  double flux;               /* cubic metres: a third of the flux of the position, in metres from the world's origin,
                                through the surface. For a closed one the volume of the solid inside; below 0 if void is
                                inside, as in a cave in endless rock */
} sgm_chunk_sums;

/* Filled by sgm_world_get_measures. */
typedef struct sgm_world_measures {
  uint32_t struct_size;
  void* next;
  sgm_chunk_sums drawn;     /* sums over what is drawn now: bodies and their drawn seams, which together are one closed
                               surface */
  sgm_chunk_sums made;      /* sums over every body and seam each time that it was meshed or read, since creation. Their
                               area and flux belong to no actual surface */
  double measuring_seconds; /* total wall-clock time of the jobs' measuring of everything in `made` */
  double meshing_seconds;   /* total wall-clock time of the jobs' meshing, reading and packing of everything in `made`;
                               time in which jobs wait for each other counts more than once */
} sgm_world_measures;

#define SGM_CHUNK_SUMS_INIT \
  { 0, 0, 0, 0, 0, 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0.0, {0.0, 0.0, 0.0}, 0.0 }
#define SGM_WORLD_MEASURES_INIT \
  { SGM_SIZEOF(sgm_world_measures), SGM_NULL, SGM_CHUNK_SUMS_INIT, SGM_CHUNK_SUMS_INIT, 0.0, 0.0 }

/* Returns the measures of a world. Takes some microseconds per hundred drawn chunks; does not wait for jobs.
 * SGM_ERR_UNSUPPORTED: the world was created without SGM_WORLD_MEASURE. */
SGM_API sgm_result sgm_world_get_measures(const sgm_world* world, sgm_world_measures* measures, sgm_error* error);

/* Measures of one chunk's mesh, filled by sgm_mesh_get_measures. */
typedef struct sgm_mesh_measures {
  uint32_t struct_size;
  void* next;
  sgm_chunk_sums sums;      /* measures of the body and the requested seams together */
  uint64_t vertices, edges; /* vertices and edges of the body; vertices that a sharp crease has split count once */
  int64_t euler;            /* Euler characteristic of the body, which is open at the chunk's faces: vertices - edges +
                               triangles */
  uint64_t border_edges[6]; /* boundary edges of the body in each face, by sgm_face */
} sgm_mesh_measures;

#define SGM_MESH_MEASURES_INIT                                                                  \
  {                                                                                             \
    SGM_SIZEOF(sgm_mesh_measures), SGM_NULL, SGM_CHUNK_SUMS_INIT, 0, 0, 0, { 0, 0, 0, 0, 0, 0 } \
  }

/* Returns the measures of one chunk of a world that has SGM_WORLD_MEASURE. seams: the seams to include, bit (1 <<
 * sgm_face), as in sgm_drawn_chunk.seams; a seam that the mesh lacks adds nothing. May be called from any thread.
 * SGM_ERR_UNSUPPORTED: the mesh is from a world without that flag, or from sgm_mesh_chunks. SGM_ERR_INVALID_ARGUMENT:
 * seams has unknown bits. */
SGM_API sgm_result sgm_mesh_get_measures(const sgm_mesh* mesh, uint32_t seams, sgm_mesh_measures* measures,
                                         sgm_error* error);

#ifdef __cplusplus
}
#endif

#endif
