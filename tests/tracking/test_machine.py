import psutil
import pytest

from treefit.tracking import machine
from treefit.tracking.machine import Machine


def test_load_is_sampled_now_and_then(monkeypatch: pytest.MonkeyPatch) -> None:
    now = 100.0
    monkeypatch.setattr(machine.time, "monotonic", lambda: now)
    load = Machine()
    assert load.sample() == {}
    now += machine.FIRST
    known = load.sample()
    assert all(name.startswith("system/") for name in known)
    assert known["system/process_memory_megabytes"] > 1
    now += machine.BETWEEN - 0.1
    assert load.sample() == {}


def test_machine_that_does_not_tell_keeps_no_run_from_its_numbers(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(**_: object) -> float:
        raise PermissionError("/proc/stat")

    monkeypatch.setattr(psutil, "cpu_percent", refuse)
    monkeypatch.setattr(machine, "FIRST", 0.0)
    assert Machine().sample() == {}
