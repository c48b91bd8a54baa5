"""Two masks become a number (sec. 4)."""

from treefit.similarity.asymmetry import Asymmetry
from treefit.similarity.class_overlap import ClassOverlap
from treefit.similarity.mix import Mix
from treefit.similarity.paper import PaperSimilarity
from treefit.similarity.similarity import Similarity
from treefit.similarity.soft_classes import SoftClasses
from treefit.similarity.stripes import Stripes, stripes
from treefit.similarity.texture import Texture
from treefit.similarity.trunk import Trunk

__all__ = [
    "Asymmetry", "ClassOverlap", "Mix", "PaperSimilarity", "Similarity", "SoftClasses", "Stripes", "Texture", "Trunk",
    "stripes",
]  # fmt: skip
