//! Contact of strands with bodies and with each other: detection, laws, solver, whole scenes.

mod at_points;
mod comb_through_rooted_hair;
mod contact_space_solver;
mod crowded_scene;
mod deforming_meshes;
mod delassus_operator;
mod determinism;
mod distance_grids;
mod drawn_grooms_at_rest;
mod friction_laws;
mod gentle_contact;
mod grooves;
mod hair_on_hair;
mod hair_pair_detection;
mod independent_cases;
mod independent_islands;
mod jumps_and_budgets;
mod moving_bodies;
mod near_without_touching;
mod nearest_points_of_shapes;
mod nowhere_to_go;
#[path = "../numbers/mod.rs"]
mod numbers;
mod out_of_reach;
mod penetration_tolerance;
mod pressed_along_itself;
mod random_bodies;
mod rest_slide_capstan;
mod roots_inside_bodies;
mod snapshots;
mod strands_against_bodies;
mod strands_that_leave;
mod swinging_tufts;
mod tied_wisps;
mod tip_in_a_crease;
mod tunnelling;
