"""Dynamics of the plant: inertia, bias, impact and their derivatives, all in the paper's coordinates.

Numbers in parentheses, as (1), are those of equations in the paper.

- `biped`       the planar biped, made of a robot's record and its two Pinocchio models
- `robots`      URDF and record of a robot; `robot_import` a robot from a URDF alone
- `ground`      slopes, steps and stones; what ground and motors can give, within which a walk is feasible
- `pinned`      single support: the tree pinned at the stance foot, its inertia matrix and bias in (1)
- `contact`     double support: the floating tree and the plastic impact (2)-(9)
- `reduction`   the actuated joints alone (11)-(15): gain of the torques and total disturbance
- `planar`      points of the robot in closed form; `planar_robot` all of the dynamics, for numbers and symbols
- `derivatives` of accelerations and of the impact with respect to the state
- `physical`    checks of the numbers of a robot read from a file
- `model_errors` relative errors of masses, COMs, inertias and friction

Time, controllers and simulation are in other folders of the package, such as `closed_loop` and `engine`, which
use this one.
"""

from importlib.util import find_spec

from biped_adrc.core.errors import InputError


def _check_pinocchio() -> None:
    """Raise InputError where `import pinocchio` fails or finds another package than Pinocchio 4, the library.

    Another package of this name, a plugin of the test runner nose, exists.
    """
    spec = find_spec("pinocchio")
    try:
        import pinocchio

        version = getattr(pinocchio, "__version__", "unknown")
        # found: what is wrong, empty where the version is right
        found = "" if version.split(".")[0] == "4" else f"version {version}"
    except ImportError as error:
        found = str(error)
    if found:
        raise InputError(
            f"'import pinocchio' finds {spec and spec.origin}: {found}; expected Pinocchio 4, which is 'pip "
            "install pin'. Try 'pip uninstall pinocchio' (a plugin of nose) and a shell without PYTHONPATH and "
            "LD_LIBRARY_PATH, which a sourced ROS sets, or 'pip install --force-reinstall pin'"
        )


_check_pinocchio()
