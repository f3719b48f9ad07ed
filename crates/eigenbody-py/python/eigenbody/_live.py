"""Models that live in other libraries, by their attributes alone: neither library is imported."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from eigenbody._eigenbody import Model, Parts
from eigenbody._errors import ModelError

Matrix = NDArray[np.float64]

HINGE, SLIDE, BALL, FREE = 3, 2, 1, 0  # mjtJoint
AXES = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}


def rebuild(constructor: str, text: str, options: dict[str, Any]) -> Model:
    """A model from what made it: for pickle."""
    make = Model if constructor == "Model" else getattr(Model, constructor)
    return make(text, **options)


def pinocchio_parts(model: Any) -> Parts:
    """The tree of a `pinocchio.Model`: its joints in their order, bodies merged as Pinocchio has merged them."""
    try:
        joints, names, gravity = list(model.joints), list(model.names), np.array(model.gravity.linear, dtype=float)
    except AttributeError as error:
        raise TypeError(f"not a pinocchio.Model: {error}") from None
    parts = Parts(str(model.name), gravity=gravity.tolist())
    links = [parts.link("universe")]
    armature = np.array(model.armature, dtype=float)
    for i in range(1, len(joints)):
        joint, name = joints[i], names[i]
        kind, axis = _pinocchio_kind(joint, name)
        inertia, placement = model.inertias[i], model.jointPlacements[i]
        links.append(
            parts.link(
                f"{name}/body", mass=float(inertia.mass), com=inertia.lever.tolist(), inertia=np.array(inertia.inertia).tolist()
            )
        )
        own = armature[joint.idx_v : joint.idx_v + joint.nv]
        if kind == "floating":
            own = np.roll(own, 3)
        limits = None
        if joint.nq == 1:
            limits = _limits(model.lowerPositionLimit[joint.idx_q], model.upperPositionLimit[joint.idx_q])
        parts.joint(
            name,
            kind,
            parent=links[model.parents[i]],
            child=links[i],
            rotation=np.array(placement.rotation).tolist(),
            position=np.array(placement.translation).tolist(),
            axis=list(axis),
            armature=own.tolist(),
            limits=limits,
        )
    return parts


def _limits(lower: Any, upper: Any) -> tuple[float, float] | None:
    """The largest number stands for no limit."""
    most = float(np.finfo(np.float64).max)
    ends = -np.inf if lower <= -most else float(lower), np.inf if upper >= most else float(upper)
    return None if ends == (-np.inf, np.inf) else ends


def _pinocchio_kind(joint: Any, name: str) -> tuple[str, tuple[float, ...]]:
    short = str(joint.shortname())
    plain = short.removeprefix("JointModel")
    simple = {"FreeFlyer": "floating", "Spherical": "spherical"}
    if plain in simple:
        return simple[plain], AXES["Z"]
    for head, kind in [("RUB", "continuous"), ("R", "revolute"), ("P", "prismatic")]:
        if plain.removeprefix(head) in AXES and plain.startswith(head):
            return kind, AXES[plain.removeprefix(head)]
    unaligned = {"RevoluteUnaligned": "revolute", "RevoluteUnboundedUnaligned": "continuous", "PrismaticUnaligned": "prismatic"}
    if plain in unaligned:
        axis = np.array(joint.extract().axis if hasattr(joint, "extract") else joint.axis, dtype=float)
        return unaligned[plain], tuple(axis.tolist())
    raise ModelError(f"joint '{name}' is a {short}, which has no counterpart", joint=name)


def mujoco_parts(model: Any) -> Parts:
    """The tree of a `mujoco.MjModel`: bodies, joints with armature, stiffness and damping.

    Equalities and tendons do not count, as in its own H. What else is left out is noted.
    """
    try:
        gravity = np.array(model.opt.gravity, dtype=float)
        name = bytes(model.names).split(b"\0", 1)[0].decode() or "mujoco"
        bodies = int(model.nbody)
    except (AttributeError, TypeError) as error:
        raise TypeError(f"not a mujoco.MjModel: {error}") from None
    parts = Parts(name, gravity=gravity.tolist())
    links = [parts.link("world")]
    # Where each body's frame stands in the frame of its last joint: joints are centred where they turn.
    offset = [np.zeros(3)]
    for body in range(1, bodies):
        own = f"body{body}:{_mujoco_name(model, model.name_bodyadr[body])}"
        parent = int(model.body_parentid[body])
        R = _rotation(model.body_quat[body])
        p = np.array(model.body_pos[body], dtype=float) + offset[parent]
        link, at = links[parent], np.zeros(3)
        first, count = int(model.body_jntadr[body]), int(model.body_jntnum[body])
        inertia = _rotation(model.body_iquat[body])
        inertia = inertia @ np.diag(model.body_inertia[body]) @ inertia.T
        last = np.array(model.jnt_pos[first + count - 1], dtype=float) if count else np.zeros(3)
        if count and model.jnt_type[first] == FREE:
            last = np.zeros(3)
        weight: dict[str, Any] = {
            "mass": float(model.body_mass[body]),
            "com": (np.array(model.body_ipos[body], dtype=float) - last).tolist(),
            "inertia": inertia.tolist(),
        }
        for k in range(first, first + count):
            child = parts.link(own, **weight) if k == first + count - 1 else parts.link(f"{own}/{k}")
            link, R, p, at = _mujoco_joint(model, parts, k, (link, child), R, p, at), np.eye(3), np.zeros(3), _place(model, k)
        if not count:
            child = parts.link(own, **weight)
            parts.joint(f"{own}/fixed", "fixed", parent=link, child=child, rotation=R.tolist(), position=p.tolist())
            link = child
        links.append(link)
        offset.append(-last)
    for note in _mujoco_notes(model):
        parts.note(note)
    return parts


def _mujoco_notes(model: Any) -> list[str]:
    """What of a model is not taken over, though it moves by it."""

    def some(name: str) -> bool:
        return bool(np.any(getattr(model, name, 0.0)))

    notes = []
    if getattr(model, "nu", 0):
        notes.append("actuators are left out: give their feedback as kp and kd")
    if some("tendon_stiffness") or some("tendon_damping") or some("tendon_armature"):
        notes.append("stiffness, damping and armature of tendons are left out")
    if some("jnt_stiffnesspoly") or some("dof_dampingpoly"):
        notes.append("of springs and dampers that are polynomials the linear part counts")
    slack = [i for i in range(int(model.njnt)) if model.jnt_type[i] in (HINGE, SLIDE) and _stiffness(model, i) != 0]
    if any(model.qpos_spring[model.jnt_qposadr[i]] != 0 for i in slack):
        notes.append("springs are slack at qpos_spring there, at zero here: give it as rest")
    free = [int(model.jnt_dofadr[i]) for i in range(int(model.njnt)) if model.jnt_type[i] == FREE]
    if any(np.any(model.dof_damping[dof : dof + 6]) for dof in free):
        notes.append("damping of free joints is left out")
    if getattr(model, "nkey", 0):
        notes.append("keyframes are left out")
    step = float(model.opt.timestep)
    return [*notes, f"the time step of {step:g} s and its integrator are left out: give step and integrator"]


def _stiffness(model: Any, joint: int) -> float:
    return float(np.ravel(model.jnt_stiffness[joint])[0])


def _place(model: Any, joint: int) -> Matrix:
    return np.zeros(3) if model.jnt_type[joint] == FREE else np.array(model.jnt_pos[joint], dtype=float)


def _mujoco_joint(
    model: Any, parts: Parts, joint: int, ends: tuple[int, int], R: Matrix, p: Matrix, before: Matrix
) -> int:
    """Adds one joint of a body whose frame stands at (R, p), measured from the joint before it; returns the child."""
    kind = int(model.jnt_type[joint])
    name = _mujoco_name(model, model.name_jntadr[joint]) or f"joint{joint}"
    dof, q = int(model.jnt_dofadr[joint]), int(model.jnt_qposadr[joint])
    axis = np.array(model.jnt_axis[joint], dtype=float)
    reference = float(model.qpos0[q])
    position = p + R @ (_place(model, joint) - before)
    width = {HINGE: 1, SLIDE: 1, BALL: 3, FREE: 6}[kind]
    armature = np.array(model.dof_armature[dof : dof + width], dtype=float)
    limits = None
    if kind == HINGE:
        R = R @ _turn(axis, -reference)
    elif kind == SLIDE:
        position = position - R @ axis * reference
    elif kind == FREE:
        # Its coordinates are the world's: the body's placement is only where it starts.
        R, position, armature = np.eye(3), np.zeros(3), np.roll(armature, 3)
    if kind in (HINGE, SLIDE) and model.jnt_limited[joint]:
        limits = float(model.jnt_range[joint][0]), float(model.jnt_range[joint][1])
    # A floating base has no springs of its own.
    is_free = kind == FREE
    parts.joint(
        name,
        {HINGE: "revolute", SLIDE: "prismatic", BALL: "spherical", FREE: "floating"}[kind],
        parent=ends[0],
        child=ends[1],
        rotation=R.tolist(),
        position=position.tolist(),
        axis=axis.tolist(),
        armature=armature.tolist(),
        limits=limits,
        stiffness=0.0 if is_free else _stiffness(model, joint),
        damping=[] if is_free else [float(np.ravel(c)[0]) for c in model.dof_damping[dof : dof + width]],
    )
    return ends[1]


def _mujoco_name(model: Any, address: int) -> str:
    return bytes(model.names)[int(address) :].split(b"\0", 1)[0].decode()


def _rotation(quaternion: Any) -> Matrix:
    """Of a quaternion w, x, y, z of any length but zero."""
    w, x, y, z = np.array(quaternion, dtype=float) / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def _turn(axis: Matrix, angle: float) -> Matrix:
    return _rotation([np.cos(angle / 2), *(np.sin(angle / 2) * axis / np.linalg.norm(axis))])
