"""How the mask network is made: scenes are painted, a small U-Net learns them, and becomes an ONNX file."""
