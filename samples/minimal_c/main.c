#include <inttypes.h>
#include <sgm/sgm.h>
#include <stdio.h>

int main(int argc, char** argv) {
  sgm_error error = SGM_ERROR_INIT;
  sgm_runtime* runtime = NULL;
  sgm_grammar* grammar = NULL;
  sgm_field* field = NULL;
  sgm_mesh* mesh = NULL;

  sgm_grammar_desc text = SGM_GRAMMAR_DESC_INIT;
  text.text = argc > 1 ? argv[1] : "sgm 1; units m; start Ball; rule Ball { at(4m, 4m, 4m) sphere(3m); }";

  sgm_field_desc world = SGM_FIELD_DESC_INIT;
  world.seed = 7;
  world.cell_units = SGM_UNITS_PER_METRE / 4;

  sgm_chunk_request request = SGM_CHUNK_REQUEST_INIT;
  sgm_chunks_desc chunks = SGM_CHUNKS_DESC_INIT;
  chunks.requests = &request;
  chunks.count = 1;

  sgm_mesh_view view = SGM_MESH_VIEW_INIT;
  sgm_result result = sgm_runtime_create(NULL, &runtime, &error);
  if (result == SGM_OK) result = sgm_grammar_compile(runtime, &text, &grammar, NULL, &error);
  world.grammar = grammar;
  if (result == SGM_OK) result = sgm_field_create(runtime, &world, &field, &error);
  if (result == SGM_OK) result = sgm_mesh_chunks(field, &chunks, &mesh, &error);
  if (result == SGM_OK) result = sgm_mesh_get_view(mesh, &view, &error);
  if (result == SGM_OK) {
    printf("%" PRIu32 " triangles, hash %016" PRIx64 "\n", view.index_count / 3, view.hash);
  } else {
    fprintf(stderr, "%s: %s (line %d, column %d)\n", sgm_result_name(result), error.message, error.line, error.column);
  }

  sgm_mesh_release(mesh);
  sgm_field_destroy(field);
  sgm_grammar_destroy(grammar);
  sgm_runtime_destroy(runtime);
  return result == SGM_OK ? 0 : 1;
}
