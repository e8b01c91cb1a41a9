//! Collisions of an element with a body during a step (`sweep.rs`, piece by piece).

use nalgebra::Vector3;

use super::sweep::{Hit, MovingChord, Near, along_nodes, first_hit};
use crate::contact::narrow_phase::ground::{Ground, Node};
use crate::contact::shape::{Bounds, Kind, Mesh, Patch, Sides, Surface};

/// Finds where the element's pieces run into the body during the step: arclength, and the surface as it is at the end.
pub(in crate::contact) fn sweep(ground: &Ground, thickness: f64, nodes: &[Node], hits: &mut Vec<(f64, Surface)>) {
    let level = (0.5 * thickness).max(1e-6);
    for pair in nodes.windows(2) {
        let chord = MovingChord { before: [pair[0].before, pair[1].before], after: [pair[0].now, pair[1].now] };
        if let Some(hit) = sweep_chord(ground, &chord, level) {
            let s = pair[0].s + (pair[1].s - pair[0].s) * hit.place;
            // Pieces share their ends.
            if hits.last().is_none_or(|(last, _)| (s - last).abs() > 1e-6) {
                hits.push((s, hit.near.what));
            }
        }
    }
    // A flat piece may be hit all along: where a piece is hit, its ends are checked as well.
    let chord_hits = hits.len();
    for (k, node) in nodes.iter().enumerate() {
        let beside = |s: f64| s >= nodes[k.saturating_sub(1)].s && s <= nodes[(k + 1).min(nodes.len() - 1)].s;
        if hits[..chord_hits].iter().any(|(s, _)| beside(*s)) && hits.iter().all(|(s, _)| (s - node.s).abs() > 1e-6) {
            let point = MovingChord { before: [node.before; 2], after: [node.now; 2] };
            if let Some(hit) = sweep_chord(ground, &point, level) {
                hits.push((node.s, hit.near.what));
            }
        }
    }
    // Pieces that start within a solid mesh come from where they are nearest to its surface then.
    if let Some(mesh) = ground.mesh.filter(|mesh| mesh.sides() == Sides::Solid) {
        for node in nodes {
            let start = mesh.closest_at_start(ground.patch, ground.reach, &node.before);
            if let Some(surface) = start.filter(|surface| surface.distance <= level) {
                hits.push((node.s, surface));
            }
        }
    }
    if let Kind::Grid(grid) = &ground.body.shape.0 {
        // On the last part of its path a node is no nearer to the surface than at its end, less what it has gone since.
        let slope = ground.body.shape.distance_slope();
        let clear = |node: &Node| {
            let distance = node.sample.map(|sample| sample.value).or(node.far);
            distance.map_or(0.0, |distance| ((distance - level) / slope).max(0.0))
        };
        along_nodes(
            nodes.iter().map(|node| (node.s, node.before, node.now, clear(node))),
            level,
            0.5 * grid.cell(),
            |point| grid.closest(point).ok_or_else(|| grid.clearance(&point)),
            hits,
        );
    }
}

/// Where a piece in straight motion runs into the body. A half-space has no other side, and a grid is swept by nodes.
fn sweep_chord(ground: &Ground, chord: &MovingChord, level: f64) -> Option<Hit<Surface>> {
    match (&ground.body.shape.0, ground.mesh) {
        (_, Some(mesh)) => sweep_mesh(mesh, ground.patch, chord, level),
        (Kind::Grid(_) | Kind::HalfSpace { .. }, _) => None,
        _ => first_hit(chord, level, 1.0, |point, _| {
            let surface = ground.body.shape.closest_smooth(*point);
            Near { normal: surface.normal, distance: surface.distance, coming: 0.0, what: surface }
        }),
    }
}

fn sweep_mesh(mesh: &Mesh, patch: &Patch, chord: &MovingChord, level: f64) -> Option<Hit<Surface>> {
    let one_sided = mesh.sides() != Sides::Both;
    // All paths of the piece's points lie in the hull of the positions of its ends.
    let places = [chord.before[0], chord.before[1], chord.after[0], chord.after[1]];
    let swept = Bounds::of_points(places).grown(1.1 * level);
    let mut earliest: Option<Hit<Surface>> = None;
    for index in &patch.triangles {
        let triangle = mesh.flat(*index);
        let travel = mesh.travel_of(*index);
        let before: [Vector3<f64>; 3] = std::array::from_fn(|corner| triangle.corners[corner] - travel[corner]);
        let apart = if mesh.is_moving() {
            !swept.meets(&Bounds::of_points(triangle.corners.into_iter().chain(before)))
        } else {
            !swept.meets(&Bounds::of_points(before)) || triangle.is_beside(&places, 1.1 * level)
        };
        if apart {
            continue;
        }
        let latest = earliest.map_or(1.0, |earliest| earliest.time);
        let hit = first_hit(chord, level, latest, |point, time| {
            let offset = if mesh.is_moving() {
                let corners: [Vector3<f64>; 3] = std::array::from_fn(|corner| before[corner] + travel[corner] * time);
                Mesh::closest_on(&corners, point).1
            } else {
                triangle.offset_to(point)
            };
            let distance = offset.norm();
            let normal = if distance > 0.0 { offset / distance } else { *triangle.normal() };
            let coming = if mesh.is_moving() {
                travel.iter().map(|travel| travel.dot(&normal)).fold(f64::NEG_INFINITY, f64::max)
            } else {
                0.0
            };
            Near { normal, distance, coming, what: *point }
        });
        let Some(Hit { time, place, near }) = hit else { continue };
        // A one-sided mesh stops nothing that comes from behind.
        if one_sided && near.normal.dot(triangle.normal()) <= 0.0 {
            continue;
        }
        if earliest.is_none_or(|earliest| time < earliest.time) {
            let corners: [Vector3<f64>; 3] = std::array::from_fn(|corner| before[corner] + travel[corner] * time);
            let (weights, _) = Mesh::closest_on(&corners, &near.what);
            let point = (0..3).map(|corner| triangle.corners[corner] * weights[corner]).sum();
            let what = Surface { point, normal: near.normal, distance: near.distance, feature: *index, weights };
            earliest =
                Some(Hit { time, place, near: Near { normal: near.normal, distance: near.distance, coming: near.coming, what } });
        }
    }
    earliest
}
