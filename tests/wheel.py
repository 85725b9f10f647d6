"""A wheel of the package, built and installed into a folder of its own: robots and gaits are inside.

python tests/wheel.py
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

INSIDE = """
import biped_adrc as ba

assert "site" in ba.__file__, ba.__file__
for preset in ("identified", "identified-bare", "tac2003"):
    biped = ba.Biped.load("rabbit", preset)
    for gait in ("published", "recipe"):
        ba.load_gait(gait, biped)
print("robots and gaits are inside the wheel")
"""

with tempfile.TemporaryDirectory() as name:
    folder, quiet = Path(name), ["--quiet", "--disable-pip-version-check", "--no-deps"]
    pip = [sys.executable, "-m", "pip"]
    subprocess.run([*pip, "wheel", *quiet, "--wheel-dir", name, "."], check=True)
    (wheel,) = folder.glob("*.whl")
    site = str(folder / "site")
    subprocess.run([*pip, "install", *quiet, "--target", site, str(wheel)], check=True)
    subprocess.run(
        [sys.executable, "-c", f"import sys; sys.path.insert(0, {site!r}){INSIDE}"],
        cwd=name,
        check=True,
    )
