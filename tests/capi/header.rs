//! `include/superhelix.h` and `include/exports.txt` match src/capi. `SHX_BLESS=1 cargo test --test capi header` writes them.

use std::fs;
use std::path::{Path, PathBuf};

/// The subjects of the header in its order: a title, and the sources whose items stand under it, each in the order of its source.
const SUBJECTS: [(&str, &[&str]); 37] = [
    ("Version", &["base/version"]),
    ("Results and errors", &["base/errors"]),
    (HANDLES, &["base/guard"]),
    ("Ids, frames, inputs and outputs", &["base/types"]),
    ("Messages and threads", &["base/log", "base/parallel"]),
    ("Memory", &["base/allocator"]),
    ("Solver", &["simulation/solver_def", "simulation/solver", "simulation/solver_options"]),
    ("Stepping", &["simulation/step_limits", "simulation/step"]),
    ("Wind", &["simulation/wind"]),
    ("Strands", &["hair/strand_def", "hair/strands"]),
    ("Roots", &["hair/roots", "hair/motion"]),
    ("Targets", &["hair/targets"]),
    ("Curvatures", &["hair/shape"]),
    ("Level of detail", &["hair/level_of_detail"]),
    ("Static equilibrium", &["hair/settle"]),
    ("Natural and rest shapes", &["hair/restyling"]),
    ("Materials and wisps", &["hair/materials", "hair/wisp"]),
    ("Posing by hand", &["tools/pose_def", "tools/posing"]),
    ("Sampling", &["reading/sampling"]),
    ("Bodies", &["scene/body_def", "scene/bodies", "scene/distance_grid"]),
    ("Contact", &["scene/contact", "scene/contacts", "scene/contact_events"]),
    ("Overlaps", &["scene/overlaps", "scene/push_out"]),
    ("Constraints", &["scene/constraints"]),
    ("Rigid attachments", &["scene/attachment"]),
    ("Haptics", &["tools/haptic_def", "tools/haptic"]),
    ("Styling tools", &["tools/styling_tool", "tools/styling", "tools/ring_comb", "tools/haptic_ring_comb"]),
    ("Snapshots", &["simulation/state"]),
    ("Debug drawing", &["reading/debug_draw"]),
    ("Fitting strands to curves", &["groom/fit", "groom/fit_curves", "groom/spline"]),
    ("Choosing settings", &["simulation/settings"]),
    ("Choosing the number of elements", &["simulation/suggest"]),
    ("Fitting friction to a recording", &["groom/friction_fit"]),
    ("Groom files and caches", &["groom/curves", "groom/curve_data", "groom/curve_cache"]),
    ("Hair types", &["groom/hair_type"]),
    ("Hair handle", &["groom/hair_handle"]),
    ("Scalps and follicles", &["groom/scalp"]),
    ("Render hair", &["render/render_def", "render/render_hair"]),
];

/// The subject that has all opaque handles, whatever their source.
const HANDLES: &str = "Handles";

/// The longest line of the header.
const WIDTH: usize = 110;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// A declaration of the header with the comment before it.
struct Item<'a> {
    name: &'a str,
    text: &'a str,
}

impl<'a> Item<'a> {
    fn new(text: &'a str) -> Self {
        let declaration = text.lines().find(|line| !line.starts_with("//")).expect("a declaration");
        let name = if let Some(rest) = declaration.strip_prefix("#define ") {
            rest
        } else if let Some(rest) = declaration.strip_prefix("typedef struct ") {
            rest
        } else if let Some((_, rest)) = declaration.split_once("(*") {
            rest
        } else {
            let end = declaration.find(['(', ';']).expect("a function or a type");
            &declaration[declaration[..end].rfind([' ', '*']).expect("a type before the name") + 1..]
        };
        let end = name.find(|letter: char| !letter.is_alphanumeric() && letter != '_').expect("more than a name");
        Self { name: &name[..end], text }
    }

    fn is_handle(&self) -> bool {
        self.text.lines().last().is_some_and(|line| line.starts_with("typedef struct "))
    }

    /// Where the item is defined in a source.
    fn place_in(&self, source: &str) -> Option<usize> {
        ["pub const ", "pub struct ", "pub type ", "fn "].iter().find_map(|keyword| {
            let definition = format!("{keyword}{}", self.name);
            let ends = |at: &usize| {
                !source[at + definition.len()..].starts_with(|letter: char| letter.is_alphanumeric() || letter == '_')
            };
            source.match_indices(&definition).map(|(at, _)| at).find(ends)
        })
    }
}

/// The header by subjects: cbindgen has all constants first, then types, then functions.
fn by_subject(header: &str) -> String {
    let (prologue, rest) = header.split_once("\n#endif\n").expect("the end of SHX_API");
    let (declarations, guard) = rest.trim_end().rsplit_once("\n\n").expect("the end of the include guard");
    let items: Vec<Item> = declarations.trim().split("\n\n").map(|text| Item::new(text.trim_matches('\n'))).collect();
    let mut placed = 0;
    let mut text = format!("{}\n#endif\n\n#ifdef __cplusplus\nextern \"C\" {{\n#endif\n", prologue.trim_start_matches('\n'));
    for (title, sources) in SUBJECTS {
        text.push_str(&format!("\n// ---- {title} {}\n", "-".repeat(WIDTH - 9 - title.len())));
        if title == HANDLES {
            for handle in items.iter().filter(|item| item.is_handle()) {
                text.push_str(&format!("\n{}\n", handle.text));
                placed += 1;
            }
        }
        for source in sources {
            let source = fs::read_to_string(root().join("src/capi").join(source).with_extension("rs")).expect("a source");
            let mut own: Vec<(usize, &Item)> = items
                .iter()
                .filter(|item| !item.is_handle())
                .filter_map(|item| item.place_in(&source).map(|place| (place, item)))
                .collect();
            own.sort_by_key(|(place, _)| *place);
            for (_, item) in own {
                text.push_str(&format!("\n{}\n", item.text));
                placed += 1;
            }
        }
    }
    assert_eq!(placed, items.len(), "an item is in no source, or in two");
    format!("{text}\n#ifdef __cplusplus\n}} // extern \"C\"\n#endif\n\n{guard}\n")
}

/// cbindgen's layout made plainer: a declaration on one line or wrapped with a fixed indent, no `struct` where the typedef will do,
/// negative codes in parentheses.
fn tidy(header: &str) -> String {
    let mut tidied = String::new();
    let mut lines = header.lines();
    while let Some(line) = lines.next() {
        if line.starts_with("SHX_API") || line.starts_with("typedef void (*") {
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
        if column + piece.trim_end().len() > WIDTH {
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
    for source in SUBJECTS.iter().flat_map(|(_, sources)| *sources) {
        builder = builder.with_src(folder.join(source).with_extension("rs"));
    }
    let mut bytes = Vec::new();
    builder.generate().expect("a header").write(&mut bytes);
    by_subject(&tidy(&String::from_utf8(bytes).expect("UTF-8")))
}

/// The sources of src/capi: a name, with its folder and without its ending, and the text.
fn sources() -> Vec<(String, String)> {
    let floor = root().join("src/capi");
    let (mut folders, mut sources) = (vec![floor.clone()], Vec::new());
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let name = path.strip_prefix(&floor).expect("a source of the floor").with_extension("");
            let name = name.components().map(|part| part.as_os_str().to_str().expect("UTF-8")).collect::<Vec<_>>().join("/");
            sources.push((name, fs::read_to_string(&path).expect("a source")));
        }
    }
    sources
}

/// The functions that src/capi exports, sorted, read from the sources themselves: cbindgen does not see what macros make.
fn exports() -> String {
    let mut names = Vec::new();
    for (_, text) in sources() {
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
fn the_committed_header_matches_the_sources() {
    compare_or_bless(&root().join("include/superhelix.h"), &generate());
}

#[test]
fn the_committed_export_list_matches_the_sources() {
    compare_or_bless(&root().join("include/exports.txt"), &exports());
}

#[test]
fn every_source_of_the_floor_is_in_the_header() {
    for (name, text) in sources() {
        if text.contains("no_mangle") || text.contains("\npub const SHX_") {
            let listed = SUBJECTS.iter().any(|(_, sources)| sources.contains(&name.as_str()));
            assert!(listed, "{name}.rs is not among the header's sources");
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
fn no_line_is_too_long() {
    for (number, line) in generate().lines().enumerate() {
        assert!(line.len() <= WIDTH, "line {} has {} characters: {line}", number + 1, line.len());
    }
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
            let threads = ["any", "shared", "exclusive"].iter().any(|rule| text.contains(&format!("// Threads: {rule}")));
            assert!(threads, "line {}: {line}: its comment has no thread rule", number + 1);
            let changes = line.contains("(shx_solver *solver") && !text.contains("Threads: exclusive");
            assert!(!changes, "line {}: {line} takes a solver that is not const, but not exclusively", number + 1);
            let reads = line.contains("(const shx_solver *solver") && !text.contains("Threads: shared");
            assert!(!reads, "line {}: {line} takes a const solver, but is not shared", number + 1);
            let fallible = line.contains(" shx_result shx_");
            assert!(!fallible || text.contains("Errors:"), "line {}: {line}: its comment has no errors", number + 1);
        }
    }
}
