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
    EXPECT(shx_strand_def_init(&strands[i].def, offsetof(shx_strand_def, initial_curvatures)) == SHX_OK);
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
  memset(&older, 0xee, sizeof older);
  EXPECT(shx_step_report_init(&older.report, offsetof(shx_step_report, contacts)) == SHX_OK);
  EXPECT(shx_solver_step(solver, 0.01, 2, &older.report) == SHX_OK);
  EXPECT(older.report.substeps == 2 && older.report.contacts == 0xeeeeeeee && older.canary == 0xeeeeeeeeeeeeeeee);
  shx_step_report full;
  EXPECT(shx_step_report_init(&full, sizeof full) == SHX_OK);
  EXPECT(shx_solver_step(solver, 0.01, 2, &full) == SHX_OK && full.substeps == 2 && full.struct_size == sizeof full);

  /* Bodies, constraints and what strands are to contact: newer hosts, in structures of their own. */
  struct { char name[16]; shx_body_def def; uint64_t future; } bodies[2];
  struct { shx_constraint_def def; uint64_t future; int note; } pins[2];
  struct { shx_strand_contact contact; uint64_t future; } touching[3];
  shx_body_id body_ids[2];
  shx_constraint_id pin_ids[2];
  for (int i = 0; i < 2; i++) {
    EXPECT(shx_body_def_init(&bodies[i].def, sizeof(shx_body_def) + 8) == SHX_OK && bodies[i].future == 0);
    bodies[i].def.shape = SHX_SHAPE_SPHERE;
    bodies[i].def.radius = 0.01;
    EXPECT(shx_constraint_def_init(&pins[i].def, sizeof(shx_constraint_def) + 8) == SHX_OK && pins[i].future == 0);
    pins[i].def.strand = ids[i];
  }
  for (int i = 0; i < 3; i++) {
    EXPECT(shx_strand_contact_init(&touching[i].contact, sizeof touching[i]) == SHX_OK && touching[i].future == 0);
    touching[i].contact.radius = 1e-4 * (i + 1);
  }
  EXPECT(shx_solver_add_bodies(solver, &bodies[0].def, sizeof bodies[0], 2, body_ids) == SHX_OK);
  EXPECT(shx_solver_add_constraints(solver, &pins[0].def, sizeof pins[0], 2, pin_ids) == SHX_OK);
  EXPECT(shx_solver_set_strand_contact(solver, ids, 3, &touching[0].contact, sizeof touching[0]) == SHX_OK);
  for (int i = 0; i < 3; i++) {
    shx_strand_contact read;
    uint32_t touches;
    EXPECT(shx_strand_contact_init(&read, sizeof read) == SHX_OK);
    EXPECT(shx_solver_get_strand_contact(solver, ids[i], &read, &touches) == SHX_OK && touches == 1 && read.radius == 1e-4 * (i + 1));
  }
  bodies[1].future = pins[1].future = touching[2].future = 1;
  EXPECT(shx_solver_add_bodies(solver, &bodies[0].def, sizeof bodies[0], 2, body_ids) == SHX_ERROR_STRUCT_SIZE);
  EXPECT(shx_solver_add_constraints(solver, &pins[0].def, sizeof pins[0], 2, pin_ids) == SHX_ERROR_STRUCT_SIZE);
  EXPECT(shx_solver_set_strand_contact(solver, ids, 3, &touching[0].contact, sizeof touching[0]) == SHX_ERROR_STRUCT_SIZE);
  shx_solver_destroy(solver);
  printf("older and newer structures work\n");
  return 0;
}
