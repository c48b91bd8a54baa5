"""Export: a trained network becomes an ONNX file that needs nothing of its training."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

import onnx
import torch
from onnx import helper, numpy_helper
from torch import Tensor, nn
from torch.nn.utils.fusion import fuse_conv_bn_eval

from scripts.mask_training.plan import Plan
from scripts.mask_training.unet import UNet

INPUT, OUTPUT = "picture", "probabilities"
OPSET, FORMAT = 17, 8
"""Versions that onnxruntime reads since 1.13."""


def export(network: UNet, plan: Plan, steps: int, path: Path) -> int:
    """Write `network` to `path` and return its bytes.

    It takes a picture (1, 3, h, w) in 0..1, sides multiples of 64, and gives probabilities (1, 3, h, w) of background,
    branch, foliage. Written node by node: torch's exporter is slow and notes paths of the machine.
    """
    graph = _Graph()
    _draw(graph, network)
    sides = (1, 3, "height", "width")
    ends = [helper.make_tensor_value_info(name, onnx.TensorProto.FLOAT, sides) for name in (INPUT, OUTPUT)]
    whole = helper.make_graph(graph.nodes, "tree", ends[:1], ends[1:], graph.weights)
    model = helper.make_model(whole, opset_imports=[helper.make_opsetid("", OPSET)], ir_version=FORMAT)
    helper.set_model_props(model, {"plan": json.dumps(asdict(plan)), "steps": str(steps)})
    onnx.checker.check_model(model, full_check=True)
    new = path.with_name(path.name + ".new")
    new.write_bytes(model.SerializeToString(deterministic=True))
    new.replace(path)
    return path.stat().st_size


class _Graph:
    """Nodes and weights, added in the order of their use."""

    def __init__(self) -> None:
        self.nodes: list[onnx.NodeProto] = []
        self.weights: list[onnx.TensorProto] = []

    def node(self, kind: str, *inputs: str, output: str = "", **attributes: object) -> str:
        """Name of the output of a new node."""
        name = output or f"{kind}_{len(self.nodes)}"
        node = helper.make_node(kind, inputs, [name], name)
        node.attribute.extend(helper.make_attribute(key, value) for key, value in attributes.items())
        self.nodes.append(node)
        return name

    def weight(self, values: Tensor) -> str:
        """Name of a constant."""
        name = f"weight_{len(self.weights)}"
        self.weights.append(numpy_helper.from_array(values.detach().contiguous().numpy(), name))
        return name

    def convolution(self, x: str, layer: nn.Conv2d) -> str:
        """Name of the output of `layer`."""
        assert layer.bias is not None
        pads = [int(side) for side in layer.padding] * 2
        weights = self.weight(layer.weight), self.weight(layer.bias)
        return self.node("Conv", x, *weights, pads=pads, strides=layer.stride, group=layer.groups)

    def units(self, x: str, module: nn.Module) -> str:
        """Name of the output of `module`'s convolutions in turn, normalisation folded into them, each with ReLU."""
        for unit in module.modules():
            if isinstance(unit, nn.Sequential) and isinstance(unit[0], nn.Conv2d):
                assert isinstance(unit[1], nn.BatchNorm2d)
                x = self.node("Relu", self.convolution(x, fuse_conv_bn_eval(unit[0], unit[1])))
        return x


def _draw(graph: _Graph, network: UNet) -> None:
    """The way of `UNet.forward`, and a softmax."""
    network.eval()
    twice = graph.weight(torch.tensor([1.0, 1.0, 2.0, 2.0]))
    x = graph.node("Sub", INPUT, graph.weight(network.mean))
    x = graph.units(graph.node("Div", x, graph.weight(network.deviation)), network.stem)
    levels = []
    for index, level in enumerate(network.down):
        x = graph.units(x if index == 0 else graph.node("MaxPool", x, kernel_shape=(2, 2), strides=(2, 2)), level)
        levels.append(x)
    for index in reversed(range(len(network.up))):
        x = graph.node("Resize", x, "", twice, mode="linear", coordinate_transformation_mode="half_pixel")
        x = graph.units(graph.node("Concat", levels[index], x, axis=1), network.up[index])
    x = graph.node("DepthToSpace", graph.convolution(x, network.head), blocksize=2, mode="CRD")
    graph.node("Softmax", x, output=OUTPUT, axis=1)
