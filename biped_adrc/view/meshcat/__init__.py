"""Walks as one offline HTML page with the viewer Meshcat, which draws three-dimensional scenes in a browser.

    objects    robots, ground, arrows and cameras as Meshcat's commands
    view       the page: scene, samples of the motion and controls

The page's own programs are scene.js and player.js. The server and the window of the Python package meshcat are
not used: its commands are kept in memory and written into the page.
"""
