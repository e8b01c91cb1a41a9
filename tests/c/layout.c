/* Rule 11: sizes and offsets as a C compiler sees them on a 64-bit machine. A wrong one is an array of negative size. */
#include <stddef.h>
#include "superhelix.h"

#define JOIN2(a, b) a##b
#define JOIN(a, b) JOIN2(a, b)
#define ASSERT(condition) typedef char JOIN(assertion_, __LINE__)[(condition) ? 1 : -1]
#define SIZE(type, size) ASSERT(sizeof(type) == (size))
#define AT(type, field, offset) ASSERT(offsetof(type, field) == (offset))

SIZE(shx_solver_def, 168);
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
AT(shx_solver_def, reserved, 136);
AT(shx_solver_def, reference_tolerance, 152);
AT(shx_solver_def, quadrature_tolerance, 160);

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
AT(shx_strand_def, freedoms, 88);
AT(shx_strand_def, reserved0, 92);
AT(shx_strand_def, root, 96);
AT(shx_strand_def, natural, 152);
AT(shx_strand_def, user_data, 160);
AT(shx_strand_def, initial, 168);
AT(shx_strand_def, initial_rates, 176);
AT(shx_strand_def, root_velocity, 184);
AT(shx_strand_def, root_angular_velocity, 208);
AT(shx_strand_def, reserved, 232);

SIZE(shx_step_report, 136);
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
AT(shx_step_report, max_error, 80);
AT(shx_step_report, contacts, 88);
AT(shx_step_report, contact_searches, 92);
AT(shx_step_report, contact_iterations, 96);
AT(shx_step_report, contact_unconverged, 100);
AT(shx_step_report, contact_sweeps, 104);
AT(shx_step_report, contact_residual, 112);
AT(shx_step_report, max_penetration, 120);
AT(shx_step_report, max_constraint_error, 128);

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
AT(shx_settings, error, 40);
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
AT(shx_suggestion, met, 8);
AT(shx_suggestion, reserved, 12);
AT(shx_suggestion, rest_error, 16);
AT(shx_suggestion, motion_error, 24);
AT(shx_suggestion, turn, 32);

SIZE(shx_fit, 88);
AT(shx_fit, struct_size, 0);
AT(shx_fit, reserved, 4);
AT(shx_fit, root, 8);
AT(shx_fit, length, 64);
AT(shx_fit, rms_error, 72);
AT(shx_fit, max_error, 80);
SIZE(shx_friction_def, 256);
AT(shx_friction_def, struct_size, 0);
AT(shx_friction_def, observable, 4);
AT(shx_friction_def, coefficients, 8);
AT(shx_friction_def, start, 12);
AT(shx_friction_def, direction, 16);
AT(shx_friction_def, internal_friction_range, 40);
AT(shx_friction_def, viscosity_range, 56);
AT(shx_friction_def, air_drag_range, 72);
AT(shx_friction_def, internal_friction_guess, 88);
AT(shx_friction_def, viscosity_guess, 96);
AT(shx_friction_def, air_drag_guess, 104);
AT(shx_friction_def, lead_in, 112);
AT(shx_friction_def, discard, 120);
AT(shx_friction_def, time_step, 128);
AT(shx_friction_def, grid_points, 136);
AT(shx_friction_def, fit_offset, 140);
AT(shx_friction_def, max_iterations, 144);
AT(shx_friction_def, reserved0, 148);
AT(shx_friction_def, oscillation_amplitude, 152);
AT(shx_friction_def, oscillation_frequency, 160);
AT(shx_friction_def, oscillation_phase, 168);
AT(shx_friction_def, oscillation_direction, 176);
AT(shx_friction_def, root_times, 200);
AT(shx_friction_def, root_frames, 208);
AT(shx_friction_def, root_count, 216);
AT(shx_friction_def, reserved, 224);
SIZE(shx_fitted_coefficient, 48);
AT(shx_fitted_coefficient, verdict, 0);
AT(shx_fitted_coefficient, reserved, 4);
AT(shx_fitted_coefficient, value, 8);
AT(shx_fitted_coefficient, standard_error, 16);
AT(shx_fitted_coefficient, step_shift, 24);
AT(shx_fitted_coefficient, excluded_below, 32);
AT(shx_fitted_coefficient, excluded_above, 40);
SIZE(shx_friction_report, 200);
AT(shx_friction_report, struct_size, 0);
AT(shx_friction_report, converged, 4);
AT(shx_friction_report, internal_friction, 8);
AT(shx_friction_report, viscosity, 56);
AT(shx_friction_report, air_drag, 104);
AT(shx_friction_report, rms_residual, 152);
AT(shx_friction_report, noise, 160);
AT(shx_friction_report, residual_correlation, 168);
AT(shx_friction_report, offset, 176);
AT(shx_friction_report, simulations, 184);
AT(shx_friction_report, unconverged, 188);
AT(shx_friction_report, first_compared, 192);
AT(shx_friction_report, compared, 196);
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
AT(shx_body_def, half_edges, 144);
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
AT(shx_body_def, friction, 280);
AT(shx_body_def, viscous_friction, 288);
AT(shx_body_def, group, 296);
AT(shx_body_def, mask, 300);
AT(shx_body_def, shape_of, 304);

SIZE(shx_contact_options, 72);
AT(shx_contact_options, struct_size, 0);
AT(shx_contact_options, model, 4);
AT(shx_contact_options, hair, 8);
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
AT(shx_contact, feature, 20);
AT(shx_contact, body, 24);
AT(shx_contact, other, 32);
AT(shx_contact, other_arclength, 40);
AT(shx_contact, position, 48);
AT(shx_contact, normal, 72);
AT(shx_contact, force, 96);
AT(shx_contact, slip, 120);
AT(shx_contact, gap, 144);

SIZE(shx_constraint_def, 120);
AT(shx_constraint_def, struct_size, 0);
AT(shx_constraint_def, hold, 4);
AT(shx_constraint_def, strand, 8);
AT(shx_constraint_def, arclength, 16);
AT(shx_constraint_def, other, 24);
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

int main(void) { return 0; }
