use eigenbody_report::figure::{self, Anchor, Axis, Curve, Panel, Plot, Scene, Style};
use eigenbody_study::{EXPERIMENTS, Lab, select};

fn svg(id: &str) -> Option<String> {
    let experiment = select(&[id]).unwrap()[0];
    let outcome = experiment.run(&Lab { quick: true, ..Lab::default() }).unwrap();
    figure::draw(id, experiment.title, &outcome.table)
}

/// Every experiment called a figure has one, and it is well-formed: a box of 800 px, no coordinate that is not a number.
#[test]
fn every_figure_is_drawn() {
    for experiment in EXPERIMENTS.iter().flat_map(|paper| paper.iter()) {
        let svg = svg(experiment.id);
        assert!(svg.is_some() || !experiment.id.contains("-fig"), "{} has no figure", experiment.id);
        let Some(svg) = svg else { continue };
        assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"), "{}", experiment.id);
        assert!(svg.contains("viewBox=\"0 0 800 "), "{}", experiment.id);
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{}", experiment.id);
    }
}

/// Words of one figure's SVG: where they are, how high, what they say.
fn words(svg: &str) -> Vec<(f64, f64, f64, String)> {
    let number = |line: &str, name: &str| -> f64 {
        line.split(&format!(" {name}=\"")).nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
    };
    let upright = svg.lines().filter(|line| line.starts_with("<text") && !line.contains("rotate"));
    upright
        .map(|line| {
            let text = line.split('>').nth(1).unwrap().split('<').next().unwrap().to_owned();
            let wide = 0.6 * number(line, "font-size") * text.chars().count() as f64;
            let from = match line.split("text-anchor=\"").nth(1).unwrap().split('"').next().unwrap() {
                "start" => 0.0,
                "middle" => 0.5,
                _ => 1.0,
            };
            let x = number(line, "x") - from * wide;
            (x, x + wide, number(line, "y"), text)
        })
        .collect()
}

/// No word lies on another, and none leaves the paper.
#[test]
fn words_do_not_overlap() {
    for experiment in EXPERIMENTS.iter().flat_map(|paper| paper.iter()) {
        let Some(svg) = svg(experiment.id) else { continue };
        let words = words(&svg);
        for (i, a) in words.iter().enumerate() {
            assert!(a.0 >= 0.0 && a.1 <= 800.0, "{}: '{}' leaves the paper", experiment.id, a.3);
            for b in &words[i + 1..] {
                let apart = a.1 <= b.0 || b.1 <= a.0 || (a.2 - b.2).abs() >= 11.0;
                assert!(apart, "{}: '{}' lies on '{}'", experiment.id, a.3, b.3);
            }
        }
    }
}

/// In grey two curves differ still: in dashes, in marker or in filling.
#[test]
fn curves_differ_without_colour() {
    let looks = |style: Style| (style.dashes, format!("{:?}", style.marker), style.filled);
    for i in 0..7 {
        for j in 0..i {
            assert_ne!(looks(Style::nth(i)), looks(Style::nth(j)));
            assert_ne!(Style::nth(i).colour, Style::nth(j).colour);
        }
        assert_ne!(Style::of_kind(i, 0).dashes, Style::of_kind(i, 1).dashes);
        assert_ne!(Style::of_kind(i, 0).filled, Style::of_kind(i, 1).filled);
    }
}

#[test]
fn words_are_escaped() {
    let mut scene = Scene::new(10.0, 10.0);
    scene.text((0.0, 0.0), Anchor::Start, 12.0, "a < b & c");
    assert!(scene.finish("x > y").contains("a &lt; b &amp; c"));
}

/// An empty panel is an empty frame, not a panic; what a log axis cannot show is left out.
#[test]
fn odd_plots_are_drawn() {
    let panel = |points: Vec<(f64, f64)>| Panel {
        title: String::new(),
        x: Axis::log("x"),
        y: Axis::linear("y"),
        curves: vec![Curve { name: "c".into(), points, style: Style::nth(0) }],
    };
    for points in [
        vec![],
        vec![(0.0, 1.0), (-1.0, 2.0)],
        vec![(1.0, f64::NAN)],
        vec![(1.0, 1.0)],
        vec![(1e-300, -1e300), (1e300, 1e300)],
    ] {
        let svg = Plot { panels: vec![panel(points)], columns: 1 }.svg("odd");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }
    assert!(Plot { panels: Vec::new(), columns: 0 }.svg("none").contains("<svg"));
}

#[cfg(feature = "png")]
#[test]
fn a_png_has_ink_and_the_size_it_should() {
    let svg = svg("F-fig14").unwrap();
    let bytes = figure::png(&svg, 2.0).unwrap();
    assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
    let side = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
    assert_eq!((side(16), side(20)), (1600, 1040));
    // With words and curves it packs to more than a white page does.
    let blank = figure::png(&Scene::new(800.0, 520.0).finish(""), 2.0).unwrap();
    assert!(bytes.len() > 4 * blank.len(), "{} against {}", bytes.len(), blank.len());
    assert!(figure::png("no svg", 1.0).is_err());
    assert!(figure::png(&Scene::new(10.0, 10.0).finish(""), 0.0).is_err());
}

/// Every character in figures is in the font that pictures are made with.
#[test]
fn the_font_has_every_character() {
    // The character map of a TrueType font, format 4 or 12, is not read here: what was asked for when the font was reduced is.
    let known = |c: char| {
        matches!(c as u32,
            0x20..=0x7e | 0xa0..=0xff | 0x370..=0x3ff | 0x2010..=0x2026 | 0x2032..=0x2033 | 0x2070..=0x209c
            | 0x2190..=0x2193 | 0x2212 | 0x221a | 0x221e | 0x2248 | 0x2260 | 0x2264..=0x2265 | 0x22c5 | 0x1d40
            | 0x1d43..=0x1d61 | 0x2202 | 0x2211)
    };
    for experiment in EXPERIMENTS.iter().flat_map(|paper| paper.iter()) {
        let text: String = svg(experiment.id).iter().flat_map(|svg| words(svg)).map(|word| word.3).collect();
        assert_eq!(text.chars().filter(|&c| !known(c)).collect::<String>(), "", "{}", experiment.id);
    }
}
