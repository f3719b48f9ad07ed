"""Pinocchio's joint-space inertia matrix of any URDF file, in eigenbody's order of coordinates.

As in `reference.py`, with mimic joints followed on request, and joints of every kind. Planar joints: eigenbody has x, y, angle,
Pinocchio x, y, cosine, sine; their velocities agree.
"""

from pathlib import Path

import numpy as np
import pinocchio

from reference import BASE

FLOATING_DOFS = [3, 4, 5, 0, 1, 2]  # where [angular; linear] stands in Pinocchio's [linear; angular]


class UrdfReference:
    """A robot file as Pinocchio reads it."""

    def __init__(self, path: Path, base: str, mimic: bool):
        root = [pinocchio.JointModelFreeFlyer(), BASE] if base == "floating" else []
        self.model = pinocchio.buildModelFromUrdf(str(path), *root, mimic=mimic)
        self.data = self.model.createData()

    def mass_matrix(self, dofs: list[str], joints: list, q: list[float]) -> np.ndarray:
        """H at eigenbody's q, rows and columns in the order of `dofs`; `joints` are (name, kind, first of q, first of v)."""
        own = {dof.rpartition("/")[0] if "/" in dof and dof not in self.model.names else dof for dof in dofs}
        joints = [joint for joint in joints if joint[0] in own]
        H = pinocchio.crba(self.model, self.data, self._configuration(joints, q))
        H = np.triu(H) + np.triu(H, 1).T  # Pinocchio writes the upper triangle only
        order = [v for joint in joints for v in self._dofs(joint)]
        if len(order) != len(dofs) or sorted(order) != list(range(self.model.nv)):
            raise ValueError(f"{len(dofs)} degrees of freedom do not match Pinocchio's {self.model.nv}")
        return H[np.ix_(order, order)]

    def _joint(self, name: str) -> pinocchio.JointModel:
        if not self.model.existJointName(name):
            raise ValueError(f"Pinocchio knows no joint {name}")
        return self.model.joints[self.model.getJointId(name)]

    def _dofs(self, joint: list) -> list[int]:
        name, kind, _, _ = joint
        first, count = self._joint(name).idx_v, self._joint(name).nv
        return [first + k for k in (FLOATING_DOFS if kind == "floating" else range(count))]

    def _configuration(self, joints: list, q: list[float]) -> np.ndarray:
        """Pinocchio's q for all of eigenbody's."""
        reference = np.zeros(self.model.nq)
        for name, kind, q0, _ in joints:
            joint = self._joint(name)
            if kind == "floating":
                x, y, z, w, i, j, k = q[q0 : q0 + 7]
                value = [x, y, z, i, j, k, w]
            elif kind == "planar":
                x, y, angle = q[q0 : q0 + 3]
                value = [x, y, np.cos(angle), np.sin(angle)]
            elif joint.nq == 2:
                value = [np.cos(q[q0]), np.sin(q[q0])]
            else:
                value = [q[q0]]
            reference[joint.idx_q : joint.idx_q + joint.nq] = value
        return reference
