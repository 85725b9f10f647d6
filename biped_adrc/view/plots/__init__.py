"""Plots on axes of your own: each takes a matplotlib Axes and data, draws, and returns the Axes.

The data are `Signals` of one walk, a mapping of names to `Signals` for several, or arrays; units
are on the axes. Modules: `over_time` for one walk, `comparison` for controllers side by side,
`stability` for return maps. Whole figures made of these plots are in
`biped_adrc.view.plots.figures`.

Nothing here opens a window or touches pyplot. A plot takes colours from the palette; the package's
other settings are in force inside `with biped_adrc.view.style.style():`.
"""

from biped_adrc.view.plots.comparison import error_over_time as error_over_time
from biped_adrc.view.plots.comparison import error_sizes as error_sizes
from biped_adrc.view.plots.comparison import torque_sizes as torque_sizes
from biped_adrc.view.plots.over_time import angles as angles
from biped_adrc.view.plots.over_time import energy as energy
from biped_adrc.view.plots.over_time import friction_cone as friction_cone
from biped_adrc.view.plots.over_time import ground_reaction as ground_reaction
from biped_adrc.view.plots.over_time import joint_tracking as joint_tracking
from biped_adrc.view.plots.over_time import matched_disturbance as matched_disturbance
from biped_adrc.view.plots.over_time import phase_portrait as phase_portrait
from biped_adrc.view.plots.over_time import torques as torques
from biped_adrc.view.plots.over_time import total_disturbance as total_disturbance
from biped_adrc.view.plots.over_time import tracking_errors as tracking_errors
from biped_adrc.view.plots.stability import magnitudes as magnitudes
from biped_adrc.view.plots.stability import multipliers as multipliers
from biped_adrc.view.plots.stability import staircase as staircase
