import numpy as np
import pytest
from omegaconf import OmegaConf

from experiments.dressing import dressed, look_of, suited
from experiments.errors import UserError
from experiments.read_tree import ReadTree
from treefit.asset import AssetSettings, TreeColours
from treefit.image import Extraction
from treefit.mask import FOLIAGE

SEEN = TreeColours((10, 20, 30), (40, 50, 60))


def tree(cone: bool) -> ReadTree:
    mask = np.zeros((100, 100), np.uint8)
    for row in range(100):
        half = row // 2 if cone else 40
        mask[row, 50 - half : 50 + half] = FOLIAGE
    return ReadTree("tree.png", None, Extraction(mask, "test", 1.0, ""))


@pytest.mark.parametrize(("outline", "cone", "wanted"), [
    ("auto", True, "tuft"), ("auto", False, "auto"), ("oak", True, "oak"),
])  # fmt: skip
def test_a_cone_wears_needles_unless_the_user_chose(outline, cone, wanted):
    cfg = OmegaConf.create({"asset": {"leaf_outline": outline}, "characteristics": {"leaf_outline": outline}})
    changed = suited(cfg, tree(cone))
    assert changed.asset.leaf_outline == changed.characteristics.leaf_outline == wanted
    assert cfg.asset.leaf_outline == outline


def test_a_preset_keeps_the_colours_of_the_picture_and_what_was_chosen():
    assert look_of(AssetSettings(leaf="#ff0000", leaf_outline="tuft"), SEEN) == {
        "bark": "#0a141e", "leaf": "#ff0000", "leaf_outline": "tuft",
    }  # fmt: skip
    assert look_of(AssetSettings(colours="own"), SEEN) == {}


def test_the_look_of_a_preset_is_worn_where_the_user_has_not_chosen():
    worn = dressed(AssetSettings(leaf="#00ff00"), look_of(AssetSettings(leaf_outline="oak"), SEEN))
    assert worn == AssetSettings(leaf="#00ff00", bark=SEEN.bark, leaf_outline="oak")
    assert dressed(AssetSettings(), {}) == AssetSettings()


@pytest.mark.parametrize(("look", "message"), [
    ({"hat": "red"}, "preset: look has 'hat'"), ({"bark": "brownish"}, "preset: look.bark: colour must be"),
])  # fmt: skip
def test_a_look_that_cannot_be_worn_is_one_line(look, message):
    with pytest.raises(UserError, match=message):
        dressed(AssetSettings(), look)
