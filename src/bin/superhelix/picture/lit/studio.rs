//! The lights of a picture: a key from above the viewer's left shoulder, a rim from behind on the right, and a bright room about them. They
//! stay with the viewer, so that every view is lit alike.

use std::f32::consts::FRAC_1_PI;

use nalgebra::Vector3;
use rayon::prelude::*;

use super::fibre::{Fibre, Scattered, scatter};
use super::shade_map::ShadeMap;
use super::skin::Skin;
use super::threads::Threads;

/// How fine the maps of lamps and of the room are.
const FINE_LAMP: usize = 120;
const FINE_ROOM: usize = 40;

/// How much a hair's width dims light that is not scattered further, and how much of the dimming colour takes back (the forward scattering
/// of Zinke et al. 2008, simplified: what goes on from hair to hair takes on their colour).
const DIMMING: f32 = 0.95;
const PASSED_ON: f32 = 0.8;
/// Exponent of the colour of light that many hairs scattered.
const TINT: f32 = 0.72;

/// Direction towards a light (right, up, towards the viewer, any length), and what it brings, linear red, green, blue.
struct Lamp {
    towards: [f32; 3],
    brings: [f32; 3],
}

const LAMPS: [Lamp; 2] = [
    Lamp { towards: [-0.62, 0.72, 0.62], brings: [3.4, 3.2, 2.95] },
    Lamp { towards: [0.72, 0.48, -0.62], brings: [3.3, 3.2, 3.1] },
];

const ROOM: [Lamp; 4] = [
    Lamp { towards: [0.0, 1.0, -0.15], brings: [0.55, 0.57, 0.61] },
    Lamp { towards: [-0.8, 0.25, 0.65], brings: [0.34, 0.34, 0.35] },
    Lamp { towards: [0.8, 0.25, 0.65], brings: [0.37, 0.38, 0.41] },
    Lamp { towards: [0.0, -0.7, 0.6], brings: [0.20, 0.19, 0.18] },
];

/// What bodies look like: clay of the colour of skin.
const CLAY: [f32; 3] = [0.50, 0.375, 0.315];
const SHEEN: f32 = 0.05;
const SHEEN_POWER: i32 = 24;

/// A hair's colours.
#[derive(Debug, Clone, Copy)]
pub struct Dye {
    fibre: Fibre,
    /// Of light that many hairs scattered.
    tint: [f32; 3],
    /// What such light loses by crossing a hair's width.
    lost: [f32; 3],
}

/// The light at a place.
#[derive(Debug, Clone, Copy, Default)]
pub struct Shade {
    /// Of each lamp, the share that comes straight, then red, green and blue of what is passed on from hair to hair.
    lamps: [[f32; 4]; LAMPS.len()],
    /// Of the room.
    room: [f32; 3],
}

impl Shade {
    /// Between this, at 0, and another, at 1.
    pub fn mixed(&self, other: &Shade, share: f32) -> Self {
        let mix = |a: f32, b: f32| a + (b - a) * share;
        let mut mixed = *self;
        for (lamp, other) in mixed.lamps.iter_mut().flatten().zip(other.lamps.iter().flatten()) {
            *lamp = mix(*lamp, *other);
        }
        for (room, other) in mixed.room.iter_mut().zip(other.room) {
            *room = mix(*room, other);
        }
        mixed
    }
}

struct Light {
    towards: Vector3<f32>,
    brings: [f32; 3],
    map: ShadeMap,
}

/// Lights that see the hair and the bodies of one picture.
pub struct Studio {
    lamps: Vec<Light>,
    room: Vec<Light>,
}

impl Studio {
    /// Looks at what is to be lit.
    pub fn new(threads: &Threads, skins: &[Skin]) -> Self {
        let all: Vec<(&Lamp, usize)> =
            LAMPS.iter().map(|lamp| (lamp, FINE_LAMP)).chain(ROOM.iter().map(|lamp| (lamp, FINE_ROOM))).collect();
        let mut lamps: Vec<Light> = all
            .par_iter()
            .map(|(lamp, fine)| {
                let towards = Vector3::from(lamp.towards).normalize();
                Light { towards, brings: lamp.brings, map: ShadeMap::new(towards, threads, skins, *fine) }
            })
            .collect();
        let room = lamps.split_off(LAMPS.len());
        Self { lamps, room }
    }

    /// How a hair's colour shows, and what of it comes through others.
    pub fn dye(fibre: Fibre) -> Dye {
        let tint = fibre.colour.map(|colour| colour.max(0.0).powf(TINT));
        Dye { fibre, tint, lost: tint.map(|tint| DIMMING * (1.0 - PASSED_ON * tint)) }
    }

    /// The light at a place where a hair runs along `along` (of length 1).
    pub fn shade(&self, place: Vector3<f32>, along: Vector3<f32>, dye: &Dye) -> Shade {
        let mut shade = Shade::default();
        for (lamp, light) in shade.lamps.iter_mut().zip(&self.lamps) {
            let open = light.map.open(place);
            if open > 0.0 {
                let crossed = light.map.crossed(place);
                let through = |loss: f32| open * (-loss * crossed).exp();
                *lamp = [through(DIMMING), through(dye.lost[0]), through(dye.lost[1]), through(dye.lost[2])];
            }
        }
        for light in &self.room {
            let crossed = light.map.crossed(place);
            let sine = (1.0 - along.dot(&light.towards).powi(2)).max(0.0).sqrt();
            let open = light.map.open(place) * sine * FRAC_1_PI;
            for channel in 0..3 {
                shade.room[channel] += open * light.brings[channel] * (-dye.lost[channel] * crossed).exp();
            }
        }
        shade
    }

    /// What a hair in such light sends to the viewer.
    pub fn hair(&self, shade: &Shade, along: Vector3<f32>, dye: &Dye) -> [f32; 3] {
        let mut sum = [0, 1, 2].map(|channel| shade.room[channel] * dye.tint[channel]);
        for (lamp, light) in shade.lamps.iter().zip(&self.lamps) {
            let Scattered { single, multiple } = scatter(along, light.towards, &dye.fibre);
            for channel in 0..3 {
                let passed_on = dye.tint[channel] * multiple * lamp[1 + channel];
                sum[channel] += light.brings[channel] * (single[channel] * lamp[0] + passed_on);
            }
        }
        sum
    }

    /// What a body sends to the viewer from a place of its surface.
    pub fn body(&self, place: Vector3<f32>, normal: Vector3<f32>) -> [f32; 3] {
        let mut sum = [0.0; 3];
        for light in &self.lamps {
            let facing = normal.dot(&light.towards).max(0.0);
            if facing == 0.0 {
                continue;
            }
            let passed = light.map.open(place) * (-DIMMING * light.map.crossed(place)).exp();
            let half = (light.towards + Vector3::z()).normalize();
            let sheen = SHEEN * normal.dot(&half).max(0.0).powi(SHEEN_POWER);
            for channel in 0..3 {
                let diffuse = CLAY[channel] * FRAC_1_PI * facing;
                sum[channel] += passed * light.brings[channel] * (diffuse + sheen);
            }
        }
        for light in &self.room {
            // Each stands for a wide part of the room.
            let facing = (0.5 + 0.5 * normal.dot(&light.towards)).powi(2);
            let passed = light.map.open(place) * (-DIMMING * light.map.crossed(place)).exp();
            for channel in 0..3 {
                sum[channel] += passed * facing * light.brings[channel] * CLAY[channel];
            }
        }
        sum
    }
}
