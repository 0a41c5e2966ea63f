"""Anterior laxity of a knee with and without its anterior cruciate ligament.

    python3 docs/python/laxity.py [FOLDER]     writes laxity.svg into FOLDER (here, unless given)

1. Read the scene once, with a load added that pulls the femur along the tibia's anterior axis.
2. Pull backward and forward by 100 N while the knee flexes from 0 to 70 deg, with the ligament and without.
3. Laxity is the femur's way between the two.
"""
import pathlib
import sys

import genu
from line_chart import line_chart

SCENE = pathlib.Path(__file__).resolve().parents[2] / "meshes" / "dortmans1984" / "scene.toml"
PULL = 100  # N
DRAWER = '\n[load.drawer]\nbody = "femur"\nforce = [0, 1, 0]\n'  # y is anterior


def laxity(knee):
    """Flexion in deg and way in mm at every pose."""
    found = []
    for pull in (PULL, -PULL):
        knee["drawer.force.y"] = pull
        found.append(knee.run())
        assert found[-1].verdict == "solved", found[-1]
    forward, backward = found
    return forward["knee.flexion_deg"], forward["knee.y_mm"] - backward["knee.y_mm"]


def main(folder):
    intact = genu.parse(SCENE.read_text() + DRAWER, SCENE)
    cut = intact.without("?AC")  # AAC and PAC: anterior and posterior fibres
    flexion, with_acl = laxity(intact)
    _, without_acl = laxity(cut)
    print(f"anterior laxity at +-{PULL} N, mm")
    print("flexion_deg      intact   without ACL")
    for k in range(0, len(flexion), 10):
        print(f"{abs(flexion[k]):11.0f}{with_acl[k]:12.2f}{without_acl[k]:14.2f}")
    lines = {"intact": with_acl, "without ACL": without_acl}
    line_chart(folder / "laxity.svg", flexion, lines, "flexion [deg]", f"way between +-{PULL} N [mm]")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "."))
