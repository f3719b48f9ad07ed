//! Files and what MuJoCo 4.0 computes for them (`mj_fullM`): name, file, q, the rows of H.

/// A file, a configuration and the rows of H.
pub type Case = (&'static str, &'static str, &'static [f64], &'static [f64]);

/// The cases.
pub const CASES: &[Case] = &[
    (
        "defaults",
        r#"<mujoco><default><joint armature=".1"/><geom density="500"/><default class="a"><geom size=".1 .2 .3"/><joint axis="1 0 0"/><default class="b"><geom type="box" mass="2"/></default></default></default><worldbody><body childclass="a"><joint/><geom class="b" size=".2"/><body pos="0 0 1"><joint/><geom/></body></body></worldbody></mujoco>"#,
        &[0.3, 0.4],
        &[2.2894393494694345, 0.008377580409572795, 0.008377580409572795, 0.1083775804095728],
    ),
    (
        "frames",
        r#"<mujoco><worldbody><frame pos="1 2 3" euler="10 20 30"><body pos=".1 .2 .3" quat="1 1 0 0"><frame pos="0 0 .5" axisangle="1 0 0 40"><joint pos=".1 0 0" axis="0 1 1"/><geom type="box" size=".1 .2 .3" pos=".1 0 .2" euler="10 20 30"/><frame euler="0 0 90"><body pos="1 0 0"><joint type="slide" axis="1 1 0"/><geom type="box" size=".1 .2 .3" pos=".1 0 .2" euler="10 20 30"/></body></frame></frame></body></frame></worldbody></mujoco>"#,
        &[0.3, 0.4],
        &[44.01569682626242, 19.19999999999997, 19.19999999999997, 47.999999999999915],
    ),
    (
        "replicate",
        r#"<mujoco><worldbody><body><joint axis="0 1 0"/><geom size=".1"/><replicate count="3" offset=".2 0 0" euler="0 0 30" sep="-"><body name="b" pos="0 1 0"><joint name="j" axis="1 0 0"/><geom size=".1"/></body></replicate></body></worldbody></mujoco>"#,
        &[0.1, 0.2, 0.3, 0.4],
        &[1.4613510750863812, 1.1720650909292475e-17, 0.008377580409572788, 0.014510394913873891, 1.1720650909292475e-17, 0.016755160819145767, 0.0, 0.0, 0.008377580409572788, 0.0, 0.01675516081914554, 0.0, 0.014510394913873891, 0.0, 0.0, 0.016755160819145604],
    ),
    (
        "several_joints_and_ref",
        r#"<mujoco><compiler angle="radian"/><worldbody><body pos="1 0 0"><joint axis="1 2 3" pos=".1 .2 .3" ref=".5"/><joint type="slide" axis="0 3 4" ref=".2"/><joint axis="0 0 1" pos="0 .4 0" ref="-.3"/><geom type="box" size=".1 .2 .3" pos=".1 0 .2" euler=".1 .2 .3"/></body></worldbody></mujoco>"#,
        &[0.3, 0.4, 0.5],
        &[3.5279825944072867, 1.3568100012188173, 3.228601554400574, 1.3568100012188173, 48.000000000000014, 10.270457490082334, 3.228601554400574, 10.270457490082334, 9.011421876419918],
    ),
    (
        "ball",
        r#"<mujoco><worldbody><body><joint axis="0 0 1"/><geom type="box" size=".1 .2 .3" pos=".1 0 .2" euler="10 20 30"/><body pos="0 0 1"><joint type="ball" pos=".1 .2 .3"/><geom type="box" size=".1 .2 .3" pos=".1 0 .2" euler="10 20 30"/></body></body></worldbody></mujoco>"#,
        &[0.3, 0.5, 0.5, -0.5, 0.5],
        &[11.879336338283084, 6.144305777009008, 0.2570831841226832, -0.3332374122590908, 6.144305777009008, 4.224305777009008, 0.25708318412268333, -0.33323741225909004, 0.2570831841226832, 0.25708318412268333, 2.2006636617169115, -0.8926762607752856, -0.3332374122590908, -0.33323741225909004, -0.8926762607752856, 2.8550305612740727],
    ),
    (
        "shells",
        r#"<mujoco><worldbody><body><joint axis="1 1 1"/><geom type="capsule" size=".1 .2" shellinertia="true"/></body><body><joint axis="1 1 1"/><geom type="cylinder" size=".1 .2" shellinertia="true"/></body><body><joint axis="1 1 1"/><geom type="ellipsoid" size=".1 .2 .3" shellinertia="true"/></body><body><joint axis="1 1 1"/><geom type="box" size=".1 .2 .3" shellinertia="true"/></body><body><joint/><geom size=".1" shellinertia="true"/></body></worldbody></mujoco>"#,
        &[0.0, 0.0, 0.0, 0.0, 0.0],
        &[9.773843811168248, 0.0, 0.0, 0.0, 0.0, 0.0, 5.794493116621176, 0.0, 0.0, 0.0, 0.0, 0.0, 13.415407465227572, 0.0, 0.0, 0.0, 0.0, 0.0, 40.1777777777778, 0.0, 0.0, 0.0, 0.0, 0.0, 0.8377580409572783],
    ),
    (
        "solids",
        r#"<mujoco><worldbody><body><joint axis="1 1 1"/><geom type="capsule" size=".1 .2"/></body><body><joint axis="1 1 1"/><geom type="cylinder" size=".1 .2"/></body><body><joint axis="1 1 1"/><geom type="ellipsoid" size=".1 .2 .3"/></body><body><joint axis="1 1 1"/><geom type="box" size=".1 .2 .3" mass="2"/></body><body><joint/><geom size=".1"/></body><body><joint axis="1 1 1"/><geom type="capsule" size=".05" fromto="0 0 0 .1 .2 .3"/></body></worldbody></mujoco>"#,
        &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        &[0.3239331091701478, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.15358897417550108, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.4691445029360759, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.06222222222222225, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.01675516081914557, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.029286605456038076],
    ),
    (
        "inertials",
        r#"<mujoco><worldbody><body><joint axis="1 2 3"/><inertial pos=".1 .2 .3" mass="2" euler="10 20 30" diaginertia=".1 .2 .25"/></body><body><joint axis="1 2 3"/><inertial pos=".1 .2 .3" mass="2" fullinertia=".1 .2 .25 .01 .02 .03"/></body></worldbody></mujoco>"#,
        &[0.0, 0.0],
        &[0.2160101159053989, 0.0, 0.0, 0.26214285714285906],
    ),
    (
        "bounds",
        r#"<mujoco><compiler boundmass="1" boundinertia=".1" balanceinertia="true"/><worldbody><body><joint axis="1 2 3"/><geom size=".1" mass=".01"/></body><body><joint axis="1 2 3"/><inertial pos="0 0 0" mass="2" diaginertia=".1 .1 .5"/></body><body><joint axis="0 1 1"/><geom size=".1"/><body pos="1 2 3"/></body></worldbody></mujoco>"#,
        &[0.0, 0.0, 0.0],
        &[0.10000000000000002, 0.0, 0.0, 0.0, 0.23333333333333334, 0.0, 0.0, 0.0, 6.199999999999997],
    ),
    (
        "total_mass",
        r#"<mujoco><compiler settotalmass="10"/><worldbody><body><joint/><geom size=".1" pos="1 0 0"/></body><body><geom size=".1"/></body></worldbody></mujoco>"#,
        &[0.0],
        &[5.02],
    ),
    (
        "groups",
        r#"<mujoco><compiler inertiagrouprange="1 2"/><worldbody><body><joint/><geom size=".1" pos="1 0 0" group="1"/><geom size=".3" group="3"/></body></worldbody></mujoco>"#,
        &[0.0],
        &[4.205545365605537],
    ),
    (
        "from_geoms_always",
        r#"<mujoco><compiler inertiafromgeom="true"/><worldbody><body><joint/><inertial pos="0 0 0" mass="9" diaginertia="1 1 1"/><geom size=".1" pos="1 0 0"/></body></worldbody></mujoco>"#,
        &[0.0],
        &[4.205545365605537],
    ),
    (
        "euler_sequences",
        r#"<mujoco><compiler eulerseq="zYx"/><worldbody><body euler="10 20 30"><joint/><geom type="box" size=".1 .2 .3" pos=".1 0 .2" euler="10 20 30"/><body euler="-40 50 60" pos="0 0 1"><joint axis="0 1 0"/><geom type="box" size=".1 .2 .3" pos=".1 0 .2" euler="10 20 30"/></body></body></worldbody></mujoco>"#,
        &[0.2, 0.3],
        &[5.946958939405511, 1.1614542922190785, 1.1614542922190785, 3.8205045089327907],
    ),
    (
        "meshes",
        r#"<mujoco><asset><mesh name="t" vertex="0 0 0 .3 0 0 0 .2 0 0 0 .4" scale="1 -1.2 .8"/><mesh name="s" inertia="shell" vertex="0 0 0 .3 0 0 0 .2 0 0 0 .4" refpos=".1 0 0" refquat="1 .2 0 .3"/></asset><worldbody><body><joint axis="1 2 3"/><geom type="mesh" mesh="t" pos=".1 .2 .3"/></body><body><joint axis="1 2 3"/><geom type="mesh" mesh="s" density="20"/></body><body><joint axis="1 2 3"/><geom type="box" mesh="t"/></body></worldbody></mujoco>"#,
        &[0.0, 0.0, 0.0],
        &[0.070623095750857, 0.0, 0.0, 0.0, 0.043021310138273434, 0.0, 0.0, 0.0, 0.09846794653224597],
    ),
    (
        "armature_of_tendons_and_actuators",
        r#"<mujoco><worldbody><body><joint name="a" axis="0 1 0"/><geom size=".1"/></body><body><joint name="b" axis="0 1 0"/><geom size=".1"/></body></worldbody><tendon><fixed name="t" armature=".1"><joint joint="a" coef="2"/></fixed></tendon><actuator><motor joint="b" gear="3" armature=".2"/><motor tendon="t" gear="2" armature=".3"/></actuator></mujoco>"#,
        &[0.0, 0.0],
        &[5.216755160819146, 0.0, 0.0, 1.8167551608191457],
    ),
];
