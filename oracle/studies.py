"""The robots of docs/estimators.md and docs/cost.md: name, base and file, one a line."""

import packages

ROBOTS = {
    "panda_description/urdf/panda.urdf": "fixed",
    "ur_description/urdf/ur5_robot.urdf": "fixed",
    "ur_description/urdf/ur10_robot.urdf": "fixed",
    "kinova_description/robots/kinova.urdf": "fixed",
    "talos_data/robots/talos_left_arm.urdf": "fixed",
    "so_arm_description/urdf/so101.urdf": "fixed",
    "allegro_hand_description/urdf/allegro_right_hand.urdf": "fixed",
    "baxter_description/urdf/baxter.urdf": "fixed",
    "pr2_description/urdf/pr2.urdf": "fixed",
    "tiago_pro_description/robots/tiago_pro.urdf": "fixed",
    "hextilt_description/urdf/hextilt_flying_arm_5.urdf": "floating",
    "a1_description/urdf/a1.urdf": "floating",
    "go2_description/urdf/go2.urdf": "floating",
    "anymal_c_simple_description/urdf/anymal.urdf": "floating",
    "hyq_description/robots/hyq_no_sensors.urdf": "floating",
    "solo_description/robots/solo12.urdf": "floating",
    "g1_description/urdf/g1_29dof_rev_1_0.urdf": "floating",
    "talos_data/robots/talos_full_v2.urdf": "floating",
    "icub_description/robots/icub_reduced.urdf": "fixed",
    "centauro_description/urdf/centauro.urdf": "fixed",
}


def main() -> None:
    found = {packages.short(path, "example-robot-data"): path for path in packages.files("example-robot-data", ".urdf")}
    for name, base in ROBOTS.items():
        print(f"{name.rsplit('/', 1)[1].removesuffix('.urdf')}\t{base}\t{found[name]}")


if __name__ == "__main__":
    main()
