/* The C half of bench_calls.py: the same calls, timed from C. Usage: bench_calls WHAT STRANDS CALLS ROUNDS. Prints the best
   seconds per call. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <superhelix.h>

/* Processor time of this thread: other programs do not count. */
static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* Memory as numpy has it: in huge pages on Linux. All of it is touched. */
static void *room(size_t size)
{
    void *memory = NULL;
    if (posix_memalign(&memory, (size_t)1 << 21, size) != 0) exit(1);
#ifdef __linux__
    madvise(memory, size, MADV_HUGEPAGE);
#endif
    memset(memory, 0, size);
    return memory;
}

static void check(shx_result result)
{
    if (result != SHX_OK) {
        char text[512];
        shx_last_error(text, sizeof text);
        fprintf(stderr, "%s\n", text);
        exit(1);
    }
}

/* Strands side by side that leave their roots along x, as bench_calls.py makes them. */
static shx_solver *scene(size_t count, uint32_t elements, shx_strand_id **ids)
{
    shx_solver *solver;
    check(shx_solver_create(NULL, &solver));
    shx_strand_def *defs = malloc(count * sizeof *defs);
    *ids = room(count * sizeof **ids);
    for (size_t i = 0; i < count; ++i) {
        check(shx_strand_def_init(&defs[i], sizeof defs[i]));
        defs[i].element_count = elements;
        defs[i].length = 0.2;
        defs[i].root.origin[1] = 0.001 * (double)i;
    }
    check(shx_solver_add_strands(solver, defs, sizeof *defs, count, *ids));
    free(defs);
    return solver;
}

int main(int argc, char **argv)
{
    if (argc != 5) return 2;
    const char *what = argv[1];
    size_t count = strtoul(argv[2], NULL, 10);
    int calls = atoi(argv[3]), rounds = atoi(argv[4]);
    shx_strand_id *ids;
    uint32_t elements = strcmp(what, "sample") == 0 ? 4 : 8;
    shx_solver *solver = scene(count, elements, &ids);
    float *points = room(count * 16 * 3 * sizeof *points);
    shx_step_report report;
    check(shx_step_report_init(&report, sizeof report));
    double best = 1e9;
    for (int round = 0; round < rounds; ++round) {
        double began = now();
        for (int call = 0; call < calls; ++call) {
            if (strcmp(what, "step") == 0) {
                check(shx_solver_step(solver, 1.0 / 240.0, 1, &report));
            } else if (strcmp(what, "sample") == 0) {
                shx_sample_def def;
                check(shx_sample_def_init(&def, sizeof def));
                def.points_per_strand = 16;
                shx_output output = {points, 0, count * 16, SHX_FORMAT_F32X3, 0};
                check(shx_solver_sample_strands(solver, ids, count, &def, &output, NULL, NULL));
            } else {
                size_t number;
                check(shx_solver_strand_count(solver, &number));
            }
        }
        double each = (now() - began) / calls;
        if (each < best) best = each;
    }
    printf("%.9e\n", best);
    shx_solver_destroy(solver);
    free(points);
    free(ids);
    return 0;
}
