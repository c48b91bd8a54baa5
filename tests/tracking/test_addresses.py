import json

from treefit.tracking.addresses import COLUMNS, VIEW, VIEW_TAG, address, runs_page, view


def test_list_of_runs_opens_with_the_columns_that_the_tag_of_the_experiment_names() -> None:
    assert VIEW_TAG.endswith(f".{VIEW}")
    assert runs_page("1").endswith(f"&viewStateShareKey={VIEW}")
    told = json.loads(view())
    assert told["selectedColumns"] == list(COLUMNS)
    assert [name for name in told["columnOrder"] if name in COLUMNS] == list(COLUMNS)


def test_description_leads_to_files_pictures_and_other_runs() -> None:
    told = address('<img src="a b.png"><a href="viewer.html">3D</a><a href="run:0123">0.7</a>', "4", "r")
    assert told == (
        '<img src="get-artifact?path=a%20b.png&amp;run_uuid=r">'
        '<a href="#/experiments/4/runs/r/artifacts/viewer.html?workflowType=machine_learning">3D</a>'
        '<a href="#/experiments/4/runs/0123?workflowType=machine_learning">0.7</a>'
    )
    assert "<script" not in address('<a href="&quot;&gt;&lt;script&gt;">x</a>', "4", "r")
