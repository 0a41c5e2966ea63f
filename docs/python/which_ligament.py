"""Which ligament matters most for the rotation of a knee?

    python3 docs/python/which_ligament.py [FOLDER]     writes which_ligament.svg into FOLDER (here, unless given)

1. Solve the knee once and differentiate its internal rotation to every stiffness and reference strain.
2. Rank them by what a standard change (1 % of a stiffness, 0.01 of a strain) does to the rotation.
3. Check the first one: change it, solve again, compare.
"""
import pathlib
import sys

import genu
import numpy
from line_chart import line_chart

SCENE = pathlib.Path(__file__).resolve().parents[2] / "meshes" / "dortmans1984" / "scene.toml"
MOST = 5


def main(folder):
    knee = genu.load(SCENE)
    found = knee.sensitivity("knee.rotation", ["*.stiffness", "*.reference_strain"])
    ranking = found.ranking()
    changes = dict(zip(found.to, found.changes))
    print("largest change of the rotation, deg")
    for name, effect in ranking[:MOST]:
        print(f"{name:24}{effect:9.4f}  by {changes[name]}")
    flexion = found.results["knee.flexion_deg"]
    lines = {name: found.effects[:, 0, found.to.index(name)] for name, _ in ranking[:MOST]}
    line_chart(folder / "which_ligament.svg", flexion, lines, "flexion [deg]", "change of the rotation [deg]")

    name = ranking[0][0]
    step = 0.001  # of strain: a tenth of the standard change
    knee[name] += step
    change = knee.run()["knee.rotation_deg"] - found.results["knee.rotation_deg"]
    predicted = step * found.derivatives[:, 0, found.to.index(name)]
    row = numpy.nanargmax(abs(predicted))
    print(f"{name} + {step}: {predicted[row]:.4f} deg predicted, {change[row]:.4f} deg found at {flexion[row]:.0f} deg")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "."))
