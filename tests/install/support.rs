//! The installations that the tests share, and folders outside the repository.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};

pub const VERSION: &str = env!("CARGO_PKG_VERSION");
/// The library directory below the prefix, one that no default is.
pub const LIBRARIES: &str = "lib/multiarch";

pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The target folder of the cargo that compiled this.
pub fn target() -> &'static Path {
    Path::new(env!("CARGO_TARGET_TMPDIR")).parent().expect("the target folder")
}

/// A command without what cargo sets for tests, which would make the cargo inside compile everything again.
pub fn command(program: impl AsRef<std::ffi::OsStr>) -> Command {
    let mut command = Command::new(program);
    for (name, _) in std::env::vars_os() {
        let name = name.to_string_lossy();
        if name.starts_with("CARGO_PKG_") || name.starts_with("CARGO_MANIFEST") || name == "CARGO_BIN_NAME" {
            command.env_remove(&*name);
        }
    }
    for name in ["DESTDIR", "PREFIX", "LIBDIR", "INCLUDEDIR", "LD_LIBRARY_PATH", "PKG_CONFIG_PATH", "MAKEFLAGS", "MAKELEVEL"] {
        command.env_remove(name);
    }
    command
}

/// The output of a command, whether it succeeds or not.
pub fn output(command: &mut Command) -> Output {
    let program = command.get_program().to_string_lossy().into_owned();
    command.output().unwrap_or_else(|error| {
        panic!("{program}: {error}. These tests need what `scripts/setup.sh test` installs, cmake and pkg-config among it")
    })
}

/// The output of a command, which must succeed.
pub fn run(command: &mut Command) -> String {
    let output = output(command);
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{command:?}: {}\n{printed}\n{}", output.status, String::from_utf8_lossy(&output.stderr));
    printed
}

/// Both outputs of a command that must fail.
pub fn refused(command: &mut Command) -> String {
    let output = output(command);
    let printed = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success(), "{command:?} succeeded:\n{printed}");
    printed
}

/// A folder outside the repository that goes with the value.
pub struct Folder(PathBuf);

impl Folder {
    pub fn new() -> Self {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("superhelix-install-{}-{number}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a folder");
        Self(path)
    }

    pub fn path(&self) -> &Path {
        &self.0
    }

    /// Writes a file in the folder.
    pub fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.0.join(name);
        std::fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
        std::fs::write(&path, text).expect("a file");
        path
    }

    /// A folder with a copy of `examples_c` and nothing else of the repository.
    pub fn with_examples() -> Self {
        let folder = Self::new();
        run(command("cp").arg("-r").arg(root().join("examples_c")).arg(folder.path()));
        folder
    }

    pub fn examples(&self) -> PathBuf {
        self.0.join("examples_c")
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

pub fn build_library(folder: &Path, linkage: &str) {
    let mut build = command(root().join("scripts/build_lib.sh"));
    if std::env::var_os("SHX_PROFILE").is_none() {
        build.env("SHX_PROFILE", "test");
    }
    run(build.env("SHX_BUILD_DIR", folder).env("SHX_LINKAGE", linkage).env("CARGO_TARGET_DIR", target()));
}

/// The folder of `scripts/build_lib.sh` with both libraries.
pub fn built() -> &'static Path {
    static BUILT: OnceLock<PathBuf> = OnceLock::new();
    BUILT.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("install/build");
        build_library(&folder, "both");
        folder
    })
}

/// `make install` or `make uninstall` into `destdir` for /opt/hair.
pub fn make(goal: &str, destdir: &Path) -> Command {
    let mut make = command("make");
    make.arg("-C").arg(root()).arg(goal).arg(format!("DESTDIR={}", destdir.display()));
    make.args(["PREFIX=/opt/hair", &format!("LIBDIR=/opt/hair/{LIBRARIES}")]).env("SHX_BUILD_DIR", built());
    make
}

/// An installation as a packager stages it: for /opt/hair, in a DESTDIR.
pub fn staged() -> &'static Path {
    static STAGED: OnceLock<PathBuf> = OnceLock::new();
    STAGED.get_or_init(|| {
        let destdir = Path::new(env!("CARGO_TARGET_TMPDIR")).join("install/stage");
        let _ = std::fs::remove_dir_all(&destdir);
        run(&mut make("install", &destdir));
        destdir.join("opt/hair")
    })
}

/// The same after moving it to an unexpected place.
pub fn moved() -> &'static Path {
    static MOVED: OnceLock<PathBuf> = OnceLock::new();
    MOVED.get_or_init(|| {
        let first = Path::new(env!("CARGO_TARGET_TMPDIR")).join("install/first");
        let second = Path::new(env!("CARGO_TARGET_TMPDIR")).join("install/second");
        let _ = std::fs::remove_dir_all(&second);
        run(&mut make("install", &first));
        std::fs::rename(first.join("opt/hair"), &second).expect("moved");
        second
    })
}

/// The shared libraries that a program asks for.
pub fn needed(program: &Path) -> String {
    let dynamic = run(command("readelf").arg("-d").arg(program));
    dynamic.lines().filter(|line| line.contains("(NEEDED)")).collect::<Vec<_>>().join("\n")
}

/// hello prints the path of a tip, six lines that end in metres.
pub fn is_hello(printed: &str) {
    assert_eq!(printed.lines().filter(|line| line.ends_with(") m")).count(), 6, "{printed}");
}
