"""MuJoCo's joint-space inertia matrix, in eigenbody's order of coordinates.

q is qpos, number for number. v is qvel, but for free joints: eigenbody has [angular; linear] in the body's frame, MuJoCo
[linear in the world; angular in the body's frame].
"""

from pathlib import Path

import mujoco
import numpy as np

KINDS = {"floating": "mjJNT_FREE", "spherical": "mjJNT_BALL", "prismatic": "mjJNT_SLIDE", "revolute": "mjJNT_HINGE"}

mujoco.set_mju_user_warning(lambda _: None)


class MjcfReference:
    """A file as MuJoCo compiles it."""

    def __init__(self, path: Path):
        self.model = mujoco.MjModel.from_xml_path(str(path))
        self.data = mujoco.MjData(self.model)

    def check(self, joints: list) -> None:
        """Refuses other joints than MuJoCo's, in another order, or with other names."""
        model = self.model
        if len(joints) != model.njnt:
            raise ValueError(f"{len(joints)} joints, MuJoCo has {model.njnt}")
        for k, (name, kind, q0, v0) in enumerate(joints):
            joint = model.joint(k)
            if joint.name and joint.name != name:
                raise ValueError(f"joint {k} is {name}, MuJoCo's is {joint.name}")
            if (q0, v0) != (model.jnt_qposadr[k], model.jnt_dofadr[k]):
                raise ValueError(f"joint {name} stands at {q0}, {v0}")
            if mujoco.mjtJoint(model.jnt_type[k]).name != KINDS[kind]:
                raise ValueError(f"joint {name} is {kind}")

    def mass_matrix(self, q: list[float]) -> np.ndarray:
        """H at eigenbody's q."""
        self.data.qpos[:] = q
        mujoco.mj_fwdPosition(self.model, self.data)
        H = np.zeros((self.model.nv, self.model.nv))
        mujoco.mj_fullM(self.model, self.data, H)
        T = self.velocities(q)
        return T.T @ H @ T

    def velocities(self, q: list[float]) -> np.ndarray:
        """MuJoCo's qvel from eigenbody's v."""
        T = np.eye(self.model.nv)
        for k in np.flatnonzero(self.model.jnt_type == mujoco.mjtJoint.mjJNT_FREE):
            q0, v0 = self.model.jnt_qposadr[k], self.model.jnt_dofadr[k]
            R = np.zeros(9)
            mujoco.mju_quat2Mat(R, np.array(q[q0 + 3 : q0 + 7]))
            block = np.zeros((6, 6))
            block[:3, 3:], block[3:, :3] = R.reshape(3, 3), np.eye(3)
            T[v0 : v0 + 6, v0 : v0 + 6] = block
        return T
