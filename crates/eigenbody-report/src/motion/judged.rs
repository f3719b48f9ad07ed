//! Estimators of κ: tables and figures.

use super::{Page, number, shown, table};
use crate::figure::{Axis, Curve, Panel, Plot, Style};
use eigenbody_study::motion::judged::{Cost, ESTIMATORS, Judgement, Motion, Row};
use eigenbody_study::motion::{quantile, rank_correlation};

const HEAD: &str = "# Estimators of κ, judged

How well cheap numbers tell κ along motions, beside κ itself, followed exactly. Written by `cargo xtask estimators`, which needs the robots
of `cargo xtask oracle`.

- **motions**, 2 s at 1000 rows a second (a thousand links: 0.06 s): *swinging*, released in a random configuration with light damping; *PD-driven*, a controller of 3 Hz pulls
  from one random posture to the next, two a second; *through the worst*, a straight line of a radian through the configuration with the
  largest κ that the joint limits allow; *random*, 300 independent configurations. Floating robots have H*, without their base.
- **estimators**: diagonal ratio r = max H_dd/min H_dd; scaled diagonal ratio δ_s = r κ(0)/r(0) (Shah & Saha 2013, Eq. 15); pivot ratio of Gaussian
  elimination; r κ′, the upper end of the bracket that always holds κ.
- **factor**: estimate over κ. 1 is exact.
";

/// The page from what was found.
pub fn judged_page(found: &[Judgement], costs: &[Cost]) -> Page {
    let mut text = HEAD.to_owned();
    text += "\n## How far the estimates are off\n\n";
    text += &distribution(found);
    text += &format!(
        "\n{}",
        shown("estimators.svg", "share of rows below a factor, for every estimator and motion")
    );
    text += "\nEach curve tells which share of rows has a factor below x. An exact estimator would be a step at 1.\n";
    text += &answer(found);
    text += "\n## What they cost\n\n";
    text += &cost_table(costs);
    text += &format!("\n{}", shown("estimators-cost.svg", "time a row over degrees of freedom"));
    text += "\nIn one run, one thread, best of five. *Tracker*: both ends, with modes and certificate. *Dense*: H by CRBA and all its eigenvalues \
             by this library's own solver; beside LAPACK and Pinocchio see [performance.md](performance.md).\n";
    text += "\n## Robot by robot\n\n";
    text += &robots(found);
    text += "\nWorst factors, as how many times too small or too large. *Tracker*: the largest relative error of λmin and λmax against the engine \
             without memory, over all rows where the engine itself knows them to 1e-13; factorisations a row and end, those of lost ends \
             included; ends lost and found again.\n";
    let figures = vec![
        ("estimators.svg".to_owned(), distribution_figure(found)),
        ("estimators-cost.svg".to_owned(), cost_figure(costs)),
    ];
    Page { text, figures }
}

fn rows_of(found: &[Judgement], motion: Motion) -> Vec<&Row> {
    found.iter().filter(|one| one.motion == motion).flat_map(|one| &one.rows).collect()
}

fn factors(rows: &[&Row], estimator: usize) -> Vec<f64> {
    rows.iter().map(|row| row.estimates[estimator] / row.kappa).filter(|x| x.is_finite()).collect()
}

fn distribution(found: &[Judgement]) -> String {
    let mut rows = Vec::new();
    for motion in Motion::ALL {
        let all = rows_of(found, motion);
        for (estimator, name) in ESTIMATORS.iter().enumerate() {
            let factors = factors(&all, estimator);
            let within = |by: f64| {
                let inside = factors.iter().filter(|&&x| x >= 1.0 / by && x <= by).count();
                format!("{:.0}%", 100.0 * inside as f64 / factors.len().max(1) as f64)
            };
            let follows: Vec<f64> = found
                .iter()
                .filter(|one| one.motion == motion)
                .map(|one| {
                    let pairs: Vec<(f64, f64)> = one
                        .rows
                        .iter()
                        .map(|row| (row.kappa, row.estimates[estimator]))
                        .filter(|pair| pair.1.is_finite())
                        .collect();
                    let (x, y): (Vec<f64>, Vec<f64>) = pairs.into_iter().unzip();
                    rank_correlation(&x, &y)
                })
                .filter(|x| x.is_finite())
                .collect();
            rows.push(vec![
                motion.name().to_owned(),
                (*name).to_owned(),
                number(quantile(&factors, 0.05)),
                number(quantile(&factors, 0.5)),
                number(quantile(&factors, 0.95)),
                within(1.1),
                within(2.0),
                within(10.0),
                format!("{:.2}", quantile(&follows, 0.5)),
            ]);
        }
    }
    let head = [
        "motion",
        "estimator",
        "5%",
        "median factor",
        "95%",
        "within 10%",
        "within 2×",
        "within 10×",
        "median rank correlation with κ along a motion",
    ];
    table(&head, &rows)
}

fn answer(found: &[Judgement]) -> String {
    let share = |motion: Motion, estimator: usize, by: f64| {
        let factors = factors(&rows_of(found, motion), estimator);
        let inside = factors.iter().filter(|&&x| x >= 1.0 / by && x <= by).count();
        100.0 * inside as f64 / factors.len().max(1) as f64
    };
    let worst = found.iter().map(|one| one.tracker_error).fold(0.0, f64::max);
    let outside = found
        .iter()
        .flat_map(|one| &one.rows)
        .filter(|row| {
            row.estimates[0] > row.kappa * (1.0 + 1e-9) || row.kappa > row.estimates[3] * (1.0 + 1e-9)
        })
        .count();
    let rows: usize = found.iter().map(|one| one.rows.len()).sum();
    let slow = found.iter().filter(|one| one.motion != Motion::Random);
    let moving: Vec<f64> = slow.map(|one| one.factorisations).collect();
    let mean = moving.iter().sum::<f64>() / moving.len().max(1) as f64;
    format!(
        "\n**In short.** The scaled diagonal ratio is within a factor of two of κ in {:.0}% of rows of swinging mechanisms, {:.0}% of driven ones and \
         {:.0}% of random configurations; within a tenth in {:.0}%, {:.0}% and {:.0}%. It is a calibration at one configuration, and good \
         as long as the motion stays near it. The bracket [r, r κ′] held κ in all but {outside} of {rows} rows. The tracker gives κ itself, to \
         {worst:.0e} against the engine without memory, at {mean:.2} factorisations a row and end over all smooth motions.\n",
        share(Motion::Swinging, 1, 2.0),
        share(Motion::Driven, 1, 2.0),
        share(Motion::Random, 1, 2.0),
        share(Motion::Swinging, 1, 1.1),
        share(Motion::Driven, 1, 1.1),
        share(Motion::Random, 1, 1.1),
    )
}

fn robots(found: &[Judgement]) -> String {
    let row = |one: &Judgement| {
        let kappas: Vec<f64> = one.rows.iter().map(|row| row.kappa).collect();
        let mut cells = vec![
            one.name.clone(),
            one.dofs.to_string(),
            one.motion.name().to_owned(),
            format!("{} to {}", number(quantile(&kappas, 0.0)), number(quantile(&kappas, 1.0))),
        ];
        for estimator in 0..ESTIMATORS.len() {
            let all: Vec<&Row> = one.rows.iter().collect();
            let factors = factors(&all, estimator);
            let worst = factors.iter().fold(1.0f64, |worst, x| worst.max(x.max(1.0 / x)));
            cells.push(if factors.is_empty() { "–".into() } else { format!("{}×", number(worst)) });
        }
        cells.push(format!("{:.0e}", one.tracker_error));
        cells.push(format!("{:.2}", one.factorisations));
        cells.push(one.restarts.to_string());
        cells
    };
    let head = [
        "robot",
        "n",
        "motion",
        "κ",
        "r",
        "δ_s",
        "pivot ratio",
        "r κ′",
        "tracker's error",
        "factorisations",
        "lost",
    ];
    let mut text = table(&head, &found.iter().map(row).collect::<Vec<_>>());
    let ended: Vec<String> = found
        .iter()
        .filter_map(|one| Some(format!("{}, {}: {}", one.name, one.motion.name(), one.ended.as_ref()?)))
        .collect();
    if !ended.is_empty() {
        text += &format!("\nMotions that ended early: {}.\n", ended.join("; "));
    }
    let unknown: usize = found.iter().map(|one| one.unknown).sum();
    if unknown > 0 {
        text += &format!(
            "\n{unknown} ends of the spectrum, of the robots with κ above 10¹⁰ most of all, are not known to 1e-13 by the engine itself.\n"
        );
    }
    text
}

fn cost_table(costs: &[Cost]) -> String {
    let micro = |s: f64| number(1e6 * s);
    let row = |one: &Cost| {
        vec![
            one.name.clone(),
            one.dofs.to_string(),
            micro(one.diagonal),
            micro(one.tracker),
            format!("{:.1}", one.tracker / one.diagonal),
            micro(one.pivots),
            micro(one.dense),
            format!("{:.1}", one.dense / one.tracker),
        ]
    };
    let head = [
        "robot",
        "n",
        "diagonal ratio, µs",
        "tracker, µs",
        "tracker/diagonal",
        "pivot ratio, µs",
        "dense, µs",
        "dense/tracker",
    ];
    table(&head, &costs.iter().map(row).collect::<Vec<_>>())
}

fn distribution_figure(found: &[Judgement]) -> String {
    let panel = |motion: Motion| {
        let rows = rows_of(found, motion);
        let curve = |estimator: usize| {
            let factors = factors(&rows, estimator);
            let points = (0..=200).map(|k| {
                let p = f64::from(k) / 200.0;
                (quantile(&factors, p), 100.0 * p)
            });
            Curve {
                name: ESTIMATORS[estimator].to_owned(),
                points: points.collect(),
                style: Style::nth(estimator).plain(),
            }
        };
        Panel {
            title: motion.name().to_owned(),
            x: Axis::log("estimate / κ"),
            y: Axis::linear("rows below (%)"),
            curves: (0..ESTIMATORS.len()).map(curve).collect(),
        }
    };
    Plot { panels: Motion::ALL.map(panel).into(), columns: 2 }.svg("Estimators of κ")
}

fn cost_figure(costs: &[Cost]) -> String {
    let curve = |k: usize, name: &str, of: fn(&Cost) -> f64| {
        let mut points: Vec<(f64, f64)> = costs.iter().map(|one| (one.dofs as f64, 1e6 * of(one))).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Curve { name: name.to_owned(), points, style: Style::nth(k).points() }
    };
    let curves = vec![
        curve(0, "tracker, both ends", |one| one.tracker),
        curve(1, "diagonal ratio", |one| one.diagonal),
        curve(2, "H and pivot ratio", |one| one.pivots),
        curve(3, "H and eigenvalues", |one| one.dense),
    ];
    let (x, y) = (Axis::log("degrees of freedom"), Axis::log("time a row (µs)"));
    Plot { panels: vec![Panel { title: String::new(), x, y, curves }], columns: 1 }
        .svg("Cost of κ and of its estimators")
}
