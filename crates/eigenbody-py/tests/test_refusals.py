"""What does not fit is refused in words, and nothing crashes or leaks."""

from __future__ import annotations

import gc
import resource

import numpy as np
import pytest

from eigenbody import InputError, Layout, Model, ModelError, NotPositiveDefiniteError, Parts, Tracker

ROBOT = Model("puma560")
Q = np.zeros(6)


def placed(rotation, **options):
    parts = Parts("p")
    ends = {"parent": parts.link("a"), "child": parts.link("b")}
    return parts.joint("j", "revolute", **ends, rotation=rotation, **options)


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (lambda: ROBOT.mass_matrix(np.zeros(5)), InputError, r"q has shape \(5,\), expected \(6,\) or \(k, 6\)"),
        (lambda: ROBOT.mass_matrix(np.zeros((2, 3, 6))), InputError, r"shape \(2, 3, 6\)"),
        (lambda: ROBOT.mass_matrix(0.0), InputError, r"shape \(\)"),
        (lambda: ROBOT.mass_matrix(np.zeros(6, complex)), TypeError, "complex128, expected real numbers"),
        (lambda: ROBOT.mass_matrix(["a"] * 6), TypeError, "expected real numbers"),
        (lambda: ROBOT.mass_matrix(None), TypeError, "expected real numbers"),
        (lambda: ROBOT.mass_matrix([[0.0] * 6, [0.0] * 5]), TypeError, "no array of numbers"),
        (lambda: ROBOT.mass_matrix([0, 0, np.nan, 0, 0, 0]), InputError, r"q\[2\] is not a finite number"),
        (lambda: ROBOT.mass_matrix([Q, Q, Q + np.inf]), InputError, r"row 2: q\[0\]"),
        (lambda: ROBOT.rnea(np.zeros((2, 6)), np.zeros((3, 6)), Q), InputError, "v has 3 rows and q 2"),
        (lambda: ROBOT.mass_matrix(Q, out=np.zeros((6, 5))), InputError, r"out has shape \(6, 5\), expected \(6, 6\)"),
        (lambda: ROBOT.mass_matrix(Q, out=np.zeros((6, 6), np.float32)), TypeError, "array of float32, expected an array of float64"),
        (lambda: ROBOT.mass_matrix(Q, out=[0.0]), TypeError, "expected an array of float64"),
        (lambda: ROBOT.conditioning("elbow=1"), ModelError, "elbow"),
        (lambda: ROBOT.conditioning(Q, metric="length=-1"), ModelError, "positive"),
        (lambda: ROBOT.conditioning(Q, method="magic"), InputError, "method: 'magic'"),
        (lambda: ROBOT.kappa(np.zeros(5)), InputError, r"q has shape \(5,\)"),
        (lambda: ROBOT.kappa(np.zeros((3, 6)), accuracy=-1.0), InputError, "accuracy: -1"),
        (lambda: ROBOT.kappa(np.zeros((3, 6)), accuracy=np.nan), InputError, "accuracy"),
        (lambda: ROBOT.kappa(np.zeros((3, 6)), out=np.zeros(4)), InputError, r"out has shape \(4,\), expected \(3,\)"),
        (lambda: ROBOT.kappa([Q, Q + np.nan]), InputError, r"row 1: q\[0\]"),
        (lambda: ROBOT.extremes([Q, Q, Q + np.inf]), InputError, r"row 2: q\[0\]"),
        (lambda: ROBOT.extremes(Q, metric="furlong"), ModelError, "furlong"),
        (lambda: ROBOT.spectrum(np.zeros((2, 7))), InputError, "q has shape"),
        (lambda: ROBOT.check(samples=0), InputError, "samples"),
        (lambda: ROBOT.check(max_kappa=-1.0), InputError, "max_kappa"),
        (lambda: ROBOT.with_armature(np.ones(5)), InputError, "armature has shape"),
        (lambda: ROBOT.with_armature(-np.ones(6)), InputError, "armature"),
        (lambda: ROBOT.with_gravity([0, 0, np.nan]), InputError, "gravity"),
        (lambda: Tracker(ROBOT, np.zeros(7)), InputError, "q has shape"),
        (lambda: Model("hydra(3,1"), ModelError, "hydra"),
        (lambda: Model("nowhere.urdf"), ModelError, "no such file"),
        (lambda: Model(7), TypeError, "no path"),
        (lambda: Model("puma560", base="flying"), InputError, "base: 'flying'"),
        (lambda: Model("puma560", reduced=True), InputError, "floating base"),
        (lambda: Model.hydra(200_000_000), ModelError, "hydra"),
        (lambda: Model.hydra(30_000).mass_matrix(np.zeros(30_000)), InputError, "too large"),
        (lambda: Model.from_pinocchio(3), TypeError, "not a pinocchio.Model"),
        (lambda: Model.from_mujoco(3), TypeError, "not a mujoco.MjModel"),
        (lambda: Layout(ROBOT, "mujoco", ["a"]), InputError, "unknown"),
        (lambda: Layout(ROBOT, "bullet"), InputError, "engine"),
        (lambda: Model(Parts("empty")), ModelError, "no link"),
        (lambda: Parts("p").link("l", mass=1.0, inertia=[[1, 0.5, 0], [0, 1, 0], [0, 0, 1]]), InputError, "'l' is not symmetric"),
        (lambda: placed([[2, 0, 0], [0, 1, 0], [0, 0, 1]]), InputError, "rotation: .*joint 'j'.*orthonormal"),
        (lambda: placed([[-1, 0, 0], [0, 1, 0], [0, 0, 1]]), InputError, "right-handed"),
        (lambda: placed(np.full((3, 3), np.nan)), InputError, "rotation"),
        (lambda: placed(np.eye(3), damping=[1.0, 2.0]), InputError, "damping: has 2 numbers, expected 1"),
        (lambda: placed(np.eye(3), stiffness=np.inf), InputError, r"stiffness\[0\]"),
    ],
)
def test_refusals(call, error, words):
    with pytest.raises(error, match=words):
        call()


def test_model_errors_know_the_place(tmp_path):
    path = tmp_path / "robot.urdf"
    path.write_text('<robot name="r">\n<link name="a"/>\n<link name="b"/>\n<joint name="j" type="hinge"/>\n</robot>\n')
    with pytest.raises(ModelError) as caught:
        Model(path)
    assert (caught.value.file, caught.value.line, caught.value.joint) == (str(path), 4, "j")


def test_input_errors_know_the_row():
    with pytest.raises(InputError) as caught:
        ROBOT.mass_matrix([Q, Q + np.nan])
    assert (caught.value.what, caught.value.index, caught.value.row) == ("q", 0, 1)


def test_read_only_and_shared_arrays_are_refused():
    out = np.zeros((6, 6))
    out.flags.writeable = False
    with pytest.raises(InputError, match="read-only"):
        ROBOT.mass_matrix(Q, out=out)
    tau = np.zeros(6)
    with pytest.raises(InputError, match="read-only, or one of the inputs"):
        ROBOT.rnea(Q, Q + 1, tau, out=tau)
    q = np.zeros(6)
    q.flags.writeable = False
    assert ROBOT.mass_matrix(q).shape == (6, 6)


def test_singular_matrices_say_so():
    parts = Parts("massless")
    base, tip = parts.link("base"), parts.link("tip")
    parts.joint("j", "revolute", parent=base, child=tip)
    with pytest.raises(NotPositiveDefiniteError) as caught:
        Model(parts).aba([0.0], [0.0], [1.0])
    assert caught.value.dof == 0


def test_empty_batches_give_empty_results():
    none = np.zeros((0, 6))
    assert ROBOT.mass_matrix(none).shape == (0, 6, 6)
    assert ROBOT.aba(none, none, none).shape == (0, 6)
    assert ROBOT.spectrum(none).shape == (0, 6)
    assert ROBOT.extremes(none).shape == (0, 2)
    assert ROBOT.kappa(none).shape == (0,)
    assert ROBOT.rnea(none, none, none).shape == (0, 6)
    assert ROBOT.bias_force(none, none).shape == (0, 6)
    assert ROBOT.gravity_force(none).shape == (0, 6)
    assert len(ROBOT.conditioning(none)) == 0
    assert Tracker(ROBOT, Q).update(none).shape == (0, 2)


def test_a_million_calls_leak_nothing():
    q, v, out = np.zeros(6), np.ones(6), np.empty((6, 6))

    def turn(count):
        for _ in range(count):
            ROBOT.mass_matrix(q)
            ROBOT.rnea(q, v, v)
            ROBOT.aba(q, v, v)
            ROBOT.mass_matrix(q, out=out)
            try:
                ROBOT.mass_matrix(v[:5])
            except InputError:
                pass

    def peak():
        gc.collect()
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    turn(20_000)
    before = peak()
    turn(200_000)
    # 10⁶ calls; a leaked reference of 100 bytes a call would be 100 MB.
    assert peak() - before < 10_000


def test_results_of_more_than_arrays_leak_nothing():
    def turn(count):
        for _ in range(count):
            ROBOT.conditioning(Q)
            ROBOT.simulate(0.01, rate=100.0, monitors=["kappa"])
            ROBOT.extremes([Q, Q])
            ROBOT.kappa(Q)

    def peak():
        gc.collect()
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    turn(300)
    before = peak()
    turn(3000)
    # Ten times as often: a leaked model or table of a kilobyte a call would be 12 MB.
    assert peak() - before < 4_000


def test_a_robot_that_cannot_move_has_empty_batches():
    """A batch gives what one row gives."""
    parts = Parts("stone")
    parts.joint("glue", "fixed", parent=parts.link("ground"), child=parts.link("stone", mass=1.0, inertia=np.eye(3)))
    stone, none = Model(parts), np.zeros((3, 0))
    assert np.array_equal(stone.kappa(none), [stone.kappa(none[0])] * 3, equal_nan=True)
    assert np.array_equal(stone.extremes(none), [stone.extremes(none[0])] * 3, equal_nan=True)
    assert stone.mass_matrix(none).shape == (3, 0, 0)
    assert stone.random(1, 3).shape == (3, 0)
    assert len(stone.conditioning(none, all=True)) == 3
