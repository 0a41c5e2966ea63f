"""genu: the poses in which an articular joint balances, with certificates, stability and error bars.

    import genu
    knee = genu.load("knee.toml")
    knee["AAC.stiffness"] *= 0.5
    found = knee.run()
    found["knee.rotation_deg"]          # numpy, one number a pose
    knee.without("PAC").run().verdict
"""
from genu._genu import (
    Laxity,
    MeshCheck,
    MeshFinding,
    Number,
    Problem,
    Results,
    Scene,
    SceneError,
    Sensitivity,
    Table,
    __version__,
    load,
    mesh_check,
    new,
    parse,
)
from genu import _show

Table.to_dataframe = _show.to_dataframe
Table.__repr__ = _show.table_text
Table._repr_html_ = _show.table_html
Results.to_dataframe = lambda self: self.table().to_dataframe()
Results.to_dataframe.__doc__ = "The columns of table() as a pandas.DataFrame."
Results.__repr__ = _show.results_text
Results._repr_html_ = _show.results_html
Scene.__repr__ = _show.scene_text
Scene._repr_html_ = _show.scene_html
Sensitivity.ranking = _show.ranking
MeshCheck.__repr__ = _show.mesh_text

__all__ = [
    "Laxity",
    "MeshCheck",
    "MeshFinding",
    "Number",
    "Problem",
    "Results",
    "Scene",
    "SceneError",
    "Sensitivity",
    "Table",
    "load",
    "mesh_check",
    "new",
    "parse",
]
