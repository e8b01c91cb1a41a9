//! Signed distance grids.

use nalgebra::Vector3;
use superhelix::Shape;
use superhelix::io::distance_grid;
use superhelix::shapes::{DistanceGrid, Mesh, Sides};

use super::random_bodies::{Dice, ball, bumpy, sheet};

#[test]
fn a_grid_is_near_its_mesh() {
    let (vertices, triangles) = bumpy(0.1, 4);
    let mesh = Mesh::new(vertices, triangles, Sides::Solid).unwrap();
    let mut worst = Vec::new();
    for cell in [0.008, 0.004] {
        let grid = DistanceGrid::bake(&mesh, cell, 0.02).unwrap();
        let mut dice = Dice(4);
        let mut largest: f64 = 0.0;
        for _ in 0..2000 {
            let point = dice.cube() * 0.14;
            let exact = mesh.closest(point, f64::INFINITY).unwrap();
            match grid.closest(point) {
                Some(surface) => {
                    // Distances change by at most the displacement, so a cell's corners differ by at most its diagonal.
                    assert!((surface.distance - exact.distance).abs() < cell * 3f64.sqrt());
                    if exact.distance.abs() < 0.01 {
                        largest = largest.max((surface.distance - exact.distance).abs());
                    }
                }
                None => assert!(exact.distance > 0.02, "{point} {exact:?}"),
            }
        }
        worst.push(largest);
    }
    // On a surface of this roundness (radius of curvature about 2 cm): of second order, h²/8 a direction.
    assert!(worst[0] < 0.3 * 0.008 && worst[1] < 0.6 * worst[0], "{worst:?}");
}

#[test]
fn a_grid_of_a_ball_is_the_ball() {
    // Distance to the faceted ball is within the facets' sagitta of that to the ball; trilinear interpolation adds (3/8) cell²/r.
    let (vertices, triangles) = ball(0.1, 4);
    let mesh = Mesh::new(vertices, triangles, Sides::Solid).unwrap();
    let grid = DistanceGrid::bake(&mesh, 0.005, 0.03).unwrap();
    let mut dice = Dice(9);
    for _ in 0..500 {
        let point = dice.direction() * dice.between(0.07, 0.125);
        let surface = grid.closest(point).unwrap();
        assert!((surface.distance - (point.norm() - 0.1)).abs() < 6e-4, "{surface:?}");
        assert!(surface.normal.dot(&point.normalize()) > 0.995);
    }
}

/// A grid of a ball's exact distances, in cells of a tenth and a twentieth of its radius: distance and normal are of third and second order,
/// and neither jumps where one cell goes over into the next, up to the outermost ones.
#[test]
fn a_grid_is_smooth_over_its_cells() {
    let radius = 0.1;
    let worst = [0.01, 0.005].map(|cell| {
        let (side, low) = ((0.3 / cell) as usize + 1, Vector3::repeat(-0.15 + 0.3 * cell));
        let node = |k: usize| low + Vector3::new((k % side) as f64, (k / side % side) as f64, (k / side / side) as f64) * cell;
        let values = (0..side * side * side).map(|k| (node(k).norm() - radius) as f32).collect();
        let grid = DistanceGrid::from_parts(low, cell, 0.04, [side as u32; 3], values).unwrap();
        let mut dice = Dice(3);
        let (mut off, mut turned) = (0.0_f64, 0.0_f64);
        for _ in 0..5000 {
            let point = dice.direction() * dice.between(0.09, 0.11);
            let found = grid.closest(point).unwrap();
            off = off.max((found.distance - (point.norm() - radius)).abs());
            turned = turned.max((found.normal - point.normalize()).norm());
            // Across the nearest face of a cell.
            let (axis, mut before) = ((dice.unit() * 3.0) as usize, dice.cube() * 0.14);
            let face = low[axis] + cell * ((before[axis] - low[axis]) / cell).round();
            before[axis] = face - 1e-9;
            let after = before + 2e-9 * Vector3::ith(axis, 1.0);
            if let (Some(before), Some(after)) = (grid.closest(before), grid.closest(after))
                && before.distance > -0.07
            {
                assert!((before.normal - after.normal).norm() < 1e-5, "{before:?} {after:?}");
                assert!((before.distance - after.distance).abs() < 3e-9);
            }
        }
        (off, turned)
    });
    // (3/8) cell²/r and cell/r are what trilinear interpolation errs by: 3.8e-4 m and 0.1 rad, 9.4e-5 m and 0.05 rad.
    assert!(worst[0].0 < 1e-5 && worst[0].1 < 5e-3, "{worst:?}");
    assert!(worst[1].0 < 0.2 * worst[0].0 && worst[1].1 < 0.35 * worst[0].1, "{worst:?}");
}

#[test]
fn a_grid_is_restored_from_its_bytes_and_from_no_others() {
    let (vertices, triangles) = ball(0.1, 1);
    let mesh = Mesh::new(vertices, triangles, Sides::Solid).unwrap();
    let grid = DistanceGrid::bake(&mesh, 0.03, 0.01).unwrap();
    let bytes = distance_grid::write_to_bytes(&grid).unwrap();
    assert_eq!(distance_grid::read_from_bytes("it", &bytes).unwrap(), grid);
    for length in (0..bytes.len()).step_by(7) {
        let error = distance_grid::read_from_bytes("it", &bytes[..length]).unwrap_err().to_string();
        assert!(error.starts_with("it: truncated"), "{length}: {error}");
    }
    let spoilt = |at: usize, by: &[u8]| {
        let mut bytes = bytes.clone();
        bytes[at..at + by.len()].copy_from_slice(by);
        distance_grid::read_from_bytes("it", &bytes).unwrap_err().to_string()
    };
    assert!(spoilt(0, b"X").contains("SHXDGRID"));
    assert!(spoilt(8, &[9]).contains("version 9"));
    assert!(spoilt(12, &u32::MAX.to_le_bytes()).contains("nodes"));
    assert!(spoilt(12, &1u32.to_le_bytes()).contains("bytes after"));
    assert!(spoilt(24, &f64::NAN.to_le_bytes()).contains("low[0] is NaN"));
    assert!(spoilt(48, &(-1.0f64).to_le_bytes()).contains("cell is -1"));
    assert!(spoilt(64, &f32::INFINITY.to_le_bytes()).contains("distance 0"));
    let mut long = bytes.clone();
    long.push(0);
    assert!(distance_grid::read_from_bytes("it", &long).unwrap_err().to_string().contains("1 bytes after"));
    let path = std::env::temp_dir().join(format!("superhelix_grid_{}", std::process::id()));
    distance_grid::write(&path, &grid).unwrap();
    assert_eq!(distance_grid::read(&path).unwrap(), grid);
    std::fs::remove_file(&path).unwrap();
}

#[test]
fn an_impossible_grid_is_refused() {
    let (vertices, triangles) = ball(0.1, 1);
    let mesh = Mesh::new(vertices, triangles, Sides::Solid).unwrap();
    let says = |result: superhelix::Result<DistanceGrid>, argument: &str| {
        let text = result.unwrap_err().to_string();
        assert!(text.starts_with(argument), "{text}");
    };
    says(DistanceGrid::bake(&mesh, 1e-5, 0.1), "cell is 0.00001");
    says(DistanceGrid::bake(&mesh, f64::NAN, 0.1), "cell is NaN");
    says(DistanceGrid::bake(&mesh, 0.01, 0.0), "band is 0");
    let (vertices, triangles) = sheet(0.1, 2);
    says(
        DistanceGrid::bake(&Mesh::new(vertices, triangles, Sides::Both).unwrap(), 0.01, 0.01),
        "mesh is too open to have an inside",
    );
    says(DistanceGrid::from_parts(Vector3::zeros(), 1.0, 1.0, [2, 2, 2], vec![0.0; 7].into()), "values is 7 long");
    let grid = DistanceGrid::bake(&mesh, 0.03, 0.01).unwrap();
    assert!(Shape::new_grid(grid).grid().is_some());
}

#[test]
fn a_mesh_with_an_opening_is_baked_as_if_closed() {
    // A ball whose bottom is cut off, and one of whose triangles is missing elsewhere; the closed ball gives the expected grid.
    let (vertices, triangles) = ball(0.1, 4);
    let solid = Mesh::new(vertices.clone(), triangles.clone(), Sides::Solid).unwrap();
    let middle = |triangle: &[u32; 3]| triangle.iter().map(|v| vertices[*v as usize]).sum::<Vector3<f64>>() / 3.0;
    let mut open: Vec<_> = triangles.iter().copied().filter(|triangle| middle(triangle).z > -0.09).collect();
    open.remove(0);
    let mesh = Mesh::new(vertices.clone(), open, Sides::Both).unwrap();
    let (grid, whole) = (DistanceGrid::bake(&mesh, 0.004, 0.02).unwrap(), DistanceGrid::bake(&solid, 0.004, 0.02).unwrap());
    let mut dice = Dice(12);
    let mut inside = 0;
    for _ in 0..3000 {
        let point = dice.cube() * 0.115;
        let (Some(found), Some(expected)) = (grid.closest(point), whole.closest(point)) else { continue };
        // The surface is the same but about the bottom, closed by a cap somewhere within the ball's, and the missing triangle.
        let missing = point.normalize().dot(&middle(&triangles[0]).normalize()) > 0.95;
        if point.z > 0.0 && expected.distance > -0.05 && !missing {
            // The lattices lie elsewhere: twice what interpolation errs by, (3/8) cell²/r with r down to 5 cm.
            assert!((found.distance - expected.distance).abs() < 2.4e-4, "{point} {found:?} {expected:?}");
            inside += usize::from(found.distance < 0.0);
        }
        // It is a distance everywhere: it grows by no more than the displacement, up to errors of spreading and interpolation.
        let step = dice.direction() * 0.004;
        if let Some(there) = grid.closest(point + step) {
            assert!((there.distance - found.distance).abs() < 1.8 * 0.004, "{point}: {} {}", found.distance, there.distance);
        }
    }
    assert!(inside > 300, "{inside}");
    // A mesh of two sides may be wound inward.
    let inward = mesh.triangles().iter().map(|[a, b, c]| [*a, *c, *b]).collect();
    let turned = Mesh::new(vertices.clone(), inward, Sides::Both).unwrap();
    let (turned, near) = (DistanceGrid::bake(&turned, 0.008, 0.02).unwrap(), DistanceGrid::bake(&mesh, 0.008, 0.02).unwrap());
    assert!(turned.values().iter().zip(near.values()).all(|(a, b)| (a - b).abs() < 1e-4));
    // A bowl is too open.
    let bowl: Vec<_> = triangles.iter().copied().filter(|triangle| middle(triangle).z > 0.06).collect();
    let error =
        DistanceGrid::bake(&Mesh::new(vertices.clone(), bowl, Sides::Both).unwrap(), 0.004, 0.02).unwrap_err().to_string();
    assert!(error.starts_with("mesh is too open"), "{error}");
    // One triangle has no inside at all, though next to nothing about it is unclear.
    let one = Mesh::new(vertices.clone(), triangles[..1].to_vec(), Sides::Both).unwrap();
    let error = DistanceGrid::bake(&one, 0.02, 0.05).unwrap_err().to_string();
    assert!(error.starts_with("mesh is without an inside"), "{error}");
}

/// Boxes whose faces are layers of the lattice's nodes, which are neither inside nor outside: all of them, some, a face, and a box with a
/// quarter of a face missing.
#[test]
fn a_box_along_the_lattice_is_baked() {
    let corners = |half: Vector3<f64>| -> Vec<Vector3<f64>> {
        (0..8).map(|k| Vector3::from_fn(|axis, _| if k >> axis & 1 == 0 { -half[axis] } else { half[axis] })).collect()
    };
    let faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let triangles: Vec<[u32; 3]> = faces.iter().flat_map(|[a, b, c, d]| [[*a, *c, *b], [*a, *d, *c]]).collect();
    let half = Vector3::new(0.03, 0.02, 0.01);
    for (cell, band) in [(0.005, 0.02), (0.01, 0.02), (0.0025, 0.005), (0.003, 0.02), (1.0 / 300.0, 0.02)] {
        let mesh = |sides| Mesh::new(corners(half), triangles.clone(), sides).unwrap();
        let solid = DistanceGrid::bake(&mesh(Sides::Solid), cell, band).unwrap();
        for sides in [Sides::Both, Sides::Front { depth: 0.01 }] {
            let grid = DistanceGrid::bake(&mesh(sides), cell, band).unwrap_or_else(|error| panic!("cell {cell}: {error}"));
            // Which side rounding puts a node of the surface on makes no difference.
            let off = grid.values().iter().zip(solid.values()).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            assert!(off < 1e-7, "cell {cell}: {off}");
        }
    }
    // A quarter of the face towards −x is missing; far from it all is as before.
    let mut vertices = corners(half);
    vertices.push(Vector3::new(-half.x, 0.0, 0.0));
    let mut open: Vec<[u32; 3]> = triangles.iter().copied().filter(|t| !t.iter().all(|v| v & 1 == 0)).collect();
    assert_eq!(open.len(), 10);
    open.extend([[0, 8, 2], [0, 4, 8], [8, 4, 6]]);
    let open = Mesh::new(vertices, open, Sides::Front { depth: 0.01 }).unwrap();
    let grid = DistanceGrid::bake(&open, 0.0025, 0.005).unwrap();
    for (point, distance) in [([0.005, 0.001, 0.011], 0.001), ([0.01, 0.0, 0.008], -0.002), ([0.031, 0.003, -0.002], 0.001)] {
        let found = grid.closest(point.into()).unwrap().distance;
        assert!((found - distance).abs() < 1e-6, "{point:?}: {found}");
    }
    // Without half of its faces it has no inside, however they lie.
    let half_open: Vec<[u32; 3]> = triangles.iter().copied().filter(|t| t.iter().any(|v| v & 1 == 0)).collect();
    for bowl in [&half_open[..6], &triangles[..4]] {
        let error = DistanceGrid::bake(&Mesh::new(corners(half), bowl.to_vec(), Sides::Both).unwrap(), 0.005, 0.02).unwrap_err();
        assert!(error.to_string().contains("mesh is"), "{error}");
    }
}
