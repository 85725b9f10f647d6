"""Calls of the command line: a typical one of each command, and wrong ones.

A chain runs in a folder of its own, one call after the other: a call finds the files of those before it.
`study.toml` and `scout.urdf` are there from the beginning.
"""

from __future__ import annotations

from typing import NamedTuple


class Call(NamedTuple):
    """`name` is that of the record, `text` the arguments as in a shell."""

    name: str
    text: str


PUSH = "--push 'q1,q2,q3,q4=30@2:0.1-0.2'"
FAST = "--engine compiled --impacts 3"
SCOUT = "--feet left_leg,right_leg --set tip=0,0,0.7"

CHAINS: dict[str, tuple[Call, ...]] = {
    "walks": (
        Call("adrc", f"simulate {FAST} {PUSH} -o adrc.npz"),
        Call("npd", f"simulate {FAST} {PUSH} --controller NPD -o npd.npz"),
        Call("sampled", f"simulate {FAST} --period 0.001 --torque-limit 150 -o sampled.npz"),
        Call("pinocchio", "simulate --impacts 1 -o one.npz"),
        Call(
            "bandwidth",
            f"simulate {FAST} "
            "--set controller.observer.bandwidth=400 --set controller.observer.order=2 "
            "--set controller.observer.reset=relabel --set hardware.friction=true",
        ),
        Call(
            "printed",
            f"simulate {FAST} --set controller.solve_theta=false --gait v0.8 "
            "--set run.method=exponential --set run.h=0.001",
        ),
        Call(
            "stiff",
            "simulate --engine compiled --impacts 1 "
            "--set run.method=stiff --set controller.observer.poles=-200,-300,-450",
        ),
        Call(
            "adaptive",
            f"simulate {FAST} --controller npd --set run.method=adaptive --preset tac2003",
        ),
        Call(
            "illegal",
            f"simulate {FAST} --controller NPD --set limits.friction=0.3 --end-infeasible",
        ),
        Call("felled", "simulate --engine compiled --torque-limit 5 --impacts 4 --controller NPD"),
        Call("signals", f"simulate {FAST} --controller NPD -o signals.mat"),
        Call("compass", "simulate --robot compass --impacts 3 -o compass.npz"),
        Call("wheel", "simulate --robot rimless_wheel --impacts 2 --set limits.friction=0.5"),
        Call("page", "animate adrc.npz --ghost npd.npz -o walk.html"),
        Call("gif", "animate npd.npz --from 0.5 --to 0.7 --set fps=10 -o walk.gif"),
        Call(
            "apart",
            "animate adrc.npz --ghost npd.npz --set apart=true --set magnify=30 --set fps=5 -o apart.gif",
        ),
        Call("strip", "animate compass.npz -o strip.png"),
        Call("plot tracking", "plot adrc.npz -o tracking.svg"),
        Call("plot comparison", "plot adrc.npz --with npd.npz --figure comparison -o both.svg"),
        Call("plot disturbance", "plot adrc.npz --figure disturbance -o disturbance.png"),
        Call("plot ground", "plot npd.npz --figure ground -o ground.svg"),
        Call("plot energy", "plot compass.npz --figure energy -o energy.svg"),
        Call("plot phase", "plot sampled.npz --with npd.npz --figure phase -o phase.svg"),
    ),
    "gaits": (
        Call("show", "gait show published --preset tac2003"),
        Call("zero", "gait show v0.8 --plot zero.svg"),
        Call("zero with limits", "gait show recipe --set friction=0.5 --set torque=100"),
        Call("export", "gait export v0.8 --convention frost -o frost.mat"),
        Call("export as json", "gait export published --convention tac2003 -o tac.json"),
        Call("import", "gait import frost.mat -o back.json"),
        Call("design", "gait design --speed 0.8 -o fast.json"),
        Call("library", "gait design --speeds 0.5 -o gaits"),
        Call("walk it", "simulate --engine compiled --controller NPD --gait fast.json --impacts 1"),
        Call("poincare compass", "poincare --robot compass"),
        Call("poincare NPD", "poincare --gait v0.8"),
        Call("poincare ADRC", "poincare --controller ADRC --no-observer-states"),
        Call("poincare slope", "poincare --robot simplest --set ground.slope=-0.001"),
    ),
    "studies": (
        Call("robot list", "robot list"),
        Call("robot show", "robot list rabbit --preset tac2003"),
        Call("robot check", f"robot check scout.urdf {SCOUT}"),
        Call("robot new", f"robot new scout.urdf {SCOUT} -o scout"),
        Call(
            "design scout",
            "gait design --robot scout/robot.toml --speed 0.7 --step 0.35 --set limits.clearance=none "
            "-o scout/walk.json",
        ),
        Call(
            "walk scout",
            "simulate --robot scout/robot.toml --gait scout/walk.json --controller NPD --impacts 2 -o s.npz",
        ),
        Call("observer", "observer --bandwidth 500 --order 1 --period 0.0015 -o observer.svg"),
        Call(
            "observer by Table I",
            "observer --set hardware.delay=0.0005 --set hardware.delay_known=true --period 0.0005",
        ),
        Call("study dry", "study study.toml -o study --dry-run"),
        Call("study", "study study.toml -o study --workers 1 --table study.csv"),
    ),
    "wrong": (
        Call("no command", ""),
        Call("unknown command", "fly"),
        Call("unknown option", "simulate --colour red"),
        Call("unknown robot", "simulate --robot roomba"),
        Call("unknown preset", "simulate --preset foo"),
        Call("unknown gait", "simulate --gait foo"),
        Call("unknown controller", "simulate --controller LQR"),
        Call("unknown method", "simulate --set run.method=euler"),
        Call("unknown engine", "simulate --engine steam"),
        Call("unstable pole", "simulate --set controller.observer.poles=-1,2"),
        Call("poles as words", "simulate --set controller.observer.poles=-1,x"),
        Call("push without a window", "simulate --push q1=5"),
        Call("push on no joint", "simulate --push q7=5@1:0-1"),
        Call("negative period", "simulate --period -1"),
        Call("no impacts", "simulate --impacts 0"),
        Call("no step", "simulate --set run.h=0"),
        Call("motors of a compass", "simulate --robot compass --period 0.001"),
        Call("no such run", "animate nowhere.npz"),
        Call("no run", "plot study.toml"),
        Call("out of a wrong kind", "simulate --impacts 1 -o walk.pdf"),
        Call("poincare controller", "poincare --controller pid"),
        Call("poincare slope", "poincare --robot compass --set ground.slope=0.5"),
        Call("reproduce preset", "reproduce --preset foo"),
        Call("gait file", "gait show nowhere.json"),
        Call("design of nothing", "gait design"),
        Call("wrong state", "gait design --set through=1,2,3"),
        Call("convention", "gait export v0.8 --convention mine -o x.json"),
        Call("observer twice", "observer --poles=-100,-200 --bandwidth 300"),
        Call("no study", "study nowhere.toml -o there"),
        Call("wrong study", "study wrong.toml -o there"),
        Call("no urdf", "robot check nowhere.urdf"),
    ),
    "reproduction": (Call("reproduce", "reproduce --out out"),),
}
"""Chains are run in parallel."""

STUDY = """\
name = "a small study"

[base]
run.impacts = 2
hardware.encoders.counts = 8192
hardware.encoders.velocity = "differences"
hardware.torque_limit = "150 N m"
run.max_step_time = 0.9

[grid]
start.q5 = { from = "-3 deg", to = "3 deg", count = 3 }

[cases]
NPD = { controller.name = "NPD" }
ADRC = { controller.name = "ADRC", controller.observer.bandwidth = "500 rad/s", controller.observer.order = 1 }
"""
WRONG_STUDY = """\
name = "wrong"

[base]
run.impact = 2
controller.observer.bandwidth = "500 kg"

[grid]
controller.name = ["LQR"]
hardware.period = [-1.0]
"""
