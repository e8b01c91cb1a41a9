//! Caches: one file per frame, written completely or not at all.

use std::path::{Path, PathBuf};

use superhelix::Error;
use superhelix::io::{CacheFormat, Curves, Existing, Sequence, SequenceWriter, hair, obj};

/// A directory of its own, deleted at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("sequence_{name}"));
        let _ = std::fs::remove_dir_all(&path);
        Self(path)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn frame(number: u32) -> Curves {
    let x = number as f32;
    Curves::from_strands(&[vec![[x, 0.0, 0.0], [x, 1.0, 0.5]], vec![[x, 2.0, 0.0], [x, 3.0, 0.1], [x, 4.0, 0.2]]]).unwrap()
}

fn names(directory: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        std::fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn frames_come_back_in_order() {
    for (format, extension) in [(CacheFormat::Obj, "obj"), (CacheFormat::Hair, "hair")] {
        let scratch = Scratch::new(extension);
        let directory = scratch.0.join("deep/er");
        let mut writer = SequenceWriter::create(&directory, "walk", format, 9998, Existing::Refuse).unwrap();
        for number in 0..4 {
            let curves = frame(number);
            let path = match number {
                0 => writer.write(&curves).unwrap(),
                _ => writer.write_points(curves.counts(), curves.points()).unwrap(),
            };
            assert_eq!(path, directory.join(format!("walk.{}.{extension}", 9998 + number)));
        }
        assert_eq!(writer.frame_count(), 4);
        // Nothing but the frames is left.
        assert_eq!(names(&directory).len(), 4);
        // Files of other names do not count.
        for other in
            ["walk.obj", "walk.12.obj", "walk.12.hair", "walk2.0001.obj", "walk2.0001.hair", "walk.00x1.obj", "walk.0001.txt"]
        {
            std::fs::write(directory.join(other), "").unwrap();
        }
        let sequence = Sequence::list(&directory, "walk", format).unwrap();
        assert_eq!(sequence.frames().iter().map(|(number, _)| *number).collect::<Vec<_>>(), [9998, 9999, 10000, 10001]);
        for index in 0..4 {
            let read = sequence.read(index).unwrap();
            assert_eq!((read.counts(), read.points()), (frame(index as u32).counts(), frame(index as u32).points()));
        }
        assert!(matches!(sequence.read(4), Err(Error::InvalidArgument { argument, .. }) if argument == "index"));
    }
}

#[test]
fn an_earlier_cache_is_refused_or_replaced() {
    let scratch = Scratch::new("existing");
    let create = |existing| SequenceWriter::create(&scratch.0, "a", CacheFormat::Obj, 1, existing);
    let mut writer = create(Existing::Refuse).unwrap();
    for number in 0..3 {
        writer.write(&frame(number)).unwrap();
    }
    std::fs::write(scratch.0.join("a.0001.hair"), "another format").unwrap();
    std::fs::write(scratch.0.join("notes.txt"), "of the user").unwrap();
    assert!(matches!(create(Existing::Refuse), Err(Error::File { path, .. }) if path.ends_with("a.0001.obj")));
    assert_eq!(names(&scratch.0).len(), 5);
    create(Existing::Replace).unwrap().write(&frame(7)).unwrap();
    assert_eq!(names(&scratch.0), ["a.0001.hair", "a.0001.obj", "notes.txt"]);
}

#[test]
fn failures_name_the_path_and_leave_nothing() {
    let scratch = Scratch::new("failures");
    std::fs::create_dir_all(&scratch.0).unwrap();
    let in_the_way = scratch.0.join("file");
    std::fs::write(&in_the_way, "").unwrap();
    let error = SequenceWriter::create(&in_the_way, "a", CacheFormat::Obj, 1, Existing::Refuse).unwrap_err();
    assert!(matches!(error, Error::File { path, .. } if path == in_the_way.display().to_string()));

    // A directory stands where the frame should go: the frame fails, and the next call tries the same number.
    let mut writer = SequenceWriter::create(&scratch.0, "a", CacheFormat::Hair, 1, Existing::Refuse).unwrap();
    let frame_path = scratch.0.join("a.0001.hair");
    std::fs::create_dir(&frame_path).unwrap();
    let error = writer.write(&frame(0)).unwrap_err();
    assert!(
        matches!(&error, Error::File { path, reason } if *path == frame_path.display().to_string() && reason.contains("written"))
    );
    assert_eq!(names(&scratch.0), ["a.0001.hair", "file"]);
    std::fs::remove_dir(&frame_path).unwrap();
    assert_eq!(writer.write(&frame(0)).unwrap(), frame_path);
    assert_eq!(writer.frame_count(), 1);

    assert!(matches!(writer.write_points(&[1], &[[0.0; 3]]), Err(Error::InvalidArgument { .. })));
    for stem in ["", ".", "..", "a/b", "/a", "a\\b", "a/"] {
        let error = SequenceWriter::create(&scratch.0, stem, CacheFormat::Obj, 1, Existing::Refuse).unwrap_err();
        assert!(matches!(error, Error::InvalidArgument { argument, .. } if argument == "stem"), "{stem:?}");
    }
    // The directory disappears under the writer.
    std::fs::remove_dir_all(&scratch.0).unwrap();
    assert!(matches!(writer.write(&frame(1)), Err(Error::File { path, .. }) if path.ends_with("a.0002.hair")));
}

/// A full disk, played by a device that is one.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    for result in [obj::write("/dev/full", &frame(0)), hair::write("/dev/full", &frame(0))] {
        assert!(
            matches!(result, Err(Error::File { path, reason }) if path == "/dev/full" && reason.contains("cannot be written"))
        );
    }
}

#[test]
fn gaps_and_doubles_are_refused() {
    let scratch = Scratch::new("gaps");
    std::fs::create_dir_all(&scratch.0).unwrap();
    assert!(
        matches!(Sequence::list(&scratch.0, "a", CacheFormat::Obj), Err(Error::File { reason, .. }) if reason.contains("no frame"))
    );
    for name in ["a.0001.obj", "a.0002.obj", "a.0004.obj"] {
        std::fs::write(scratch.0.join(name), "").unwrap();
    }
    let gap = Sequence::list(&scratch.0, "a", CacheFormat::Obj).unwrap_err();
    assert!(matches!(gap, Error::File { path, reason } if path.ends_with("a.0003.obj") && reason.contains("missing")));
    std::fs::write(scratch.0.join("a.00002.obj"), "").unwrap();
    let double = Sequence::list(&scratch.0, "a", CacheFormat::Obj).unwrap_err();
    assert!(matches!(double, Error::File { reason, .. } if reason.contains("exists twice")));
    assert!(Sequence::list(scratch.0.join("none"), "a", CacheFormat::Obj).is_err());
}

#[test]
fn the_last_frame_number_is_the_last() {
    let scratch = Scratch::new("last");
    let mut writer = SequenceWriter::create(&scratch.0, "a", CacheFormat::Obj, u32::MAX, Existing::Refuse).unwrap();
    writer.write(&frame(0)).unwrap();
    assert!(matches!(writer.write(&frame(1)), Err(Error::File { reason, .. }) if reason.contains("4294967295")));
    assert_eq!(Sequence::list(&scratch.0, "a", CacheFormat::Obj).unwrap().frames()[0].0, u32::MAX);
}
