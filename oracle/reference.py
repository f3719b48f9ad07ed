"""Pinocchio's joint-space inertia matrix, in eigenbody's order of coordinates.

eigenbody: q holds x, y, z, w, x, y, z of a floating base, then one number a joint in the order of `dofs`; the base's
velocity is [angular; linear] in its own frame.
Pinocchio: q holds x, y, z, x, y, z, w of a floating base, and cosine and sine of a continuous joint; the base's velocity
is [linear; angular] in its own frame.
"""

from pathlib import Path

import numpy as np
import pinocchio

BASE = "floating_base"
BASE_COORDINATES = [0, 1, 2, 6, 3, 4, 5]  # where x, y, z, w, x, y, z stand in Pinocchio's q
BASE_DOFS = {"wx": 3, "wy": 4, "wz": 5, "vx": 0, "vy": 1, "vz": 2}


class Reference:
    """A robot file as Pinocchio reads it, with moving mimic joints."""

    def __init__(self, path: Path, base: str):
        root = [pinocchio.JointModelFreeFlyer(), BASE] if base == "floating" else []
        self.model = pinocchio.buildModelFromUrdf(str(path), *root)
        self.data = self.model.createData()

    def mass_matrix(self, dofs: list[str], q: list[float]) -> np.ndarray:
        """H at eigenbody's q, rows and columns in the order of `dofs`."""
        order = self._order(dofs)
        H = pinocchio.crba(self.model, self.data, self._configuration(dofs, q))
        H = np.triu(H) + np.triu(H, 1).T  # Pinocchio writes the upper triangle only
        return H[np.ix_(order, order)]

    def _order(self, dofs: list[str]) -> list[int]:
        """Where each of `dofs` stands in Pinocchio's velocity."""
        order = []
        for name in dofs:
            joint, _, axis = name.rpartition("/")
            if joint == BASE:
                order.append(self._joint(BASE).idx_v + BASE_DOFS[axis])
            else:
                order.append(self._joint(name).idx_v)
        if sorted(order) != list(range(self.model.nv)):
            raise ValueError(f"{len(dofs)} degrees of freedom do not match Pinocchio's {self.model.nv}")
        return order

    def _configuration(self, dofs: list[str], q: list[float]) -> np.ndarray:
        """Pinocchio's q for eigenbody's."""
        reference = np.zeros(self.model.nq)
        joints = [name for name in dofs if not name.startswith(f"{BASE}/")]
        first = len(BASE_COORDINATES) if len(joints) < len(dofs) else 0
        if len(q) != first + len(joints):
            raise ValueError(f"q holds {len(q)} numbers instead of {first + len(joints)}")
        if first:
            reference[BASE_COORDINATES] = q[:first]
        for name, angle in zip(joints, q[first:], strict=True):
            joint = self._joint(name)
            is_continuous = joint.nq == 2
            value = [np.cos(angle), np.sin(angle)] if is_continuous else angle
            reference[joint.idx_q : joint.idx_q + joint.nq] = value
        return reference

    def _joint(self, name: str) -> pinocchio.JointModel:
        if not self.model.existJointName(name):
            raise ValueError(f"Pinocchio knows no joint {name}")
        return self.model.joints[self.model.getJointId(name)]


def condition_number(H: np.ndarray) -> float:
    """λmax/λmin."""
    eigenvalues = np.linalg.eigvalsh(H)
    return eigenvalues[-1] / eigenvalues[0]
