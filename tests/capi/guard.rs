//! Rules 4, 5 and 6 of the C ABI, from inside: panics are caught and poison the solver, errors keep their text, a strand that turns
//! non-finite is rolled back and marked.
#![allow(unsafe_code)] // calls of the C ABI

use std::ffi::{CStr, c_char, c_void};
use std::ptr::{null, null_mut};

use superhelix::internals::capi::base::errors::*;
use superhelix::internals::capi::base::guard::{panic_inside, shx_solver};
use superhelix::internals::capi::base::log::*;
use superhelix::internals::capi::base::types::shx_strand_id;
use superhelix::internals::capi::hair::strand_def::*;
use superhelix::internals::capi::hair::strands::*;
use superhelix::internals::capi::scene::contact::*;
use superhelix::internals::capi::scene::overlaps::shx_solver_permit_overlaps;
use superhelix::internals::capi::simulation::solver::*;
use superhelix::internals::capi::simulation::solver_def::*;
use superhelix::internals::capi::simulation::state::{shx_solver_snapshot, shx_solver_state_hash};
use superhelix::internals::capi::simulation::step::*;
use superhelix::internals::capi::tools::posing::shx_solver_cut_strands;

fn solver(log: shx_log_fn, user: *mut c_void) -> *mut shx_solver {
    let mut solver = null_mut();
    let mut def = std::mem::MaybeUninit::<shx_solver_def>::uninit();
    // SAFETY: room for a definition and a handle.
    unsafe {
        assert_eq!(shx_solver_def_init(def.as_mut_ptr(), size_of::<shx_solver_def>()), SHX_OK);
        let mut def = def.assume_init();
        def.log = log;
        def.log_user = user;
        def.log_level = SHX_LOG_DEBUG;
        assert_eq!(shx_solver_create(&raw const def, &raw mut solver), SHX_OK);
    }
    solver
}

fn add(solver: *mut shx_solver, edit: impl Fn(&mut shx_strand_def)) -> shx_strand_id {
    let mut id = shx_strand_id { bits: 0 };
    let mut def = std::mem::MaybeUninit::<shx_strand_def>::uninit();
    // SAFETY: room for a definition and an id.
    unsafe {
        assert_eq!(shx_strand_def_init(def.as_mut_ptr(), size_of::<shx_strand_def>()), SHX_OK);
        let mut def = def.assume_init();
        def.length = 0.1;
        def.element_count = 4;
        edit(&mut def);
        assert_eq!(
            shx_solver_add_strands(solver, &raw const def, size_of::<shx_strand_def>(), 1, &raw mut id),
            SHX_OK,
            "{}",
            text()
        );
    }
    id
}

fn text() -> String {
    let mut bytes = [0_u8; 2048];
    // SAFETY: room for 2048 bytes.
    let length = unsafe { shx_last_error(bytes.as_mut_ptr().cast(), bytes.len()) };
    String::from_utf8(bytes[..length].to_vec()).expect("UTF-8")
}

#[test]
fn rule_5_a_panic_is_caught_and_poisons_its_solver_only() {
    let (hurt, well) = (solver(None, null_mut()), solver(None, null_mut()));
    let id = add(hurt, |_| ());
    let mut count = 77;
    // SAFETY: living handles.
    unsafe {
        assert_eq!(panic_inside(hurt), SHX_ERROR_INTERNAL);
        assert!(text().contains("a panic made for a test"), "{}", text());
        assert_eq!(shx_solver_step(hurt, 0.01, 1, null_mut()), SHX_ERROR_POISONED);
        assert!(text().contains("poisoned"), "{}", text());
        assert_eq!(shx_solver_strand_count(hurt, &raw mut count), SHX_ERROR_POISONED);
        assert_eq!(count, 77);
        assert!(!shx_solver_has_strand(hurt, id));
        assert_eq!(shx_solver_step(well, 0.01, 1, null_mut()), SHX_OK);
        shx_solver_destroy(hurt);
        shx_solver_destroy(well);
    }
}

#[test]
fn rule_4_codes_and_names_never_change() {
    let published = [
        (0, "SHX_OK"),
        (-1, "SHX_ERROR_NULL_ARGUMENT"),
        (-2, "SHX_ERROR_INVALID_ARGUMENT"),
        (-3, "SHX_ERROR_INVALID_ID"),
        (-4, "SHX_ERROR_STRUCT_SIZE"),
        (-5, "SHX_ERROR_BUFFER_TOO_SMALL"),
        (-6, "SHX_ERROR_BUSY"),
        (-7, "SHX_ERROR_SNAPSHOT"),
        (-8, "SHX_ERROR_OUT_OF_MEMORY"),
        (-9, "SHX_ERROR_UNSUPPORTED"),
        (-10, "SHX_ERROR_FILE"),
        (-100, "SHX_ERROR_INTERNAL"),
        (-101, "SHX_ERROR_POISONED"),
    ];
    let header = include_str!("../../include/superhelix.h");
    for (code, name) in published {
        // SAFETY: a static text.
        assert_eq!(unsafe { CStr::from_ptr(shx_result_name(code)) }.to_str(), Ok(name));
        let value = if code < 0 { format!("({code})") } else { code.to_string() };
        assert!(header.contains(&format!("#define {name} {value}\n")), "{name}");
    }
    let codes = header.lines().filter(|line| line.starts_with("#define SHX_ERROR_")).count();
    assert_eq!(codes, published.len() - 1);
}

#[test]
fn rule_4_the_last_error_is_cut_to_the_buffer_and_kept() {
    // SAFETY: buffers of the stated sizes.
    unsafe {
        assert_eq!(shx_solver_step(null_mut(), 1.0, 1, null_mut()), SHX_ERROR_NULL_ARGUMENT);
        let whole = "shx_solver_step: solver is null";
        assert_eq!(text(), whole);
        let mut small = [0x55_u8; 8];
        assert_eq!(shx_last_error(small.as_mut_ptr().cast(), 6), whole.len());
        assert_eq!(&small, b"shx_s\0\x55\x55");
        // A call that succeeds leaves the text.
        let mut handle = null_mut();
        assert_eq!(shx_solver_create(null(), &raw mut handle), SHX_OK);
        shx_solver_destroy(handle);
        assert_eq!(text(), whole);
        // Never cut inside a character.
        let mut curves = null_mut();
        let path = c"\u{e9}\u{e9}\u{e9}.obj";
        assert_eq!(superhelix::internals::capi::groom::curves::shx_curves_read(path.as_ptr(), &raw mut curves), SHX_ERROR_FILE);
        let all = text();
        for capacity in 1..all.len() {
            let mut bytes = vec![0x55_u8; capacity];
            shx_last_error(bytes.as_mut_ptr().cast(), capacity);
            let cut = CStr::from_bytes_until_nul(&bytes).expect("a closing zero").to_str().expect("UTF-8");
            assert!(all.starts_with(cut) && cut.len() + 2 >= capacity, "{capacity}: {cut}");
        }
    }
}

unsafe extern "C" fn collect(user: *mut c_void, level: u32, message: *const c_char) {
    // SAFETY: the test's list, and a closed text.
    unsafe {
        let list = &mut *user.cast::<Vec<(u32, String)>>();
        list.push((level, CStr::from_ptr(message).to_str().expect("UTF-8").to_string()));
    }
}

#[test]
fn messages_reach_the_host_of_their_solver() {
    let mut messages: Vec<(u32, String)> = Vec::new();
    let handle = solver(Some(collect), (&raw mut messages).cast());
    add(handle, |_| ());
    // SAFETY: a living handle.
    unsafe {
        assert_eq!(shx_solver_step(handle, 0.01, 1, null_mut()), SHX_OK);
        assert_eq!(shx_solver_step(handle, f64::NAN, 1, null_mut()), SHX_ERROR_INVALID_ARGUMENT);
        shx_solver_destroy(handle);
    }
    let levels: Vec<u32> = messages.iter().map(|(level, _)| *level).collect();
    assert_eq!(levels, [SHX_LOG_INFO, SHX_LOG_DEBUG, SHX_LOG_DEBUG, SHX_LOG_ERROR], "{messages:?}");
    // One line for a reader; what only helps debugging comes at its own level.
    let summary = &messages[0].1;
    assert!(summary.len() < 160 && !summary.contains(['{', '\n']), "{summary}");
    for part in ["second order", "double precision", "1 thread", "gravity (0, 0, -9.81) m/s^2"] {
        assert!(summary.contains(part), "{summary}");
    }
    assert!(messages[1].1.contains("tolerance"), "{messages:?}");
    assert!(messages[3].1.contains("dt is NaN"), "{messages:?}");
}

#[test]
fn rule_6_a_strand_that_turns_non_finite_is_rolled_back_and_marked() {
    let mut messages: Vec<(u32, String)> = Vec::new();
    let handle = solver(Some(collect), (&raw mut messages).cast());
    let well = add(handle, |_| ());
    // Finite, and beyond what arithmetic can square.
    let ill = add(handle, |def| def.root_velocity = [1e200, 0.0, 0.0]);
    let mut report = std::mem::MaybeUninit::<shx_step_report>::uninit();
    // SAFETY: living handles, room for a report and two results.
    unsafe {
        assert_eq!(shx_step_report_init(report.as_mut_ptr(), size_of::<shx_step_report>()), SHX_OK);
        assert_eq!(shx_solver_step(handle, 0.01, 1, report.as_mut_ptr()), SHX_OK);
        let report = report.assume_init();
        let mut status = [99; 2];
        assert_eq!(shx_solver_strand_status(handle, [well, ill].as_ptr(), 2, status.as_mut_ptr()), SHX_OK);
        assert_eq!(status, [SHX_STRAND_CONVERGED, SHX_STRAND_QUARANTINED]);
        assert_eq!(report.quarantined, 1);
        assert!(messages.iter().any(|(level, text)| *level == SHX_LOG_WARN && text.contains("rolled back")), "{messages:?}");
        // Mended.
        assert_eq!(shx_solver_reset_strands(handle, [ill].as_ptr(), 1), SHX_OK);
        assert_eq!(shx_solver_strand_status(handle, [ill].as_ptr(), 1, status.as_mut_ptr()), SHX_OK);
        assert_eq!(status[0], SHX_STRAND_CONVERGED);
        shx_solver_destroy(handle);
    }
}

#[test]
fn a_number_of_iterations_chosen_for_the_wrong_model_is_warned_of() {
    let mut messages: Vec<(u32, String)> = Vec::new();
    let handle = solver(Some(collect), (&raw mut messages).cast());
    let mut options = std::mem::MaybeUninit::<shx_contact_options>::uninit();
    // SAFETY: a living handle, and a structure of its own size.
    unsafe {
        assert_eq!(shx_contact_options_init(options.as_mut_ptr(), size_of::<shx_contact_options>()), SHX_OK);
        let mut options = options.assume_init();
        for (model, iterations) in [(SHX_CONTACT_COULOMB, 50), (SHX_CONTACT_PENALTY, 1), (SHX_CONTACT_COULOMB, 2)] {
            (options.model, options.max_iterations) = (model, iterations);
            assert_eq!(shx_solver_set_contact_options(handle, &raw const options), SHX_OK);
        }
        shx_solver_destroy(handle);
    }
    let warnings: Vec<&str> = messages.iter().filter(|(level, _)| *level == SHX_LOG_WARN).map(|(_, text)| &**text).collect();
    assert!(warnings.len() == 1 && warnings[0].contains("options.max_iterations is 2"), "{messages:?}");
}

#[test]
fn rule_2_a_removed_strands_id_never_names_another() {
    let handle = solver(None, null_mut());
    let mut seen = std::collections::BTreeSet::new();
    // SAFETY: a living handle and one id.
    unsafe {
        let first = add(handle, |_| ());
        for _ in 0..1000 {
            let id = add(handle, |_| ());
            assert!(seen.insert(id.bits) && id.bits != 0);
            assert!(shx_solver_has_strand(handle, id));
            assert_eq!(shx_solver_remove_strands(handle, [id].as_ptr(), 1), SHX_OK);
            assert!(seen.iter().all(|bits| !shx_solver_has_strand(handle, shx_strand_id { bits: *bits })));
        }
        assert!(shx_solver_has_strand(handle, first));
        shx_solver_destroy(handle);
    }
}

/// Images are counted in bytes, everything else in items.
#[test]
fn a_buffer_that_is_too_small_is_measured_in_its_own_unit() {
    let handle = solver(None, null_mut());
    let id = add(handle, |_| ());
    add(handle, |_| ());
    let (mut image, mut size, mut ids) = ([0_u8; 10], 0, [id]);
    // SAFETY: a living handle, room for ten bytes, a number and an id.
    unsafe {
        let result = shx_solver_snapshot(handle, image.as_mut_ptr().cast(), image.len(), &raw mut size);
        assert_eq!(result, SHX_ERROR_BUFFER_TOO_SMALL);
        let message = text();
        assert!(message.contains("out_image holds 10 bytes; ") && !message.contains("items"), "{message}");
        assert_eq!(shx_solver_strand_ids(handle, ids.as_mut_ptr(), 1), SHX_ERROR_BUFFER_TOO_SMALL);
        assert!(text().contains("out_ids holds 1 items; 2 are needed"), "{}", text());
        shx_solver_destroy(handle);
    }
}

#[test]
fn a_batch_of_cuts_says_which_strand_cannot_be_cut_and_cuts_none() {
    let handle = solver(None, null_mut());
    let ids = [add(handle, |_| ()), add(handle, |_| ()), add(handle, |_| ())];
    let (mut before, mut after) = (0, 0);
    // SAFETY: a living handle, three ids and numbers, room for hashes.
    unsafe {
        assert_eq!(shx_solver_state_hash(handle, &raw mut before), SHX_OK);
        assert_eq!(shx_solver_cut_strands(handle, ids.as_ptr(), 3, [0.05, 0.05, 0.3].as_ptr()), SHX_ERROR_INVALID_ARGUMENT);
        let message = text();
        let named =
            format!("arclengths[2] is 0.3; expected above zero, at most 0.1 m, the length of ids[2], 0x{:016x}", ids[2].bits);
        assert!(message.contains(&named), "{message}");
        assert_eq!(shx_solver_state_hash(handle, &raw mut after), SHX_OK);
        assert_eq!(before, after);
        shx_solver_destroy(handle);
    }
}

/// Curls drawn through each other never converge. The log says what permits that.
#[test]
fn strands_drawn_through_each_other_are_told_of() {
    const SIDE: usize = 7;
    let mut messages: Vec<(u32, String)> = Vec::new();
    let handle = solver(Some(collect), (&raw mut messages).cast());
    // 16 mm wide, a turn in 20 mm, hanging from roots 10 mm apart.
    let (radius, rise) = (0.008_f64, 0.02 / std::f64::consts::TAU);
    let squared = radius * radius + rise * rise;
    let curl = [[rise / squared, radius / squared, 0.0]; 12];
    let ids: Vec<shx_strand_id> = (0..SIDE * SIDE)
        .map(|k| {
            add(handle, |def| {
                (def.length, def.element_count, def.air_drag) = (3.0 * std::f64::consts::TAU * squared.sqrt(), 12, 1e-5);
                def.natural_curvatures = curl.as_ptr().cast();
                let place = |line: usize, off: usize| 0.01 * line as f64 + 0.0007 * off as f64;
                def.root.origin = [place(k % SIDE, k * 37 % 11), place(k / SIDE, k * 53 % 13), 0.0];
                let (sine, cosine) = (std::f64::consts::PI * (k * 29 % 17) as f64 / 17.0).sin_cos();
                def.root.rotation = [sine, cosine, -sine, cosine].map(|part| part * 0.5_f64.sqrt());
            })
        })
        .collect();
    let mut contact = std::mem::MaybeUninit::<shx_strand_contact>::uninit();
    let mut options = std::mem::MaybeUninit::<shx_contact_options>::uninit();
    let told = |messages: &[(u32, String)]| {
        messages.iter().any(|(level, text)| *level == SHX_LOG_WARN && text.contains("shx_solver_permit_overlaps"))
    };
    // SAFETY: a living handle, structures of their own sizes, and as many ids as are said.
    unsafe {
        assert_eq!(shx_strand_contact_init(contact.as_mut_ptr(), size_of::<shx_strand_contact>()), SHX_OK);
        assert_eq!(shx_contact_options_init(options.as_mut_ptr(), size_of::<shx_contact_options>()), SHX_OK);
        let (mut contact, mut options) = (contact.assume_init(), options.assume_init());
        contact.wisp_radius = 1e-3;
        options.hair_contact = 1;
        assert_eq!(shx_solver_set_strand_contact(handle, ids.as_ptr(), ids.len(), &raw const contact, 0), SHX_OK);
        assert_eq!(shx_solver_set_contact_options(handle, &raw const options), SHX_OK);
        for _ in 0..2 {
            assert_eq!(shx_solver_step(handle, 1.0 / 60.0, 1, null_mut()), SHX_OK);
        }
        assert!(told(&messages), "{messages:?}");
        messages.clear();
        assert_eq!(shx_solver_permit_overlaps(handle, ids.as_ptr(), ids.len()), SHX_OK);
        assert_eq!(shx_solver_step(handle, 1.0 / 60.0, 1, null_mut()), SHX_OK);
        assert!(!told(&messages), "{messages:?}");
        shx_solver_destroy(handle);
    }
}
