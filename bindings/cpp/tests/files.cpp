// Groom files, caches, scalps, render hair.
#include "check.hpp"

using namespace superhelix;
using check::hanging;

// Where files go: the folder that main was given.
namespace check {
std::string &folder();
}

TEST(curves_are_written_and_read) {
  const std::vector<std::array<float, 3>> points{{0, 0, 0}, {0, 0, -1}, {1, 0, 0}, {1, 0, -1}, {1, 1, -2}};
  const std::vector<std::uint32_t> counts{2, 3};
  const std::vector<float> thickness(5, 0.25F);
  const std::string plain = check::folder() + "/plain.hair", full = check::folder() + "/full.usda";
  GET(write_curves(plain, points, counts));
  curves read = GET(curves::read(plain));
  EXPECT(GET(read.strand_count()) == 2 && GET(read.point_count()) == 5 && GET(read.point_counts()) == counts);
  EXPECT(GET(read.points(0.01))[4][2] == -0.02 && GET(read.attribute(curve_attribute::velocity)).empty());
  std::vector<std::array<float, 3>> second(3);
  GET(read.points(1, 1, 1.0, second));
  EXPECT(second[2] == points[4]);
  const auto data =
      curve_data().with_point_counts(counts).with_points(points).with_thickness(thickness).with_metres_per_unit(0.01).with_up_axis(up_axis::z);
  GET(write_curves(full, data));
  read = GET(curves::read(full));
  EXPECT(GET(read.attribute(curve_attribute::thickness)) == thickness && GET(read.units()).metres == 0.01 && GET(read.units()).up_axis == up_axis::z);
  const auto why = WHY(curves::read(check::folder() + "/none.hair"));
  EXPECT(why.code() == SHX_ERROR_FILE && std::string(why.what()).find("none.hair") != std::string::npos);

  const std::string path = check::folder() + "/cache.usda";
  auto writer = GET(curve_cache_writer::create(path, data, 24.0));
  GET(writer.write(0.0, points));
  GET(writer.write(1.0, std::vector<std::array<float, 3>>(5, std::array<float, 3>{1, 2, 3})));
  GET(writer.finish());
  EXPECT(!writer);
  const auto cache = GET(curve_cache::read(path));
  EXPECT(GET(cache.times()) == (std::vector<double>{0.0, 1.0}));
  NEAR(GET(GET(cache.sample(0.5)).points())[1][2], 1.0, 1e-6);
  // One that is not finished leaves nothing.
  const std::string given_up = check::folder() + "/given_up.usda";
  { auto unfinished = GET(curve_cache_writer::create(given_up, data, 24.0)); }
  EXPECT(WHY(curve_cache::read(given_up)).code() == SHX_ERROR_FILE);
}

// A square of 10 cm at z = 0, two triangles, seen from above.
static const std::vector<vec3> corners{{0.0, 0.0, 0.0}, {0.1, 0.0, 0.0}, {0.1, 0.1, 0.0}, {0.0, 0.1, 0.0}};
static const std::vector<triangle> square{{0, 1, 2}, {0, 2, 3}};
static const std::vector<std::array<double, 6>> square_uvs{{0, 0, 1, 0, 1, 1}, {0, 0, 1, 1, 0, 1}};

TEST(follicles_stand_on_scalps) {
  const auto patch = GET(scalp::create(scalp_def().with_vertices(corners).with_triangles(square).with_uvs(square_uvs)));
  const std::vector<double> front{1.0, 1.0, 0.0, 0.0}, left{1.0, 0.0};
  double least = 0.0;
  const auto follicles = GET(patch.scatter(scatter_def().with_count(50), &least));
  EXPECT(follicles.size() == 50 && least > 0.005);
  EXPECT(GET(patch.scatter(scatter_def().with_spacing(0.02))).size() > 10);
  EXPECT(GET(patch.scatter(scatter_def().with_count(20).with_density(front))).size() == 20);
  EXPECT(GET(patch.scatter(scatter_def().with_count(20).with_density_picture(left, 2, 1))).size() == 20);
  EXPECT(WHY(patch.scatter(scatter_def().with_count(20).with_density(left))).code() == SHX_ERROR_INVALID_ARGUMENT);
  EXPECT(WHY(patch.scatter(scatter_def().with_count(std::size_t{1} << 60))).code() == SHX_ERROR_INVALID_ARGUMENT);
  const auto middle = GET(patch.follicles_at_uvs({{0.5, 0.25}}));
  frame root{};
  GET(patch.root_frames(middle, root));
  NEAR(check::distance({root.origin[0], root.origin[1], root.origin[2]}, {0.05, 0.025, 0.0}), 0.0, 1e-9);
  auto moved = corners;
  for (auto &corner : moved)
    corner[2] += 0.3;
  GET(patch.root_frames(middle, root, moved));
  NEAR(root.origin[2], 0.3, 1e-9);
}

TEST(render_hair_follows_guides) {
  solver hair = GET(solver::create());
  const auto ids = hanging(hair, 4);
  std::vector<vec3> roots;
  for (int i = 0; i < 20; i++)
    roots.push_back({0.0015 * i, 0.001 * (i % 3), 0.0});
  const auto settings = render_settings().with_points_per_strand(8).with_length_variation(0.0).with_interpolation(interpolation::position);
  const auto map = GET(hair.create_render_hair(ids, settings, roots));
  std::vector<std::uint32_t> guides(20, 9), wisps(20, 9);
  GET(map.wisps(0, guides, wisps));
  EXPECT(guides[0] == 0 && guides[19] == 3 && wisps[0] < 4);
  auto pose = GET(map.create_pose());
  std::vector<std::array<float, 3>> points(160), all(160), velocities(160);
  EXPECT(WHY(pose.evaluate(points)).code() == SHX_ERROR_INVALID_ARGUMENT);
  GET(hair.set_render_pose(ids, true, pose));
  GET(pose.evaluate(points, {}, velocities));
  NEAR(points[0][0], 0.0F, 1e-4F);
  NEAR(points[7][2], -0.2F, 5e-3F);
  std::vector<std::array<float, 3>> tangents(160);
  GET(pose.evaluate(output(), tangents));
  NEAR(tangents[3][2], -1.0F, 0.01F);  // it hangs
  const auto view = render_view().with_first_strand(5).with_strand_count(2);
  std::vector<std::array<float, 3>> two(16);
  GET(pose.evaluate(view, two));
  EXPECT(two[3] == points[5 * 8 + 3]);
  GET(hair.evaluate_render_pose(pose, all));
  EXPECT(all[17] == points[17]);
  GET(hair.evaluate_render_pose(pose, view, two));
  EXPECT(two[3] == points[5 * 8 + 3]);

  // Kept as bytes, and without a guide.
  const auto image = GET(map.save());
  const auto loaded = GET(render_hair::load(image, render_settings().with_worker_count(2)));
  auto again = GET(loaded.create_pose());
  GET(hair.set_render_pose(ids, false, again));
  GET(again.evaluate(all));
  EXPECT(all == points);
  // With shapes of their own, which they have at rest.
  std::vector<vec3> bent;
  for (std::size_t k = 0; k < points.size(); k++)
    bent.push_back({points[k][0], points[k][1] + 0.001 * static_cast<double>(k % 8), points[k][2]});
  const auto own = GET(map.with_own_shapes(bent, 20));
  auto own_pose = GET(own.create_pose());
  GET(hair.set_render_pose(ids, false, own_pose));
  GET(own_pose.evaluate(all));
  NEAR(static_cast<double>(all[15][1]), bent[15][1], 2e-6);
  EXPECT(WHY(map.with_own_shapes(bent, 19)).code() == SHX_ERROR_INVALID_ARGUMENT);
  EXPECT(WHY(map.with_own_shapes(bent, 20, std::vector<std::uint32_t>(19, 8))).code() == SHX_ERROR_INVALID_ARGUMENT);
  const auto fewer = GET(map.without_guides(3));
  GET(fewer.wisps(0, guides, {}));
  EXPECT(guides[19] != 3);

  // Guides as curves of the host's.
  std::vector<vec3> drawn;
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 8; j++)
      drawn.push_back({0.02 * i, 0.0, -0.02 * j});
  const auto of_curves = GET(render_hair::create(settings, render_guides().with_guide_count(2).with_points(drawn), roots));
  auto curve_pose = GET(of_curves.create_pose());
  for (auto &point : drawn)
    point[1] += 0.5;
  GET(curve_pose.set_guides(render_guides().with_guide_count(2).with_points(drawn)));
  GET(curve_pose.evaluate(points));
  NEAR(points[0][1], 0.5F, 1e-3F);
}
