//! A strand that is pressed along itself: its own matrix is indefinite, and what holds it in place is the contact.

use std::sync::Arc;

use nalgebra::Vector3;
use superhelix::{BodyDef, Frame, Friction, Shape, Solver, SolverOptions, StrandContact, StrandDef};

/// A ball that holds the tip comes 3 cm nearer to the root within 0.2 s: the strand, 10 cm long and bent by 0.2 rad, bows out.
#[test]
fn a_strand_pressed_along_itself_converges_in_a_few_iterations() {
    for elements in [5, 10, 20] {
        let mut solver = Solver::new(SolverOptions::default()).unwrap();
        let mut def = StrandDef::straight(0.1, elements);
        def.natural = vec![[0.0, 2.0, 0.0]; elements];
        let strand = solver.add_strands(&[def]).unwrap();
        let contact = StrandContact { friction: Friction::uniform(5.0), ..StrandContact::default() };
        solver.set_contact(&strand, Some(&contact)).unwrap();
        let (radius, steps) = (0.5, 12);
        let at = |step: u32| {
            let origin = Vector3::x() * (0.1005 + radius - 0.03 * f64::from(step) / f64::from(steps));
            Frame { origin, ..Frame::default() }
        };
        let ball = Arc::new(Shape::new_sphere(radius).unwrap());
        let ball = solver.add_bodies(vec![BodyDef { pose: at(0), ..BodyDef::new(ball) }]).unwrap();
        let mut most = 0;
        for step in 1..=steps {
            solver.set_body_frames(&ball, &[at(step)], 1.0 / 60.0).unwrap();
            let report = solver.step(1.0 / 60.0, 1).unwrap();
            assert_eq!(report.unconverged, 0, "{elements} elements, step {step}: {report:?}");
            most = most.max(report.contact.iterations);
        }
        println!("{elements} elements: {most} iterations, {} contacts", solver.contacts().len());
        assert!(most > 10, "{elements} elements are not pressed hard: {most}");
        assert!(most <= 30, "{elements} elements: {most}");
    }
}
