from threading import Event

from treefit.tracking.background import Background


def test_jobs_are_done_in_order() -> None:
    done: list[int] = []
    background = Background("test", lambda error: None)
    for number in range(100):
        background.do(lambda number=number: done.append(number))
    assert background.close(10)
    assert done == list(range(100))


def test_first_failure_is_told_once_and_ends_the_work() -> None:
    done: list[str] = []
    errors: list[Exception] = []
    background = Background("test", errors.append)
    background.do(lambda: done.append("before"))
    background.do(lambda: 1 / 0)
    background.do(lambda: done.append("after"))
    background.do(lambda: [][0], always=True)
    background.do(lambda: done.append("always"), always=True)
    assert background.close(10)
    assert done == ["before", "always"]
    assert [type(error) for error in errors] == [ZeroDivisionError]
    assert background.failed


def test_work_that_hangs_is_left_behind() -> None:
    release = Event()
    background = Background("test", lambda error: None)
    background.do(lambda: release.wait(30) and None)
    assert not background.close(0.05)
    release.set()
