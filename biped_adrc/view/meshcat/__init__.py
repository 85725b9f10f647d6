"""Walks in Meshcat's viewer, as one offline page.

    objects    robots, ground, arrows and cameras as Meshcat's commands
    view       the page: scene, samples and controls

The page's own programs are scene.js and player.js. meshcat's server and its window are not used: commands are
kept in memory and written into the page.
"""
