//! Numbers as tables: shown to six digits, exact in `<data value>`.

use super::html::{Html, table};
use super::{Page, heading, symbol};
use crate::diagnosis::{AdviceReport, SensitivityReport, SteppingReport};
use crate::number::significant;
use eigenbody_study::portrait::ModePlace;

/// Parameters that are seen at once.
const STRONGEST: usize = 8;

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
    if !report.sensitivities.is_empty() {
        let headings = ["parameter", "is", "a change of", "changes log κ by"];
        let row = |one: &SensitivityReport| {
            vec![
                Html::text(format!("{} of {}", one.parameter, one.of)),
                data("", Some(one.value), ""),
                data("", Some(one.against), ""),
                data("", Some(one.rate), ""),
            ]
        };
        let (most, less) = report.sensitivities.split_at(report.sensitivities.len().min(STRONGEST));
        whole.push(table("What moves κ most where it is worst", &headings, most.iter().map(row)));
        if !less.is_empty() {
            let summary = Html::words("summary", format!("{} parameters that move it less", less.len()));
            let rest = table("What moves κ less where it is worst", &headings, less.iter().map(row));
            whole.push(Html::element("details", &[], summary.then(rest)));
        }
    }
    for (k, motion) in report.null_motions.iter().enumerate() {
        let rows = motion.iter().map(|rate| vec![Html::text(&rate.joint), data("", Some(rate.rate), "")]);
        whole.push(table(&format!("Motion {} that moves no mass", k + 1), &["joint", "rate"], rows));
    }
    whole
}

/// The largest stable step of each integrator, and the gains that joints bear at the step that is wanted.
pub(super) fn stepping(found: Option<&SteppingReport>) -> Html {
    let Some(found) = found else {
        return Html::words("p", "Nothing holds or drives a joint: no step is asked of it.");
    };
    if !found.passive {
        return Html::words("p", "A stiffness or damping is below zero: no step is stable.");
    }
    let asked = match found.step {
        Some(step) => Html::text("Asked for: ")
            .then(data("", Some(step), ""))
            .then(Html::text(format!(" s, {}.", found.integrator))),
        None => Html::text(format!("No step is asked for; {}.", found.integrator)),
    };
    let mut whole = Html::element("p", &[], asked);
    let rows = found.limits.iter().map(|limit| {
        let pulls: Vec<String> = limit
            .joints
            .iter()
            .take(3)
            .map(|part| format!("{} {:.0}%", part.joint, 100.0 * part.share))
            .collect();
        vec![
            Html::text(limit.integrator),
            data("", limit.largest, "without limit"),
            data("", Some(limit.stiffness), ""),
            data("", Some(limit.damping), ""),
            Html::text(pulls.join(", ")),
        ]
    });
    let headings =
        ["integrator", "largest step (s)", "of (K, H) (1/s²)", "of (D, H) (1/s)", "in the motion that grows"];
    whole.push(table("The largest stable step over the joint limits", &headings, rows));
    if found
        .joints
        .iter()
        .any(|joint| joint.largest_kp.is_some() || joint.stiffness != 0.0 || joint.damping != 0.0)
    {
        let rows = found.joints.iter().map(|joint| {
            vec![
                Html::text(&joint.joint),
                data("", Some(joint.stiffness), ""),
                data("", Some(joint.damping), ""),
                data("", Some(joint.inertia), ""),
                data("", joint.largest_kp, "–"),
                data("", joint.largest_kd, "–"),
            ]
        });
        let headings = ["joint", "kp it has", "kd it has", "least inertia", "largest kp", "largest kd"];
        let gains = table("Gains of each joint, and what it bears alone at that step", &headings, rows);
        let summary = Html::words("summary", "Gains, joint by joint");
        whole.push(Html::element("details", &[], summary.then(gains)));
    }
    whole
}

/// What to change: armature, one link, a limit.
pub(super) fn advice(advice: &AdviceReport) -> Html {
    let wanted = significant(advice.wanted, 4);
    let goal = match advice.measure {
        "kappa" => format!("κ of at most {wanted}"),
        "lambda_min" => format!("λmin of at least {wanted} kg m²"),
        _ => format!("a stable step of {wanted} s"),
    };
    let mut whole = Html::words("h3", format!("What gives {goal} in every configuration"));
    let rows = advice.added.iter().filter(|added| added.added > 0.0).map(|added| {
        vec![
            Html::text(&added.joint),
            data("", Some(added.authored), ""),
            data("", Some(added.added), ""),
            data("", Some(100.0 * added.inflation), ""),
        ]
    });
    let rows: Vec<Vec<Html>> = rows.collect();
    if rows.is_empty() {
        whole.push(Html::words(
            "p",
            if advice.reached.is_some() { "No armature is needed." } else { "No armature does." },
        ));
    } else {
        let headings = ["joint", "has (kg m², kg)", "add", "% of its own inertia"];
        whole.push(table("The least armature", &headings, rows));
    }
    if !advice.links.is_empty() {
        let rows = advice.links.iter().map(|link| {
            let [xx, yy, zz, ..] = link.added_inertia;
            let diagonal = [xx, yy, zz].map(|x| significant(x, 3).replace('-', "−")).join(", ");
            vec![
                Html::text(&link.link),
                data("", Some(link.mass), ""),
                data("", Some(link.added_mass), ""),
                Html::text(diagonal),
                data("", Some(link.reached), ""),
            ]
        });
        let headings = ["link", "mass (kg)", "add (kg)", "add xx, yy, zz (kg m²)", "reaches"];
        whole.push(table("Or more inertia for one link", &headings, rows));
    }
    if !advice.limits.is_empty() {
        let rows = advice.limits.iter().map(|limit| {
            let range =
                |[low, high]: [f64; 2]| Html::text(format!("{low:.4} to {high:.4}").replace('-', "−"));
            vec![
                Html::text(&limit.joint),
                range(limit.range),
                range(limit.kept),
                data("", Some(100.0 * limit.lost), ""),
                data("", Some(limit.reached), ""),
            ]
        });
        let headings = ["joint", "range (rad, m)", "keep", "% lost", "reaches"];
        whole.push(table("Or a limit on one joint", &headings, rows));
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
        let share = Html::text(format!("{:.1}%", 100.0 * mode.shares[k]));
        let share = Html::element("span", &[("class", "share")], share);
        vec![Html::text(&names[k]), data("", Some(mode.rates[k]), ""), share.then(bar)]
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
