"""Which observer does a robot allow? Delay margins, one encoder count, and a walk that has the last word.

Run: python examples/observer_design.py
"""

import biped_adrc as ba
from biped_adrc.analysis.observer.check import DelayCase, check_encoders
from biped_adrc.analysis.observer.report import observer_report

PERIOD, COUNTS = 1.5e-3, 8192  # [s], per revolution: RABBIT's

biped = ba.Biped.load("rabbit")
gait = ba.load_gait("published", biped)
observers = [
    ba.GPIObserver.from_poles(),  # Table I
    ba.GPIObserver.from_bandwidth(500.0, m=1),
    ba.GPIObserver.from_bandwidth(150.0, m=1),
]

for observer in observers:
    report = observer_report(observer, period=PERIOD, counts=COUNTS, robot=biped, gait=gait)
    print(report.verdict)
    walked = check_encoders(biped, gait, observer, period=PERIOD, counts=COUNTS)
    print(f"  a walk with these encoders: {walked.status.name}")

    case = DelayCase(biped, gait, observer)
    print(f"  delay margin {1e6 * case.margin:.4g} us; a torque so much late:")
    for share in (0.95, 1.05):
        late = case.walked(share * case.margin)
        tracks = "tracks" if late.tracks else "diverges"
        print(f"    {share:.2f} of it {tracks}, largest error {late.errors.max():.2g} rad")

print("largest bandwidths that RABBIT allows:")
for r in report.recommended:
    print(f"  m = {r.m}: {r.bandwidth:5.0f} rad/s, limited by {r.because}")

# To try: how many counts per revolution would let Table I run, and how short a period? Is there any?
