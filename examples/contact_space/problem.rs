//! A contact problem like that of a shaken head: strands over a head, their true responses, contacts with the head and each
//! other.

use nalgebra::Vector3;
use superhelix::Material;
use superhelix::internals::chain::delassus::Delassus;
use superhelix::internals::chain::elimination::Elimination;
use superhelix::internals::chain::load::{Load, MaterialPoint};
use superhelix::internals::chain::system::ChainSystem;
use superhelix::internals::contact::constraint::law::Law;
use superhelix::internals::contact::constraint::law::coefficient::Coefficient;
use superhelix::internals::contact::constraint::law::contact::{Contact, Friction};
use superhelix::internals::contact::constraint::law::response::Response;
use superhelix::internals::contact::solver::contact_space::{ContactSpace, End, SpaceConstraint};
use superhelix::internals::math::quadrature::Rule;
use superhelix::internals::math::vector::{Mat3, Vec3};
use superhelix::internals::rod::kinematics::Kinematics;

/// The head's radius, m.
const HEAD: f64 = 0.09;
/// The step, s.
pub const STEP: f64 = 1.0 / 60.0;

/// Numbers from 0 to 1, the same on every machine.
pub struct Numbers(pub u64);

impl Numbers {
    /// The next.
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

/// The parameters of the problem.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// Strands.
    pub strands: usize,
    /// Contacts of each with the head.
    pub elements: usize,
    /// Pairs per strand.
    pub on_head: usize,
    /// Pairs, a strand.
    pub pairs: f64,
    /// Coulomb's coefficient.
    pub mu: f64,
    /// Curvature in addition to that along the head, rad/m.
    pub curl: f64,
}

struct Strand {
    origin: Vector3<f64>,
    kinematics: Kinematics<f64>,
    material_points: Vec<MaterialPoint>,
}

/// Builds it. The second list is the unconstrained displacements of the next step, slightly different: for warm starts.
pub fn build(kind: &Kind) -> (ContactSpace, Vec<Vector3<f64>>) {
    let mut numbers = Numbers(7);
    let rule = Rule::gauss_legendre(8);
    let material = Material { youngs_modulus: 1e9, internal_friction: 1e-10, air_drag: 5e-6, ..Material::default() };
    let length = 0.25 / kind.elements as f64;
    let mut strands: Vec<Strand> = (0..kind.strands)
        .map(|index| {
            // A spiral over the upper half of the head; strands hang outwards and down along it.
            let z = 1.0 - (index as f64 + 0.5) / kind.strands as f64;
            let turn = 2.399963 * index as f64;
            let out = Vector3::new((1.0 - z * z).sqrt() * turn.cos(), (1.0 - z * z).sqrt() * turn.sin(), z);
            let down = (-Vector3::z() - out * -out.z).normalize();
            let side = out.cross(&down);
            let frame = Mat3([0, 1, 2].map(|i| [down[i], side[i], out[i]]));
            let curvatures: Vec<[f64; 3]> = (0..kind.elements)
                .map(|_| {
                    let mut noise = || kind.curl * numbers.within(-1.0, 1.0);
                    [noise(), 1.0 / HEAD + noise(), noise()]
                })
                .collect();
            let mut kinematics = Kinematics::default();
            kinematics.update(&frame, &vec![length; kind.elements], &curvatures, &rule);
            Strand { origin: out * HEAD, kinematics, material_points: Vec::new() }
        })
        .collect();

    let material_point = |numbers: &mut Numbers| {
        let place = numbers.within(0.05, 1.0) * kind.elements as f64 * 0.999_999;
        MaterialPoint::on(place as usize, place.fract() * length)
    };
    // (strand, material point) of the two ends.
    type Place = (usize, usize);
    let mut pairs: Vec<(Place, Option<Place>)> = Vec::new();
    for (index, strand) in strands.iter_mut().enumerate() {
        for _ in 0..kind.on_head {
            strand.material_points.push(material_point(&mut numbers));
            pairs.push(((index, strand.material_points.len() - 1), None));
        }
    }
    for _ in 0..(kind.pairs * kind.strands as f64) as usize {
        let first = (numbers.next() * kind.strands as f64) as usize;
        // Neighbours on the spiral: 1, 2, 3, 5, 8, 13, 21 farther.
        let away = [1, 2, 3, 5, 8, 13, 21][(numbers.next() * 7.0) as usize];
        let second = (first + away) % kind.strands;
        if second == first {
            continue;
        }
        for strand in [first, second] {
            let place = material_point(&mut numbers);
            strands[strand].material_points.push(place);
        }
        pairs
            .push(((first, strands[first].material_points.len() - 1), Some((second, strands[second].material_points.len() - 1))));
    }

    let mut space = ContactSpace::default();
    space.reset(STEP).unwrap();
    for strand in &mut strands {
        // From root to tip, as the elimination requires; the pairs keep their own order.
        let mut order: Vec<usize> = (0..strand.material_points.len()).collect();
        order.sort_by(|a, b| {
            let key = |k: &usize| (strand.material_points[*k].element, strand.material_points[*k].s);
            key(a).partial_cmp(&key(b)).unwrap()
        });
        let loads: Vec<_> =
            order.iter().map(|k| Load::at(&strand.kinematics.elements, &strand.material_points[*k], Vec3::zero())).collect();
        let mut system = ChainSystem { exact: false, ..ChainSystem::default() };
        let n = rule.len();
        system.resize(kind.elements, kind.elements * n);
        for p in 0..kind.elements * n {
            let weight = rule.weights[p % n] * length;
            system.point_stiffness[p] = weight * (material.linear_density() / (STEP * STEP) + material.air_drag / STEP);
            system.point_force[p] = Vec3::zero();
        }
        for element in 0..kind.elements {
            for axis in 0..3 {
                system.curvature_stiffness[element][axis] =
                    length * (material.stiffness()[axis] + material.dissipation()[axis] / STEP);
                system.curvature_force[element][axis] = 0.0;
            }
        }
        let (mut elimination, mut change) = (Elimination::default(), Vec::new());
        let mut operator = Delassus::default();
        elimination.solve_loaded(&strand.kinematics, &system, &loads, &[0, 1, 2], &mut change);
        operator.update(&elimination, &strand.kinematics, 0, &loads, &[0, 1, 2]);
        let m = loads.len();
        let matrix = space.add_strand(m);
        for (i, at_i) in order.iter().enumerate() {
            for (j, at_j) in order.iter().enumerate() {
                for a in 0..3 {
                    for b in 0..3 {
                        matrix[(3 * at_j + b) * 3 * m + 3 * at_i + a] = operator.columns[(3 * j + b) * 3 * m + 3 * i + a];
                    }
                }
            }
        }
    }

    // The head turns and sways: a strand lags behind, more so farther out, towards the head on one side of it.
    let mut next = Vec::new();
    for (first, second) in &pairs {
        let way = |(strand, material_point): (usize, usize), sway: Vector3<f64>| {
            let strand = &strands[strand];
            let place = strand.material_points[material_point];
            let s = (place.element as f64 * length + place.s) / 0.25;
            let at = strand.origin + Vector3::from(strand.kinematics.elements[place.element].point(place.s).position);
            (sway + Vector3::z().cross(&at) * 0.05) * (s * s)
        };
        let tangent = |(strand, material_point): (usize, usize)| {
            let place = strands[strand].material_points[material_point];
            let element = &strands[strand].kinematics.elements[place.element];
            let (a, b) = (element.point(place.s - 1e-5), element.point(place.s + 1e-5));
            (Vector3::from(b.position) - Vector3::from(a.position)).normalize()
        };
        let (normal, mu) = match second {
            None => {
                let strand = &strands[first.0];
                let place = strand.material_points[first.1];
                let at = strand.origin + Vector3::from(strand.kinematics.elements[place.element].point(place.s).position);
                (at.normalize(), Coefficient::of_scales(kind.mu, 1.5 * kind.mu, tangent(*first)))
            }
            Some(second) => {
                let (a, b) = (tangent(*first), tangent(*second));
                let across = a.cross(&b);
                let normal = if across.norm() > 1e-3 { across.normalize() } else { a.cross(&Vector3::x()).normalize() };
                let scales = |t| Coefficient::of_scales(kind.mu, 1.5 * kind.mu, t);
                (normal, Coefficient::of_two(scales(a), scales(b)))
            }
        };
        let gap = numbers.within(-2e-4, 5e-4);
        let unconstrained = |sway| {
            let mut u = way(*first, sway) + normal * gap;
            if let Some(second) = second {
                u -= way(*second, sway);
            }
            // Weight and curls press hair to the head all round.
            if second.is_none() { u - normal * 5e-4 } else { u }
        };
        let end = |(strand, point): (usize, usize)| End { strand: strand as u32, point: point as u32 };
        let law = Law::Contact(Contact { normal, response: Response::Hard, friction: Friction::Coulomb(mu) });
        let constraint = SpaceConstraint {
            first: end(*first),
            second: second.map(end),
            law,
            unconstrained: unconstrained(Vector3::new(0.01, 0.004, 0.0)),
        };
        space.add_constraint(constraint).unwrap();
        next.push(unconstrained(Vector3::new(0.0105, 0.0043, 0.0)));
    }
    (space, next)
}
