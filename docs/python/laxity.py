"""Anterior laxity of a measured knee with and without its anterior cruciate ligament.

    python3 docs/python/laxity.py [FOLDER]     writes laxity.svg into FOLDER (here, unless given)

1. Read the scene once, with a load along the femur's anterior axis that pulls the tibia.
2. Pull forward and backward by 100 N at flexion angles from 0 to 90 deg, with the ligament and without.
3. Laxity is the tibia's way between the two.
"""
import pathlib
import sys

import genu
from line_chart import line_chart

SCENE = pathlib.Path(__file__).resolve().parents[2] / "meshes" / "lenhart_polynomial" / "scene.toml"
PULL = 100  # N
DRAWER = '\n[load.drawer]\nbody = "tibia"\nforce = [1, 0, 0]\n'  # N, the world's axes: x anterior


def laxity(knee):
    """(flexion in deg, way in mm) at every pose that both pulls have."""
    found = {}
    for pull in (PULL, -PULL):
        knee["drawer.force.x"] = pull
        found[pull] = knee.run()
    poses = min(result.solved for result in found.values())
    forward, backward = (found[pull]["knee.x_mm"][:poses] for pull in (PULL, -PULL))
    return found[PULL]["knee.flexion_deg"][:poses], forward - backward


def main(folder):
    text = SCENE.read_text().replace("increments = 90", "increments = 18")
    intact = genu.parse(text + DRAWER, SCENE)
    cut = intact.without("ACL*")
    flexion, with_acl = laxity(intact)
    flexion_cut, without_acl = laxity(cut)
    poses = min(len(flexion), len(flexion_cut))
    print(f"anterior laxity at +-{PULL} N, mm")
    print("flexion_deg      intact   without ACL")
    for k in range(0, poses, 3):
        print(f"{flexion[k]:11.0f}{with_acl[k]:12.2f}{without_acl[k]:14.2f}")
    lines = {"intact": with_acl[:poses], "without ACL": without_acl[:poses]}
    line_chart(folder / "laxity.svg", flexion[:poses], lines, "flexion [deg]", f"way between +-{PULL} N [mm]")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "."))
