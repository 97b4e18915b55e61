//! The complementarity problem alone: it ends, breaks its cycles, and every condition holds.

use faer::Mat;
use gearwear_fem::active_set::{Condensed, ContactEquilibrium};
use proptest::prelude::*;

/// C = A Aᵀ + shift·I for A with n rows and `columns` columns, given row by row.
fn compliance(a: &[f64], (n, columns): (usize, usize), shift: f64) -> Mat<f64> {
    Mat::from_fn(n, n, |i, j| {
        let product: f64 = (0..columns).map(|k| a[i * columns + k] * a[j * columns + k]).sum();
        if i == j { product + shift } else { product }
    })
}

/// Largest violation of g = g⁰ + C f + G α ≥ 0, f ≥ 0, f g = 0 and Gᵀ f = q, relative to the greatest of each.
fn violation(problem: &Condensed, found: &ContactEquilibrium) -> f64 {
    let n = problem.gap_mm.len();
    let gap: Vec<f64> = (0..n)
        .map(|i| {
            let elastic: f64 = (0..n).map(|j| problem.compliance[(i, j)] * found.force[j]).sum();
            let rigid: f64 = found.rigid.iter().enumerate().map(|(a, alpha)| problem.rigid[(i, a)] * alpha).sum();
            problem.gap_mm[i] + elastic + rigid
        })
        .collect();
    let greatest = |values: &[f64]| values.iter().fold(f64::MIN_POSITIVE, |most, value| most.max(value.abs()));
    let rigid_part = |i: usize| (0..found.rigid.len()).map(|a| (problem.rigid[(i, a)] * found.rigid[a]).abs()).sum();
    let rigid: Vec<f64> = (0..n).map(rigid_part).collect();
    let gap_scale = greatest(&gap).max(greatest(&problem.gap_mm)).max(greatest(&rigid));
    let force_scale = greatest(&found.force);
    let mut worst = 0.0_f64;
    for (g, f) in gap.iter().zip(&found.force) {
        let (g, f) = (g / gap_scale, f / force_scale);
        worst = worst.max(-g).max(-f).max(g.min(f).abs());
    }
    for (a, load) in problem.rigid_load.iter().enumerate() {
        let sum: f64 = (0..n).map(|i| problem.rigid[(i, a)] * found.force[i]).sum();
        worst = worst.max((sum - load).abs() / force_scale);
    }
    worst
}

/// Numbers between −1 and 1 from D. H. Lehmer's generator with the multiplier of S. K. Park and K. W. Miller (1988).
fn numbers(seed: u64) -> impl Iterator<Item = f64> {
    let mut state = seed;
    std::iter::repeat_with(move || {
        state = state * 48_271 % 2_147_483_647;
        2.0 * state as f64 / 2_147_483_647.0 - 1.0
    })
}

/// Few columns make neighbours overshoot each other, which is what lets full exchanges cycle.
fn random(seed: u64, (n, columns): (usize, usize)) -> Condensed {
    let mut next = numbers(seed);
    let a: Vec<f64> = next.by_ref().take(n * columns).collect();
    Condensed {
        compliance: compliance(&a, (n, columns), 1e-4),
        gap_mm: next.take(n).collect(),
        rigid: Mat::zeros(n, 0),
        rigid_load: Vec::new(),
    }
}

/// A parabola on 41 multipliers, pressed down by one motion: those in the middle touch.
fn parabola() -> Condensed {
    let n = 41_i32;
    let across = |i: usize| f64::from(i as i32 - n / 2);
    Condensed {
        compliance: Mat::from_fn(n as usize, n as usize, |i, j| (-0.2 * (across(i) - across(j)).abs()).exp()),
        gap_mm: (0..n as usize).map(|i| 0.05 * across(i).powi(2)).collect(),
        rigid: Mat::from_fn(n as usize, 1, |_, _| -1.0),
        rigid_load: vec![-5.0],
    }
}

/// On gaps that change a little the active set stays, and forces and motion are to the bit those of the whole solution; where a member pulls or its neighbour
/// penetrates nothing is solved, and a far one is not looked at.
#[test]
fn ver_solved_again_with_the_same_active_set() {
    let problem = parabola();
    let mut kept = None;
    let before = problem.solve_with(None, &mut kept).expect("it touches");
    let last = before.active.iter().rposition(|active| *active).expect("it touches");
    assert!((22..36).contains(&last), "{last}");
    let again = |change: &dyn Fn(usize) -> f64| {
        let (mut found, mut kept) = (before.clone(), kept.clone().expect("there is a solution"));
        let asked = kept.asked(problem.compliance.as_ref(), &found.active).expect("with this active set");
        let gap_mm = (0..41).map(|i| if asked[i] { problem.gap_mm[i] + change(i) } else { f64::NAN }).collect();
        let asks = asked.iter().filter(|asked| **asked).count();
        let solved = Condensed { gap_mm, ..problem.clone() }.solve_again(&mut found, &kept);
        let gap_mm = (0..41).map(|i| problem.gap_mm[i] + change(i)).collect();
        let whole = Condensed { gap_mm, ..problem.clone() }.solve(Some(&before.active)).expect("it touches");
        (solved, found, whole, asks)
    };
    let (solved, found, whole, asks) = again(&|i| 1e-3 * (i as f64).sin());
    assert!(solved && asks == 2 * (last + 4) - 40 + 1, "{asks}");
    assert_eq!((&found.force, &found.rigid, &found.active), (&whole.force, &whole.rigid, &whole.active));
    assert!(found.force != before.force && violation(&problem, &before) < 1e-9);
    for (place, change) in [(last, 2.0), (last + 1, -2.0), (last + 4, -10.0)] {
        let (solved, found, whole, _) = again(&|i| if i == place { change } else { 0.0 });
        assert!(!solved && found == before && whole.active != before.active, "{place}");
    }
    let (solved, _, whole, _) = again(&|i| if i == 40 { -40.0 } else { 0.0 });
    assert!(solved && whole.active[40]);
}

/// The same problem on one body with a shift and a turn, pressed on between its outermost contacts.
fn on_a_body(problem: Condensed) -> Condensed {
    let n = problem.gap_mm.len();
    let place = |i: usize| -1.0 + 2.0 * i as f64 / (n - 1) as f64;
    let rigid = Mat::from_fn(n, 2, |i, k| if k == 0 { 1.0 } else { place(i) });
    Condensed { rigid, rigid_load: vec![1.0, 0.3], ..problem }
}

/// Among random problems full exchanges cycle now and then; each cycle is broken, counted, and the answer is right, after few active sets.
#[test]
fn ver_cycles_are_broken() {
    for (seeds, n, columns, [least_cycles, most]) in [(2000, 8, 3, [40, 30]), (100, 80, 40, [80, 150])] {
        let (mut cycles, mut longest) = (0, 0);
        for seed in 1..=seeds {
            let free = random(seed, (n, columns));
            for problem in [on_a_body(free.clone()), free] {
                match problem.solve(None) {
                    Ok(found) => {
                        assert!(violation(&problem, &found) < 1e-9, "{seed}: {}", violation(&problem, &found));
                        cycles += found.log.cycles_broken;
                        longest = longest.max(found.log.factorisations);
                    }
                    Err(error) => assert!(problem.gap_mm.iter().all(|gap| *gap > 0.0), "{seed}: {error}"),
                }
            }
        }
        println!("{cycles} of {} problems of {n} cycled; the longest took {longest} active sets", 2 * seeds);
        assert!(cycles > least_cycles && longest <= most, "{cycles}, {longest}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn prop_every_condition_holds(
        n in 2_usize..25,
        a in prop::collection::vec(-1.0..1.0_f64, 625),
        gap in prop::collection::vec(-1.0..1.0_f64, 25),
        shift in 1e-3..1.0_f64,
    ) {
        let problem = Condensed {
            compliance: compliance(&a, (n, n), shift),
            gap_mm: gap[..n].to_vec(),
            rigid: Mat::zeros(n, 0),
            rigid_load: Vec::new(),
        };
        match problem.solve(None) {
            Ok(found) => prop_assert!(violation(&problem, &found) < 1e-9, "{}", violation(&problem, &found)),
            Err(error) => prop_assert!(problem.gap_mm.iter().all(|gap| *gap > 0.0), "{error}"),
        }
    }

    /// One body with a shift and a turn, pressed on at a point between its outermost contacts.
    #[test]
    fn prop_with_rigid_motions(
        n in 3_usize..25,
        a in prop::collection::vec(-1.0..1.0_f64, 625),
        gap in prop::collection::vec(0.0..1.0_f64, 25),
        shift in 1e-3..1.0_f64,
        at in -0.9..0.9_f64,
        load in 1e-3..1e3_f64,
    ) {
        let place = |i: usize| -1.0 + 2.0 * i as f64 / (n - 1) as f64;
        let problem = Condensed {
            compliance: compliance(&a, (n, n), shift),
            gap_mm: gap[..n].to_vec(),
            rigid: Mat::from_fn(n, 2, |i, k| if k == 0 { 1.0 } else { place(i) }),
            rigid_load: vec![load, load * at],
        };
        let found = problem.solve(None);
        prop_assert!(found.is_ok(), "{:?}", found);
        if let Ok(found) = found {
            prop_assert!(violation(&problem, &found) < 1e-9, "{}", violation(&problem, &found));
        }
    }
}
