//! The engine against theory: statics, motion, vibration, equilibria and their branches, numbers of elements.

mod branch_following;
mod coil;
mod dynamics;
mod element_suggestions;
mod equilibrium_search;
mod rest_energy_invariance;
mod rods;
mod statics;
mod vibration;
mod whirl;
