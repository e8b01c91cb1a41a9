//! A solver's state as bytes: little-endian, versioned, checksummed; the same image on every machine.
//!
//! Layout: "SHXSNAP\0", format version (u32), length of the body (u64), the body, FNV-1a hash of the body (u64). The body holds
//! the options that act on results, the identifiers, and every strand. Workers, logging and callbacks are the host's and stay out.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::Solver;
use super::id::{Slot, SlotMap, StrandId};
use super::report::Energies;
use super::sections::Sections;
use super::strand::{Authored, Fared, Strand};
use crate::error::{Error, Result};
use crate::math::frame::Frame;
use crate::math::lane::Precision;
use crate::math::quadrature::Rules;
use crate::math::rotation::PoseMove;
use crate::math::vector::Vec3;
use crate::rod::freedoms::Freedoms;
use crate::rod::material::Material;
use crate::rod::strand::StrandModel;
use crate::step::options::{Integrator, LinearSolver, StepOptions};
use crate::step::state::{Earlier, Past, StrandState};

/// Changes whenever an image of an older version could not be read.
pub const SNAPSHOT_VERSION: u32 = 3;
const MAGIC: &[u8; 8] = b"SHXSNAP\0";
const HEAD: usize = 8 + 4 + 8;

/// The parts of a solver that an image holds.
pub(super) struct Image {
    pub gravity: Vector3<f64>,
    pub wind: Vector3<f64>,
    pub step: StepOptions,
    pub slots: SlotMap,
    pub strands: Vec<Strand>,
    pub sections: Sections,
}

/// FNV-1a, 64 bits.
pub(super) fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

/// Wraps a body into an image.
pub(super) fn wrap(body: &[u8]) -> Vec<u8> {
    let mut image = Vec::with_capacity(HEAD + body.len() + 8);
    image.extend_from_slice(MAGIC);
    image.extend_from_slice(&SNAPSHOT_VERSION.to_le_bytes());
    image.extend_from_slice(&(body.len() as u64).to_le_bytes());
    image.extend_from_slice(body);
    image.extend_from_slice(&fnv1a(body).to_le_bytes());
    image
}

/// The body of an image, checked.
fn unwrap(image: &[u8]) -> Result<&[u8]> {
    let bad = |reason: String| Error::Snapshot { reason };
    if image.len() < HEAD + 8 {
        return Err(bad(format!("{} bytes are too few for an image", image.len())));
    }
    if &image[..8] != MAGIC {
        return Err(bad("it does not begin with SHXSNAP".into()));
    }
    let version = u32::from_le_bytes(image[8..12].try_into().unwrap_or_default());
    if version != SNAPSHOT_VERSION {
        return Err(bad(format!("it is of version {version}; this library reads version {SNAPSHOT_VERSION}")));
    }
    let length = u64::from_le_bytes(image[12..20].try_into().unwrap_or_default());
    if length != (image.len() - HEAD - 8) as u64 {
        return Err(bad(format!("it states a body of {length} bytes and holds {}", image.len() - HEAD - 8)));
    }
    let (body, checksum) = image[HEAD..].split_at(image.len() - HEAD - 8);
    if u64::from_le_bytes(checksum.try_into().unwrap_or_default()) != fnv1a(body) {
        return Err(bad("its checksum is wrong".into()));
    }
    Ok(body)
}

/// Writes numbers.
#[derive(Default)]
pub(super) struct Writer(pub Vec<u8>);

impl Writer {
    fn u32(&mut self, value: u32) {
        self.0.extend_from_slice(&value.to_le_bytes());
    }
    fn u64(&mut self, value: u64) {
        self.0.extend_from_slice(&value.to_le_bytes());
    }
    fn f64(&mut self, value: f64) {
        self.u64(value.to_bits());
    }
    fn vector(&mut self, v: Vector3<f64>) {
        v.iter().for_each(|x| self.f64(*x));
    }
    fn frame(&mut self, frame: &Frame) {
        self.vector(frame.origin);
        frame.rotation_xyzw().iter().for_each(|x| self.f64(*x));
    }
    fn rows(&mut self, rows: &[[f64; 3]]) {
        rows.iter().flatten().for_each(|x| self.f64(*x));
    }

    /// What acts on results but is not a strand.
    pub fn options(&mut self, gravity: Vector3<f64>, wind: Vector3<f64>, step: &StepOptions) {
        self.vector(gravity);
        self.vector(wind);
        self.u32(step.integrator as u32);
        self.u32(step.linear_solver as u32);
        self.u32(step.max_iterations);
        self.u32(u32::from(step.exact_hessian));
        self.f64(step.tolerance);
        self.f64(step.reference_tolerance);
        self.u32(step.max_subdivisions);
        self.f64(step.error_tolerance);
        self.u32(match step.precision {
            Precision::F64 => 1,
            Precision::F32 => 2,
        });
        self.f64(step.quadrature_tolerance);
    }

    /// The identifiers.
    pub fn slots(&mut self, slots: &SlotMap) {
        self.u32(u32::from(slots.mark));
        self.u64(slots.slots.len() as u64);
        for slot in &slots.slots {
            self.u32(slot.generation);
            self.u32(slot.highest);
            self.u32(slot.index.unwrap_or(u32::MAX));
        }
        self.u64(slots.free.len() as u64);
        slots.free.iter().for_each(|slot| self.u32(*slot));
    }

    /// The natural shape as it was given, where it has other elements. Apart from the strand: no step depends on it.
    fn authored(&mut self, authored: Option<&Authored>) {
        self.u64(authored.map_or(0, |authored| authored.lengths.len() as u64));
        if let Some(authored) = authored {
            authored.lengths.iter().for_each(|length| self.f64(*length));
            self.rows(&authored.natural);
        }
    }

    /// A strand's constants and state; the identifier stands apart.
    pub fn strand(&mut self, strand: &Strand) {
        let (model, state, material) = (&strand.model, &strand.state, &strand.model.material);
        self.u64(strand.user_data);
        self.u64(model.element_count() as u64);
        model.lengths.iter().for_each(|length| self.f64(*length));
        self.rows(&model.natural);
        for value in [
            material.radius[0],
            material.radius[1],
            material.density,
            material.youngs_modulus,
            material.poisson_ratio,
            material.internal_friction,
            material.viscosity,
            material.air_drag,
        ] {
            self.f64(value);
        }
        self.u32(model.freedoms.bits());
        self.rows(&state.curvatures);
        self.rows(&state.rates);
        self.u32(state.rule as u32);
        state.velocities.iter().for_each(|v| v.0.iter().for_each(|x| self.f64(*x)));
        self.frame(&state.root);
        self.vector(state.root_velocity);
        self.vector(state.root_angular_velocity);
        self.vector(state.wrench_force.into());
        self.vector(state.wrench_torque.into());
        self.u32(state.subdivision);
        self.f64(state.past.step);
        if state.past.step > 0.0 {
            self.rows(&state.past.curvatures);
            state.past.velocities.iter().for_each(|v| v.0.iter().for_each(|x| self.f64(*x)));
            self.frame(&state.past.root);
        }
        self.u32(u32::from(strand.root_move.is_some()));
        if let Some((root_move, elapsed)) = strand.root_move.as_deref() {
            self.frame(&root_move.from);
            self.frame(&root_move.to);
            self.vector(root_move.velocity);
            self.vector(root_move.angular_velocity);
            self.f64(root_move.duration);
            self.f64(*elapsed);
        }
        self.u32(strand.fared.iterations);
        self.u32(u32::from(strand.fared.converged));
        self.u32(u32::from(strand.fared.quarantined));
        self.f64(strand.energies.kinetic);
        self.f64(strand.energies.elastic);
        self.f64(strand.energies.gravity);
    }
}

/// Reads numbers; every length is checked against what is left before memory is taken.
struct Reader<'a> {
    left: &'a [u8],
}

impl Reader<'_> {
    fn take<const COUNT: usize>(&mut self) -> Result<[u8; COUNT]> {
        let Some((head, tail)) = self.left.split_first_chunk::<COUNT>() else {
            return Err(Error::Snapshot { reason: "its body ends early".into() });
        };
        self.left = tail;
        Ok(*head)
    }
    fn u32(&mut self) -> Result<u32> {
        Ok(u32::from_le_bytes(self.take()?))
    }
    fn u64(&mut self) -> Result<u64> {
        Ok(u64::from_le_bytes(self.take()?))
    }
    fn f64(&mut self) -> Result<f64> {
        Ok(f64::from_bits(self.u64()?))
    }
    fn flag(&mut self) -> Result<bool> {
        match self.u32()? {
            0 => Ok(false),
            1 => Ok(true),
            other => Err(Error::Snapshot { reason: format!("a flag is {other}") }),
        }
    }
    fn count(&mut self, bytes_each: usize) -> Result<usize> {
        let count = self.u64()?;
        if count > (self.left.len() / bytes_each) as u64 {
            return Err(Error::Snapshot { reason: format!("it states {count} items where {} bytes are left", self.left.len()) });
        }
        Ok(count as usize)
    }
    fn vector(&mut self) -> Result<Vector3<f64>> {
        Ok(Vector3::new(self.f64()?, self.f64()?, self.f64()?))
    }
    fn frame(&mut self) -> Result<Frame> {
        let origin = self.vector()?;
        let (x, y, z, w) = (self.f64()?, self.f64()?, self.f64()?, self.f64()?);
        // Kept to the bit: normalising again would change it.
        Ok(Frame { origin, rotation: UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z)) })
    }
    fn rows(&mut self, count: usize) -> Result<Vec<[f64; 3]>> {
        (0..count).map(|_| Ok([self.f64()?, self.f64()?, self.f64()?])).collect()
    }

    fn past(&mut self, elements: usize, points: usize) -> Result<Past> {
        let step = self.f64()?;
        if step == 0.0 {
            return Ok(Past::default());
        }
        if !(step.is_finite() && step > 0.0) {
            return Err(Error::Snapshot { reason: format!("a strand's last step took {step} s") });
        }
        let curvatures = self.rows(elements)?;
        let velocities = self.rows(points)?;
        if !curvatures.iter().chain(&velocities).flatten().all(|x| x.is_finite()) {
            return Err(Error::Snapshot { reason: "a strand's past holds a number that is not finite".into() });
        }
        let velocities = velocities.into_iter().map(Vec3).collect();
        Ok(Past::new(step, Earlier { curvatures, velocities, root: self.frame()? }))
    }

    /// The natural shape as it was given of a strand of that length.
    fn authored(&mut self, length: f64) -> Result<Option<Box<Authored>>> {
        let count = self.count(8 * 4)?;
        if count == 0 {
            return Ok(None);
        }
        let lengths = (0..count).map(|_| self.f64()).collect::<Result<Vec<f64>>>()?;
        let natural = self.rows(count)?;
        let good = lengths.iter().all(|length| length.is_finite() && *length > 0.0)
            && (lengths.iter().sum::<f64>() - length).abs() <= 1e-6 * length
            && natural.iter().flatten().all(|x| x.is_finite());
        if !good {
            return Err(Error::Snapshot { reason: "a strand's given natural shape is none of its length".into() });
        }
        Ok(Some(Box::new(Authored { lengths: lengths.into(), natural: natural.into() })))
    }

    fn strand(&mut self, id: StrandId, rules: &Rules, sections: &mut Sections) -> Result<Strand> {
        let user_data = self.u64()?;
        let count = self.count(8 * 10)?;
        if count == 0 {
            return Err(Error::Snapshot { reason: "a strand has no elements".into() });
        }
        let lengths = (0..count).map(|_| self.f64()).collect::<Result<Vec<f64>>>()?;
        let natural = self.rows(count)?;
        let material = Material {
            radius: [self.f64()?, self.f64()?],
            density: self.f64()?,
            youngs_modulus: self.f64()?,
            poisson_ratio: self.f64()?,
            internal_friction: self.f64()?,
            viscosity: self.f64()?,
            air_drag: self.f64()?,
        };
        let reason = |error: Error| Error::Snapshot { reason: error.to_string() };
        material.check("a strand's material").map_err(reason)?;
        let freedoms = Freedoms::from_bits("a strand's freedoms", self.u32()?).map_err(reason)?;
        let curvatures = self.rows(count)?;
        let rates = self.rows(count)?;
        let rule = self.u32()? as usize;
        if rule >= rules.count() {
            return Err(Error::Snapshot { reason: format!("a strand's quadrature rule is {rule}") });
        }
        let velocities = self.rows(count * rules.rule(rule).len())?.into_iter().map(Vec3).collect();
        let state = StrandState {
            curvatures,
            rates,
            velocities,
            rule,
            root: self.frame()?,
            root_velocity: self.vector()?,
            root_angular_velocity: self.vector()?,
            wrench_force: self.vector()?.into(),
            wrench_torque: self.vector()?.into(),
            subdivision: self.u32()?,
            past: self.past(count, count * rules.rule(rule).len())?,
        };
        let lengths_are_right = lengths.iter().all(|length| length.is_finite() && *length > 0.0);
        if !(state.is_finite() && lengths_are_right && natural.iter().flatten().all(|x| x.is_finite())) {
            return Err(Error::Snapshot {
                reason: "a strand holds a number that is not finite, or a length not above zero".into(),
            });
        }
        let root_move = if self.flag()? {
            let root_move = PoseMove {
                from: self.frame()?,
                to: self.frame()?,
                velocity: self.vector()?,
                angular_velocity: self.vector()?,
                duration: self.f64()?,
            };
            Some(Box::new((root_move, self.f64()?)))
        } else {
            None
        };
        let fared = Fared { iterations: self.u32()?, converged: self.flag()?, quarantined: self.flag()? };
        let energies = Energies { kinetic: self.f64()?, elastic: self.f64()?, gravity: self.f64()? };
        let model = StrandModel::of_section(lengths, natural, sections.of(&material, freedoms));
        let mut strand = Strand {
            model,
            state,
            id,
            user_data,
            authored: None,
            root_move,
            energies,
            fared,
            held: false,
            touched: false,
            contact: None,
        };
        strand.shrink();
        Ok(strand)
    }
}

fn precision_from(value: u32) -> Result<Precision> {
    match value {
        1 => Ok(Precision::F64),
        2 => Ok(Precision::F32),
        other => Err(Error::Snapshot { reason: format!("its precision is {other}") }),
    }
}

/// Reads an image back.
pub(super) fn read(image: &[u8], rules: &Rules) -> Result<Image> {
    let mut reader = Reader { left: unwrap(image)? };
    let gravity = reader.vector()?;
    let wind = reader.vector()?;
    let bad = |what: &str, value: u32| Error::Snapshot { reason: format!("its {what} is {value}") };
    let integrator = reader.u32()?;
    let solver = reader.u32()?;
    let step = StepOptions {
        integrator: Integrator::from_u32(integrator).ok_or_else(|| bad("integrator", integrator))?,
        linear_solver: LinearSolver::from_u32(solver).ok_or_else(|| bad("linear solver", solver))?,
        max_iterations: reader.u32()?,
        exact_hessian: reader.flag()?,
        tolerance: reader.f64()?,
        reference_tolerance: reader.f64()?,
        max_subdivisions: reader.u32()?,
        error_tolerance: reader.f64()?,
        precision: precision_from(reader.u32()?)?,
        quadrature_tolerance: reader.f64()?,
    };
    step.check("its options").map_err(|error| Error::Snapshot { reason: error.to_string() })?;
    let mark = reader.u32()? as u16;
    let slot_count = reader.count(12)?;
    let mut slots = SlotMap::new(mark);
    for _ in 0..slot_count {
        let (generation, highest, index) = (reader.u32()?, reader.u32()?, reader.u32()?);
        slots.slots.push(Slot { generation, highest, index: (index != u32::MAX).then_some(index) });
    }
    let free_count = reader.count(4)?;
    for _ in 0..free_count {
        let slot = reader.u32()?;
        if slots.slots.get(slot as usize).is_none_or(|free| free.index.is_some()) {
            return Err(Error::Snapshot { reason: format!("slot {slot} is said to be free") });
        }
        slots.free.push(slot);
    }
    let strand_count = reader.count(8)?;
    let mut strands = Vec::with_capacity(strand_count);
    let mut sections = Sections::default();
    for index in 0..strand_count {
        let id = StrandId::from_bits(reader.u64()?);
        if slots.index(id) != Some(index) {
            return Err(Error::Snapshot { reason: format!("strand {index} and its identifier disagree") });
        }
        let mut strand = reader.strand(id, rules, &mut sections)?;
        strand.authored = reader.authored(strand.model.length())?;
        strands.push(strand);
    }
    if !reader.left.is_empty() {
        return Err(Error::Snapshot { reason: format!("{} bytes are left over", reader.left.len()) });
    }
    Ok(Image { gravity, wind, step, slots, strands, sections })
}

/// Writes a solver's parts.
pub(super) fn write(
    gravity: Vector3<f64>,
    wind: Vector3<f64>,
    step: &StepOptions,
    slots: &SlotMap,
    strands: &[Strand],
) -> Vec<u8> {
    let mut writer = Writer::default();
    writer.options(gravity, wind, step);
    writer.slots(slots);
    writer.u64(strands.len() as u64);
    for strand in strands {
        writer.u64(strand.id.bits());
        writer.strand(strand);
        writer.authored(strand.authored.as_deref());
    }
    wrap(&writer.0)
}

impl Solver {
    /// The whole state as bytes, to be given to [`Solver::restore`]: options that act on results, identifiers, strands.
    pub fn snapshot(&self) -> Vec<u8> {
        write(self.options.gravity, self.options.wind, &self.options.step, &self.slots, &self.strands)
    }

    /// Goes back to a snapshot, of this solver or another: strands, identifiers and options become those of the image; the workers stay.
    ///
    /// # Errors
    /// [`Error::Snapshot`] for an image that is truncated, damaged or of another version.
    pub fn restore(&mut self, image: &[u8]) -> Result<()> {
        let image = read(image, &self.rules)?;
        self.options.gravity = image.gravity;
        self.options.wind = image.wind;
        self.options.step = image.step;
        self.rules.set_tolerance(image.step.quadrature_tolerance);
        let later = std::mem::replace(&mut self.slots, image.slots);
        self.slots.remember(&later);
        (self.strands, self.sections) = (image.strands, image.sections);
        Ok(())
    }

    /// A number that differs when the state differs: options that act on results and every strand, not the identifiers. The same on
    /// every machine and for any number of workers.
    pub fn state_hash(&self) -> u64 {
        let mut writer = Writer::default();
        writer.options(self.options.gravity, self.options.wind, &self.options.step);
        for strand in &self.strands {
            writer.strand(strand);
        }
        fnv1a(&writer.0)
    }
}
