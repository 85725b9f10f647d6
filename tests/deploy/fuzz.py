"""Calls of any numbers in any order, through the C under sanitizers, against what its header says of them."""

import math
import platform
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from biped_adrc.deploy.layout import functions
from biped_adrc.deploy.loaded import ERRORS, NOT_MEASURED, OK, compiled

HOLD = 5
"""Of the header."""
SANITIZED = ("-std=c99", "-O1", "-ffp-contract=off", "-fno-sanitize-recover=all")
SANITIZED += ("-fsanitize=address,undefined",)
ODD = [math.nan, math.inf, -math.inf, 5e-324, -5e-324, 1e-310, 2.2e-308, 1e-45, 0.0, -0.0]
ODD += [1e16, -1e20, 3.5e38, 1e155, -1e200, 1.7e308, -1.7e308]
"""Entries that no robot measures: NaN, infinite, denormal and too large, as doubles and as floats."""
DRIVER = r"""
#include <stdio.h>
#include <string.h>
#include "controller.h"
#ifdef FLUSH
#include <xmmintrin.h>
#endif
int main(void)
{
  controller_state x, before;
  controller_measurement m;
  CONTROLLER_REAL u[CONTROLLER_P];
  char kind;
  double v;
  int i, flag, same;
#ifdef FLUSH
  _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
  memset(&x, 0xff, sizeof x);
  while (scanf(" %c %lf", &kind, &m.t) == 2) {
    for (i = 0; i < CONTROLLER_N; ++i) if (scanf("%lf", &m.q[i]) != 1) return 1;
    for (i = 0; i < CONTROLLER_N; ++i) {
      if (scanf("%lf", &v) != 1) return 1;
      m.v[i] = (CONTROLLER_REAL)v;
    }
    for (i = 0; i < CONTROLLER_P; ++i) u[i] = 0;
    memcpy(&before, &x, sizeof x);
    if (kind == 'i') flag = controller_init(&x, &m);
    else if (kind == 't') flag = controller_touchdown(&x, &m);
    else flag = controller_step(&x, &m, u);
    before.without = x.without;
#ifdef FRESH
    if (kind == 's') before.fresh[0] = x.fresh[0];
#endif
    same = memcmp(&before, &x, sizeof x) == 0;
    printf("%d %d", flag, same);
    for (i = 0; i < CONTROLLER_P; ++i) printf(" %a", (double)u[i]);
    printf("\n");
  }
  return 0;
}
"""
"""Reads calls and prints flag, whether the state but `without` and `fresh` is as before, and torque."""


def program(source, folder, flags=SANITIZED, flush=False):
    """The program of a source, in a folder; flush: with denormals as zero, where the processor has that."""
    for name, text in {**source.files, "driver.c": DRIVER}.items():
        (Path(folder) / name).write_text(text)
    if flush and platform.machine() in ("x86_64", "AMD64"):
        flags = (*flags, "-DFLUSH")
    if any(field.name == "fresh" for field in source.fields):
        flags = (*flags, "-DFRESH")
    out = Path(folder) / "driver"
    compiled(Path(folder), ["driver.c", "controller.c"], out, flags)
    return out


def answers(path, calls):
    """Flags (K,), whether the state is as before (K,), and torques (K, p), of calls (kind, t, q, v)."""
    lines = [" ".join([c[0], *map(repr, map(float, (c[1], *c[2], *c[3])))]) for c in calls]
    done = subprocess.run(
        [path], input="\n".join(lines), capture_output=True, text=True, check=True, timeout=120
    )
    rows = [line.split() for line in done.stdout.splitlines()]
    assert len(rows) == len(calls), done.stderr
    u = np.array([[float.fromhex(x) for x in row[2:]] for row in rows])
    return [int(row[0]) for row in rows], [row[1] == "1" for row in rows], u


def odd_calls(calls, number, random):
    """Recorded calls in any order and of any kind, entries of which are odd; init is the first."""
    made = []
    for _ in range(number):
        call = calls[random.integers(len(calls))]
        values = np.concatenate(([call.t], call.q, call.v))
        count = random.choice([0, 1, 2, len(values)], p=[0.3, 0.4, 0.2, 0.1])
        values[random.permutation(len(values))[:count]] = random.choice(ODD, count)
        n = len(call.q)
        kind = "ist"[random.choice(3, p=[0.04, 0.9, 0.06])] if made else "i"
        made.append((kind, values[0], values[1 : n + 1], values[n + 1 :]))
    return made


def check_contract(computer, source, calls, found, real):
    """Kinds of calls with flags that came; AssertionError for an answer that is not as the header says."""
    walker, rates = computer.walker, list(functions(computer).rates)
    strongest = min(walker.torque_limit or math.inf, float(computer.alone.bounds.strongest))
    sent, without, seen = np.zeros(source.p), HOLD, set()
    for call, flag, same, u in zip(calls, *found, strict=True):
        kind, t, q, v = call
        read = np.asarray(v, real)[... if kind == "i" else rates]
        finite = np.all(np.isfinite(np.concatenate(([t], q, read))))
        assert (flag == NOT_MEASURED) == (not finite), call
        assert flag in (OK, *ERRORS)
        seen.add((kind, flag))
        if kind == "i":
            sent, without = np.zeros(source.p), HOLD * (flag != OK)
        elif kind == "t":
            assert flag == OK or same
            sent = sent[walker.swap] if flag == OK else sent
        elif flag == OK:
            assert np.all(np.abs(u) <= strongest), call
            sent, without = u, 0
        else:
            assert same or without == HOLD, call
            sent = sent if without < HOLD else np.zeros(source.p)
            without = min(without + 1, HOLD)
            assert np.array_equal(u, sent), call
    return seen


def attack(computer, source, calls, number, seed=0, real="float64"):
    """Odd calls, then recorded ones from init on, which have the torques that they have alone.

    Kinds of calls with flags that came; AssertionError for what is not as it should be.
    """
    good = [(c.kind[0], c.t, c.q, c.v) for c in calls]
    odd = odd_calls(calls, number, np.random.default_rng(seed))
    kind = {"float64": "double", "float32": "float"}[real]
    with tempfile.TemporaryDirectory() as folder:
        path = program(source, folder, (*SANITIZED, f"-DCONTROLLER_REAL={kind}"))
        found, alone = answers(path, odd + good), answers(path, good)
    assert found[0][number:] == alone[0]
    assert np.array_equal(found[2][number:], alone[2])
    with np.errstate(over="ignore"):
        return check_contract(computer, source, odd + good, found, real)
