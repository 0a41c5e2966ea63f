"""The scripts of docs/python.md run, and print what the page shows."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.dom.minidom

from support import SOURCE

PAGE = (SOURCE / "docs" / "python.md").read_text(encoding="utf-8")


def blocks(kind):
    return re.findall(rf"```{kind}\n(.*?)```", PAGE, re.S)


class Scripts(unittest.TestCase):
    def run_script(self, name):
        with tempfile.TemporaryDirectory() as folder:
            script = SOURCE / "docs" / "python" / f"{name}.py"
            done = subprocess.run([sys.executable, script, folder], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            figure = pathlib.Path(folder) / f"{name}.svg"
            xml.dom.minidom.parse(str(figure))
            self.assertEqual(figure.read_bytes(), (SOURCE / "docs" / "python" / f"{name}.svg").read_bytes(), "docs/python is old")
        self.assertIn(done.stdout, [block for block in blocks("text")], "docs/python.md shows something else")
        return done.stdout

    def test_laxity(self):
        rows = [line.split() for line in self.run_script("laxity").splitlines()[2:]]
        for _, intact, cut in rows:
            self.assertGreater(float(cut), float(intact))

    def test_which_ligament(self):
        predicted, found = re.search(r"(\S+) deg predicted, (\S+) deg found", self.run_script("which_ligament")).groups()
        self.assertAlmostEqual(float(predicted) / float(found), 1, delta=0.05)


    def test_speed(self):
        script = SOURCE / "docs" / "python" / "speed.py"
        done = subprocess.run([sys.executable, script, "3"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        least, middle = re.fullmatch(r"3 runs: (\S+) ms at least, (\S+) ms in the middle\n", done.stdout).groups()
        self.assertLessEqual(float(least), float(middle))


class Page(unittest.TestCase):
    def test_code_runs_as_it_stands(self):
        code = "\n".join(blocks("python"))
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "meshes").symlink_to(SOURCE / "meshes")
            (pathlib.Path(folder) / "tests").symlink_to(SOURCE / "tests")
            (pathlib.Path(folder) / "out").mkdir()
            done = subprocess.run([sys.executable, "-c", code], cwd=folder, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
