"""Ways to misbehave, by name; each is a function of one call, and its docstring says what it does."""

from hostile import left_behind, no_answers, wrong_answers, wrong_files, wrong_trees

KINDS = {
    name.rstrip("_"): kind
    for room in (no_answers, wrong_answers, wrong_trees, wrong_files, left_behind)
    for name, kind in vars(room).items()
    if getattr(kind, "__module__", "") == room.__name__ and not name.startswith("_")
}
