"""The same sweep on every engine, killed and resumed: sweep.py COMMAND FOLDER, for `cargo xtask sweep`.

One line a figure: name, tab, number. Ends with an error if any table differs from the serial one or misses or doubles a case.
"""

from __future__ import annotations

import hashlib
import os
import random
import shutil
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import pyarrow.parquet

import eigenbody

SPEC = """
seed = 7
quantities = ["kappa", "kappa_weighted", "lambda_min", "lambda_max", "eigenvalues"]

[[robots]]
family = "hydra"
n = { from = 4, to = 16, count = 10 }
branching = [1.0, 1.5]
skew = 0.3
at = ["zag(0)", "curl(0.1)"]
random = 7998

[[robots]]
family = "onion"
sample = 7
n = { from = 4, to = 16, scale = "log" }
taper = { from = 0.8, to = 1.0 }
random = 4000

[[robots]]
model = ["puma560", "chain(4, m=2.2, l=1)", "arm.urdf"]
random = 4000
"""
CASES = 20 * 8000 + 7 * 4000 + 3 * 4000


def figure(name: str, number: float) -> None:
    print(f"{name}\t{number:.9g}", flush=True)


def say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


def seconds_of(pid: int) -> float:
    """Processor time of a process."""
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def of_children() -> float:
    times = os.times()
    return times.children_user + times.children_system


class Sweep:
    def __init__(self, command: str, folder: Path) -> None:
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        self.command, self.folder = command, folder
        self.spec = folder / "spec.toml"
        self.spec.write_text(SPEC)
        # A path in a spec is seen from the spec.
        (folder / "arm.urdf").write_text(eigenbody.Model.hydra(6, 1.0, 0.4).to_urdf())
        self.serial = ""
        self.chunks = eigenbody.SweepPlan(SPEC, folder).chunks

    def take(self, name: str, table: Path, start: float) -> None:
        """Compares a table with the serial one and counts its cases."""
        figure(f"{name} wall", time.perf_counter() - start)
        digest = hashlib.sha256(table.read_bytes()).hexdigest()
        if not self.serial:
            self.serial = digest
            figure("bytes", table.stat().st_size)
        cases = pyarrow.parquet.read_table(table, columns=["case"])["case"].to_pylist()
        if cases != list(range(CASES)):
            sys.exit(f"{name}: {len(cases)} cases, {len(set(cases))} of them different, expected {CASES}")
        if digest != self.serial:
            sys.exit(f"{name}: {table} is not the serial table")
        say(f"{name}: {time.perf_counter() - start:.1f} s, {digest[:16]}")

    def there(self, folder: Path) -> int:
        return len(list((folder / "chunks").glob("*.csv"))) if (folder / "chunks").exists() else 0

    def serially(self) -> None:
        start, cpu = time.perf_counter(), time.process_time()
        plan = eigenbody.SweepPlan(SPEC, self.folder)
        table = eigenbody.sweep(self.spec, self.folder / "serial")
        figure("serial cpu", time.process_time() - cpu)
        self.take("serial", table, start)
        cpu = time.process_time()
        plan.merge(self.folder / "serial")
        eigenbody.SweepPlan(SPEC, self.folder)
        figure("alone", time.process_time() - cpu)

    def processes(self, workers: int) -> None:
        name = f"{workers} process" + "es" * (workers > 1)
        with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool:
            # Started before the clock is: an interpreter takes as long on any machine.
            list(pool.map(time.sleep, [0.5] * workers))
            before = {pid: seconds_of(pid) for pid in pool._processes}
            start = time.perf_counter()
            table = eigenbody.sweep(self.spec, self.folder / f"processes{workers}", pool)
            spent = [seconds_of(pid) - before[pid] for pid in before]
            self.take(name, table, start)
        figure(f"{name} cpu", sum(spent))
        figure(f"{name} busier", max(spent) / sum(spent))

    def by_command(self, threads: int) -> None:
        name = f"command, {threads} thread" + "s" * (threads > 1)
        output, start, cpu = self.folder / f"command{threads}", time.perf_counter(), of_children()
        environment = {**os.environ, "RAYON_NUM_THREADS": str(threads)}
        subprocess.run([self.command, "sweep", str(self.spec), "-o", str(output)], check=True, capture_output=True, env=environment)
        figure(f"{name} cpu", of_children() - cpu)
        self.take(name, output / "sweep.parquet", start)

    def dask(self) -> None:
        import distributed

        output = self.folder / "dask"
        with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
            with distributed.Client(cluster) as client:
                victim = next(iter(client.run(os.getpid).values()))

                def kill() -> None:
                    while self.there(output) < self.chunks // 3:
                        time.sleep(0.01)
                    figure("dask chunks at kill", self.there(output))
                    os.kill(victim, signal.SIGKILL)

                killer = threading.Thread(target=kill)
                start = time.perf_counter()
                killer.start()
                table = eigenbody.sweep(self.spec, output, client.get_executor(retries=3))
                killer.join()
                self.take("Dask, 2 workers, one killed", table, start)

    def mpi(self) -> None:
        script = self.folder / "mpi.py"
        script.write_text(
            "import sys, eigenbody\n"
            "from mpi4py.futures import MPIPoolExecutor\n"
            "if __name__ == '__main__':\n"
            "    with MPIPoolExecutor() as pool:\n"
            "        eigenbody.sweep(sys.argv[1], sys.argv[2], pool)\n"
        )
        mpiexec = shutil.which("mpiexec")
        if mpiexec is None:
            say("MPI: mpiexec is not installed")
            return
        output, start = self.folder / "mpi", time.perf_counter()
        call = [mpiexec, "-n", "3", "--oversubscribe", sys.executable, "-m", "mpi4py.futures", str(script), str(self.spec), str(output)]
        allowed = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        subprocess.run(call, check=True, capture_output=True, env=allowed)
        self.take("MPI, 2 workers", output / "sweep.parquet", start)

    def killed(self, spent: float) -> None:
        """At ten random moments of a run, which goes on each time with what is there."""
        output, start, rng = self.folder / "killed", time.perf_counter(), random.Random(5)
        run = [self.command, "sweep", str(self.spec), "-o", str(output)]
        there = []
        for _ in range(10):
            process = subprocess.Popen(run, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(rng.uniform(0.0, spent / 6))
            process.kill()
            process.wait()
            there.append(self.there(output))
            if (output / "sweep.parquet").exists():
                sys.exit("killed: the run was over before it was killed ten times")
        say(f"killed with {there} of {self.chunks} chunks")
        figure("kill first", there[0])
        figure("kill last", there[-1])
        subprocess.run(run, check=True, capture_output=True)
        self.take("command, killed 10 times", output / "sweep.parquet", start)

    def full(self) -> None:
        """On a disk of 8 MB if one may be mounted, which is then made larger; else under a limit on the size of files."""
        output, start = self.folder / "full", time.perf_counter()
        output.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=8m", "tmpfs", str(output)], capture_output=True, check=False).returncode == 0
        try:
            run = [self.command, "sweep", str(self.spec), "-o", str(output / "out")]
            limited = run if mounted else ["bash", "-c", f"trap '' XFSZ; ulimit -f 200; exec {' '.join(run)}"]
            done = subprocess.run(limited, capture_output=True, text=True, check=False)
            say(f"disk {'of 8 MB' if mounted else 'with a limit'}: {done.stderr.strip()}")
            if done.returncode != 2 or (output / "out" / "sweep.parquet").exists():
                sys.exit(f"full: exit {done.returncode}, expected 2 and no table")
            figure("full chunks", self.there(output / "out"))
            if mounted:
                subprocess.run(["mount", "-o", "remount,size=2g", str(output)], check=True)
            subprocess.run(run, check=True, capture_output=True)
            self.take("command, disk full, then resumed", output / "out" / "sweep.parquet", start)
        finally:
            if mounted:
                subprocess.run(["umount", str(output)], check=False)


def main() -> None:
    sweep = Sweep(sys.argv[1], Path(sys.argv[2]))
    figure("cases", CASES)
    figure("chunks", sweep.chunks)
    sweep.serially()
    sweep.processes(1)
    sweep.processes(2)
    sweep.by_command(1)
    start = time.perf_counter()
    sweep.by_command(2)
    spent = time.perf_counter() - start
    sweep.dask()
    sweep.mpi()
    sweep.killed(spent)
    sweep.full()
    shutil.rmtree(sweep.folder)


if __name__ == "__main__":
    main()
