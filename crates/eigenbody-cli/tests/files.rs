//! Outputs as files: none takes the place of an input, of another output, or of what is no file; what was interrupted leaves nothing.

use crate::run::{Scratch, failure, run, stdout};
use std::path::Path;
use std::process::{Command, Stdio};

/// Two links on revolute joints.
const ARM: &str = "<robot name='arm'><link name='base'/>
<link name='upper'><inertial><origin xyz='.5 0 0'/><mass value='2'/><inertia ixx='.1' iyy='.2' izz='.2' ixy='0' ixz='0' iyz='0'/></inertial></link>
<link name='lower'><inertial><origin xyz='.5 0 0'/><mass value='1'/><inertia ixx='.1' iyy='.1' izz='.1' ixy='0' ixz='0' iyz='0'/></inertial></link>
<joint name='shoulder' type='continuous'><parent link='base'/><child link='upper'/><axis xyz='0 0 1'/></joint>
<joint name='elbow' type='continuous'><parent link='upper'/><child link='lower'/><origin xyz='1 0 0'/><axis xyz='0 0 1'/></joint></robot>";
const LOG: &str = "t,q0,q1\n0,0,0\n1,0.1,0.1\n";

#[test]
fn no_output_takes_the_place_of_an_input() {
    let scratch = Scratch::new();
    let arm = scratch.file("arm.urdf", ARM);
    let log = scratch.file("log.csv", LOG);
    // The same file by another path.
    let other = scratch.path("./arm.urdf");
    let other = other.to_str().unwrap();
    let baseline = scratch.file("old.json", "{}");
    let calls: &[&[&str]] = &[
        &["spectrum", &arm, "-o", &arm],
        &["spectrum", &arm, "-o", other],
        &["matrix", &arm, "-o", &arm],
        &["check", &arm, "-o", &arm],
        &["check", &arm, "--baseline", &baseline, "-o", &baseline],
        &["check", &arm, "--want-kappa", "9", "--write-patch", &arm],
        &["report", &arm, "-o", &arm],
        &["convert", &arm, "-o", &arm],
        &["track", &arm, &log, "-o", &log],
        &["simulate", &arm, "--time", "0.1", "--follow", &log, "-o", &log],
        &["simulate", &arm, "--time", "0.1", "--torque", &log, "-o", &log],
    ];
    for call in calls {
        assert!(failure(call).ends_with(": is what this command reads: choose another output"), "{call:?}");
    }
    let settings = scratch.file("eigenbody.toml", "[check]\nsamples = 64\n");
    assert!(failure(&["check", &arm, "-o", &settings]).contains("is what this command reads"));
    for (path, text) in [(&arm, ARM), (&log, LOG), (&baseline, "{}")] {
        assert_eq!(std::fs::read_to_string(path).unwrap(), text);
    }
}

/// What a model includes and the meshes that it names are inputs as its own file is.
#[test]
fn no_output_takes_the_place_of_a_part_of_the_model() {
    let scratch = Scratch::new();
    let body = "<body><joint/><geom size='.1' pos='1 0 0'/></body>";
    let part = scratch.file("part.xml", &format!("<mujocoinclude>{body}</mujocoinclude>"));
    let hull = scratch.file("hull.stl", "solid");
    let hills = scratch.file("hills.png", "png");
    let mjcf = scratch.file(
        "main.xml",
        "<mujoco><asset><mesh file='hull.stl'/><hfield name='h' file='hills.png' size='1 1 1 1'/></asset>
         <worldbody><include file='part.xml'/></worldbody></mujoco>",
    );
    let seen = scratch.file("seen.obj", "v");
    let felt = scratch.file("felt.obj", "v");
    let shape =
        |tag: &str, file: &str| format!("<{tag}><geometry><mesh filename='{file}'/></geometry></{tag}>");
    let shapes = shape("visual", "seen.obj") + &shape("collision", "felt.obj");
    let urdf =
        scratch.file("arm.urdf", &ARM.replace("</inertial></link>", &format!("</inertial>{shapes}</link>")));
    let link = "<link name='l'/><joint name='j' type='continuous'><parent>world</parent><child>l</child><axis><xyz>0 0 1</xyz></axis></joint>";
    let arm = scratch.file("arm.sdf", &format!("<sdf version='1.9'><model name='arm'>{link}</model></sdf>"));
    let world = scratch.file(
        "world.sdf",
        "<sdf version='1.9'><world name='w'><include><uri>arm.sdf</uri></include></world></sdf>",
    );
    let log = scratch.file("log.csv", "t,q0\n0,0\n1,0.1\n");
    let calls: &[&[&str]] = &[
        &["spectrum", &mjcf, "-o", &part],
        &["matrix", &mjcf, "-o", &hull],
        &["check", &mjcf, "-o", &hills],
        &["check", &mjcf, "--want-kappa", "9", "--write-patch", &part],
        &["report", &urdf, "-o", &seen],
        &["convert", &world, "-o", &arm],
        &["track", &mjcf, &log, "-o", &part],
        &["simulate", &urdf, "--time", "0.1", "-o", &felt],
        &["simulate", &world, "--time", "0.1", "--plot", &arm],
    ];
    for call in calls {
        assert!(failure(call).ends_with(": is what this command reads: choose another output"), "{call:?}");
    }
    for (path, text) in [(&hull, "solid"), (&hills, "png"), (&seen, "v"), (&felt, "v")] {
        assert_eq!(std::fs::read_to_string(path).unwrap(), text);
    }
}

#[test]
fn two_outputs_are_two_files() {
    let scratch = Scratch::new();
    let arm = scratch.file("arm.urdf", ARM);
    let both = scratch.path("both.urdf");
    let both = both.to_str().unwrap();
    let message = failure(&["check", &arm, "--want-kappa", "9", "--write-patch", both, "-o", both]);
    assert!(message.ends_with("both.urdf: two outputs are this one file"), "{message}");
    let plot = scratch.path("both.svg");
    let plot = plot.to_str().unwrap();
    assert!(
        failure(&["simulate", &arm, "--plot", plot, "-o", plot]).ends_with("two outputs are this one file")
    );
}

/// An output that cannot be made is refused before any other is begun.
#[test]
fn a_figure_without_a_folder_leaves_no_rows() {
    let scratch = Scratch::new();
    let arm = scratch.file("arm.urdf", ARM);
    let rows = scratch.path("rows.csv");
    let rows = rows.to_str().unwrap();
    let plot = scratch.path("none/x.svg");
    let message = failure(&["simulate", &arm, "--time", "0.1", "-o", rows, "--plot", plot.to_str().unwrap()]);
    assert!(message.contains("x.svg: no folder"), "{message}");
    stdout(&["simulate", &arm, "--time", "0.1", "-o", rows]);
}

#[cfg(unix)]
fn mode(path: &Path) -> u32 {
    use std::os::unix::fs::PermissionsExt;
    std::fs::metadata(path).unwrap().permissions().mode() & 0o777
}

/// A link leads to its file, an old file keeps its permissions, and a pipe is written into.
#[cfg(unix)]
#[test]
fn what_stands_there_stays_what_it_is() {
    use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
    let scratch = Scratch::new();
    let private = scratch.file("private", "old");
    std::fs::set_permissions(&private, std::fs::Permissions::from_mode(0o600)).unwrap();
    let (link, dangling, new) = (scratch.path("link.csv"), scratch.path("dangling"), scratch.path("new"));
    symlink("private", &link).unwrap();
    symlink("new", &dangling).unwrap();
    for (call, path) in [
        (&["matrix", "puma560", "--csv"][..], &link),
        (&["matrix", "puma560", "--csv"], &dangling),
        (&["simulate", "puma560", "--time", "0.1"], &link),
    ] {
        stdout(&[call, &["-o", path.to_str().unwrap()]].concat());
        assert!(std::fs::symlink_metadata(path).unwrap().is_symlink());
    }
    assert_eq!(mode(Path::new(&private)), 0o600);
    assert!(std::fs::read_to_string(&private).unwrap().starts_with("t,q0"));
    assert!(std::fs::read_to_string(&new).unwrap().starts_with("joint_1"));

    let pipe = scratch.path("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let reader = Command::new("cat").arg(&pipe).stdout(Stdio::piped()).spawn().unwrap();
    stdout(&["matrix", "puma560", "--csv", "-o", pipe.to_str().unwrap()]);
    assert!(reader.wait_with_output().unwrap().stdout.starts_with(b"joint_1"));
    assert!(std::fs::symlink_metadata(&pipe).unwrap().file_type().is_fifo());
}

/// New files are as the user's mask has them: a sweep's as any other.
#[cfg(all(unix, feature = "parquet"))]
#[test]
fn files_of_a_sweep_are_for_all() {
    let scratch = Scratch::new();
    let spec = scratch.file("s.toml", "[[robots]]\nfamily = \"hydra\"\nn = 3\n");
    let folder = scratch.path("out");
    stdout(&["sweep", &spec, "-o", folder.to_str().unwrap()]);
    let plain = mode(Path::new(&spec));
    for name in ["plan.json", "sweep.parquet", "chunks/000000.csv"] {
        assert_eq!(mode(&folder.join(name)), plain, "{name}");
    }
}

/// Nobody to tell: no reason to fail.
#[cfg(target_os = "linux")]
#[test]
fn talk_that_cannot_be_written_is_lost() {
    let scratch = Scratch::new();
    let arm = scratch.file("arm.urdf", &ARM.replace(" name='arm'", ""));
    let (rows, copy) = (scratch.path("rows.csv"), scratch.path("copy.xml"));
    for (call, status) in [
        (&["simulate", &arm, "--time", "0.1", "-o", rows.to_str().unwrap()][..], 0),
        (&["spectrum", "no/such/robot.urdf"], 2),
        (&["convert", &arm, "-o", copy.to_str().unwrap()], 0),
    ] {
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_eigenbody"));
        let found = command.args(call).stderr(full).stdout(Stdio::null()).status().unwrap();
        assert_eq!(found.code(), Some(status), "{call:?}");
    }
}

/// A reader that has seen enough is no error.
#[cfg(unix)]
#[test]
fn a_reader_may_leave() {
    for form in ["--csv", "--json", "--npy"] {
        let script = format!("\"$0\" matrix 'hydra(300)' {form} | true; exit \"${{PIPESTATUS[0]}}\"");
        let mut command = Command::new("bash");
        let output = command.args(["-c", &script, env!("CARGO_BIN_EXE_eigenbody")]).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{form}: {}", String::from_utf8_lossy(&output.stderr));
    }
}

/// Signals remove what is not finished.
#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_no_hidden_files() {
    for signal in ["-INT", "-TERM"] {
        let scratch = Scratch::new();
        let file = scratch.path("H.csv");
        let mut child = Command::new(env!("CARGO_BIN_EXE_eigenbody"))
            .args(["matrix", "hydra(3000)", "--csv", "-o", file.to_str().unwrap()])
            .spawn()
            .unwrap();
        let files = || std::fs::read_dir(scratch.path("")).unwrap().count();
        while files() == 0 {
            assert!(child.try_wait().unwrap().is_none(), "ended by itself");
            std::thread::yield_now();
        }
        assert!(!file.exists(), "too fast for this test");
        Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(130));
        assert_eq!(files(), 0);
    }
}

/// Names that would steer a terminal are shown.
#[test]
fn names_do_not_steer_the_terminal() {
    let scratch = Scratch::new();
    let arm = scratch.file("arm.urdf", &ARM.replace("elbow", "el\u{9b}31m\u{202e}b&#10;ow"));
    for command in ["info", "spectrum", "matrix"] {
        let page = stdout(&[command, &arm]);
        assert!(page.contains("el\\u{9b}31m\\u{202e}b\\now"), "{command}: {page}");
        assert!(!page.contains('\u{9b}') && !page.contains('\u{202e}'), "{command}");
    }
    // Programs get the name as it is.
    assert!(stdout(&["matrix", &arm, "--csv"]).contains("el\u{9b}31m\u{202e}b\now"));
}

/// What was refused says which file or option it is of.
#[test]
fn faults_name_where_they_come_from() {
    let scratch = Scratch::new();
    let arm = scratch.file("arm.urdf", ARM);
    scratch.file("eigenbody.toml", "[check]\nsamples = 64\nkp = \"zz=1\"\n");
    let message = failure(&["check", &arm]);
    assert!(message.contains("eigenbody.toml:3:6: kp = zz=1, column 1: no moving joint"), "{message}");
    assert!(failure(&["check", "puma560", "--kp=-1"]).starts_with("error: --kp -1, column 1: gain -1"));
    assert!(failure(&["simulate", &arm, "--damping=-1"]).starts_with("error: --damping -1, column 1: "));
    let twice = failure(&["check", "puma560", "--kp", "joint_1=1,joint_1=2"]);
    assert!(twice.ends_with("'joint_1' is named twice"), "{twice}");
    let mixed = run(&["check", &arm, "--fail-on", "error,solves"]);
    let message = String::from_utf8(mixed.stderr).unwrap();
    assert!(message.contains("'error' stands alone"), "{message}");
}

/// Options that nothing would use are refused.
#[test]
fn idle_options_are_refused() {
    let scratch = Scratch::new();
    let arm = scratch.file("arm.urdf", ARM);
    assert!(failure(&["simulate", &arm, "--step", "0.1"]).contains("--step is for --method euler"));
    assert!(failure(&["simulate", &arm, "--method", "rk4", "--tolerance", "1"]).contains("--method dopri5"));
    assert_eq!(run(&["simulate", &arm, "--bandwidth", "3"]).status.code(), Some(2));
    let times = scratch.file("times.csv", "t\n0\n1\n");
    let message = failure(&["simulate", &arm, "--torque", &times]);
    assert!(message.contains("times.csv:1: no column of forces"), "{message}");
    assert!(stdout(&["help", "check"]).contains("--fail-on"));
}

/// Lines are counted alike whatever ends them.
#[test]
fn lines_of_logs_are_counted_alike() {
    let scratch = Scratch::new();
    let arm = scratch.file("arm.urdf", ARM);
    for (text, place) in [
        ("t,q0,q1\r\n0,0,0\r\n1,0,x\r\n", ":3: column 'q1'"),
        ("t,q0,q1\n0,0,0\n1,0,x", ":3: column 'q1'"),
        ("t,q0,q1\n\n# words\n0,0,0\n\n1,0,x\n2,0,0\n", ":6: column 'q1'"),
        ("t,q0,q1\r\n0,0,0\r\n\r\n1,0,x", ":4: column 'q1'"),
        ("# words\nt,q0\n", ":2: no column for joint 'elbow'"),
    ] {
        let log = scratch.file("log.csv", text);
        let output = run(&["track", &arm, &log]);
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(message.contains(&format!("log.csv{place}")), "{text:?}: {message}");
    }
}

/// A robot that cannot move is not praised, and what gives energy away is found.
#[test]
fn what_was_not_assessed_is_not_praised() {
    let scratch = Scratch::new();
    let rigid = scratch.file("rigid.urdf", &ARM.replace("continuous", "fixed"));
    let page = stdout(&["check", &rigid]);
    assert!(page.contains("The robot cannot move") && !page.contains("Nothing found"), "{page}");
    assert!(stdout(&["check", &rigid, "--format", "html"]).contains("The robot cannot move"));
    assert!(!stdout(&["info", &rigid]).contains("-0 kg"));

    let joint = "<axis xyz='0 0 1'/></joint></robot>";
    let driven = ARM.replace(joint, "<axis xyz='0 0 1'/><dynamics damping='-1'/></joint></robot>");
    let path = scratch.file("driven.urdf", &driven);
    let output = run(&["check", &path]);
    let page = String::from_utf8(output.stdout).unwrap();
    assert!(page.contains("warning[time-step]: no time step is stable"), "{page}");
    assert_eq!(output.status.code(), Some(1));
}
