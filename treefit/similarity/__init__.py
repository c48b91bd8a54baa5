"""Two masks become a number (sec. 4)."""

from treefit.similarity.paper import PaperSimilarity
from treefit.similarity.similarity import Similarity
from treefit.similarity.stripes import Stripes, stripes

__all__ = ["PaperSimilarity", "Similarity", "Stripes", "stripes"]
