"""Extended observers, which estimate the total disturbance of each joint; a file for each choice of gains."""
