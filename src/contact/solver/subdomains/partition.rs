//! Divides a large problem into subdomains that threads sweep side by side: strands are halved by the positions of their roots,
//! again and again, each time across the axis that cuts fewest contacts. A contact between strands of two subdomains waits for
//! both: it is in the smallest subdomain that has them whole (`subdomains.rs`). No result depends on the threads, and the
//! number of subdomains depends on the problem alone.

use nalgebra::Vector3;

use super::smallest;

/// Problems of fewer contacts are not divided: the overhead would exceed the gain.
const LEAST: usize = 250;
/// How often strands are halved.
const HALVINGS: u32 = 2;

/// The strands of a contact; `None` where its partner is a body.
type Ends = [Option<u32>; 2];

/// Strands and contacts by subdomain. Its memory is kept.
#[derive(Debug, Default)]
pub struct Partition {
    /// The strands, subdomain by subdomain.
    pub strands: Vec<u32>,
    /// Every strand's index among them.
    pub place: Vec<u32>,
    /// The end of every lowest subdomain's strands.
    pub strand_ends: Vec<usize>,
    /// The end of the contacts of every subdomain of every level.
    pub constraint_ends: Vec<usize>,
    /// The contacts, subdomain by subdomain.
    constraints: Vec<u32>,
    /// Every strand's subdomain.
    part: Vec<u32>,
    roots: Vec<Vector3<f64>>,
    between: Vec<Ends>,
    weights: Vec<u64>,
    order: Vec<u32>,
    halved: Vec<u32>,
    best: Vec<u32>,
}

impl Partition {
    /// Divides strands with these roots, and contacts between them, if it `may` and there are enough.
    pub fn update(&mut self, roots: impl Iterator<Item = Vector3<f64>>, constraints: impl Iterator<Item = Ends>, may: bool) {
        self.roots.clear();
        self.roots.extend(roots);
        self.between.clear();
        self.between.extend(constraints);
        self.part.clear();
        self.part.resize(self.roots.len(), 0);
        let halvings = if may && self.between.len() >= LEAST { HALVINGS } else { 0 };
        if halvings > 0 {
            self.weigh();
            for level in 0..halvings {
                self.halve(1 << level);
            }
        }
        let Self { strands, place, part, .. } = self;
        strands.clear();
        strands.extend(0..part.len() as u32);
        strands.sort_by_key(|strand| part[*strand as usize]);
        place.clear();
        place.resize(part.len(), 0);
        for (at, strand) in strands.iter().enumerate() {
            place[*strand as usize] = at as u32;
        }
        self.order_constraints(1 << halvings);
    }

    /// Sorts a list with one entry per contact by subdomain.
    pub fn put_in_order(&mut self, list: &mut [u32]) {
        self.order.clear();
        self.order.extend(self.constraints.iter().map(|constraint| list[*constraint as usize]));
        list.copy_from_slice(&self.order);
    }

    fn weigh(&mut self) {
        self.weights.clear();
        self.weights.resize(self.part.len(), 0);
        for strand in self.between.iter().flatten().flatten() {
            self.weights[*strand as usize] += 1;
        }
    }

    /// Halves each of `subdomains`: number k becomes 2 k and 2 k + 1.
    fn halve(&mut self, subdomains: u32) {
        let Self { part, roots, between, weights, order, halved, best, .. } = self;
        let mut least = usize::MAX;
        for axis in 0..3 {
            halved.clear();
            halved.resize(part.len(), 0);
            for k in 0..subdomains {
                order.clear();
                order.extend((0..part.len() as u32).filter(|strand| part[*strand as usize] == k));
                let along = |strand: &u32| roots[*strand as usize][axis];
                order.sort_by(|a, b| along(a).total_cmp(&along(b)).then(a.cmp(b)));
                let weight = |strand: &u32| weights[*strand as usize];
                let (all, mut before) = (order.iter().map(weight).sum(), 0);
                for strand in order.iter() {
                    halved[*strand as usize] = 2 * k + u32::from(2 * before + weight(strand) > all);
                    before += weight(strand);
                }
            }
            let subdomains_of = |ends: &Ends| ends.map(|strand| strand.map(|strand| halved[strand as usize]));
            let cut =
                between.iter().map(subdomains_of).filter(|subdomains| matches!(subdomains, [Some(a), Some(b)] if a != b)).count();
            if cut < least {
                least = cut;
                std::mem::swap(halved, best);
            }
        }
        std::mem::swap(part, best);
    }

    fn order_constraints(&mut self, lowest: u32) {
        let Self { strands, constraints, strand_ends, constraint_ends, part, between, order, .. } = self;
        order.clear();
        order.extend(between.iter().map(|ends| smallest(lowest, ends.map(|strand| strand.map(|strand| part[strand as usize])))));
        constraints.clear();
        constraints.extend(0..between.len() as u32);
        constraints.sort_by_key(|constraint| order[*constraint as usize]);
        strand_ends.clear();
        strand_ends.extend((0..lowest).map(|k| strands.partition_point(|strand| part[*strand as usize] <= k)));
        constraint_ends.clear();
        constraint_ends
            .extend((0..2 * lowest - 1).map(|k| constraints.partition_point(|constraint| order[*constraint as usize] <= k)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Strands on a grid, each touching its neighbours and the ground.
    fn update(side: u32, may: bool) -> (Partition, Vec<Ends>) {
        let at = |k: u32| Vector3::new(f64::from(k % side), 0.1 * f64::from(k / side), 0.0);
        let mut constraints = Vec::new();
        for k in 0..side * side {
            constraints.push([Some(k), None]);
            constraints.extend((k % side + 1 < side).then_some([Some(k), Some(k + 1)]));
            constraints.extend((k + side < side * side).then_some([Some(k), Some(k + side)]));
        }
        let mut partition = Partition::default();
        partition.update((0..side * side).map(at), constraints.iter().copied(), may);
        (partition, constraints)
    }

    #[test]
    fn every_contact_of_a_subdomain_is_between_its_strands() {
        let (mut partition, constraints) = update(24, true);
        assert_eq!((partition.strand_ends.len(), partition.constraint_ends.len()), (4, 7));
        let mut order: Vec<u32> = (0..constraints.len() as u32).collect();
        partition.put_in_order(&mut order);
        let mut seen = order.clone();
        seen.sort_unstable();
        assert!(seen.iter().enumerate().all(|(k, constraint)| k as u32 == *constraint));
        let start = |k: usize| if k == 0 { 0 } else { partition.strand_ends[k - 1] };
        let leaves = [0..1, 1..2, 2..3, 3..4, 0..2, 2..4, 0..4];
        let mut first = 0;
        for (k, (end, leaves)) in partition.constraint_ends.iter().zip(leaves).enumerate() {
            let own = &partition.strands[start(leaves.start)..start(leaves.end)];
            for constraint in &order[first..*end] {
                assert!(
                    constraints[*constraint as usize].iter().flatten().all(|strand| own.contains(strand)),
                    "touch {constraint}"
                );
            }
            // Balanced by contacts, to a row of the grid.
            let fraction = (end - first) as f64 / constraints.len() as f64;
            assert!(
                if k < 4 { (0.2..0.27).contains(&fraction) } else { fraction > 0.0 && fraction < 0.05 },
                "part {k}: {fraction}"
            );
            first = *end;
        }
        assert_eq!((first, start(4)), (constraints.len(), partition.strands.len()));
        for (strand, place) in partition.place.iter().enumerate() {
            assert_eq!(partition.strands[*place as usize], strand as u32);
        }
    }

    #[test]
    fn small_or_indivisible_problems_stay_in_order() {
        for (side, may) in [(8, true), (24, false)] {
            let (mut partition, constraints) = update(side, may);
            let mut order: Vec<u32> = (0..constraints.len() as u32).collect();
            partition.put_in_order(&mut order);
            assert!(partition.strand_ends == [partition.strands.len()] && partition.constraint_ends == [constraints.len()]);
            assert!(order.is_sorted() && partition.strands.is_sorted());
        }
    }
}
