//! Follicles on scalps: as far apart as promised, as dense as the map, in frames that are orthonormal, smooth and move with the mesh.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::Error;
use superhelix::hair::{Amount, Density, Follicle, Jitter, Scalp, ScatterOptions};
use superhelix::io::obj_mesh;

/// A square of `side` m in the plane z = 0, cut into n × n × 2 triangles, u along x and v along y from 0 to 1.
fn square(side: f64, n: usize) -> Scalp {
    let mut vertices = Vec::new();
    for row in 0..=n {
        vertices.extend((0..=n).map(|column| Vector3::new(column as f64, row as f64, 0.0) * (side / n as f64)));
    }
    let mut triangles = Vec::new();
    for row in 0..n {
        for column in 0..n {
            let at = |x: usize, y: usize| ((row + y) * (n + 1) + column + x) as u32;
            triangles.push([at(0, 0), at(1, 0), at(1, 1)]);
            triangles.push([at(0, 0), at(1, 1), at(0, 1)]);
        }
    }
    let uvs = triangles
        .iter()
        .map(|t: &[u32; 3]| t.map(|vertex| [vertices[vertex as usize].x, vertices[vertex as usize].y].map(|x| x / side)));
    let uvs = uvs.collect();
    Scalp::new(vertices, triangles, Some(uvs), Vector3::x()).expect("a square")
}

/// A sphere of longitudes u and latitudes v, without its poles.
fn sphere(radius: f64, n: usize) -> Scalp {
    let (mut vertices, mut triangles, mut uvs) = (Vec::new(), Vec::new(), Vec::new());
    let (columns, rows) = (2 * n, n);
    for row in 0..=rows {
        let latitude = (row as f64 / rows as f64 - 0.5) * 2.8;
        vertices.extend((0..columns).map(|column| {
            let longitude = std::f64::consts::TAU * column as f64 / columns as f64;
            Vector3::new(latitude.cos() * longitude.cos(), latitude.cos() * longitude.sin(), latitude.sin()) * radius
        }));
    }
    for row in 0..rows {
        for column in 0..columns {
            let at = |x: usize, y: usize| ((row + y) * columns + (column + x) % columns) as u32;
            let uv = |x: usize, y: usize| [(column + x) as f64 / columns as f64, (row + y) as f64 / rows as f64];
            triangles.push([at(0, 0), at(1, 0), at(1, 1)]);
            uvs.push([uv(0, 0), uv(1, 0), uv(1, 1)]);
            triangles.push([at(0, 0), at(1, 1), at(0, 1)]);
            uvs.push([uv(0, 0), uv(1, 1), uv(0, 1)]);
        }
    }
    Scalp::new(vertices, triangles, Some(uvs), Vector3::x()).expect("a sphere")
}

fn bust() -> Scalp {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/grooms/sintel_bust.obj");
    let mesh = obj_mesh::read(path).expect("a bust");
    Scalp::new(mesh.vertices.iter().map(|p| p * 0.01).collect(), mesh.triangles, None, Vector3::x()).expect("a scalp")
}

fn scatter(scalp: &Scalp, amount: Amount, density: Density, seed: u64) -> (Vec<Follicle>, f64) {
    let scattered = scalp.scatter(&ScatterOptions { amount, density, seed }).expect("follicles");
    scalp.check_follicles("follicles", &scattered.follicles).expect("on the scalp");
    (scattered.follicles, scattered.least_distance)
}

/// The least straight distance, and the mean distance to the nearest.
fn nearness(scalp: &Scalp, follicles: &[Follicle]) -> (f64, f64) {
    let places: Vec<_> = follicles.iter().map(|follicle| scalp.place(follicle)).collect();
    let nearest: Vec<f64> = (0..places.len())
        .map(|a| {
            let others = places.iter().enumerate().filter(|(b, _)| *b != a);
            others.map(|(_, b)| (b - places[a]).norm_squared()).fold(f64::INFINITY, f64::min).sqrt()
        })
        .collect();
    (nearest.iter().copied().fold(f64::INFINITY, f64::min), nearest.iter().sum::<f64>() / nearest.len() as f64)
}

#[test]
fn no_two_are_nearer_than_the_spacing_and_there_is_no_room_for_more() {
    let scalp = square(0.1, 6);
    let spacing = 0.004;
    let (follicles, least) = scatter(&scalp, Amount::Spacing(spacing), Density::Uniform, 1);
    let (nearest, _) = nearness(&scalp, &follicles);
    assert!(nearest >= spacing * (1.0 - 1e-6), "{nearest}");
    assert!((least / nearest - 1.0).abs() < 1e-6, "{least} {nearest}");
    // Of the closest packing (0.1²·2/(√3 r²) = 721) one that leaves no room has a third or more; disks that come at random one after the other end
    // at 0.6 (0.547 of the area against 0.907), of these few candidates at a half.
    let closest = 0.01 * 2.0 / (3.0_f64.sqrt() * spacing * spacing);
    assert!(
        follicles.len() as f64 > 0.54 * closest && (follicles.len() as f64) < closest * 1.1,
        "{} of {closest}",
        follicles.len()
    );
    // Nowhere (but for what the candidates left out) a hole with room for another.
    let places: Vec<_> = follicles.iter().map(|f| scalp.place(f)).collect();
    for row in 0..100 {
        for column in 0..100 {
            let here = Vector3::new(f64::from(column) + 0.5, f64::from(row) + 0.5, 0.0) * 1e-3;
            let away = places.iter().map(|p| (p - here).norm()).fold(f64::INFINITY, f64::min);
            assert!(away < 1.3 * spacing, "{here} {away}");
        }
    }
}

#[test]
fn a_count_is_kept_with_most_of_the_distance_that_there_can_be() {
    for scalp in [square(0.1, 6), sphere(0.05, 12), bust()] {
        for count in [1, 2, 500] {
            let (follicles, least) = scatter(&scalp, Amount::Count(count), Density::Uniform, 7);
            assert_eq!(follicles.len(), count);
            if count < 3 {
                continue;
            }
            let most = 2.0 * (scalp.area() / (2.0 * 3.0_f64.sqrt() * count as f64)).sqrt();
            // Yuksel 2015, figure 6, has 0.75 and more for five candidates; random points have 1/count of it.
            assert!(least > 0.6 * most, "{} of the most", least / most);
            let (_, mean) = nearness(&scalp, &follicles);
            assert!(mean > 0.65 * most && mean < 1.05 * most, "{} of the most", mean / most);
        }
        assert_eq!(scatter(&scalp, Amount::Count(0), Density::Uniform, 7).0, []);
    }
}

#[test]
fn on_a_sphere_distances_are_arcs() {
    // Spacing of a third of the radius: chords may be shorter than it, arcs not (to what a mesh of 40 rows is off a sphere).
    let (radius, spacing) = (0.1, 0.05);
    let scalp = sphere(radius, 40);
    let (follicles, _) = scatter(&scalp, Amount::Spacing(spacing), Density::Uniform, 3);
    let places: Vec<_> = follicles.iter().map(|f| scalp.place(f).normalize()).collect();
    let mut least = f64::INFINITY;
    for (index, a) in places.iter().enumerate() {
        for b in &places[index + 1..] {
            least = least.min(radius * a.angle(b));
        }
    }
    assert!(least > spacing * 0.995 && least < spacing * 1.1, "{least}");
}

#[test]
fn the_two_sides_of_a_sheet_do_not_see_each_other() {
    // Two squares 0.1 mm apart, back to back: each as full as one alone.
    let one = square(0.1, 3);
    let count = one.vertices().len() as u32;
    let mut vertices = one.vertices().to_vec();
    vertices.extend(one.vertices().iter().map(|p| p - Vector3::z() * 1e-4));
    let mut triangles = one.triangles().to_vec();
    triangles.extend(one.triangles().iter().map(|[a, b, c]| [a + count, c + count, b + count]));
    let both = Scalp::new(vertices, triangles, None, Vector3::x()).expect("a sheet");
    let alone = scatter(&one, Amount::Spacing(0.005), Density::Uniform, 1).0.len() as f64;
    let together = scatter(&both, Amount::Spacing(0.005), Density::Uniform, 1).0.len() as f64;
    assert!((together / alone - 2.0).abs() < 0.1, "{together} {alone}");
}

/// Pearson's statistic of follicles in bands of x against expected shares, over the number of bands less one.
fn chi_square(scalp: &Scalp, follicles: &[Follicle], side: f64, shares: &[f64]) -> f64 {
    let mut bins = vec![0.0; shares.len()];
    for follicle in follicles {
        bins[((scalp.place(follicle).x / side * shares.len() as f64) as usize).min(shares.len() - 1)] += 1.0;
    }
    let total = follicles.len() as f64;
    let sum: f64 = bins.iter().zip(shares).map(|(bin, share)| (bin - total * share).powi(2) / (total * share)).sum();
    sum / (shares.len() - 1) as f64
}

#[test]
fn density_follows_the_map() {
    let side = 0.1;
    let scalp = square(side, 10);
    let bands = 10;
    // From 0.2 to 1 along x, linear: by vertices, and as a picture (finer than the bands).
    let density = |x: f64| 0.2 + 0.8 * x;
    let by_vertices = Density::Vertices(scalp.vertices().iter().map(|p| density(p.x / side)).collect());
    let width = 400;
    let picture =
        Density::Picture { width, height: 1, values: (0..width).map(|k| density((k as f64 + 0.5) / width as f64)).collect() };
    let shares: Vec<f64> = (0..bands).map(|k| density((k as f64 + 0.5) / bands as f64) / (0.6 * bands as f64)).collect();
    let even = vec![1.0 / bands as f64; bands];
    for map in [by_vertices, picture] {
        for seed in 0..3 {
            let (follicles, _) = scatter(&scalp, Amount::Count(2000), map.clone(), seed);
            // Independent points would have 1 with a deviation of √(2/9) = 0.47; blue noise has less. The wrong map has some 50.
            let found = chi_square(&scalp, &follicles, side, &shares);
            assert!(found < 1.5, "{found}");
            let wrong = chi_square(&scalp, &follicles, side, &even);
            assert!(wrong > 20.0, "{wrong}");
        }
    }
    // Nothing where the density is 0.
    let half = Density::Picture { width: 1, height: 4, values: vec![0.0, 0.0, 1.0, 1.0] };
    let (follicles, _) = scatter(&scalp, Amount::Count(300), half, 0);
    let rows: Vec<f64> = follicles.iter().map(|f| scalp.place(f).y / side).collect();
    assert!(
        !rows.iter().any(|y| (0.125..0.375).contains(y)) && rows.iter().filter(|y| (0.625..0.875).contains(*y)).count() > 120
    );
    // Maps that are multiplied: bands times quarters across them; what one leaves bare stays bare.
    let by_vertices = Density::Vertices(scalp.vertices().iter().map(|p| density(p.x / side)).collect());
    let upper = Density::Picture { width: 1, height: 4, values: vec![0.0, 0.0, 1.0, 1.0] };
    let (follicles, _) = scatter(&scalp, Amount::Count(2000), Density::Product(vec![by_vertices, upper]), 0);
    assert!(!follicles.iter().any(|f| (0.125..0.375).contains(&(scalp.place(f).y / side))));
    let found = chi_square(&scalp, &follicles, side, &shares);
    assert!(found < 1.5, "{found}");
    // A spacing is kept where the density is the largest, and grows as its root falls.
    let quarter = Density::Vertices(scalp.vertices().iter().map(|p| if p.x < 0.5 * side { 0.25 } else { 1.0 }).collect());
    let (follicles, _) = scatter(&scalp, Amount::Spacing(0.003), quarter, 0);
    let (sparse, dense): (Vec<_>, Vec<_>) = follicles.into_iter().partition(|f| scalp.place(f).x < 0.4 * side);
    let dense: Vec<_> = dense.into_iter().filter(|f| scalp.place(f).x > 0.5 * side).collect();
    assert!(nearness(&scalp, &dense).0 >= 0.003 * (1.0 - 1e-6));
    assert!(nearness(&scalp, &sparse).0 >= 0.006 * (1.0 - 1e-6));
    // A quarter as many to the area: 0.4 and 0.5 of the square.
    let ratio = (sparse.len() as f64 / 0.4) / (dense.len() as f64 / 0.5);
    assert!((ratio - 0.25).abs() < 0.03, "{ratio}");
}

#[test]
fn the_seed_decides() {
    let scalp = bust();
    let of = |seed| scatter(&scalp, Amount::Count(200), Density::Uniform, seed).0;
    assert_eq!(of(4), of(4));
    assert_ne!(of(4), of(5));
}

#[test]
fn frames_are_orthonormal_and_along_normal_and_u() {
    let scalp = sphere(0.1, 60);
    let (follicles, _) = scatter(&scalp, Amount::Count(300), Density::Uniform, 2);
    let frames = scalp.frames(scalp.vertices(), &follicles).expect("frames");
    for (frame, follicle) in frames.iter().zip(&follicles) {
        assert_eq!(frame.origin, scalp.place(follicle));
        let out = frame.origin.normalize();
        let east = Vector3::z().cross(&out).normalize();
        // Rows of 0.047 rad: on the mesh's border, where vertices have triangles on one side only, normals are half a row off.
        let turned = frame.rotation.to_rotation_matrix();
        let off = if out.z.abs() < 0.95 { 0.003 } else { 0.03 };
        assert!((turned * Vector3::x()).angle(&out) < off, "{} {}", (turned * Vector3::x()).angle(&out), out.z);
        assert!((turned * Vector3::y()).angle(&east) < off, "{} {}", (turned * Vector3::y()).angle(&east), out.z);
        assert!((turned.matrix().determinant() - 1.0).abs() < 1e-12);
    }
    // Across triangles: along a line, frames turn by no more than the distance permits.
    let uvs: Vec<_> = (0..4000).map(|k| [0.1 + 2e-4 * f64::from(k), 0.2 + 1.5e-4 * f64::from(k)]).collect();
    let line = scalp.follicles_at(&uvs, Jitter::default()).expect("on the scalp");
    let frames = scalp.frames(scalp.vertices(), &line).expect("frames");
    for pair in frames.windows(2) {
        let (turned, gone) = (pair[0].rotation.angle_to(&pair[1].rotation), (pair[1].origin - pair[0].origin).norm());
        assert!(turned < 60.0 * gone, "{turned} {gone}");
    }
    assert!(line.iter().map(|f| f.triangle).collect::<std::collections::BTreeSet<_>>().len() > 50);
}

#[test]
fn roots_go_with_the_mesh() {
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.7, -1.1, 2.0));
    let shift = Vector3::new(1.0, -2.0, 0.5);
    for scalp in [sphere(0.1, 10), bust()] {
        let (follicles, _) = scatter(&scalp, Amount::Count(300), Density::Uniform, 2);
        let rest = scalp.frames(scalp.vertices(), &follicles).expect("frames");
        let moved: Vec<_> = scalp.vertices().iter().map(|p| turn * p + shift).collect();
        for (before, after) in rest.iter().zip(scalp.frames(&moved, &follicles).expect("frames")) {
            assert!((turn * before.origin + shift - after.origin).norm() < 1e-12);
            assert!((turn * before.rotation).angle_to(&after.rotation) < 1e-9);
        }
    }
    // A sheared square: origins shear, n0 stays across, n1 goes with the material direction of u.
    let scalp = square(0.1, 4);
    let (follicles, _) = scatter(&scalp, Amount::Count(100), Density::Uniform, 2);
    let shear = |p: &Vector3<f64>| Vector3::new(p.x, p.y + 0.5 * p.x, 0.3 * p.x);
    let moved: Vec<_> = scalp.vertices().iter().map(shear).collect();
    let along = Vector3::new(1.0, 0.5, 0.3).normalize();
    let normal = along.cross(&Vector3::y()).normalize();
    for (follicle, frame) in follicles.iter().zip(scalp.frames(&moved, &follicles).expect("frames")) {
        assert!((frame.origin - shear(&scalp.place(follicle))).norm() < 1e-12);
        assert!((frame.rotation * Vector3::x() - normal).norm() < 1e-9);
        assert!((frame.rotation * Vector3::y() - along).norm() < 1e-9);
    }
}

#[test]
fn texture_coordinates_are_found_and_jittered() {
    let scalp = square(0.1, 7);
    let uvs: Vec<_> = (0..400).map(|k| [f64::from(k % 20) / 19.0, f64::from(k / 20) / 19.0]).collect();
    for (uv, follicle) in uvs.iter().zip(scalp.follicles_at(&uvs, Jitter::default()).expect("on the square")) {
        assert!((scalp.place(&follicle) - Vector3::new(uv[0], uv[1], 0.0) * 0.1).norm() < 1e-9);
    }
    let amplitude = 0.02;
    let jittered = scalp.follicles_at(&uvs, Jitter { amplitude, seed: 1 }).expect("on the square");
    let offsets: Vec<_> =
        uvs.iter().zip(&jittered).map(|(uv, f)| scalp.place(f) * 10.0 - Vector3::new(uv[0], uv[1], 0.0)).collect();
    assert!(offsets.iter().all(|offset| offset.x.abs() <= amplitude + 1e-9 && offset.y.abs() <= amplitude + 1e-9));
    let inside: Vec<_> = uvs.iter().zip(&offsets).filter(|(uv, _)| uv.iter().all(|x| (0.1..0.9).contains(x))).collect();
    // Uniform in ± the amplitude: a mean square of its third, known to 0.9/√n of it.
    let square_mean = inside.iter().map(|(_, offset)| offset.x * offset.x).sum::<f64>() / inside.len() as f64;
    assert!(
        (square_mean / (amplitude * amplitude / 3.0) - 1.0).abs() < 4.0 * 0.9 / (inside.len() as f64).sqrt(),
        "{square_mean}"
    );
    assert_ne!(jittered, scalp.follicles_at(&uvs, Jitter { amplitude, seed: 2 }).expect("on the square"));
}

#[test]
fn bad_input_is_named() {
    let refused = |result: Result<(), Error>, name: &str| match result {
        Err(Error::InvalidArgument { argument, .. }) => assert!(argument.contains(name), "{argument} in place of {name}"),
        other => panic!("{name}: {other:?}"),
    };
    let corners = vec![Vector3::zeros(), Vector3::x(), Vector3::y()];
    let new = |vertices: Vec<Vector3<f64>>, triangles, uvs, axis| Scalp::new(vertices, triangles, uvs, axis).map(|_| ());
    refused(
        new(vec![Vector3::zeros(), Vector3::x(), Vector3::repeat(f64::NAN)], vec![[0, 1, 2]], None, Vector3::x()),
        "vertices[2][0]",
    );
    refused(new(corners.clone(), vec![[0, 1, 3]], None, Vector3::x()), "triangles[0]");
    refused(new(corners.clone(), vec![], None, Vector3::x()), "triangles");
    refused(new(corners.clone(), vec![[0, 1, 1]], None, Vector3::x()), "triangles");
    refused(new(corners.clone(), vec![[0, 1, 2]], None, Vector3::zeros()), "reference");
    refused(new(corners.clone(), vec![[0, 1, 2]], Some(vec![]), Vector3::x()), "uvs (count)");
    refused(new(corners.clone(), vec![[0, 1, 2]], Some(vec![[[f64::INFINITY; 2]; 3]]), Vector3::x()), "uvs[0]");

    let scalp = square(0.1, 2);
    let plain = Scalp::new(corners, vec![[0, 1, 2]], None, Vector3::x()).expect("a triangle");
    let scatter = |scalp: &Scalp, amount, density| scalp.scatter(&ScatterOptions { amount, density, seed: 0 }).map(|_| ());
    let one = Amount::Count(1);
    refused(scatter(&scalp, Amount::Spacing(0.0), Density::Uniform), "spacing");
    refused(scatter(&scalp, Amount::Spacing(f64::NAN), Density::Uniform), "spacing");
    refused(scatter(&scalp, Amount::Spacing(1e-9), Density::Uniform), "spacing");
    refused(scatter(&scalp, Amount::Count(usize::MAX), Density::Uniform), "count");
    refused(scatter(&scalp, one, Density::Vertices(vec![1.0; 8])), "density (count)");
    refused(scatter(&scalp, one, Density::Vertices(vec![-1.0; 9])), "density[0]");
    refused(scatter(&scalp, one, Density::Vertices(vec![0.0; 9])), "density");
    refused(scatter(&scalp, one, Density::Picture { width: 2, height: 2, values: vec![1.0; 3] }), "density (count)");
    refused(scatter(&plain, one, Density::Picture { width: 1, height: 1, values: vec![1.0] }), "density");
    let product = Density::Product(vec![Density::Uniform, Density::Vertices(vec![1.0; 8])]);
    refused(scatter(&scalp, one, product), "density (count)");
    refused(plain.follicles_at(&[[0.0; 2]], Jitter::default()).map(|_| ()), "scalp");
    refused(scalp.follicles_at(&[[0.5, 0.5], [1.5, 0.0]], Jitter::default()).map(|_| ()), "uvs[1]");
    refused(scalp.follicles_at(&[[f64::NAN, 0.0]], Jitter::default()).map(|_| ()), "uvs[0][0]");
    refused(scalp.follicles_at(&[], Jitter { amplitude: -1.0, seed: 0 }).map(|_| ()), "jitter");
    let follicle = |triangle, shares| scalp.frames(scalp.vertices(), &[Follicle { triangle, shares }]).map(|_| ());
    refused(follicle(8, [0.0; 2]), "follicles[0].triangle");
    refused(follicle(0, [0.8, 0.8]), "follicles[0].shares");
    refused(follicle(0, [f64::NAN, 0.0]), "follicles[0].shares");
    refused(scalp.frames(&scalp.vertices()[1..], &[]).map(|_| ()), "vertices (count)");
    let mut bad = scalp.vertices().to_vec();
    bad[3].z = f64::NAN;
    refused(scalp.frames(&bad, &[]).map(|_| ()), "vertices[3][2]");
}
