/* Rule 3: programs built against older and newer headers. An older structure is a prefix of this one; a newer one has more at its end. */
#include <stddef.h>
#include "expect.h"

/* A newer host's definition. */
typedef struct newer_def {
  shx_solver_def known;
  uint64_t future[2];
} newer_def;

/* A host that keeps strand definitions in structures of its own: the stride. */
typedef struct host_strand {
  char name[24];
  shx_strand_def def;
  int shade;
} host_strand;

int main(void) {
  shx_solver *solver = NULL;

  /* Older: ends before linear_solver; what follows in memory is not looked at. */
  shx_solver_def old;
  memset(&old, 0xee, sizeof old);
  EXPECT(shx_solver_def_init(&old, offsetof(shx_solver_def, linear_solver)) == SHX_OK);
  EXPECT(old.struct_size == offsetof(shx_solver_def, linear_solver));
  EXPECT(old.linear_solver == 0xeeeeeeee && old.reserved[1] == 0xeeeeeeeeeeeeeeee); /* nor written */
  EXPECT(shx_solver_create(&old, &solver) == SHX_OK);
  shx_solver_destroy(solver);
  solver = NULL;

  /* Newer: fine while the fields that this library does not know are zero. */
  newer_def newer;
  memset(&newer, 0xee, sizeof newer);
  EXPECT(shx_solver_def_init(&newer.known, sizeof newer) == SHX_OK);
  EXPECT(newer.known.struct_size == sizeof newer && newer.future[0] == 0 && newer.future[1] == 0);
  EXPECT(shx_solver_create(&newer.known, &solver) == SHX_OK);
  newer.future[1] = 1;
  shx_solver *none = NULL;
  EXPECT(shx_solver_create(&newer.known, &none) == SHX_ERROR_STRUCT_SIZE && none == NULL);

  /* Sizes that no version has. */
  const uint32_t impossible[] = {0, 1, 4, 8, 92, 97, 100, sizeof(shx_solver_def) + 4, 4104, 0xffffffff};
  for (size_t i = 0; i < sizeof impossible / sizeof impossible[0]; i++) {
    shx_solver_def def;
    EXPECT(shx_solver_def_init(&def, sizeof def) == SHX_OK);
    def.struct_size = impossible[i];
    EXPECT(shx_solver_create(&def, &none) == SHX_ERROR_STRUCT_SIZE && none == NULL);
    EXPECT(shx_solver_def_init(&def, impossible[i]) == SHX_ERROR_STRUCT_SIZE);
  }

  /* Older strand definitions, in an array with the host's stride. */
  host_strand strands[3];
  memset(strands, 0xee, sizeof strands);
  for (int i = 0; i < 3; i++) {
    EXPECT(shx_strand_def_init(&strands[i].def, offsetof(shx_strand_def, initial)) == SHX_OK);
    strands[i].def.length = 0.1 + 0.1 * i;
    strands[i].def.element_count = 3;
    strands[i].def.user_data = 40 + (uint64_t)i;
  }
  shx_strand_id ids[3];
  EXPECT(shx_solver_add_strands(solver, &strands[0].def, sizeof strands[0], 3, ids) == SHX_OK);
  for (int i = 0; i < 3; i++) {
    double lengths[3];
    uint64_t user_data;
    EXPECT(shx_solver_get_element_lengths(solver, ids[i], lengths, 3) == SHX_OK);
    EXPECT(lengths[0] > (0.1 + 0.1 * i) / 3 - 1e-15 && lengths[0] < (0.1 + 0.1 * i) / 3 + 1e-15);
    EXPECT(shx_solver_get_user_data(solver, ids[i], &user_data) == SHX_OK && user_data == 40 + (uint64_t)i);
  }

  /* An older report: only the fields that it has are written. */
  struct { shx_step_report report; uint64_t canary; } older;
  memset(&older, 0xee, sizeof older);
  EXPECT(shx_step_report_init(&older.report, offsetof(shx_step_report, substeps)) == SHX_OK);
  EXPECT(shx_solver_step(solver, 0.01, 2, &older.report) == SHX_OK);
  EXPECT(older.report.struct_size == offsetof(shx_step_report, substeps) && older.report.seconds > 0.0);
  EXPECT(older.report.substeps == 0xeeeeeeee && older.canary == 0xeeeeeeeeeeeeeeee);
  shx_step_report full;
  EXPECT(shx_step_report_init(&full, sizeof full) == SHX_OK);
  EXPECT(shx_solver_step(solver, 0.01, 2, &full) == SHX_OK && full.substeps == 2 && full.struct_size == sizeof full);
  shx_solver_destroy(solver);
  printf("older and newer structures work\n");
  return 0;
}
