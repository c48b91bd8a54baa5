import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

torch = pytest.importorskip("torch", reason="torch is not installed: python -m pip install -e '.[train]'")

from scripts.mask_training.augment import plain, views  # noqa: E402
from scripts.mask_training.loss import mask_loss  # noqa: E402
from scripts.mask_training.plan import Plan  # noqa: E402
from scripts.mask_training.rounds import paint_scenes, rounds  # noqa: E402
from scripts.mask_training.train import train  # noqa: E402
from scripts.mask_training.unet import UNet  # noqa: E402
from tests.mask_training.discs import disc  # noqa: E402

TINY = Plan(steps=4, batch=4, size=64, canvas=64, width=4, scenes=8, views=1, held_out=4, warmup=2, bfloat16=False)


def weights(learner: object) -> dict[str, np.ndarray]:
    return {name: value.numpy() for name, value in learner.average.state_dict().items()}  # type: ignore[attr-defined]


@pytest.fixture(autouse=True)
def _one_thread() -> None:
    torch.set_num_threads(1)


def test_a_killed_training_ends_with_the_same_weights(tmp_path: Path) -> None:
    whole = weights(train(TINY, disc, tmp_path / "whole", 60, workers=0))
    killed = tmp_path / "killed"

    def dies(seed: int, index: int, size: int) -> tuple[np.ndarray, np.ndarray]:
        if seed == TINY.seed and index >= 8:
            raise KeyboardInterrupt
        return disc(seed, index, size)

    with pytest.raises(KeyboardInterrupt):
        train(TINY, dies, killed, 60, workers=0)
    parts = weights(train(TINY, disc, killed, 60, workers=0))
    for name, value in whole.items():
        np.testing.assert_array_equal(parts[name], value, err_msg=name)
    steps = [json.loads(line)["step"] for line in (killed / "log.jsonl").read_text(encoding="utf-8").splitlines()]
    assert steps == sorted(steps)


def test_a_training_leaves_its_log_and_pictures(tmp_path: Path) -> None:
    learner = train(TINY, disc, tmp_path, 60, workers=0)
    assert learner.step == 4
    names = {path.name for path in tmp_path.iterdir()}
    assert names == {"checkpoint.pt", "log.jsonl", "loss.png", "validation.png"}
    last = json.loads((tmp_path / "log.jsonl").read_text(encoding="utf-8").splitlines()[-1])
    assert {"iou_background", "iou_branch", "iou_foliage", "iou_tree", "loss", "step"} == set(last)


def test_a_training_stops_by_the_clock(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert train(TINY, disc, tmp_path, 0, workers=0).step == 0
    assert "stopped by the clock at step 0 of 4" in capsys.readouterr().out


def test_another_plan_does_not_go_on_in_the_same_folder(tmp_path: Path) -> None:
    train(replace(TINY, steps=2), disc, tmp_path, 60, workers=0)
    with pytest.raises(ValueError, match="trained with other settings"):
        train(TINY, disc, tmp_path, 60, workers=0)


def test_scenes_do_not_depend_on_the_number_of_painters() -> None:
    here, there = (list(rounds(disc, 3, range(1, 3), 10, 32, workers)) for workers in (0, 2))
    assert len(here) == len(there) == 2
    for one, other in zip(here, there, strict=True):
        np.testing.assert_array_equal(one.rgb, other.rgb)
        np.testing.assert_array_equal(one.classes, other.classes)


def test_views_keep_colours_and_classes_together() -> None:
    scenes = paint_scenes(disc, 0, range(16), 64)
    pictures, classes = views(scenes, (64, 48), np.random.default_rng(1))
    assert pictures.shape == (16, 3, 64, 48)
    assert 0 <= float(pictures.min()) <= float(pictures.max()) <= 1
    again, same = views(scenes, (64, 48), np.random.default_rng(1))
    assert torch.equal(pictures, again)
    assert torch.equal(classes, same)
    greener = pictures[:, 1] - pictures[:, 0]
    # grey views have no colour; of the others leaves are greener than wood
    for picture, kind in zip(greener, classes, strict=True):
        assert picture[kind == 2].mean() >= picture[kind == 1].mean() - 0.02


def test_the_loss_is_least_for_the_truth() -> None:
    classes = plain(paint_scenes(disc, 0, range(4), 32))[1]
    truth = torch.nn.functional.one_hot(classes, 3).permute(0, 3, 1, 2) * 20.0
    assert float(mask_loss(truth, classes, 2.0)) < 0.01
    assert float(mask_loss(truth.roll(1, dims=1), classes, 2.0)) > 1


def test_rates_rise_and_fall() -> None:
    plan = Plan()
    rates = [plan.rate_at(step) for step in range(plan.steps)]
    assert max(rates) == pytest.approx(plan.rate)
    assert rates.index(max(rates)) in (plan.warmup - 1, plan.warmup)
    assert rates[-1] < 0.011 * plan.rate
    assert all(earlier >= later for earlier, later in zip(rates[plan.warmup :], rates[plan.warmup + 1 :], strict=False))


def test_the_exported_file_answers_as_the_network(tmp_path: Path) -> None:
    pytest.importorskip("onnx", reason="onnx is not installed: python -m pip install -e '.[train]'")
    onnxruntime = pytest.importorskip("onnxruntime", reason="onnxruntime is not installed")
    from scripts.mask_training.export import export

    torch.manual_seed(0)
    network = UNet(width=4)
    network(torch.rand(4, 3, 64, 64))  # normalisations with statistics that are not 0 and 1
    path = tmp_path / "tree.onnx"
    size = export(network.eval(), TINY, 4, path)
    written = path.read_bytes()
    assert size == len(written)
    pictures = torch.rand(1, 3, 128, 64)
    with torch.inference_mode():
        expected = torch.softmax(network(pictures), dim=1).numpy()
    session = onnxruntime.InferenceSession(path, providers=["CPUExecutionProvider"])
    np.testing.assert_allclose(session.run(None, {"picture": pictures.numpy()})[0], expected, atol=1e-5)
    export(network, TINY, 4, tmp_path / "again.onnx")
    assert (tmp_path / "again.onnx").read_bytes() == written
