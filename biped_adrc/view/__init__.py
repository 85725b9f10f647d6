"""Pictures of walks and results: figures, animations in Meshcat, moving pictures, pages.

    plots/            matplotlib: curves on the user's axes, and whole figures made of them
    from_the_side/    the robot in its sagittal plane: with its coordinates, strips of stick figures, GIFs
    meshcat/          the robot in the browser, by the 3D viewer Meshcat: one offline page
    pages             HTML pages
    placement, style, export    what these share

Everything becomes a figure, bytes or a file; no window is opened and pyplot's global state is not
used. The data are a walk (`Drawable`: walker, trajectory and signals), or plain summaries.
A node is an instant at which the state of a walk is stored, an arc of a trajectory one single support.
The studies and the reproduction of the paper import this folder; it knows nothing of them.
"""
