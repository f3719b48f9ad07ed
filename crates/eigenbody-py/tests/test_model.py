"""Models, their arrays, and the command line's numbers to the last bit."""

from __future__ import annotations

import ast
import copy
import inspect
import pickle
from pathlib import Path

import numpy as np
import pytest

import eigenbody
from eigenbody import Model

ROBOTS = ["puma560", "hydra(10,1,0,1)", "hydra(12,2,0.5,0.9)", "auto_tree(9,1.5,0.3,0.9)", "onion(40,1,0,1)"]


@pytest.mark.parametrize("text", ROBOTS)
def test_the_command_line_prints_the_same_bits(text, command):
    robot = Model(text)
    q = robot.random(3)
    matrix = command("matrix", text, "--at", "random(3)", "--json")
    assert np.array_equal(robot.mass_matrix(q), np.array(matrix["rows"]))
    printed = command("spectrum", text, "--at", "random(3)", "--json", "--all")
    found = robot.conditioning("random(3)", all=True)
    assert found.to_dict() == printed
    assert np.array_equal(robot.spectrum(q), np.array(printed["eigenvalues"]))
    assert robot.extremes(q).tolist() == [printed["lambda_min"], printed["lambda_max"]]


def test_check_prints_the_same(command):
    printed = command("check", "hydra(10,1,0,1)", "--samples", "256", "--format", "json")
    found = Model("hydra(10,1,0,1)").check(samples=256)
    assert found.to_dict() == printed
    assert found.worst("kappa")["worst"] == pytest.approx(42907.97274937, rel=1e-9)


def test_worst_case_of_a_chain_is_stretched_out():
    worst = Model.hydra(10).worst_case(samples=256)
    assert worst["kappa"].worst == pytest.approx(42907.97274937, rel=1e-9)
    again = Model.hydra(10).conditioning(worst["kappa"].q)
    assert again.kappa == pytest.approx(worst["kappa"].worst, rel=1e-12)


@pytest.mark.parametrize("text", ROBOTS)
def test_a_batch_is_its_rows(text):
    robot = Model(text)
    n = robot.nv
    rng = np.random.default_rng(1)
    q, v, x = robot.random(1, 100), rng.standard_normal((100, n)), rng.standard_normal((100, n))
    single = [
        (robot.mass_matrix(q), [robot.mass_matrix(row) for row in q]),
        (robot.rnea(q, v, x), [robot.rnea(*rows) for rows in zip(q, v, x)]),
        (robot.aba(q, v, x), [robot.aba(*rows) for rows in zip(q, v, x)]),
        (robot.bias_force(q, v), [robot.bias_force(*rows) for rows in zip(q, v)]),
        (robot.gravity_force(q), [robot.gravity_force(row) for row in q]),
        (robot.spectrum(q), [robot.spectrum(row) for row in q]),
        (robot.extremes(q), [robot.extremes(row) for row in q]),
    ]
    for batch, rows in single:
        rows = np.stack(rows)
        # Lanes and single numbers are added in another order.
        assert np.allclose(batch, rows, rtol=0, atol=1e-12 * np.abs(rows).max())
    both = robot.conditioning(q)
    assert both.kappa.tolist() == [robot.conditioning(row).kappa for row in q]
    assert len(both) == 100


def test_a_single_row_stands_in_for_every_row():
    robot = Model("puma560")
    q, v = robot.random(1, 5), np.ones(6)
    assert np.array_equal(robot.bias_force(q, v), robot.bias_force(q, np.ones((5, 6))))


def test_dynamics_are_inverse_to_each_other():
    robot = Model.auto_tree(20, 1.5, 0.3, 0.9)
    rng = np.random.default_rng(2)
    q, v, a = robot.random(5), rng.standard_normal(robot.nv), rng.standard_normal(robot.nv)
    tau = robot.inverse_dynamics(q, v, a)
    assert np.allclose(robot.mass_matrix(q) @ a + robot.bias_force(q, v), tau, rtol=0, atol=1e-12 * abs(tau).max())
    assert np.allclose(robot.forward_dynamics(q, v, tau), a, rtol=0, atol=1e-9)


@pytest.mark.parametrize("text", ROBOTS)
@pytest.mark.parametrize("metric", ["euclidean", "unit-diagonal"])
def test_kappa_side_by_side(text, metric):
    """In lanes to the accuracy that is asked for; with accuracy 0 each row as if it were alone."""
    robot = Model(text)
    q = robot.random(1, 60)
    alone = np.array([robot.kappa(row, metric=metric) for row in q])
    assert all(isinstance(robot.kappa(row), float) for row in q[:2])
    assert np.array_equal(robot.kappa(q, metric=metric, accuracy=0), alone)
    assert np.array_equal(alone, [robot.conditioning(row, metric=metric).kappa for row in q])
    ends = robot.extremes(q, metric=metric)
    assert np.array_equal(robot.kappa(q, metric=metric), ends[:, 1] / ends[:, 0])
    for accuracy in [1e-6, 1e-8, 1e-12]:
        found = robot.kappa(q, metric=metric, accuracy=accuracy)
        assert np.allclose(found, alone, rtol=2 * accuracy, atol=0)
    out = np.empty(60)
    assert robot.kappa(q, metric=metric, out=out) is out
    strided = np.zeros((60, 2))[:, ::2][:, 0]
    robot.kappa(q, metric=metric, out=strided)
    assert np.array_equal(strided, out)


def test_kappa_of_a_singular_robot_does_not_exist():
    parts = eigenbody.Parts("massless")
    base, tip = parts.link("base"), parts.link("tip")
    parts.joint("j", "revolute", parent=base, child=tip)
    robot = Model(parts)
    assert np.isnan(robot.kappa([0.0]))
    assert np.isnan(robot.kappa([[0.0], [1.0]])).all()
    assert np.isnan(robot.extremes([[0.0], [1.0]])[:, 0]).all()


def test_single_precision_stays_single():
    robot = Model("puma560")
    q = robot.random(1, 7).astype(np.float32)
    H = robot.mass_matrix(q)
    assert H.dtype == np.float32
    assert np.allclose(H, robot.mass_matrix(q.astype(np.float64)), rtol=0, atol=1e-5)
    assert robot.rnea(q, np.zeros((7, 6), np.float32), np.zeros((7, 6))).dtype == np.float64


def test_results_go_where_they_are_wanted():
    robot = Model("puma560")
    q = robot.random(1, 4)
    out = np.empty((4, 6, 6))
    assert robot.mass_matrix(q, out=out) is out
    strided = np.zeros((4, 6, 12))[:, :, ::2]
    robot.mass_matrix(q, out=strided)
    assert np.array_equal(out, strided)
    assert np.array_equal(robot.mass_matrix(np.asfortranarray(q)), out)
    assert np.array_equal(robot.mass_matrix(np.repeat(q, 2, axis=1)[:, ::2]), out)
    assert np.array_equal(robot.mass_matrix(q.tolist()), out)


def test_models_have_properties():
    robot = Model.hydra(4, base="floating")
    assert (robot.nq, robot.nv, robot.nbodies, robot.has_floating_base) == (10, 9, 4, True)
    assert len(robot.dof_names) == 3  # free-floating: H*
    assert robot.mass_matrix(robot.neutral()).shape == (3, 3)
    assert robot.rnea(robot.neutral(), np.zeros(9), np.zeros(9)).shape == (9,)
    assert "free-floating" in repr(robot)
    assert Model("puma560").gravity.tolist() == [0, 0, -9.81]
    heavy = Model.chain(2, mass=3.0).with_armature([1.0, 0.5])
    assert heavy.armature.tolist() == [1.0, 0.5]
    assert (heavy.mass_matrix([0, 0]) - Model.chain(2, mass=3.0).mass_matrix([0, 0])).diagonal() == pytest.approx([1, 0.5])
    weightless = heavy.with_gravity([0, 0, 0])
    assert np.array_equal(weightless.gravity_force([0.1, 0.2]), [0, 0])


def test_models_survive_pickling():
    robot = Model("hydra(5,1,0,1)")
    again = pickle.loads(pickle.dumps(robot))
    assert np.array_equal(again.mass_matrix(np.ones(5)), robot.mass_matrix(np.ones(5)))
    assert copy.copy(robot).nq == 5
    with pytest.raises(TypeError, match="pickled"):
        pickle.dumps(robot.with_armature(np.ones(5)))


@pytest.mark.parametrize(
    "make",
    [
        Model.puma560,
        lambda: Model.hydra(3, 2, 0.25, 0.9, base="floating"),
        lambda: Model.onion(4),
        lambda: Model.auto_tree(5, 1.5, 0.3, 0.9),
        lambda: Model.chain(2, mass=3.0, length=0.1),
    ],
)
def test_named_models_survive_pickling(make):
    robot = make()
    again = pickle.loads(pickle.dumps(robot))
    assert repr(again) == repr(robot)
    assert np.array_equal(again.mass_matrix(again.random(1)), robot.mass_matrix(robot.random(1)))


def test_files_survive_pickling(tmp_path):
    """With the constructor that reads them, whatever they are called."""
    texts = {"from_urdf": (Model.hydra(3).to_urdf(), "floating"), "from_mjcf": (Model.hydra(3).to_mjcf(), "fixed")}
    for constructor, (text, base) in texts.items():
        path = tmp_path / f"{constructor}.txt"
        path.write_text(text)
        robot = getattr(Model, constructor)(path, base=base)
        assert repr(pickle.loads(pickle.dumps(robot))) == repr(robot)


def test_what_cannot_change_is_its_own_copy():
    robot = Model("puma560")
    heavy = robot.with_armature(np.ones(6))
    found = robot.check(samples=16)
    for thing in [robot, heavy, found]:
        assert copy.copy(thing) is thing and copy.deepcopy(thing) is thing
    assert copy.copy(found).to_text() == found.to_text()
    layout = copy.deepcopy(eigenbody.Layout(heavy, "mujoco"))
    assert np.array_equal(layout.q_to(np.ones(6)), np.ones(6))


def test_results_compare_without_error():
    robot = Model("puma560")
    q = robot.random(1, 3)
    makers = [
        lambda: robot.conditioning(),
        lambda: robot.conditioning(q),
        lambda: robot.conditioning().softest,
        lambda: robot.check(samples=16),
        lambda: robot.worst_case(samples=16)["kappa"],
        lambda: robot.simulate(0.05),
        lambda: eigenbody.Layout(robot, "mujoco"),
    ]
    for make in makers:
        one, other = make(), make()
        assert one == one and one != other and len({one, other}) == 2
        assert [other, one].index(one) == 1


def test_all_of_a_batch():
    """Eigenvalues and both error estimates, row by row those of one configuration."""
    robot = Model.hydra(6)
    q = robot.random(1, 7)
    both, alone = robot.conditioning(q, all=True), [robot.conditioning(row, all=True) for row in q]
    assert np.array_equal(both.eigenvalues, [one.eigenvalues for one in alone])
    assert np.array_equal(both.error_estimate, [one.error_estimate for one in alone])
    assert both.to_dict()["eigenvalues"] is both.eigenvalues
    few = robot.conditioning(q)
    assert few.eigenvalues is None and "eigenvalues" not in few.to_dict()


def test_random_rows_are_those_of_their_seeds():
    robot = Model.hydra(5, base="floating")
    assert np.array_equal(robot.random(3, 40), [robot.random(3 + k) for k in range(40)])


def test_gains_by_any_mapping():
    from types import MappingProxyType

    robot = Model("puma560")
    name = robot.joints[0][0]
    motions = [robot.simulate(0.1, q="random(1)", damping=gains, monitors=[]).q for gains in ({name: 2}, MappingProxyType({name: 2}))]
    assert np.array_equal(*motions)


def test_everything_says_what_it_is():
    """Docstrings at run time are those of the stub."""
    stub = Path(eigenbody.__file__).with_name("_eigenbody.pyi").read_text(encoding="utf-8")
    told = 0
    for node in ast.parse(stub).body:
        if not isinstance(node, ast.ClassDef | ast.FunctionDef):
            continue
        thing = getattr(eigenbody._eigenbody, node.name)
        assert inspect.getdoc(thing) == ast.get_docstring(node), node.name
        for member in node.body:
            if isinstance(member, ast.FunctionDef) and (text := ast.get_docstring(member)):
                assert inspect.getdoc(getattr(thing, member.name)) == text, f"{node.name}.{member.name}"
                told += 1
    assert told > 60
    for name in eigenbody.__all__:
        thing = getattr(eigenbody, name)
        for part, value in [("", thing), *(vars(thing).items() if inspect.isclass(thing) else [])]:
            if not part.startswith("_") and (callable(value) or isinstance(value, property | staticmethod)):
                assert inspect.getdoc(value), f"{name}.{part}"


def test_converted_models_have_the_same_matrix(tmp_path):
    for robot, suffix in [(Model.hydra(6, 2, 0.3), "urdf"), (Model("puma560"), "xml")]:
        text = robot.to_urdf() if suffix == "urdf" else robot.to_mjcf()
        path = tmp_path / f"robot.{suffix}"
        path.write_text(text)
        again = Model(path)
        q = robot.random(1)
        assert np.allclose(again.mass_matrix(q), robot.mass_matrix(q), rtol=0, atol=1e-12)
    with pytest.raises(eigenbody.InputError, match="armature"):
        Model("puma560").to_urdf()


def test_a_tracker_follows():
    robot = Model.hydra(20)
    motion = np.linspace(0, 1, 200)[:, None] * np.linspace(0.5, 1, 20)
    tracker = eigenbody.Tracker(robot, motion[0])
    tracked = tracker.update(motion)
    assert np.allclose(tracked, robot.extremes(motion, accuracy=0), rtol=1e-12, atol=0)
    assert tracker.update(motion[-1]).shape == (2,)
    x = tracker.softest
    assert x @ robot.mass_matrix(motion[-1]) @ x == pytest.approx(tracked[-1, 0], rel=1e-9)


def test_reproduce_gives_claims():
    claims = eigenbody.reproduce("S-eq7", quick=True)
    assert "S-eq7" in [claim["id"] for claim in claims]
    assert all("verdict" in claim for claim in claims)
