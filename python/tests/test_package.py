"""The package: the same bits as the program, and what people expect of one."""

from __future__ import annotations

import json
import math
import pickle
import signal
import subprocess
import sys
import time
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import peenpose as p


def without_times(record: dict[str, Any]) -> dict[str, Any]:
    record["work"]["seconds"] = None
    record.pop("evidence", None)
    return record


@pytest.mark.parametrize("name", ["keyway", "keyway-blind", "plate", "bore-turning"])
def test_the_same_bits_as_the_program(problems: Path, program: Path, name: str) -> None:
    file = problems / f"{name}.yaml"
    run = subprocess.run(
        [program, "solve", file, "--json", "--quiet", "--accuracy", "7 %", "--seed", "3"],
        capture_output=True,
        text=True,
    )
    assert run.returncode in (0, 1), run.stderr
    found = p.solve(file, accuracy=0.07, seed=3, threads=1)
    assert without_times(found.to_dict()) == without_times(json.loads(run.stdout))
    assert found.passes == (run.returncode == 0)


def test_a_result_has_what_the_sheet_says(problems: Path) -> None:
    result = p.solve(problems / "keyway.yaml")
    best = result.best
    assert result.status == "converged" and result.passes and best.feasible
    assert best.settings.contact in ("dry", "damp", "oiled")
    assert best.objective is not None
    terms = best.objective
    parts = terms.normal_impulse + terms.tangential_impulse + terms.rebound + terms.miss
    assert math.isclose(terms.total, parts, rel_tol=1e-12)
    assert np.linalg.norm(best.pose.direction) == pytest.approx(1)
    assert [row[2] for row in best.pose.matrix[:3]] == pytest.approx(best.pose.direction)
    assert set(result.verdicts["subject"]) >= {"normal_impulse", "hub.bore", "clearance"}
    assert result.verdicts["passes"].all()
    assert result.choices.rows == 3 == len(result.answers)
    assert (result.windows["low"] <= result.windows["high"]).all()
    assert "hub.bore" in result.surfaces["surface"]
    hits = result.hits
    assert hits.rows > 10_000 and hits["angle_deg"].dtype == np.float32
    assert hits["normal_impulse_N_s"].mean() == pytest.approx(39.8e-6, rel=0.01)
    assert result.stroke is None
    assert "SET THIS" in result.sheet and "SET THIS" in repr(result)
    bundle = result._repr_mimebundle_()
    assert bundle["text/plain"] == result.sheet and "<iframe" in bundle["text/html"]


def test_results_are_kept(problems: Path, tmp_path: Path) -> None:
    result = p.solve(problems / "plate.yaml")
    names = result.save(tmp_path)
    assert {"result.json", "sheet.txt", "report.html", "pose.csv"} <= set(names)
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(names)
    assert (tmp_path / "sheet.txt").read_text() == result.sheet
    for again in (p.Result.load(tmp_path), pickle.loads(pickle.dumps(result))):
        assert again.to_json() == result.to_json()
    with pytest.raises(ValueError):
        p.Result.from_json("{}")


def test_a_given_setting_is_evaluated(problems: Path, program: Path) -> None:
    file = problems / "keyway.yaml"
    settings = {"incidence": 67.0, "azimuth": 0, "standoff": "8 mm", "speed": 9.4, "contact": "oiled"}
    found = p.evaluate(file, settings, shots=4096, evidence=False)
    run = subprocess.run(
        [program, "evaluate", file, "--json", "--quiet", "--shots", "4096", "--set", "incidence=67deg"]
        + ["--set", "azimuth=0deg", "--set", "standoff=8mm", "--set", "speed=9.4m/s", "--set", "contact=oiled"],
        capture_output=True,
        text=True,
    )
    assert without_times(found.to_dict()) == without_times(json.loads(run.stdout))
    again = p.evaluate(file, found.best.settings, shots=4096)
    assert again.best.objective == found.best.objective
    for wrong, word in [
        ({}, "open"),
        ({**settings, "sped": 3.0}, "there is no setting `sped`"),
        ({**settings, "contct": "dry"}, "did you mean `contact`"),
        ({**settings, "contact": "wet"}, "there is no contact `wet`"),
        ({**settings, "speed": "9.4 mm"}, "speed"),
    ]:
        with pytest.raises(ValueError, match=word):
            p.evaluate(file, wrong)


def test_friction_that_was_chosen_is_kept(problems: Path) -> None:
    held = p.Problem.load(problems / "plate.yaml")
    left_open = held.with_("contacts", {"mu_030": {"mu_s": [0.05, 0.2], "mu_d_ratio": 0.9, "restitution": 0.25}})
    found = p.solve(left_open, accuracy=0.1, evidence=False).best.settings
    assert 0.05 <= found.mu_s <= 0.2
    again = p.evaluate(left_open, found, evidence=False).best.settings
    assert again == found
    # A problem that holds the friction has its own, and is asked for no other.
    assert p.evaluate(held, found, evidence=False).best.settings.mu_s == 0.3
    with pytest.raises(ValueError, match="fixed in the file"):
        p.evaluate(held, found.to_dict())
    with pytest.raises(ValueError, match="mu_s open"):
        p.evaluate(left_open, {})


def test_the_package_is_a_program_too(program: Path) -> None:
    for arguments, status in [(["--version"], 0), (["check", "none.yaml"], 2)]:
        run = subprocess.run([sys.executable, "-m", "peenpose", *arguments], capture_output=True, text=True)
        direct = subprocess.run([program, *arguments], capture_output=True, text=True)
        assert (run.returncode, run.stdout, run.stderr) == (status, direct.stdout, direct.stderr)


def test_faults_have_places(problems: Path) -> None:
    sound = p.Problem.load(problems / "keyway.yaml")
    assert sound.check() == [] and "Keyway floor" in sound.title
    assert "hub.floor" in sound.surfaces and sound.contacts == ["dry", "damp", "oiled"]
    wrong = sound.with_("shot.radius", "3").with_("contacts.dry.restitutoin", 0.3)
    faults = wrong.check()
    assert [fault.key for fault in faults] == ["shot.radius", "contacts.dry.restitutoin"]
    assert faults[0].proposal == "3 mm" and faults[1].proposal == "restitution"
    line = wrong.to_yaml().splitlines()[(faults[0].line or 0) - 1]
    assert line[(faults[0].column or 0) - 1 :].startswith("3")
    with pytest.raises(p.ProblemError) as caught:
        p.solve(wrong)
    assert caught.value.faults == faults and "shot.radius" in str(caught.value)
    again = pickle.loads(pickle.dumps(caught.value))
    assert again.faults == faults
    assert p.Problem.parse("format: 1").check()
    with pytest.raises(FileNotFoundError):
        p.solve("none.yaml")
    with pytest.raises(ValueError, match="no group"):
        sound.with_("title.x", 1)


def test_problems_are_built_in_python(problems: Path) -> None:
    sound = p.Problem.load(problems / "plate.yaml")
    changed = sound.with_("settings.speed", "12 m/s").with_("shot.radius", "0.4 mm")
    assert changed.to_yaml().count("#") == sound.to_yaml().count("#")
    again = pickle.loads(pickle.dumps(changed))
    assert again == changed and hash(again) == hash(changed) and changed != sound
    plate = p.Problem.from_dict(
        {
            "format": 1,
            "lengths_in": "mm",
            "scene": {"plate": {"box": {"min": [-50, -50, -10], "max": [50, 50, 0]}}},
            "target": {"surface": "plate.z_max", "aim": [0, 0, 0], "along": [1, 0, 0]},
            "shot": {"radius": "0.4 mm", "density": "7000 kg/m3"},
            "jet": {"exit_diameter": "0 mm", "divergence": "0 deg"},
            "contacts": {"dry": {"mu_s": 0.3, "mu_d": 0.27, "restitution": 0.25}},
            "settings": {"incidence": "60 deg", "azimuth": "0 deg", "standoff": "10 mm", "speed": "12 m/s"},
            "goals": {"normal_impulse": {"target": "30 uN.s"}},
        }
    )
    assert plate.check() == []
    value = p.solve(plate).best.objective
    # N* = (1 + e) m v sin 60.
    mass = 7000 * 4 / 3 * math.pi * 0.4e-3**3
    impulse = 1.25 * mass * 12 * math.sin(math.radians(60))
    assert value is not None and value.normal_impulse == pytest.approx((impulse / 30e-6 - 1) ** 2)


def test_ctrl_c_gives_the_best_so_far(problems: Path) -> None:
    code = (
        "import peenpose as p, sys\n"
        "said = []\n"
        "def tell(*news):\n"
        "    if not said: print('searching', flush=True)\n"
        "    said.append(news)\n"
        f"r = p.solve({str(problems / 'deflector.yaml')!r}, accuracy='0.1 %', progress=tell)\n"
        "print(r.status, len(said) > 0, r.best.settings.speed > 0)\n"
    )
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as run:
        assert run.stdout is not None and run.stdout.readline() == "searching\n"
        time.sleep(0.2)
        run.send_signal(signal.SIGINT)
        assert run.stdout.read() == "interrupted True True\n"


def test_what_a_callback_raises_is_raised(problems: Path) -> None:
    def tell(*news: object) -> None:
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        p.solve(problems / "deflector.yaml", progress=tell)


def test_the_interpreter_is_free_meanwhile(problems: Path) -> None:
    import threading

    ticks = []
    done = threading.Event()

    def tick() -> None:
        while not done.wait(0.001):
            ticks.append(1)

    thread = threading.Thread(target=tick)
    thread.start()
    p.solve(problems / "keyway-blind.yaml")
    done.set()
    thread.join()
    assert len(ticks) > 20


def test_impacts_over_arrays_are_those_of_the_paper() -> None:
    angles = np.array([[90.0, 60.0], [30.0, 10.0]])
    found = p.impact(10.0, angles, mu_s=0.3, restitution=[0.25, 0.5])
    assert found.rows == 4 and found["sticks"].dtype == bool
    mass = 7000 * 4 / 3 * math.pi * 0.5e-3**3
    normal = mass * 10 * np.sin(np.radians(angles)) * (1 + np.array([0.25, 0.5]))
    assert found["normal_impulse"] == pytest.approx(normal.ravel())
    # Sticking takes 2/7 of the tangential momentum, sliding mu_d N*.
    sliding = 0.27 * normal.ravel()
    sticking = 2 / 7 * mass * 10 * np.cos(np.radians(angles)).ravel()
    assert found["tangential_impulse"] == pytest.approx(np.where(found["sticks"], sticking, sliding))
    with pytest.raises(ValueError, match="row 1"):
        p.impact([10, -1], 60, 0.3)
    with pytest.raises(ValueError, match="there is no law"):
        p.impact(10, 60, 0.3, law="none")


def test_the_objective_is_that_of_the_model(problems: Path) -> None:
    problem = p.Problem.load(problems / "keyway.yaml")
    objective = p.Objective(problem, "oiled", shots=4096)
    assert objective.names == ["incidence", "azimuth", "standoff", "speed"]
    assert objective.bounds[0] == pytest.approx((30, 85))
    best = p.solve(problem)
    answer = next(it for it in best.answers if it.settings.contact == "oiled")
    row = [getattr(answer.settings, name) for name in objective.names]
    assert answer.objective is not None
    value = objective(row)
    assert value.shape == (1,) and value[0] == pytest.approx(answer.objective.total, rel=0.02)
    # The same in any order and number, by one thread or many.
    rows = np.random.default_rng(1).uniform(*np.array(objective.bounds).T, (64, 4))
    many = objective(rows)
    assert (objective(rows[::-1])[::-1] == many).all()
    assert (many >= value[0]).all()
    deep = np.array([[30.0, 90.0, 0.02, 9.0]])
    assert objective(deep)[0] > 1e6
    assert (pickle.loads(pickle.dumps(objective))(rows) == many).all()
    assert p.evaluate(problem, objective.settings(row), shots=1024).best.settings.contact == "oiled"
    with pytest.raises(ValueError, match="expected 4: incidence"):
        objective([[1.0]])
    with pytest.raises(ValueError, match="NaN"):
        objective([[1.0, 1.0, 1.0, float("nan")]])


def test_maps_and_tables(problems: Path) -> None:
    file = problems / "keyway.yaml"
    best = p.solve(file).best
    found = p.map(file, "incidence", "standoff", settings=best.settings, steps=9, shots=256)
    assert found.values.shape == (9, 9) == found.passes.shape
    assert found.x[[0, -1]] == pytest.approx([30, 85])
    near = int(np.abs(found.x - best.settings.incidence).argmin())
    assert found.values[0, near] == np.nanmin(found.values[0])
    rebound = p.map(
        file, "incidence", "azimuth", "rebound", settings={"standoff": 0.008, "speed": 9.4, "contact": "dry"},
        x_range=(60, 85), y_range=(-5, 5), steps=5, shots=256,
    )
    assert rebound.values[2, -1] > rebound.values[2, 1]
    xarray = pytest.importorskip("xarray")
    assert isinstance(found.to_xarray(), xarray.Dataset)
    with pytest.raises(ValueError, match="there is no term"):
        p.map(file, "incidence", "azimuth", "j", settings=best.settings, steps=2, shots=1)


def test_tables_go_where_people_work(problems: Path) -> None:
    pandas, polars = pytest.importorskip("pandas"), pytest.importorskip("polars")
    result = p.solve(problems / "keyway.yaml")
    hits = result.hits.to_pandas()
    assert isinstance(hits, pandas.DataFrame) and len(hits) == result.hits.rows
    assert np.shares_memory(hits["x_m"].to_numpy(), result.hits["x_m"])
    verdicts = polars.DataFrame(result.verdicts)
    assert verdicts.columns == list(result.verdicts) and verdicts["passes"].all()
    assert verdicts.filter(polars.col("subject") == "miss")["allowed"].to_list() == [0.01]
    assert "<table>" in result.verdicts._repr_html_()


def test_the_library_and_the_schema(problems: Path) -> None:
    assert any(it["name"] == "S110" for it in p.media()["shot"])
    assert p.schema() == json.loads((problems / "peenpose.schema.json").read_text())
    assert version("peenpose") == p.__version__
