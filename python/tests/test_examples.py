"""The examples run, are typed, and the notebook draws its figure."""

from __future__ import annotations

import re
import runpy
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import peenpose as p

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"


def test_the_notebook_runs() -> None:
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    pytest.importorskip("matplotlib")
    notebook = nbformat.read(EXAMPLES / "keyway.ipynb", as_version=4)
    client = nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": EXAMPLES}})
    client.execute()
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    shown = [kind for output in outputs for kind in output.get("data", {})]
    assert "image/png" in shown and shown.count("text/html") >= 3
    assert not any(output.output_type == "error" for output in outputs)


def test_a_result_is_written(problems: Path, tmp_path: Path) -> None:
    main = runpy.run_path(str(EXAMPLES / "solve.py"))["main"]
    result = main(str(problems / "keyway.yaml"), str(tmp_path))
    assert p.Result.load(tmp_path).best == result.best
    assert (tmp_path / "report.html").exists()


def test_another_optimiser_comes_near(problems: Path) -> None:
    pytest.importorskip("scipy")
    main = runpy.run_path(str(EXAMPLES / "other_optimiser.py"))["main"]
    best, evaluations = main(str(problems / "keyway.yaml"))
    ours = next(it for it in p.solve(problems / "keyway.yaml").answers if it.settings.contact == "oiled")
    assert 10 < evaluations and best.feasible
    # It optimises on few shots, whose least J is not that of the jet.
    assert ours.objective.total <= best.objective.total * 1.01 < ours.objective.total * 5


def test_the_document_runs(problems: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("pandas")
    pytest.importorskip("tqdm")
    text = (problems.parent / "docs" / "python.md").read_text()
    blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert blocks
    shutil.copytree(problems, tmp_path / "problems")
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    for block in blocks:
        exec(block, names)
    assert (tmp_path / "result" / "report.html").exists()


def test_everything_is_typed() -> None:
    pytest.importorskip("mypy")
    source = EXAMPLES.parent
    files = [*sorted(EXAMPLES.glob("*.py")), *sorted((source / "peenpose").glob("*.py"))]
    run = subprocess.run(
        [sys.executable, "-m", "mypy", "--config-file", str(source / "pyproject.toml"), *map(str, files)],
        cwd=source,
        capture_output=True,
        text=True,
    )
    assert run.returncode == 0, run.stdout
