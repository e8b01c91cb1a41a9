//! The device's own solve: Signorini's and Coulomb's laws at the touches of a local model, with the tool where the hand has it now.
//!
//! Within `s` of the model's seconds a touched point goes s·moved + W (λ − λ₀): at s = 0, with the tool where it was, the forces λ₀ that the simulation
//! had solve it, and at s = 1 it is the simulation's own next step. Strands are coupled through the tool, which gives way by the virtual coupling.
//! Gaps and normals are those of the tool's shapes where strands and tool are now, under the forces of the update before. Sweeps over the touches
//! (Gauss–Seidel), each by its law's exact solve, begin with these forces.

use nalgebra::{Matrix3, Vector3};

use super::coupling::{Compliance, moved};
use super::geometry::Tooth;
use super::local_model::LocalModel;
use crate::contact::law::contact::{Contact, Friction};
use crate::contact::law::response::Response;
use crate::contact::law::{Law, LawSolve};
use crate::math::frame::Frame;
use crate::solver::report::Wrench;
use crate::solver::touch_compliance::BodyTouch;

/// Sweeps end when no force changes by more than this part of the largest.
const CHANGE: f64 = 1e-4;
/// Where the last sweep changes forces by more than this part of the largest they go half of the way.
const UNSOLVED: f64 = 0.01;
/// How much further than the simulation's next step strands are foreseen.
const FARTHEST: f64 = 2.0;
/// A surface whose normal has turned from the model's by more than this cosine is another one: what it had in the model goes on to be it.
const SAME_SIDE: f64 = 0.2;

/// The gap of a touch that is none any more, m.
const FAR: f64 = 1.0;

/// The most that a touch may have slid into the surface within a step, m.
const MOST_SLID: f64 = 1e-4;

/// A touch's part in the solve.
#[derive(Debug, Clone, Copy)]
struct Row {
    law: LawSolve,
    /// How far the strand's point goes for a force at it.
    own: Matrix3<f64>,
    /// The same with the tool's giving way.
    response: Matrix3<f64>,
    /// From the handle's origin to the tool's point.
    arm: Vector3<f64>,
    /// What there would be with the forces that the model came with, and a tool that does not give way.
    free: Vector3<f64>,
    force: Vector3<f64>,
    /// The update before's.
    before: Vector3<f64>,
    /// How much nearer the surface is than the simulation had it where the touch slid on within its step, m: what pressed there goes on to.
    slid: f64,
}

/// What a solve came to.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Solved {
    /// On the tool, about its handle's origin, with what comes from no touch.
    pub wrench: Wrench,
    /// How far the tool gives way.
    pub moved: Vector3<f64>,
    pub turned: Vector3<f64>,
    pub sweeps: u32,
    pub pressing: u32,
    /// The last change of a force as a part of the largest.
    pub change: f64,
}

/// The touches of the present local model.
#[derive(Debug)]
pub(super) struct TouchForces {
    rows: Vec<Row>,
    teeth: Vec<Tooth>,
}

/// What the forces on strands come to at the tool, with opposite sign.
#[derive(Debug, Clone, Copy, Default)]
struct Sum {
    force: Vector3<f64>,
    moment: Vector3<f64>,
}

impl Sum {
    fn add(&mut self, arm: &Vector3<f64>, force: &Vector3<f64>) {
        self.force += force;
        self.moment += arm.cross(force);
    }
}

fn law(touch: &BodyTouch, normal: Vector3<f64>, response: &Matrix3<f64>, seconds: f64) -> LawSolve {
    let contact = Contact { normal, response: Response::Hard, friction: Friction::Coulomb(touch.friction) };
    LawSolve::new(&Law::Contact(contact), response, seconds)
}

impl TouchForces {
    pub fn new(most: usize, teeth: Vec<Tooth>) -> Self {
        Self { rows: Vec::with_capacity(most), teeth }
    }

    /// Begins with another model, from its own forces.
    pub fn begin(&mut self, model: &LocalModel) {
        self.rows.clear();
        for (range, response) in model.strands() {
            let size = 3 * range.len();
            for (k, touch) in model.touches[range].iter().enumerate() {
                let own = Matrix3::from_fn(|i, j| response[(3 * k + j) * size + 3 * k + i]);
                let arm = touch.point - model.handle.origin;
                let law = law(touch, touch.normal, &own, model.seconds);
                let slid = match self.teeth.get(touch.body as usize) {
                    Some(tooth) if touch.force != Vector3::zeros() => {
                        let near = tooth.nearest(&model.handle, touch.strand_point(), touch.tangent, touch.reach);
                        near.map_or(0.0, |near| near.distance - touch.margin - touch.gap).clamp(-MOST_SLID, 0.0)
                    }
                    _ => 0.0,
                };
                self.rows.push(Row {
                    law,
                    own,
                    response: own,
                    arm,
                    free: Vector3::zeros(),
                    force: touch.force,
                    before: touch.force,
                    slid,
                });
            }
        }
    }

    /// How far the point of a strand's touch `k` goes by how the forces differ from the model's; `matrix` is the strand's.
    #[inline(always)]
    fn given_way(rows: &[Row], touches: &[BodyTouch], matrix: &[f64], k: usize) -> Vector3<f64> {
        let size = 3 * touches.len();
        // Symmetric: three columns are three rows.
        let own = &matrix[3 * k * size..][..3 * size];
        let mut sum = Vector3::zeros();
        for (j, (row, touch)) in rows.iter().zip(touches).enumerate() {
            let by = row.force - touch.force;
            for axis in 0..3 {
                let numbers = &own[axis * size + 3 * j..][..3];
                sum[axis] += numbers[0] * by.x + numbers[1] * by.y + numbers[2] * by.z;
            }
        }
        sum
    }

    /// Looks at where strands and tool are under the forces of the update before, `part` of the model's seconds on.
    fn look(&mut self, model: &LocalModel, handle: &Frame, part: f64, compliance: Compliance) -> Sum {
        let mut sum = Sum::default();
        self.rows.iter().for_each(|row| sum.add(&row.arm, &row.force));
        let (yielded, turned) = (-sum.force * compliance.linear, -sum.moment * compliance.angular);
        let tool = moved(handle, yielded, turned);
        let turn = tool.rotation * model.handle.rotation.inverse();
        sum = Sum::default();
        for (range, response) in model.strands() {
            let (rows, touches) = (&mut self.rows[range.clone()], &model.touches[range]);
            for (k, touch) in touches.iter().enumerate() {
                let way = Self::given_way(rows, touches, response, k);
                let was = touch.strand_point();
                let now = was + touch.moved * part + way;
                let carried = tool.origin + turn * (touch.point - model.handle.origin) - touch.point;
                let found =
                    self.teeth.get(touch.body as usize).and_then(|tooth| tooth.nearest(&tool, now, touch.tangent, touch.reach));
                let slip = now - was - carried;
                let (normal, gap, point) = match found {
                    Some(near) if near.normal.dot(&(turn * touch.normal)) > SAME_SIDE => {
                        (near.normal, near.distance - touch.margin - rows[k].slid, near.point)
                    }
                    Some(_) => (touch.normal, touch.gap + touch.normal.dot(&slip), touch.point + carried),
                    None => (touch.normal, FAR, touch.point + carried),
                };
                let row = &mut rows[k];
                row.arm = point - tool.origin;
                let across = row.arm.cross_matrix();
                row.response = row.own + Matrix3::identity() * compliance.linear - across * across * compliance.angular;
                row.law = law(touch, normal, &row.response, model.seconds);
                let u = normal * gap + (slip - normal * normal.dot(&slip));
                // Less what these forces have done to it.
                row.free = u - way + yielded + turned.cross(&row.arm);
                sum.add(&row.arm, &row.force);
            }
        }
        sum
    }

    /// The forces `age` seconds after the pose that the model's step was taken with, when the handle would be at `handle` if no force acted on it.
    pub fn solve(&mut self, model: &LocalModel, handle: &Frame, age: f64, max_sweeps: u32, compliance: Compliance) -> Solved {
        let part = (age / model.seconds).clamp(0.0, FARTHEST);
        let mut sum = self.look(model, handle, part, compliance);
        self.rows.iter_mut().for_each(|row| row.before = row.force);
        let mut solved = Solved::default();
        while solved.sweeps < max_sweeps && !self.rows.is_empty() {
            let (mut change, mut largest) = (0.0_f64, f64::MIN_POSITIVE);
            for (range, response) in model.strands() {
                let (rows, touches) = (&mut self.rows[range.clone()], &model.touches[range]);
                for k in 0..touches.len() {
                    let mut u = Self::given_way(rows, touches, response, k);
                    let row = &mut rows[k];
                    u += row.free + sum.force * compliance.linear + sum.moment.cross(&row.arm) * compliance.angular;
                    let force = row.law.solve(u - row.response * row.force);
                    let size = force.norm();
                    let most = touches[k].most_force.max(touches[k].force.norm());
                    let force = if size > most { force * (most / size) } else { force };
                    let by = force - row.force;
                    if by.iter().all(|x| x.is_finite()) {
                        row.force = force;
                        sum.add(&row.arm, &by);
                        change = change.max(by.norm());
                        largest = largest.max(force.norm());
                    }
                }
            }
            solved.sweeps += 1;
            solved.change = change / largest;
            if solved.change <= CHANGE {
                break;
            }
        }
        if solved.change > UNSOLVED {
            // What jams has no one solution: it is not to jump from one to another.
            sum = Sum::default();
            for row in &mut self.rows {
                row.force = 0.5 * (row.force + row.before);
                sum.add(&row.arm, &row.force);
            }
        }
        solved.pressing = self.rows.iter().filter(|row| row.force != Vector3::zeros()).count() as u32;
        (solved.moved, solved.turned) = (-sum.force * compliance.linear, -sum.moment * compliance.angular);
        solved.wrench = Wrench { force: model.rest.force - sum.force, torque: model.rest.torque - sum.moment };
        solved
    }
}
