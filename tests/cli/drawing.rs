//! `superhelix picture` draws hair: light, occlusion, bodies beside a cache, animations.

use std::path::Path;

use nalgebra::{Rotation3, Vector3};
use superhelix::io::{Curves, hair, obj};

use crate::support::{data, directory, errors, superhelix};

type Strands = Vec<Vec<[f32; 3]>>;

/// Pixels as a screen has them.
struct Picture {
    width: usize,
    height: usize,
    pixels: Vec<[f64; 3]>,
}

impl Picture {
    fn read(path: &Path) -> Self {
        let picture = tiny_skia::Pixmap::load_png(path).unwrap();
        let pixels = picture.pixels().iter().map(|pixel| [pixel.red(), pixel.green(), pixel.blue()].map(f64::from)).collect();
        Self { width: picture.width() as usize, height: picture.height() as usize, pixels }
    }

    /// A pixel by its place as shares of the width and height.
    fn at(&self, right: f64, down: f64) -> [f64; 3] {
        self.pixels[(down * self.height as f64) as usize * self.width + (right * self.width as f64) as usize]
    }

    /// Mean brightness of the places that `within` picks by shares of the width and height.
    fn brightness(&self, within: impl Fn(f64, f64) -> bool) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for (index, pixel) in self.pixels.iter().enumerate() {
            let (right, down) =
                ((index % self.width) as f64 / self.width as f64, (index / self.width) as f64 / self.height as f64);
            if within(right, down) {
                (sum, count) = (sum + pixel.iter().sum::<f64>() / 3.0, count + 1.0);
            }
        }
        assert!(count > 10.0);
        sum / count
    }
}

/// Draws something alone in its cell, 200 pixels wide.
fn draw(input: &Path, out: &Path, flags: &[&str]) -> Picture {
    let fixed =
        ["picture", input.to_str().unwrap(), "--out", out.to_str().unwrap(), "--plain", "--moments", "1", "--cell", "200"];
    let output = superhelix(&[&fixed[..], flags].concat());
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    Picture::read(out)
}

fn write(path: &Path, strands: &Strands) {
    hair::write(path, &Curves::from_strands(strands).unwrap()).unwrap();
}

/// Points spread evenly over the unit sphere (a Fibonacci lattice).
fn sphere(count: usize) -> impl Iterator<Item = Vector3<f64>> {
    (0..count).map(move |k| {
        let z = 1.0 - (2 * k + 1) as f64 / count as f64;
        let around = k as f64 * 2.399_963_229_728_653;
        let across = (1.0 - z * z).sqrt();
        Vector3::new(across * around.cos(), z, across * around.sin())
    })
}

/// A ball of 10 cm with hair that lies on it, combed down.
fn ball(count: usize) -> Strands {
    sphere(count)
        .map(|normal| {
            let down = (normal * normal.y - Vector3::y()).try_normalize(1e-3).unwrap_or_else(Vector3::x);
            (0..9)
                .map(|k| {
                    let along = 0.03 * f64::from(k);
                    let lying = normal * along.cos() + down * along.sin();
                    (lying * (0.1 + 0.02 * along)).map(|value| value as f32).into()
                })
                .collect()
        })
        .collect()
}

/// The mesh of that ball.
fn write_ball(path: &Path) {
    let mut text = String::new();
    for ring in 0..=16 {
        for place in 0..32 {
            let (down, around) = (f64::from(ring) / 16.0 * std::f64::consts::PI, f64::from(place) / 16.0 * std::f64::consts::PI);
            let (x, y, z) = (down.sin() * around.sin(), down.cos(), down.sin() * around.cos());
            text += &format!("v {} {} {}\n", 0.099 * x, 0.099 * y, 0.099 * z);
        }
    }
    for ring in 0..16 {
        for place in 0..32 {
            let at = |ring: usize, place: usize| 32 * ring + place % 32 + 1;
            let [a, b, c, d] = [at(ring, place), at(ring + 1, place), at(ring + 1, place + 1), at(ring, place + 1)];
            // At the poles corners coincide.
            text += &if ring == 0 { format!("f {a} {b} {c}\n") } else { format!("f {a} {b} {d}\nf {b} {c} {d}\n") };
        }
    }
    std::fs::write(path, text).unwrap();
}

/// Hair that hangs in the plane of a depth.
fn curtain(depth: f32) -> Strands {
    (0..400).map(|k| (0..9).map(|j| [0.001 * k as f32 - 0.2, 0.2 - 0.05 * j as f32, depth]).collect()).collect()
}

/// A mesh of a box about a point, wound outward.
fn write_box(path: &Path, middle: [f64; 3], half: [f64; 3], turn: &Rotation3<f64>) {
    let mut text = String::new();
    for corner in 0..8 {
        let side = |axis: usize| if corner >> axis & 1 == 1 { half[axis] } else { -half[axis] };
        let vertex = turn * (Vector3::new(side(0), side(1), side(2)) + Vector3::from(middle));
        text += &format!("v {} {} {}\n", vertex.x, vertex.y, vertex.z);
    }
    text += "f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\nf 5 6 8 7\n";
    std::fs::write(path, text).unwrap();
}

#[test]
fn a_ball_of_hair_is_brighter_towards_the_lamp_and_shades_itself() {
    let place = directory("drawing_ball");
    let body = place.join("ball.obj");
    write_ball(&body);
    write(&place.join("ball.hair"), &ball(8000));
    let flags = ["--views", "front", "--scale", "1", "--body", body.to_str().unwrap()];
    let picture = draw(&place.join("ball.hair"), &place.join("ball.png"), &flags);
    // The key light comes from above on the left; the rim of the right is lit from behind.
    let left = picture.brightness(|right, down| (0.2..0.4).contains(&right) && (0.3..0.5).contains(&down));
    let right = picture.brightness(|right, down| (0.6..0.75).contains(&right) && (0.55..0.75).contains(&down));
    assert!(left > 1.4 * right, "{left} on the left, {right} on the right");

    // Without others about them hairs are brighter.
    let few: Strands = ball(8000).into_iter().step_by(200).collect();
    write(&place.join("few.hair"), &few);
    let flags = ["--views", "front", "--scale", "1", "--hairs", "0", "--colour", "blond"];
    let dense = draw(&place.join("ball.hair"), &place.join("dense.png"), &flags);
    let darkest = |picture: &Picture| picture.pixels.iter().map(|pixel| pixel.iter().sum::<f64>()).fold(f64::INFINITY, f64::min);
    let few = draw(&place.join("few.hair"), &place.join("few.png"), &flags);
    assert!(darkest(&dense) < 0.7 * darkest(&few), "{} and {}", darkest(&dense), darkest(&few));
}

#[test]
fn bodies_hide_the_hair_behind_them_and_no_other() {
    let place = directory("drawing_occlusion");
    let body = place.join("body.obj");
    write_box(&body, [0.0, 0.0, 0.0], [0.1, 0.1, 0.1], &Rotation3::identity());
    let with = |name: &str, depth: f32, colour: &str| {
        let file = place.join(format!("{name}.hair"));
        write(&file, &curtain(depth));
        let flags = ["--views", "front", "--hairs", "0", "--colour", colour, "--body", body.to_str().unwrap()];
        draw(&file, &place.join(format!("{name}_{colour}.png")), &flags)
    };
    let differ = |a: &Picture, b: &Picture, right: f64| {
        let (a, b) = (a.at(right, 0.5), b.at(right, 0.5));
        (0..3).map(|channel| (a[channel] - b[channel]).abs()).fold(0.0, f64::max)
    };
    let (dark, light) = (with("behind", -0.15, "black"), with("behind", -0.15, "blond"));
    assert!(differ(&dark, &light, 0.1) > 20.0, "beside the box there is hair");
    assert!(differ(&dark, &light, 0.5) < 3.0, "hair shows through the box by {}", differ(&dark, &light, 0.5));
    let (dark, light) = (with("before", 0.15, "black"), with("before", 0.15, "blond"));
    assert!(differ(&dark, &light, 0.1) > 20.0 && differ(&dark, &light, 0.5) > 20.0, "hair before the box is seen");
}

/// Three frames of hair on a box that turns, and the boxes themselves.
fn turning(place: &Path) {
    for folder in ["hair", "boxes"] {
        std::fs::create_dir(place.join(folder)).unwrap();
    }
    for frame in 0..3 {
        let turn = Rotation3::from_axis_angle(&Vector3::y_axis(), 0.5 * f64::from(frame));
        let strands: Strands = (0..300)
            .map(|k| {
                let root = Vector3::new(0.01 * f64::from(k % 20) - 0.095, 0.05, 0.01 * f64::from(k / 20) - 0.07);
                (0..7)
                    .map(|j| (turn * (root + Vector3::new(0.0, 0.01, 0.004) * f64::from(j))).map(|value| value as f32).into())
                    .collect()
            })
            .collect();
        obj::write(place.join(format!("hair/h.{frame:04}.obj")), &Curves::from_strands(&strands).unwrap()).unwrap();
        write_box(&place.join(format!("boxes/b.{frame:04}.obj")), [0.0; 3], [0.12, 0.05, 0.09], &turn);
    }
}

#[test]
fn a_body_goes_with_the_roots_as_frames_of_its_own_would_say() {
    let place = directory("drawing_body");
    turning(&place);
    let sheet = |name: &str, body: &Path| {
        let out = place.join(name);
        let (hair, body) = (place.join("hair"), body.to_str().unwrap());
        let arguments = ["picture", hair.to_str().unwrap(), "--out", out.to_str().unwrap(), "--plain", "--cell", "150"];
        let output = superhelix(&[&arguments[..], &["--moments", "3", "--hairs", "0", "--body", body]].concat());
        assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
        Picture::read(&out)
    };
    let followed = sheet("followed.png", &place.join("boxes/b.0000.obj"));
    let given = sheet("given.png", &place.join("boxes"));
    let apart = |a: &Picture, b: &Picture| {
        let difference = |(a, b): (&[f64; 3], &[f64; 3])| (a[0] - b[0]).abs();
        a.pixels.iter().zip(&b.pixels).map(difference).sum::<f64>() / a.pixels.len() as f64
    };
    assert!(apart(&followed, &given) < 0.1, "{}", apart(&followed, &given));
    // Boxes that do not turn differ from ones that do.
    let still = place.join("still");
    std::fs::create_dir(&still).unwrap();
    for frame in 0..3 {
        std::fs::copy(place.join("boxes/b.0000.obj"), still.join(format!("b.{frame:04}.obj"))).unwrap();
    }
    assert!(apart(&followed, &sheet("still.png", &still)) > 1.0);
}

#[test]
fn guides_are_drawn_as_the_hair_that_grows_among_them() {
    let place = directory("drawing_grown");
    let (groom, body) = (data("sintel_hair_001.tfx"), data("sintel_bust.obj"));
    let picture = |name: &str, flags: &[&str]| {
        let fixed = ["--views", "front", "--scale", "0.01", "--body", &body];
        draw(Path::new(&groom), &place.join(name), &[&fixed[..], flags].concat())
    };
    // The crown, which brown hair covers and a few threads do not.
    let crown = |picture: &Picture| picture.brightness(|right, down| (0.4..0.6).contains(&right) && (0.12..0.2).contains(&down));
    let (grown, bare) = (crown(&picture("grown.png", &[])), crown(&picture("bare.png", &["--hairs", "0"])));
    assert!(grown < 0.85 * bare, "{grown} {bare}");
    let lines = picture("lines.png", &["--as", "lines"]);
    let colourful = |picture: &Picture| {
        let spread =
            |pixel: &&[f64; 3]| pixel.iter().fold(0.0, |a: f64, b| a.max(*b)) - pixel.iter().fold(255.0, |a: f64, b| a.min(*b));
        picture.pixels.iter().filter(|pixel| spread(pixel) > 90.0).count()
    };
    assert!(colourful(&lines) > 10 * (1 + colourful(&picture("again.png", &[]))), "lines have the colours of their roots");
}

#[test]
fn an_animation_has_its_frames_and_the_same_bytes_for_any_number_of_threads() {
    let place = directory("drawing_animation");
    turning(&place);
    let (hair, body) = (place.join("hair"), place.join("boxes"));
    let make = |threads: &str| {
        let paths = [format!("sheet_{threads}.png"), format!("animation_{threads}.apng")].map(|name| place.join(name));
        let output = superhelix(&[
            "picture",
            hair.to_str().unwrap(),
            "--out",
            paths[0].to_str().unwrap(),
            "--animate",
            paths[1].to_str().unwrap(),
            "--body",
            body.to_str().unwrap(),
            "--fps",
            "10",
            "--rate",
            "20",
            "--size",
            "120",
            "--cell",
            "120",
            "--views",
            "front,three-quarter",
            "--hairs",
            "3000",
            "--threads",
            threads,
        ]);
        assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
        paths.map(|path| std::fs::read(path).unwrap())
    };
    let one = make("1");
    assert!(one == make("2") && one == make("5"));

    let mut reader = png::Decoder::new(std::io::Cursor::new(&one[1])).read_info().unwrap();
    let control = *reader.info().animation_control().expect("an animation");
    // Three frames of a tenth of a second are five of a twentieth, the last where the cache ends.
    assert_eq!((control.num_frames, control.num_plays), (5, 0));
    assert_eq!(reader.info().width, 2 * 120);
    let mut frames = Vec::new();
    for _ in 0..control.num_frames {
        let mut frame = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut frame).unwrap();
        let delay = reader.info().frame_control().unwrap();
        assert_eq!(20 * u32::from(delay.delay_num), u32::from(delay.delay_den));
        frames.push(frame);
    }
    assert!(frames[0] != frames[2] && frames[2] != frames[4]);
    let mut buffer = vec![0; reader.output_buffer_size().unwrap()];
    assert!(reader.next_frame(&mut buffer).is_err(), "no frame more");
}

#[test]
fn what_cannot_be_drawn_or_animated_names_the_argument_and_leaves_nothing() {
    let place = directory("drawing_errors");
    turning(&place);
    let line = place.join("line");
    std::fs::create_dir(&line).unwrap();
    for frame in 0..2 {
        let strands: Strands = (0..3).map(|k| vec![[k as f32, 0.0, 0.0], [k as f32, 1.0, 0.1 * frame as f32]]).collect();
        obj::write(line.join(format!("l.{frame}.obj")), &Curves::from_strands(&strands).unwrap()).unwrap();
    }
    let path = |name: &str| place.join(name).to_str().unwrap().to_string();
    let (hair, boxes, first, line) = (path("hair"), path("boxes"), path("boxes/b.0000.obj"), path("line"));
    let (sheet, animation) = (path("sheet.png"), path("animation.png"));
    let out = ["--out", sheet.as_str()];
    let animate = ["--animate", animation.as_str()];
    let cases: Vec<(&str, Vec<&str>, &str)> = vec![
        (&hair, vec![], "--out"),
        (&hair, vec!["--out", "sheet.jpg"], "--out"),
        (&hair, vec!["--animate", "walk.gif"], "--animate"),
        (&hair, animate.to_vec(), "--fps"),
        (&hair, [&animate[..], &["--fps", "10", "--rate", "90"]].concat(), "--rate is 90"),
        (&hair, [&out[..], &["--rate", "20"]].concat(), "--animate"),
        (&hair, [&out[..], &["--hairs", "-1"]].concat(), "--hairs"),
        (&hair, [&out[..], &["--views", "top"]].concat(), "--views"),
        (&hair, [&out[..], &["--colour", "green"]].concat(), "--colour"),
        (&hair, [&out[..], &["--as", "wool"]].concat(), "--as"),
        (&hair, [&out[..], &["--body", "no_such_head.obj"]].concat(), "no_such_head.obj"),
        (&hair, [&out[..], &["--body-scale", "1"]].concat(), "--body"),
        (&hair, [&out[..], &["--body", &line]].concat(), "2 meshes"),
        (&line, [&out[..], &["--body", &boxes]].concat(), "3 meshes"),
        (&line, [&out[..], &["--body", &first]].concat(), "--body: the strands' roots lie on a line"),
    ];
    let before = std::fs::read_dir(&place).unwrap().count();
    for (input, flags, named) in cases {
        let output = superhelix(&[&["picture", input], &flags[..]].concat());
        assert_eq!(output.status.code(), Some(1), "{flags:?}: {}", errors(&output));
        assert!(errors(&output).contains(named), "{flags:?}: {}", errors(&output));
        assert_eq!(std::fs::read_dir(&place).unwrap().count(), before, "{flags:?}: something is left behind");
    }
}
