/* A consumer in C: compiles a grammar, meshes a ball and checks the result. */
#include <sgm/sgm.h>
#include <stdio.h>

static int fail(const char* what, const sgm_error* error) {
  fprintf(stderr, "%s: %s: %s\n", what, sgm_result_name(error->code), error->message);
  return 1;
}

int main(void) {
  sgm_error error = SGM_ERROR_INIT;
  sgm_runtime* runtime = NULL;
  sgm_grammar* grammar = NULL;
  sgm_field* field = NULL;
  sgm_surface* surface = NULL;
  sgm_grammar_desc text = SGM_GRAMMAR_DESC_INIT;
  sgm_field_desc with = SGM_FIELD_DESC_INIT;
  sgm_region_desc region = SGM_REGION_DESC_INIT;
  sgm_surface_view view = SGM_SURFACE_VIEW_INIT;
  int axis;

  if (sgm_version() != SGM_API_VERSION) {
    fprintf(stderr, "the library's version is not the header's\n");
    return 1;
  }
  if (sgm_runtime_create(NULL, &runtime, &error)) return fail("runtime", &error);
  text.text = "sgm 1; units m; start Ball; rule Ball { sphere(3m); }";
  if (sgm_grammar_compile(runtime, &text, &grammar, NULL, &error)) return fail("grammar", &error);
  with.grammar = grammar;
  if (sgm_field_create(runtime, &with, &field, &error)) return fail("field", &error);
  for (axis = 0; axis < 3; ++axis) {
    region.minimum[axis] = -4 * SGM_UNITS_PER_METRE;
    region.maximum[axis] = 4 * SGM_UNITS_PER_METRE;
  }
  if (sgm_surface_from_region(field, &region, &surface, &error)) return fail("surface", &error);
  if (sgm_surface_get_view(surface, &view, &error)) return fail("view", &error);
  printf("%lu vertices, %lu triangles\n", (unsigned long)view.vertex_count, (unsigned long)(view.index_count / 3));
  /* Euler's formula for a closed surface of genus 0: V - F/2 = 2. */
  if (view.vertex_count == 0 || 2 * view.vertex_count - view.index_count / 3 != 4) return 1;

  sgm_surface_destroy(surface);
  sgm_field_destroy(field);
  sgm_grammar_destroy(grammar);
  return sgm_runtime_destroy(runtime) == SGM_OK ? 0 : 1;
}
