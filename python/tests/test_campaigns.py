"""Campaigns: the same table whoever solves the cases, also after a kill with another engine going on."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
import slurm_loopback

import peenpose as p

CASES = 24
SHARDS = 6


@pytest.fixture
def campaign(tmp_path: Path, problems: Path) -> Path:
    shutil.copy(problems / "keyway.yaml", tmp_path)
    file = tmp_path / "campaign.yaml"
    file.write_text(
        "campaign: 1\nbase: keyway.yaml\nvary:\n"
        "  contacts.dry.restitution: { from: 0.2, to: 0.4 }\n"
        "  jet.exit_diameter: { from: 1 mm, to: 2 mm }\n"
        "  settings.contact: [dry, [dry, oiled]]\n"
        "  solve.accuracy: [20 %]\n"
        f"sample: {{ sobol: {CASES}, seed: 2 }}\n"
    )
    return file


def planned(campaign: Path, name: str) -> Path:
    folder = campaign.with_name(name)
    assert p.campaigns.plan(campaign, folder) == CASES
    return folder


def one_process(program: Path, folder: Path) -> list[str]:
    return [str(program), "campaign", "run", str(folder), "--quiet"]


def parallel(program: Path, folder: Path) -> list[str]:
    tool = shutil.which("parallel")
    if tool is None:
        pytest.skip("GNU parallel is not installed")
    run = f"{program} campaign run {folder} --quiet --threads 1 --shard {{}}/{SHARDS}"
    return [tool, "--jobs", "2", run, ":::", *map(str, range(1, SHARDS + 1))]


def hyperqueue(program: Path, folder: Path) -> list[str]:
    pytest.importorskip("hyperqueue")
    script = f"""
from hyperqueue import Job
from hyperqueue.cluster import LocalCluster, WorkerConfig
with LocalCluster(worker_config=WorkerConfig(cores=2)) as cluster:
    job = Job()
    for number in range(1, {SHARDS} + 1):
        command = [{str(program)!r}, "campaign", "run", {str(folder)!r}, "--quiet", "--threads", "1"]
        job.program([*command, "--shard", f"{{number}}/{SHARDS}"], stdout=None, stderr=None)
    client = cluster.client()
    client.wait_for_jobs([client.submit(job)])
"""
    return [sys.executable, "-c", script]


def dask(program: Path, folder: Path) -> list[str]:
    pytest.importorskip("distributed")
    return [sys.executable, "-m", "peenpose.dask", str(folder), "--shards", str(SHARDS)]


def slurm(program: Path, folder: Path) -> list[str]:
    if absent := slurm_loopback.missing():
        pytest.skip(f"not installed: {', '.join(absent)}")
    run = f"{program} campaign run {folder} --quiet --threads 1 --shard $SLURM_ARRAY_TASK_ID/{SHARDS}"
    output = f"--output={folder.with_name('slurm-%a.log')}"
    submission = ["sbatch", "--wait", f"--array=1-{SHARDS}", output, "--wrap", run]
    return [sys.executable, slurm_loopback.__file__, *submission]


ENGINES = [one_process, parallel, hyperqueue, dask, slurm]


def finish(command: list[str]) -> None:
    run = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert run.returncode == 0, f"{command}: {run.stdout} {run.stderr}"


@pytest.mark.parametrize("engine", ENGINES)
def test_every_engine_gives_the_same_table(
    campaign: Path, program: Path, engine: Callable[[Path, Path], list[str]]
) -> None:
    reference = planned(campaign, "reference")
    outcome = p.campaigns.run(reference)
    assert (outcome.solved, outcome.faulty, outcome.left) == (CASES, 0, 0)
    table = p.campaigns.gather_csv(reference)
    folder = planned(campaign, "study")
    finish(engine(program, folder))
    assert p.campaigns.status(folder) == p.campaigns.Status(CASES, 0, 0)
    assert p.campaigns.gather_csv(folder) == table
    finish([str(program), "campaign", "gather", str(folder)])
    assert (folder / "table.csv").read_text() == table


def test_another_engine_goes_on_after_a_kill(campaign: Path, program: Path) -> None:
    reference = planned(campaign, "reference")
    p.campaigns.run(reference)
    folder = planned(campaign, "study")
    killed = 0
    for wait in (0.15, 0.3, 0.45):
        with subprocess.Popen(one_process(program, folder), stdout=subprocess.DEVNULL) as run:
            time.sleep(wait)
            run.send_signal(signal.SIGKILL)
        killed += p.campaigns.status(folder).missing > 0
    assert killed > 0
    finish([sys.executable, "-c", f"import peenpose as p; p.campaigns.run({str(folder)!r})"])
    assert p.campaigns.gather_csv(folder) == p.campaigns.gather_csv(reference)


def test_a_campaign_from_python(tmp_path: Path, problems: Path) -> None:
    file = tmp_path / "campaign.yaml"
    base = os.path.relpath(problems / "plate.yaml", tmp_path)
    file.write_text(
        f"campaign: 1\nbase: {base}\nvary: {{ settings.speed: [8 m/s, 10 m/s], shot.radius: [0.5 mm, -1 mm] }}\n"
    )
    told: list[tuple[str, str]] = []
    table = p.campaign(file, tmp_path / "study", progress=lambda *news: told.append(news))
    assert sorted(status for _, status in told) == ["done", "done", "faulty", "faulty"]
    assert table["status"].tolist() == [1, 2, 0, 2]
    assert table["settings.speed"].tolist() == ["8 m/s", "8 m/s", "10 m/s", "10 m/s"]
    assert table["objective"][2] < 1e-9 < table["objective"][0]
    assert p.campaigns.run(tmp_path / "study") == p.campaigns.Outcome(0, 0, 4, 0)
    with pytest.raises(OSError, match="peenpose campaign plan"):
        p.campaigns.status(tmp_path)
    with pytest.raises(ValueError, match="no shard"):
        p.campaigns.run(tmp_path / "study", "0/2")
    file.write_text("campaign: 1\nbase: none.yaml\n")
    with pytest.raises(p.ProblemError) as caught:
        p.campaigns.plan(file, tmp_path / "other")
    assert caught.value.faults[0].key == "vary"
