//! A strand that forces hold at stations and that takes its step by itself, an iteration at a time.

use super::Setting;
use super::held::Held;
use super::held_pack::HeldPack;
use super::members::One;
use crate::chain::load::Station;
use crate::math::vector::Vec3;

/// A strand that takes its step by itself.
#[derive(Debug, Default)]
pub struct Alone {
    /// The strand.
    pub held: Held,
    pack: HeldPack<f64>,
}

impl Alone {
    /// Makes room for so many stations.
    pub fn make_room(&mut self, stations: usize) {
        self.held.make_room(stations);
        self.pack.make_room(stations);
    }

    /// Begins a step of `h` seconds; `first_order`: by implicit Euler whatever the setting says.
    pub fn begin(&mut self, one: &One, setting: &Setting, h: f64, first_order: bool) {
        self.pack.begin(one, setting, h, first_order, &mut [Some(&mut self.held)]);
    }

    /// [`Held::hold`], and the first half of an iteration.
    pub fn linearise(&mut self, stations: &[Station], guess: &[Vec3<f64>]) {
        self.held.hold(stations, guess, &[]);
        self.pack.linearise(&mut [Some(&mut self.held)]);
    }

    /// [`Held::pull`], and the second half.
    pub fn advance(&mut self, setting: &Setting, forces: &[Vec3<f64>]) {
        self.held.pull(forces);
        self.pack.advance(setting, &mut [Some(&mut self.held)]);
    }
}
