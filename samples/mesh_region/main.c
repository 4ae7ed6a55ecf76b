/* mesh_region FILE.sgm OUT.obj: meshes a box of 32 m around an anchor of the grammar, or around the origin if no anchor
 * is near, and writes the welded surface as Wavefront OBJ. */
#include <inttypes.h>
#include <sgm/sgm.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Reads a file. Returns its text, terminated by 0, which the caller frees; NULL on failure. */
static char* read_file(const char* path) {
  FILE* file = fopen(path, "rb");
  char* text = NULL;
  size_t size = 0, room = 0, got = 0;
  if (file == NULL) return NULL;
  do {
    if (size + 1 >= room) {
      char* larger = (char*)realloc(text, room += 65536);
      if (larger == NULL) break;
      text = larger;
    }
    got = fread(text + size, 1, room - size - 1, file);
    size += got;
  } while (got > 0);
  if (ferror(file) || text == NULL || size + 1 > room) {
    free(text);
    text = NULL;
  } else {
    text[size] = '\0';
  }
  fclose(file);
  return text;
}

/* Writes the folder of a path to `folder`: imports are read from there. */
static void folder_of(const char* path, char* folder, size_t room) {
  const char* slash = strrchr(path, '/');
  if (slash == NULL) {
    snprintf(folder, room, ".");
  } else {
    snprintf(folder, room, "%.*s", (int)(slash - path + 1), path);
  }
}

static int write_obj(const char* path, const sgm_surface_view* view) {
  FILE* file = fopen(path, "wb");
  uint64_t i;
  int failed;
  if (file == NULL) return 0;
  for (i = 0; i < view->vertex_count; ++i) {
    const float* p = view->positions + i * (view->position_stride / sizeof(float));
    const float* n = view->normals + i * (view->normal_stride / sizeof(float));
    fprintf(file, "v %.9g %.9g %.9g\nvn %.6g %.6g %.6g\n", (double)p[0], (double)p[1], (double)p[2], (double)n[0],
            (double)n[1], (double)n[2]);
  }
  for (i = 0; i + 2 < view->index_count; i += 3) {
    const uint32_t* t = view->indices + i;
    fprintf(file, "f %" PRIu32 "//%" PRIu32 " %" PRIu32 "//%" PRIu32 " %" PRIu32 "//%" PRIu32 "\n", t[0] + 1, t[0] + 1,
            t[1] + 1, t[1] + 1, t[2] + 1, t[2] + 1);
  }
  failed = ferror(file);
  if (fclose(file) != 0) failed = 1;
  return !failed;
}

static int report_progress(void* user, uint64_t done, uint64_t total) {
  (void)user;
  fprintf(stderr, "\r%" PRIu64 "/%" PRIu64 " chunks%s", done, total, done == total ? "\n" : "");
  return 0;
}

/* Sets place to the first anchor within 128 m of the origin, in units; to the origin if there is none. */
static sgm_result find_place(sgm_field* field, int32_t place[3], sgm_error* error) {
  const int32_t low[3] = {-128 * SGM_UNITS_PER_METRE, -128 * SGM_UNITS_PER_METRE, -128 * SGM_UNITS_PER_METRE};
  const int32_t high[3] = {128 * SGM_UNITS_PER_METRE, 128 * SGM_UNITS_PER_METRE, 128 * SGM_UNITS_PER_METRE};
  sgm_anchor anchor;
  size_t count = 1;
  sgm_result result = sgm_field_anchors(field, low, high, &anchor, 0, &count, error);
  if (result >= SGM_OK && count > 0) memcpy(place, anchor.position, sizeof anchor.position);
  return result < SGM_OK ? result : SGM_OK;
}

static void print_diagnostics(const sgm_diagnostics* list) {
  uint32_t i;
  for (i = 0; i < sgm_diagnostics_count(list); ++i) {
    sgm_diagnostic d = SGM_DIAGNOSTIC_INIT;
    if (sgm_diagnostics_get(list, i, &d) != SGM_OK) continue;
    fprintf(stderr, "%s:%d:%d: %s: %s\n%s\n%*s^\n", d.file, d.line, d.column,
            d.severity == SGM_LOG_ERROR ? "error" : "warning", d.message, d.source_line, d.column - 1, "");
  }
}

int main(int argc, char** argv) {
  sgm_error error = SGM_ERROR_INIT;
  sgm_runtime* runtime = NULL;
  sgm_grammar* grammar = NULL;
  sgm_diagnostics* diagnostics = NULL;
  sgm_field* field = NULL;
  sgm_surface* surface = NULL;
  sgm_grammar_desc text = SGM_GRAMMAR_DESC_INIT;
  sgm_field_desc world = SGM_FIELD_DESC_INIT;
  sgm_region_desc region = SGM_REGION_DESC_INIT;
  sgm_surface_view view = SGM_SURFACE_VIEW_INIT;
  sgm_result result;
  char folder[4096];
  char* content;
  int32_t place[3] = {0, 0, 0};
  int axis;

  if (argc != 3) {
    fprintf(stderr, "usage: mesh_region FILE.sgm OUT.obj\n");
    return 2;
  }
  content = read_file(argv[1]);
  if (content == NULL) {
    fprintf(stderr, "mesh_region: cannot read %s\n", argv[1]);
    return 4;
  }
  folder_of(argv[1], folder, sizeof folder);
  text.text = content;
  text.name = argv[1];
  text.import_folder = folder;
  world.seed = 7;
  region.progress = report_progress;

  result = sgm_runtime_create(NULL, &runtime, &error);
  if (result == SGM_OK) result = sgm_grammar_compile(runtime, &text, &grammar, &diagnostics, &error);
  print_diagnostics(diagnostics);
  world.grammar = grammar;
  if (result == SGM_OK) result = sgm_cell_from_metres(0.5, &world.cell_units, &error);
  if (result == SGM_OK) result = sgm_field_create(runtime, &world, &field, &error);
  if (result == SGM_OK) result = find_place(field, place, &error);
  for (axis = 0; axis < 3; ++axis) {
    region.minimum[axis] = place[axis] - 16 * SGM_UNITS_PER_METRE;
    region.maximum[axis] = place[axis] + 16 * SGM_UNITS_PER_METRE;
  }
  if (result == SGM_OK) result = sgm_surface_from_region(field, &region, &surface, &error);
  if (result == SGM_OK) result = sgm_surface_get_view(surface, &view, &error);
  if (result == SGM_OK) {
    if (write_obj(argv[2], &view)) {
      printf("%s: %" PRIu64 " vertices, %" PRIu64 " triangles, hash %016" PRIx64 "\n", argv[2], view.vertex_count,
             view.index_count / 3, sgm_surface_hash(surface));
    } else {
      fprintf(stderr, "mesh_region: cannot write %s\n", argv[2]);
      result = SGM_ERR_IO;
    }
  } else {
    fprintf(stderr, "mesh_region: %s: %s\n", sgm_result_name(result), error.message);
  }

  sgm_surface_destroy(surface);
  sgm_field_destroy(field);
  sgm_grammar_destroy(grammar);
  sgm_diagnostics_destroy(diagnostics);
  sgm_runtime_destroy(runtime);
  free(content);
  return result == SGM_OK ? 0 : result == SGM_ERR_IO ? 4 : 1;
}
