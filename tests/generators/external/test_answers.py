"""Answers are found among whatever else a program prints."""

from __future__ import annotations

import io

import pytest

from generators.external.answers import Answers, Ended, TooMuch, answer_in

OK = {"id": 1, "ok": True}


@pytest.mark.parametrize(
    "line", [b'{"id": 1, "ok": true}', b'  {"id": 1, "ok": true}\r', b'50 % done{"id": 1, "ok": true}',
             b'{"half": {"id": 1, "ok": true}'],
)  # fmt: skip
def test_an_answer_is_found_even_behind_other_words(line: bytes) -> None:
    assert answer_in(line) == OK


@pytest.mark.parametrize("line", [b"", b"growing", b"{}", b'{"id": 1}', b'{"ok": true}', b"[1]", b"{" * 70_000])
def test_other_lines_are_no_answers(line: bytes) -> None:
    assert answer_in(line) is None


def test_the_last_words_are_kept_for_what_goes_wrong() -> None:
    answers = Answers()
    answers.read(io.BytesIO(b'loading\n{"id": 1, "ok": true}\nTraceback\nValueError: no such bark\n\n'))
    assert answers.queue.get() == OK
    assert isinstance(answers.queue.get(), Ended)
    assert answers.quoted() == "; its last words: ValueError: no such bark"


def test_a_flood_is_told_once_and_no_more_is_kept_of_it() -> None:
    answers = Answers(limit=1000)
    answers.read(io.BytesIO(b"x" * 1_000_000))
    assert answers.queue.get() == TooMuch(1000)
    assert isinstance(answers.queue.get(), Ended)
    assert len(answers.quoted()) < 500
