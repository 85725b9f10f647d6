"""Pictures of walks and results: figures, animations in Meshcat, moving pictures, pages.

    plots/            matplotlib: curves on the user's axes, and whole figures made of them
    from_the_side/    the robot in its sagittal plane: figure 1, strips of stick figures, GIFs
    meshcat/          the robot in the browser: one offline page, or live from this process
    pages             HTML pages
    placement, style, export    what these share

Everything becomes a figure, bytes or a file; no window is opened and pyplot's global state is not
used. The data are a walk (`Drawable`: walker, trajectory and signals), or plain summaries.
A node is an instant at which the state of a walk is stored, an arc of a trajectory one single support.
Studies and paper import this folder; it knows nothing of them.
"""
