//! Numbers as tables: shown to six digits, exact in `<data value>`.

use super::html::{Html, table};
use super::{Page, heading, symbol};
use crate::diagnosis::{AdviceReport, SteppingReport};
use crate::number::significant;
use eigenbody_study::portrait::ModePlace;

/// A number with its exact value; `nothing` where there is none.
pub(super) fn data(id: &str, x: Option<f64>, nothing: &str) -> Html {
    match x {
        Some(x) => {
            let exact = format!("{x:?}");
            let attributes: Vec<(&'static str, &str)> = match id {
                "" => vec![("value", &exact)],
                id => vec![("id", id), ("value", &exact)],
            };
            Html::element("data", &attributes, Html::text(significant(x, 6).replace('-', "−")))
        }
        None => Html::text(nothing),
    }
}

/// Measures, digits, and the joints' rates where nothing is moved.
pub(super) fn summary(page: &Page) -> Html {
    let report = &page.report;
    let rows = report.worst.iter().map(|worst| {
        let nothing = if worst.measure == "lambda_min" { "0" } else { "∞" };
        let cell = |what: &str, x: Option<f64>| data(&format!("{}-{what}", worst.measure), x, nothing);
        let unit = if worst.measure == "lambda_min" { page.unit } else { "" };
        let (name, use_of) = match worst.measure {
            "kappa" => ("κ", "gains, explicit steps, gradients"),
            "kappa_weighted" => ("κ′", "digits of a solve"),
            _ => ("λmin", "least inertia of any motion"),
        };
        vec![
            Html::text(name),
            cell("worst", worst.worst),
            cell("median", worst.median),
            cell("tenth", worst.tenth),
            Html::text(unit),
            Html::text(use_of),
        ]
    });
    let headings = ["", "worst", "median", "worst tenth from", "unit", "matters for"];
    let mut whole = table("Over the joint limits", &headings, rows);
    if let Some(digits) = &report.digits {
        let rows = digits.lost.iter().map(|loss| {
            let cell = |precision: &str, x: Option<f64>| {
                data(&format!("lost-{}-{precision}", loss.method.replace(' ', "-")), x, "all")
            };
            vec![Html::text(loss.method), cell("f32", loss.f32), cell("f64", loss.f64)]
        });
        let kept = [(
            "kept by the worst of them",
            data("left-f32", Some(digits.left_in_f32), ""),
            data("left-f64", Some(digits.left_in_f64), ""),
        )];
        let rows = rows.chain(kept.map(|(what, a, b)| vec![Html::text(what), a, b]));
        let caption = "Decimal digits of an acceleration lost at the worst κ′, measured against double-double (single precision has 7.2, double 16.0)";
        whole.push(table(caption, &["way of solving", "single", "double"], rows));
        let predicted = Html::fixed("Predicted from κ′: ")
            .then(data("predicted-loss", Some(digits.predicted_loss), ""))
            .then(Html::text(" digits lost."));
        whole.push(Html::element("p", &[], predicted));
    }
    if let Some(found) = report.stepping.as_ref().filter(|found| found.passive) {
        whole.push(stepping(found));
    }
    for (k, motion) in report.null_motions.iter().enumerate() {
        let rows = motion.iter().map(|rate| vec![Html::text(&rate.joint), data("", Some(rate.rate), "")]);
        whole.push(table(&format!("Motion {} that moves no mass", k + 1), &["joint", "rate"], rows));
    }
    whole
}

/// What to add.
pub(super) fn advice(advice: &AdviceReport) -> Html {
    let goal = match advice.measure {
        "kappa" => "κ at most",
        "step" => "steps (s) of",
        _ => "λmin at least",
    };
    let rows = advice.added.iter().filter(|added| added.added > 0.0).map(|added| {
        vec![
            Html::text(&added.joint),
            data("", Some(added.authored), ""),
            data("", Some(added.added), ""),
            data("", Some(100.0 * added.inflation), ""),
        ]
    });
    let caption =
        format!("The least armature for {goal} {} in every configuration", significant(advice.wanted, 4));
    let mut whole = Html::words("h3", "Armature").then(table(
        &caption,
        &["joint", "has (kg m², kg)", "add", "% of its own inertia"],
        rows,
    ));
    if !advice.links.is_empty() {
        let rows = advice.links.iter().map(|link| {
            let trace = |inertia: &[f64; 6]| Some(inertia[..3].iter().sum());
            vec![
                Html::text(&link.link),
                data("", Some(link.mass), ""),
                data("", Some(link.added_mass), ""),
                data("", trace(&link.inertia), ""),
                data("", trace(&link.added_inertia), ""),
            ]
        });
        let headings = ["link", "mass (kg)", "add", "trace of its inertia (kg m²)", "add"];
        whole.push(table("Or matter about the centre of mass of one link", &headings, rows));
    }
    if !advice.limits.is_empty() {
        let rows = advice.limits.iter().map(|limit| {
            vec![
                Html::text(&limit.joint),
                data("", Some(limit.kept[0]), ""),
                data("", Some(limit.kept[1]), ""),
                data("", Some(100.0 * limit.lost), ""),
            ]
        });
        let headings = ["joint", "from (rad, m)", "to", "% of its range lost"];
        whole.push(table("Or a limit on one joint", &headings, rows));
    }
    whole
}

/// Stable steps, and what joints bear.
fn stepping(found: &SteppingReport) -> Html {
    let rows = found.limits.iter().map(|limit| {
        let joints: Vec<&str> = limit.joints.iter().take(2).map(|pull| pull.joint.as_str()).collect();
        vec![
            Html::text(limit.integrator),
            data("", limit.largest, "without limit"),
            Html::text(if limit.largest.is_some() { joints.join(", ") } else { String::new() }),
        ]
    });
    let headings = ["method", "largest stable step (s)", "what grows beyond it"];
    let mut whole =
        table("Time steps, with the stiffness, damping and gains that are known", &headings, rows);
    if let Some(step) = found.step {
        let rows = found.joints.iter().map(|joint| {
            vec![
                Html::text(&joint.joint),
                data("", Some(joint.stiffness), ""),
                data("", Some(joint.damping), ""),
                data("", Some(joint.inertia), ""),
                data("", joint.largest_kp, "any"),
                data("", joint.largest_kd, "any"),
            ]
        });
        let caption =
            format!("Gains that one joint bears alone at {} s, {}", significant(step, 4), found.integrator);
        let headings =
            ["joint", "stiffness", "damping", "least inertia, others free", "largest kp", "largest kd"];
        whole.push(table(&caption, &headings, rows));
    }
    whole
}

/// Joints of a mode with bars.
pub(super) fn mode(title: &str, mode: &ModePlace, names: &[String]) -> Html {
    let mut order: Vec<usize> = (0..names.len()).collect();
    order.sort_by(|&a, &b| mode.shares[b].total_cmp(&mode.shares[a]));
    let rows = order.iter().take(12).filter(|&&k| mode.shares[k] >= 5e-4).map(|&k| {
        let width = format!("width:{:.2}rem", 8.0 * mode.shares[k]);
        let bar = Html::element(
            "span",
            &[("class", "bar"), ("style", &width), ("aria-hidden", "true")],
            Html::new(),
        );
        vec![
            Html::text(&names[k]),
            data("", Some(mode.rates[k]), ""),
            Html::text(format!("{:.1}% ", 100.0 * mode.shares[k])).then(bar),
        ]
    });
    table(title, &["joint", "rate", "share"], rows)
}

/// Every coordinate at every worst configuration.
pub(super) fn coordinates(page: &Page) -> Html {
    if page.worst.is_empty() {
        return Html::words("p", "The robot has no degrees of freedom.");
    }
    let headings: Vec<String> = page.worst.iter().map(heading).collect();
    let mut columns = vec!["coordinate", "unit"];
    columns.extend(headings.iter().map(String::as_str));
    let rows = page.coordinates.iter().enumerate().map(|(k, (name, unit))| {
        let mut row = vec![Html::text(name), Html::text(unit)];
        row.extend(page.worst.iter().map(|worst| data("", worst.portrait.q.get(k).copied(), "")));
        row
    });
    table("All coordinates of the worst configurations", &columns, rows)
}

/// Everything about one configuration, in one line of a table.
pub(super) fn verdicts(page: &Page) -> Html {
    let rows = page.worst.iter().map(|worst| {
        let verdict = &worst.portrait.verdict;
        let error = |x: Option<f64>| x.map_or_else(String::new, |x| format!(" ± {x:.0e}"));
        let [least, most] = verdict.error_estimate;
        let finite = |x: Option<f64>| x.filter(|x| x.is_finite());
        vec![
            Html::text(heading(worst)),
            Html::text(&worst.portrait.metric),
            data("", finite(verdict.kappa), "∞"),
            data("", finite(verdict.kappa_weighted), "∞"),
            data("", finite(verdict.lambda_min), "0").then(Html::text(error(least))),
            data("", finite(verdict.lambda_max), "∞").then(Html::text(error(most))),
        ]
    });
    let headings = ["at the", "metric", "κ", symbol("kappa_weighted"), "λmin", "λmax"];
    table("Spectra, with estimated relative errors", &headings, rows)
}
