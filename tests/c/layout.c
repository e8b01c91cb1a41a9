/* Rule 11: sizes and offsets as a C compiler sees them on a 64-bit machine. A wrong one is an array of negative size. */
#include <stddef.h>
#include "superhelix.h"

#define JOIN2(a, b) a##b
#define JOIN(a, b) JOIN2(a, b)
#define ASSERT(condition) typedef char JOIN(assertion_, __LINE__)[(condition) ? 1 : -1]
#define SIZE(type, size) ASSERT(sizeof(type) == (size))
#define AT(type, field, offset) ASSERT(offsetof(type, field) == (offset))

SIZE(shx_solver_def, 176);
AT(shx_solver_def, struct_size, 0);
AT(shx_solver_def, worker_count, 4);
AT(shx_solver_def, gravity, 8);
AT(shx_solver_def, wind, 32);
AT(shx_solver_def, parallel_for, 56);
AT(shx_solver_def, parallel_for_user, 64);
AT(shx_solver_def, log, 72);
AT(shx_solver_def, log_user, 80);
AT(shx_solver_def, log_level, 88);
AT(shx_solver_def, integrator, 92);
AT(shx_solver_def, linear_solver, 96);
AT(shx_solver_def, precision, 100);
AT(shx_solver_def, max_iterations, 104);
AT(shx_solver_def, exact_hessian, 108);
AT(shx_solver_def, tolerance, 112);
AT(shx_solver_def, max_subdivisions, 120);
AT(shx_solver_def, instruction_set, 124);
AT(shx_solver_def, error_tolerance, 128);
AT(shx_solver_def, reference_tolerance, 136);
AT(shx_solver_def, quadrature_tolerance, 144);
AT(shx_solver_def, jump_acceleration, 152);
AT(shx_solver_def, reserved, 160);

SIZE(shx_frame, 56);
AT(shx_frame, origin, 0);
AT(shx_frame, rotation, 24);

SIZE(shx_strand_def, 264);
AT(shx_strand_def, struct_size, 0);
AT(shx_strand_def, element_count, 4);
AT(shx_strand_def, length, 8);
AT(shx_strand_def, element_lengths, 16);
AT(shx_strand_def, radius, 24);
AT(shx_strand_def, density, 40);
AT(shx_strand_def, youngs_modulus, 48);
AT(shx_strand_def, poisson_ratio, 56);
AT(shx_strand_def, internal_friction, 64);
AT(shx_strand_def, viscosity, 72);
AT(shx_strand_def, air_drag, 80);
AT(shx_strand_def, dofs, 88);
AT(shx_strand_def, reserved0, 92);
AT(shx_strand_def, root, 96);
AT(shx_strand_def, natural_curvatures, 152);
AT(shx_strand_def, user_data, 160);
AT(shx_strand_def, initial_curvatures, 168);
AT(shx_strand_def, initial_rates, 176);
AT(shx_strand_def, root_velocity, 184);
AT(shx_strand_def, root_angular_velocity, 208);
AT(shx_strand_def, reserved, 232);

SIZE(shx_step_report, 176);
AT(shx_step_report, struct_size, 0);
AT(shx_step_report, quarantined, 4);
AT(shx_step_report, unconverged, 8);
AT(shx_step_report, max_iterations, 12);
AT(shx_step_report, max_residual, 16);
AT(shx_step_report, kinetic_energy, 24);
AT(shx_step_report, elastic_energy, 32);
AT(shx_step_report, gravity_energy, 40);
AT(shx_step_report, seconds, 48);
AT(shx_step_report, substeps, 56);
AT(shx_step_report, subdivided, 60);
AT(shx_step_report, mean_iterations, 64);
AT(shx_step_report, max_condition, 72);
AT(shx_step_report, max_local_error, 80);
AT(shx_step_report, contacts, 88);
AT(shx_step_report, contact_searches, 92);
AT(shx_step_report, max_contact_iterations, 96);
AT(shx_step_report, unconverged_islands, 100);
AT(shx_step_report, contact_sweeps, 104);
AT(shx_step_report, max_contact_residual, 112);
AT(shx_step_report, max_penetration, 120);
AT(shx_step_report, max_constraint_error, 128);
AT(shx_step_report, roots_inside_bodies, 136);
AT(shx_step_report, stop_reason, 144);
AT(shx_step_report, unfinished, 148);
AT(shx_step_report, work, 152);
AT(shx_step_report, jumped_roots, 160);
AT(shx_step_report, fast_body_pieces, 164);
AT(shx_step_report, capped_contact_forces, 168);

SIZE(shx_step_limits, 32);
AT(shx_step_limits, struct_size, 0);
AT(shx_step_limits, reserved0, 4);
AT(shx_step_limits, max_work, 8);
AT(shx_step_limits, max_seconds, 16);
AT(shx_step_limits, cancel, 24);

SIZE(shx_strand_id, 8);
AT(shx_strand_id, bits, 0);

SIZE(shx_input, 32);
AT(shx_input, data, 0);
AT(shx_input, stride, 8);
AT(shx_input, count, 16);
AT(shx_input, format, 24);
AT(shx_input, reserved, 28);

SIZE(shx_output, 32);
AT(shx_output, data, 0);
AT(shx_output, stride, 8);
AT(shx_output, count, 16);
AT(shx_output, format, 24);
AT(shx_output, reserved, 28);

SIZE(shx_sample_def, 32);
AT(shx_sample_def, struct_size, 0);
AT(shx_sample_def, points_per_strand, 4);
AT(shx_sample_def, origin, 8);

SIZE(shx_settings, 64);
AT(shx_settings, struct_size, 0);
AT(shx_settings, integrator, 4);
AT(shx_settings, max_iterations, 8);
AT(shx_settings, substeps, 12);
AT(shx_settings, element_count, 16);
AT(shx_settings, max_subdivisions, 20);
AT(shx_settings, tolerance, 24);
AT(shx_settings, error_tolerance, 32);
AT(shx_settings, rms_error, 40);
AT(shx_settings, cost, 48);
AT(shx_settings, quadrature_tolerance, 56);

SIZE(shx_settle_def, 24);
AT(shx_settle_def, struct_size, 0);
AT(shx_settle_def, max_steps, 4);
AT(shx_settle_def, tolerance, 8);
AT(shx_settle_def, check_stability, 16);
AT(shx_settle_def, reserved, 20);

SIZE(shx_settle_report, 48);
AT(shx_settle_report, struct_size, 0);
AT(shx_settle_report, unconverged, 4);
AT(shx_settle_report, unstable, 8);
AT(shx_settle_report, saddles, 12);
AT(shx_settle_report, iterations, 16);
AT(shx_settle_report, max_residual, 24);
AT(shx_settle_report, smallest_eigenvalue, 32);
AT(shx_settle_report, seconds, 40);

SIZE(shx_suggest_def, 64);
AT(shx_suggest_def, struct_size, 0);
AT(shx_suggest_def, max_elements, 4);
AT(shx_suggest_def, tolerance, 8);
AT(shx_suggest_def, gravity, 16);
AT(shx_suggest_def, motion, 40);
AT(shx_suggest_def, motion_count, 48);
AT(shx_suggest_def, motion_interval, 56);

SIZE(shx_suggestion, 40);
AT(shx_suggestion, struct_size, 0);
AT(shx_suggestion, element_count, 4);
AT(shx_suggestion, meets_tolerance, 8);
AT(shx_suggestion, reserved, 12);
AT(shx_suggestion, rest_error, 16);
AT(shx_suggestion, motion_error, 24);
AT(shx_suggestion, max_turning_angle, 32);

SIZE(shx_polyline_fit, 88);
AT(shx_polyline_fit, struct_size, 0);
AT(shx_polyline_fit, reserved, 4);
AT(shx_polyline_fit, root, 8);
AT(shx_polyline_fit, length, 64);
AT(shx_polyline_fit, rms_error, 72);
AT(shx_polyline_fit, max_error, 80);

SIZE(shx_fit_options, 120);
AT(shx_fit_options, struct_size, 0);
AT(shx_fit_options, element_count, 4);
AT(shx_fit_options, tolerance, 8);
AT(shx_fit_options, length_mode, 16);
AT(shx_fit_options, twist, 20);
AT(shx_fit_options, min_length_ratio, 24);
AT(shx_fit_options, target_rms_error, 32);
AT(shx_fit_options, target_max_error, 40);
AT(shx_fit_options, noise, 48);
AT(shx_fit_options, frame_weight, 56);
AT(shx_fit_options, max_starts, 64);
AT(shx_fit_options, worker_count, 68);
AT(shx_fit_options, parallel_for, 72);
AT(shx_fit_options, parallel_for_user, 80);
AT(shx_fit_options, reserved, 88);

SIZE(shx_fit_input, 168);
AT(shx_fit_input, struct_size, 0);
AT(shx_fit_input, reserved0, 4);
AT(shx_fit_input, curve_count, 8);
AT(shx_fit_input, points, 16);
AT(shx_fit_input, point_counts, 48);
AT(shx_fit_input, arclengths, 56);
AT(shx_fit_input, widths, 64);
AT(shx_fit_input, frames, 72);
AT(shx_fit_input, roots, 104);
AT(shx_fit_input, reserved, 136);

SIZE(shx_fitted_strand, 112);
AT(shx_fitted_strand, result, 0);
AT(shx_fitted_strand, element_count, 4);
AT(shx_fitted_strand, root, 8);
AT(shx_fitted_strand, length, 64);
AT(shx_fitted_strand, rms_error, 72);
AT(shx_fitted_strand, max_error, 80);
AT(shx_fitted_strand, max_distance, 88);
AT(shx_fitted_strand, frame_error, 96);
AT(shx_fitted_strand, radius, 104);

SIZE(shx_friction_fit_def, 256);
AT(shx_friction_fit_def, struct_size, 0);
AT(shx_friction_fit_def, observable, 4);
AT(shx_friction_fit_def, coefficients, 8);
AT(shx_friction_fit_def, start, 12);
AT(shx_friction_fit_def, direction, 16);
AT(shx_friction_fit_def, internal_friction_range, 40);
AT(shx_friction_fit_def, viscosity_range, 56);
AT(shx_friction_fit_def, air_drag_range, 72);
AT(shx_friction_fit_def, internal_friction_guess, 88);
AT(shx_friction_fit_def, viscosity_guess, 96);
AT(shx_friction_fit_def, air_drag_guess, 104);
AT(shx_friction_fit_def, lead_in, 112);
AT(shx_friction_fit_def, discard, 120);
AT(shx_friction_fit_def, time_step, 128);
AT(shx_friction_fit_def, grid_points, 136);
AT(shx_friction_fit_def, fit_offset, 140);
AT(shx_friction_fit_def, max_iterations, 144);
AT(shx_friction_fit_def, reserved0, 148);
AT(shx_friction_fit_def, oscillation_amplitude, 152);
AT(shx_friction_fit_def, oscillation_frequency, 160);
AT(shx_friction_fit_def, oscillation_phase, 168);
AT(shx_friction_fit_def, oscillation_direction, 176);
AT(shx_friction_fit_def, root_times, 200);
AT(shx_friction_fit_def, root_frames, 208);
AT(shx_friction_fit_def, root_count, 216);
AT(shx_friction_fit_def, reserved, 224);

SIZE(shx_fitted_coefficient, 48);
AT(shx_fitted_coefficient, status, 0);
AT(shx_fitted_coefficient, reserved, 4);
AT(shx_fitted_coefficient, value, 8);
AT(shx_fitted_coefficient, standard_error, 16);
AT(shx_fitted_coefficient, step_sensitivity, 24);
AT(shx_fitted_coefficient, excluded_below, 32);
AT(shx_fitted_coefficient, excluded_above, 40);

SIZE(shx_friction_fit_report, 200);
AT(shx_friction_fit_report, struct_size, 0);
AT(shx_friction_fit_report, converged, 4);
AT(shx_friction_fit_report, internal_friction, 8);
AT(shx_friction_fit_report, viscosity, 56);
AT(shx_friction_fit_report, air_drag, 104);
AT(shx_friction_fit_report, rms_residual, 152);
AT(shx_friction_fit_report, noise, 160);
AT(shx_friction_fit_report, residual_correlation, 168);
AT(shx_friction_fit_report, offset, 176);
AT(shx_friction_fit_report, simulations, 184);
AT(shx_friction_fit_report, unconverged, 188);
AT(shx_friction_fit_report, first_compared, 192);
AT(shx_friction_fit_report, compared, 196);

SIZE(shx_body_id, 8);
AT(shx_body_id, bits, 0);

SIZE(shx_constraint_id, 8);
AT(shx_constraint_id, bits, 0);

SIZE(shx_body_def, 312);
AT(shx_body_def, struct_size, 0);
AT(shx_body_def, shape, 4);
AT(shx_body_def, pose, 8);
AT(shx_body_def, radius, 64);
AT(shx_body_def, a, 72);
AT(shx_body_def, b, 96);
AT(shx_body_def, semi_axes, 120);
AT(shx_body_def, half_extents, 144);
AT(shx_body_def, normal, 168);
AT(shx_body_def, vertices, 192);
AT(shx_body_def, triangles, 224);
AT(shx_body_def, triangle_count, 232);
AT(shx_body_def, sides, 240);
AT(shx_body_def, reserved0, 244);
AT(shx_body_def, depth, 248);
AT(shx_body_def, grid, 256);
AT(shx_body_def, grid_size, 264);
AT(shx_body_def, thickness, 272);
AT(shx_body_def, friction_scale, 280);
AT(shx_body_def, viscous_friction_scale, 288);
AT(shx_body_def, groups, 296);
AT(shx_body_def, mask, 300);
AT(shx_body_def, shape_of, 304);

SIZE(shx_contact_options, 72);
AT(shx_contact_options, struct_size, 0);
AT(shx_contact_options, model, 4);
AT(shx_contact_options, hair_contact, 8);
AT(shx_contact_options, max_iterations, 12);
AT(shx_contact_options, max_sweeps, 16);
AT(shx_contact_options, reserved0, 20);
AT(shx_contact_options, stiffness, 24);
AT(shx_contact_options, damping, 32);
AT(shx_contact_options, regularisation_depth, 40);
AT(shx_contact_options, tolerance, 48);
AT(shx_contact_options, residual, 56);
AT(shx_contact_options, separation_speed, 64);

SIZE(shx_strand_contact, 88);
AT(shx_strand_contact, struct_size, 0);
AT(shx_strand_contact, groups, 4);
AT(shx_strand_contact, mask, 8);
AT(shx_strand_contact, reserved0, 12);
AT(shx_strand_contact, radius, 16);
AT(shx_strand_contact, wisp_radius, 24);
AT(shx_strand_contact, friction_along, 32);
AT(shx_strand_contact, friction_against, 40);
AT(shx_strand_contact, hair_friction_along, 48);
AT(shx_strand_contact, hair_friction_against, 56);
AT(shx_strand_contact, viscous_friction_along, 64);
AT(shx_strand_contact, viscous_friction_against, 72);
AT(shx_strand_contact, exempt_length, 80);

SIZE(shx_contact, 152);
AT(shx_contact, strand, 0);
AT(shx_contact, arclength, 8);
AT(shx_contact, partner, 16);
AT(shx_contact, triangle, 20);
AT(shx_contact, body, 24);
AT(shx_contact, other_strand, 32);
AT(shx_contact, other_arclength, 40);
AT(shx_contact, position, 48);
AT(shx_contact, normal, 72);
AT(shx_contact, force, 96);
AT(shx_contact, slip, 120);
AT(shx_contact, gap, 144);

SIZE(shx_constraint_def, 120);
AT(shx_constraint_def, struct_size, 0);
AT(shx_constraint_def, kind, 4);
AT(shx_constraint_def, strand, 8);
AT(shx_constraint_def, arclength, 16);
AT(shx_constraint_def, other_strand, 24);
AT(shx_constraint_def, other_arclength, 32);
AT(shx_constraint_def, target, 40);
AT(shx_constraint_def, friction_along, 96);
AT(shx_constraint_def, friction_against, 104);
AT(shx_constraint_def, compliance, 112);

SIZE(shx_constraint_state, 72);
AT(shx_constraint_state, status, 0);
AT(shx_constraint_state, reserved, 4);
AT(shx_constraint_state, arclength, 8);
AT(shx_constraint_state, error, 16);
AT(shx_constraint_state, force, 24);
AT(shx_constraint_state, torque, 48);

SIZE(shx_hair_type, 176);
AT(shx_hair_type, struct_size, 0);
AT(shx_hair_type, curl, 4);
AT(shx_hair_type, mean_radius, 8);
AT(shx_hair_type, ellipticity, 16);
AT(shx_hair_type, helix_radius, 24);
AT(shx_hair_type, helix_pitch, 32);
AT(shx_hair_type, youngs_modulus, 40);
AT(shx_hair_type, poisson_ratio, 48);
AT(shx_hair_type, density, 56);
AT(shx_hair_type, internal_friction, 64);
AT(shx_hair_type, air_drag, 72);
AT(shx_hair_type, friction, 80);
AT(shx_hair_type, variation_between, 88);
AT(shx_hair_type, variation_along, 96);
AT(shx_hair_type, variation_thickness, 104);
AT(shx_hair_type, frizz, 112);
AT(shx_hair_type, variation_period, 120);
AT(shx_hair_type, root_turn, 128);
AT(shx_hair_type, seed, 136);
AT(shx_hair_type, reserved, 144);

SIZE(shx_hair_sliders, 64);
AT(shx_hair_sliders, struct_size, 0);
AT(shx_hair_sliders, reserved0, 4);
AT(shx_hair_sliders, curliness, 8);
AT(shx_hair_sliders, stiffness, 16);
AT(shx_hair_sliders, discipline, 24);
AT(shx_hair_sliders, weight, 32);
AT(shx_hair_sliders, combing_ease, 40);
AT(shx_hair_sliders, reserved, 48);

SIZE(shx_hair_strand, 88);
AT(shx_hair_strand, radius, 0);
AT(shx_hair_strand, density, 16);
AT(shx_hair_strand, youngs_modulus, 24);
AT(shx_hair_strand, poisson_ratio, 32);
AT(shx_hair_strand, internal_friction, 40);
AT(shx_hair_strand, viscosity, 48);
AT(shx_hair_strand, air_drag, 56);
AT(shx_hair_strand, root_turn, 64);
AT(shx_hair_strand, friction_along, 72);
AT(shx_hair_strand, friction_against, 80);

SIZE(shx_curve_data, 184);
AT(shx_curve_data, struct_size, 0);
AT(shx_curve_data, up_axis, 4);
AT(shx_curve_data, strand_count, 8);
AT(shx_curve_data, point_counts, 16);
AT(shx_curve_data, points, 24);
AT(shx_curve_data, velocities, 56);
AT(shx_curve_data, thickness, 88);
AT(shx_curve_data, transparency, 96);
AT(shx_curve_data, colors, 104);
AT(shx_curve_data, pinned, 112);
AT(shx_curve_data, strand_thickness, 120);
AT(shx_curve_data, strand_uvs, 128);
AT(shx_curve_data, metres_per_unit, 136);
AT(shx_curve_data, tfx_version, 144);
AT(shx_curve_data, reserved0, 148);
AT(shx_curve_data, reserved, 152);

SIZE(shx_pose_options, 80);
AT(shx_pose_options, struct_size, 0);
AT(shx_pose_options, keep_tip_direction, 4);
AT(shx_pose_options, avoid_bodies, 8);
AT(shx_pose_options, reserved0, 12);
AT(shx_pose_options, natural_pull, 16);
AT(shx_pose_options, clearance, 24);
AT(shx_pose_options, movable, 32);
AT(shx_pose_options, movable_count, 40);
AT(shx_pose_options, reserved, 48);

SIZE(shx_brush, 88);
AT(shx_brush, struct_size, 0);
AT(shx_brush, reserved0, 4);
AT(shx_brush, centre, 8);
AT(shx_brush, radius, 32);
AT(shx_brush, falloff, 40);
AT(shx_brush, displacement, 48);
AT(shx_brush, reserved, 72);

SIZE(shx_element_change, 48);
AT(shx_element_change, struct_size, 0);
AT(shx_element_change, element, 4);
AT(shx_element_change, twist, 8);
AT(shx_element_change, bend, 16);
AT(shx_element_change, length_scale, 32);
AT(shx_element_change, keep_curvature, 40);
AT(shx_element_change, reserved, 44);

SIZE(shx_material, 72);
AT(shx_material, struct_size, 0);
AT(shx_material, reserved0, 4);
AT(shx_material, radius, 8);
AT(shx_material, density, 24);
AT(shx_material, youngs_modulus, 32);
AT(shx_material, poisson_ratio, 40);
AT(shx_material, internal_friction, 48);
AT(shx_material, viscosity, 56);
AT(shx_material, air_drag, 64);

SIZE(shx_wisp, 24);
AT(shx_wisp, struct_size, 0);
AT(shx_wisp, reserved0, 4);
AT(shx_wisp, hairs, 8);
AT(shx_wisp, hold, 16);

SIZE(shx_render_settings, 248);
AT(shx_render_settings, struct_size, 0);
AT(shx_render_settings, points_per_strand, 4);
AT(shx_render_settings, interpolation, 8);
AT(shx_render_settings, guides_per_strand, 12);
AT(shx_render_settings, curliness, 16);
AT(shx_render_settings, measure_curliness, 24);
AT(shx_render_settings, wisps_per_guide, 28);
AT(shx_render_settings, max_tip_distance, 32);
AT(shx_render_settings, max_tip_ratio, 40);
AT(shx_render_settings, wisp_profile, 48);
AT(shx_render_settings, wisp_flatness, 72);
AT(shx_render_settings, wisp_noise, 80);
AT(shx_render_settings, wisp_noise_waves, 88);
AT(shx_render_settings, frizz, 96);
AT(shx_render_settings, frizz_waves, 104);
AT(shx_render_settings, flyaway_fraction, 112);
AT(shx_render_settings, flyaway_distance, 120);
AT(shx_render_settings, length_variation, 128);
AT(shx_render_settings, radius, 136);
AT(shx_render_settings, tip_radius, 144);
AT(shx_render_settings, taper_start, 152);
AT(shx_render_settings, taper_shape, 160);
AT(shx_render_settings, radius_variation, 168);
AT(shx_render_settings, body_clearance, 176);
AT(shx_render_settings, seed, 184);
AT(shx_render_settings, preserve_length, 192);
AT(shx_render_settings, worker_count, 196);
AT(shx_render_settings, parallel_for, 200);
AT(shx_render_settings, parallel_for_user, 208);
AT(shx_render_settings, reserved, 216);

SIZE(shx_render_guides, 184);
AT(shx_render_guides, struct_size, 0);
AT(shx_render_guides, reserved0, 4);
AT(shx_render_guides, guide_count, 8);
AT(shx_render_guides, points, 16);
AT(shx_render_guides, point_counts, 48);
AT(shx_render_guides, roots, 56);
AT(shx_render_guides, velocities, 88);
AT(shx_render_guides, root_angular_velocities, 120);
AT(shx_render_guides, reserved, 152);

SIZE(shx_render_view, 160);
AT(shx_render_view, struct_size, 0);
AT(shx_render_view, reserved0, 4);
AT(shx_render_view, first_strand, 8);
AT(shx_render_view, strand_count, 16);
AT(shx_render_view, origin, 24);
AT(shx_render_view, previous_pose, 48);
AT(shx_render_view, interval, 56);
AT(shx_render_view, roots, 64);
AT(shx_render_view, previous_roots, 96);
AT(shx_render_view, reserved, 128);

SIZE(shx_follicle, 24);
AT(shx_follicle, triangle, 0);
AT(shx_follicle, reserved, 4);
AT(shx_follicle, barycentric, 8);

SIZE(shx_scalp_def, 120);
AT(shx_scalp_def, struct_size, 0);
AT(shx_scalp_def, reserved0, 4);
AT(shx_scalp_def, vertices, 8);
AT(shx_scalp_def, triangles, 40);
AT(shx_scalp_def, triangle_count, 48);
AT(shx_scalp_def, uvs, 56);
AT(shx_scalp_def, reference_axis, 64);
AT(shx_scalp_def, reserved, 88);

SIZE(shx_scatter_def, 128);
AT(shx_scatter_def, struct_size, 0);
AT(shx_scatter_def, reserved0, 4);
AT(shx_scatter_def, count, 8);
AT(shx_scatter_def, spacing, 16);
AT(shx_scatter_def, density, 24);
AT(shx_scatter_def, density_width, 32);
AT(shx_scatter_def, density_height, 40);
AT(shx_scatter_def, seed, 48);
AT(shx_scatter_def, guide_roots, 56);
AT(shx_scatter_def, max_guide_distance, 88);
AT(shx_scatter_def, reserved, 96);

SIZE(shx_distance_grid_def, 72);
AT(shx_distance_grid_def, struct_size, 0);
AT(shx_distance_grid_def, reserved0, 4);
AT(shx_distance_grid_def, vertices, 8);
AT(shx_distance_grid_def, triangles, 40);
AT(shx_distance_grid_def, triangle_count, 48);
AT(shx_distance_grid_def, cell, 56);
AT(shx_distance_grid_def, band, 64);

SIZE(shx_hair_strands_def, 56);
AT(shx_hair_strands_def, struct_size, 0);
AT(shx_hair_strands_def, reserved0, 4);
AT(shx_hair_strands_def, hair_type, 8);
AT(shx_hair_strands_def, sliders, 16);
AT(shx_hair_strands_def, first_strand, 24);
AT(shx_hair_strands_def, strand_count, 32);
AT(shx_hair_strands_def, element_counts, 40);
AT(shx_hair_strands_def, element_lengths, 48);

SIZE(shx_push_out_def, 40);
AT(shx_push_out_def, struct_size, 0);
AT(shx_push_out_def, reserved0, 4);
AT(shx_push_out_def, body, 8);
AT(shx_push_out_def, clearance, 16);
AT(shx_push_out_def, point_counts, 24);
AT(shx_push_out_def, curve_count, 32);

SIZE(shx_spline_def, 48);
AT(shx_spline_def, struct_size, 0);
AT(shx_spline_def, kind, 4);
AT(shx_spline_def, ends, 8);
AT(shx_spline_def, points_per_span, 12);
AT(shx_spline_def, controls, 16);

SIZE(shx_haptic_def, 200);
AT(shx_haptic_def, struct_size, 0);
AT(shx_haptic_def, mode, 4);
AT(shx_haptic_def, handle, 8);
AT(shx_haptic_def, stiffness, 64);
AT(shx_haptic_def, damping, 72);
AT(shx_haptic_def, angular_stiffness, 80);
AT(shx_haptic_def, angular_damping, 88);
AT(shx_haptic_def, max_force, 96);
AT(shx_haptic_def, max_torque, 104);
AT(shx_haptic_def, max_force_rate, 112);
AT(shx_haptic_def, max_torque_rate, 120);
AT(shx_haptic_def, energy_allowance, 128);
AT(shx_haptic_def, max_energy_credit, 136);
AT(shx_haptic_def, max_acceleration, 144);
AT(shx_haptic_def, max_angular_acceleration, 152);
AT(shx_haptic_def, max_model_age, 160);
AT(shx_haptic_def, max_contacts, 168);
AT(shx_haptic_def, max_sweeps, 172);
AT(shx_haptic_def, force_law, 176);
AT(shx_haptic_def, reserved0, 180);
AT(shx_haptic_def, explicit_time, 184);
AT(shx_haptic_def, explicit_friction, 192);

SIZE(shx_haptic_state, 176);
AT(shx_haptic_state, struct_size, 0);
AT(shx_haptic_state, limits, 4);
AT(shx_haptic_state, proxy, 8);
AT(shx_haptic_state, contact_force, 64);
AT(shx_haptic_state, contact_torque, 88);
AT(shx_haptic_state, energy_given, 112);
AT(shx_haptic_state, energy_received, 120);
AT(shx_haptic_state, max_energy_excess, 128);
AT(shx_haptic_state, model_age, 136);
AT(shx_haptic_state, model_count, 144);
AT(shx_haptic_state, contacts, 152);
AT(shx_haptic_state, pressing, 156);
AT(shx_haptic_state, left_out, 160);
AT(shx_haptic_state, sweeps, 164);
AT(shx_haptic_state, residual, 168);

SIZE(shx_hair_handle, 64);
AT(shx_hair_handle, struct_size, 0);
AT(shx_hair_handle, reserved0, 4);
AT(shx_hair_handle, major_diameter, 8);
AT(shx_hair_handle, ellipticity, 16);
AT(shx_hair_handle, natural_twist, 24);
AT(shx_hair_handle, natural_curvature, 32);
AT(shx_hair_handle, bending_stiffness, 40);
AT(shx_hair_handle, frictional_force, 48);
AT(shx_hair_handle, internal_friction, 56);

SIZE(shx_combing_test, 48);
AT(shx_combing_test, struct_size, 0);
AT(shx_combing_test, strand_count, 4);
AT(shx_combing_test, element_count, 8);
AT(shx_combing_test, reserved0, 12);
AT(shx_combing_test, length, 16);
AT(shx_combing_test, stroke, 24);
AT(shx_combing_test, speed, 32);
AT(shx_combing_test, rate, 40);

SIZE(shx_combing_result, 40);
AT(shx_combing_result, step_count, 0);
AT(shx_combing_result, mean_force, 8);
AT(shx_combing_result, mean_pressure, 16);
AT(shx_combing_result, friction, 24);
AT(shx_combing_result, work, 32);

SIZE(shx_tool_def, 64);
AT(shx_tool_def, struct_size, 0);
AT(shx_tool_def, kind, 4);
AT(shx_tool_def, tooth_count, 8);
AT(shx_tool_def, row_count, 12);
AT(shx_tool_def, spacing, 16);
AT(shx_tool_def, row_spacing, 24);
AT(shx_tool_def, length, 32);
AT(shx_tool_def, radius, 40);
AT(shx_tool_def, width, 48);
AT(shx_tool_def, thickness, 56);

SIZE(shx_clip_def, 96);
AT(shx_clip_def, struct_size, 0);
AT(shx_clip_def, kind, 4);
AT(shx_clip_def, pose, 8);
AT(shx_clip_def, half_edges, 64);
AT(shx_clip_def, compliance, 88);

SIZE(shx_cut, 56);
AT(shx_cut, strand, 0);
AT(shx_cut, length, 8);
AT(shx_cut, removed, 16);
AT(shx_cut, position, 24);
AT(shx_cut, removed_constraints, 48);

SIZE(shx_heat_def, 96);
AT(shx_heat_def, struct_size, 0);
AT(shx_heat_def, shape, 4);
AT(shx_heat_def, pose, 8);
AT(shx_heat_def, half_edges, 64);
AT(shx_heat_def, rate, 88);

SIZE(shx_ring_comb_def, 32);
AT(shx_ring_comb_def, struct_size, 0);
AT(shx_ring_comb_def, reserved0, 4);
AT(shx_ring_comb_def, friction, 8);
AT(shx_ring_comb_def, max_force, 16);
AT(shx_ring_comb_def, exempt_length, 24);

SIZE(shx_ring_comb_report, 64);
AT(shx_ring_comb_report, held, 0);
AT(shx_ring_comb_report, caught, 4);
AT(shx_ring_comb_report, combed, 8);
AT(shx_ring_comb_report, let_go, 12);
AT(shx_ring_comb_report, force, 16);
AT(shx_ring_comb_report, torque, 40);

int main(void) { return 0; }
