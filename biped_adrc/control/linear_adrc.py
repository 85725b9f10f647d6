"""Linear ADRC by two bandwidths: an extended state observer with m = 1, and proportional-derivative action.

    observer poles    s = -w_o, three times
    K_p = w_c^2,   K_d = 2 w_c        closed-loop poles s = -w_c, twice

Gao, Scaling and bandwidth-parameterization based controller tuning, American Control Conference 2003, after
Han, IEEE Trans. Industrial Electronics 56(3), 2009. w_o of 3 to 10 times w_c is usual. It is (20) with
m = 1; its transfer function is that of a filtered PID, from which `npid` tells it apart.
"""

from __future__ import annotations

from biped_adrc.control.adrc import ADRCController
from biped_adrc.control.tracking import TABLE_II, Gains
from biped_adrc.errors import check_positive
from biped_adrc.gait.reference import Reference
from biped_adrc.observers.gpi import GPIObserver


def linear_adrc(
    reference: Reference,
    observer_bandwidth: float = 500.0,
    controller_bandwidth: float | None = None,
) -> ADRCController:
    """ADRC with w_o and w_c [rad/s]; without w_c the gains are those of Table II.

    Raises InputError for a bandwidth that is not positive.
    """
    gains = TABLE_II if controller_bandwidth is None else bandwidth_gains(controller_bandwidth)
    return ADRCController(reference, GPIObserver.from_bandwidth(observer_bandwidth), gains)


def bandwidth_gains(bandwidth: float) -> Gains:
    """K_p = w_c^2 and K_d = 2 w_c for w_c [rad/s]. Raises InputError."""
    check_positive(bandwidth, f"controller bandwidth is {bandwidth} rad/s")
    return Gains(bandwidth**2, 2.0 * bandwidth)
