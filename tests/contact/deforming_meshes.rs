//! Meshes that deform.

use std::sync::Arc;

use nalgebra::Vector3;
use superhelix::internals::contact::body::Body;
use superhelix::shapes::{Mesh, Sides};
use superhelix::{BodyDef, Shape};

use super::random_bodies::{Dice, bumpy};

#[test]
fn a_refitted_mesh_answers_like_a_new_one() {
    let mut dice = Dice(21);
    let (mut vertices, triangles) = bumpy(0.1, 3);
    let mut mesh = Mesh::new(vertices.clone(), triangles.clone(), Sides::Solid).unwrap();
    for frame in 0..4 {
        let old = vertices.clone();
        for vertex in &mut vertices {
            *vertex += Vector3::new(0.02 * (30.0 * vertex.y).sin(), 0.01 * f64::from(frame), 0.02 * (20.0 * vertex.x).cos());
        }
        mesh.set_vertices(&vertices).unwrap();
        assert_eq!(mesh.vertices_before(), &old[..]);
        let fresh = Mesh::new(vertices.clone(), triangles.clone(), Sides::Solid).unwrap();
        for _ in 0..200 {
            let point = dice.cube() * 0.15;
            let (a, b) = (mesh.closest(point, f64::INFINITY).unwrap(), fresh.closest(point, f64::INFINITY).unwrap());
            // Of equally near triangles (a shared edge) another may be found.
            assert!((a.distance - b.distance).abs() < 1e-15 && (a.point - b.point).norm() < 1e-12, "{a:?} {b:?}");
        }
    }
    let before = mesh.vertices().to_vec();
    assert!(mesh.set_vertices(&vertices[1..]).unwrap_err().to_string().contains("vertices"));
    vertices[5].x = f64::NAN;
    assert!(mesh.set_vertices(&vertices).unwrap_err().to_string().starts_with("vertices[5][0] is NaN"));
    assert_eq!(mesh.vertices(), &before[..]);
}

#[test]
fn a_deforming_body_reports_the_displacement_of_its_surface() {
    let (vertices, triangles) = bumpy(0.1, 2);
    let shape = Arc::new(Shape::new_mesh(vertices.clone(), triangles, Sides::Solid).unwrap());
    let mut body = Body::new(BodyDef::new(shape.clone())).unwrap();
    let stretched: Vec<_> = vertices.iter().map(|vertex| vertex.component_mul(&Vector3::new(1.2, 1.0, 0.9))).collect();
    body.set_vertices(&stretched, 0.02).unwrap();
    for substep in 0..3 {
        body.begin(0.01);
        let at = body.at(0, 0.01);
        let surface = at.shape.closest(Vector3::new(0.11, 0.03, 0.02), 1.0).unwrap();
        let carried = at.carried(&surface);
        // Half of the displacement in each of two substeps; at the surface's place the stretch is that of the triangle, linear in the place.
        let after = [0.5, 1.0, 1.0][substep];
        let factor = Vector3::new(1.0 + 0.2 * after, 1.0, 1.0 - 0.1 * after);
        let rest = surface.point.component_div(&factor);
        let expected = if substep < 2 { rest.component_mul(&Vector3::new(0.1, 0.0, -0.05)) } else { Vector3::zeros() };
        assert!((carried - expected).norm() < 1e-15, "{substep}: {carried} {expected}");
        body.finish(0.01);
    }
    assert_eq!(body.def().shape.mesh().unwrap().vertices(), &stretched[..]);
    // The shared shape stays the same.
    assert_eq!(shape.mesh().unwrap().vertices(), &vertices[..]);
    let mut sphere = Body::new(BodyDef::new(Arc::new(Shape::new_sphere(1.0).unwrap()))).unwrap();
    assert!(sphere.set_vertices(&vertices, 0.0).unwrap_err().to_string().contains("only triangle meshes"));
}
