// Strands, roots, shapes, posing, sampling, state.
#include "check.hpp"

#include <algorithm>
#include <atomic>

using namespace superhelix;
using check::distance;
using check::hanging;

TEST(strands_are_added_asked_and_removed) {
  solver hair = GET(solver::create());
  const auto ids = hanging(hair, 3);
  EXPECT(GET(hair.strand_count()) == 3 && GET(hair.strand_ids()) == ids && hair.has_strand(ids[1]) && !hair.has_strand(strand_id{}));
  std::vector<strand_id> again(3);
  GET(hair.strand_ids(again));
  EXPECT(again == ids);
  EXPECT(GET(hair.get_element_count(ids[0])) == 8 && GET(hair.get_user_data(ids[2])) == 102);
  const auto lengths = GET(hair.get_element_lengths(ids[0]));
  EXPECT(lengths.size() == 8);
  NEAR(lengths[3], 0.025, 1e-12);
  std::vector<double> room(8);
  GET(hair.get_element_lengths(ids[0], room));
  EXPECT(room == lengths);
  const strand_id more = GET(hair.add_strand(strand_def().with_length(0.1).with_element_count(4)));
  std::vector<strand_id> two(2);
  GET(hair.add_strands(std::vector<strand_def>(2, strand_def().with_length(0.1).with_element_count(4)), two));
  GET(hair.remove_strands({more, two[0], two[1]}));
  EXPECT(GET(hair.strand_count()) == 3 && !hair.has_strand(more));
  const auto why = WHY(hair.get_element_count(more));
  EXPECT(why.code() == SHX_ERROR_INVALID_ID);
  EXPECT(WHY(hair.add_strands(std::vector<strand_def>(2), span<strand_id>(again))).code() == SHX_ERROR_INVALID_ARGUMENT);
  const auto wrong = WHY(hair.add_strand(strand_def().with_length(-1.0).with_element_count(4)));
  EXPECT(wrong.code() == SHX_ERROR_INVALID_ARGUMENT && std::string(wrong.what()).find("length") != std::string::npos);
}

TEST(steps_report_what_they_did) {
  solver hair = GET(solver::create());
  const auto ids = hanging(hair, 3);
  GET(hair.set_wind({1.0, 0.0, 0.0}));
  GET(hair.set_gravity({0.0, 0.0, -9.0}));
  step_report report;
  for (int frame = 0; frame < 10; frame++)
    GET(hair.step(1.0 / 60.0, 2, report));
  EXPECT(report.substeps == 2 && report.quarantined == 0 && report.kinetic_energy > 0.0);
  GET(hair.step(1.0 / 60.0));
  std::vector<double> kinetic(3), elastic(3), gravity(3);
  GET(hair.strand_energies(ids, kinetic, elastic, gravity));
  EXPECT(kinetic[0] > 0.0 && elastic[1] > 0.0 && gravity[2] < 0.0);
  std::vector<shx_strand_status> status(3, -7);
  GET(hair.strand_status(ids, status));
  EXPECT(status == std::vector<shx_strand_status>(3, SHX_STRAND_CONVERGED) && GET(hair.strand_status(ids[0])) == strand_state::converged);
  std::vector<std::uint32_t> iterations(3), points(3);
  std::vector<double> errors(3), angles(3);
  GET(hair.strand_iterations(ids, iterations));
  GET(hair.strand_quadrature(ids, points, errors));
  GET(hair.strand_turning_angles(ids, angles));
  EXPECT(iterations[0] >= 1 && points[0] >= 2 && errors[0] > 0.0 && errors[0] < 1e-3 && angles[0] > 0.0 && angles[0] < 0.5);
  EXPECT(WHY(hair.strand_energies(ids, span<double>(kinetic).first(2))).code() == SHX_ERROR_BUFFER_TOO_SMALL);
  EXPECT(WHY(hair.step(-1.0)).code() == SHX_ERROR_INVALID_ARGUMENT);
  EXPECT(GET(hair.memory_usage()) > 1000);
  GET(hair.reset_strands(ids));
  GET(hair.strand_energies(ids, kinetic));
  NEAR(kinetic[0], 0.0, 1e-15);
}

TEST(steps_end_at_their_limits) {
  solver hair = GET(solver::create());
  const auto ids = hanging(hair, 2);
  std::atomic<std::uint32_t> cancelled{1};
  const auto report = GET(hair.step_with_limits(1.0 / 60.0, 1, step_limits().with_cancel(cancelled)));
  EXPECT(report.stop_reason == stop_reason::cancelled && report.unfinished == 2);
  cancelled = 0;
  EXPECT(GET(hair.step_with_limits(1.0 / 60.0, 1, step_limits().with_cancel(cancelled).with_max_seconds(10.0))).stop_reason == stop_reason::none);
}

TEST(roots_move_and_feel_the_weight) {
  solver hair = GET(solver::create());
  const auto ids = hanging(hair, 2);
  std::vector<frame> roots(2), now(2);
  GET(hair.get_root_frames(ids, roots));
  NEAR(roots[1].origin[0], 0.01, 1e-15);
  for (auto &root : roots)
    root.origin[1] += 0.05;
  GET(hair.set_root_frames(ids, roots, 0.1));
  for (int frame = 0; frame < 10; frame++)
    GET(hair.step(0.01));
  GET(hair.get_root_frames(ids, now));
  NEAR(now[0].origin[1], 0.05, 1e-12);
  GET(hair.teleport_roots(ids[0], make_frame({1.0, 2.0, 3.0})));
  frame alone{};
  GET(hair.get_root_frames(ids[0], alone));
  EXPECT(alone.origin[2] == 3.0);
  GET(hair.settle(ids));
  GET(hair.step(1e-3));
  std::vector<vec3> forces(2), torques(2);
  GET(hair.root_wrenches(ids, forces, torques));
  const double weight = 1300.0 * 3.14159265358979 * 50e-6 * 50e-6 * 0.2 * 9.81;
  NEAR(forces[1][2], -weight, 1e-3 * weight);
  EXPECT(WHY(hair.set_root_frames(ids, make_frame({0.0, 0.0, 0.0}), 0.1)).code() == SHX_ERROR_INVALID_ARGUMENT);
}

TEST(strands_follow_targets) {
  solver hair = GET(solver::create());
  const auto ids = hanging(hair, 2);
  std::vector<double> distances(2);
  GET(hair.target_distances(ids, distances));
  EXPECT(distances[0] == -1.0 && distances[1] == -1.0);
  // Hanging strands, drawn to the side.
  std::vector<vec3> curves;
  for (int strand = 0; strand < 2; strand++)
    for (int point = 0; point < 9; point++)
      curves.push_back({0.01 * strand, 1e-4 * point * point, -0.0249 * point});
  const std::vector<double> positions{0.0, 1.0}, weights{1.0, 1.0}, strand_weights{1.0, 0.0};
  target_def def;
  def.with_points(curves).with_weight_positions(positions).with_weights(weights).with_strand_weights(strand_weights).with_time_constant(0.05);
  GET(hair.set_targets(ids, def, 0.1));
  for (int frame = 0; frame < 10; frame++)
    GET(hair.step(0.01));
  GET(hair.target_distances(ids, distances));
  EXPECT(distances[0] >= 0.0 && distances[0] < 2e-3 && distances[1] == -1.0);
  GET(hair.clear_targets(ids));
  GET(hair.target_distances(ids, distances));
  EXPECT(distances[0] == -1.0);
  EXPECT(WHY(hair.set_targets(ids[0], def, 0.1)).code() == SHX_ERROR_INVALID_ARGUMENT);
}

TEST(shapes_are_set_settled_and_adopted) {
  solver hair = GET(solver::create());
  const auto ids = hanging(hair, 2);
  std::vector<curvature> rows(8, curvature{0.0, 20.0, 0.0}), back(8), rates(8);
  GET(hair.set_natural_curvatures(ids[0], rows));
  GET(hair.get_natural_curvatures(ids[0], back));
  EXPECT(back == rows);
  GET(hair.set_curvatures(ids[0], rows, std::vector<curvature>(8, curvature{0.0, 1.0, 0.0})));
  GET(hair.get_curvatures(ids[0], back, rates));
  EXPECT(back == rows && rates[7][1] == 1.0);
  GET(hair.set_curvatures(ids[0], rows));
  GET(hair.get_curvatures(ids[0], {}, rates));
  EXPECT(rates[7][1] == 0.0);
  EXPECT(WHY(hair.get_curvatures(ids[0], back, span<curvature>(rates).first(7))).code() == SHX_ERROR_INVALID_ARGUMENT);

  std::vector<shx_strand_status> status(2, -1);
  std::vector<double> eigenvalues(2), residuals(2), youngs(2), radii(2), scales(2);
  const settle_report report = GET(hair.settle(ids, settle_def().with_tolerance(1e-9), status, eigenvalues, residuals));
  EXPECT(report.unconverged == 0 && status[0] == SHX_STRAND_CONVERGED && eigenvalues[0] > 0.0 && residuals[0] < 1e-9);
  std::vector<curvature> drawn(16), after(16);
  GET(hair.get_shapes(ids, drawn));
  EXPECT(std::abs(drawn[7][1]) > 1.0 && std::abs(drawn[8][1]) < 1e-6);
  GET(hair.adopt_natural_shapes(ids));
  GET(hair.get_natural_curvatures(ids[0], back));
  EXPECT(back[3] == drawn[3]);
  GET(hair.set_shapes(ids, drawn));
  GET(hair.adopt_rest_shapes(ids));
  for (int frame = 0; frame < 20; frame++)
    GET(hair.step(1.0 / 60.0));
  GET(hair.get_shapes(ids, after));
  NEAR(after[3][1], drawn[3][1], 1e-4);
  GET(hair.shape_stability(ids, 0.1, eigenvalues, youngs, radii));
  EXPECT(eigenvalues[1] > 0.1 && youngs[1] == 1.0 && radii[1] == 1.0);
  GET(hair.stiffen_strands(ids, stiffen_by::youngs_modulus, 0.1, scales));
  EXPECT(scales[0] >= 1.0);

  const material thick = material().with_radius(1e-4).with_youngs_modulus(3e9);
  GET(hair.set_materials(ids, thick));
  GET(hair.set_materials(ids, {thick, thick}));
  EXPECT(GET(hair.get_material(ids[1])).youngs_modulus == 3e9);
  EXPECT(WHY(hair.set_materials(ids, {thick, thick, thick})).code() == SHX_ERROR_INVALID_ARGUMENT);

  std::vector<double> moved(2, -1.0);
  GET(hair.set_element_count(ids, 16, moved));
  EXPECT(GET(hair.get_element_count(ids[0])) == 16 && moved[0] >= 0.0 && moved[0] < 1e-9);
  EXPECT(GET(hair.set_element_lengths(ids[0], {0.05, 0.05, 0.1})) < 0.1 && GET(hair.get_element_count(ids[0])) == 3);
}

TEST(strands_are_posed_by_hand) {
  solver hair = GET(solver::create());
  const auto ids = hanging(hair, 2);
  std::vector<double> far(2, -1.0);
  const std::vector<vec3> targets{{0.08, 0.0, -0.14}, {0.09, 0.0, -0.14}};
  GET(hair.drag_strands(ids, {0.2, 0.2}, targets, pose_options().with_avoid_bodies(false), far));
  EXPECT(far[0] >= 0.0 && far[0] < 1e-6 && far[1] < 1e-6);
  std::vector<std::uint8_t> touched(2, 9);
  GET(hair.brush_strands(ids, brush().with_centre({0.08, 0.0, -0.14}).with_radius(0.05).with_displacement({0.0, 0.01, 0.0}), {}, touched, far));
  EXPECT(touched == std::vector<std::uint8_t>(2, 1) && far[0] < 0.01);
  GET(hair.change_elements(ids, std::vector<element_change>(2, element_change().with_element(2).with_length_scale(1.1))));
  NEAR(GET(hair.get_element_lengths(ids[0]))[2], 0.0275, 1e-9);
  GET(hair.cut_strands(ids[0], 0.1));
  const auto left = GET(hair.get_element_lengths(ids[0]));
  double length = 0.0;
  for (const double part : left)
    length += part;
  NEAR(length, 0.1, 1e-12);
  GET(hair.grow_strands(ids[0], 0.05, 2, curvature{0.0, 5.0, 0.0}));
  GET(hair.grow_strands(ids[0], 0.01));
  EXPECT(GET(hair.get_element_count(ids[0])) == left.size() + 2);
  const auto images = GET(hair.mirror_strands(ids, {-0.1, 0.0, 0.0}, {1.0, 0.0, 0.0}));
  frame image{};
  GET(hair.get_root_frames(images[0], image));
  NEAR(image.origin[0], -0.2, 1e-12);
  EXPECT(WHY(hair.cut_strands(ids, 0.1)).code() == SHX_ERROR_INVALID_ARGUMENT);
}

struct interleaved {
  float position[3];
  float velocity[3];
  float mark;
};

TEST(sampling_fills_the_hosts_vertices) {
  solver hair = GET(solver::create());
  const auto ids = hanging(hair, 3);
  std::vector<interleaved> vertices(3 * 5, {{}, {}, 7.0F});
  std::vector<vec3> packed(3 * 5);
  std::vector<frame> frames(3 * 5);
  const auto def = sample_def().with_points_per_strand(5);
  GET(hair.step(0.01));
  GET(hair.sample_strands(ids, def, output::of(vertices, &interleaved::position), {}, output::of(vertices, &interleaved::velocity)));
  GET(hair.sample_strands(ids, def, packed, frames));
  std::vector<vec3> tangents(3 * 5);
  GET(hair.sample_strands(ids, def, {}, tangents));
  for (std::size_t i = 0; i < tangents.size(); i++) {
    const double *turn = frames[i].rotation;
    NEAR(tangents[i][2], 2.0 * (turn[0] * turn[2] - turn[3] * turn[1]), 1e-12);
  }
  for (std::size_t i = 0; i < packed.size(); i++) {
    for (std::size_t k = 0; k < 3; k++)
      NEAR(static_cast<double>(vertices[i].position[k]), packed[i][k], 1e-6);
    EXPECT(vertices[i].mark == 7.0F && frames[i].origin[2] == packed[i][2]);
  }
  std::vector<vec3> ends(2);
  GET(hair.sample_at(ids[1], {0.0, 0.2}, ends));
  EXPECT(distance(ends[0], packed[5]) < 1e-12 && distance(ends[1], packed[9]) < 1e-12);
  GET(hair.sample_at(ids[1], {0.2}, output(ends[0]), {}, {}, {0.01, 0.0, 0.0}));
  NEAR(ends[0][0], ends[1][0] - 0.01, 1e-12);
  packed.resize(14);
  EXPECT(WHY(hair.sample_strands(ids, def, packed)).code() == SHX_ERROR_BUFFER_TOO_SMALL);
  EXPECT(WHY(hair.sample_strands(ids, def, {})).code() == SHX_ERROR_NULL_ARGUMENT);
}

TEST(snapshots_go_back) {
  solver hair = GET(solver::create());
  hanging(hair, 2);
  GET(hair.step(0.01));
  const auto image = GET(hair.snapshot());
  std::vector<std::uint8_t> room(image.size() + 10);
  EXPECT(GET(hair.snapshot(room)) == image.size() && std::equal(image.begin(), image.end(), room.begin()));
  const auto before = GET(hair.state_hash());
  GET(hair.step(0.01));
  const auto after = GET(hair.state_hash());
  EXPECT(after != before);
  GET(hair.restore(image));
  EXPECT(GET(hair.state_hash()) == before);
  GET(hair.step(0.01));
  EXPECT(GET(hair.state_hash()) == after);
  EXPECT(WHY(hair.restore(std::vector<std::uint8_t>(100))).code() == SHX_ERROR_SNAPSHOT);
}

TEST(options_change_and_snapshots_refer_to_shapes) {
  solver hair = GET(solver::create());
  const auto ids = hanging(hair, 2);
  solver_options options = GET(hair.get_options());
  GET(hair.set_options(options.with_integrator(integrator::implicit_euler).with_max_iterations(20)));
  EXPECT(GET(hair.get_options()).integrator == integrator::implicit_euler);
  EXPECT(WHY(hair.set_options(options.with_worker_count(7))).code() == SHX_ERROR_UNSUPPORTED);
  std::vector<double> lengths(2);
  GET(hair.strand_lengths(ids, lengths));
  EXPECT(lengths[0] > 0.0);
  GET(hair.set_own_user_data(5));
  EXPECT(GET(hair.get_own_user_data()) == 5);
  const std::vector<vec3> corners = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
  const body_id body = GET(hair.add_body(body_def().with_shape(shape::hull).with_vertices(corners).with_user_data(9)));
  EXPECT(GET(hair.get_body_user_data(body)) == 9);
  const auto small = GET(hair.snapshot(snapshot_def().with_shapes(snapshot_shapes::referenced)));
  const auto shapes = GET(hair.snapshot_shapes());
  EXPECT(small.size() < GET(hair.snapshot()).size());
  solver other = GET(solver::create());
  EXPECT(WHY(other.restore(small)).code() == SHX_ERROR_SNAPSHOT);
  GET(other.restore(small, restore_def().with_shapes(shapes).with_options(restore_options::keep)));
  EXPECT(GET(other.get_options()).integrator == integrator::second_order);
  GET(other.restore(small, restore_def().with_shapes(shapes)));
  EXPECT(GET(other.state_hash()) == GET(hair.state_hash()));
  const attachment head = GET(attachment::create(hair, frame{{0, 0, 0}, {0, 0, 0, 1}}, ids, {body}));
  GET(head.move(hair, frame{{1, 0, 0}, {0, 0, 0, 1}}, 0.01));
  GET(hair.step(0.01));
  frame at{};
  GET(hair.get_body_frames({body}, output(at)));
  NEAR(at.origin[0], 1.0, 1e-12);
  GET(head.teleport(hair, frame{{0, 0, 0}, {0, 0, 0, 1}}));
  const constraint_id pin = GET(hair.add_constraint(constraint_def().with_strand(ids[0]).with_user_data(44)));
  EXPECT(GET(hair.get_constraint_user_data(pin)) == 44);
  // Centimetres, y up.
  vec3 metres{}, there{};
  GET(hair.sample_at(ids[1], {0.2}, output(metres)));
  GET(hair.sample_at(ids[1], {0.2}, sample_def().with_x_axis({100, 0, 0}).with_y_axis({0, 0, -100}).with_z_axis({0, 100, 0}), output(there)));
  NEAR(there[1], 100 * metres[2], 1e-9);
  NEAR(there[2], -100 * metres[1], 1e-9);
  GET(hair.keep_contact_events(4));
  std::vector<contact_event> events(4);
  EXPECT(GET(hair.drain_contact_events(events)).count == 0);
}
