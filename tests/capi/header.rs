//! `include/superhelix.h` and `include/exports.txt` are what src/capi says. `SHX_BLESS=1 cargo test --test capi header` writes them.

use std::fs;
use std::path::{Path, PathBuf};

/// The sources in the order of the header.
const SOURCES: [&str; 41] = [
    "version",
    "errors",
    "types",
    "log",
    "parallel",
    "solver_def",
    "strand_def",
    "guard",
    "step_options",
    "solver",
    "strands",
    "roots",
    "shape",
    "level_of_detail",
    "settle",
    "restyling",
    "materials",
    "wisp",
    "pose_def",
    "posing",
    "sampling",
    "body_def",
    "bodies",
    "contact",
    "contacts",
    "overlaps",
    "constraints",
    "state",
    "fit",
    "fit_curves",
    "spline",
    "settings",
    "friction_fit",
    "suggest",
    "curves",
    "curve_data",
    "curve_cache",
    "hair",
    "scalp",
    "render_def",
    "render_hair",
];

/// Titles, each put before the first item of its section. cbindgen has constants first, then types, then functions.
const SECTIONS: [(&str, &str); 51] = [
    ("#define SHX_VERSION_MAJOR ", "Version"),
    ("#define SHX_OK ", "Results"),
    ("#define SHX_FORMAT_F32X3 ", "Formats of inputs and outputs"),
    ("#define SHX_LOG_ERROR ", "Levels of messages"),
    ("#define SHX_INTEGRATOR_LINEARLY_IMPLICIT ", "Options of a solver"),
    ("#define SHX_FREE_TWIST ", "Freedoms of a strand"),
    ("#define SHX_SHAPE_SPHERE ", "Shapes of bodies"),
    ("#define SHX_CONTACT_PENALTY ", "Models of contact"),
    ("#define SHX_PARTNER_BODY ", "What a strand met"),
    ("#define SHX_HOLD_POINT ", "Constraints"),
    ("#define SHX_FIT_LENGTHS_EQUAL ", "Fitting strands"),
    ("#define SHX_SPLINE_CATMULL_ROM ", "Kinds of splines"),
    ("#define SHX_PRESET_PREVIEW ", "Presets and measured scenes"),
    ("#define SHX_OBSERVABLE_SPAN ", "Fitting friction"),
    ("#define SHX_CURVES_THICKNESS ", "What curves have beside points"),
    ("#define SHX_CURL_EXACT ", "Kinds of hair"),
    ("#define SHX_SPACE_POSITION ", "Mixing guides"),
    ("typedef struct shx_curves ", "Handles"),
    ("typedef int32_t shx_result;", "Plain data, host hooks, definitions"),
    ("SHX_API uint32_t shx_version(", "Version"),
    ("SHX_API const char *shx_result_name(", "Errors"),
    ("SHX_API shx_result shx_solver_def_init(", "Definitions"),
    ("SHX_API shx_result shx_step_report_init(", "Solver"),
    ("SHX_API shx_result shx_solver_add_strands(", "Strands"),
    ("SHX_API shx_result shx_solver_set_root_frames(", "Roots"),
    ("SHX_API shx_result shx_solver_set_natural_curvatures(", "Curvatures"),
    ("SHX_API shx_result shx_solver_set_element_count(", "Level of detail"),
    ("SHX_API shx_result shx_settle_def_init(", "Static rest"),
    ("SHX_API shx_result shx_solver_take_natural_shapes(", "Shapes taken as they are"),
    ("SHX_API shx_result shx_material_init(", "Materials"),
    ("SHX_API shx_result shx_wisp_init(", "Wisps"),
    ("SHX_API shx_result shx_pose_options_init(", "How strands are posed"),
    ("SHX_API shx_result shx_solver_drag_strands(", "Posing"),
    ("SHX_API shx_result shx_sample_def_init(", "Sampling"),
    ("SHX_API shx_result shx_body_def_init(", "Bodies"),
    ("SHX_API shx_result shx_contact_options_init(", "Contact"),
    ("SHX_API shx_result shx_solver_contact_count(", "What touches"),
    ("SHX_API shx_result shx_constraint_def_init(", "Constraints"),
    ("SHX_API shx_result shx_solver_snapshot(", "State"),
    ("SHX_API shx_result shx_fit_init(", "Fitting strands to polylines"),
    ("SHX_API shx_result shx_fit_options_init(", "Fitting strands to many curves"),
    ("SHX_API shx_result shx_spline_points(", "Splines"),
    ("SHX_API shx_result shx_settings_init(", "Settings"),
    ("SHX_API shx_result shx_friction_def_init(", "Fitting friction to recorded curves"),
    ("SHX_API shx_result shx_suggest_def_init(", "Choosing the number of elements"),
    ("SHX_API shx_result shx_curves_read(", "Groom files and caches"),
    ("SHX_API shx_result shx_curve_data_init(", "All that groom files say"),
    ("SHX_API shx_result shx_curve_cache_read(", "Caches of curves over time"),
    ("SHX_API shx_result shx_hair_init(", "Kinds of hair"),
    ("SHX_API shx_result shx_scalp_def_init(", "Follicles on a scalp"),
    ("SHX_API shx_result shx_render_settings_init(", "Render hair"),
];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The header with a title before each section's first item (before the comment that belongs to it).
fn with_titles(header: &str) -> String {
    let lines: Vec<&str> = header.lines().collect();
    let mut titled: Vec<String> = Vec::new();
    let mut wanted = SECTIONS.iter();
    let mut next = wanted.next();
    for line in &lines {
        if let Some((start, title)) = next
            && format!("{line} ").starts_with(start)
        {
            let comment = titled.iter().rev().take_while(|earlier| earlier.starts_with("//")).count();
            let place = titled.len() - comment;
            let rule = "-".repeat(110 - title.len());
            titled.splice(place..place, [format!("// ---- {title} {rule}"), String::new()]);
            next = wanted.next();
        }
        titled.push((*line).trim_end().to_string());
    }
    assert!(next.is_none(), "the header has no {next:?}, or not in this order:\n{header}");
    titled.join("\n") + "\n"
}

/// cbindgen's layout made plainer: a declaration on one line or wrapped with a fixed indent, no `struct` where the typedef will do,
/// negative codes in parentheses.
fn tidy(header: &str) -> String {
    let mut tidied = String::new();
    let mut lines = header.lines();
    while let Some(line) = lines.next() {
        if line.starts_with("SHX_API") {
            let mut declaration = line.to_string();
            while !declaration.ends_with(");") {
                declaration = declaration + " " + lines.next().expect("the rest of a declaration").trim();
            }
            tidied.push_str(&wrapped(&declaration.replace("struct shx_", "shx_").replace("( ", "(")));
        } else if let Some((define, code)) = line.split_once(" -").filter(|_| line.starts_with("#define SHX_")) {
            tidied.push_str(&format!("{define} (-{code})"));
        } else if line.starts_with("typedef struct") {
            tidied.push_str(line);
        } else {
            tidied.push_str(&line.replace("struct shx_", "shx_"));
        }
        tidied.push('\n');
    }
    tidied
}

fn wrapped(declaration: &str) -> String {
    let mut text = String::new();
    let mut column = 0;
    for piece in declaration.split_inclusive(", ") {
        if column + piece.trim_end().len() > 120 {
            text.truncate(text.trim_end().len());
            text.push_str("\n    ");
            column = 4;
        }
        text.push_str(piece);
        column += piece.len();
    }
    text
}

fn generate() -> String {
    let folder = root().join("src/capi");
    let config = cbindgen::Config::from_file(root().join("cbindgen.toml")).expect("cbindgen.toml");
    let mut builder = cbindgen::Builder::new().with_config(config);
    for source in SOURCES {
        builder = builder.with_src(folder.join(source).with_extension("rs"));
    }
    let mut bytes = Vec::new();
    builder.generate().expect("a header").write(&mut bytes);
    with_titles(&tidy(&String::from_utf8(bytes).expect("UTF-8")))
}

/// The functions that src/capi exports, sorted, read from the sources themselves: cbindgen does not see what macros make.
fn exports() -> String {
    let mut names = Vec::new();
    for entry in fs::read_dir(root().join("src/capi")).expect("src/capi") {
        let text = fs::read_to_string(entry.expect("an entry").path()).expect("a source");
        let lines: Vec<&str> = text.lines().map(str::trim).collect();
        for pair in lines.windows(2).filter(|pair| pair[0] == "#[unsafe(no_mangle)]") {
            let (_, rest) = pair[1].split_once(" fn ").expect("a function after no_mangle");
            names.push(rest.split(['(', '<']).next().expect("a name").to_string());
        }
    }
    names.sort();
    names.join("\n") + "\n"
}

fn compare_or_bless(path: &Path, generated: &str) {
    if std::env::var_os("SHX_BLESS").is_some() {
        fs::create_dir_all(path.parent().expect("a folder")).expect("the folder");
        fs::write(path, generated).expect("the file");
        return;
    }
    let committed = fs::read_to_string(path).unwrap_or_default();
    if let Some((number, (ours, theirs))) =
        generated.lines().zip(committed.lines()).enumerate().find(|(_, (ours, theirs))| ours != theirs)
    {
        panic!("{}:{}: has\n  {theirs}\nexpected\n  {ours}\n(SHX_BLESS=1 writes it)", path.display(), number + 1);
    }
    assert_eq!(generated.len(), committed.len(), "{} is not what src/capi says (SHX_BLESS=1 writes it)", path.display());
}

#[test]
fn the_committed_header_is_what_the_sources_say() {
    compare_or_bless(&root().join("include/superhelix.h"), &generate());
}

#[test]
fn the_committed_export_list_is_what_the_sources_say() {
    compare_or_bless(&root().join("include/exports.txt"), &exports());
}

#[test]
fn every_source_of_the_floor_is_in_the_header() {
    for entry in fs::read_dir(root().join("src/capi")).expect("src/capi") {
        let path = entry.expect("an entry").path();
        let text = fs::read_to_string(&path).expect("a source");
        let stem = path.file_stem().expect("a name").to_str().expect("UTF-8").to_string();
        if text.contains("no_mangle") || text.contains("\npub const SHX_") {
            assert!(SOURCES.contains(&stem.as_str()), "{stem}.rs is not among the header's sources");
        }
    }
}

#[test]
fn every_exported_function_is_declared_and_nothing_else() {
    let header = generate();
    let mut declared: Vec<&str> = header
        .lines()
        .filter_map(|line| line.strip_prefix("SHX_API "))
        .filter_map(|line| line.split('(').next()?.rsplit([' ', '*']).next())
        .collect();
    declared.sort_unstable();
    assert_eq!(declared.join("\n") + "\n", exports());
}

#[test]
fn every_declared_item_has_a_comment() {
    let header = generate();
    let lines: Vec<&str> = header.lines().collect();
    for (number, line) in lines.iter().enumerate().skip(1) {
        let item = line.starts_with("SHX_API ") || line.starts_with("#define SHX_") && !line.contains("SHX_API");
        if item {
            assert!(lines[number - 1].starts_with("//"), "line {}: {line} has no comment", number + 1);
        }
        if line.starts_with("SHX_API ") {
            let comment: Vec<&str> = lines[..number].iter().rev().take_while(|line| line.starts_with("//")).copied().collect();
            let text = comment.join(" ");
            let threads = ["Any thread", "May run beside", "Alone with"].iter().any(|rule| text.contains(rule));
            assert!(threads, "line {}: {line}: its comment has no thread rule", number + 1);
            let fallible = line.contains(" shx_result shx_");
            assert!(!fallible || text.contains("Errors:"), "line {}: {line}: its comment has no errors", number + 1);
        }
    }
}
