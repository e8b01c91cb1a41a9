//! Removes guides from a map.

use nalgebra::Vector3;

use super::binding::Binder;
use super::weights::Guides;
use super::wisps;
use crate::error::{Error, Result};
use crate::groom::render_hair::RenderHair;
use crate::groom::render_hair::guides::shape::{Reference, Shape};
use crate::groom::render_hair::settings::RenderSettings;
use crate::workers::Workers;

impl RenderHair {
    /// The map without some guides. The others keep their order, and strands that follow none of the removed guides stay the
    /// same, to the bit. The rest follow the remaining guides as if bound to them, and join the nearest of their wisps.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] (`gone`) for nonexistent guides, repeated ones, or all of them; [`Error::Unsupported`] where
    /// threads cannot be started. Keeps a host's parallel loop; creates a new pool.
    pub fn without_guides(&self, gone: &[u32]) -> Result<Self> {
        let old = &self.reference;
        let mut stays = vec![true; old.guides];
        for (index, guide) in gone.iter().enumerate() {
            let name = || format!("gone[{index}]");
            let place = stays.get_mut(*guide as usize);
            let place = place.ok_or_else(|| Error::invalid(name(), guide, format!("a guide: 0 to {}", old.guides - 1)))?;
            if !std::mem::replace(place, false) {
                return Err(Error::invalid(name(), guide, "each guide once"));
            }
        }
        if gone.len() == old.guides {
            return Err(Error::invalid("gone (count)", gone.len(), "fewer than all guides"));
        }
        // The new index of each remaining guide.
        let mut left = 0;
        let numbers: Vec<Option<u32>> = stays
            .iter()
            .map(|stays| {
                stays.then(|| {
                    left += 1;
                    left - 1
                })
            })
            .collect();
        let kept = |guide: usize| stays[guide];
        let reference = Reference {
            points: old.points,
            stride: old.stride,
            guides: left as usize,
            rest: old
                .rest
                .chunks(old.points)
                .enumerate()
                .filter(|(guide, _)| kept(*guide))
                .flat_map(|(_, p)| p.to_vec())
                .collect(),
            origins: of_kept(&old.origins, &stays),
            rotations: of_kept(&old.rotations, &stays),
            rotations_given: old.rotations_given,
            curved: old.curved,
            phases: old.phases.chunks(old.stride).enumerate().filter(|(g, _)| kept(*g)).flat_map(|(_, p)| p.to_vec()).collect(),
        };
        let mut shape = Shape::default();
        shape.update(&reference, &reference.rest, &reference.rotations);

        let root = |index: usize| -> Vector3<f64> {
            let (strand, guide) = (&self.strands[index], self.strands[index].guides[0] as usize);
            old.origins[guide] + old.rotations[guide] * Vector3::from(strand.roots[0].map(f64::from))
        };
        let (mut strands, mut curls) = (self.strands.clone(), self.curls.clone());
        let mut orphans = Vec::new();
        let mut middles: Vec<Vec<(u32, [f32; 2])>> = vec![Vec::new(); reference.guides];
        for (index, strand) in strands.iter_mut().enumerate() {
            let followed = strand.guides.map(|guide| numbers[guide as usize]);
            match followed {
                [Some(a), Some(b), Some(c), Some(d)] => {
                    strand.guides = [a, b, c, d];
                    let list = &mut middles[a as usize];
                    if !list.iter().any(|(wisp, _)| *wisp == strand.wisp) {
                        list.push((strand.wisp, strand.middle));
                    }
                }
                _ => orphans.push(index),
            }
        }
        let roots: Vec<Vector3<f64>> = orphans.iter().map(|index| root(*index)).collect();
        let mut cells = vec![Vec::new(); reference.guides];
        let nearness = Guides::new(&reference.rest, reference.points);
        let mut found = Vec::new();
        let settings = RenderSettings { workers: Workers::Serial, ..self.settings.clone() };
        let followed = roots.iter().map(|root| nearness.of(*root, &settings, &mut found)).collect::<Result<Vec<_>>>()?;
        for (place, followed) in followed.iter().enumerate() {
            cells[followed.guides[0] as usize].push(place as u32);
        }
        let binder = Binder::new(&settings, &reference, &shape, &cells, &roots, None);
        for ((index, root), followed) in orphans.iter().zip(&roots).zip(&followed) {
            let (mut strand, curl) = binder.strand(*index, *root, followed);
            let list = &middles[strand.guides[0] as usize];
            let places: Vec<[f32; 2]> = list.iter().map(|(_, middle)| *middle).collect();
            if let Some((wisp, middle)) = list.get(wisps::nearest(strand.offset, &places)) {
                strand.wisp = *wisp;
                strand.middle = *middle;
                strand.offset = [0, 1].map(|axis| strand.offset[axis] - middle[axis]);
            }
            binder.in_wisp(&mut strand);
            strands[*index] = strand;
            if let (Some(place), Some(curl)) = (curls.get_mut(*index), curl) {
                *place = curl;
            }
        }
        let mut made = Self::assembled(self.settings.clone(), reference, strands, curls)?;
        made.own = self.own.as_ref().map(|own| own.rebound(self, &made, &orphans));
        Ok(made)
    }
}

fn of_kept<T: Copy>(list: &[T], stays: &[bool]) -> Vec<T> {
    list.iter().zip(stays).filter(|(_, stays)| **stays).map(|(item, _)| *item).collect()
}
