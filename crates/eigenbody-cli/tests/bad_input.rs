//! Every bad input: one clear line that says where and what was expected, status 2, no panic.

use crate::run::{Scratch, failure};
use insta::assert_snapshot;

/// The message about a URDF text, its path cut to the file's name.
fn urdf(text: &str) -> String {
    let scratch = Scratch::new();
    let path = scratch.file("robot.urdf", text);
    failure(&["spectrum", &path]).replace(&path, "robot.urdf")
}

#[test]
fn files() {
    assert_snapshot!(failure(&["spectrum", "no/such/robot.urdf"]), @"error: no/such/robot.urdf: no such file");
    assert_snapshot!(urdf("mass: 1"), @"error: robot.urdf:1:1: not well-formed XML: unknown token");
    assert_snapshot!(urdf("<robot name=\"r\"><link name=\"a\"></robot>"), @"error: robot.urdf:1:32: not well-formed XML: expected 'link' tag, not 'robot'");
    assert_snapshot!(urdf("<html><body/></html>"), @"error: robot.urdf:1:1: no URDF: the root element is <html>, expected <robot>");
    assert_snapshot!(urdf("<robot name=\"r\"/>"), @"error: robot.urdf:1:1: the model has no links");
}

#[test]
fn joints() {
    let robot = |joints: &str| {
        urdf(&format!(
            "<robot name=\"r\">\n<link name=\"a\"/>\n<link name=\"b\"/>\n<link name=\"c\"/>\n{joints}\n</robot>"
        ))
    };
    let joint = |name: &str, kind: &str, parent: &str, child: &str| {
        format!(
            "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/></joint>\n"
        )
    };
    assert_snapshot!(robot(&(joint("j", "hinge", "a", "b") + &joint("k", "fixed", "b", "c"))), @"error: robot.urdf:5:17: joint 'j' has type 'hinge', expected one of revolute, continuous, prismatic, fixed, floating, planar");
    assert_snapshot!(robot(&(joint("j", "revolute", "a", "elbow") + &joint("k", "fixed", "b", "c"))), @"error: robot.urdf:5:58: joint 'j' names child link 'elbow', which is not in the file");
    assert_snapshot!(robot(&(joint("j", "fixed", "b", "c") + &joint("k", "fixed", "c", "b"))), @"error: robot.urdf:6:1: joint 'k' closes a loop: its child link 'b' is among its own ancestors");
    assert_snapshot!(robot(&joint("j", "fixed", "a", "b")), @"error: robot.urdf:4:1: two root links, 'a' and 'c'; a tree has one link that is no joint's child");
    assert_snapshot!(robot(&(joint("j", "fixed", "a", "b") + &joint("k", "fixed", "c", "b"))), @"error: robot.urdf:6:1: link 'b' is the child of joint 'j' and of joint 'k'; in a tree a link has one parent");
}

#[test]
fn numbers() {
    let link = |inertial: &str| {
        urdf(&format!("<robot name=\"r\">\n<link name=\"a\">\n{inertial}\n</link>\n</robot>"))
    };
    let inertial = |mass: &str, ixx: &str| {
        format!(
            "<inertial><mass value=\"{mass}\"/><inertia ixx=\"{ixx}\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial>"
        )
    };
    assert_snapshot!(link(&inertial("NaN", "1")), @"error: robot.urdf:3:17: 'value' of <mass> holds 'NaN', expected a finite number");
    assert_snapshot!(link(&inertial("1", "inf")), @"error: robot.urdf:3:37: 'ixx' of <inertia> holds 'inf', expected a finite number");
    assert_snapshot!(link(&inertial("-1", "1")), @"error: robot.urdf:2:1: link 'a' has mass -1, expected zero or more (kg)");
    assert_snapshot!(link(&inertial("heavy", "1")), @"error: robot.urdf:3:17: 'value' of <mass> holds 'heavy', expected a finite number");
}

#[test]
fn configurations() {
    assert_snapshot!(failure(&["spectrum", "puma560", "--at", "q=[1,2,3]"]), @"error: q=[1,2,3], column 3: q has 3 numbers, expected 6");
    assert_snapshot!(failure(&["spectrum", "puma560", "--at", "zag(banana)"]), @"error: zag(banana), column 5: 'banana' is not a number; expected a number such as 0.3 or pi/2");
    assert_snapshot!(failure(&["spectrum", "puma560", "--at", "joint_9=1"]), @"error: joint_9=1, column 1: no moving joint is named 'joint_9'; did you mean 'joint_1'?");
    assert_snapshot!(failure(&["spectrum", "puma560", "--at", "random(1.5)"]), @"error: random(1.5), column 8: expected a whole number from 0 to 18446744073709551615");
    assert_snapshot!(failure(&["spectrum", "puma560", "--at", "q=[0,0,0,0,0,1/0]"]), @"error: q=[0,0,0,0,0,1/0], column 15: the value is not a finite number");
    assert_snapshot!(failure(&["spectrum", "puma560", "--at", "sideways"]), @"error: sideways, column 1: no configuration; expected zero, zag(angle), curl(angle), random(seed), q=[..] or joint=value, ..");
}

#[test]
fn families() {
    assert_snapshot!(failure(&["spectrum", "hydra(0,1,0,1)"]), @"error: hydra(0,1,0,1), column 7: N = 0: the number of links is a whole number from 1 to 10000000");
    assert_snapshot!(failure(&["spectrum", "hydra(10,0.5,0,1)"]), @"error: hydra(10,0.5,0,1), column 10: B = 0.5: the branching factor is a number of 1 or more");
    assert_snapshot!(failure(&["spectrum", "hydra(1e12,1,0,1)"]), @"error: hydra(1e12,1,0,1), column 7: N = 1000000000000: the number of links is a whole number from 1 to 10000000");
    assert_snapshot!(failure(&["spectrum", "hydra(10,1,0,0)"]), @"error: hydra(10,1,0,0), column 14: ρ = 0: the taper is a positive number");
    assert_snapshot!(failure(&["spectrum", "hyrda(10)"]), @"error: no model 'hyrda(10)': no such file, and none of hydra(N,B,α,ρ), onion(N,B,α,ρ), auto_tree(N,B,α,ρ), chain(N,m,l), puma560; did you mean 'hydra'?");
    assert_snapshot!(failure(&["spectrum", "hydra(10"]), @"error: hydra(10, column 9: expected ')', found the end");
    assert_snapshot!(failure(&["spectrum", "hydra(400,1,0,10)"]), @"error: hydra(400,1,0,10): inertia of link 'link_63' is not a finite number");
    assert_snapshot!(failure(&["matrix", "hydra(1000000,1,0,1)"]), @"error: hydra(1000000,1,0,1): a dense matrix of 1000000 × 1000000 entries is too large (limit 20000 × 20000)");
}

#[test]
fn options() {
    assert_snapshot!(failure(&["spectrum", "puma560", "--metric", "length=-1"]), @"error: length=-1, column 8: length -1 m, expected a positive number");
    assert_snapshot!(failure(&["spectrum", "puma560", "--metric", "diagonal=[1,2]"]), @"error: puma560: B has 2 numbers, expected 6");
    assert_snapshot!(failure(&["spectrum", "puma560", "--count-below", "inf"]), @"error: --count-below inf: expected a finite number");
    assert_snapshot!(failure(&["spectrum", "puma560", "--reduced"]), @"error: --reduced removes a floating base: add --base floating");
    assert_snapshot!(failure(&["matrix", "puma560", "--csv", "-o", "/no/such/folder/h.csv"]), @"error: /no/such/folder/h.csv: no folder '/no/such/folder'");
}

/// A failed run leaves what the user had.
#[test]
fn an_old_output_survives_a_failed_run() {
    let scratch = Scratch::new();
    let kept = scratch.file("h.csv", "precious");
    failure(&["matrix", "puma560", "--at", "zag(banana)", "--csv", "-o", &kept]);
    assert_eq!(std::fs::read_to_string(&kept).unwrap(), "precious");
}
