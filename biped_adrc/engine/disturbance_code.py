"""The laws of disturbances as machine code: `void f(double* K, double* inp, double* out)`.

inp is (t, step, t_start, q, v), out zeta (n,) or the force (2,). A law's `active` is looked at first: where it
is not above 0, out is zero and the rest is not computed.
"""

from __future__ import annotations

from typing import Any

from biped_adrc.disturbances.base import DisturbanceLaw
from biped_adrc.engine.equations import Function, count
from biped_adrc.engine.fingerprint import hash_of, law_text, skeleton, versions_text
from biped_adrc.engine.ir import module_text
from biped_adrc.engine.machine import Machine, Text, remembered
from biped_adrc.engine.program import NotCompiled
from biped_adrc.engine.symbols import Tracer, Untraceable, Vector, column, run

GUARDED = """
define void @{name}(ptr %K, ptr %inp, ptr %out) nounwind {{
  %flag = alloca double
  call void @active(ptr %K, ptr %inp, ptr %flag)
  %a = load double, ptr %flag
  %acts = fcmp ogt double %a, 0.0
  br i1 %acts, label %act, label %rest
act:
  call void @{name}_acting(ptr %K, ptr %inp, ptr %out)
  ret void
rest:
  call void @llvm.memset.p0.i64(ptr %out, i8 0, i64 {bytes}, i1 false)
  ret void
}}
"""


def disturbance_code(law: DisturbanceLaw, n: int) -> Machine:
    """With the functions `torque` and, where there is one, `resultant`. Raises NotCompiled."""
    parts = {"torque": (law.torque, n), "resultant": (law.resultant, 2)}
    given = {name: part for name, part in parts.items() if part[0] is not None}
    texts = [law_text(part[0]) for part in given.values()]
    texts += [law_text(law.active), skeleton(law.parameters), versions_text()]
    key = hash_of("disturbance", n, *given, *texts)
    try:
        return remembered(key, list(given), lambda: _text(law, given, n))
    except Untraceable as error:
        raise NotCompiled(f"{error}; the run goes on in Python on the compiled plant") from error


def _text(law: DisturbanceLaw, parts: dict[str, Any], n: int) -> Text:
    if law.active is None:
        return Text(module_text({name: _function(law, f, n) for name, (f, _) in parts.items()}))
    functions = {"active": _function(law, law.active, n, timed=True)}
    functions |= {f"{name}_acting": _function(law, f, n) for name, (f, _) in parts.items()}
    guarded = [GUARDED.format(name=name, bytes=8 * size) for name, (_, size) in parts.items()]
    clear = "declare void @llvm.memset.p0.i64(ptr, i8, i64, i1)"
    return Text("\n".join([module_text(functions), clear, *guarded]))


def _function(law: DisturbanceLaw, part: Any, n: int, timed: bool = False) -> Function:
    K, inp = Vector("K", count(law.parameters)), Vector("inp", 3 + 2 * n)
    k, at = K.like(law.parameters), (inp.take(), inp.take(), inp.take())
    state = () if timed else (inp.take(n), inp.take(n))
    return Function(K.symbol, inp.symbol, column(run(Tracer(), part, k, *at, *state)))
