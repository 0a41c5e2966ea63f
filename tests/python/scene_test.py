"""Scenes: changed in memory, with the program's numbers."""
import os
import pathlib
import signal
import tempfile
import threading
import time
import unittest

import genu
import numpy
from support import BONE, CARTILAGE, KNEE, WHEEL, compare, program, refusal


class Numbers(unittest.TestCase):
    def test_are_those_of_the_program(self):
        for scene in (KNEE, BONE, CARTILAGE, WHEEL):
            with self.subTest(scene=scene.parent.name):
                compare(self, genu.load(scene).run().table(), program("run", scene, "--no-report"))

    def test_are_those_of_a_file_with_the_change(self):
        knee = genu.load(KNEE)
        knee["ligament.AAC.stiffness"] *= 0.5
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "scene.toml"
            file.write_text(KNEE.read_text().replace("stiffness = 37200.0", "stiffness = 18600.0"))
            compare(self, knee.run().table(), program("run", file, "--no-report"))

    def test_of_evaluate_are_those_of_the_program(self):
        bone = genu.load(BONE)
        poses = {"joint.flexion_deg": [0, 4.5], "joint.adduction_deg": [1, 2], "joint.rotation_deg": [0, -3]}
        poses.update({"joint.x_mm": [0, 1], "joint.y_mm": [0, 2], "joint.z_mm": [-60, -61.5]})
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "poses.csv"
            rows = [",".join(poses)] + [",".join(str(column[k]) for column in poses.values()) for k in range(2)]
            file.write_text("\n".join(rows) + "\n")
            compare(self, bone.evaluate(poses).table(), program("evaluate", BONE, "--poses", file))

    def test_of_changes_are_those_of_the_command_line(self):
        wheel = genu.load(WHEEL).without("across")
        wheel["upright.stiffness"] *= 0.5
        told = program("run", WHEEL, "--no-report", "--without", "across", "--set", "upright.stiffness=x0.5")
        compare(self, wheel.run().table(), told)
        without = genu.load(WHEEL).without("upright1")
        compare(self, without.run().table(), program("run", WHEEL, "--no-report", "--without", "upright1"))
        self.assertEqual(genu.load(WHEEL).without("upright").ligaments, ["ahead", "across"])

    def test_of_laxity_are_those_of_the_program(self):
        wheel = genu.load(WHEEL)
        found = wheel.laxity([0, 10], anterior=20, varus=0.2, internal=0.1, compression=10, increments=3)
        asked = ("--at", "0,10", "--anterior", "20", "--varus", "0.2", "--internal", "0.1", "--compression", "10")
        asked = ("laxity", WHEEL, *asked, "--increments", "3")
        compare(self, found.poses, program(*asked, table="laxity.csv"))
        compare(self, found.summary, program(*asked, table="laxity_summary.csv"))
        self.assertEqual(found.complete, len(found.sentences) == 1)
        self.assertIn("drawer", repr(found))
        self.assertIn("from 0 to", str(refusal(lambda: wheel.laxity(anterior=-1))))
        refusal(lambda: wheel.laxity(anterior=0, varus=0, internal=0))
        refusal(lambda: genu.load(KNEE).laxity())


class Changes(unittest.TestCase):
    def test_by_name_by_pattern_and_one_by_one(self):
        knee = genu.load(KNEE)
        self.assertEqual(knee["AAC.stiffness"], 37200)
        before = knee["A*.stiffness"]
        self.assertEqual(before.shape, (3,))
        knee["A*.stiffness"] *= 0.5
        numpy.testing.assert_array_equal(knee["A*.stiffness"], 0.5 * before)
        knee["A*.stiffness"] = before
        self.assertEqual(knee.changes, [])
        knee["AAC.stiffness"] = numpy.float32(2)
        self.assertEqual(knee["AAC.stiffness"], 2)
        self.assertEqual([n.unit for n in knee.numbers("AAC.s*")], ["N"])

    def test_make_other_scenes(self):
        knee = genu.load(KNEE)
        cut = knee.without("A*C")
        self.assertEqual(len(cut.ligaments), 4)
        self.assertEqual(len(knee.ligaments), 7)
        other = knee.copy()
        other["AAC.stiffness"] = 1
        self.assertEqual(knee["AAC.stiffness"], 37200)

    def test_that_are_wrong_change_nothing(self):
        knee = genu.load(KNEE)
        error = refusal(lambda: knee.__setitem__("AAC.stiffness", -2))
        self.assertEqual((error.key, error.found, error.code), ("AAC.stiffness", "-2", "out-of-range"))
        self.assertIn('did you mean "AAC.stiffness"', str(refusal(lambda: knee["AAC.stifness"])))
        self.assertIn("means 3 numbers", str(refusal(lambda: knee.__setitem__("A*.stiffness", [1, 2]))))
        for value in ("stiff", 1j, None, [[1, 2]], object()):
            with self.assertRaises((TypeError, ValueError)):
                knee["AAC.stiffness"] = value
        with self.assertRaises(TypeError):
            knee[3]
        refusal(lambda: knee.without("nothing*"))
        self.assertEqual(knee.changes, [])

    def test_never_touch_the_disk(self):
        with tempfile.TemporaryDirectory() as folder:
            here = os.getcwd()
            os.chdir(folder)
            try:
                scene = genu.new()
                scene[scene.numbers("*.stiffness")[0].name] *= 1.1
                self.assertGreater(scene.run().solved, 0)
                self.assertEqual(os.listdir(folder), [])
            finally:
                os.chdir(here)


class Errors(unittest.TestCase):
    def test_have_their_place(self):
        text = KNEE.read_text().replace("stiffness = 37200.0", "stiffness = -2").replace("major_radius = 15", "radius = 15")
        error = refusal(lambda: genu.parse(text, "bad.toml"))
        self.assertIsInstance(error, ValueError)
        self.assertEqual((error.file, error.code), ("bad.toml", "missing-key"))
        self.assertGreater(error.line, 0)
        self.assertGreater(error.column, 0)
        self.assertGreater(len(error.problems), 1)
        self.assertIn("ligament.AAC.stiffness", [p.key for p in error.problems])
        self.assertIn("must be > 0 N", str(error))

    def test_of_files(self):
        error = refusal(lambda: genu.load("no/such/scene.toml"))
        self.assertIsNone(error.line)
        with self.assertRaises(TypeError):
            genu.load(3)
        refusal(lambda: genu.new(kind="hip"))
        refusal(lambda: genu.new(kind="stl"))

    def test_of_meshes_that_are_no_knee(self):
        bones = KNEE.parent.parent / "leskovar2019"
        with tempfile.TemporaryDirectory() as folder:
            knee = pathlib.Path(folder) / "knee"
            error = refusal(lambda: genu.new(knee, kind="stl", femur=[bones / "femur.stl"], tibia=bones / "tibia.stl",
                                             patella=(bones / "tibia.stl",)))
            self.assertIn("is it the patella?", str(error))
            self.assertFalse(knee.exists())


class Runs(unittest.TestCase):
    def test_tell_their_progress(self):
        told = []
        genu.load(KNEE).run(progress=lambda done, asked: told.append((done, asked)))
        self.assertEqual(told[0], (1, 71))
        self.assertEqual(told[-1], (71, 71))
        with self.assertRaises(TypeError):
            genu.load(KNEE).run(progress=3)

    def test_pass_on_what_the_progress_throws(self):
        def stop(done, asked):
            if done == 4:
                raise KeyError("enough")

        knee = genu.load(KNEE)
        with self.assertRaises(KeyError):
            knee.run(progress=stop)
        self.assertEqual(knee.run().solved, 71)

    def test_let_the_progress_use_the_scene(self):
        knee = genu.load(KNEE)
        values = []
        knee.run(progress=lambda done, asked: values.append(knee["AAC.stiffness"]))
        self.assertEqual(values, [37200] * 71)

    def test_end_with_ctrl_c(self):
        knee = genu.load(CARTILAGE)
        pid = os.getpid()
        threading.Timer(0.1, lambda: os.kill(pid, signal.SIGINT)).start()
        begun = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            for _ in range(1000):
                knee.run()
        self.assertLess(time.monotonic() - begun, 10)
        self.assertEqual(genu.load(KNEE).run().solved, 71)

    def test_leave_other_threads_running(self):
        counted = [0]
        done = threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        before = counted[0]
        genu.load(CARTILAGE).run()
        during = counted[0] - before
        done.set()
        thread.join()
        self.assertGreater(during, 5)

    def test_of_two_scenes_in_threads_give_the_bytes_of_one_alone(self):
        knee, bone = genu.load(KNEE), genu.load(BONE)
        softer = knee.copy()
        softer["AAC.stiffness"] *= 0.5
        scenes = [knee, bone, softer, knee]
        alone = [scene.run().table().csv() for scene in scenes]
        found = [[] for _ in scenes]

        def run(k):
            for _ in range(5):
                found[k].append(scenes[k].run().table().csv())

        threads = [threading.Thread(target=run, args=(k,)) for k in range(len(scenes))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for k, csv in enumerate(alone):
            self.assertEqual(found[k], [csv] * 5)


class Solvers(unittest.TestCase):
    def test_of_your_own_find_the_same_pose(self):
        bone = genu.load(BONE)
        q = bone.start.copy()
        for _ in range(20):
            q += numpy.linalg.solve(bone.stiffness(q), bone.residual(q))
        numpy.testing.assert_allclose(q, bone.run().q[0], rtol=0, atol=1e-11)
        numpy.testing.assert_allclose(bone.residual(q), 0, atol=1e-10)

    def test_get_exact_derivatives(self):
        bone = genu.load(BONE)
        q = bone.start + [0.1, 0.2, -0.1, 0.001, 0.002, 0.003]
        K = bone.stiffness(q)
        self.assertEqual(K.shape, (6, 6))
        step = 1e-6 * numpy.eye(6)
        differences = numpy.array([(bone.residual(q - d) - bone.residual(q + d)) / 2e-6 for d in step]).T
        numpy.testing.assert_allclose(K, differences, rtol=0, atol=1e-6 * numpy.abs(K).max())

    def test_are_told_what_cannot_be(self):
        bone = genu.load(BONE)
        for q in (numpy.zeros((2, 3)), ["a"] * 6, numpy.zeros(6) * 1j, None):
            with self.assertRaises((TypeError, ValueError)):
                bone.residual(q)
        self.assertIn("5 values", str(refusal(lambda: bone.residual(numpy.zeros(5)))))
        self.assertIn("finite", str(refusal(lambda: bone.residual([numpy.nan] * 6))))
        self.assertIn("no load", str(refusal(lambda: bone.residual(bone.start, {"push": 1}))))
        self.assertIn("rigid", str(refusal(lambda: genu.load(KNEE).residual(numpy.zeros(6)))))

    def test_may_give_numbers_in_any_order_and_type(self):
        bone = genu.load(BONE)
        poses = numpy.asfortranarray(bone.run().q.repeat(3, axis=0))
        forces = bone.evaluate(poses)["front.force_N"]
        numpy.testing.assert_array_equal(bone.evaluate(poses[::-1])["front.force_N"], forces[::-1])
        whole = bone.residual(numpy.array([0, 0, 0, 0, 0, -1], dtype=numpy.int8))
        numpy.testing.assert_array_equal(whole, bone.residual([0.0, 0, 0, 0, 0, -1]))


class Poses(unittest.TestCase):
    def test_are_refused_with_their_reason(self):
        bone = genu.load(BONE)
        good = {name + ("_deg" if k < 3 else "_mm"): [0.0] for k, name in enumerate(bone.coordinates)}
        self.assertIn("joint.z", str(refusal(lambda: bone.evaluate({k: v for k, v in good.items() if "z_mm" not in k}))))
        self.assertIn("2 rows", str(refusal(lambda: bone.evaluate({**good, "joint.z_mm": [1, 2]}))))
        refusal(lambda: bone.evaluate({**good, "joint.z_mm": [numpy.nan]}))
        refusal(lambda: bone.evaluate({}))
        refusal(lambda: bone.evaluate(numpy.zeros((0, 6))))
        for poses in ({**good, "joint.z_mm": ["down"]}, numpy.zeros((2, 5)), numpy.zeros(6), 3, {**good, "joint.z_mm": 1}):
            with self.assertRaises((TypeError, ValueError)):
                bone.evaluate(poses)

    def test_of_any_results_are_those_of_their_table(self):
        bone = genu.load(BONE)
        found = bone.run()
        expected = bone.evaluate(found.table())["front.force_N"]
        numpy.testing.assert_array_equal(bone.evaluate(found)["front.force_N"], expected)
        numpy.testing.assert_array_equal(bone.evaluate(found.to_dataframe())["front.force_N"], expected)
        rows = {name: found[name] for name in found.table().keys()}
        failed = {**rows, "status": ["ok"] * (len(found) - 1) + ["no_equilibrium"]}
        self.assertEqual(len(bone.evaluate(failed)), len(found) - 1)

    def test_need_the_factor_of_a_load_that_drives(self):
        text = BONE.read_text()
        driven = genu.parse(text + "\n[load.lift]\nbody = \"bone\"\nforce = [0, 0, 1]\n\n[[step]]\n"
                            'prescribe = { "joint.z" = [-60, -61] }\ndrive = "lift"\nincrements = 2\n', "driven.toml")
        found = driven.run()
        self.assertEqual(found.verdict, "solved")
        q = found.q[-1]
        self.assertIn("factors.lift", str(refusal(lambda: driven.residual(q))))
        left = driven.residual(q, factors={"lift": found["lift.factor"][-1]})
        self.assertLess(abs(left).max(), 1e-8)

    def test_may_be_results(self):
        bone = genu.load(BONE)
        found = bone.run()
        again = bone.evaluate(found.table())
        numpy.testing.assert_allclose(again["front.force_N"], found["front.force_N"], rtol=1e-12)


class Freed(unittest.TestCase):
    def test_scenes_leave_their_results(self):
        results = genu.load(KNEE).run()
        column = results["knee.rotation_deg"]
        kept = column.copy()
        table, events = results.table(), results.events
        del results
        for _ in range(3):
            genu.load(KNEE).run()
        numpy.testing.assert_array_equal(column, kept)
        self.assertGreater(events.rows, 0)
        numpy.testing.assert_array_equal(table["knee.rotation_deg"], kept)
        derivatives = genu.load(KNEE).sensitivity("knee.rotation", "AAC.*").derivatives
        self.assertTrue(numpy.isfinite(derivatives).any())


if __name__ == "__main__":
    unittest.main()
