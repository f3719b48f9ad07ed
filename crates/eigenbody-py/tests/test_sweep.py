"""Sweeps give the same table whoever computes them, and lose nothing when somebody dies."""

from __future__ import annotations

import os
import signal
import subprocess
import threading
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import pytest

import eigenbody
from eigenbody import SweepPlan

parquet = pytest.importorskip("pyarrow.parquet")

SPEC = """
seed = 7
quantities = ["kappa", "kappa_weighted", "lambda_min", "eigenvalues"]

[[robots]]
family = "hydra"
n = { from = 4, to = 12, count = 5 }
branching = [1.0, 2.0]
skew = 0.3
at = ["zag(0)", "curl(0.1)"]
random = 700

[[robots]]
family = "onion"
sample = 30
n = { from = 3, to = 30, scale = "log" }
taper = { from = 0.8, to = 1.0 }
base = ["fixed", "floating"]

[[robots]]
model = ["puma560", "chain(4, m=2.2, l=1)"]
at = "zero"
random = 500
"""
CASES = 10 * 702 + 60 + 2 * 501


@pytest.fixture(scope="module")
def serial(tmp_path_factory):
    """The table by this process alone."""
    return eigenbody.sweep(SPEC, tmp_path_factory.mktemp("serial") / "out").read_bytes()


def spawned(workers: int) -> ProcessPoolExecutor:
    return ProcessPoolExecutor(workers, mp_context=get_context("spawn"))


def test_the_plan_counts():
    plan = SweepPlan(SPEC)
    assert plan.cases == CASES
    assert plan.chunks >= 1
    assert SweepPlan(SPEC).fingerprint == plan.fingerprint
    assert SweepPlan(SPEC.replace("seed = 7", "seed = 8")).fingerprint != plan.fingerprint


def test_rows_are_what_the_library_computes(serial, tmp_path):
    path = tmp_path / "sweep.parquet"
    path.write_bytes(serial)
    table = parquet.read_table(path)
    rows = table.to_pylist()
    assert [row["case"] for row in rows] == list(range(CASES))
    for row in rows[::97]:
        robot = eigenbody.Model(row["model"], base=row["base"])
        found = robot.conditioning(row["at"], all=True)
        assert (row["kappa"], row["kappa_weighted"], row["lambda_min"]) == (found.kappa, found.kappa_weighted, found.lambda_min)
        assert row["eigenvalues"] == found.eigenvalues.tolist()
    metadata = {key.decode(): value.decode() for key, value in parquet.read_metadata(path).metadata.items() if not key.startswith(b"ARROW")}
    assert metadata["unit:lambda_min"] == "kg m^2"
    assert metadata["eigenbody:seed"] == "7"
    assert metadata["eigenbody:version"] == eigenbody.__version__
    assert len(metadata["eigenbody:models"].splitlines()) == 2


def test_processes_give_the_same_bytes(serial, tmp_path):
    seen = []
    with spawned(2) as pool:
        table = eigenbody.sweep(SPEC, tmp_path / "out", pool, progress=lambda done, of: seen.append((done, of)))
    assert table.read_bytes() == serial
    assert seen[-1][0] == seen[-1][1] == SweepPlan(SPEC).chunks


def test_the_command_gives_the_same_bytes(serial, tmp_path):
    spec = tmp_path / "spec.toml"
    spec.write_text(SPEC)
    run = [command_path(), "sweep", str(spec), "-o", str(tmp_path / "out")]
    for shard in ["2/3", "1/3", "3/3"]:
        subprocess.run([*run, "--shard", shard], check=True, capture_output=True)
    subprocess.run([*run, "--merge"], check=True, capture_output=True)
    assert (tmp_path / "out" / "sweep.parquet").read_bytes() == serial


def command_path() -> str:
    root = Path(__file__).resolve().parents[3]
    return os.environ.get("EIGENBODY", str(root / "target" / "release" / "eigenbody"))


def test_a_killed_command_is_taken_up(serial, tmp_path):
    spec = tmp_path / "spec.toml"
    spec.write_text(SPEC)
    run = [command_path(), "sweep", str(spec), "-o", str(tmp_path / "out")]
    for moment in range(10):
        process = subprocess.Popen(run, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(0.013 * (moment + 1))
        process.kill()
        process.wait()
    subprocess.run(run, check=True, capture_output=True)
    assert (tmp_path / "out" / "sweep.parquet").read_bytes() == serial


def test_dask_outlives_a_worker(serial, tmp_path):
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            pids = list(client.run(os.getpid).values())
            killer = threading.Timer(0.15, os.kill, (pids[0], signal.SIGKILL))
            killer.start()
            table = eigenbody.sweep(SPEC, tmp_path / "out", client.get_executor(retries=3))
            killer.join()
    assert table.read_bytes() == serial


def test_mpi_gives_the_same_bytes(serial, tmp_path):
    pytest.importorskip("mpi4py")
    spec = tmp_path / "spec.toml"
    spec.write_text(SPEC)
    script = tmp_path / "run.py"
    script.write_text(
        "import sys, eigenbody\n"
        "from mpi4py.futures import MPIPoolExecutor\n"
        "if __name__ == '__main__':\n"
        "    with MPIPoolExecutor() as pool:\n"
        "        eigenbody.sweep(sys.argv[1], sys.argv[2], pool)\n"
    )
    import shutil
    import sys

    mpiexec = shutil.which("mpiexec")
    if mpiexec is None:
        pytest.skip("no mpiexec")
    call = [mpiexec, "-n", "3", "--oversubscribe", sys.executable, "-m", "mpi4py.futures", str(script), str(spec), str(tmp_path / "out")]
    allowed = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    subprocess.run(call, check=True, capture_output=True, env=allowed, timeout=300)
    assert (tmp_path / "out" / "sweep.parquet").read_bytes() == serial


def test_a_full_disk_keeps_what_is_there(serial, tmp_path):
    """A limit on file sizes stands in for a full disk: writing fails in the middle."""
    spec = tmp_path / "spec.toml"
    spec.write_text(SPEC)
    run = f"{command_path()} sweep {spec} -o {tmp_path / 'out'}"
    full = subprocess.run(["bash", "-c", f"trap '' XFSZ; ulimit -f 40; {run}"], capture_output=True, text=True, check=False)
    assert full.returncode == 2
    assert "too large" in full.stderr.lower()
    assert not (tmp_path / "out" / "sweep.parquet").exists()
    subprocess.run(run.split(), check=True, capture_output=True)
    assert (tmp_path / "out" / "sweep.parquet").read_bytes() == serial


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("seed = 1\nrobots = 3\n", "2:10"),
        ("[[robots]]\nfamily = 'hydra'\n", "1:1: a family needs n"),
        ("[[robots]]\nfamily = 'hidra'\nn = 3\n", "2:10: family 'hidra'"),
        ("[[robots]]\nmodel = 'puma560'\nn = 3\n", "3:5: n is for a family"),
        ("[[robots]]\nfamily = 'hydra'\nn = { from = 1, to = 3 }\n", "3:5: n: a grid needs a count"),
        ("[[robots]]\nfamily = 'hydra'\nn = 'many'\n", "a number, a list of numbers"),
        ("quantities = ['kapa']\n[[robots]]\nmodel = 'puma560'\n", "1:15: unknown variant `kapa`"),
        ("metric = 'length=-1'\n[[robots]]\nmodel = 'puma560'\n", "1:10"),
        ("[[robots]]\nmodel = 'nowhere.urdf'\n", "case 0: nowhere.urdf: no such file"),
        ("[[robots]]\nmodel = 'puma560'\nat = ['zero']\nbase = 'flying'\n", "4:8: base 'flying'"),
        ("[[robots]]\nmodel = 'puma560'\ncolour = 1\n", "unknown field `colour`"),
    ],
)
def test_refusals(text, words):
    with pytest.raises(eigenbody.InputError) as caught:
        SweepPlan(text)
    assert words in str(caught.value)


def test_paths_are_seen_from_the_spec(tmp_path, monkeypatch):
    """The same table from any folder, by any engine: paths in it are as they are written."""
    text = "[[robots]]\nmodel = ['robots/arm.urdf', 'puma560']\nrandom = 5\n"
    tables = []
    for name in ["here", "there"]:
        folder = tmp_path / name
        (folder / "robots").mkdir(parents=True)
        (folder / "robots" / "arm.urdf").write_text(eigenbody.Model.hydra(3).to_urdf())
        spec = folder / "spec.toml"
        spec.write_text(text)
        tables.append(eigenbody.sweep(spec, tmp_path / f"{name}-out").read_bytes())
        subprocess.run([command_path(), "sweep", str(spec), "-o", str(tmp_path / f"{name}-command")], check=True, capture_output=True)
        tables.append((tmp_path / f"{name}-command" / "sweep.parquet").read_bytes())
    with spawned(1) as pool:
        tables.append(eigenbody.sweep(tmp_path / "here" / "spec.toml", tmp_path / "pool-out", pool).read_bytes())
    monkeypatch.chdir(tmp_path / "there")
    tables.append(eigenbody.sweep(text, tmp_path / "text-out").read_bytes())
    assert all(table == tables[0] for table in tables)
    rows = parquet.read_table(tmp_path / "here-out" / "sweep.parquet").to_pylist()
    assert rows[0]["model"] == "robots/arm.urdf"
    monkeypatch.chdir(tmp_path)
    with pytest.raises(eigenbody.InputError, match="robots/arm.urdf"):
        SweepPlan(text)
    # A built-in name goes before a file of that name, as everywhere.
    (tmp_path / "puma560").write_text("no robot")
    assert SweepPlan("[[robots]]\nmodel = 'puma560'\n", tmp_path).cases == 1


def test_another_sweep_is_not_overwritten(tmp_path):
    first = "[[robots]]\nmodel = 'puma560'\n"
    eigenbody.sweep(first, tmp_path / "out")
    with pytest.raises(eigenbody.InputError, match="another sweep"):
        eigenbody.sweep("seed = 2\n" + first, tmp_path / "out")
    (tmp_path / "precious").mkdir()
    (tmp_path / "precious" / "data").write_text("keep me")
    with pytest.raises(eigenbody.InputError, match="not empty"):
        eigenbody.sweep(first, tmp_path / "precious")


def test_a_changed_robot_is_another_sweep(tmp_path):
    """The same text in the same process, after a robot's file has changed."""
    path = tmp_path / "arm.urdf"
    spec = "[[robots]]\nmodel = 'arm.urdf'\nrandom = 5\n"
    (tmp_path / "spec.toml").write_text(spec)
    tables = []
    for k, taper in enumerate([1.0, 0.5]):
        path.write_text(eigenbody.Model.hydra(3, 1.0, 0.0, taper).to_urdf())
        tables.append(eigenbody.sweep(tmp_path / "spec.toml", tmp_path / f"out{k}").read_bytes())
    assert tables[0] != tables[1]
    with pytest.raises(eigenbody.InputError, match="another sweep"):
        eigenbody.sweep(tmp_path / "spec.toml", tmp_path / "out0")
    with spawned(1) as pool:
        for k, taper in enumerate([0.9, 0.8]):
            path.write_text(eigenbody.Model.hydra(3, 1.0, 0.0, taper).to_urdf())
            here = eigenbody.sweep(tmp_path / "spec.toml", tmp_path / f"here{k}").read_bytes()
            assert eigenbody.sweep(tmp_path / "spec.toml", tmp_path / f"pool{k}", pool).read_bytes() == here
