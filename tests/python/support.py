"""What the tests share: where things are, and how the program is asked."""
import csv
import os
import pathlib
import subprocess
import tempfile

import genu
import numpy

SOURCE = pathlib.Path(os.environ["GENU_SOURCE"])
KNEE = SOURCE / "meshes" / "dortmans1984" / "scene.toml"
BONE = SOURCE / "tests" / "examples" / "hanging_bone.toml"
WHEEL = SOURCE / "tests" / "python" / "wheel_on_a_plate.toml"
CARTILAGE = SOURCE / "meshes" / "lenhart_polynomial" / "scene.toml"


def program(*arguments, table="results.csv"):
    """Runs the program; a table that it writes as a dict of lists of words."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        done = subprocess.run([os.environ["GENU_PROGRAM"], *map(str, arguments), "--out", out, "--quiet"], check=False)
        assert done.returncode in (0, 3, 4), done.returncode
        with open(out / table, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
    return {name: [row[k] for row in rows[1:]] for k, name in enumerate(rows[0])}


def compare(test, table, told):
    """Every value, as float("%.17g") brings it back."""
    test.assertEqual(list(table.columns), list(told))
    for name, words in told.items():
        column = table[name]
        test.assertEqual(len(column), len(words))
        if isinstance(column, list):
            test.assertEqual(column, words, name)
            continue
        expected = numpy.array([float(w) if w else numpy.nan for w in words])
        numpy.testing.assert_array_equal(column, expected, name)


def refusal(call):
    """The SceneError of a call."""
    try:
        call()
    except genu.SceneError as error:
        return error
    raise AssertionError("nothing was refused")
