from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from scripts.mask_training.exam import main
from treefit.image.read import read_mask_file, read_picture


@pytest.mark.slow
def test_pictures_of_the_kinds_asked_for_stand_beside_their_exact_masks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        "sys.argv", ["exam", "--count", "2", "--size", "64", "--kinds", "silhouette", "--folder", str(tmp_path)]
    )
    main()
    pictures = sorted(path for path in tmp_path.iterdir() if not path.name.startswith("mask_"))
    assert [path.name.split("_")[0] for path in pictures] == ["silhouette", "silhouette"]
    for path in pictures:
        mask = read_mask_file(path.with_name(f"mask_{path.name}"))
        assert mask.shape == read_picture(path).shape == Image.open(path).size[::-1]
        assert 0.02 < np.mean(mask > 0) < 0.9
