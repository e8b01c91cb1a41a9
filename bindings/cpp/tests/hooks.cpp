// The host's callables behind the library's callbacks.
#include "check.hpp"

#include <atomic>
#include <memory>
#include <thread>

using namespace superhelix;
using check::hanging;

TEST(a_callable_is_the_parallel_loop) {
  const auto calls = std::make_shared<std::atomic<int>>(0);
  const auto loop = [calls](std::uint32_t count, std::uint32_t, range_task task) {
    ++*calls;
    std::thread other([&] { task(count / 2, count, 1); });
    task(0, count / 2, 0);
    other.join();
  };
  solver serial = GET(solver::create());
  // The definition no longer exists when the solver steps: the solver keeps its own copy.
  solver parallel = GET(solver::create(solver_def().with_worker_count(2).with_parallel_for(loop)));
  EXPECT(calls.use_count() == 3);
  hanging(serial, 64);
  hanging(parallel, 64);
  for (int frame = 0; frame < 3; frame++) {
    GET(serial.step(1.0 / 60.0));
    GET(parallel.step(1.0 / 60.0));
  }
  EXPECT(*calls > 0 && GET(serial.state_hash()) == GET(parallel.state_hash()));
  // It moves along, and goes with the solver.
  solver moved(std::move(parallel));
  GET(moved.step(1.0 / 60.0));
  moved = GET(solver::create());
  EXPECT(calls.use_count() == 2);
}

TEST(a_callable_receives_messages) {
  std::vector<std::string> texts;
  solver hair = GET(solver::create(solver_def().with_log_level(log_level::debug).with_log([&texts](std::uint32_t level, const char *text) {
    texts.push_back(std::to_string(level) + ": " + text);
  })));
  hanging(hair, 1);
  GET(hair.step(1.0 / 60.0));
  WHY(hair.step(-1.0));
  EXPECT(texts.size() >= 2 && texts.back().find("1: ") == 0 && texts.back().find("dt") != std::string::npos);
}

TEST(fits_and_render_hair_take_the_loop_too) {
  int calls = 0;
  const auto loop = [&calls](std::uint32_t count, std::uint32_t, range_task task) {
    calls++;
    task(0, count, 0);
  };
  std::vector<vec3> points;
  for (int i = 0; i < 8; i++)
    points.insert(points.end(), {{0.01 * i, 0.0, 0.0}, {0.01 * i, 0.0, -0.05}, {0.01 * i, 0.01, -0.1}});
  const std::vector<std::uint32_t> counts(8, 3);
  const auto fitted = GET(fit_strands(fit_input().with_point_counts(counts).with_points(points),
                                      fit_options().with_element_count(2).with_worker_count(2).with_parallel_for(loop)));
  EXPECT(fitted.ok(7) && calls > 0);

  solver hair = GET(solver::create());
  const auto ids = hanging(hair, 4);
  std::vector<vec3> roots;
  for (int i = 0; i < 2000; i++)
    roots.push_back({0.00001 * i, 0.0, 0.0});
  auto map = GET(hair.create_render_hair(ids, render_settings().with_worker_count(2).with_parallel_for(loop), roots));
  auto pose = GET(map.create_pose());
  GET(hair.set_render_pose(ids, false, pose));
  calls = 0;
  std::vector<std::array<float, 3>> drawn(2000 * 16);
  GET(pose.evaluate(drawn));
  EXPECT(calls > 0);
}
