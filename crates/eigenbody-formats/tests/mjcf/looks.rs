//! How geoms are drawn: where they stand on their links, whether or not they weigh anything.

use eigenbody::dynamics::link_poses;
use eigenbody_formats::{Form, MjcfOptions, Shape, load_text, read_mjcf_str};

const ROBOT: &str = r#"<mujoco>
  <default><geom group="1"/><default class="collision"><geom group="3"/></default></default>
  <asset><mesh name="cover" file="cover.stl" scale="2 2 2"/></asset>
  <worldbody>
    <geom type="plane" size="1 1 1"/><geom type="box" size="1 2 3" pos="0 0 -3"/>
    <body name="a" pos="1 0 0">
      <joint type="hinge" axis="0 0 1" pos="0.5 0 0"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <geom type="capsule" size="0.1" fromto="0 0 0 0 0 2"/>
      <geom class="collision" size="9"/>
      <geom type="mesh" mesh="cover"/>
      <frame pos="0 1 0"><geom type="sphere" size="0.2" pos="0 0 1"/></frame>
      <replicate count="3" offset="1 0 0"><geom type="cylinder" size="0.1 0.3"/></replicate>
    </body>
  </worldbody>
</mujoco>"#;

#[test]
fn geoms_are_drawn_where_they_stand() {
    let loaded = read_mjcf_str(ROBOT, "r.xml", &MjcfOptions::default()).unwrap();
    let links = loaded.model.links();
    let poses = link_poses(&loaded.model, &[0.0]).unwrap();
    let drawn: Vec<(&Form, [f64; 3])> = loaded
        .looks
        .iter()
        .map(|look| {
            let link = links.iter().position(|link| link.name() == look.link).unwrap();
            (&look.form, (look.pose * poses[link]).r.to_array())
        })
        .collect();
    let place = |wanted: &dyn Fn(&Form) -> bool| -> Vec<[f64; 3]> {
        drawn.iter().filter(|(form, _)| wanted(form)).map(|(_, at)| *at).collect()
    };
    let is = |shape: Shape| move |form: &Form| *form == Form::Primitive(shape);
    assert_eq!(place(&is(Shape::Box([1.0, 2.0, 3.0]))), [[0.0, 0.0, -3.0]]);
    assert_eq!(place(&is(Shape::Capsule([0.1, 1.0]))), [[1.0, 0.0, 1.0]]);
    assert_eq!(place(&is(Shape::Sphere([0.2]))), [[1.0, 1.0, 1.0]]);
    assert_eq!(place(&is(Shape::Cylinder([0.1, 0.3]))), [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]]);
    let mesh = Form::Mesh { file: "cover.stl".into(), scale: [2.0; 3] };
    assert_eq!(place(&|form| *form == mesh), [[1.0, 0.0, 0.0]]);
    // Neither the plane nor the collision shape.
    assert_eq!(drawn.len(), 7);
}

/// What is only drawn is not looked for, and never the reason that a text is refused.
#[test]
fn a_look_that_is_not_understood_is_passed_over() {
    let text = ROBOT.replace("fromto=\"0 0 0 0 0 2\"", "fromto=\"0 0 0 0 0 0\"").replace("0.1 0.3", "many");
    let loaded = load_text(&text, "r.xml", &Default::default()).unwrap();
    assert_eq!(loaded.looks.len(), 3);
}
