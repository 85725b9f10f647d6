"""Figures 2 and 3 of the paper as block diagrams, drawn from the text of section III.

Run: python docs/diagrams.py
"""

from pathlib import Path

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot as plt
from matplotlib.patches import Circle, FancyBboxPatch, Rectangle

BLUE, ORANGE, GREY, INK = "#0072b2", "#d55e00", "#5a5a5a", "#1a1a1a"
FOLDER = Path(__file__).parent / "diagrams"
plt.rcParams.update(
    {
        "svg.hashsalt": "biped_adrc",
        "svg.fonttype": "path",
        "mathtext.fontset": "cm",
        "font.size": 11,
    }
)


class Diagram:
    """A white canvas of width x height, one unit per quarter of an inch."""

    def __init__(self, width, height):
        self.figure = plt.figure(figsize=(width / 4, height / 4), facecolor="white")
        self.axes = self.figure.add_axes((0, 0, 1, 1))
        self.axes.set(xlim=(0, width), ylim=(0, height), aspect="equal")
        self.axes.axis("off")

    def box(self, x, y, w, h, text, colour=BLUE):
        """A block centred at (x, y)."""
        self.axes.add_patch(
            FancyBboxPatch(
                (x - w / 2, y - h / 2),
                w,
                h,
                boxstyle="round,pad=0,rounding_size=0.3",
                fc="white",
                ec=colour,
                lw=1.8,
                zorder=3,
            )
        )
        self.text(x, y, text)

    def sum(self, x, y):
        """A summing point."""
        self.axes.add_patch(Circle((x, y), 0.45, fc="white", ec=INK, lw=1.5, zorder=3))

    def arrow(self, *points, colour=INK):
        """A line through the points with a head at the end."""
        xs, ys = zip(*points, strict=True)
        self.axes.plot(xs, ys, color=colour, lw=1.4, zorder=2, solid_joinstyle="miter")
        self.axes.annotate(
            "",
            points[-1],
            points[-2],
            arrowprops={
                "arrowstyle": "-|>",
                "color": colour,
                "lw": 1.4,
                "shrinkA": 0,
                "shrinkB": 0,
                "mutation_scale": 14,
            },
            zorder=4,
        )

    def dot(self, x, y):
        """A branching point."""
        self.axes.add_patch(Circle((x, y), 0.14, color=INK, zorder=3))

    def text(self, x, y, text, colour=INK, size=11, **options):
        """Text centred at (x, y)."""
        options = {"ha": "center", "va": "center"} | options
        self.axes.text(x, y, text, color=colour, size=size, zorder=5, **options)

    def frame(self, x, y, w, h, text, colour):
        """A dashed frame from its lower left corner, titled inside its upper left one."""
        self.axes.add_patch(Rectangle((x, y), w, h, fc=colour, alpha=0.05, ec="none", zorder=0))
        self.axes.add_patch(
            Rectangle((x, y), w, h, fc="none", ec=colour, lw=1.2, ls=(0, (5, 3)), zorder=1)
        )
        self.text(x + 0.4, y + h - 0.75, text, colour, ha="left")

    def save(self, name):
        """Write the SVG without a date in it."""
        FOLDER.mkdir(exist_ok=True)
        self.figure.savefig(FOLDER / name, metadata={"Date": None})
        plt.close(self.figure)


def two_loops():
    """Figure 2: reference generation outside, tracking inside."""
    d = Diagram(42, 18)
    d.frame(0.6, 1.0, 40.8, 16.2, "external loop: reference generation", ORANGE)
    d.frame(14.3, 4.6, 26.3, 10.6, "internal loop: tracking", BLUE)
    d.box(6.2, 10, 8.6, 4.2, "virtual constraint\n" + r"$q_d = h(\Theta)$", ORANGE)
    d.box(18.8, 10, 7.4, 4.2, "tracking control\n(20) or (28)")
    d.box(33, 10, 9.6, 4.2, "biped, (1)\nimpact, (8)", GREY)
    d.arrow((10.5, 10), (15.1, 10))
    d.text(12.4, 11.0, r"$q_d,\ \dot q_d,\ \ddot q_d$", size=10.5)
    d.arrow((22.5, 10), (28.2, 10))
    d.text(25.3, 10.9, r"$u$")
    d.arrow((33, 14.4), (33, 12.1))
    d.text(33.7, 13.6, r"$\zeta$  external torques", ha="left")
    d.axes.plot((37.8, 39.6), (10, 10), color=INK, lw=1.4, zorder=2)
    d.dot(39.6, 10)
    d.arrow((39.6, 10), (39.6, 6.2), (18.8, 6.2), (18.8, 7.9))
    d.text(29, 6.95, r"$q_b,\ \dot q_b$  (28)     or     $q_b$  (20)")
    d.dot(39.6, 6.2)
    d.arrow((39.6, 6.2), (39.6, 2.6), (6.2, 2.6), (6.2, 7.9))
    d.text(23, 3.4, r"$q_s,\ \dot q_s\ \rightarrow\ \Theta = q_5 + q_1 + q_3/2$")
    d.save("figure2.svg")


def adrc():
    """Figure 3: PD action on the estimates, disturbance cancelled, GPI observer."""
    d = Diagram(46, 21)
    y = 15
    d.text(1.4, y, r"$q_d$")
    d.text(1.4, y - 4, r"$\dot q_d$")
    d.text(1.4, y + 3.6, r"$\ddot q_d$")
    d.sum(6.4, y)
    d.sum(6.4, y - 4)
    d.box(10.6, y, 3.4, 2.2, r"$K_p$")
    d.box(10.6, y - 4, 3.4, 2.2, r"$K_d$")
    d.sum(16.2, y)
    d.sum(20.2, y)
    d.box(25, y, 4.4, 2.6, r"$\kappa^{-1}(q_s)$")
    d.box(36.4, y, 9.4, 3.6, "biped, (13)\n" + r"$\ddot q_b = \kappa u + \xi$", GREY)
    d.box(28.6, 4.2, 12.4, 3.8, "GPI observer, (17)\n" + r"$m+2$ states per joint", ORANGE)
    d.box(36.4, 9.4, 3.4, 2.2, r"$\kappa(q_s)$")
    d.arrow((2.2, y), (5.95, y))
    d.arrow((2.2, y - 4), (5.95, y - 4))
    d.arrow((2.2, y + 3.6), (16.2, y + 3.6), (16.2, y + 0.45))
    d.arrow((6.85, y), (8.9, y))
    d.arrow((6.85, y - 4), (8.9, y - 4))
    d.arrow((12.3, y), (15.75, y))
    d.arrow((12.3, y - 4), (16.2, y - 4), (16.2, y - 0.45))
    d.arrow((16.65, y), (19.75, y))
    d.arrow((20.65, y), (22.8, y))
    d.axes.plot((27.2, 29.6), (y, y), color=INK, lw=1.4, zorder=2)
    d.arrow((29.6, y), (31.7, y))
    d.text(28.6, y + 0.9, r"$u$")
    d.dot(29.6, y)
    d.arrow((29.6, y), (29.6, 9.4), (34.7, 9.4))
    d.arrow((38.1, 9.4), (39.8, 9.4), (39.8, 5.2), (34.8, 5.2))
    d.text(37.4, 6.0, r"$\kappa u$")
    d.arrow((36.4, y + 4.2), (36.4, y + 1.8))
    d.text(37.1, y + 3.3, r"$\xi$  total disturbance", ha="left")
    d.axes.plot((41.1, 43.4), (y, y), color=INK, lw=1.4, zorder=2)
    d.dot(43.4, y)
    d.arrow((43.4, y), (45.4, y))
    d.text(44.4, y + 0.9, r"$q_b$")
    d.arrow((43.4, y), (43.4, 3.2), (34.8, 3.2))
    d.text(40.6, 2.4, r"$y = q_b$")
    # estimates, back from the observer
    d.arrow((22.4, 5.3), (20.2, 5.3), (20.2, y - 0.45), colour=ORANGE)
    d.text(21.3, 9, r"$\hat\xi=\hat x_3$", ORANGE, ha="left")
    d.arrow((22.4, 4.2), (6.4, 4.2), (6.4, y - 4.45), colour=ORANGE)
    d.text(14, 4.95, r"$\hat x_2$", ORANGE)
    d.arrow((22.4, 3.1), (3.8, 3.1), (3.8, 13), (6.4, 13), (6.4, y - 0.45), colour=ORANGE)
    d.text(14, 2.3, r"$\hat x_1$", ORANGE)
    for x, below in ((6.4, y), (6.4, y - 4), (20.2, y)):
        d.text(x + 0.75, below - 0.95, r"$-$", size=12)
        d.text(x - 0.95, below + 0.65, r"$+$", size=10)
    d.text(16.2 + 0.75, y - 0.95, r"$+$", size=10)
    d.text(16.2 + 0.75, y + 0.95, r"$+$", size=10)
    d.text(16.2 - 0.95, y + 0.65, r"$+$", size=10)
    d.save("figure3.svg")


if __name__ == "__main__":
    two_loops()
    adrc()
