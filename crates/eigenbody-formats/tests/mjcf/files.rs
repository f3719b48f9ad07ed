//! What takes several files: includes, meshes, attached models.

use super::loaded;
use crate::folder::Folder;
use eigenbody::mass_matrix;
use insta::assert_snapshot;
use std::path::PathBuf;

const BALL: &str = "<body name='b'><joint name='j' axis='0 1 0'/><geom size='.1' pos='1 0 0'/></body>";

#[test]
fn included_elements_stand_where_the_include_does() {
    let folder = Folder::new();
    folder.file("parts/inner.xml", format!("<mujocoinclude>{BALL}</mujocoinclude>"));
    folder.file("parts/outer.xml", "<mujocoinclude><include file='inner.xml'/></mujocoinclude>");
    let found = folder.load("<mujoco><worldbody><include file='parts/outer.xml'/></worldbody></mujoco>");
    assert_eq!(found.model.joints()[0].name(), "j");
}

#[test]
fn faults_name_the_included_file() {
    let folder = Folder::new();
    folder.file("part.xml", "<mujocoinclude>\n  <body><joint axis='0 0 0'/></body></mujocoinclude>");
    assert_snapshot!(folder.fault("<mujoco><worldbody><include file='part.xml'/></worldbody></mujoco>"), @"part.xml:2:16: 'axis' of <joint> is too short to give a direction");
    assert_snapshot!(folder.fault("<mujoco><include file='part.xml'/><include file='part.xml'/></mujoco>"), @"main.xml:1:44: 'part.xml' is included already; a file is included once, and not in itself");
    assert_snapshot!(folder.fault("<mujoco><include file='missing.xml'/></mujoco>"), @"main.xml:1:18: 'missing.xml' cannot be included: no such file");
    assert_snapshot!(folder.fault("<mujoco>\n<include/></mujoco>"), @"main.xml:2:1: <include> has no attribute 'file'");
    folder.file("a.xml", "<mujoco><include file='main.xml'/></mujoco>");
    assert_snapshot!(folder.fault("<mujoco><include file='a.xml'/></mujoco>"), @"a.xml:1:18: 'main.xml' is included already; a file is included once, and not in itself");
    folder.file("latin.xml", b"<mujoco>\n \xe9</mujoco>");
    assert_snapshot!(folder.fault("<mujoco><include file='latin.xml'/></mujoco>"), @"latin.xml:2:2: byte 0xe9 is not UTF-8 text");
    folder.file("empty.xml", "<mujoco/>");
    assert_snapshot!(folder.fault("<mujoco><include file='empty.xml'/></mujoco>"), @"main.xml:1:18: 'empty.xml' is included, but has no elements");
}

/// A tetrahedron with the corners of the unit axes, in each format.
fn tetrahedron() -> [(&'static str, Vec<u8>); 3] {
    let corners: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let faces: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let bytes = |v: [f32; 3]| v.into_iter().flat_map(f32::to_le_bytes).collect::<Vec<u8>>();
    let mut stl = vec![0; 80];
    stl.extend(4u32.to_le_bytes());
    for face in faces {
        stl.extend([0; 12]);
        face.iter().for_each(|&i| stl.extend(bytes(corners[i as usize])));
        stl.extend([0; 2]);
    }
    let mut msh: Vec<u8> = [4u32, 0, 0, 4].into_iter().flat_map(u32::to_le_bytes).collect();
    corners.iter().for_each(|&v| msh.extend(bytes(v)));
    msh.extend(faces.as_flattened().iter().flat_map(|i| i.to_le_bytes()));
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1//1 2//1 4//1\nf 1/1 4/1 3/1\ng\nf -3 -2 -1\no more\nf 1 2 3\n";
    [("t.stl", stl), ("t.msh", msh), ("t.obj", obj.into())]
}

#[test]
fn one_tetrahedron_in_three_formats() {
    let folder = Folder::new();
    for (name, bytes) in tetrahedron() {
        folder.file(&format!("meshes/{name}"), bytes);
        let found = folder.load(&format!(
            "<mujoco><compiler meshdir='meshes'/><asset><mesh name='t' file='{name}' inertia='exact'/></asset>
             <worldbody><body><joint type='slide'/><joint axis='1 0 0'/><geom type='mesh' mesh='t'/></body></worldbody></mujoco>"
        ));
        let H = mass_matrix(&found.model, &[0.0, 0.0]).unwrap();
        // 1/6 m³ of water; about x: m (y² + z²), each ∫ y² = 1/60 a corner.
        let expected = [1000.0 / 6.0, 1000.0 / 30.0];
        for (i, expected) in expected.into_iter().enumerate() {
            // 20 ε of the mass
            assert!((H[(i, i)] - expected).abs() < 20.0 * f64::EPSILON * 200.0, "{name} {}", H[(i, i)]);
        }
    }
}

#[test]
fn meshes_that_are_broken() {
    let folder = Folder::new();
    let mesh = |name: &str, bytes: &[u8]| {
        folder.file(name, bytes);
        folder.fault(&format!(
            "<mujoco><asset>\n<mesh name='m' file='{name}'/></asset><worldbody><body><joint/><geom type='mesh' mesh='m'/></body></worldbody></mujoco>"
        ))
    };
    assert_snapshot!(mesh("a.stl", b"solid ascii\n facet normal 0 0 1"), @"main.xml:2:1: mesh 'm': file 'a.stl' is an STL file of text, expected a binary one");
    assert_snapshot!(mesh("b.stl", &[0; 20]), @"main.xml:2:1: mesh 'm': file 'b.stl' holds 20 bytes, expected at least 84");
    assert_snapshot!(mesh("c.stl", &[0xff; 100]), @"main.xml:2:1: mesh 'm': file 'c.stl' holds 100 bytes, expected 214748364834 for 4294967295 triangles");
    assert_snapshot!(mesh("a.msh", &[0; 3]), @"main.xml:2:1: mesh 'm': file 'a.msh' holds 3 bytes, expected at least 16");
    assert_snapshot!(mesh("b.msh", &[0xff; 64]), @"main.xml:2:1: mesh 'm': file 'b.msh' holds 64 bytes, expected 188978560996 for 4294967295 vertices, 4294967295 normals, 4294967295 texels and 4294967295 faces");
    assert_snapshot!(mesh("a.obj", b"v 1 2 three"), @"main.xml:2:1: mesh 'm': file 'a.obj', line 1: a vertex holds no number");
    assert_snapshot!(mesh("b.obj", b"v 1 2 3\nf 1 2 3\nf a b c"), @"main.xml:2:1: mesh 'm': file 'b.obj', line 3: a face names no vertex");
    assert_snapshot!(mesh("c.obj", b"v 1 2 3\nf 1 2 3"), @"main.xml:2:1: mesh 'm': face 0 names vertex 1 of 1");
    assert_snapshot!(mesh("a.ply", b"ply"), @"main.xml:2:1: mesh 'm': file 'a.ply' is of no known kind, expected .stl, .obj or .msh");
}

#[test]
fn a_model_is_attached_with_a_prefix() {
    let folder = Folder::new();
    folder.file(
        "arm.xml",
        format!("<mujoco><compiler angle='radian'/><worldbody><geom size='.1'/>{BALL}</worldbody></mujoco>"),
    );
    let with = |attach: &str| {
        let found = folder.load(&format!(
            "<mujoco><asset><model name='arm' file='arm.xml'/></asset>
             <worldbody><body name='base'><joint name='turn'/><geom size='.2'/>
             <frame pos='0 1 0'>{attach}</frame></body></worldbody></mujoco>"
        ));
        let names: Vec<String> = found.model.joints().iter().map(|j| j.name().to_owned()).collect();
        (names.join(" "), mass_matrix(&found.model, &vec![0.0; found.model.nq()]).unwrap()[(0, 0)])
    };
    let ball = |r: f64| 4000.0 / 3.0 * std::f64::consts::PI * r * r * r;
    let base = 0.4 * ball(0.2) * 0.04;
    let (names, H) = with("<attach model='arm' body='b' prefix='left_'/>");
    assert_eq!(names, "turn left_j");
    // The arm's ball stands at (1, 1): 0.4 m r² + 2 m.
    let arm = ball(0.1) * (0.004 + 2.0);
    // 20 ε of the sum
    assert!((H - base - arm).abs() < 20.0 * f64::EPSILON * (base + arm), "{H}");
    // With the whole model comes what stands in its world.
    let (names, H) = with("<attach model='arm' prefix='right_'/>");
    let all = base + arm + ball(0.1) * (0.004 + 1.0);
    assert_eq!(names, "turn right_j");
    assert!((H - all).abs() < 20.0 * f64::EPSILON * all, "{H} {all}");
}

/// A model comes from what it includes and attaches, and from the meshes and height fields that it names, used or not.
#[test]
fn its_files_are_known() {
    let folder = Folder::new();
    let mesh = "<asset><mesh file='m.stl'/><hfield name='h' file='h.png' size='1 1 1 1'/></asset>";
    folder.file("part.xml", "<mujocoinclude/>".replace("/>", "><body name='p'/></mujocoinclude>"));
    folder.file("arm/arm.xml", "<mujoco><asset><mesh file='a.obj'/></asset></mujoco>");
    folder.file("meshes/m.stl", "");
    let found = folder.load(&format!(
        "<mujoco><compiler meshdir='meshes'/>{mesh}<asset><model name='arm' file='arm/arm.xml'/></asset>
         <worldbody><include file='part.xml'/></worldbody></mujoco>"
    ));
    let names = ["main.xml", "part.xml", "arm/arm.xml", "meshes/m.stl", "meshes/h.png", "arm/a.obj"];
    assert_eq!(found.files(), names.map(|name| folder.path(name)));
    assert_eq!(loaded("<mujoco/>").files(), [PathBuf::from("test.xml")]);
}

/// An attached model's sections are there as far as what they name is: the rest of them may name what was left behind.
#[test]
fn what_was_not_attached_may_be_named() {
    let folder = Folder::new();
    let parts = "<body name='a'><joint name='j'/><geom size='.1'/></body><body name='c'><joint name='k'/><geom size='.1'/></body>";
    let rest = "<actuator><motor name='m' joint='j'/><motor joint='k'/></actuator><tendon><fixed name='t'><joint joint='j' coef='1'/></fixed></tendon>";
    folder.file("child.xml", format!("<mujoco><worldbody>{parts}</worldbody>{rest}</mujoco>"));
    let main = |sections: &str| {
        format!(
            "<mujoco><asset><model name='child' file='child.xml'/></asset>\n<worldbody><attach model='child' body='a' prefix='p_'/></worldbody>\n{sections}</mujoco>"
        )
    };
    let found = folder.load(&main(
        "<actuator><motor tendon='p_t'/></actuator><sensor><actuatorpos actuator='p_m'/></sensor>",
    ));
    assert_eq!(found.model.nv(), 1);
    assert_snapshot!(folder.fault(&main("<actuator><motor joint='p_k'/></actuator>")), @"main.xml:3:18: no joint is named 'p_k'; did you mean 'p_j'?");
    folder.file("child.xml", "<mujoco><tendon><fixed name='t'/><fixed name='t'/></tendon></mujoco>");
    assert_snapshot!(folder.fault(&main("")), @"child.xml:1:34: a second tendon is named 't'; the first is at 1:17");
}
