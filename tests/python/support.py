"""What the tests share: where things are, and how the program is asked."""
import csv
import os
import pathlib
import subprocess
import tempfile

import genu

SOURCE = pathlib.Path(os.environ["GENU_SOURCE"])
KNEE = SOURCE / "meshes" / "dortmans1984" / "scene.toml"
BONE = SOURCE / "tests" / "examples" / "hanging_bone.toml"
CARTILAGE = SOURCE / "meshes" / "lenhart_polynomial" / "scene.toml"


def program(*arguments):
    """Runs the program; its results.csv as a dict of lists of words."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        done = subprocess.run([os.environ["GENU_PROGRAM"], *map(str, arguments), "--out", out, "--quiet"], check=False)
        assert done.returncode in (0, 4), done.returncode
        with open(out / "results.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
    return {name: [row[k] for row in rows[1:]] for k, name in enumerate(rows[0])}


def refusal(call):
    """The SceneError of a call."""
    try:
        call()
    except genu.SceneError as error:
        return error
    raise AssertionError("nothing was refused")
