import pytest

from experiments.names import LONGEST, run_name


@pytest.mark.parametrize(
    ("image", "name"),
    [
        ("pine.png", "pine"), ("/a/b/my pine (1).png", "my_pine_1"), ("C:\\x\\pine.png", "pine"), ("été.png", "été"),
        ("../../..", "picture"), ("a\n<b>.png", "a_b"), ("‮evil.png", "evil"), ("$(x).png", "x"),
    ],
)  # fmt: skip
def test_folder_name_of_any_picture_is_safe(image: str, name: str) -> None:
    assert run_name("fit", image) == name


def test_folder_name_is_short() -> None:
    assert len(run_name("fit", "x" * 400 + ".png")) == LONGEST


def test_run_without_a_picture_is_named_by_its_task() -> None:
    assert run_name("grow", None) == "grow"
