//! The mathematics under the engine, formula by formula.

mod kernel_mathematics;
mod pose_spline;
mod quadrature;
