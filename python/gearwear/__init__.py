"""How the flanks of a gear pair wear, and what the wear does to pressure, load sharing and transmission error.

>>> import gearwear
>>> scene = gearwear.Scene.preset("fzg-c").with_(**{"operation.pinion_torque_Nm": 250, "numerics.verify": False})
>>> run = scene.run()
>>> float(run.pinion.wear_um.max()) > 0
True

Names of keys, columns and figures are those of the scene, the CSV files and ``summary.json``; each ends in its unit.
"""

from gearwear._native import VERSION as __version__
from gearwear._native import presets, unit_of
from gearwear.calibration import Calibration
from gearwear.errors import Finding, GearwearError, NotConverged, RunError, SceneError, WornThrough
from gearwear.evaluate import Evaluation, evaluate
from gearwear.fem import FemPair, FemProblem, fem_problem
from gearwear.figures import Figure, main_figures
from gearwear.mesh import Mesh
from gearwear.run import Flank, Run
from gearwear.scene import Scene
from gearwear.schema import scene_schema
from gearwear.stage import PlanetaryStage, StageRun
from gearwear.studies import Study, compare, compare_runs, improve, remaining_life, validate
from gearwear.sweep import Sweep, sweep
from gearwear.table import Table
from gearwear.uncertainty import Uncertainty, uncertainty

__all__ = [
    "Calibration",
    "Evaluation",
    "FemPair",
    "FemProblem",
    "Figure",
    "Finding",
    "Flank",
    "GearwearError",
    "Mesh",
    "NotConverged",
    "PlanetaryStage",
    "Run",
    "RunError",
    "Scene",
    "SceneError",
    "StageRun",
    "Study",
    "Sweep",
    "Table",
    "Uncertainty",
    "WornThrough",
    "__version__",
    "compare",
    "compare_runs",
    "evaluate",
    "fem_problem",
    "improve",
    "main_figures",
    "presets",
    "remaining_life",
    "scene_schema",
    "sweep",
    "uncertainty",
    "unit_of",
    "validate",
]
