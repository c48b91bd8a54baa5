"""The training loop: rounds of scenes in, a folder with a checkpoint, a log and pictures out."""

from __future__ import annotations

import time
from pathlib import Path

import numpy as np

from scripts.mask_training.learner import Learner
from scripts.mask_training.log import Log
from scripts.mask_training.plan import Plan
from scripts.mask_training.rounds import Painter, Scenes, paint_scenes, rounds
from scripts.mask_training.validation import validate

HELD_OUT_SEED = 1_000_003
LOG_EVERY = 20


def train(plan: Plan, painter: Painter, folder: Path, seconds: float, workers: int) -> Learner:
    """Learner after `plan.steps`, or what there is after `seconds`; goes on where `folder` ended.

    Same plan and same threads give the same weights, however often it was interrupted.
    """
    folder.mkdir(parents=True, exist_ok=True)
    end = time.monotonic() + seconds
    learner = Learner(plan)
    learner.load(folder)
    log = Log(folder, plan.steps, learner.step, end)
    first = learner.step // plan.steps_a_round
    if learner.step >= plan.steps:
        return learner
    held_out = paint_scenes(painter, plan.seed + HELD_OUT_SEED, range(plan.held_out), plan.size)
    for scenes in rounds(painter, plan.seed, range(first, plan.rounds), plan.scenes, plan.canvas, workers):
        done = _one_round(learner, scenes, log, end)
        if done:
            learner.save(folder)
        log.validated(learner.step, validate(learner.average, held_out, folder))
        if not done:
            log.say(f"stopped by the clock at step {learner.step} of {plan.steps}, before the rate had fallen")
            break
    return learner


def _one_round(learner: Learner, scenes: Scenes, log: Log, end: float) -> bool:
    """Learn all views of `scenes`; False as soon as the time is over."""
    plan = learner.plan
    start = learner.step
    orders = [np.random.default_rng([plan.seed, start, view]).permutation(plan.scenes) for view in range(plan.views)]
    batches = np.concatenate(orders).reshape(-1, plan.batch)[: plan.steps - start]
    for chosen in batches:
        if time.monotonic() > end:
            return False
        loss = learner.learn(Scenes(scenes.rgb[chosen], scenes.classes[chosen]))
        if learner.step % LOG_EVERY == 0 or learner.step == plan.steps:
            log.stepped(learner.step, loss, plan.rate_at(learner.step))
    return True
