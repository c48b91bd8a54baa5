"""What run.py runs: each task builds, calls and saves; the last place that sees the configuration."""
