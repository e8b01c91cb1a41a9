// Generated from bindings/api.json by bindings/csharp/generate.py: do not edit.
#pragma warning disable 169, 649
using System;
using System.Runtime.InteropServices;

namespace Superhelix
{
  internal static unsafe partial class Native
  {
    internal const uint AbiVersion = 2;

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern uint shx_version();

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern uint shx_abi_version();

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern IntPtr shx_build_info();

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern IntPtr shx_result_name(int result);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern UIntPtr shx_last_error(byte* buffer, UIntPtr capacity);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_set_allocator(IntPtr alloc, IntPtr free, void* user);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_def_init(SolverDefRaw* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_create(SolverDefRaw* @def, IntPtr* out_solver);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern void shx_solver_destroy(IntPtr solver);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_get_own_user_data(SolverHandle solver, ulong* out_user_data);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_own_user_data(SolverHandle solver, ulong user_data);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_gravity(SolverHandle solver, double* gravity);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_wind(SolverHandle solver, double* wind);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_memory_usage(SolverHandle solver, ulong* out_bytes);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_options_init(SolverOptions* options, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_get_options(SolverHandle solver, SolverOptions* out_options);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_options(SolverHandle solver, SolverOptions* options);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_step_limits_init(StepLimitsRaw* limits, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_step_report_init(StepReport* report, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_step(SolverHandle solver, double dt, uint substeps, StepReport* report);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_step_with_limits(SolverHandle solver, double dt, uint substeps, StepLimitsRaw* limits, StepReport* report);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_wind_field(SolverHandle solver, IntPtr function, void* user);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_strand_def_init(StrandDefRaw* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_add_strands(SolverHandle solver, StrandDefRaw* defs, UIntPtr def_stride, UIntPtr count, StrandId* out_ids);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_remove_strands(SolverHandle solver, StrandId* ids, UIntPtr count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern byte shx_solver_has_strand(SolverHandle solver, StrandId id);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_strand_count(SolverHandle solver, UIntPtr* out_count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_strand_ids(SolverHandle solver, StrandId* out_ids, UIntPtr capacity);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_get_element_count(SolverHandle solver, StrandId id, UIntPtr* out_count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_get_element_lengths(SolverHandle solver, StrandId id, double* out_lengths, UIntPtr capacity);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_strand_lengths(SolverHandle solver, StrandId* ids, UIntPtr count, double* out_lengths);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_get_user_data(SolverHandle solver, StrandId id, ulong* out_user_data);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_strand_status(SolverHandle solver, StrandId* ids, UIntPtr count, StrandStatus* out_status);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_strand_iterations(SolverHandle solver, StrandId* ids, UIntPtr count, uint* out_iterations);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_strand_quadrature(SolverHandle solver, StrandId* ids, UIntPtr count, uint* out_points, double* out_errors);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_strand_turning_angles(SolverHandle solver, StrandId* ids, UIntPtr count, double* out_turns);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_strand_energies(SolverHandle solver, StrandId* ids, UIntPtr count, double* out_kinetic, double* out_elastic, double* out_gravity);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_reset_strands(SolverHandle solver, StrandId* ids, UIntPtr count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_root_frames(SolverHandle solver, StrandId* ids, UIntPtr count, RawView* frames, double over_seconds);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_teleport_roots(SolverHandle solver, StrandId* ids, UIntPtr count, RawView* frames);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_get_root_frames(SolverHandle solver, StrandId* ids, UIntPtr count, RawView* frames);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_sample_motion(double* pose_times, RawView* poses, double* times, UIntPtr count, RawView* frames, RawView* velocities, RawView* angular_velocities);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_target_def_init(TargetDefRaw* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_targets(SolverHandle solver, StrandId* ids, UIntPtr count, TargetDefRaw* @def, double over_seconds);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_clear_targets(SolverHandle solver, StrandId* ids, UIntPtr count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_target_distances(SolverHandle solver, StrandId* ids, UIntPtr count, double* out_distances);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_natural_curvatures(SolverHandle solver, StrandId id, double* curvatures, UIntPtr count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_get_natural_curvatures(SolverHandle solver, StrandId id, double* out_curvatures, UIntPtr count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_get_curvatures(SolverHandle solver, StrandId id, double* out_curvatures, double* out_rates, UIntPtr count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_curvatures(SolverHandle solver, StrandId id, double* curvatures, double* rates, UIntPtr count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_element_count(SolverHandle solver, StrandId* ids, UIntPtr count, uint element_count, double* out_distances);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_element_lengths(SolverHandle solver, StrandId id, double* lengths, UIntPtr count, double* out_distance);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_settle_def_init(SettleDef* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_settle_report_init(SettleReport* report, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_settle(SolverHandle solver, StrandId* ids, UIntPtr count, SettleDef* @def, SettleReport* report, StrandStatus* out_status, double* out_eigenvalues, double* out_residuals);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_adopt_natural_shapes(SolverHandle solver, StrandId* ids, UIntPtr count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_adopt_rest_shapes(SolverHandle solver, StrandId* ids, UIntPtr count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_shape_stability(SolverHandle solver, StrandId* ids, UIntPtr count, double margin, double* out_eigenvalues, double* out_youngs_scales, double* out_radius_scales);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_stiffen_strands(SolverHandle solver, StrandId* ids, UIntPtr count, uint by, double margin, double* out_scales);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_get_shapes(SolverHandle solver, StrandId* ids, UIntPtr count, double* out_curvatures, UIntPtr capacity);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_shapes(SolverHandle solver, StrandId* ids, UIntPtr count, double* curvatures, UIntPtr row_count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_material_init(Material* material, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_materials(SolverHandle solver, StrandId* ids, UIntPtr count, Material* defs, UIntPtr def_stride, UIntPtr def_count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_get_material(SolverHandle solver, StrandId id, Material* out_material);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_wisp_init(Wisp* wisp, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_wisp_material(Wisp* wisp, Material* hair, Material* out_material, double* out_radius, double* out_margin);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_pose_options_init(PoseOptionsRaw* options, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_brush_init(Brush* brush, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_element_change_init(ElementChange* change, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_drag_strands(SolverHandle solver, StrandId* ids, UIntPtr count, double* arclengths, RawView* targets, PoseOptionsRaw* options, double* out_distances);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_brush_strands(SolverHandle solver, StrandId* ids, UIntPtr count, Brush* brush, PoseOptionsRaw* options, byte* out_brushed, double* out_distances);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_change_elements(SolverHandle solver, StrandId* ids, UIntPtr count, ElementChange* defs, UIntPtr def_stride);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_cut_strands(SolverHandle solver, StrandId* ids, UIntPtr count, double* arclengths);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_grow_strands(SolverHandle solver, StrandId* ids, UIntPtr count, double length, uint element_count, double* curvatures);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_mirror_strands(SolverHandle solver, StrandId* ids, UIntPtr count, double* point, double* normal, StrandId* out_ids);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_sample_def_init(SampleDef* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_sample_strands(SolverHandle solver, StrandId* ids, UIntPtr count, SampleDef* @def, RawView* points, RawView* frames, RawView* velocities);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_sample_at(SolverHandle solver, StrandId id, double* arclengths, UIntPtr count, double* origin, RawView* points, RawView* frames, RawView* velocities);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_sample_at_with(SolverHandle solver, StrandId id, double* arclengths, UIntPtr count, SampleDef* @def, RawView* points, RawView* frames, RawView* velocities);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_root_wrenches(SolverHandle solver, StrandId* ids, UIntPtr count, RawView* forces, RawView* torques);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_body_def_init(BodyDefRaw* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_add_bodies(SolverHandle solver, BodyDefRaw* defs, UIntPtr def_stride, UIntPtr count, BodyId* out_ids);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_remove_bodies(SolverHandle solver, BodyId* ids, UIntPtr count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern byte shx_solver_has_body(SolverHandle solver, BodyId id);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_get_body_user_data(SolverHandle solver, BodyId id, ulong* out_user_data);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_body_count(SolverHandle solver, UIntPtr* out_count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_body_ids(SolverHandle solver, BodyId* out_ids, UIntPtr capacity);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_body_frames(SolverHandle solver, BodyId* ids, UIntPtr count, RawView* frames, double over_seconds);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_teleport_bodies(SolverHandle solver, BodyId* ids, UIntPtr count, RawView* frames);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_get_body_frames(SolverHandle solver, BodyId* ids, UIntPtr count, RawView* frames);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_body_vertices(SolverHandle solver, BodyId id, RawView* vertices, double over_seconds);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_body_surface(SolverHandle solver, BodyId id, double thickness, double friction_scale, double viscous_friction_scale);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_body_filter(SolverHandle solver, BodyId id, uint groups, uint mask);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_body_wrenches(SolverHandle solver, BodyId* ids, UIntPtr count, RawView* forces, RawView* torques);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_distance_grid_def_init(DistanceGridDefRaw* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_distance_grid_bake(DistanceGridDefRaw* @def, void* out_grid, UIntPtr capacity, UIntPtr* out_size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_contact_options_init(ContactOptions* options, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_contact_options(SolverHandle solver, ContactOptions* options);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_get_contact_options(SolverHandle solver, ContactOptions* out_options);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_strand_contact_init(StrandContact* contact, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_strand_contact(SolverHandle solver, StrandId* ids, UIntPtr count, StrandContact* contacts, UIntPtr contact_stride);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_get_strand_contact(SolverHandle solver, StrandId id, StrandContact* out_contact, uint* out_enabled);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_contact_count(SolverHandle solver, UIntPtr* out_count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_contacts(SolverHandle solver, Contact* out_contacts, UIntPtr stride, UIntPtr capacity, UIntPtr* out_count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_keep_contact_events(SolverHandle solver, UIntPtr capacity);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_drain_contact_events(SolverHandle solver, ContactEvent* out_events, UIntPtr stride, UIntPtr capacity, UIntPtr* out_count, ulong* out_lost);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_overlaps(SolverHandle solver, StrandId* ids, UIntPtr count, double* out_hair_depths, StrandId* out_strands, double* out_body_depths, BodyId* out_bodies);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_permit_overlaps(SolverHandle solver, StrandId* ids, UIntPtr count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_permitted_overlap(SolverHandle solver, StrandId id, double* arclengths, double* wisp_fractions, double* body_depths, UIntPtr count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_get_permitted_overlap(SolverHandle solver, StrandId id, double* out_arclengths, double* out_wisp_fractions, double* out_body_depths, UIntPtr capacity, UIntPtr* out_count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_push_out_def_init(PushOutDefRaw* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_push_out_curves(SolverHandle solver, PushOutDefRaw* @def, double* points, double* out_depths, double* out_displacements, uint* out_stuck);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_constraint_def_init(ConstraintDef* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_add_constraints(SolverHandle solver, ConstraintDef* defs, UIntPtr def_stride, UIntPtr count, ConstraintId* out_ids);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_remove_constraints(SolverHandle solver, ConstraintId* ids, UIntPtr count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern byte shx_solver_has_constraint(SolverHandle solver, ConstraintId id);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_get_constraint_user_data(SolverHandle solver, ConstraintId id, ulong* out_user_data);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_constraint_count(SolverHandle solver, UIntPtr* out_count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_constraint_ids(SolverHandle solver, ConstraintId* out_ids, UIntPtr capacity);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_constraint_targets(SolverHandle solver, ConstraintId* ids, UIntPtr count, RawView* frames, double over_seconds);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_get_constraint_targets(SolverHandle solver, ConstraintId* ids, UIntPtr count, RawView* frames);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_constraint_states(SolverHandle solver, ConstraintId* ids, UIntPtr count, ConstraintState* out_states, UIntPtr stride);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_attachment_create(SolverHandle solver, Frame* pose, StrandId* strand_ids, UIntPtr strand_count, BodyId* body_ids, UIntPtr body_count, ConstraintId* constraint_ids, UIntPtr constraint_count, IntPtr* out_attachment);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_attachment_move(AttachmentHandle attachment, SolverHandle solver, Frame* pose, double over_seconds);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_attachment_teleport(AttachmentHandle attachment, SolverHandle solver, Frame* pose);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern void shx_attachment_destroy(IntPtr attachment);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_haptic_def_init(HapticDef* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_haptic_state_init(HapticState* state, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_haptic_create(SolverHandle solver, HapticDef* @def, BodyId* bodies, UIntPtr count, IntPtr* out_haptic);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern void shx_haptic_destroy(IntPtr haptic);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_haptic_before_step(HapticHandle haptic, SolverHandle solver, double dt);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_haptic_after_step(HapticHandle haptic, SolverHandle solver);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_haptic_update(HapticHandle haptic, Frame* pose, double* velocity, double dt, double* out_wrench, HapticState* state);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_tool_def_init(ToolDef* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_tool_frames(ToolDef* @def, Frame* frame, double opening, Frame* out_frames, UIntPtr capacity, UIntPtr* out_count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_tool_hot_box(ToolDef* @def, double opening, double* out_half_edges);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_add_tool(SolverHandle solver, ToolDef* @def, Frame* frame, double opening, BodyId* out_ids, UIntPtr capacity, UIntPtr* out_count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_clip_def_init(ClipDef* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_clip_strands(SolverHandle solver, ClipDef* @def, StrandId* ids, UIntPtr count, ConstraintId* out_ids, UIntPtr capacity, UIntPtr* out_count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_move_constraints(SolverHandle solver, ConstraintId* ids, UIntPtr count, Frame* from, Frame* to, double over_seconds);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_scissor_strands(SolverHandle solver, StrandId* ids, UIntPtr count, double* corners, double min_length, Cut* out_cuts, UIntPtr* out_count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_heat_def_init(HeatDef* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_heat_strands(SolverHandle solver, HeatDef* @def, StrandId* ids, UIntPtr count, double seconds, double* out_heated);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_freeze_strands(SolverHandle solver, StrandId* ids, UIntPtr count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_wake_strands(SolverHandle solver, StrandId* ids, UIntPtr count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_frozen_strands(SolverHandle solver, StrandId* ids, UIntPtr count, byte* out_frozen);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_ring_comb_def_init(RingCombDef* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_ring_comb_create(ToolDef* tool, Frame* frame, RingCombDef* @def, IntPtr* out_comb);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern void shx_ring_comb_destroy(IntPtr comb);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_ring_comb_before_step(RingCombHandle comb, SolverHandle solver, StrandId* ids, UIntPtr count, Frame* frame, double dt);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_ring_comb_after_step(RingCombHandle comb, SolverHandle solver, RingCombReport* out_report);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_ring_comb_release(RingCombHandle comb, SolverHandle solver);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_haptic_add_ring_comb(HapticHandle haptic, SolverHandle solver, ToolDef* tool, Frame* frame, RingCombDef* @def, StrandId* ids, UIntPtr count, UIntPtr* out_index);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_haptic_ring_comb_report(HapticHandle haptic, UIntPtr index, RingCombReport* out_report);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_haptic_ring_comb_frame(HapticHandle haptic, UIntPtr index, Frame* out_frame);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_haptic_release_ring_combs(HapticHandle haptic, SolverHandle solver);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_snapshot(SolverHandle solver, void* out_image, UIntPtr capacity, UIntPtr* out_size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_snapshot_def_init(SnapshotDef* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_snapshot_with(SolverHandle solver, SnapshotDef* @def, void* out_image, UIntPtr capacity, UIntPtr* out_size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_snapshot_shapes(SolverHandle solver, void* out_image, UIntPtr capacity, UIntPtr* out_size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_restore(SolverHandle solver, void* image, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_restore_def_init(RestoreDefRaw* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_restore_with(SolverHandle solver, void* image, UIntPtr size, RestoreDefRaw* @def);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_state_hash(SolverHandle solver, ulong* out_hash);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_debug_draw_def_init(DebugDrawDefRaw* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_debug_draw(SolverHandle solver, DebugDrawDefRaw* @def);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_polyline_fit_init(PolylineFit* fit, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_fit_polyline(RawView* polyline, uint element_count, PolylineFit* out_fit, double* out_element_lengths, double* out_curvatures, UIntPtr capacity);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_sag_free_curvatures(StrandDefRaw* @def, double* curvatures, UIntPtr count, double* gravity, double* out_natural);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_fit_options_init(FitOptionsRaw* options, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_fit_input_init(FitInputRaw* curves, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_fit_strands(FitOptionsRaw* options, FitInputRaw* curves, FittedStrand* out_strands, UIntPtr stride, double* out_element_lengths, double* out_curvatures, UIntPtr capacity);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_strand_def_set_fit(StrandDefRaw* @def, FittedStrand* fitted, double* element_lengths, double* curvatures);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_spline_def_init(SplineDefRaw* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_spline_points(SplineDefRaw* @def, RawView* points, double* out_arclengths, UIntPtr* out_count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_settings_init(Settings* settings, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_settings_from_preset(uint preset, double curvature, double length, double frame_time, Settings* out_settings);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_settings_suggest(double target_error, double curvature, double length, double frame_time, Settings* out_settings);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_suggest_def_init(SuggestDefRaw* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_suggestion_init(Suggestion* suggestion, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_suggest_elements(StrandDefRaw* strand, SuggestDefRaw* demand, Suggestion* out_suggestion);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_friction_fit_def_init(FrictionFitDefRaw* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_friction_fit_report_init(FrictionFitReport* report, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_fit_friction(SolverDefRaw* solver, StrandDefRaw* strand, FrictionFitDefRaw* friction, double* times, double* values, UIntPtr count, FrictionFitReport* out_report, double* out_curve);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_curves_read(byte* path, IntPtr* out_curves);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern void shx_curves_destroy(IntPtr curves);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_curves_count(CurvesHandle curves, UIntPtr* out_strands, UIntPtr* out_points);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_curves_point_counts(CurvesHandle curves, uint* out_counts, UIntPtr capacity);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_curves_points(CurvesHandle curves, UIntPtr first_strand, UIntPtr strand_count, double scale, RawView* points);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_curves_write_points(byte* path, RawView* points, uint* point_counts, UIntPtr strand_count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_curve_data_init(CurveDataRaw* data, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_curve_data_write(byte* path, CurveDataRaw* data);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_curves_attribute(CurvesHandle curves, uint attribute, float* out_values, UIntPtr capacity, UIntPtr* out_count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_curves_units(CurvesHandle curves, double* out_metres_per_unit, uint* out_up_axis);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_curve_cache_read(byte* path, IntPtr* out_cache);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern void shx_curve_cache_destroy(IntPtr cache);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_curve_cache_times(CurveCacheHandle cache, double* out_times, UIntPtr capacity, UIntPtr* out_count);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_curve_cache_sample(CurveCacheHandle cache, double time, IntPtr* out_curves);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_curve_cache_writer_create(byte* path, CurveDataRaw* first, double frames_per_second, IntPtr* out_writer);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_curve_cache_writer_write(CurveCacheWriterHandle writer, double time, RawView* points, RawView* velocities);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_curve_cache_writer_finish(IntPtr writer);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern void shx_curve_cache_writer_abandon(IntPtr writer);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_hair_type_init(HairType* hair, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_hair_sliders_init(HairSliders* sliders, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_hair_type_from_name(byte* name, HairType* out_hair);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_hair_strands_def_init(HairStrandsDefRaw* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_hair_strands(HairStrandsDefRaw* @def, HairStrand* out_strands, UIntPtr stride, double* out_curvatures, UIntPtr capacity);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_hair_handle_init(HairHandle* handle, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_hair_handle_from_name(byte* name, HairHandle* out_handle);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_hair_handle_adjust(HairHandle* handle, double curliness, double combing_ease, HairHandle* out_handle);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_hair_handle_to_type(HairHandle* handle, HairType* out_hair);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_combing_test_init(CombingTest* test, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_combing_test_run(CombingTest* test, HairHandle* handle, double* out_stroke, double* out_force, double* out_pressure, UIntPtr capacity, CombingResult* out_result);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_scalp_def_init(ScalpDefRaw* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_scatter_def_init(ScatterDefRaw* @def, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_scalp_create(ScalpDefRaw* @def, IntPtr* out_scalp);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern void shx_scalp_destroy(IntPtr scalp);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_scalp_scatter(ScalpHandle scalp, ScatterDefRaw* @def, Follicle* out_follicles, UIntPtr capacity, UIntPtr* out_count, double* out_min_distance);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_scalp_follicles_at_uvs(ScalpHandle scalp, double* uvs, UIntPtr count, double jitter, ulong seed, Follicle* out_follicles);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_scalp_root_frames(ScalpHandle scalp, RawView* vertices, Follicle* follicles, UIntPtr count, RawView* frames);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_render_settings_init(RenderSettingsRaw* settings, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_render_guides_init(RenderGuidesRaw* guides, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_render_view_init(RenderViewRaw* view, UIntPtr size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_render_hair_create(RenderSettingsRaw* settings, RenderGuidesRaw* guides, RawView* roots, IntPtr* out_hair);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_create_render_hair(SolverHandle solver, StrandId* ids, UIntPtr count, RenderSettingsRaw* settings, RawView* roots, IntPtr* out_hair);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_render_hair_save(RenderHairHandle hair, void* out_image, UIntPtr capacity, UIntPtr* out_size);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_render_hair_load(void* image, UIntPtr size, RenderSettingsRaw* settings, IntPtr* out_hair);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_render_hair_without_guides(RenderHairHandle hair, uint* removed, UIntPtr count, IntPtr* out_hair);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_render_hair_with_own_shapes(RenderHairHandle hair, RawView* points, uint* point_counts, UIntPtr count, IntPtr* out_hair);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern void shx_render_hair_destroy(IntPtr hair);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_render_hair_wisps(RenderHairHandle hair, UIntPtr first, UIntPtr count, uint* out_guides, uint* out_wisps);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_render_pose_create(RenderHairHandle hair, IntPtr* out_pose);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern void shx_render_pose_destroy(IntPtr pose);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_render_pose_set_guides(RenderPoseHandle pose, RenderGuidesRaw* guides);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_set_render_pose(SolverHandle solver, StrandId* ids, UIntPtr count, uint velocities, RenderPoseHandle pose);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_render_pose_evaluate(RenderPoseHandle pose, RenderViewRaw* view, RawView* points, RawView* frames, RawView* velocities);

    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
    internal static extern int shx_solver_evaluate_render_pose(SolverHandle solver, RenderPoseHandle pose, RenderViewRaw* view, RawView* points, RawView* frames, RawView* velocities);
  }
}
