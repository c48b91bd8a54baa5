"""Outdoors: one tree in a landscape, painted from far to near, with the classes a person would give."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from scripts.mask_training.scenery.arrays import Classes, Field, Image, Rng, chance
from scripts.mask_training.scenery.buildings import paint_buildings, paint_wall
from scripts.mask_training.scenery.canvas import Canvas
from scripts.mask_training.scenery.ground import paint_ground
from scripts.mask_training.scenery.groves import paint_grove
from scripts.mask_training.scenery.labels import person_labels
from scripts.mask_training.scenery.neighbours import paint_neighbours
from scripts.mask_training.scenery.render import Layer, Pose, opened, render
from scripts.mask_training.scenery.setting import Setting, drawn_setting
from scripts.mask_training.scenery.shadow import grow_grass, throw_shadow
from scripts.mask_training.scenery.sky import paint_sky
from scripts.mask_training.scenery.things import paint_mulch, paint_things
from scripts.mask_training.scenery.trees import Tree, drawn_kind, drawn_tree, slender
from scripts.mask_training.scenery.woods import bush, paint_bushes, paint_hills, paint_tree_line

LEAVES = 22_000
"""Most leaves of the tree in a picture of 192 pixels; more in larger ones."""


def outdoors(size: int, rng: Rng) -> tuple[Image, Classes]:
    """Picture (size, size, 3) of a tree outdoors, as it is before the camera, and its classes."""
    tree = drawn_tree(drawn_kind(rng), rng, LEAVES)
    setting = drawn_setting(tree.season, size, rng)
    pose, setting = _pose(tree, setting, size, rng)
    canvas = Canvas.blank(size)
    _paint_behind(canvas, tree, setting, rng)
    paint_neighbours(canvas, tree, pose, setting, rng)
    model = opened(tree.model, pose, rng) if chance(rng, 0.3) else tree.model
    layer = render(model, pose, tree.look, setting.light, size, 2, rng)
    if chance(rng, 0.25):
        paint_mulch(canvas, setting, pose.x, pose.y, pose.height * rng.uniform(0.06, 0.3), rng)
    throw_shadow(canvas, layer.cover, pose, setting, rng)
    classes = person_labels(layer, canvas.land, tree.kind == "bare")
    hidden = _set_in(canvas, layer, pose, setting, rng)
    classes[hidden > 0.5] = 0
    return canvas.rgb, classes


def _pose(tree: Tree, setting: Setting, size: int, rng: Rng) -> tuple[Pose, Setting]:
    """Where the tree stands, and the setting with the horizon above its foot."""
    aspect = float(np.exp(rng.normal(0.18, 0.17)))
    height = size * float(np.clip(rng.normal(0.88, 0.14), 0.45, 1.15))
    foot = size * float(np.clip(rng.normal(0.91, 0.045), 0.76, 0.99))
    wide = slender(tree.model) * height * aspect
    close = chance(rng, 0.2 if tree.kind == "bare" else 0.06)
    if close:  # the picture shows a part of the tree
        height, foot = size * rng.uniform(1.1, 1.7), size * rng.uniform(0.98, 1.25)
    elif wide > 0.97 * size and chance(rng, 0.85):  # most people keep the tree in the picture
        height *= size * rng.uniform(0.8, 1.0) / wide
    if chance(rng, 0.06):
        foot = size * rng.uniform(1.0, 1.15)
    if foot - height < 0.02 * size and not close and chance(rng, 0.8):
        height = foot - size * rng.uniform(0.01, 0.08)
    foot = max(foot, 0.5 * (size + height) - 0.05 * size)
    horizon = min(setting.horizon, foot - size * rng.uniform(0.015, 0.12))
    if foot > size:
        horizon = min(size * rng.uniform(0.75, 1.15), foot - 0.02 * size)
    x = size * float(np.clip(rng.normal(0.5, 0.07), 0.3, 0.7))
    pose = Pose(x, foot, height, rng.uniform(0, 2 * np.pi), rng.normal(0, 0.07), rng.normal(0, 0.025), aspect)
    return pose, replace(setting, horizon=float(horizon))


def _paint_behind(canvas: Canvas, tree: Tree, setting: Setting, rng: Rng) -> None:
    paint_sky(canvas, setting, rng)
    if chance(rng, 0.35):
        paint_hills(canvas, setting, rng)
    if chance(rng, 0.5):
        paint_tree_line(canvas, setting, rng)
    if chance(rng, 0.22):
        paint_buildings(canvas, setting, rng)
        if chance(rng, 0.3):
            paint_tree_line(canvas, setting, rng)
    paint_ground(canvas, setting, rng)
    if chance(rng, 0.4):
        paint_grove(canvas, tree, setting, rng)
    if chance(rng, 0.08):
        paint_wall(canvas, setting, rng)
    if chance(rng, 0.4):
        paint_bushes(canvas, setting, rng)
    paint_things(canvas, setting, rng)


def _set_in(canvas: Canvas, layer: Layer, pose: Pose, setting: Setting, rng: Rng) -> Field:
    """Lay the tree over all, then what stands before it; return what is hidden (h, w)."""
    behind = canvas.rgb.copy()
    air = setting.haze * rng.uniform(0, 0.12)
    canvas.lay((layer.rgb + (np.array(setting.air) - layer.rgb) * air).astype(np.float32), layer.cover)
    hidden = grow_grass(canvas, behind, pose, setting, rng)
    if chance(rng, 0.13):
        front = Canvas(np.dstack([canvas.rgb, np.zeros_like(canvas.land)]))
        for _ in range(int(rng.integers(1, 4) if chance(rng, 0.6) else rng.integers(6, 12))):
            high = pose.height * rng.uniform(0.04, 0.15)
            x = pose.x + rng.normal(0, 0.3) * pose.height
            bush(front, setting, x, pose.y + high * rng.uniform(0.1, 0.5), high, rng)
        canvas.rgb[...] = front.rgb
        hidden = np.maximum(hidden, front.land)
    return hidden
