"""Tracking: keeps the numbers and files of runs; the only room that knows mlflow."""

from treefit.tracking.mlflow_tracker import MlflowTracker
from treefit.tracking.no_tracker import NoTracker
from treefit.tracking.story import Story, Table
from treefit.tracking.tracker import Tracker

__all__ = ["MlflowTracker", "NoTracker", "Story", "Table", "Tracker"]
