//! Poses, spectra and matrices.

use super::html::Html;
use super::numbers::{self, data};
use super::{Page, WorstPicture, heading};
use crate::figure::heat::Heat;
use crate::figure::{Axis, Curve, Panel, Plot, Scene, Style, pose};
use crate::number::significant;
use eigenbody::Matrix;
use eigenbody_study::portrait::{ModePlace, Portrait};

/// Powers of ten that a map of magnitudes spans at most.
const DECADES: f64 = 12.0;
/// Most eigenvalues that are listed.
const LISTED: usize = 400;

fn figure(scene: &Scene, title: &str, about: &str, caption: &str) -> Html {
    let drawing = Html::drawing(scene, title, about);
    // On a narrow screen drawings scroll by themselves, also by keyboard.
    Html::element("figure", &[("tabindex", "0")], drawing.then(Html::words("figcaption", caption)))
        .then(Html::fixed("\n"))
}

fn names(portrait: &Portrait) -> Vec<String> {
    portrait.dofs.iter().map(|dof| dof.name.clone()).collect()
}

/// The robot in each worst configuration, with its softest and its stiffest mode.
pub(super) fn worst(page: &Page) -> Html {
    let mut whole = Html::words(
        "p",
        "Lines are links, open circles joints, grey discs centres of mass (larger is heavier). Dashed blue: where the mode takes them. \
         Arrows with two heads: the axis that a joint turns about, by the right-hand rule; with one head: the way it slides; a \
         point or a cross in a circle: towards the reader or away.",
    );
    for worst in &page.worst {
        let portrait = &worst.portrait;
        whole.push(Html::words("h3", sentence(&heading(worst))));
        if let Some(found) = page.report.worst.iter().find(|found| worst.measures.contains(&found.measure)) {
            let carriers: Vec<String> = found
                .carriers
                .iter()
                .take(5)
                .filter(|part| part.share >= 0.005)
                .map(|part| format!("{} {:.0}%", part.name, 100.0 * part.share))
                .collect();
            if !carriers.is_empty() {
                whole.push(Html::words(
                    "p",
                    format!("The softest motion's inertia: {}.", carriers.join(", ")),
                ));
            }
        }
        for (what, mode) in [("softest", &portrait.softest), ("stiffest", &portrait.stiffest)] {
            if let Some(mode) = mode {
                whole.push(picture(worst, what, mode));
            }
        }
    }
    whole
}

fn picture(worst: &WorstPicture, what: &str, mode: &ModePlace) -> Html {
    let portrait = &worst.portrait;
    let lambda = mode.eigenvalue.map_or_else(String::new, |x| format!(", λ = {}", significant(x, 4)));
    let title = format!("{} mode at the {}{lambda}", sentence(what), heading(worst));
    let mut order: Vec<usize> = (0..mode.shares.len()).collect();
    order.sort_by(|&a, &b| mode.shares[b].total_cmp(&mode.shares[a]));
    let parts: Vec<String> = order
        .iter()
        .take(3)
        .map(|&k| format!("{} {:.0}%", portrait.dofs[k].name, 100.0 * mode.shares[k]))
        .collect();
    let about = format!("Two drawings of the robot. {title}: {}.", parts.join(", "));
    figure(&pose::scene(portrait, Some(mode)), &title, &about, &format!("{title}.")).then(numbers::mode(
        &format!("{} mode, joint by joint", sentence(what)),
        mode,
        &names(portrait),
    ))
}

/// The first letter large.
fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().to_string() + letters.as_str())
}

/// All eigenvalues, in each worst configuration.
pub(super) fn spectrum(page: &Page) -> Html {
    let curves: Vec<Curve> = page
        .worst
        .iter()
        .enumerate()
        .filter_map(|(k, worst)| {
            let values = worst.portrait.verdict.eigenvalues.as_ref()?;
            let points = values.iter().enumerate().map(|(i, &x)| ((i + 1) as f64, x)).collect();
            let name = format!("{}, {} metric", heading(worst), worst.portrait.metric);
            Some(Curve { name, points, style: Style::nth(k) })
        })
        .collect();
    let mut whole = Html::new();
    if !curves.is_empty() {
        let panel = Panel {
            title: String::new(),
            x: Axis::linear("eigenvalue, ascending"),
            y: Axis::log(format!("λ, {}", if page.unit.is_empty() { "1" } else { page.unit })),
            curves,
        };
        let plot = Plot { panels: vec![panel], columns: 1 };
        let about = "A plot of all eigenvalues in ascending order, on a logarithmic axis; the numbers are in the table below.";
        whole.push(figure(
            &plot.scene(),
            "Spectrum",
            about,
            "All eigenvalues of H x = λ B x. In the unit-diagonal metric they have no unit.",
        ));
    }
    whole.push(numbers::verdicts(page));
    for worst in &page.worst {
        let Some(values) = worst.portrait.verdict.eigenvalues.as_ref().filter(|v| v.len() <= LISTED) else {
            continue;
        };
        let mut list = Html::new();
        for (k, &x) in values.iter().enumerate() {
            if k > 0 {
                list.push(Html::text(", "));
            }
            list.push(data("", Some(x), ""));
        }
        let summary = Html::words("summary", format!("Eigenvalues at the {}", heading(worst)));
        whole.push(Html::element("details", &[], summary.then(Html::element("p", &[], list))));
    }
    whole
}

/// H in each worst configuration: magnitudes, and couplings.
pub(super) fn matrices(page: &Page) -> Html {
    let mut whole = Html::new();
    for worst in &page.worst {
        let Some(H) = &worst.portrait.H else { continue };
        let names = names(&worst.portrait);
        let at = heading(worst);
        let title = format!("Magnitudes of H at the {at}");
        let about =
            format!("{title}: a square of {} rows, coloured by the logarithm of each entry.", names.len());
        let (map, spanned) = magnitudes(H, names.clone());
        let caption = format!(
            "|H| at the {at}, logarithmic{}. Rows and columns in the order of the degrees of freedom.",
            if spanned { "; what is smaller has the darkest colour" } else { "" }
        );
        whole.push(figure(&map.scene(), &title, &about, &caption));
        let title = format!("Couplings of H at the {at}");
        let about =
            format!("{title}: a square of {} rows, coloured by the size of each coupling.", names.len());
        let caption = format!(
            "|H_ij| / √(H_ii H_jj) at the {at}: 1 where two joints move the same mass the same way, so that they can cancel."
        );
        whole.push(figure(&couplings(H, names).scene(), &title, &about, &caption));
    }
    if whole == Html::new() {
        let text = if page.worst.is_empty() { "There is none." } else { "Too large to draw." };
        whole.push(Html::words("p", text));
    }
    whole
}

/// Logarithms of magnitudes over the range that they span; true if it was cut off.
fn magnitudes(H: &Matrix<f64>, names: Vec<String>) -> (Heat, bool) {
    let seen = || H.as_slice().iter().map(|x| x.abs()).filter(|&x| x > 0.0);
    let most = seen().fold(f64::MIN_POSITIVE, f64::max).log10();
    let least = seen().fold(f64::INFINITY, f64::min).log10().min(most);
    let low = least.max(most - DECADES);
    let place = |x: f64| if most > low { ((x.log10() - low) / (most - low)).clamp(0.0, 1.0) } else { 1.0 };
    let cells = H.as_slice().iter().map(|x| (*x != 0.0).then(|| place(x.abs()))).collect();
    let ends = [low, most].map(|x| significant(10f64.powf(x), 2).replace('-', "−"));
    (Heat { names, cells, ends }, low > least)
}

fn couplings(H: &Matrix<f64>, names: Vec<String>) -> Heat {
    let n = names.len();
    let coupling = |i: usize, j: usize| {
        let own = (H[(i, i)] * H[(j, j)]).sqrt();
        (H[(i, j)] != 0.0 && own > 0.0).then(|| H[(i, j)].abs() / own)
    };
    let cells = (0..n * n).map(|k| coupling(k / n, k % n)).collect();
    Heat { names, cells, ends: ["0".into(), "1".into()] }
}
