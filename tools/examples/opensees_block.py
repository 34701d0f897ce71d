"""A free-standing rigid block in OpenSees, for compare_opensees.py: a stiff column with large displacements on a base
that resists compression only, see Setting.contact."""

import typing

import numpy as np

WIDTH, HEIGHT, DENSITY, GRAVITY = 0.5, 2.0, 2500.0, 9.81  # [m], [m], [kg/m3], [m/s2]; the block is 1 m deep
MASS = DENSITY * WIDTH * HEIGHT  # [kg]
FALLEN = 1.2  # tilt at which an analysis ends; no motion of this study would turn the block back [rad]
RIGID = 1e3  # stiffness of the members over that of the contact [1]


class Setting(typing.NamedTuple):
    """Choices of an OpenSees user."""

    name: str
    time_step: float = 1e-3  # [s]
    stiffness: float = 1e9  # of the contact at each corner, or half of that of the base [N/m]
    damping: float = 0.1  # ratio in the first mode of the block in full contact [1]
    initial: bool = False  # whether damping is proportional to the initial, not the current, stiffness
    integrator: tuple = ("Newmark", 0.5, 0.25)
    tolerance: float = 1e-8  # norm of the last increment of displacement [m, rad]
    contact: str = "sliders"  # at the corners: the block turns about them. Or "springs" at the corners or "fibres" all
    # over the base, with its middle held: the block turns about a corner that slides towards the middle
    fibres: int = 0


def build_model(ops, setting):
    """A stiff corotational column with the mass and rotary inertia of the block at its centre; and its contact."""
    k = setting.stiffness
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.node(1, 0.0, 0.0)
    ops.node(2, 0.0, HEIGHT / 2)
    ops.mass(2, MASS, MASS, MASS * (WIDTH ** 2 + HEIGHT ** 2) / 12)
    ops.geomTransf("Corotational", 1)
    ops.element("elasticBeamColumn", 1, 1, 2, 1.0, RIGID * k, 1.0, 1)
    if setting.contact == "fibres":  # sections of 1 m depth that resist compression only; no sliding
        ops.node(10, 0.0, 0.0)
        ops.fix(10, 1, 1, 1)
        ops.equalDOF(10, 1, 1)
        ops.uniaxialMaterial("ENT", 1, 2 * k / WIDTH)
        ops.section("Fiber", 1)
        ops.patch("rect", 1, setting.fibres, 1, -WIDTH / 2, -0.5, WIDTH / 2, 0.5)
        ops.element("zeroLengthSection", 2, 10, 1, 1, "-orient", 0, 1, 0, -1, 0, 0, "-doRayleigh", 1)
        return
    ops.uniaxialMaterial("ENT", 1, k)
    ops.uniaxialMaterial("Elastic", 2, k)
    ops.uniaxialMaterial("Elastic", 3, 0.0)
    ops.frictionModel("Coulomb", 1, 100.0)  # the block does not slide
    for corner, x in ((3, -WIDTH / 2), (4, WIDTH / 2)):
        ground = corner + 10
        ops.node(corner, x, 0.0)
        ops.node(ground, x, 0.0)
        ops.fix(ground, 1, 1, 1)
        ops.element("elasticBeamColumn", corner, 1, corner, 1.0, RIGID * k, 1.0, 1)
        if setting.contact == "springs":
            ops.element("zeroLength", ground, ground, corner, "-mat", 1, "-dir", 2, "-doRayleigh", 1)
        else:
            ops.element("flatSliderBearing", ground, ground, corner, 1, k, "-P", 2, "-Mz", 3,
                        "-orient", 0, 1, 0, -1, 0, 0, "-doRayleigh")
    if setting.contact == "springs":
        ops.fix(1, 1, 0, 0)  # the middle of the base does not slide


def prepare_analysis(ops, tolerance, integrator, kind):
    ops.wipeAnalysis()
    ops.constraints("Transformation")
    ops.numberer("Plain")
    ops.system("BandGeneral")
    ops.test("NormDispIncr", tolerance, 50, 0)
    ops.algorithm("KrylovNewton")
    ops.integrator(*integrator)
    ops.analysis(kind)


def advance(ops, step, refinements=2):
    """Returns whether a step [s] converges, or ten shorter ones instead of it, each of which may be divided again."""
    return ops.analyze(1, step) == 0 or (
        refinements > 0 and all(advance(ops, step / 10, refinements - 1) for _ in range(10)))


def analyse(ops, setting, acceleration, sample_step, end):
    """Returns the tilt [rad] at every step until the end [s] or the fall, and whether the analysis converged.

    acceleration: of the ground [g], linear between samples every sample_step [s]."""
    build_model(ops, setting)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(2, 0.0, -MASS * GRAVITY, 0.0)
    prepare_analysis(ops, 1e-12, ("LoadControl", 0.1), "Static")
    if ops.analyze(10):
        raise RuntimeError(f"{setting.name}: the analysis under the weight of the block failed")
    ops.loadConst("-time", 0.0)
    factor = 2 * setting.damping / np.sqrt(ops.eigen(1)[0])
    ops.rayleigh(0.0, 0.0 if setting.initial else factor, factor if setting.initial else 0.0, 0.0)
    ops.timeSeries("Path", 2, "-dt", sample_step, "-values", *map(float, acceleration), "-factor", GRAVITY)
    ops.pattern("UniformExcitation", 2, 1, "-accel", 2)
    prepare_analysis(ops, setting.tolerance, setting.integrator, "Transient")
    tilt = [0.0]
    for _ in range(round(end / setting.time_step)):
        if not advance(ops, setting.time_step):
            return np.array(tilt), False
        tilt.append(-ops.nodeDisp(2, 3))
        if abs(tilt[-1]) > FALLEN:
            break
    return np.array(tilt), True
