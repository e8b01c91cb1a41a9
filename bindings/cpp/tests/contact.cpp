// Bodies, contact, constraints.
#include "check.hpp"

using namespace superhelix;
using check::hanging;

static strand_id lying(solver &hair) {
  return GET(hair.add_strand(strand_def().with_length(0.1).with_element_count(5).with_viscosity(0.05).with_air_drag(2e-4)));
}

TEST(strands_rest_on_bodies) {
  solver hair = GET(solver::create());
  const strand_id strand = lying(hair);
  GET(hair.set_contact_options(contact_options().with_model(contact_model::coulomb).with_hair_contact(true)));
  EXPECT(GET(hair.get_contact_options()).hair_contact == 1 && GET(hair.get_contact_options()).model == contact_model::coulomb);
  EXPECT(!GET(hair.get_strand_contact(strand)).has_value());
  GET(hair.set_strand_contact(strand, strand_contact().with_friction_against(0.4)));
  EXPECT(GET(hair.get_strand_contact(strand))->friction_against == 0.4);
  const body_id ball = GET(hair.add_body(body_def().with_shape(shape::sphere).with_radius(0.03).with_pose(make_frame({0.05, 0.0, -0.032}))));
  EXPECT(GET(hair.body_count()) == 1 && GET(hair.body_ids())[0] == ball && hair.has_body(ball));
  step_report report;
  for (int frame = 0; frame < 120; frame++)
    GET(hair.step(1.0 / 60.0, 1, report));
  EXPECT(report.contacts > 0 && GET(hair.contact_count()) == report.contacts);
  const auto list = GET(hair.contacts());
  std::vector<contact> room(list.size() + 3);
  EXPECT(GET(hair.contacts(room)) == list.size() && room[0].arclength == list[0].arclength);
  vec3 sum{}, force{}, torque{};
  for (const contact &one : list) {
    EXPECT(one.strand == strand && one.body == ball && one.partner == contact_partner::body && one.other_strand == strand_id{});
    for (std::size_t k = 0; k < 3; k++)
      sum[k] += one.force[k];
  }
  GET(hair.body_wrenches(ball, force, torque));
  EXPECT(sum[2] > 0.0);
  NEAR(sum[2] + force[2], 0.0, 1e-15);
  GET(hair.set_body_surface(ball, 0.001, 2.0, 1.0));
  GET(hair.set_body_filter(ball, 1, 0));
  GET(hair.step(1.0 / 60.0));
  EXPECT(GET(hair.contact_count()) == 0);
  GET(hair.set_body_frames(ball, make_frame({0.05, 0.0, -0.5}), 0.01));
  GET(hair.step(1.0 / 60.0));
  frame now{};
  GET(hair.get_body_frames(ball, now));
  EXPECT(now.origin[2] == -0.5);
  GET(hair.teleport_bodies(ball, make_frame({0.05, 0.0, -0.6})));
  GET(hair.clear_strand_contact(strand));
  EXPECT(!GET(hair.get_strand_contact(strand)).has_value());
  GET(hair.remove_bodies(ball));
  EXPECT(!hair.has_body(ball) && WHY(hair.remove_bodies(ball)).code() == SHX_ERROR_INVALID_ID);
  EXPECT(WHY(hair.set_strand_contact(strand, std::vector<strand_contact>(2))).code() == SHX_ERROR_INVALID_ARGUMENT);
}

// A cube about the origin.
static const double side = 0.02;
static std::vector<vec3> cube_vertices() {
  std::vector<vec3> vertices;
  for (unsigned i = 0; i < 8; i++)
    vertices.push_back({(i & 1) != 0 ? side : -side, (i & 2) != 0 ? side : -side, (i & 4) != 0 ? side : -side});
  return vertices;
}
static const std::vector<triangle> cube_triangles{{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                                  {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};

TEST(meshes_and_grids_are_bodies) {
  solver hair = GET(solver::create());
  const auto vertices = cube_vertices();
  const auto grid =
      GET(bake_distance_grid(distance_grid_def().with_vertices(vertices).with_triangles(cube_triangles).with_cell(0.004).with_band(0.01)));
  EXPECT(grid.size() > 1000);
  const auto mesh = body_def().with_shape(shape::mesh).with_vertices(vertices).with_triangles(cube_triangles);
  const auto ids = GET(hair.add_bodies({mesh, body_def().with_shape(shape::grid).with_grid(grid)}));
  EXPECT(ids.size() == 2 && GET(hair.body_count()) == 2);
  auto higher = vertices;
  for (auto &vertex : higher)
    vertex[2] += 0.01;
  GET(hair.set_body_vertices(ids[0], higher, 0.0));
  GET(hair.step(0.01));
  EXPECT(WHY(hair.set_body_vertices(ids[1], higher, 0.0)).code() == SHX_ERROR_UNSUPPORTED);

  // A curve drawn through the grid comes out of it.
  std::vector<vec3> points;
  for (int i = 0; i < 12; i++)
    points.push_back({side - 0.001, -0.0275 + 0.005 * i, 0.0});
  const std::vector<std::uint32_t> counts{12};
  std::vector<double> depths(1, -1.0), moved(1, -1.0);
  std::vector<std::uint32_t> stuck(1, 9);
  const auto def = push_out_def().with_body(ids[1]).with_clearance(0.001).with_point_counts(counts);
  GET(hair.push_out_curves(def, points, depths, moved, stuck));
  EXPECT(depths[0] > 0.0 && moved[0] > 0.0 && stuck[0] == 0 && points[6][0] > side);
  EXPECT(WHY(hair.push_out_curves(def, span<vec3>(points).first(11))).code() == SHX_ERROR_INVALID_ARGUMENT);
}

TEST(overlaps_are_measured_and_permitted) {
  solver hair = GET(solver::create());
  const auto ids = hanging(hair, 2);
  GET(hair.set_contact_options(contact_options().with_hair_contact(true)));
  GET(hair.set_strand_contact(ids, strand_contact().with_wisp_radius(0.006)));
  const body_id ball = GET(hair.add_body(body_def().with_shape(shape::sphere).with_radius(0.02).with_pose(make_frame({-0.005, 0.0, -0.1}))));
  std::vector<double> in_hair(2), in_body(2);
  std::vector<strand_id> others(2);
  std::vector<body_id> bodies(2);
  GET(hair.overlaps(ids, in_hair, others, in_body, bodies));
  NEAR(in_hair[0], 0.002, 1e-6);
  NEAR(in_body[0], 0.01505, 1e-5);
  EXPECT(others[0] == ids[1] && bodies[0] == ball);
  GET(hair.permit_overlaps(ids));
  GET(hair.overlaps(ids, in_hair, {}, in_body));
  NEAR(in_hair[0], 0.0, 1e-9);
  NEAR(in_body[0], 0.0, 1e-9);
  const auto overlap = GET(hair.get_permitted_overlap(ids[0]));
  EXPECT(!overlap.arclengths.empty() && overlap.wisp_fractions.size() == overlap.arclengths.size());
  GET(hair.set_permitted_overlap(ids[0], {}));
  EXPECT(GET(hair.get_permitted_overlap(ids[0])).arclengths.empty());
  GET(hair.set_permitted_overlap(ids[0], overlap));
  EXPECT(GET(hair.get_permitted_overlap(ids[0])).body_depths == overlap.body_depths);
  EXPECT(WHY(hair.set_permitted_overlap(ids[0], {{0.0, 0.1}, {1.0}, {0.0, 0.0}})).code() == SHX_ERROR_INVALID_ARGUMENT);
}

TEST(constraints_hold) {
  solver hair = GET(solver::create());
  const auto ids = hanging(hair, 2);
  const auto def = constraint_def().with_strand(ids[0]).with_arclength(0.2).with_target(make_frame({0.02, 0.0, -0.195}));
  const auto held = GET(hair.add_constraints(def));
  const constraint_id tie = GET(hair.add_constraint(
      constraint_def().with_kind(constraint_kind::tie).with_strand(ids[0]).with_arclength(0.1).with_other_strand(ids[1]).with_other_arclength(0.1)));
  EXPECT(GET(hair.constraint_count()) == 2 && GET(hair.constraint_ids())[1] == tie && hair.has_constraint(tie));
  GET(hair.set_constraint_targets(held, make_frame({0.02, 0.01, -0.19}), 0.05));
  for (int i = 0; i < 20; i++)
    GET(hair.step(1.0 / 60.0));
  frame target{};
  GET(hair.get_constraint_targets(held, target));
  EXPECT(target.origin[1] == 0.01);
  vec3 tip{};
  GET(hair.sample_at(ids[0], {0.2}, tip));
  NEAR(check::distance(tip, {0.02, 0.01, -0.19}), 0.0, 1e-6);
  std::vector<constraint_state> states(2);
  GET(hair.constraint_states({held[0], tie}, states));
  EXPECT(states[0].status == constraint_status::satisfied && states[0].error < 1e-6 && states[1].arclength == 0.1);
  EXPECT(WHY(hair.constraint_states({held[0], tie}, span<constraint_state>(states).first(1))).code() == SHX_ERROR_BUFFER_TOO_SMALL);
  GET(hair.remove_constraints({held[0], tie}));
  EXPECT(GET(hair.constraint_count()) == 0 && !hair.has_constraint(tie));
}

TEST(a_hand_feels_hair) {
  solver hair = GET(solver::create());
  const auto ids = hanging(hair, 4);
  GET(hair.set_strand_contact(ids, strand_contact()));
  const body_id ball =
      GET(hair.add_body(body_def().with_shape(shape::sphere).with_radius(0.02).with_pose(make_frame({-0.05, 0.0, -0.1}))));
  EXPECT(WHY(haptic::create(hair, ball, haptic_def().with_stiffness(-1.0))).code() == SHX_ERROR_INVALID_ARGUMENT);
  EXPECT(WHY(haptic::create(hair, ball, haptic_def().with_force_law(haptic_force::explicit_).with_explicit_time(-1.0))).code() ==
         SHX_ERROR_INVALID_ARGUMENT);
  haptic hand = GET(haptic::create(hair, ball, haptic_def().with_max_force(1.0)));
  EXPECT(static_cast<bool>(hand));
  haptic_state state;
  haptic_wrench felt;
  for (int step = 0; step < 60; step++) {
    for (int tick = 0; tick < 8; tick++) {
      const double along = std::fmin((8 * step + tick) / 400.0, 1.0);
      felt = GET(hand.update(make_frame({-0.05 + 0.08 * along, 0.0, -0.1}), {along < 1.0 ? 0.16 : 0.0, 0.0, 0.0}, {}, 1e-3, &state));
    }
    GET(hand.before_step(hair, 8e-3));
    GET(hair.step(8e-3));
    GET(hand.after_step(hair));
  }
  EXPECT(felt.force[0] < 0.0 && state.model_count == 59 && state.pressing > 0 && state.energy_given > 0.0);
  EXPECT(WHY(hand.update(make_frame({}), {}, {}, 0.0)).code() == SHX_ERROR_INVALID_ARGUMENT);
}

// A ball in the hand, which hair without contact ignores, and a tooth along y from there on; both go along x.
TEST(ring_combs_in_the_hand) {
  solver hair = GET(solver::create());
  const std::vector<strand_id> ids = hanging(hair, 4);
  const auto ball_at = [](double x) { return make_frame({x, -0.03, -0.03}); };
  const body_id ball = GET(hair.add_body(body_def().with_shape(shape::sphere).with_radius(0.001).with_pose(ball_at(-0.03))));
  haptic hand = GET(haptic::create(hair, ball, haptic_def().with_mode(haptic_mode::direct)));
  const tool_def finger = tool_def().with_kind(tool::finger);
  const frame tooth = make_frame({-0.03, -0.03, -0.03}, {-std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)});
  EXPECT(WHY(hand.add_ring_comb(hair, tool_def().with_kind(tool::plates), tooth, ids)).code() == SHX_ERROR_UNSUPPORTED);
  EXPECT(WHY(hand.get_ring_comb_report(0)).code() == SHX_ERROR_INVALID_ARGUMENT);
  EXPECT(GET(hand.add_ring_comb(hair, finger, tooth, ids)) == 0);
  EXPECT(GET(hand.add_ring_comb(hair, finger, tooth, ids, ring_comb_def().with_max_force(1e-9))) == 1);
  EXPECT(GET(hand.get_ring_comb_report(1)).held == 0);
  NEAR(GET(hand.ring_comb_frame(1)).origin[2], -0.03, 1e-12);
  haptic_state state;
  std::array<std::uint32_t, 2> caught{};
  std::uint32_t let_go = 0;
  vec3 pulled{};
  for (int step = 0; step <= 20; step++) {
    GET(hand.update(ball_at(-0.03 + 0.09 * step / 20), {4.5, 0.0, 0.0}, {}, 1e-3, &state));
    for (std::size_t axis = 0; axis < 3; axis++)
      NEAR(state.contact_force[axis], pulled[axis], 1e-9);
    GET(hand.before_step(hair, 1e-3));
    GET(hair.step(1e-3));
    GET(hand.after_step(hair));
    pulled = {};
    for (std::size_t comb = 0; comb < 2; comb++) {
      const ring_comb_report report = GET(hand.get_ring_comb_report(comb));
      caught[comb] += report.caught;
      let_go += comb == 1 ? report.let_go : 0;
      for (std::size_t axis = 0; axis < 3; axis++)
        pulled[axis] += report.force[axis];
    }
  }
  EXPECT(caught[0] == 4 && caught[1] >= 4 && let_go >= 4);
  for (std::size_t axis = 0; axis < 3; axis++)
    NEAR(GET(hand.ring_comb_frame(0)).origin[axis], state.proxy.origin[axis], 1e-12);
  GET(hand.release_ring_combs(hair));
  EXPECT(GET(hair.constraint_count()) == 0);
}

TEST(styling) {
  solver hair = GET(solver::create());
  const std::vector<strand_id> ids = hanging(hair, 4);
  const tool_def teeth_def = tool_def().with_kind(tool::comb).with_length(0.06);
  const std::vector<body_id> teeth = GET(hair.add_tool(teeth_def, make_frame({-0.5, 0.0, 0.0})));
  EXPECT(teeth.size() == 12 && GET(tool_frames(teeth_def, make_frame({}))).size() == 12);
  const tool_def plates = tool_def().with_kind(tool::plates);
  const vec3 half_edges = GET(tool_hot_box(plates, 0.01));
  NEAR(half_edges[1], 0.007, 1e-15);
  EXPECT(WHY(tool_hot_box(teeth_def, 0.01)).code() == SHX_ERROR_UNSUPPORTED);
  clip_def clip;
  clip.pose = make_frame({0.0, 0.0, -0.05});
  clip.half_edges[0] = clip.half_edges[1] = 0.1;
  const auto held = GET(hair.clip_strands(clip, ids));
  EXPECT(held.size() == 4);
  GET(hair.move_constraints(held, clip.pose, make_frame({0.01, 0.0, -0.05}), 0.1));
  GET(hair.step(0.1, 4));
  GET(hair.remove_constraints(held));
  heat_def heat;
  heat.half_edges[0] = heat.half_edges[1] = heat.half_edges[2] = 1.0;
  EXPECT(GET(hair.heat_strands(heat, ids, 0.1))[2] > 0.05);
  const auto cuts = GET(hair.scissor_strands(ids, {vec3{-1.0, -1.0, -0.06}, vec3{1.0, -1.0, -0.06}, vec3{1.0, 1.0, -0.06}, vec3{-1.0, 1.0, -0.06}}));
  EXPECT(cuts.size() == 4 && cuts[0].strand == ids[0] && cuts[0].removed > 0.0);
  GET(hair.freeze_strands(ids));
  GET(hair.step(0.1));
  EXPECT(GET(hair.frozen_strands(ids))[3] == 1);
  GET(hair.wake_strands(ids));
  EXPECT(GET(hair.frozen_strands(ids))[3] == 0);

  EXPECT(WHY(ring_comb::create(plates, make_frame({}))).code() == SHX_ERROR_UNSUPPORTED);
  // A tooth along y that goes along x.
  const auto tooth = [](double x) { return make_frame({x, -0.03, -0.03}, {-std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)}); };
  ring_comb comb = GET(ring_comb::create(tool_def().with_kind(tool::finger).with_radius(0.001), tooth(-0.03)));
  GET(comb.before_step(hair, ids, tooth(0.06), 0.01));
  GET(hair.step(0.01));
  EXPECT(GET(comb.after_step(hair)).caught == 4);
  GET(comb.release(hair));
  EXPECT(GET(hair.constraint_count()) == 0 && static_cast<bool>(comb));

  const hair_handle h1 = GET(hair_handle_from_name("h1"));
  NEAR(h1.bending_stiffness, 7.59e-9, 1e-20);
  const hair_handle easy = GET(adjust_hair_handle(h1, 0.0, 1.0));
  EXPECT(easy.frictional_force < h1.frictional_force && GET(hair_handle_to_type(easy)).friction < 1.0);
  const combing_curve felt = GET(run_combing_test(h1, combing_test().with_stroke(0.005)));
  EXPECT(felt.force.size() == felt.result.step_count && felt.result.mean_force > 0.0 && felt.stroke.back() == 0.005);
}
