import json
from pathlib import Path

from PIL import Image

from experiments.sweep_page import write_page
from experiments.sweep_picture import write_picture
from experiments.sweep_table import read_jobs, tabulate, write_job


def make_sweep(folder: Path, images: list[str]) -> None:
    for number in range(4):
        job = folder / f"{number}_job"
        (job / "candidates" / "1").mkdir(parents=True)
        generator, image = ("a", "b")[number % 2], images[number // 2]
        failed = number == 3
        write_job(
            job, number, [f"generator={generator}", f"image='{image}'", "seed=1"], image,
            "failed" if failed else "done", "boom <script>" if failed else "",
        )  # fmt: skip
        if not failed:
            Image.new("RGB", (80, 120), "green").save(job / "candidates" / "1" / "picture.png")
            best = {"score": 0.5 + number / 10, "score_other_seeds": 0.4, "hull_iou": 0.876, "values": {"whorl": 3}}
            (job / "summary.json").write_text(json.dumps({"score": best["score"], "candidates": [best]}))


def test_table_has_a_row_a_picture_and_a_column_a_choice(tmp_path: Path) -> None:
    make_sweep(tmp_path, ["x.png", "y.png"])
    table = tabulate(read_jobs(tmp_path))
    assert table.rows == ("x.png", "y.png")
    assert table.columns == ("a", "b")
    assert table.cells["y.png", "a"].score == 0.7
    assert table.cells["y.png", "b"].status == "failed"


def test_page_shows_the_measures_that_are_known(tmp_path: Path) -> None:
    make_sweep(tmp_path, ["x.png", "y.png"])
    table = tabulate(read_jobs(tmp_path))
    write_page(table, tmp_path / "sweep.html")
    page = (tmp_path / "sweep.html").read_text()
    assert table.cells["x.png", "a"].facts == {"score": 0.5, "score_other_seeds": 0.4, "hull_iou": 0.876}
    assert page.count("<small>hull IoU</small><small>0.88</small>") == 3
    assert "silhouette IoU" not in page


def test_columns_name_all_settings_that_differ(tmp_path: Path) -> None:
    for number, (generator, seed) in enumerate([("a", 1), ("a", 2), ("b", 1)]):
        (tmp_path / str(number)).mkdir()
        write_job(tmp_path / str(number), number, [f"generator={generator}", f"+seed={seed}", "k=1"], "x.png", "done")
    expected = ("generator=a seed=1", "generator=a seed=2", "generator=b seed=1")
    assert tabulate(read_jobs(tmp_path)).columns == expected


def test_page_shows_hostile_names_as_text_and_runs_nothing(tmp_path: Path) -> None:
    make_sweep(tmp_path, ["<img src=x onerror=alert(1)>.png", "</td><script>alert(2)</script>"])
    write_page(tabulate(read_jobs(tmp_path)), tmp_path / "sweep.html")
    page = (tmp_path / "sweep.html").read_text()
    assert "<script" not in page
    assert "<img src=x" not in page
    assert "boom &lt;script&gt;" in page
    assert "default-src 'none'" in page
    assert page.count("data:image/png;base64,") == 3


def test_picture_of_the_table_has_a_cell_for_every_run(tmp_path: Path) -> None:
    make_sweep(tmp_path, ["x.png", "y.png"])
    write_picture(tabulate(read_jobs(tmp_path)), tmp_path / "sweep.png")
    with Image.open(tmp_path / "sweep.png") as sheet:
        assert sheet.size == (16 + 3 * 272, 44 + 2 * 312)
        assert (0, 128, 0) in {colour for _, colour in sheet.getcolors(1 << 20)}


def test_sweep_without_runs_still_has_a_table(tmp_path: Path) -> None:
    write_page(tabulate([]), tmp_path / "sweep.html")
    write_picture(tabulate([]), tmp_path / "sweep.png")
