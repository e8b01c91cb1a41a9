// Times calls through the C++ binding beside the same calls from C, in turns and on the same solver: bench_calls step|sample|count STRANDS CALLS ROUNDS.
// Prints the best seconds a call from C and from C++, of this thread's processor time: what else the machine does is not counted.
#include <superhelix/superhelix.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

static double now() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

int main(int argc, char **argv) {
  if (argc != 5)
    return 2;
  const std::string what = argv[1];
  const std::size_t count = std::strtoul(argv[2], nullptr, 10);
  const int calls = std::atoi(argv[3]), rounds = std::atoi(argv[4]);

  superhelix::solver hair;
  std::vector<superhelix::strand_def> defs(count);
  for (std::size_t i = 0; i < count; i++)
    defs[i]
        .with_element_count(what == "sample" ? 4 : 8)
        .with_length(0.2)
        .with_root(superhelix::make_frame({0.0, 0.001 * static_cast<double>(i), 0.0}));
  const auto ids = hair.add_strands(defs);
  const auto start = hair.snapshot();
  std::vector<std::array<float, 3>> points(count * 16);
  superhelix::step_report report;
  shx_solver *raw = hair.get();
  bool failed = false;
  double best[2] = {1e9, 1e9};
  for (int turn = 0; turn < 2 * rounds; turn++) {
    hair.restore(start);  // the same steps for both
    const double began = now();
    for (int call = 0; call < calls; call++) {
      if (turn % 2 == 0) {
        std::size_t number;
        if (what == "step") {
          failed |= shx_solver_step(raw, 1.0 / 240.0, 1, &report) != SHX_OK;
        } else if (what == "sample") {
          shx_sample_def def;
          failed |= shx_sample_def_init(&def, sizeof def) != SHX_OK;
          def.points_per_strand = 16;
          const shx_output output = {points.data(), 0, points.size(), SHX_FORMAT_F32X3, 0};
          failed |= shx_solver_sample_strands(raw, ids.data(), ids.size(), &def, &output, nullptr, nullptr) != SHX_OK;
        } else {
          failed |= shx_solver_strand_count(raw, &number) != SHX_OK;
        }
      } else if (what == "step") {
        hair.step(1.0 / 240.0, 1, report);
      } else if (what == "sample") {
        hair.sample_strands(ids, superhelix::sample_def().with_points_per_strand(16), points);
      } else {
        hair.strand_count();
      }
    }
    best[turn % 2] = std::min(best[turn % 2], (now() - began) / calls);
  }
  std::printf("%.9e %.9e\n", best[0], best[1]);
  return failed ? 1 : 0;
}
