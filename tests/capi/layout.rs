//! Rule 11: sizes and offsets of every structure of the C ABI, as Rust has them on a 64-bit machine; `tests/c/layout.c` asserts the
//! same numbers from C, and this test that it leaves none out.
#![cfg(target_pointer_width = "64")]

use std::mem::{offset_of, size_of};

use superhelix::internals::capi::base::types::{shx_body_id, shx_constraint_id, shx_frame, shx_input, shx_output, shx_strand_id};
use superhelix::internals::capi::groom::curve_data::shx_curve_data;
use superhelix::internals::capi::groom::fit::shx_polyline_fit;
use superhelix::internals::capi::groom::fit_curves::{shx_fit_input, shx_fit_options, shx_fitted_strand};
use superhelix::internals::capi::groom::friction_fit::{shx_fitted_coefficient, shx_friction_fit_def, shx_friction_fit_report};
use superhelix::internals::capi::groom::hair_handle::{shx_combing_result, shx_combing_test, shx_hair_handle};
use superhelix::internals::capi::groom::hair_type::{shx_hair_sliders, shx_hair_strand, shx_hair_strands_def, shx_hair_type};
use superhelix::internals::capi::groom::scalp::{shx_follicle, shx_scalp_def, shx_scatter_def};
use superhelix::internals::capi::groom::spline::shx_spline_def;
use superhelix::internals::capi::hair::materials::shx_material;
use superhelix::internals::capi::hair::settle::{shx_settle_def, shx_settle_report};
use superhelix::internals::capi::hair::strand_def::shx_strand_def;
use superhelix::internals::capi::hair::targets::shx_target_def;
use superhelix::internals::capi::hair::wisp::shx_wisp;
use superhelix::internals::capi::reading::debug_draw::{shx_debug_draw_def, shx_debug_vertex};
use superhelix::internals::capi::reading::sampling::shx_sample_def;
use superhelix::internals::capi::render::render_def::{shx_render_guides, shx_render_settings, shx_render_view};
use superhelix::internals::capi::scene::body_def::shx_body_def;
use superhelix::internals::capi::scene::constraints::{shx_constraint_def, shx_constraint_state};
use superhelix::internals::capi::scene::contact::{shx_contact_options, shx_strand_contact};
use superhelix::internals::capi::scene::contact_events::shx_contact_event;
use superhelix::internals::capi::scene::contacts::shx_contact;
use superhelix::internals::capi::scene::distance_grid::shx_distance_grid_def;
use superhelix::internals::capi::scene::push_out::shx_push_out_def;
use superhelix::internals::capi::simulation::settings::shx_settings;
use superhelix::internals::capi::simulation::solver_def::shx_solver_def;
use superhelix::internals::capi::simulation::solver_options::shx_solver_options;
use superhelix::internals::capi::simulation::state::{shx_restore_def, shx_snapshot_def};
use superhelix::internals::capi::simulation::step::shx_step_report;
use superhelix::internals::capi::simulation::step_limits::shx_step_limits;
use superhelix::internals::capi::simulation::suggest::{shx_suggest_def, shx_suggestion};
use superhelix::internals::capi::tools::haptic_def::{shx_haptic_def, shx_haptic_state};
use superhelix::internals::capi::tools::pose_def::{shx_brush, shx_element_change, shx_pose_options};
use superhelix::internals::capi::tools::ring_comb::{shx_ring_comb_def, shx_ring_comb_report};
use superhelix::internals::capi::tools::styling::{shx_clip_def, shx_cut, shx_heat_def};
use superhelix::internals::capi::tools::styling_tool::shx_tool_def;

/// The lines of layout.c for these structures, after their numbers have been compared with Rust's.
macro_rules! layouts {
    ($($name:ident: $size:literal { $($field:ident: $offset:literal),* $(,)? })*) => {{
        let mut lines = Vec::new();
        $(
            assert_eq!(size_of::<$name>(), $size, stringify!($name));
            lines.push(format!("SIZE({}, {});", stringify!($name), $size));
            $(
                assert_eq!(offset_of!($name, $field), $offset, "{}.{}", stringify!($name), stringify!($field));
                lines.push(format!("AT({}, {}, {});", stringify!($name), stringify!($field), $offset));
            )*
        )*
        lines
    }};
}

#[test]
fn every_size_and_offset_is_as_published() {
    let expected = layouts! {
        shx_solver_def: 184 { struct_size: 0, worker_count: 4, gravity: 8, wind: 32, parallel_for: 56, parallel_for_user: 64, log: 72, log_user: 80, log_level: 88, integrator: 92, linear_solver: 96, precision: 100, max_iterations: 104, exact_hessian: 108, tolerance: 112, max_subdivisions: 120, instruction_set: 124, error_tolerance: 128, reference_tolerance: 136, quadrature_tolerance: 144, jump_acceleration: 152, reserved: 160, user_data: 176 }
        shx_solver_options: 144 { struct_size: 0, integrator: 4, linear_solver: 8, precision: 12, max_iterations: 16, exact_hessian: 20, max_subdivisions: 24, instruction_set: 28, gravity: 32, wind: 56, tolerance: 80, error_tolerance: 88, reference_tolerance: 96, quadrature_tolerance: 104, jump_acceleration: 112, max_work: 120, max_seconds: 128, worker_count: 136, reserved0: 140 }
        shx_debug_vertex: 32 { position: 0, color: 24, layer: 28 }
        shx_debug_draw_def: 184 { struct_size: 0, layers: 4, points_per_strand: 8, reserved: 12, frame_length: 16, normal_length: 24, force_scale: 32, origin: 40, x_axis: 64, y_axis: 88, z_axis: 112, translation: 136, lines: 160, points: 168, user: 176 }
        shx_restore_def: 24 { struct_size: 0, options: 4, shapes: 8, shapes_size: 16 }
        shx_snapshot_def: 8 { struct_size: 0, shapes: 4 }
        shx_frame: 56 { origin: 0, rotation: 24 }
        shx_strand_def: 264 { struct_size: 0, element_count: 4, length: 8, element_lengths: 16, radius: 24, density: 40, youngs_modulus: 48, poisson_ratio: 56, internal_friction: 64, viscosity: 72, air_drag: 80, dofs: 88, reserved0: 92, root: 96, natural_curvatures: 152, user_data: 160, initial_curvatures: 168, initial_rates: 176, root_velocity: 184, root_angular_velocity: 208, reserved: 232 }
        shx_step_report: 208 { struct_size: 0, quarantined: 4, unconverged: 8, max_iterations: 12, max_residual: 16, kinetic_energy: 24, elastic_energy: 32, gravity_energy: 40, seconds: 48, substeps: 56, subdivided: 60, mean_iterations: 64, max_condition: 72, max_local_error: 80, contacts: 88, contact_searches: 92, max_contact_iterations: 96, unconverged_islands: 100, contact_sweeps: 104, max_contact_residual: 112, max_penetration: 120, max_constraint_error: 128, roots_inside_bodies: 136, stop_reason: 144, unfinished: 148, work: 152, jumped_roots: 160, fast_body_pieces: 164, capped_contact_forces: 168, search_seconds: 176, strand_seconds: 184, contact_seconds: 192, sampling_seconds: 200 }
        shx_step_limits: 32 { struct_size: 0, reserved0: 4, max_work: 8, max_seconds: 16, cancel: 24 }
        shx_strand_id: 8 { bits: 0 }
        shx_input: 32 { data: 0, stride: 8, count: 16, format: 24, reserved: 28 }
        shx_output: 32 { data: 0, stride: 8, count: 16, format: 24, reserved: 28 }
        shx_sample_def: 128 { struct_size: 0, points_per_strand: 4, origin: 8, x_axis: 32, y_axis: 56, z_axis: 80, translation: 104 }
        shx_settings: 64 { struct_size: 0, integrator: 4, max_iterations: 8, substeps: 12, element_count: 16, max_subdivisions: 20, tolerance: 24, error_tolerance: 32, rms_error: 40, cost: 48, quadrature_tolerance: 56 }
        shx_settle_def: 24 { struct_size: 0, max_steps: 4, tolerance: 8, check_stability: 16, reserved: 20 }
        shx_settle_report: 48 { struct_size: 0, unconverged: 4, unstable: 8, saddles: 12, iterations: 16, max_residual: 24, smallest_eigenvalue: 32, seconds: 40 }
        shx_suggest_def: 64 { struct_size: 0, max_elements: 4, tolerance: 8, gravity: 16, motion: 40, motion_count: 48, motion_interval: 56 }
        shx_suggestion: 40 { struct_size: 0, element_count: 4, meets_tolerance: 8, reserved: 12, rest_error: 16, motion_error: 24, max_turning_angle: 32 }
        shx_polyline_fit: 88 { struct_size: 0, reserved: 4, root: 8, length: 64, rms_error: 72, max_error: 80 }
        shx_fit_options: 120 { struct_size: 0, element_count: 4, tolerance: 8, length_mode: 16, twist: 20, min_length_ratio: 24, target_rms_error: 32, target_max_error: 40, noise: 48, frame_weight: 56, max_starts: 64, worker_count: 68, parallel_for: 72, parallel_for_user: 80, reserved: 88 }
        shx_fit_input: 168 { struct_size: 0, reserved0: 4, curve_count: 8, points: 16, point_counts: 48, arclengths: 56, widths: 64, frames: 72, roots: 104, reserved: 136 }
        shx_fitted_strand: 112 { result: 0, element_count: 4, root: 8, length: 64, rms_error: 72, max_error: 80, max_distance: 88, frame_error: 96, radius: 104 }
        shx_friction_fit_def: 256 { struct_size: 0, observable: 4, coefficients: 8, start: 12, direction: 16, internal_friction_range: 40, viscosity_range: 56, air_drag_range: 72, internal_friction_guess: 88, viscosity_guess: 96, air_drag_guess: 104, lead_in: 112, discard: 120, time_step: 128, grid_points: 136, fit_offset: 140, max_iterations: 144, reserved0: 148, oscillation_amplitude: 152, oscillation_frequency: 160, oscillation_phase: 168, oscillation_direction: 176, root_times: 200, root_frames: 208, root_count: 216, reserved: 224 }
        shx_fitted_coefficient: 48 { status: 0, reserved: 4, value: 8, standard_error: 16, step_sensitivity: 24, excluded_below: 32, excluded_above: 40 }
        shx_friction_fit_report: 200 { struct_size: 0, converged: 4, internal_friction: 8, viscosity: 56, air_drag: 104, rms_residual: 152, noise: 160, residual_correlation: 168, offset: 176, simulations: 184, unconverged: 188, first_compared: 192, compared: 196 }
        shx_body_id: 8 { bits: 0 }
        shx_constraint_id: 8 { bits: 0 }
        shx_body_def: 320 { struct_size: 0, shape: 4, pose: 8, radius: 64, a: 72, b: 96, semi_axes: 120, half_extents: 144, normal: 168, vertices: 192, triangles: 224, triangle_count: 232, sides: 240, reserved0: 244, depth: 248, grid: 256, grid_size: 264, thickness: 272, friction_scale: 280, viscous_friction_scale: 288, groups: 296, mask: 300, shape_of: 304, user_data: 312 }
        shx_contact_options: 72 { struct_size: 0, model: 4, hair_contact: 8, max_iterations: 12, max_sweeps: 16, reserved0: 20, stiffness: 24, damping: 32, regularisation_depth: 40, tolerance: 48, residual: 56, separation_speed: 64 }
        shx_strand_contact: 88 { struct_size: 0, groups: 4, mask: 8, reserved0: 12, radius: 16, wisp_radius: 24, friction_along: 32, friction_against: 40, hair_friction_along: 48, hair_friction_against: 56, viscous_friction_along: 64, viscous_friction_against: 72, exempt_length: 80 }
        shx_contact: 152 { strand: 0, arclength: 8, partner: 16, triangle: 20, body: 24, other_strand: 32, other_arclength: 40, position: 48, normal: 72, force: 96, slip: 120, gap: 144 }
        shx_contact_event: 128 { event: 0, partner: 4, strand: 8, arclength: 16, element: 24, triangle: 28, body: 32, other_strand: 40, other_arclength: 48, position: 56, normal: 80, force: 104 }
        shx_constraint_def: 128 { struct_size: 0, kind: 4, strand: 8, arclength: 16, other_strand: 24, other_arclength: 32, target: 40, friction_along: 96, friction_against: 104, compliance: 112, user_data: 120 }
        shx_constraint_state: 72 { status: 0, reserved: 4, arclength: 8, error: 16, force: 24, torque: 48 }
        shx_hair_type: 176 { struct_size: 0, curl: 4, mean_radius: 8, ellipticity: 16, helix_radius: 24, helix_pitch: 32, youngs_modulus: 40, poisson_ratio: 48, density: 56, internal_friction: 64, air_drag: 72, friction: 80, variation_between: 88, variation_along: 96, variation_thickness: 104, frizz: 112, variation_period: 120, root_turn: 128, seed: 136, reserved: 144 }
        shx_hair_sliders: 64 { struct_size: 0, reserved0: 4, curliness: 8, stiffness: 16, discipline: 24, weight: 32, combing_ease: 40, reserved: 48 }
        shx_hair_strand: 88 { radius: 0, density: 16, youngs_modulus: 24, poisson_ratio: 32, internal_friction: 40, viscosity: 48, air_drag: 56, root_turn: 64, friction_along: 72, friction_against: 80 }
        shx_curve_data: 184 { struct_size: 0, up_axis: 4, strand_count: 8, point_counts: 16, points: 24, velocities: 56, thickness: 88, transparency: 96, colors: 104, pinned: 112, strand_thickness: 120, strand_uvs: 128, metres_per_unit: 136, tfx_version: 144, reserved0: 148, reserved: 152 }
        shx_pose_options: 80 { struct_size: 0, keep_tip_direction: 4, avoid_bodies: 8, reserved0: 12, natural_pull: 16, clearance: 24, movable: 32, movable_count: 40, reserved: 48 }
        shx_brush: 88 { struct_size: 0, reserved0: 4, centre: 8, radius: 32, falloff: 40, displacement: 48, reserved: 72 }
        shx_element_change: 48 { struct_size: 0, element: 4, twist: 8, bend: 16, length_scale: 32, keep_curvature: 40, reserved: 44 }
        shx_material: 72 { struct_size: 0, reserved0: 4, radius: 8, density: 24, youngs_modulus: 32, poisson_ratio: 40, internal_friction: 48, viscosity: 56, air_drag: 64 }
        shx_wisp: 24 { struct_size: 0, reserved0: 4, hairs: 8, hold: 16 }
        shx_render_settings: 248 { struct_size: 0, points_per_strand: 4, interpolation: 8, guides_per_strand: 12, curliness: 16, measure_curliness: 24, wisps_per_guide: 28, max_tip_distance: 32, max_tip_ratio: 40, wisp_profile: 48, wisp_flatness: 72, wisp_noise: 80, wisp_noise_waves: 88, frizz: 96, frizz_waves: 104, flyaway_fraction: 112, flyaway_distance: 120, length_variation: 128, radius: 136, tip_radius: 144, taper_start: 152, taper_shape: 160, radius_variation: 168, body_clearance: 176, seed: 184, preserve_length: 192, worker_count: 196, parallel_for: 200, parallel_for_user: 208, reserved: 216 }
        shx_render_guides: 184 { struct_size: 0, reserved0: 4, guide_count: 8, points: 16, point_counts: 48, roots: 56, velocities: 88, root_angular_velocities: 120, reserved: 152 }
        shx_render_view: 256 { struct_size: 0, reserved0: 4, first_strand: 8, strand_count: 16, origin: 24, previous_pose: 48, interval: 56, roots: 64, previous_roots: 96, reserved: 128, x_axis: 160, y_axis: 184, z_axis: 208, translation: 232 }
        shx_follicle: 24 { triangle: 0, reserved: 4, barycentric: 8 }
        shx_scalp_def: 120 { struct_size: 0, reserved0: 4, vertices: 8, triangles: 40, triangle_count: 48, uvs: 56, reference_axis: 64, reserved: 88 }
        shx_scatter_def: 128 { struct_size: 0, reserved0: 4, count: 8, spacing: 16, density: 24, density_width: 32, density_height: 40, seed: 48, guide_roots: 56, max_guide_distance: 88, reserved: 96 }
        shx_distance_grid_def: 72 { struct_size: 0, reserved0: 4, vertices: 8, triangles: 40, triangle_count: 48, cell: 56, band: 64 }
        shx_hair_strands_def: 56 { struct_size: 0, reserved0: 4, hair_type: 8, sliders: 16, first_strand: 24, strand_count: 32, element_counts: 40, element_lengths: 48 }
        shx_push_out_def: 40 { struct_size: 0, reserved0: 4, body: 8, clearance: 16, point_counts: 24, curve_count: 32 }
        shx_target_def: 128 {
            struct_size: 0, weight_count: 4, curve_count: 8, points: 16, point_counts: 48, arclengths: 56, weight_positions: 64, weights: 72,
            strand_weights: 80, time_constant: 88, reserved: 96,
        }
        shx_spline_def: 48 { struct_size: 0, kind: 4, ends: 8, points_per_span: 12, controls: 16 }
        shx_haptic_def: 200 { struct_size: 0, mode: 4, handle: 8, stiffness: 64, damping: 72, angular_stiffness: 80, angular_damping: 88, max_force: 96, max_torque: 104, max_force_rate: 112, max_torque_rate: 120, energy_allowance: 128, max_energy_credit: 136, max_acceleration: 144, max_angular_acceleration: 152, max_model_age: 160, max_contacts: 168, max_sweeps: 172, force_law: 176, reserved0: 180, explicit_time: 184, explicit_friction: 192 }
        shx_haptic_state: 176 { struct_size: 0, limits: 4, proxy: 8, contact_force: 64, contact_torque: 88, energy_given: 112, energy_received: 120, max_energy_excess: 128, model_age: 136, model_count: 144, contacts: 152, pressing: 156, left_out: 160, sweeps: 164, residual: 168 }
        shx_hair_handle: 64 { struct_size: 0, reserved0: 4, major_diameter: 8, ellipticity: 16, natural_twist: 24, natural_curvature: 32, bending_stiffness: 40, frictional_force: 48, internal_friction: 56 }
        shx_combing_test: 48 { struct_size: 0, strand_count: 4, element_count: 8, reserved0: 12, length: 16, stroke: 24, speed: 32, rate: 40 }
        shx_combing_result: 40 { step_count: 0, mean_force: 8, mean_pressure: 16, friction: 24, work: 32 }
        shx_tool_def: 64 { struct_size: 0, kind: 4, tooth_count: 8, row_count: 12, spacing: 16, row_spacing: 24, length: 32, radius: 40, width: 48, thickness: 56 }
        shx_clip_def: 96 { struct_size: 0, kind: 4, pose: 8, half_edges: 64, compliance: 88 }
        shx_cut: 56 { strand: 0, length: 8, removed: 16, position: 24, removed_constraints: 48 }
        shx_heat_def: 96 { struct_size: 0, shape: 4, pose: 8, half_edges: 64, rate: 88 }
        shx_ring_comb_def: 32 { struct_size: 0, reserved0: 4, friction: 8, max_force: 16, exempt_length: 24 }
        shx_ring_comb_report: 64 { held: 0, caught: 4, combed: 8, let_go: 12, force: 16, torque: 40 }
    };
    let program = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/c/layout.c")).expect("layout.c");
    let asserted: Vec<&str> = program.lines().filter(|line| line.starts_with("SIZE(") || line.starts_with("AT(")).collect();
    assert_eq!(asserted, expected);
}

#[test]
fn every_structure_of_the_header_is_asserted() {
    let header = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/include/superhelix.h")).expect("the header");
    let program = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/c/layout.c")).expect("layout.c");
    for line in header.lines().filter(|line| line.starts_with("typedef struct ") && line.ends_with('{')) {
        let name = line.split_whitespace().nth(2).expect("a name");
        assert!(program.contains(&format!("SIZE({name},")), "{name} is not in layout.c");
        let (_, rest) = header.split_once(line).expect("the structure");
        let (fields, _) = rest.split_once("\n}").expect("its end");
        for field in fields.lines().map(str::trim).filter(|field| field.ends_with(';') && !field.starts_with("//")) {
            let field = field.trim_end_matches(';').split('[').next().expect("a declaration");
            let field = field.rsplit([' ', '*']).next().expect("a name");
            assert!(program.contains(&format!("AT({name}, {field},")), "{name}.{field} is not in layout.c");
        }
    }
}
