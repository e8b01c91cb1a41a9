//! Which files an installation has, that it can be moved and removed, and what is refused.

use std::path::{Path, PathBuf};

use crate::support::{Folder, LIBRARIES, VERSION, built, command, make, output, refused, root, run, staged};

/// Every file and link below a folder, as paths from there.
fn files(folder: &Path) -> Vec<String> {
    let mut open = vec![folder.to_path_buf()];
    let mut found = Vec::new();
    while let Some(next) = open.pop() {
        for entry in std::fs::read_dir(next).expect("a folder") {
            let entry = entry.expect("an entry");
            if entry.file_type().expect("a type").is_dir() {
                open.push(entry.path());
            } else {
                found.push(entry.path().strip_prefix(folder).expect("a prefix").display().to_string());
            }
        }
    }
    found.sort_unstable();
    found
}

fn major() -> &'static str {
    VERSION.split('.').next().expect("a version")
}

#[test]
fn an_installation_has_these_files() {
    let mut expected = vec![
        "include/superhelix.h".to_string(),
        format!("{LIBRARIES}/libsuperhelix.a"),
        format!("{LIBRARIES}/libsuperhelix.so"),
        format!("{LIBRARIES}/libsuperhelix.so.{}", major()),
        format!("{LIBRARIES}/libsuperhelix.so.{VERSION}"),
        format!("{LIBRARIES}/superhelix/libsuperhelix.a"),
        format!("{LIBRARIES}/pkgconfig/superhelix.pc"),
        format!("{LIBRARIES}/pkgconfig/superhelix-library.pc"),
        format!("{LIBRARIES}/cmake/superhelix/superhelixConfig.cmake"),
        format!("{LIBRARIES}/cmake/superhelix/superhelixConfigVersion.cmake"),
        format!("{LIBRARIES}/cmake/superhelix/superhelixTargets.cmake"),
        "share/licenses/superhelix/LICENSE-APACHE".to_string(),
        "share/licenses/superhelix/LICENSE-MIT".to_string(),
    ];
    expected.extend(files(&root().join("bindings/cpp/include")).into_iter().map(|header| format!("include/{header}")));
    expected.sort_unstable();
    assert_eq!(files(staged()), expected);

    let library = staged().join(LIBRARIES);
    let dynamic = run(command("readelf").arg("-d").arg(library.join("libsuperhelix.so")));
    assert!(dynamic.contains(&format!("Library soname: [libsuperhelix.so.{}]", major())), "{dynamic}");
    for link in ["libsuperhelix.so".to_string(), format!("libsuperhelix.so.{}", major())] {
        let real = std::fs::canonicalize(library.join(&link)).expect("a link that leads somewhere");
        assert!(real.ends_with(format!("libsuperhelix.so.{VERSION}")), "{}", real.display());
        assert!(std::fs::read_link(library.join(link)).expect("a link").is_relative());
    }
}

#[test]
fn no_file_names_a_path_of_the_machine_that_built_it() {
    for name in files(staged()) {
        if name.ends_with(".pc") || name.ends_with(".cmake") {
            let text = std::fs::read_to_string(staged().join(&name)).expect("text");
            for path in [root().display().to_string(), "/opt/hair".to_string()] {
                assert!(!text.contains(&path), "{name} names {path}:\n{text}");
            }
        }
    }
}

#[test]
fn uninstalling_leaves_other_files() {
    let destdir = Folder::new();
    run(&mut make("install", destdir.path()));
    let others = ["opt/hair/include/other.h", "opt/hair/lib/multiarch/cmake/superhelix/site.cmake"];
    for other in others {
        destdir.write(other, "");
    }
    run(&mut make("uninstall", destdir.path()));
    assert_eq!(files(destdir.path()), others);
    assert!(!destdir.path().join("opt/hair/share/licenses/superhelix").exists());
}

#[test]
fn directories_outside_the_prefix_are_found() {
    let destdir = Folder::new();
    let mut install = command(root().join("scripts/install.sh"));
    install.env("SHX_BUILD_DIR", built()).env("DESTDIR", destdir.path()).env("PREFIX", "/usr/local");
    run(install.env("LIBDIR", "/lib64").env("INCLUDEDIR", "include/hair"));
    assert!(destdir.path().join("usr/local/include/hair/superhelix.h").exists());
    let file = std::fs::read_to_string(destdir.path().join("lib64/pkgconfig/superhelix.pc")).expect("superhelix.pc");
    assert!(file.contains("prefix=${pcfiledir}/../../usr/local\n"), "{file}");
    assert!(file.contains("\nlibdir=/lib64\n") && file.contains("\nincludedir=${prefix}/include/hair\n"), "{file}");
    let targets = destdir.path().join("lib64/cmake/superhelix/superhelixTargets.cmake");
    let targets = std::fs::read_to_string(targets).expect("the targets");
    assert!(
        targets.contains("${CMAKE_CURRENT_LIST_DIR}/../../../usr/local\"") && targets.contains("/../../lib64\""),
        "{targets}"
    );
}

#[test]
fn bad_arguments_are_named_and_install_nothing() {
    let destdir = Folder::new();
    let install = || {
        let mut install = command(root().join("scripts/install.sh"));
        install.env("SHX_BUILD_DIR", built()).env("DESTDIR", destdir.path());
        install
    };
    let message = refused(install().env("PREFIX", "opt/hair"));
    assert!(message.contains("PREFIX is 'opt/hair': it must be an absolute path"), "{message}");
    let message = refused(install().env("SHX_BUILD_DIR", destdir.path().join("nothing")));
    assert!(message.contains("nothing holds no library: run 'make lib' first"), "{message}");
    let message = refused(install().arg("--remove"));
    assert!(message.contains("unknown argument '--remove'"), "{message}");
    assert_eq!(files(destdir.path()), Vec::<String>::new());
    let message = refused(command(root().join("scripts/build_lib.sh")).env("SHX_LINKAGE", "dynamic"));
    assert!(message.contains("SHX_LINKAGE is 'dynamic': it must be shared, static or both"), "{message}");
}

/// The loader finds the library by its links: `ldconfig` makes of the folder the links that are there.
#[test]
fn the_loader_would_make_the_same_links() {
    let library: PathBuf = staged().join(LIBRARIES);
    let listed = output(command("/sbin/ldconfig").args(["-n", "-N", "-v"]).arg(&library));
    let listed = String::from_utf8_lossy(&listed.stdout).into_owned();
    assert!(listed.contains(&format!("libsuperhelix.so.{} -> libsuperhelix.so.{VERSION}", major())), "{listed}");
}
