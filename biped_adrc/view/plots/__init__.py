"""Plots on axes of your own: each takes a matplotlib Axes and data, draws, and returns the Axes.

The data are `Signals` (angles, torques, forces over time) of one walk, a mapping of names to `Signals` for
several, or arrays; units are on the axes. Modules: `over_time` for one walk, `zero_dynamics` for a gait
and its rough ground, `study` for many walks. Whole figures made of these plots, and plots of multipliers and of
several controllers side by side, are in `biped_adrc.view.plots.figures`.

Nothing here opens a window or touches pyplot. A plot takes colours from the palette; the package's other
settings are in force inside `with biped_adrc.view.style.new_figure(..) as figure:`.
"""
