//! Steps in time, against trajectories of other software and against finer steps.

mod hard_cases;
mod oracle_cases;
mod oracle_trajectories;
mod peer_case;
mod price_list;
mod reference_integrator;
mod single_precision;
mod small_steps;
mod subdivision;
