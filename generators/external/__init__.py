"""External: any program, any Python function, any mesh of a tree as a generator; the guide is README.md beside this."""

from generators.external.generator import External, ExternalError
from generators.external.mesh import Mesh

__all__ = ["External", "ExternalError", "Mesh"]
