"""Ways to answer that are not as agreed; the file of the tree is right."""

import os
import time

from hostile.call import Call


def raise_(call: Call) -> None:
    """Says that it failed, over two lines."""
    call.say(ok=False, error="RuntimeError: the bark\nis loose")


def long_error(call: Call) -> None:
    """Says that it failed in 10 MB, with control codes of a terminal."""
    call.say(ok=False, error="\x1b[31mthe bark " + "x" * 10_000_000)


def odd_error(call: Call) -> None:
    """Says that it failed, by a table instead of a text."""
    call.say(ok=False, error={"bark": ["loose"]})


def no_error(call: Call) -> None:
    """Says that it failed and not why."""
    call.say(ok=False)


def wrong_id(call: Call) -> None:
    """Answers to another call."""
    call.write(call.tree)
    call.say(id=call.id + 1, ok=True)


def twice(call: Call) -> None:
    """Answers twice."""
    call.write(call.tree)
    call.answer(call.line + call.line)


def ahead(call: Call) -> None:
    """Answers well, and to the next calls too before they are asked."""
    call.write(call.tree)
    call.answer()
    for more in (1, 2, 3):
        call.say(id=call.id + more, ok=True)


def not_sure(call: Call) -> None:
    """Answers that it is perhaps well."""
    call.write(call.tree)
    call.say(ok="perhaps")


def half_json(call: Call) -> None:
    """Prints half of an answer, then a right one on a line of its own."""
    call.write(call.tree)
    call.answer(call.line[:9] + "\n[1, 2\n" + call.line)


def same_line(call: Call) -> None:
    """Prints words before the answer on its line, and no right one."""
    call.write(call.tree)
    call.answer("growing ... " + call.line)


def deep_json(call: Call) -> None:
    """Prints JSON of 100,000 levels, and a number of as many digits, before the answer."""
    call.write(call.tree)
    call.answer("[" * 100_000 + "\n" + '{"id": ' + "9" * 100_000 + "}\n" + call.line)


def odd_json(call: Call) -> None:
    """Prints JSON that is no table and bytes that are no text before the answer."""
    call.write(call.tree)
    os.write(1, b'\xff\xfe\x00{\n[]\n"id"\nnull\n{"id": null, "ok": true}\n{"id": true, "ok": true}\n{"id": [1]}\n\n')
    call.answer()


def talk(call: Call) -> None:
    """Prints 100 MB of lines before the answer."""
    call.write(call.tree)
    for _ in range(100):
        os.write(1, b"growing a branch of the tree ...\n" * 31_775)
    call.answer()


def slowly(call: Call) -> None:
    """Answers letter by letter, 2 ms each."""
    call.write(call.tree)
    for letter in call.line.encode():
        os.write(1, bytes([letter]))
        time.sleep(0.002)


def late(call: Call) -> None:
    """Writes the tree and answers 1.5 s later."""
    time.sleep(1.5)
    call.give()
