/* clang-format off */
/*
 * sgm_service.h: the metrics service inside an engine, in the library sgm_service beside sgm.
 *
 * A small HTTP server of the process's own: a page that shows what worlds stream and how good it is, metrics for
 * Prometheus, and a verdict on any mesh that is handed in. It looks at worlds from a thread of its own, once a second;
 * the engine's threads do nothing for it.
 *
 * Two ports, each with a thread of its own: one for operators (/metrics, /healthz, /readyz), one for the page and
 * /api/v1 (described by /api/v1/openapi.json), so that nothing that happens on one can hold up the other. What comes
 * from outside (meshes, grammars, masters) is read by the command `sgm` in a limited process, never in the engine.
 *
 * Conventions as in sgm.h. Memory comes from the C++ heap: some megabytes, and what the reports that are kept take, at
 * most 128 MiB.
 */
/* clang-format on */
#ifndef SGM_SGM_SERVICE_H
#define SGM_SGM_SERVICE_H

#include <sgm/sgm.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct sgm_service sgm_service;

/* Texts are copied. */
typedef struct sgm_service_desc {
  uint32_t struct_size;
  const void* next;
  uint32_t api_version;     /* SGM_API_VERSION of the header in use; the _INIT macro sets it */
  uint16_t work_port;       /* of the page and /api/v1; 0: any that is free */
  uint16_t operations_port; /* of /metrics, /healthz and /readyz; 0: any that is free */
  const char* address; /* to listen on, IPv4 or IPv6 in numbers; NULL: "127.0.0.1". One that others can reach needs a
                          token */
  const char* token;   /* 16 characters or more, of letters, digits and -._~+/=, which clients send as "Authorization:
                          Bearer TOKEN" with all but /healthz, /readyz and the page's own files; NULL: none is asked for.
                          The connection is not encrypted: put a proxy with TLS in front where that matters */
  const char* const* host_names; /* under which clients may know this server, beside its address and localhost: a
                                    request with another Host is refused */
  size_t host_name_count;
  const char* inspector;      /* path of the command `sgm`, of the same version, which judges what is handed in; NULL:
                                 nothing can be (503), and all else works */
  const char* masters;        /* a base of masters for that (`sgm masters build --out`), which PUT /api/v1/masters may
                                 replace; made then where there is none. NULL: those that are built in */
  const char* upload_folder;  /* on whose disk uploads lie while they are judged, without a name; NULL: that of the
                                 machine's temporary files */
  uint64_t upload_bytes;      /* the most of one upload, 1 to 2^32; 0: 64 MiB */
  uint64_t inspector_memory;  /* bytes of address space for one inspection; 0: 2 GiB */
  uint32_t inspector_seconds; /* for one inspection, of the clock and of processor time; 0: 60 */
  uint32_t inspector_jobs;    /* inspections at one time, to 64; 0: 2 */
  uint32_t inspector_waiting; /* uploads that may wait beside those, to 4,096; 0: 16. More are refused with a 503 */
} sgm_service_desc;

#define SGM_SERVICE_DESC_INIT                                                                                 \
  {                                                                                                           \
    SGM_SIZEOF(sgm_service_desc), SGM_NULL, SGM_API_VERSION, 0, 0, SGM_NULL, SGM_NULL, SGM_NULL, 0, SGM_NULL, \
        SGM_NULL, SGM_NULL, 0, 0, 0, 0, 0                                                                     \
  }

/* Listens from then on, on threads of its own: two, one that looks at worlds, and one for each of inspector_jobs.
 * SGM_ERR_INVALID_ARGUMENT: an address that is not in numbers, or that others can reach, without a token; a token or a
 * name that is none; a number out of its range. SGM_ERR_IO: a port is in use or not allowed, no thread could be
 * started. */
SGM_API sgm_result sgm_service_start(const sgm_service_desc* desc, sgm_service** out, sgm_error* error);

/* The ports that are listened on. Each may be NULL. */
SGM_API sgm_result sgm_service_get_ports(const sgm_service* service, uint16_t* work_port, uint16_t* operations_port,
                                         sgm_error* error);

/* Shows a world under this name: letters, digits, '_', '-' and '.', 64 at most. The world must be forgotten before it
 * ends. Never waits for a job. SGM_ERR_BUSY: the world or the name is watched already. SGM_ERR_LIMIT: more than 16
 * worlds. */
SGM_API sgm_result sgm_service_watch_world(sgm_service* service, const char* name, sgm_world* world, sgm_error* error);

/* Returns when nothing looks at the world any more, within some milliseconds. Does nothing for one that is not watched.
 */
SGM_API sgm_result sgm_service_forget_world(sgm_service* service, sgm_world* world, sgm_error* error);

/* Takes no more requests, lets those that have begun be answered within so many milliseconds, ends the processes that
 * still inspect, and returns when no thread is left. Blocks. NULL does nothing. To use the handle after that, or to
 * stop it again, is undefined: there is no runtime that would remember it. */
SGM_API sgm_result sgm_service_stop(sgm_service* service, uint32_t grace_milliseconds);

#ifdef __cplusplus
}
#endif

#endif
