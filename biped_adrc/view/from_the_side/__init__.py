"""The robot in its sagittal plane, drawn by matplotlib: one posture, strips of stick figures, moving pictures.

`side_view` turns a walk into lines in the x-z plane; `moving_picture` draws them, as strips too, with
the parts of a picture in `moving_parts`. `check_figure` draws one posture with its coordinates.
"""
