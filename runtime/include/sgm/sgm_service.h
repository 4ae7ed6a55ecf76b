/* clang-format off */
/*
 * sgm_service.h: the metrics service inside an engine, in its own library, sgm_service.
 *
 * A small HTTP server in the process. It has a page that shows what worlds stream and the quality of their meshes,
 * metrics for Prometheus, and reports on uploaded meshes. A thread of the service reads the worlds once a second; the
 * engine's threads do nothing for it.
 *
 * Two ports, each with its own thread: one for operators (/metrics, /healthz, /readyz), one for the page and /api/v1
 * (described by /api/v1/openapi.json), so that neither can delay the other. The command `sgm` reads external data
 * (meshes, grammars, reference histograms) in a sandboxed process, never in the engine.
 *
 * Conventions as in sgm.h. Memory comes from the C++ heap: some megabytes, plus at most 128 MiB for the reports that
 * are kept.
 */
/* clang-format on */
#ifndef SGM_SGM_SERVICE_H
#define SGM_SGM_SERVICE_H

#include <sgm/sgm.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct sgm_service sgm_service;

/* The settings of a service. Texts are copied. */
typedef struct sgm_service_desc {
  uint32_t struct_size;
  const void* next;
  uint32_t api_version;     /* SGM_API_VERSION of the header in use; the _INIT macro sets it */
  uint16_t work_port;       /* port of the page and /api/v1; 0: any free port */
  uint16_t operations_port; /* port of /metrics, /healthz and /readyz; 0: any free port */
  const char* address; /* listening address, numeric IPv4 or IPv6; NULL: "127.0.0.1". An address that others can reach
                          needs a token */
  const char* token;   /* at least 16 letters, digits and characters of -._~+/=, which clients send as "Authorization:
                          Bearer TOKEN" with all requests except /healthz, /readyz and the page's own files; NULL: no
                          token. The connection is not encrypted: put a proxy with TLS in front if that matters */
  const char* const* host_names; /* additional names under which clients reach this server, besides its address and
                                    localhost: a request with another Host header is refused */
  size_t host_name_count;
  const char* inspector;      /* path of the command `sgm`, of the same version, which inspects uploads; NULL: uploads
                                 are refused (503), everything else works */
  const char* masters;        /* file of reference histograms for the reports (`sgm masters build --out`); PUT
                                 /api/v1/masters may replace it, and creates it if missing. NULL: the built-in
                                 histograms */
  const char* upload_folder;  /* folder on whose disk uploads are stored during their inspection, as files without a
                                 name; NULL: the folder of temporary files */
  uint64_t upload_bytes;      /* maximum bytes of one upload, 1 to 2^32; 0: 64 MiB */
  uint64_t inspector_memory;  /* bytes of address space for one inspection; 0: 2 GiB */
  uint32_t inspector_seconds; /* time limit of one inspection in seconds, both of wall-clock and of processor time; 0:
                                 60 */
  uint32_t inspector_jobs;    /* maximum number of concurrent inspections, up to 64; 0: 2 */
  uint32_t inspector_waiting; /* maximum number of uploads that wait for an inspection, up to 4,096; 0: 16. Further
                                 uploads are refused with 503 */
} sgm_service_desc;

#define SGM_SERVICE_DESC_INIT                                                                                 \
  {                                                                                                           \
    SGM_SIZEOF(sgm_service_desc), SGM_NULL, SGM_API_VERSION, 0, 0, SGM_NULL, SGM_NULL, SGM_NULL, 0, SGM_NULL, \
        SGM_NULL, SGM_NULL, 0, 0, 0, 0, 0                                                                     \
  }

/* Starts the service on its own threads: two that listen on the ports, one that reads worlds, and one for each of
 * inspector_jobs. SGM_ERR_INVALID_ARGUMENT: the address is not numeric, or other machines can reach it but there is no
 * token; the token or a name is invalid; a number is out of its range. SGM_ERR_IO: a port is in use or not allowed, or
 * a thread could not be started. */
SGM_API sgm_result sgm_service_start(const sgm_service_desc* desc, sgm_service** out, sgm_error* error);

/* Returns the ports on which the service listens. Each pointer may be NULL. */
SGM_API sgm_result sgm_service_get_ports(const sgm_service* service, uint16_t* work_port, uint16_t* operations_port,
                                         sgm_error* error);

/* Makes the service show a world. name: letters, digits, '_', '-' and '.', at most 64. Call sgm_service_forget_world
 * before the world is destroyed. Never waits for a job. SGM_ERR_BUSY: the world or the name is already in use.
 * SGM_ERR_LIMIT: more than 16 worlds. */
SGM_API sgm_result sgm_service_watch_world(sgm_service* service, const char* name, sgm_world* world, sgm_error* error);

/* Stops showing a world. Returns when no thread of the service reads the world any more, within some milliseconds. Does
 * nothing if the service does not show the world. */
SGM_API sgm_result sgm_service_forget_world(sgm_service* service, sgm_world* world, sgm_error* error);

/* Stops the service: it accepts no more requests, answers those in progress within grace_milliseconds, ends the
 * inspecting processes, and ends all of its threads. Blocks until then. NULL does nothing. Using the handle afterwards,
 * or stopping it again, is undefined, because unlike other handles it is not remembered by a runtime. */
SGM_API sgm_result sgm_service_stop(sgm_service* service, uint32_t grace_milliseconds);

#ifdef __cplusplus
}
#endif

#endif
