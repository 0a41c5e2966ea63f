"""Results as columns, how they show themselves, and meshes."""
import pathlib
import tempfile
import unittest

import genu
import numpy
from support import KNEE, SOURCE, refusal


class Columns(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.found = genu.load(KNEE).run()

    def test_share_their_memory_and_cannot_be_written(self):
        column = self.found["knee.rotation_deg"]
        self.assertEqual((column.dtype, column.shape), (numpy.float64, (71,)))
        again = self.found["knee.rotation_deg"]
        self.assertEqual(column.__array_interface__["data"][0], again.__array_interface__["data"][0])
        self.assertFalse(column.flags.owndata)
        with self.assertRaises(ValueError):
            column[0] = 1
        with self.assertRaises(ValueError):
            column.flags.writeable = True

    def test_are_a_mapping(self):
        table = self.found.table()
        everything = dict(table)
        self.assertEqual(list(everything), table.columns)
        self.assertEqual(set(everything["status"]), {"ok"})
        self.assertIn("status", table)
        self.assertNotIn(3, table)
        self.assertEqual(len(self.found), 71)
        self.assertIn('did you mean "knee.rotation_deg"', str(refusal(lambda: self.found["knee.rotaton_deg"])))

    def test_become_a_dataframe(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("no pandas")
        frame = self.found.to_dataframe()
        self.assertIsInstance(frame, pandas.DataFrame)
        self.assertEqual(frame.shape, (71, len(self.found.table().columns)))
        numpy.testing.assert_array_equal(frame["knee.rotation_deg"], self.found["knee.rotation_deg"])

    def test_show_themselves(self):
        self.assertEqual(self.found.verdict, "solved")
        self.assertIn("71 of 71 poses", repr(self.found))
        page = self.found._repr_html_()
        self.assertIn("<th>knee.flexion_deg</th>", page)
        self.assertEqual(page.count("<table>"), page.count("</table>"))
        self.assertIn("AAC", repr(genu.load(KNEE)))
        self.assertIn("<table>", genu.load(KNEE)._repr_html_())
        self.assertIn("71 rows", repr(self.found.table()))
        self.assertIn("rows", self.found.events._repr_html_())

    def test_go_into_a_report(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "report.html"
            self.found.report(str(file))
            self.assertIn("Dortmans", file.read_text(encoding="utf-8"))
            refusal(lambda: self.found.report(folder))

    def test_tell_what_was_changed(self):
        knee = genu.load(KNEE).without("PAC")
        knee["AAC.stiffness"] = 30000
        found = knee.run()
        self.assertEqual(found.changes, ["without PAC: 1 ligament", "AAC.stiffness = 30000 N (37200)"])
        self.assertIn("without PAC", repr(found))


class Sensitivities(unittest.TestCase):
    def test_have_shapes_names_and_a_ranking(self):
        s = genu.load(KNEE).sensitivity(["knee.rotation", "knee.adduction"], "*.stiffness")
        self.assertEqual(s.of, ["knee.adduction_deg", "knee.rotation_deg"])
        self.assertEqual(len(s.to), 7)
        self.assertEqual(s.derivatives.shape, (71, 2, 7))
        self.assertEqual(s.effects.shape, (71, 2, 7))
        self.assertEqual(s.changes, ["1 %"] * 7)
        self.assertEqual(s.results.solved, 71)
        ranking = s.ranking("knee.rotation_deg")
        sizes = [abs(effect) for _, effect in ranking]
        self.assertEqual(sizes, sorted(sizes, reverse=True))
        self.assertAlmostEqual(sizes[0], numpy.nanmax(numpy.abs(s.effects[:, 1, :])))
        with self.assertRaises(ValueError):
            s.ranking()

    def test_agree_with_differences(self):
        knee = genu.load(KNEE)
        derivative = knee.sensitivity("knee.rotation", "PAC.stiffness").derivatives[30, 0, 0]
        value = knee["PAC.stiffness"]
        found = []
        for x in (value + 5, value - 5):
            knee["PAC.stiffness"] = x
            found.append(knee.run()["knee.rotation_deg"][30])
        self.assertAlmostEqual((found[0] - found[1]) / 10 / derivative, 1, places=4)

    def test_refuse_names_that_are_none(self):
        knee = genu.load(KNEE)
        error = refusal(lambda: knee.sensitivity("knee.rotatoin", ["AAC.stifness", "PAC.stiffness"]))
        self.assertEqual([p.key for p in error.problems], ["of", "to"])
        with self.assertRaises(TypeError):
            knee.sensitivity(3, "AAC.stiffness")
        with self.assertRaises(TypeError):
            knee.sensitivity("knee.rotation", [3])


class Meshes(unittest.TestCase):
    def test_of_files(self):
        check = genu.mesh_check(SOURCE / "meshes" / "leskovar2019" / "femur.stl")
        self.assertGreater(check.triangles, 100)
        self.assertIn("triangles", repr(check))
        self.assertTrue(all(f.verdict in ("ok", "note", "BAD") for f in check.findings))
        refusal(lambda: genu.mesh_check("no/such.stl"))

    def test_in_memory(self):
        vertices = numpy.array([[0, 0, 0], [40, 0, 0], [0, 40, 0], [0, 0, 40]], dtype=numpy.float32, order="F")
        triangles = numpy.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], dtype=numpy.uint16)
        self.assertEqual(genu.mesh_check((vertices, triangles)).triangles, 4)
        self.assertIn("vertex", str(refusal(lambda: genu.mesh_check((vertices, triangles + 1)))))
        refusal(lambda: genu.mesh_check((vertices, triangles.astype(numpy.int64) - 1)))
        refusal(lambda: genu.mesh_check((vertices, triangles[:0])))
        refusal(lambda: genu.mesh_check((vertices, triangles), "furlong"))
        for pair in (
            (vertices, triangles.astype(float)),
            (vertices[:, :2], triangles),
            (vertices[0], triangles),
            (vertices.astype(complex), triangles),
            (vertices, triangles[:, :2]),
            (vertices,),
        ):
            with self.assertRaises((TypeError, ValueError)):
                genu.mesh_check(pair)
        with self.assertRaises(TypeError):
            genu.mesh_check(3)


if __name__ == "__main__":
    unittest.main()
