import json
from pathlib import Path

from PIL import Image

from treefit.tracking.table import SIDE, write_table


def test_table_has_thumbnails_on_white_and_empty_cells_for_what_is_no_picture(tmp_path: Path) -> None:
    Image.new("RGBA", (400, 100), (0, 0, 0, 0)).save(tmp_path / "clear.png")
    (tmp_path / "broken.png").write_text("no picture")
    rows = [{"name": "a", "picture": tmp_path / "clear.png"}, {"name": "b", "picture": tmp_path / "broken.png"}]
    files = write_table(tmp_path, "trees", rows)
    assert [file.relative_to(tmp_path).as_posix() for file in files] == ["table_images/trees/1_1.webp", "trees.json"]
    told = json.loads((tmp_path / "trees.json").read_text())
    place = "table_images/trees/1_1.webp"
    assert told["columns"] == ["name", "picture"]
    assert told["data"] == [["a", {"type": "image", "filepath": place, "compressed_filepath": place}], ["b", ""]]
    with Image.open(files[0]) as thumbnail:
        assert thumbnail.size == (SIDE, SIDE // 4)
        assert min(low for low, _ in thumbnail.convert("RGB").getextrema()) > 250


def test_table_without_rows_is_a_table(tmp_path: Path) -> None:
    write_table(tmp_path, "none", [])
    assert json.loads((tmp_path / "none.json").read_text()) == {"columns": [], "data": []}
