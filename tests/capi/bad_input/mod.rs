//! Rules 2, 4 and 5 of the C ABI: every argument of every exported function with everything that can be wrong with it. Each call must
//! give its code and a text that names the argument, write no output, and leave the solver's state as it was.
#![allow(unsafe_code, clippy::macro_metavars_in_unsafe)] // the table is made of C calls

mod attachment;
mod bodies;
mod constraints;
mod contact;
mod curve_cache;
mod curve_data;
mod curves;
mod definitions;
mod fit;
mod fit_curves;
mod friction_fit;
mod hair;
mod haptic;
mod hooks;
mod level_of_detail;
mod motion;
mod overlaps;
mod posing;
mod render_hair;
mod restyling;
mod roots;
mod sampling;
mod scalp;
mod scene;
mod settings;
mod settle;
mod shape;
mod solver;
mod solver_options;
mod state;
mod strands;
mod styling;
mod suggest;
mod targets;
mod wisp;

use std::collections::BTreeSet;
use std::ptr::{null, null_mut};

use scene::{Scene, UNTOUCHED, strand};
use superhelix::internals::capi::base::errors::*;
use superhelix::internals::capi::base::guard::shx_solver;
use superhelix::internals::capi::base::types::*;
use superhelix::internals::capi::groom::curve_cache::*;
use superhelix::internals::capi::groom::curve_data::*;
use superhelix::internals::capi::groom::curves::*;
use superhelix::internals::capi::groom::fit::*;
use superhelix::internals::capi::groom::fit_curves::*;
use superhelix::internals::capi::groom::friction_fit::*;
use superhelix::internals::capi::groom::hair_handle::*;
use superhelix::internals::capi::groom::hair_type::*;
use superhelix::internals::capi::groom::spline::*;
use superhelix::internals::capi::hair::level_of_detail::*;
use superhelix::internals::capi::hair::materials::*;
use superhelix::internals::capi::hair::motion::*;
use superhelix::internals::capi::hair::restyling::*;
use superhelix::internals::capi::hair::roots::*;
use superhelix::internals::capi::hair::settle::*;
use superhelix::internals::capi::hair::shape::*;
use superhelix::internals::capi::hair::strand_def::*;
use superhelix::internals::capi::hair::strands::*;
use superhelix::internals::capi::hair::targets::*;
use superhelix::internals::capi::hair::wisp::*;
use superhelix::internals::capi::reading::sampling::*;
use superhelix::internals::capi::scene::attachment::*;
use superhelix::internals::capi::scene::bodies::*;
use superhelix::internals::capi::scene::body_def::*;
use superhelix::internals::capi::scene::constraints::*;
use superhelix::internals::capi::scene::contact::*;
use superhelix::internals::capi::scene::contact_events::*;
use superhelix::internals::capi::scene::contacts::*;
use superhelix::internals::capi::scene::distance_grid::*;
use superhelix::internals::capi::scene::overlaps::*;
use superhelix::internals::capi::scene::push_out::*;
use superhelix::internals::capi::simulation::settings::*;
use superhelix::internals::capi::simulation::solver::*;
use superhelix::internals::capi::simulation::solver_def::*;
use superhelix::internals::capi::simulation::solver_options::*;
use superhelix::internals::capi::simulation::state::*;
use superhelix::internals::capi::simulation::step::*;
use superhelix::internals::capi::simulation::step_limits::*;
use superhelix::internals::capi::simulation::suggest::*;
use superhelix::internals::capi::tools::haptic::*;
use superhelix::internals::capi::tools::haptic_def::*;
use superhelix::internals::capi::tools::haptic_ring_comb::*;
use superhelix::internals::capi::tools::pose_def::*;
use superhelix::internals::capi::tools::posing::*;
use superhelix::internals::capi::tools::ring_comb::*;
use superhelix::internals::capi::tools::styling::*;
use superhelix::internals::capi::tools::styling_tool::*;

/// One line of the table.
pub struct Case {
    function: &'static str,
    argument: &'static str,
    what: &'static str,
    expected: shx_result,
    call: fn(&mut Scene) -> shx_result,
}

/// A line: the call may use the scene as `s`.
macro_rules! case {
    ($cases:ident, $function:literal, $argument:literal, $what:literal, $expected:ident, |$s:ident| $call:expr) => {
        $cases.push(Case {
            function: $function,
            argument: $argument,
            what: $what,
            expected: $expected,
            // SAFETY: what is wrong with a call is something that the library promises to find.
            call: |$s: &mut Scene| {
                let _ = &$s;
                #[allow(unused_unsafe)] // a few of the functions are safe
                unsafe {
                    $call
                }
            },
        });
    };
}
pub(crate) use case;

fn solver_def() -> shx_solver_def {
    let mut def = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one definition, which the call fills.
    unsafe {
        assert_eq!(shx_solver_def_init(def.as_mut_ptr(), size_of::<shx_solver_def>()), SHX_OK);
        def.assume_init()
    }
}

/// Three points a strand: six for the two strands of the scene.
fn sample_def() -> shx_sample_def {
    let mut def = std::mem::MaybeUninit::<shx_sample_def>::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(shx_sample_def_init(def.as_mut_ptr(), size_of::<shx_sample_def>()), SHX_OK);
        shx_sample_def { points_per_strand: 3, ..def.assume_init() }
    }
}

fn new_fit() -> shx_polyline_fit {
    let mut fit = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(shx_polyline_fit_init(fit.as_mut_ptr(), size_of::<shx_polyline_fit>()), SHX_OK);
        fit.assume_init()
    }
}

fn new_settings() -> shx_settings {
    let mut settings = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(shx_settings_init(settings.as_mut_ptr(), size_of::<shx_settings>()), SHX_OK);
        settings.assume_init()
    }
}

/// Restores every truncation of a real image and the image with each byte damaged in turn; gives SHX_ERROR_SNAPSHOT when all of them
/// were refused, the first other result otherwise.
fn damaged_images(s: &mut Scene) -> shx_result {
    let mut size = 0;
    // SAFETY: the size of an image, then room for it, then parts of it.
    unsafe {
        assert_eq!(shx_solver_snapshot(s.solver, null_mut(), 0, &raw mut size), SHX_OK);
        let mut image = vec![0_u8; size];
        assert_eq!(shx_solver_snapshot(s.solver, image.as_mut_ptr().cast(), size, &raw mut size), SHX_OK);
        for length in 0..size {
            let result = shx_solver_restore(s.solver, image.as_ptr().cast(), length);
            if result != SHX_ERROR_SNAPSHOT {
                return result;
            }
        }
        for byte in 0..size {
            image[byte] ^= 0x10;
            let result = shx_solver_restore(s.solver, image.as_ptr().cast(), size);
            if result != SHX_ERROR_SNAPSHOT {
                return result;
            }
            image[byte] ^= 0x10;
        }
    }
    SHX_ERROR_SNAPSHOT
}

fn table() -> Vec<Case> {
    let mut cases = Vec::new();
    for add in [
        definitions::cases,
        solver::cases,
        solver_options::cases,
        state::cases,
        strands::cases,
        roots::cases,
        motion::cases,
        targets::cases,
        shape::cases,
        settle::cases,
        restyling::cases,
        posing::cases,
        wisp::cases,
        level_of_detail::cases,
        suggest::cases,
        sampling::cases,
        attachment::cases,
        bodies::cases,
        contact::cases,
        overlaps::cases,
        constraints::cases,
        fit::cases,
        fit_curves::cases,
        settings::cases,
        friction_fit::cases,
        curves::cases,
        curve_data::cases,
        curve_cache::cases,
        hair::cases,
        haptic::cases,
        hooks::cases,
        styling::cases,
        render_hair::cases,
        scalp::cases,
    ] {
        add(&mut cases);
    }
    cases
}

fn last_error() -> String {
    let mut text = [0_u8; 2048];
    // SAFETY: room for 2048 bytes.
    let length = unsafe { shx_last_error(text.as_mut_ptr().cast(), text.len()) };
    String::from_utf8(text[..length].to_vec()).expect("UTF-8")
}

#[test]
fn every_bad_argument_is_found_named_and_harmless() {
    let table = table();
    let mut failures = Vec::new();
    for case in &table {
        let mut scene = Scene::new();
        let what = format!("{}, {} {}", case.function, case.argument, case.what);
        let result = (case.call)(&mut scene);
        // SAFETY: a name of static life.
        let name = |code| unsafe { std::ffi::CStr::from_ptr(shx_result_name(code)).to_str().expect("UTF-8") };
        let text = last_error();
        if result != case.expected {
            failures.push(format!("{what}: {} in place of {}: {text}", name(result), name(case.expected)));
            continue;
        }
        scene.check_untouched(&what);
        if result != SHX_OK {
            let named = text.contains(case.argument)
                || matches!(result, SHX_ERROR_STRUCT_SIZE | SHX_ERROR_SNAPSHOT | SHX_ERROR_FILE | SHX_ERROR_BUFFER_TOO_SMALL)
                || (case.argument == "count" && text.contains("curvatures (count)"))
                || (case.argument == "point_counts" && text.contains("points"));
            if !named || !text.starts_with(&format!("{}: ", case.function)) {
                failures.push(format!("{what}: the text does not name function and argument: {text}"));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(table.len() > 500, "{} cases", table.len());
}

/// Functions of the header and the names of their arguments.
fn declared() -> BTreeSet<(String, String)> {
    let header = include_str!("../../../include/superhelix.h");
    let mut declared = BTreeSet::new();
    for declaration in header.split("SHX_API ").skip(1) {
        let Some((head, rest)) = declaration.split_once('(') else { continue };
        let function = head.rsplit([' ', '*']).next().expect("a name");
        if !function.starts_with("shx_") {
            continue;
        }
        let (arguments, _) = rest.split_once(");").expect("a closed declaration");
        for argument in arguments.split(',').map(str::trim).filter(|argument| *argument != "void") {
            let argument = argument.split('[').next().expect("a declaration").rsplit([' ', '*']).next().expect("a name");
            declared.insert((function.to_string(), argument.to_string()));
        }
    }
    declared
}

#[test]
fn the_table_covers_every_argument_of_every_exported_function() {
    let covered: BTreeSet<_> = table().iter().map(|case| (case.function.to_string(), case.argument.to_string())).collect();
    let declared = declared();
    let missing: Vec<_> = declared.difference(&covered).collect();
    let unknown: Vec<_> = covered.difference(&declared).collect();
    assert!(missing.is_empty(), "no case for {missing:?}");
    assert!(unknown.is_empty(), "cases for what is not there: {unknown:?}");
    let without_arguments = ["shx_version", "shx_abi_version", "shx_build_info"];
    for function in include_str!("../../../include/exports.txt").lines() {
        let known = declared.iter().any(|(name, _)| name == function) || without_arguments.contains(&function);
        assert!(known, "{function} is exported and not in the table");
    }
}
