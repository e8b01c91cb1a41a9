//! Faults of the contact engine, each with tests of its own, one module per subject. All use the default options unless noted.

mod incline;
mod neighbours_of_a_failing_strand;
mod penalties;
mod slow_friction;
mod straight_strands;
mod what_is_accepted;
mod wrench_of_roots_inside;

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::{BodyDef, BodyId, ContactOptions, Frame, Shape, Solver, SolverOptions, StrandContact, StrandDef, StrandId};

const GRAVITY: f64 = 9.81;

/// A solver with the default options but for contact's, gravity to -z.
fn solver(contact: ContactOptions) -> Solver {
    Solver::new(SolverOptions { contact, ..SolverOptions::default() }).unwrap()
}

/// The default options with strands touching each other.
fn with_hair() -> ContactOptions {
    ContactOptions { hair: true, ..ContactOptions::default() }
}

fn at(origin: Vector3<f64>) -> Frame {
    Frame { origin, ..Frame::default() }
}

fn body(shape: Shape) -> BodyDef {
    BodyDef::new(Arc::new(shape))
}

/// The half-space below z = 0.
fn floor() -> BodyDef {
    body(Shape::new_half_space(Vector3::z()).unwrap())
}

/// A root from which a strand hangs along -z.
fn hanging(origin: Vector3<f64>) -> Frame {
    Frame { origin, rotation: UnitQuaternion::from_axis_angle(&Vector3::y_axis(), FRAC_PI_2) }
}

fn weight(def: &StrandDef) -> f64 {
    GRAVITY * def.material.linear_density() * def.length()
}

fn point(solver: &Solver, id: StrandId, arclength: f64) -> Vector3<f64> {
    let mut at = Vector3::zeros();
    solver.sample_at(id, &[arclength], |_, sample| at = sample.position).unwrap();
    at
}

fn tangent(solver: &Solver, id: StrandId, arclength: f64) -> Vector3<f64> {
    let mut along = Vector3::zeros();
    solver.sample_at(id, &[arclength], |_, sample| along = sample.rotation * Vector3::x()).unwrap();
    along
}

fn line(solver: &Solver, id: StrandId, places: u32) -> Vec<Vector3<f64>> {
    let mut line = Vec::new();
    solver.sample_strands(&[id], places as usize, |_, _, sample| line.push(sample.position)).unwrap();
    line
}

/// A vector without its part along a direction of length 1.
fn across(v: &Vector3<f64>, direction: &Vector3<f64>) -> Vector3<f64> {
    v - direction * v.dot(direction)
}

/// Strands all over the upper part of a ball at the origin, which they leave slanting; the ball is the first body.
struct Head {
    solver: Solver,
    ids: Vec<StrandId>,
    defs: Vec<StrandDef>,
    ball: BodyId,
}

const BALL: f64 = 0.09;

impl Head {
    /// `wisps` heads of hair of five strands each, by `contact`.
    fn new(options: ContactOptions, wisps: usize, contact: &StrandContact) -> Self {
        let mut solver = solver(options);
        let golden = PI * (3.0 - 5.0_f64.sqrt());
        let defs: Vec<StrandDef> = (0..5 * wisps)
            .map(|k| {
                let (wisp, place) = (k / 5, k % 5);
                // Wisps spread evenly over the cap above 0.2 of the radius, strands in a ring round the wisp's own middle.
                let (z, turn) = (1.0 - 0.8 * (wisp as f64 + 0.5) / wisps as f64, golden * wisp as f64);
                let flat = (1.0 - z * z).sqrt();
                let middle = Vector3::new(flat * turn.cos(), flat * turn.sin(), z);
                let side = middle.cross(&Vector3::new(0.3, -0.5, 0.81)).normalize();
                let ring = 2.0 * PI * place as f64 / 5.0;
                let off = side * ring.cos() + middle.cross(&side) * ring.sin();
                let up = (middle + off * 0.04).normalize();
                // Leaves by 45 degrees to the surface, downwards.
                let down = across(&-Vector3::z(), &up);
                let down = if down.norm() > 1e-3 { down.normalize() } else { side };
                let leave = (up + down).normalize();
                let mut def = StrandDef::straight(0.12, 6);
                (def.material.viscosity, def.material.air_drag) = (0.02, 5e-5);
                let bend = 6.0 + 2.0 * (1.3 * k as f64).sin();
                def.natural = vec![[0.0, 0.4 * bend * (0.7 * k as f64).sin(), bend * (0.9 * wisp as f64).cos()]; 6];
                let rotation = UnitQuaternion::rotation_between(&Vector3::x(), &leave).unwrap();
                def.root = Frame { origin: up * (BALL + 1e-4), rotation };
                def
            })
            .collect();
        let ids = solver.add_strands(&defs).unwrap();
        solver.set_contact(&ids, Some(contact)).unwrap();
        let ball = solver.add_bodies(vec![body(Shape::new_sphere(BALL).unwrap())]).unwrap()[0];
        Self { solver, ids, defs, ball }
    }

    /// Sends the ball and the roots on it to a pose, within the next step of `h` seconds.
    fn send(&mut self, pose: &Frame, h: f64) {
        let moved = |def: &StrandDef| Frame {
            origin: pose.origin + pose.rotation * def.root.origin,
            rotation: pose.rotation * def.root.rotation,
        };
        let roots: Vec<Frame> = self.defs.iter().map(moved).collect();
        self.solver.set_root_frames(&self.ids, &roots, h).unwrap();
        self.solver.set_body_frames(&[self.ball], &[*pose], h).unwrap();
    }
}

fn turned_about_z(angle: f64) -> Frame {
    Frame { origin: Vector3::zeros(), rotation: UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle) }
}
