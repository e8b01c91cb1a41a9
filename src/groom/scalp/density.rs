//! The relative density of follicles over a scalp.

use super::{Follicle, Scalp};
use crate::error::{Error, Result, check_not_negative, check_positive};
use crate::groom::curves::guide_roots::GuideRoots;

/// Relative density over a scalp: numbers of 0 or above, of which only the ratios count.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Density {
    /// The same everywhere.
    #[default]
    Uniform,
    /// A number for each vertex, linear in between.
    Vertices(Vec<f64>),
    /// A picture over the texture coordinates: row after row from v = 0, with pixel centres at (k + ½)/width, linear in between,
    /// repeated outside 0 to 1.
    Picture {
        /// Pixels of a row.
        width: usize,
        /// Rows.
        height: usize,
        /// width·height numbers.
        values: Vec<f64>,
    },
    /// By guides' roots, place by place, however coarse the mesh is.
    Roots(GuideRoots, RootRegion),
    /// The product of all of them.
    Product(Vec<Density>),
}

/// The region that roots define.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RootRegion {
    /// Places closer to one than this, m: [`GuideRoots::near`].
    Within(f64),
    /// What they cover with this spacing, m: [`GuideRoots::cover`]. [`GuideRoots::spacing`] measures it.
    Covered(f64),
}

impl Density {
    /// Checks the numbers against a scalp.
    pub(super) fn check(&self, scalp: &Scalp) -> Result<()> {
        let numbers = match self {
            Density::Uniform => return Ok(()),
            Density::Product(factors) => return factors.iter().try_for_each(|factor| factor.check(scalp)),
            Density::Roots(_, RootRegion::Within(within)) => return check_positive(|| "within".into(), *within),
            Density::Roots(_, RootRegion::Covered(spacing)) => return check_positive(|| "spacing".into(), *spacing),
            Density::Vertices(values) => {
                let needed = scalp.vertices.len();
                if values.len() != needed {
                    return Err(Error::invalid("density (count)", values.len(), format!("{needed}, one for each vertex")));
                }
                values
            }
            Density::Picture { width, height, values } => {
                if scalp.uvs.is_none() {
                    return Err(Error::invalid(
                        "density",
                        "a picture",
                        "a number for each vertex: the scalp has no texture coordinates",
                    ));
                }
                if *width == 0 || *height == 0 || width.checked_mul(*height) != Some(values.len()) {
                    let value = format!("{width} x {height}, {} numbers", values.len());
                    return Err(Error::invalid("density (count)", value, "width times height numbers, at least one"));
                }
                values
            }
        };
        for (index, value) in numbers.iter().enumerate() {
            check_not_negative(|| format!("density[{index}]"), *value)?;
        }
        if !numbers.iter().any(|value| *value > 0.0) {
            return Err(Error::invalid("density", "0 everywhere", "a number above zero somewhere"));
        }
        Ok(())
    }

    /// An upper bound on the density.
    pub(super) fn most(&self) -> f64 {
        match self {
            Density::Uniform | Density::Roots(..) => 1.0,
            Density::Product(factors) => factors.iter().map(Density::most).product(),
            Density::Vertices(values) | Density::Picture { values, .. } => values.iter().copied().fold(0.0, f64::max),
        }
    }

    /// The density at a place.
    pub(super) fn at(&self, scalp: &Scalp, follicle: &Follicle) -> f64 {
        let (index, weights) = (follicle.triangle as usize, follicle.weights());
        match self {
            Density::Uniform => 1.0,
            Density::Product(factors) => factors.iter().map(|factor| factor.at(scalp, follicle)).product(),
            // The distances have been checked.
            Density::Roots(roots, RootRegion::Within(within)) => roots.near(scalp.place(follicle), *within).unwrap_or(0.0),
            Density::Roots(roots, RootRegion::Covered(spacing)) => roots.cover(scalp.place(follicle), *spacing).unwrap_or(0.0),
            Density::Vertices(values) => {
                let triangle = &scalp.triangles[index];
                (0..3).map(|corner| weights[corner] * values[triangle[corner] as usize]).sum::<f64>().max(0.0)
            }
            Density::Picture { width, height, values } => {
                let Some(uvs) = &scalp.uvs else { return 0.0 };
                let uv = [0, 1].map(|axis| (0..3).map(|corner| weights[corner] * uvs[index][corner][axis]).sum::<f64>());
                let (x, y) = (uv[0] * *width as f64 - 0.5, uv[1] * *height as f64 - 0.5);
                let (left, low) = (x.floor(), y.floor());
                let pixel = |column: f64, row: f64| {
                    let wrap = |at: f64, size: usize| (at.rem_euclid(size as f64) as usize).min(size - 1);
                    values[wrap(row, *height) * width + wrap(column, *width)]
                };
                let mix = |row: f64| pixel(left, row) * (1.0 - (x - left)) + pixel(left + 1.0, row) * (x - left);
                mix(low) * (1.0 - (y - low)) + mix(low + 1.0) * (y - low)
            }
        }
    }
}
