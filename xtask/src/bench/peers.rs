//! `cargo xtask bench-peers`: eigenbody beside other dynamics libraries on published robots.
//!
//! One description of each robot goes to every peer, so that no parser stands between; all take turns. Times are medians, ratios medians
//! of the ratios within a turn.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::figures::Figures;
use super::report::{self, table, time};
use super::write;
use crate::program::{build_directory, cargo, output, program, root, run};
use crate::{Outcome, oracle};

/// Name, base, and file below the robots of example-robot-data.
const ROBOTS: [(&str, &str, &str); 6] = [
    ("ur5", "fixed", "ur_description/urdf/ur5_robot.urdf"),
    ("xarm7", "fixed", "xarm_description/urdf/xarm7.urdf"),
    ("panda", "fixed", "panda_description/urdf/panda.urdf"),
    ("anymal", "floating", "anymal_b_simple_description/robots/anymal.urdf"),
    ("g1", "floating", "g1_description/urdf/g1_29dof_rev_1_0.urdf"),
    ("talos", "floating", "talos_data/robots/talos_reduced.urdf"),
];

/// Builds of Pinocchio: header-only code is as fast as the compiler may make it.
const BUILDS: [(&str, &[&str]); 3] =
    [("native", &["-march=native"]), ("avx2", &["-mavx2", "-mfma"]), ("plain", &[])];
/// Pinocchio's variant of joints is longer than Boost's default lists.
const LISTS: [&str; 4] = [
    "-DBOOST_MPL_LIMIT_LIST_SIZE=30",
    "-DBOOST_MPL_LIMIT_VECTOR_SIZE=30",
    "-DBOOST_FUSION_INVOKE_MAX_ARITY=12",
    "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS",
];
const EIGEN: &str = "/usr/include/eigen3";

/// What is compared: quantity, title, peers by the beginning of their names, the goal for each robot.
struct Contest {
    quantity: &'static str,
    title: &'static str,
    peers: &'static [&'static str],
}

const CONTESTS: [Contest; 8] = [
    Contest { quantity: "rnea", title: "Inverse dynamics", peers: &["pinocchio", "dynibo"] },
    Contest { quantity: "aba", title: "Forward dynamics", peers: &["pinocchio", "dynibo"] },
    Contest { quantity: "upper", title: "Mass matrix, upper triangle", peers: &["pinocchio"] },
    Contest {
        quantity: "crba",
        title: "Mass matrix, both triangles",
        peers: &["pinocchio", "mujoco", "dynibo"],
    },
    Contest { quantity: "bias", title: "Bias force C(q, v)", peers: &["pinocchio", "mujoco"] },
    Contest { quantity: "extremes", title: "Mass matrix, λmin and λmax", peers: &["pinocchio"] },
    Contest { quantity: "conditioning", title: "Mass matrix, κ and κ′", peers: &["pinocchio"] },
    Contest {
        quantity: "eigenvalues",
        title: "λmin and λmax of a given matrix",
        peers: &["nalgebra", "faer", "lapack"],
    },
];

/// Quantities of batches, their titles, and what peers call them.
const BATCHES: [(&str, &str, &str); 5] = [
    ("rnea", "Inverse dynamics", "rnea"),
    ("aba", "Forward dynamics", "aba"),
    ("crba", "Mass matrix, both triangles", "crba"),
    ("entries", "Mass matrix, entries that are not zero between branches", "upper"),
    ("conditioning", "κ and κ′", "conditioning"),
];

/// Measures, prints, writes `peers.json` into the build directory and the section of docs/performance.md.
pub fn bench() -> Outcome {
    if !oracle::python().exists() {
        return Err("the oracle is not installed: run `cargo xtask oracle` first".into());
    }
    let directory = build_directory()?.join("peers");
    let packages = output(
        program(oracle::python()).args(["-c", "import sysconfig; print(sysconfig.get_path('purelib'))"]),
    )?;
    let packages = PathBuf::from(packages.trim());
    run(cargo(&["build", "--release", "--manifest-path", "benches/peers/Cargo.toml", "--target-dir"])
        .arg(&directory))?;
    let programs = compile(&directory, &packages)?;
    let peers = directory.join("release/peers");
    let robots = directory.join("robots");
    let _ = fs::remove_dir_all(&robots);
    run(program(&peers).arg("dump").arg(&robots).args(ROBOTS.map(|(name, base, file)| {
        let share = packages.join("cmeel.prefix/share/example-robot-data/robots");
        format!("{name}={base}:{}", share.join(file).display())
    })))?;
    let mut figures = Figures::default();
    let mut race = program(&peers);
    race.arg("race").arg(&robots).args(programs).stderr(Stdio::inherit());
    figures.read(&output(race.env("OMP_NUM_THREADS", "1").env("OPENBLAS_NUM_THREADS", "1"))?)?;
    let text = text(&figures);
    println!("\n{text}");
    write(&directory.join("peers.json"), &figures.json())?;
    report::update(&root().join("docs/performance.md"), "bench-peers", &text)
}

/// The contestants that are programs of their own, as `peers race` is told.
fn compile(directory: &Path, packages: &Path) -> Result<Vec<String>, String> {
    if !Path::new(EIGEN).exists() {
        return Err(format!(
            "{EIGEN} is not there: install Eigen (Debian, Ubuntu: apt install libeigen3-dev)"
        ));
    }
    let sources = root().join("benches/peers/cpp");
    let mut programs = Vec::new();
    for (name, flags) in BUILDS {
        let built = directory.join(format!("pinocchio-{name}"));
        let mut call = program("g++");
        call.args(["-O3", "-DNDEBUG"]).args(flags).args(LISTS);
        call.arg("-isystem").arg(packages.join("cmeel.prefix/include")).args(["-isystem", EIGEN]);
        gcc(call, &sources, "pinocchio.cpp", &[], &built)?;
        programs.push(format!("pinocchio-{name}={}", built.display()));
    }
    let mujoco = packages.join("mujoco");
    let library = fs::read_dir(&mujoco)
        .map_err(|error| format!("{}: {error}", mujoco.display()))?
        .filter_map(|entry| Some(entry.ok()?.path()))
        .find(|path| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("libmujoco.so")))
        .ok_or("MuJoCo's library is not where its package should have it")?;
    let built = directory.join("mujoco");
    let mut call = program("g++");
    call.args(["-O3", "-DNDEBUG", "-isystem"]).arg(mujoco.join("include"));
    call.arg(format!("-Wl,-rpath,{}", mujoco.display()));
    gcc(call, &sources, "mujoco.cpp", &[library], &built)?;
    programs.push(format!("mujoco={}", built.display()));
    programs.push(format!("lapack={},oracle/lapack_peer.py", oracle::python().display()));
    Ok(programs)
}

/// Runs a compiler unless what it makes is newer than the sources.
fn gcc(mut call: Command, sources: &Path, source: &str, libraries: &[PathBuf], built: &Path) -> Outcome {
    let changed = |path: &Path| fs::metadata(path).and_then(|data| data.modified()).ok();
    let source = sources.join(source);
    let newest = changed(&source).max(changed(&sources.join("robot.hpp")));
    if changed(built) > newest {
        return Ok(());
    }
    run(call.arg("-std=c++17").arg(&source).args(libraries).arg("-o").arg(built))
}

/// The fastest of a peer's builds and conventions at what `head` names; nothing if it took no part.
fn best(figures: &Figures, head: &str, peer: &str) -> Option<String> {
    let names = figures.names(head).filter(|name| name.starts_with(peer) && !name.ends_with("-only"));
    let names = names.map(|name| format!("{head}{name}"));
    names.min_by(|a, b| figures.get(a).total_cmp(&figures.get(b)))
}

fn label(robot: &str, base: &str) -> String {
    if base == "floating" { format!("{robot}, floating") } else { robot.to_owned() }
}

/// A time, and how many times longer it is than another.
fn slower(figures: &Figures, name: Option<String>, other: &str) -> [String; 2] {
    name.map_or_else(nothing, |name| {
        [time(figures.get(&name)), format!("{:.2}×", figures.ratio(&name, other))]
    })
}

/// A time, and how many times shorter it is than another.
fn faster(figures: &Figures, name: &str, other: Option<&str>) -> [String; 2] {
    match other {
        Some(other) if figures.get(name).is_finite() => {
            [time(figures.get(name)), format!("{:.2}×", figures.ratio(other, name))]
        }
        _ => nothing(),
    }
}

fn nothing() -> [String; 2] {
    ["–".to_owned(), "–".to_owned()]
}

fn text(figures: &Figures) -> String {
    let tables = CONTESTS.map(|Contest { quantity, title, peers }| {
        let row = |(robot, base, _): (&str, &str, &str)| {
            let head = format!("{robot} {quantity} ");
            let ours = format!("{head}eigenbody");
            let cells = peers.iter().flat_map(|peer| slower(figures, best(figures, &head, peer), &ours));
            [label(robot, base), time(figures.get(&ours))].into_iter().chain(cells).collect::<Vec<_>>()
        };
        let head: Vec<&str> = ["robot", "eigenbody"]
            .into_iter()
            .chain(peers.iter().flat_map(|peer| [*peer, "ratio"]))
            .collect();
        table(title, &head, &ROBOTS.map(row))
    });
    let batches = BATCHES.map(|(quantity, title, theirs)| {
        let row = |(robot, base, _): (&str, &str, &str)| {
            let name = |contestant: &str| format!("{robot} {quantity} {contestant}");
            let one = name("batch");
            let peer = best(figures, &format!("{robot} {theirs} "), "pinocchio");
            let peer = peer.as_deref();
            [label(robot, base), peer.map_or_else(|| "–".to_owned(), |peer| time(figures.get(peer)))]
                .into_iter()
                .chain(faster(figures, &one, peer))
                .chain(faster(figures, &name("batch-avx2"), peer))
                .chain(faster(figures, &name("batch-f32"), Some(&one)))
                .collect::<Vec<_>>()
        };
        let head = ["robot", "pinocchio", "one core", "ratio", "AVX2", "ratio", "f32", "to f64"];
        table(&format!("Batches: {title}"), &head, &ROBOTS.map(row))
    });
    let cores = ROBOTS.map(|(robot, base, _)| {
        let cells = BATCHES.map(|(quantity, ..)| {
            let ratio = |two: &str| {
                let name = |contestant: &str| format!("{robot} {quantity} {contestant}");
                format!("{:.2}×", figures.ratio(&name("batch-many"), &name(two)))
            };
            [ratio("batch-many-2"), ratio("batch-many-apart")]
        });
        [label(robot, base)].into_iter().chain(cells.into_iter().flatten()).collect::<Vec<_>>()
    });
    let head: Vec<&str> = ["robot"]
        .into_iter()
        .chain(["τ", "v̇", "H", "entries of H", "κ and κ′"].into_iter().flat_map(|what| [what, "apart"]))
        .collect();
    let cores = table("Batches: two threads to one, and two calls apart, a thread each", &head, &cores);
    let zeros = ROBOTS.map(|(robot, base, _)| {
        let cells = ["crba", "entries"].map(|quantity| {
            let name = |contestant: &str| format!("{robot} {quantity} {contestant}");
            let [all, zeros] = ["batch", "batch-zeros"].map(name);
            let part = format!("{:.0}%", 100.0 * figures.ratio(&zeros, &all));
            [time(figures.get(&all)), time(figures.get(&zeros)), part]
        });
        [label(robot, base)].into_iter().chain(cells.into_iter().flatten()).collect::<Vec<_>>()
    });
    let head = ["robot", "H", "zeros", "part", "entries of H", "zeros", "part"];
    let zeros = table("Batches: H on one core, and nothing but zeros into the same memory", &head, &zeros);
    let fastest = |quantity: &str| {
        let heads = ROBOTS.map(|(robot, ..)| format!("{robot} {quantity} "));
        let names = heads
            .iter()
            .filter_map(|head| Some(best(figures, head, "pinocchio")?.strip_prefix(head)?.to_owned()))
            .map(|name| format!("`{}`", name.trim_start_matches("pinocchio-")));
        let mut names: Vec<String> = names.collect();
        names.sort();
        names.dedup();
        names.join(", ")
    };
    let wins =
        ["rnea", "aba", "upper"].map(|quantity| format!("{quantity} {}", fastest(quantity))).join("; ");
    let tables = tables.into_iter().chain(batches).chain([zeros, cores]).collect::<Vec<_>>();
    format!("{}\nPinocchio's best builds and conventions: {wins}.\n", tables.join("\n"))
}
