"""Time of a run with another stiffness, in memory, its columns read from Python included.

    python3 docs/python/speed.py [RUNS [SCENE [NUMBERS]]]     200 runs of the simplified knee with another AAC.stiffness

Prints the least and the median time of a run: what other programs take from this one only makes a run longer.
Of the measured knee with cartilage: speed.py 20 meshes/lenhart2015/scene-cartilage.toml "ACL*.stiffness"
"""
import pathlib
import statistics
import sys
import time

import genu

KNEE = pathlib.Path(__file__).resolve().parents[2] / "meshes" / "dortmans1984" / "scene.toml"


def times(scene, numbers, runs):
    """Seconds of each run."""
    before = scene[numbers]
    taken = []
    for k in range(runs):
        begin = time.perf_counter()
        scene[numbers] = before * (1 + 1e-4 * (k + 1))
        found = scene.run()
        assert found[scene.coordinates[1] + "_deg"].size == found.table().rows
        taken.append(time.perf_counter() - begin)
    return taken


def main():
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    scene = genu.load(sys.argv[2] if len(sys.argv) > 2 else KNEE)
    taken = times(scene, sys.argv[3] if len(sys.argv) > 3 else "AAC.stiffness", runs)
    print(f"{runs} runs: {1e3 * min(taken):.2f} ms at least, {1e3 * statistics.median(taken):.2f} ms in the middle")


if __name__ == "__main__":
    main()
