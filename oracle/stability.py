"""Stable steps against simulation: 0.95 of the largest step that `eigenbody check` names is stable, 1.05 of it is not.

    python oracle/stability.py path/to/eigenbody

MJCF files run in MuJoCo itself, by its own integrators; URDF files with gains on every joint in Pinocchio, by steppers written here.
Both are the whole robot, not a linear system: joints at the configuration that `check` names, springs at rest there, no gravity,
contacts or limits, and a push of 1e-9.
"""

import json
import math
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin

import packages

PUSH = 1e-9
STEPS = 3000
GAINS = ["--kp", "100", "--kd", "1"]


@dataclass
class Tally:
    robots: set[str] = field(default_factory=set)
    right: int = 0
    wrong: list[str] = field(default_factory=list)
    gains: int = 0


def check(command: Path, path: Path, *options: str) -> dict | None:
    call = [command, "check", path, "--format", "json", "--fail-on", "never", *options]
    answer = subprocess.run(call, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120)
    return json.loads(answer.stdout) if answer.returncode == 0 else None


def grows(sizes: list[float]) -> bool:
    """Whether a motion grows as only an unstable one does: a free one drifts, by as many pushes as there are steps."""
    return not all(map(math.isfinite, sizes)) or max(sizes) > 300 * STEPS * sizes[0]


# MuJoCo


def mujoco_model(path: Path) -> mujoco.MjModel | None:
    try:
        model = mujoco.MjModel.from_xml_path(str(path))
    except (ValueError, mujoco.FatalError):
        return None
    disable = mujoco.mjtDisableBit
    model.opt.disableflags |= disable.mjDSBL_CONSTRAINT | disable.mjDSBL_GRAVITY | disable.mjDSBL_CLAMPCTRL
    model.opt.disableflags |= disable.mjDSBL_AUTORESET
    model.opt.density = model.opt.viscosity = 0
    model.actuator_forcelimited[:] = 0
    model.jnt_actfrclimited[:] = 0
    model.tendon_actfrclimited[:] = 0
    for tendon in range(model.ntendon):
        first = model.tendon_adr[tendon]
        if int(model.wrap_type[first]) != int(mujoco.mjtWrap.mjWRAP_JOINT):
            model.tendon_stiffness[tendon] = model.tendon_damping[tendon] = 0
    return model


def settle(model: mujoco.MjModel, data: mujoco.MjData, q: np.ndarray) -> None:
    """Springs and feedback at rest in q."""
    model.qpos_spring[:] = q
    data.qpos[:] = q
    mujoco.mj_forward(model, data)
    model.tendon_lengthspring[:] = data.ten_length[:, None]
    model.actuator_gaintype[:] = mujoco.mjtGain.mjGAIN_FIXED
    model.actuator_gainprm[:] = 0
    model.actuator_biasprm[:, 0] = -model.actuator_biasprm[:, 1] * data.actuator_length


def mujoco_grows(path: Path, limit: dict, part: float) -> bool:
    model = mujoco_model(path)
    integrators = mujoco.mjtIntegrator
    chosen = {
        "semi-implicit Euler": integrators.mjINT_EULER,
        "damped Euler": integrators.mjINT_EULER,
        "implicit in velocity": integrators.mjINT_IMPLICITFAST,
        "RK4": integrators.mjINT_RK4,
    }
    model.opt.integrator = chosen[limit["integrator"]]
    if limit["integrator"] == "semi-implicit Euler":
        model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_EULERDAMP
    model.opt.timestep = part * limit["largest"]
    data = mujoco.MjData(model)
    q = np.array(limit["q"])
    settle(model, data, q)
    rng = np.random.default_rng(1)
    data.qvel[:] = PUSH * rng.standard_normal(model.nv)
    sizes, apart = [], np.zeros(model.nv)
    for step in range(STEPS):
        mujoco.mj_step(model, data)
        if step % (STEPS // 10) == 0:
            mujoco.mj_differentiatePos(model, apart, 1.0, q, data.qpos)
            sizes.append(float(np.abs(data.qvel).max() * model.opt.timestep + np.abs(apart).max()))
            if not math.isfinite(sizes[-1]) or sizes[-1] > 1e-2:
                return True
    return grows(sizes)


def is_linear(model: mujoco.MjModel) -> bool:
    """Whether every actuator's feedback is linear."""
    affine = (int(mujoco.mjtBias.mjBIAS_NONE), int(mujoco.mjtBias.mjBIAS_AFFINE))
    return all(int(bias) in affine for bias in model.actuator_biastype)


def gains(model: mujoco.MjModel, report: dict) -> bool:
    """Whether K_dd and D_dd of every hinge, slide and ball are MuJoCo's own."""
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    K, D = np.zeros(model.nv), model.dof_damping.copy()
    for d in range(model.nv):
        K[d] = model.jnt_stiffness[model.dof_jntid[d]]
    moment = np.zeros((model.nu, model.nv))
    if model.nu:
        mujoco.mju_sparse2dense(moment, data.actuator_moment, data.moment_rownnz, data.moment_rowadr, data.moment_colind)
    for a in range(model.nu):
        if int(model.actuator_biastype[a]) == int(mujoco.mjtBias.mjBIAS_AFFINE):
            K -= model.actuator_biasprm[a, 1] * moment[a] ** 2
            D -= model.actuator_biasprm[a, 2] * moment[a] ** 2
    arms = np.zeros((model.ntendon, model.nv))
    for t in range(model.ntendon):
        for w in range(model.tendon_adr[t], model.tendon_adr[t] + model.tendon_num[t]):
            if int(model.wrap_type[w]) == int(mujoco.mjtWrap.mjWRAP_JOINT):
                arms[t, model.jnt_dofadr[model.wrap_objid[w]]] += model.wrap_prm[w]
        K += model.tendon_stiffness[t] * arms[t] ** 2
        D += model.tendon_damping[t] * arms[t] ** 2
    ours = report["stepping"]["joints"]
    if len(ours) != model.nv:
        return False
    plain = [d for d in range(model.nv) if int(model.jnt_type[model.dof_jntid[d]]) != int(mujoco.mjtJoint.mjJNT_FREE)]
    near = lambda a, b: abs(a - b) <= 1e-6 * max(abs(a), abs(b))
    return all(near(ours[d]["stiffness"], K[d]) and near(ours[d]["damping"], D[d]) for d in plain)


# Pinocchio


class Arm:
    """A URDF robot without gravity, with a spring and a damper on every joint."""

    def __init__(self, path: Path, report: dict):
        self.model = pin.buildModelFromUrdf(str(path))
        self.data = self.model.createData()
        self.model.gravity.linear[:] = 0
        own = {joint["joint"]: joint for joint in report["stepping"]["joints"]}
        order = [name for name in self.model.names[1:]]
        self.K = np.array([own[name]["stiffness"] for name in order])
        self.D = np.array([own[name]["damping"] for name in order])
        self.names, self.order = list(own), order

    def configuration(self, numbers: list[float]) -> np.ndarray:
        angle = dict(zip(self.names, numbers))
        q = pin.neutral(self.model)
        for k, name in enumerate(self.order):
            joint = self.model.joints[k + 1]
            if joint.nq == 1:
                q[joint.idx_q] = angle[name]
            else:
                q[joint.idx_q : joint.idx_q + 2] = math.cos(angle[name]), math.sin(angle[name])
        return q

    def acceleration(self, q, v, q0):
        tau = -self.K * pin.difference(self.model, q0, q) - self.D * v
        return pin.aba(self.model, self.data, q, v, tau)

    def step(self, integrator: str, q, v, q0, h: float):
        model, move = self.model, pin.integrate
        if integrator == "semi-implicit Euler":
            v = v + h * self.acceleration(q, v, q0)
            return move(model, q, h * v), v
        if integrator == "implicit in velocity":
            H = pin.crba(model, self.data, q)
            H = np.triu(H) + np.triu(H, 1).T
            force = -self.K * pin.difference(model, q0, q) - self.D * v
            force -= pin.nonLinearEffects(model, self.data, q, v)
            v = v + h * np.linalg.solve(H + h * np.diag(self.D), force)
            return move(model, q, h * v), v
        a1 = self.acceleration(q, v, q0)
        v2 = v + h / 2 * a1
        a2 = self.acceleration(move(model, q, h / 2 * v), v2, q0)
        v3 = v + h / 2 * a2
        a3 = self.acceleration(move(model, q, h / 2 * v2), v3, q0)
        v4 = v + h * a3
        a4 = self.acceleration(move(model, q, h * v3), v4, q0)
        return move(model, q, h / 6 * (v + 2 * v2 + 2 * v3 + v4)), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)

    def grows(self, limit: dict, part: float) -> bool:
        h, q0 = part * limit["largest"], self.configuration(limit["q"])
        q, v = q0.copy(), PUSH * np.random.default_rng(1).standard_normal(self.model.nv)
        sizes = []
        for step in range(STEPS):
            q, v = self.step(limit["integrator"], q, v, q0, h)
            if step % (STEPS // 10) == 0:
                sizes.append(float(np.abs(v).max() * h + np.abs(pin.difference(self.model, q0, q)).max()))
                if not math.isfinite(sizes[-1]) or sizes[-1] > 1e-2:
                    return True
        return grows(sizes)


def judge(tally: Tally, name: str, limits: list[dict], simulate) -> None:
    for limit in limits:
        # A step of minutes and more is none that anyone takes; below a nanosecond H itself is in doubt.
        if limit["largest"] is None or not 1e-9 < limit["largest"] < 10:
            continue
        below, above = simulate(limit, 0.95), simulate(limit, 1.05)
        tally.robots.add(name)
        if above and not below:
            tally.right += 1
        else:
            tally.wrong.append(f"{name}: {limit['integrator']} {limit['largest']:.3g} s: "
                               f"{'grows' if below else 'stays'} at 0.95, {'grows' if above else 'stays'} at 1.05")


def main() -> int:
    command = Path(sys.argv[1])
    tally = Tally()
    for package in ("dm-control", "robosuite", "gymnasium"):
        for path in packages.mjcf(package):
            report = check(command, path)
            model = mujoco_model(path) if report and report["stepping"] else None
            if model is None or not is_linear(model):
                continue
            name = packages.short(path, package)
            if not gains(model, report):
                tally.wrong.append(f"{name}: other gains than MuJoCo has")
            else:
                tally.gains += 1
            judge(tally, name, report["stepping"]["limits"], lambda limit, part: mujoco_grows(path, limit, part))
    mjcf = len(tally.robots)
    print(f"MJCF: {mjcf} robots in MuJoCo, {tally.right} limits right; gains of {tally.gains} files as MuJoCo has them", flush=True)
    for path in packages.files("example-robot-data", ".urdf"):
        report = check(command, path, "--mimic", "off", *GAINS)
        if not report or not report["stepping"] or len(report["stepping"]["joints"]) != report["dofs"]:
            continue
        try:
            arm = Arm(path, report)
        except (ValueError, KeyError):
            continue
        judge(tally, packages.short(path, "example-robot-data"), report["stepping"]["limits"], arm.grows)
    print(f"URDF: {len(tally.robots) - mjcf} robots in Pinocchio")
    for line in tally.wrong:
        print(line)
    total = tally.right + len([line for line in tally.wrong if "0.95" in line])
    print(f"{tally.right} of {total} limits on {len(tally.robots)} robots: stable at 0.95, not at 1.05")
    return 1 if tally.wrong or len(tally.robots) < 10 else 0


if __name__ == "__main__":
    sys.exit(main())
