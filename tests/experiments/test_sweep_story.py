from pathlib import Path

from PIL import Image

from experiments.glance import HEIGHT, WIDEST, write_glance
from experiments.sweep_story import TABLE, numbers, sweep_story
from experiments.sweep_table import read_jobs, tabulate
from tests.experiments.test_sweep_table import make_sweep
from treefit.tracking.kept_run import write_run


def test_story_tells_how_far_the_sweep_is_and_leads_to_its_runs(tmp_path: Path) -> None:
    for name in ("x.png", "y<i>.png"):
        Image.new("RGB", (30, 40), "blue").save(tmp_path / name)
    make_sweep(tmp_path, [str(tmp_path / "x.png"), str(tmp_path / "y<i>.png")])
    write_run(tmp_path / "2_job", "store", "e", "0123")
    jobs = read_jobs(tmp_path)
    story = sweep_story(tmp_path, jobs, tabulate(jobs))
    assert '<b>best <a href="run:0123">0.700</a></b>, 3 done, 1 failed' in story.description
    told = '<td>y&lt;i&gt;.png&nbsp;</td><td><a href="run:0123">0.700</a></td><td>failed</td>'
    assert told in story.description
    assert "\n\n" not in story.description
    rows = story.tables[TABLE]
    assert [row["a: score"] for row in rows] == ["0.500", "0.700"]
    assert rows[1]["b: score"] == "failed boom <script>"
    assert rows[0]["a"] == tmp_path / "0_job" / "candidates" / "1" / "picture.png"
    assert (tmp_path / "sweep_glance.png").is_file()
    assert numbers(jobs) == {"runs": 4, "failed": 1, "score": 0.7, "best_score": 0.7}


def test_story_of_a_sweep_without_runs(tmp_path: Path) -> None:
    assert "no runs yet" in sweep_story(tmp_path, [], tabulate([])).description
    assert numbers([]) == {"runs": 0, "failed": 0}


def test_row_of_pictures_is_low_and_as_wide_as_there_is_room(tmp_path: Path) -> None:
    write_glance(tmp_path / "g.png", [(f"a long caption {i}", Image.new("RGB", (300, 600))) for i in range(40)])
    with Image.open(tmp_path / "g.png") as row:
        assert WIDEST - 60 < row.width <= WIDEST + 8
        assert HEIGHT < row.height < 100
