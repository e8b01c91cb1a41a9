//! Serialises the map.
//!
//! Little-endian: "SHXRHAIR", format version (u32), length of the body (u64), the body, FNV-1a hash of the body (u64). The body
//! holds the settings (workers and instruction set belong to the host and are left out), the guides at binding, and the strands.
//! Derived data is recomputed.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::strand::{RenderCurl, RenderStrand};
use crate::error::{Error, Result};
use crate::groom::render_hair::RenderHair;
use crate::groom::render_hair::guides::phase;
use crate::groom::render_hair::guides::shape::{Reference, Shape};
use crate::groom::render_hair::points::own_shapes::OwnShapes;
use crate::groom::render_hair::settings::{MAX_GUIDES, RenderSettings, Space};
use crate::math::frame::UNIT_QUATERNION_TOLERANCE;
use crate::workers::Workers;

/// Changes whenever older bytes can no longer be read.
pub const RENDER_HAIR_VERSION: u32 = 1;
const MAGIC: &[u8; 8] = b"SHXRHAIR";
const HEAD: usize = 8 + 4 + 8;
/// 4-byte words per strand, without and with the data for mixing curvatures.
const STRAND_WORDS: usize = 2 * MAX_GUIDES + 3 * MAX_GUIDES + 2 + 2 + 2 + 3 + 3 + 3;
const CURL_WORDS: usize = 4 * MAX_GUIDES + 1;

fn bad(reason: impl Into<String>) -> Error {
    Error::Snapshot { reason: reason.into() }
}

fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

#[derive(Default)]
struct Writer(Vec<u8>);

impl Writer {
    fn u32(&mut self, value: u32) {
        self.0.extend_from_slice(&value.to_le_bytes());
    }

    fn u64(&mut self, value: u64) {
        self.0.extend_from_slice(&value.to_le_bytes());
    }

    fn doubles(&mut self, values: impl IntoIterator<Item = f64>) {
        values.into_iter().for_each(|value| self.u64(value.to_bits()));
    }

    fn singles<'a>(&mut self, values: impl IntoIterator<Item = &'a f32>) {
        values.into_iter().for_each(|value| self.u32(value.to_bits()));
    }
}

struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn take<const COUNT: usize>(&mut self) -> Result<[u8; COUNT]> {
        let (head, tail) = self.0.split_first_chunk::<COUNT>().ok_or_else(|| bad("its body ends early"))?;
        self.0 = tail;
        Ok(*head)
    }

    fn u32(&mut self) -> Result<u32> {
        Ok(u32::from_le_bytes(self.take()?))
    }

    fn u64(&mut self) -> Result<u64> {
        Ok(u64::from_le_bytes(self.take()?))
    }

    fn flag(&mut self) -> Result<bool> {
        match self.u32()? {
            0 => Ok(false),
            1 => Ok(true),
            other => Err(bad(format!("a flag is {other}"))),
        }
    }

    fn f64(&mut self) -> Result<f64> {
        Ok(f64::from_bits(self.u64()?))
    }

    /// A finite number.
    fn double(&mut self) -> Result<f64> {
        Some(self.f64()?).filter(|value| value.is_finite()).ok_or_else(|| bad("it has a number that is not finite"))
    }

    fn vector(&mut self) -> Result<Vector3<f64>> {
        Ok(Vector3::new(self.double()?, self.double()?, self.double()?))
    }

    /// Finite numbers.
    fn singles<const COUNT: usize>(&mut self) -> Result<[f32; COUNT]> {
        let mut out = [0.0; COUNT];
        for value in &mut out {
            *value = f32::from_bits(self.u32()?);
            if !value.is_finite() {
                return Err(bad("it has a number that is not finite"));
            }
        }
        Ok(out)
    }

    fn rows<const ROWS: usize, const COUNT: usize>(&mut self) -> Result<[[f32; COUNT]; ROWS]> {
        let mut out = [[0.0; COUNT]; ROWS];
        for row in &mut out {
            *row = self.singles()?;
        }
        Ok(out)
    }

    /// A number of items of this many bytes each; at most as many as there are bytes for.
    fn count(&mut self, bytes: usize, what: &str) -> Result<usize> {
        let count = self.u64()?;
        if count > (self.0.len() / bytes) as u64 {
            return Err(bad(format!("it states {count} {what} and holds fewer")));
        }
        Ok(count as usize)
    }
}

impl RenderHair {
    /// The map as bytes; [`RenderHair::from_bytes`] restores it.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut body = Writer::default();
        let s = &self.settings;
        for value in [s.points_per_strand, s.guides_per_strand, s.wisps_per_guide] {
            body.u64(value as u64);
        }
        body.u32(match s.space {
            Space::Position => 1,
            Space::Curvature => 2,
        });
        for flag in [s.measure_curliness, s.preserve_length, self.reference.rotations_given] {
            body.u32(u32::from(flag));
        }
        body.u64(s.seed);
        body.doubles(numbers(s));
        body.u64(self.reference.guides as u64);
        for guide in 0..self.reference.guides {
            let q = self.reference.rotations[guide].quaternion();
            body.doubles([q.i, q.j, q.k, q.w]);
        }
        body.doubles(self.reference.rest.iter().flat_map(|point| [point.x, point.y, point.z]));
        body.u64(self.strands.len() as u64);
        for strand in &self.strands {
            strand.guides.iter().for_each(|guide| body.u32(*guide));
            body.singles(&strand.weights);
            body.singles(strand.roots.iter().flatten());
            body.singles(strand.middle.iter().chain(&strand.offset).chain(&strand.gather));
            body.u32(strand.frizz);
            body.singles(&strand.frizz_turn);
            body.u32(strand.clump);
            body.singles(&strand.clump_turn);
            body.singles([&strand.radius, &strand.length]);
            body.u32(strand.wisp);
        }
        for curl in &self.curls {
            body.singles(curl.turns.iter().chain(&curl.halves).flatten());
            body.u32(u32::from(curl.curled));
        }
        if let Some(own) = &self.own {
            body.singles(own.numbers(&self.reference));
        }
        let body = body.0;
        let mut image = Writer(MAGIC.to_vec());
        image.u32(RENDER_HAIR_VERSION);
        image.u64(body.len() as u64);
        image.0.extend_from_slice(&body);
        image.u64(fnv1a(&body));
        image.0
    }

    /// Restores a map from its bytes, to be evaluated by `workers`: its strands are the same to the bit.
    ///
    /// # Errors
    /// [`Error::Snapshot`] for bytes that are not a map, of another version, damaged or truncated; for workers as
    /// [`RenderHair::bind`].
    pub fn from_bytes(image: &[u8], workers: Workers) -> Result<Self> {
        if image.len() < HEAD + 8 || &image[..8] != MAGIC {
            return Err(bad("it is not render hair: it does not begin with SHXRHAIR, or is truncated"));
        }
        let mut head = Reader(&image[8..HEAD]);
        let (version, length) = (head.u32()?, head.u64()?);
        if version != RENDER_HAIR_VERSION {
            return Err(bad(format!("it is render hair of version {version}; this library reads version {RENDER_HAIR_VERSION}")));
        }
        if length != (image.len() - HEAD - 8) as u64 {
            return Err(bad(format!("its header has a body of {length} bytes, and the image has {}", image.len() - HEAD - 8)));
        }
        let (body, hash) = image[HEAD..].split_at(image.len() - HEAD - 8);
        if Reader(hash).u64()? != fnv1a(body) {
            return Err(bad("its checksum is wrong"));
        }
        let mut body = Reader(body);
        let [points, per_strand, wisps] = [body.u64()?, body.u64()?, body.u64()?];
        let space = match body.u32()? {
            1 => Space::Position,
            2 => Space::Curvature,
            other => return Err(bad(format!("its space is {other}"))),
        };
        let (measure_curliness, preserve_length, rotations_given) = (body.flag()?, body.flag()?, body.flag()?);
        let mut settings = RenderSettings {
            points_per_strand: points as usize,
            guides_per_strand: per_strand as usize,
            wisps_per_guide: wisps as usize,
            space,
            measure_curliness,
            preserve_length,
            seed: body.u64()?,
            workers,
            ..RenderSettings::default()
        };
        for number in numbers_mut(&mut settings) {
            *number = body.f64()?;
        }
        settings.check("settings.")?;
        let points = settings.points_per_strand;
        let guides = body.count(32 + 24 * points, "guides")?;
        if guides == 0 {
            return Err(bad("it has no guides"));
        }
        let mut rotations = Vec::with_capacity(guides);
        for _ in 0..guides {
            let [i, j, k, w] = [body.double()?, body.double()?, body.double()?, body.double()?];
            let quaternion = Quaternion::new(w, i, j, k);
            if (quaternion.norm() - 1.0).abs() > UNIT_QUATERNION_TOLERANCE {
                return Err(bad("a rotation is not a unit quaternion"));
            }
            rotations.push(UnitQuaternion::new_unchecked(quaternion));
        }
        let rest = (0..guides * points).map(|_| body.vector()).collect::<Result<Vec<_>>>()?;
        let reference = Reference::restored(rest, points, rotations, rotations_given, settings.space == Space::Curvature);
        let curved = reference.curved;
        let strands = body.count(4 * (STRAND_WORDS + if curved { CURL_WORDS } else { 0 }), "strands")?;
        let strands = (0..strands).map(|_| strand(&mut body, guides)).collect::<Result<Vec<_>>>()?;
        let curls = (0..if curved { strands.len() } else { 0 }).map(|_| curl(&mut body)).collect::<Result<Vec<_>>>()?;
        // Own shapes are last, if strands have them.
        let left = body.0.len();
        let own = if left > 0 && left.is_multiple_of(4) {
            let numbers = (0..left / 4).map(|_| Ok(body.singles::<1>()?[0])).collect::<Result<Vec<_>>>()?;
            OwnShapes::from_numbers(&reference, strands.len(), &numbers)
        } else {
            None
        };
        if left > 0 && own.is_none() {
            return Err(bad(format!("{left} bytes are left over")));
        }
        Ok(Self { own, ..Self::assembled(settings, reference, strands, curls)? })
    }
}

fn strand(body: &mut Reader, guides: usize) -> Result<RenderStrand> {
    let mut followed = [0; MAX_GUIDES];
    for guide in &mut followed {
        *guide = body.u32()?;
        if *guide as usize >= guides {
            return Err(bad(format!("a strand follows guide {guide} of {guides}")));
        }
    }
    let (weights, roots) = (body.singles()?, body.rows()?);
    let (middle, offset, gather) = (body.singles()?, body.singles()?, body.singles()?);
    let (frizz, frizz_turn, clump, clump_turn) = (body.u32()?, body.singles()?, body.u32()?, body.singles()?);
    let [radius, length] = body.singles()?;
    let wisp = body.u32()?;
    if [frizz, clump].iter().any(|curve| *curve as usize >= crate::groom::render_hair::points::profile::CURVES) {
        return Err(bad(format!(
            "a strand strays along curve {frizz} or {clump} of {}",
            crate::groom::render_hair::points::profile::CURVES
        )));
    }
    if !(length > 0.0 && length <= 1.0) || radius < 0.0 {
        return Err(bad(format!("a strand has {length} of its length and {radius} of its radius")));
    }
    Ok(RenderStrand {
        guides: followed,
        weights,
        roots,
        middle,
        offset,
        gather,
        frizz,
        frizz_turn,
        clump,
        clump_turn,
        radius,
        length,
        wisp,
    })
}

fn curl(body: &mut Reader) -> Result<RenderCurl> {
    Ok(RenderCurl { turns: body.rows()?, halves: body.rows()?, curled: body.flag()? })
}

impl Reference {
    /// From checked guides, as they were at binding.
    fn restored(
        rest: Vec<Vector3<f64>>,
        points: usize,
        rotations: Vec<UnitQuaternion<f64>>,
        rotations_given: bool,
        curved: bool,
    ) -> Self {
        let origins = rest.iter().step_by(points).copied().collect();
        let (guides, stride) = (rotations.len(), points.next_multiple_of(8));
        let mut reference =
            Self { points, stride, guides, rest, origins, rotations, rotations_given, curved, phases: Vec::new() };
        if curved {
            let mut shape = Shape::default();
            shape.update(&reference, &reference.rest, &reference.rotations);
            reference.phases = phase::phases(&reference, &shape);
        }
        reference
    }
}

/// All numbers of the settings, in file order.
fn numbers(settings: &RenderSettings) -> [f64; 20] {
    let mut copy = settings.clone();
    numbers_mut(&mut copy).map(|number| *number)
}

fn numbers_mut(s: &mut RenderSettings) -> [&mut f64; 20] {
    let [root, middle, tip] = &mut s.wisp_profile;
    [
        &mut s.curliness,
        &mut s.max_tip_distance,
        &mut s.max_tip_ratio,
        root,
        middle,
        tip,
        &mut s.flatness,
        &mut s.clump_noise,
        &mut s.clump_noise_waves,
        &mut s.flyaways,
        &mut s.flyaway_distance,
        &mut s.frizz,
        &mut s.frizz_waves,
        &mut s.radius,
        &mut s.tip_radius,
        &mut s.taper_from,
        &mut s.taper_shape,
        &mut s.radius_variation,
        &mut s.length_variation,
        &mut s.clearance,
    ]
}
