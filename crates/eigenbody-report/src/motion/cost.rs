//! What conditioning costs: tables and figures.

use super::{Page, number, shown, table};
use crate::figure::{Axis, Curve, Panel, Plot, Style};
use eigenbody_study::motion::cost::{Digits, Effort, LongRun, NORMS, PRECISIONS, WAYS, predicted};
use eigenbody_study::motion::{Group, quantile, rank_correlation};

const HEAD: &str = "# What ill-conditioning costs

Digits of forward dynamics, steps of an adaptive solver and energy, against κ and κ′. Written by `cargo xtask cost`, which needs the robots of
`cargo xtask oracle`.

";

const DIGITS: &str = "
Eight random configurations and velocities of each robot; forces are those of random accelerations. Error: |D^p (v̇ − v̇*)|/|D^p v̇*| over ε of the
precision, v̇* by articulated bodies in double-double; *plain*: p = 0; *inertia-weighted*: p = 1, D = diag(H)^½, each joint in units of its own
inertia. Rank correlations (Spearman) over all configurations of all robots; *off*: median of |log₁₀ (error/ε) − log₁₀ (κ′/4)|, digits.

";

const STEPS: &str = "
From a random configuration, joints at up to 2 rad/s, for one second, no damping; floating bases start at rest. *Steps*: Dormand-Prince at a tolerance of 1e-6. *Stiffness of
formulation*: steps at 1e-11 with H by CRBA and LTL over those with articulated bodies; 1 where the solver does not feel
the algorithm's rounding. *Drift*: of the energy, Runge-Kutta 4 in steps of 1 ms, against the largest kinetic energy; – where it blew up.

";

/// The page from what was found.
pub fn cost_page(digits: &[Digits], efforts: &[Effort], long_runs: &[LongRun]) -> Page {
    let mut text = HEAD.to_owned();
    text += &answer(digits, efforts);
    text += "\n## Digits\n";
    text += DIGITS;
    text += &correlations(digits);
    for name in PRECISIONS {
        text += &format!(
            "\n{}",
            shown(&format!("cost-{name}.svg"), &format!("errors in {name} against κ and κ′"))
        );
    }
    text += "\nInertia-weighted errors. Where a factorisation fails, there is no point.\n";
    text += &failures(digits);
    text += "\n## Steps and energy\n";
    text += STEPS;
    text += &effort_correlations(efforts);
    text += &format!("\n{}", shown("cost-steps.svg", "steps of an adaptive solver against κ and κ′"));
    text += &long_run_table(long_runs);
    text += &effort_table(efforts);
    let mut figures: Vec<(String, String)> = PRECISIONS
        .iter()
        .enumerate()
        .map(|(precision, name)| (format!("cost-{name}.svg"), digits_figure(digits, precision)))
        .collect();
    figures.push(("cost-steps.svg".into(), steps_figure(efforts)));
    Page { text, figures }
}

const LONG: &str = "
Ten links without friction for a thousand seconds, by the implicit midpoint rule in steps of 1 ms. *Largest* and *mean* error of the energy in each tenth of the time, of
the largest kinetic energy. Where links whip about, the error rises for a moment with their speed and falls back; neither the mean nor the peaks grow with time.

";

fn long_run_table(runs: &[LongRun]) -> String {
    let mut text = LONG.to_owned();
    text += "| released | fastest joint, rad/s | error |";
    text += &(1..=10).map(|k| format!(" {} s |", 100 * k)).collect::<String>();
    text += &format!("\n|{}\n", "---|".repeat(13));
    for run in runs {
        for (k, name) in ["largest", "mean"].into_iter().enumerate() {
            let tenths = run.tenths.iter().map(|tenth| format!(" {:.1e} |", tenth[k])).collect::<String>();
            text += &format!("| {} | {:.1} | {name} |{tenths}\n", run.name, run.fastest);
        }
    }
    text + "\n"
}

/// Configurations at which no factorisation failed in this precision and way.
fn solved(digits: &[Digits], way: usize, precision: usize, norm: usize) -> Vec<(&Digits, f64)> {
    let all = digits.iter().map(|one| (one, one.errors[way][precision][norm]));
    all.filter(|(_, error)| error.is_finite() && *error > 0.0).collect()
}

fn follows(points: &[(&Digits, f64)], of: impl Fn(&Digits) -> f64) -> f64 {
    let (x, y): (Vec<f64>, Vec<f64>) = points.iter().map(|(one, error)| (of(one), *error)).unzip();
    rank_correlation(&x, &y)
}

fn correlations(digits: &[Digits]) -> String {
    let mut rows = Vec::new();
    for (precision, precision_name) in PRECISIONS.iter().enumerate() {
        for (norm, norm_name) in NORMS.iter().enumerate() {
            for (way, way_name) in WAYS.iter().enumerate() {
                let points = solved(digits, way, precision, norm);
                let lost: Vec<f64> = points.iter().map(|(_, error)| error.log10()).collect();
                let off: Vec<f64> = points
                    .iter()
                    .map(|(one, error)| (error.log10() - predicted(one.kappa_weighted).log10()).abs())
                    .collect();
                rows.push(vec![
                    (*precision_name).to_owned(),
                    (*norm_name).to_owned(),
                    (*way_name).to_owned(),
                    format!("{:.2}", follows(&points, |one| one.kappa)),
                    format!("{:.2}", follows(&points, |one| one.kappa_weighted)),
                    format!("{:.1}", quantile(&lost, 0.5)),
                    format!("{:.1}", quantile(&lost, 0.99)),
                    format!("{:.1}", quantile(&off, 0.5)),
                    (digits.len() - points.len()).to_string(),
                ]);
            }
        }
    }
    let head = [
        "precision",
        "norm",
        "way",
        "rank correlation with κ",
        "with κ′",
        "median digits lost",
        "99%",
        "off",
        "failed",
    ];
    table(&head, &rows)
}

fn failures(digits: &[Digits]) -> String {
    let failed = |one: &&Digits| (0..WAYS.len()).any(|way| !one.errors[way][0][0].is_finite());
    let least = digits.iter().filter(failed).map(|one| one.kappa_weighted).fold(f64::INFINITY, f64::min);
    if least.is_finite() {
        format!("\nIn f32 a factorisation fails nowhere below κ′ = {}.\n", number(least))
    } else {
        "\nNo factorisation failed.\n".into()
    }
}

/// Rank correlations of an effort with κ, κ′ and the number of degrees of freedom.
fn effort_follows(efforts: &[Effort], of: impl Fn(&Effort) -> Option<f64>) -> [f64; 4] {
    let points: Vec<(&Effort, f64)> = efforts
        .iter()
        .filter_map(|one| Some((one, of(one)?)))
        .filter(|(one, x)| x.is_finite() && one.kappa.is_finite())
        .collect();
    let by = |x: fn(&Effort) -> f64| {
        let (x, y): (Vec<f64>, Vec<f64>) = points.iter().map(|(one, y)| (x(one), *y)).unzip();
        rank_correlation(&x, &y)
    };
    [
        by(|one| one.kappa),
        by(|one| one.kappa_weighted),
        by(|one| one.kappa / one.kappa_weighted),
        by(|one| one.dofs as f64),
    ]
}

fn stiffness(one: &Effort) -> Option<f64> {
    one.tight[1].zip(one.tight[0]).map(|(crba, aba)| crba / aba)
}

fn effort_correlations(efforts: &[Effort]) -> String {
    let row = |name: &str, group: Option<Group>, of: fn(&Effort) -> Option<f64>| {
        let some: Vec<Effort> =
            efforts.iter().filter(|one| group.is_none_or(|group| one.group == group)).cloned().collect();
        let found =
            effort_follows(&some, of).map(|x| if x.is_finite() { format!("{x:.2}") } else { "–".into() });
        let group = group.map_or("all", Group::name).to_owned();
        [vec![name.to_owned(), group], found.to_vec()].concat()
    };
    let mut rows = Vec::new();
    for (name, of) in [
        ("steps", (|one| one.steps) as fn(&Effort) -> Option<f64>),
        ("stiffness of formulation", stiffness),
        ("energy drift", |one| one.drift),
    ] {
        for group in [None, Some(Group::Chain), Some(Group::Robot)] {
            rows.push(row(name, group, of));
        }
    }
    table(&["", "robots", "rank correlation with κ", "with κ′", "with κ/κ′", "with n"], &rows)
}

fn effort_table(efforts: &[Effort]) -> String {
    let whole = |x: Option<f64>| x.map_or_else(|| "–".to_owned(), |x| format!("{x:.0}"));
    let row = |one: &Effort| {
        vec![
            one.name.clone(),
            one.dofs.to_string(),
            number(one.kappa),
            number(one.kappa_weighted),
            whole(one.steps),
            whole(one.tight[0]),
            whole(one.tight[1]),
            stiffness(one).map_or_else(|| "–".to_owned(), |x| format!("{x:.3}")),
            one.drift.map_or_else(|| "–".to_owned(), |x| format!("{x:.1e}")),
        ]
    };
    let head = [
        "robot",
        "n",
        "κ",
        "κ′",
        "steps, 1e-6",
        "1e-11, ABA",
        "1e-11, CRBA+LTL",
        "stiffness of formulation",
        "drift, RK4",
    ];
    table(&head, &efforts.iter().map(row).collect::<Vec<_>>())
}

fn answer(digits: &[Digits], efforts: &[Effort]) -> String {
    let range = |precision: usize, norm: usize, of: fn(&Digits) -> f64| {
        let all: Vec<f64> =
            (0..WAYS.len()).map(|way| follows(&solved(digits, way, precision, norm), of)).collect();
        format!(
            "{:.2} to {:.2}",
            all.iter().fold(1.0, |a: f64, b| a.min(*b)),
            all.iter().fold(-1.0, |a: f64, b| a.max(*b))
        )
    };
    let of_kappa: fn(&Digits) -> f64 = |one| one.kappa;
    let of_weighted: fn(&Digits) -> f64 = |one| one.kappa_weighted;
    let steps = effort_follows(efforts, |one| one.steps);
    let chains: Vec<Effort> = efforts.iter().filter(|one| one.group == Group::Chain).cloned().collect();
    let of_chains = effort_follows(&chains, |one| one.steps);
    let drift = effort_follows(efforts, |one| one.drift);
    let stiffest: Vec<f64> = efforts.iter().filter_map(stiffness).collect();
    let same = stiffest.iter().filter(|x| (*x - 1.0).abs() <= 0.01).count();
    let equal: Vec<&Effort> = efforts.iter().filter(|one| one.name.ends_with(",1.000)")).collect();
    let span = |of: &dyn Fn(&Effort) -> f64| {
        let all: Vec<f64> = equal.iter().map(|one| of(one)).collect();
        (number(quantile(&all, 0.0)), number(quantile(&all, 1.0)))
    };
    let (kappas, counts) = (span(&|one| one.kappa), span(&|one| one.steps.unwrap_or(f64::NAN)));
    format!(
        "**Which of the two predicts what.**\n\n\
         - *Digits, each joint in units of its own inertia*: κ′. Rank correlation {} in f64 and {} in f32 over the four ways of solving; with κ only {} and {}.\n\
         - *Digits in rad/s² and m/s² as they are*: κ before κ′, {} against {} in f64. Such a norm has the ratio of the joints' inertias in it, and \
         so has κ.\n\
         - *The way of solving* hardly matters: medians lie within half a digit of each other. A fourth of κ′ tells the loss to within a digit.\n\
         - *Steps of an adaptive solver*: κ along chains, {:.2} (κ′ {:.2}), because a longer or more tapered chain moves faster at its tip; over all robots \
         {:.2} with κ, {:.2} with κ′, {:.2} with κ/κ′, {:.2} with the number of joints; among real robots alone little. Over links of equal \
         size κ goes from {} to {} and steps from {} to {}.\n\
         - *Stiffness of the formulation*: not seen in f64. At a tolerance of 1e-11 the solver takes the same steps, to a hundredth, with CRBA and LTL as with \
         articulated bodies in {same} of {} cases, with κ′ up to {}; where not, motions are chaotic or rounding is felt a little, by hundredths of the steps at κ′ = 10⁷.\n\
         - *Energy drift at a fixed step*: rank {:.2} with κ/κ′, {:.2} with κ, {:.2} with κ′.\n",
        range(1, 1, of_weighted),
        range(0, 1, of_weighted),
        range(1, 1, of_kappa),
        range(0, 1, of_kappa),
        range(1, 0, of_kappa),
        range(1, 0, of_weighted),
        of_chains[0],
        of_chains[1],
        steps[0],
        steps[1],
        steps[2],
        steps[3],
        kappas.0,
        kappas.1,
        counts.0,
        counts.1,
        stiffest.len(),
        number(efforts.iter().map(|one| one.kappa_weighted).fold(0.0, f64::max)),
        drift[2],
        drift[0],
        drift[1],
    )
}

fn digits_figure(digits: &[Digits], precision: usize) -> String {
    let panel = |title: &str, of: fn(&Digits) -> f64| {
        let mut curves: Vec<Curve> = (0..WAYS.len())
            .map(|way| {
                let points = solved(digits, way, precision, 1);
                // Every other configuration: enough to see, half the file.
                let points = points.into_iter().step_by(2).map(|(one, error)| (of(one), error)).collect();
                Curve { name: WAYS[way].to_owned(), points, style: Style::nth(way).points() }
            })
            .collect();
        let ends: Vec<f64> = digits.iter().map(of).collect();
        let line = [quantile(&ends, 0.0).max(4.0), quantile(&ends, 1.0)].map(|x| (x, predicted(x)));
        curves.push(Curve {
            name: "a fourth of it".into(),
            points: line.into(),
            style: Style::nth(0).plain(),
        });
        Panel {
            title: String::new(),
            x: Axis::log(title),
            y: Axis::log(format!("error over ε, {}", PRECISIONS[precision])),
            curves,
        }
    };
    let panels = vec![panel("κ", |one| one.kappa), panel("κ′", |one| one.kappa_weighted)];
    Plot { panels, columns: 2 }.svg(&format!("Errors of forward dynamics in {}", PRECISIONS[precision]))
}

fn steps_figure(efforts: &[Effort]) -> String {
    let panel = |title: &str, label: &str, x: fn(&Effort) -> f64, y: fn(&Effort) -> Option<f64>| {
        let curve = |(k, group): (usize, Group)| {
            let points = efforts.iter().filter(|one| one.group == group && x(one).is_finite());
            let points = points.filter_map(|one| Some((x(one), y(one)?))).collect();
            Curve { name: group.name().to_owned(), points, style: Style::nth(k).points() }
        };
        let curves = [Group::Chain, Group::Tree, Group::Robot].into_iter().enumerate().map(curve).collect();
        Panel { title: String::new(), x: Axis::log(title), y: Axis::log(label), curves }
    };
    let kappa: fn(&Effort) -> f64 = |one| one.kappa;
    let weighted: fn(&Effort) -> f64 = |one| one.kappa_weighted;
    let panels = vec![
        panel("κ", "steps in a second", kappa, |one| one.steps),
        panel("κ′", "steps in a second", weighted, |one| one.steps),
        panel("κ", "energy drift", kappa, |one| one.drift),
        panel("κ′", "energy drift", weighted, |one| one.drift),
    ];
    Plot { panels, columns: 2 }.svg("Steps and energy against κ and κ′")
}
