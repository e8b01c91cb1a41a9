// Fits, splines, settings, kinds of hair.
#include "check.hpp"

using namespace superhelix;

static const double pi = 3.14159265358979323846;

// Points of a helix of one turn: radius 2 cm, 4 cm high.
static std::vector<vec3> helix(std::size_t count) {
  std::vector<vec3> points;
  for (std::size_t i = 0; i < count; i++) {
    const double t = 2.0 * pi * static_cast<double>(i) / static_cast<double>(count - 1);
    points.push_back({0.02 * std::cos(t), 0.02 * std::sin(t), -0.04 * t / (2.0 * pi)});
  }
  return points;
}

TEST(polylines_are_fitted) {
  const auto fitted = GET(fit_polyline(helix(60), 6));
  NEAR(fitted.fit.length, std::hypot(2.0 * pi * 0.02, 0.04), 1e-3);
  EXPECT(fitted.fit.rms_error < 1e-3 && fitted.element_lengths.size() == 6);
  const auto def = strand_def().with_element_lengths(fitted.element_lengths).with_natural_curvatures(fitted.curvatures).with_root(fitted.fit.root);
  const auto natural = GET(sag_free_curvatures(def, fitted.curvatures, {0.0, 0.0, -9.81}));
  EXPECT(natural.size() == 6 && natural[0] != fitted.curvatures[0]);
  solver hair = GET(solver::create());
  strand_def still = def;
  still.with_natural_curvatures(natural).with_initial_curvatures(fitted.curvatures);
  const strand_id id = GET(hair.add_strand(still));
  GET(hair.step(1.0 / 60.0));
  std::vector<curvature> now(6);
  GET(hair.get_curvatures(id, now));
  NEAR(now[3][1], fitted.curvatures[3][1], 1e-3);
  EXPECT(WHY(fit_polyline(helix(60), 4000000000)).code() == SHX_ERROR_INVALID_ARGUMENT);
  EXPECT(WHY(fit_polyline(std::vector<vec3>(1), 6)).code() == SHX_ERROR_INVALID_ARGUMENT);
}

TEST(many_curves_are_fitted_at_once) {
  std::vector<vec3> points = helix(40);
  points.insert(points.end(), 3, vec3{1.0, 1.0, 1.0});  // no length
  const std::vector<std::uint32_t> counts{40, 3};
  const std::vector<double> widths(43, 1e-4);
  const auto curves = fit_input().with_point_counts(counts).with_points(points).with_widths(widths);
  const auto fitted = GET(fit_strands(curves, fit_options().with_element_count(8).with_length_mode(fit_lengths::equal)));
  EXPECT(fitted.size() == 2 && fitted.ok(0) && !fitted.ok(1) && fitted[0].rms_error < 1e-3);
  EXPECT(fitted.element_lengths(0).size() == 8 && fitted.curvatures(0).size() == 8 && fitted.curvatures(1).empty());
  strand_def def;
  GET(fitted.apply(0, def));
  EXPECT(def.element_count == 8 && def.natural_curvatures == fitted.curvatures(0).data()->data());
  NEAR(def.radius[0], 5e-5, 1e-12);
  EXPECT(WHY(fitted.apply(1, def)).code() == SHX_ERROR_INVALID_ARGUMENT);
}

TEST(splines_are_sampled) {
  const std::vector<vec3> controls{{0.0, 0.0, 0.0}, {0.0, 0.0, -0.1}, {0.02, 0.0, -0.2}};
  const auto def = spline_def().with_kind(spline::catmull_rom).with_ends(spline_ends::pinned).with_points_per_span(10).with_controls(controls);
  const auto made = GET(sample_spline(def));
  EXPECT(made.points.size() == 21 && made.arclengths.size() == 21 && made.arclengths[0] == 0.0);
  NEAR(check::distance(made.points[20], controls[2]), 0.0, 1e-12);
}

TEST(motions_are_sampled) {
  // A turn about z at 2 rad/s on a way at 0.5 m/s.
  const std::vector<double> pose_times{0.0, 0.1, 0.2, 0.3};
  std::vector<frame> poses;
  for (const double time : pose_times)
    poses.push_back(make_frame({0.5 * time, 0.0, 1.0}, {0.0, 0.0, std::sin(time), std::cos(time)}));
  const std::vector<double> times{-1.0, 0.0, 0.17};
  const auto made = GET(sample_motion(pose_times, poses, times));
  EXPECT(made.frames.size() == 3 && made.velocities.size() == 3 && made.angular_velocities.size() == 3);
  NEAR(made.frames[2].origin[0], 0.085, 1e-12);
  NEAR(made.frames[2].rotation[2], std::sin(0.17), 1e-12);
  NEAR(made.velocities[0][0], 0.0, 0.0);
  NEAR(made.velocities[1][0], 0.5, 1e-12);
  NEAR(made.angular_velocities[2][2], 2.0, 1e-12);
  EXPECT(WHY(sample_motion({pose_times.data(), 3}, poses, times)).code() == SHX_ERROR_INVALID_ARGUMENT);
  EXPECT(WHY(sample_motion({}, {}, times)).code() == SHX_ERROR_INVALID_ARGUMENT);
}

TEST(friction_is_fitted_to_a_recording) {
  // A pendulum recorded in a simulation of known air drag.
  const double truth = 2e-5;
  const auto def = strand_def().with_length(0.1).with_element_count(1).with_youngs_modulus(1e9).with_air_drag(truth).with_root(
      make_frame({0.0, 0.0, 0.0}, {0.0, std::sqrt(0.5), 0.0, std::sqrt(0.5)}));
  solver hair = GET(solver::create());
  const curvature bent{0.0, 5.0, 0.0};
  const auto pushed = strand_def(def).with_initial_curvatures(bent);
  const strand_id id = GET(hair.add_strand(pushed));
  std::vector<double> times, values;
  for (int i = 0; i < 60; i++) {
    vec3 tip{};
    GET(hair.sample_at(id, {0.1}, tip));
    times.push_back(i / 240.0);
    values.push_back(tip[0]);
    GET(hair.step(1.0 / 240.0, 2));
  }
  const auto friction = friction_fit_def()
                            .with_coefficients(friction_coefficient::air_drag)
                            .with_observable(observable::offset)
                            .with_start(friction_start::as_defined)
                            .with_grid_points(5);
  std::vector<double> curve(60);
  const auto report = GET(fit_friction(pushed, friction, times, values, {}, curve));
  EXPECT(report.air_drag.status == coefficient_status::determined && report.internal_friction.status == coefficient_status::not_fitted);
  NEAR(report.air_drag.value, truth, 0.02 * truth);
  NEAR(curve[30], values[30], 1e-4);
  EXPECT(WHY(fit_friction(pushed, friction, times, span<const double>(values).first(59))).code() == SHX_ERROR_INVALID_ARGUMENT);
}

TEST(settings_are_suggested) {
  const auto preset = GET(settings_from_preset(preset::balanced, 20.0, 0.2, 1.0 / 60.0));
  const auto cheap = GET(suggest_settings(0.05, 20.0, 0.2, 1.0 / 60.0));
  EXPECT(preset.element_count >= 4 && preset.substeps >= 1 && cheap.element_count >= 1 && cheap.rms_error <= 0.05);
  EXPECT(WHY(suggest_settings(-1.0, 20.0, 0.2, 1.0 / 60.0)).code() == SHX_ERROR_INVALID_ARGUMENT);
  const curvature curl{5.0, 40.0, 0.0};
  const auto found = GET(suggest_elements(strand_def().with_length(0.15).with_natural_curvatures(curl),
                                          suggest_def().with_tolerance(2e-3).with_max_elements(40)));
  EXPECT(found.meets_tolerance == 1 && found.element_count >= 2 && found.rest_error <= 2e-3);
}

TEST(kinds_of_hair_and_wisps) {
  const auto african = GET(hair_type_from_name("african"));
  EXPECT(african.helix_radius > 0.0 && WHY(hair_type_from_name("elvish")).code() == SHX_ERROR_INVALID_ARGUMENT);
  const auto sliders = hair_sliders().with_curliness(0.5);
  const std::vector<std::uint32_t> counts{2, 3};
  const std::vector<double> lengths(5, 0.01);
  const auto made = GET(make_hair_strands(hair_strands_def().with_hair_type(&african).with_sliders(&sliders).with_elements(counts, lengths)));
  EXPECT(made.strands.size() == 2 && made.curvatures.size() == 5 && std::abs(made.curvatures[4][1]) > 10.0 && made.strands[1].density > 1000.0);
  EXPECT(WHY(make_hair_strands(hair_strands_def().with_hair_type(&african).with_elements(counts, span<const double>(lengths).first(4)))).code() ==
         SHX_ERROR_INVALID_ARGUMENT);
  const auto rod = GET(wisp_material(wisp().with_hairs(100.0), material()));
  EXPECT(rod.material.radius[0] > material().radius[0] && rod.radius > rod.material.radius[0] && rod.margin > 0.0);
}
