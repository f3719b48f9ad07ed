//! `eigenbody report` and `check --format html`.

use crate::run::{Scratch, failure, run, stdout};
use roxmltree::{Document, Node, ParsingOptions};
use serde_json::Value;
use std::collections::HashMap;

/// The page as a tree; it is XML too, so that nothing is left open.
fn parsed(page: &str) -> Document<'_> {
    Document::parse_with_options(page, ParsingOptions { allow_dtd: true, ..ParsingOptions::default() })
        .unwrap()
}

fn named<'a>(page: &'a Document<'a>, tag: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
    page.descendants().filter(move |node| node.has_tag_name(tag))
}

/// Exact numbers by their ids.
fn numbers(page: &Document<'_>) -> HashMap<String, f64> {
    let data = named(page, "data").filter(|node| node.attribute("id").is_some());
    data.map(|node| {
        (node.attribute("id").unwrap().to_owned(), node.attribute("value").unwrap().parse().unwrap())
    })
    .collect()
}

/// The page has every number of the JSON, to the last bit.
pub fn assert_same_numbers(page: &str, report: &Value) {
    let page = parsed(page);
    let found = numbers(&page);
    let mut expected: Vec<(String, &Value)> = Vec::new();
    for worst in report["worst"].as_array().unwrap() {
        for what in ["worst", "median", "tenth"] {
            expected.push((format!("{}-{what}", worst["measure"].as_str().unwrap()), &worst[what]));
        }
    }
    if let Some(digits) = report["digits"].as_object() {
        expected.push(("predicted-loss".into(), &digits["predicted_loss"]));
        expected.push(("left-f32".into(), &digits["left_in_f32"]));
        expected.push(("left-f64".into(), &digits["left_in_f64"]));
        for lost in digits["lost"].as_array().unwrap() {
            for precision in ["f32", "f64"] {
                let method = lost["method"].as_str().unwrap().replace(' ', "-");
                expected.push((format!("lost-{method}-{precision}"), &lost[precision]));
            }
        }
    }
    for (id, value) in &expected {
        assert_eq!(found.get(id).copied(), value.as_f64(), "{id}");
    }
    let there = expected.iter().filter(|(_, value)| !value.is_null()).count();
    assert_eq!(found.len(), there, "numbers with ids");
    let text: String = named(&page, "p").filter_map(|p| p.text()).collect();
    for finding in report["findings"].as_array().unwrap() {
        for part in ["message", "advice"] {
            let shown = text.contains(finding[part].as_str().unwrap())
                || named(&page, "p").any(|p| {
                    p.descendants()
                        .filter_map(|n| n.text())
                        .collect::<String>()
                        .contains(finding[part].as_str().unwrap())
                });
            assert!(shown, "{finding}");
        }
    }
    // Every worst configuration, coordinate by coordinate.
    let all: Vec<f64> =
        named(&page, "data").map(|node| node.attribute("value").unwrap().parse().unwrap()).collect();
    for q in report["worst"].as_array().unwrap().iter().flat_map(|worst| worst["q"].as_array().unwrap()) {
        assert!(all.contains(&q.as_f64().unwrap()), "{q}");
    }
}

#[test]
fn the_page_has_the_numbers_of_the_json() {
    for robot in ["puma560", "hydra(6,1,0,1)", "auto_tree(9,1.5,0.3,0.9)"] {
        let call = |format: &'static str| {
            ["check", robot, "--samples", "64", "--format", format, "--fail-on", "never"]
        };
        let report: Value = serde_json::from_str(&stdout(&call("json"))).unwrap();
        assert_same_numbers(&stdout(&call("html")), &report);
    }
}

/// The second command writes what the first prints, and says where.
#[test]
fn a_report_is_the_page_in_a_file() {
    let scratch = Scratch::new();
    let path = scratch.path("arm.html");
    let path = path.to_str().unwrap();
    let said = stdout(&["report", "puma560", "--samples", "64", "-o", path]);
    let page = stdout(&["check", "puma560", "--samples", "64", "--format", "html"]);
    assert_eq!(std::fs::read_to_string(path).unwrap(), page);
    assert_eq!(said, format!("{path}: {} kB\n", page.len().div_ceil(1000)));
    assert_eq!(failure(&["report", "no/such.urdf", "-o", path]), "error: no/such.urdf: no such file");
}

/// Elements that ask for nothing.
const TAGS: &str = "html head meta title style body a header h1 h2 h3 nav ul li main section div p strong data table caption \
    thead tbody tr th td code pre details summary span figure figcaption svg polyline polygon circle rect text footer";

/// No script, no request, nothing but what is in the file; every table and drawing has its words.
#[test]
fn the_page_stands_alone_and_can_be_read() {
    let page = stdout(&["check", "hydra(8,1,0.3,1)", "--samples", "64", "--format", "html"]);
    let style = page.split("<style>").nth(1).unwrap().split("</style>").next().unwrap();
    assert!(!style.contains("url(") && !style.contains("@import"));
    assert!(page.contains("default-src 'none'; style-src 'unsafe-inline'"));
    let page = parsed(&page);
    let targets: Vec<&str> = named(&page, "a").map(|a| a.attribute("href").unwrap()).collect();
    assert!(targets.len() > 5);
    for target in targets {
        let id = target.strip_prefix('#').unwrap();
        assert!(page.descendants().any(|node| node.attribute("id") == Some(id)), "{target}");
    }
    for node in page.descendants().filter(Node::is_element) {
        assert!(TAGS.split_whitespace().any(|tag| node.has_tag_name(tag)), "{node:?}");
        for attribute in node.attributes() {
            let (name, value) = (attribute.name(), attribute.value());
            assert!(!name.starts_with("on") && name != "src" && !value.contains("url("), "{name}={value}");
            assert!(name != "href" || value.starts_with('#'), "{name}={value}");
        }
        match node.tag_name().name() {
            "figure" => {
                let drawing = node.first_element_child().unwrap();
                assert_eq!((drawing.tag_name().name(), drawing.attribute("role")), ("svg", Some("img")));
                assert!(drawing.attribute("aria-label").is_some_and(|label| label.len() > 20));
                assert!(node.children().any(|child| child.has_tag_name("figcaption")));
            }
            "table" => {
                assert!(node.children().any(|child| child.has_tag_name("caption")));
                assert!(named_within(node, "th").all(|th| th.attribute("scope").is_some()));
            }
            "html" => assert_eq!(node.attribute("lang"), Some("en")),
            _ => {}
        }
    }
    assert_eq!(named(&page, "h1").count(), 1);
    let ids: Vec<&str> = page.descendants().filter_map(|node| node.attribute("id")).collect();
    let once: std::collections::HashSet<&str> = ids.iter().copied().collect();
    assert_eq!(ids.len(), once.len());
}

fn named_within<'a>(node: Node<'a, 'a>, tag: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.descendants().filter(move |node| node.has_tag_name(tag))
}

/// A robot whose names are HTML: they are words on the page, in drawings, labels and attributes.
#[test]
fn names_are_words() {
    let evil =
        "&lt;/title&gt;&lt;script&gt;alert(1)&lt;/script&gt;&quot; onload=&quot;x&quot; &apos;&amp;amp;";
    let text = format!(
        r#"<robot name="{evil}"><link name="base"/>
<link name="a{evil}"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1e-12"/></inertial></link>
<link name="b{evil}"><inertial><mass value="1e-9"/><inertia ixx="1e-12" ixy="0" ixz="0" iyy="1e-12" iyz="0" izz="1e-12"/></inertial></link>
<joint name="j{evil}" type="continuous"><parent link="base"/><child link="a{evil}"/><axis xyz="1 0 0"/></joint>
<joint name="k{evil}" type="continuous"><parent link="a{evil}"/><child link="b{evil}"/><axis xyz="0 0 1"/></joint></robot>"#
    );
    let scratch = Scratch::new();
    let path = scratch.file("evil.urdf", &text);
    let output = run(&["check", &path, "--samples", "64", "--format", "html"]);
    assert_eq!(output.status.code(), Some(1), "{}", String::from_utf8_lossy(&output.stderr));
    let page = String::from_utf8(output.stdout).unwrap();
    assert!(!page.contains("<script") && !page.contains("</title><"), "a name became a tag");
    let page = parsed(&page);
    let name = "j</title><script>alert(1)</script>\" onload=\"x\" '&amp;";
    assert!(named(&page, "th").any(|th| th.text() == Some(name)));
    assert!(
        named(&page, "svg")
            .any(|svg| svg.attribute("aria-label").is_some_and(|label| label.contains("<script>")))
    );
    assert!(page.descendants().all(|node| node.attribute("onload").is_none()));
}
