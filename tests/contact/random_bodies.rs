//! What the tests share: random numbers, meshes, strands.

use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use superhelix::internals::contact::body_at::BodyAt;
use superhelix::internals::contact::contact_point::{ContactPoint, StrandCurve, StrandPath};
use superhelix::internals::contact::narrow_phase::path_bounds::PathBounds;
use superhelix::internals::contact::narrow_phase::strand_body::{BodySearchScratch, Span, contacts};
use superhelix::internals::math::vector::{Mat3, Vec3};
use superhelix::internals::rod::kinematics::{ElementState, element_state};
use superhelix::{Frame, Shape};

/// Numbers that look random (xorshift).
pub struct Dice(pub u64);

impl Dice {
    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// In the cube [-1, 1]³.
    pub fn cube(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.between(-1.0, 1.0))
    }

    pub fn direction(&mut self) -> Vector3<f64> {
        loop {
            let vector = self.cube();
            let norm = vector.norm();
            if norm > 0.1 && norm < 1.0 {
                return vector / norm;
            }
        }
    }

    pub fn rotation(&mut self) -> UnitQuaternion<f64> {
        UnitQuaternion::from_scaled_axis(self.direction() * self.between(0.0, 3.0))
    }
}

/// A sphere of triangles: an octahedron with each triangle cut in four, `levels` times, wound outward.
pub fn ball(radius: f64, levels: usize) -> (Vec<Vector3<f64>>, Vec<[u32; 3]>) {
    let mut vertices: Vec<Vector3<f64>> =
        [Vector3::x(), -Vector3::x(), Vector3::y(), -Vector3::y(), Vector3::z(), -Vector3::z()].into();
    let mut triangles: Vec<[u32; 3]> =
        vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    for _ in 0..levels {
        let mut middles = std::collections::BTreeMap::new();
        let mut finer = Vec::new();
        for [a, b, c] in triangles {
            let mut middle = |p: u32, q: u32| {
                *middles.entry((p.min(q), p.max(q))).or_insert_with(|| {
                    vertices.push((vertices[p as usize] + vertices[q as usize]).normalize());
                    vertices.len() as u32 - 1
                })
            };
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
        }
        triangles = finer;
    }
    (vertices.into_iter().map(|vertex| vertex * radius).collect(), triangles)
}

/// A closed surface that is not convex: a ball with waves on it.
pub fn bumpy(radius: f64, levels: usize) -> (Vec<Vector3<f64>>, Vec<[u32; 3]>) {
    let (mut vertices, triangles) = ball(radius, levels);
    for vertex in &mut vertices {
        let u = *vertex / radius;
        *vertex *= 1.0 + 0.25 * (5.0 * u.x).sin() * (4.0 * u.y + 1.0).sin() + 0.1 * (6.0 * u.z).cos();
    }
    (vertices, triangles)
}

/// A flat sheet in the plane z = 0: a square of half edge `half` with `cells` squares along each edge.
pub fn sheet(half: f64, cells: u32) -> (Vec<Vector3<f64>>, Vec<[u32; 3]>) {
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for j in 0..=cells {
        for i in 0..=cells {
            let place = |k: u32| half * (2.0 * f64::from(k) / f64::from(cells) - 1.0);
            vertices.push(Vector3::new(place(i), place(j), 0.0));
        }
    }
    for j in 0..cells {
        for i in 0..cells {
            let a = j * (cells + 1) + i;
            let (b, c, d) = (a + 1, a + cells + 1, a + cells + 2);
            triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    (vertices, triangles)
}

/// What lies from x = -0.05 to 0.3 m within an outline in y and z, whose corners go round the x axis. All of them are seen from the corner (0, 0), or
/// else from the first.
pub fn prism(outline: &[(f64, f64)]) -> (Vec<Vector3<f64>>, Vec<[u32; 3]>) {
    let count = outline.len() as u32;
    let vertices = [-0.05, 0.3].iter().flat_map(|x| outline.iter().map(|(y, z)| Vector3::new(*x, *y, *z))).collect();
    let mut triangles = Vec::new();
    for k in 0..count {
        let next = (k + 1) % count;
        triangles.extend([[k, next, count + next], [k, count + next, count + k]]);
    }
    let seeing = outline.iter().position(|corner| *corner == (0.0, 0.0)).unwrap_or(0) as u32;
    for k in 1..count - 1 {
        let [a, b] = [(seeing + k) % count, (seeing + k + 1) % count];
        triangles.extend([[seeing, b, a], [count + seeing, count + a, count + b]]);
    }
    (vertices, triangles)
}

/// A strand's elements from its root's rotation, its elements' lengths and curvatures.
pub fn strand(rotation: &UnitQuaternion<f64>, length: f64, curvatures: &[[f64; 3]]) -> Vec<ElementState<f64>> {
    let mut frame = Mat3::from(Matrix3::from(rotation.to_rotation_matrix()));
    let mut origin = Vec3::zero();
    let mut elements = Vec::new();
    for row in curvatures {
        let element = element_state(Vec3(*row), length, frame, origin);
        (frame, origin) = (element.frame_right(), element.origin_right());
        elements.push(element);
    }
    elements
}

/// A strand's curve at a step's start and now.
pub struct Moving {
    pub start: (Vector3<f64>, Vec<ElementState<f64>>),
    pub now: (Vector3<f64>, Vec<ElementState<f64>>),
}

impl Moving {
    /// A strand at rest.
    pub fn still(origin: Vector3<f64>, elements: Vec<ElementState<f64>>) -> Self {
        Self { start: (origin, elements.clone()), now: (origin, elements) }
    }

    /// A strand that is carried along.
    pub fn carried(origin: Vector3<f64>, way: Vector3<f64>, elements: Vec<ElementState<f64>>) -> Self {
        Self { start: (origin, elements.clone()), now: (origin + way, elements) }
    }

    pub fn path(&self) -> StrandPath<'_> {
        StrandPath {
            index: 3,
            start: StrandCurve { origin: self.start.0, elements: &self.start.1 },
            now: StrandCurve { origin: self.now.0, elements: &self.now.1 },
            permitted_overlap: None,
        }
    }

    pub fn contacts(&self, radius: f64, body: &BodyAt, within: f64) -> Vec<ContactPoint> {
        self.contacts_from(0.0, radius, body, within)
    }

    pub fn contacts_from(&self, exempt: f64, radius: f64, body: &BodyAt, within: f64) -> Vec<ContactPoint> {
        let path = self.path();
        let mut bounds = PathBounds::default();
        bounds.update(&path);
        let mut out = Vec::new();
        contacts(
            &path,
            &bounds,
            Span { exempt, unmoved: &[] },
            radius,
            body,
            within,
            &mut BodySearchScratch::default(),
            &mut out,
        );
        out
    }
}

pub fn at_rest(shape: &Shape, pose: Frame, thickness: f64) -> BodyAt<'_> {
    BodyAt::new(7, shape, pose, pose, thickness)
}
