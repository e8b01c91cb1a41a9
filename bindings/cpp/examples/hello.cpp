// One strand, held out level at its root, falls and swings for a second: examples_c/hello.c in C++.
#include <superhelix/superhelix.hpp>

#include <array>
#include <cstdio>

namespace sh = superhelix;

int main() {
  sh::solver hair; // all defaults: gravity points to -z
  // 0.2 m, five helical elements; drag in kg/(m s).
  const sh::strand_id strand = hair.add_strand(sh::strand_def().with_length(0.2).with_element_count(5).with_air_drag(5e-6));

  std::array<std::array<double, 3>, 1> tip;
  for (int frame = 1; frame <= 60; frame++) {
    hair.step(1.0 / 60.0, 1);
    hair.sample_at(strand, {0.2}, tip);
    if (frame % 10 == 0)
      std::printf("%.3f s: the tip is at (%.4f, %.4f, %.4f) m\n", frame / 60.0, tip[0][0], tip[0][1], tip[0][2]);
  }
}
