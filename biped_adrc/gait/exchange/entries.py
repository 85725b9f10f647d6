"""Entries of a file by name: structs, arrays of structs, cells, elements of arrays, and the steps of FROST.

    R.alpha                an entry of a struct, or of an object of JSON
    gait(3).states.x       an entry of one struct of an array, {} of a cell
    p(2), a(2,1), x(1:5,:) elements, counted from 1 and down the columns as in MATLAB

`read_mat` drops dimensions of length 1, but a name may state them: gait(1).x is also the x of a single struct,
and p(1,2) the second number of a row.

FROST (ayonga/frost-dev), a MATLAB program that designs gaits, returns a step from its `exportSolution`, and
users save it as an array of structs or as cells, at any depth of a file:

    gait(1).tspan           t (1, K) [s]
    gait(1).states.x, .dx   q and v, one instant per column, (n + 2, K), the base's position first [m, rad]
    gait(1).params.a..., p  Bezier coefficients, column below column [rad], and their phase at end and start

An impact in such a file has no course over time, so it is not counted as a step. FROST's parameters may run
over a phase that the file does not state, so the gait is taken from the states; only if the user names the
parameters as the gait's coefficients (`names` of `import_gait`) are they taken, over the phase of convention
`frost`.
"""

import re
from collections.abc import Mapping
from typing import Any

import numpy as np
from scipy.io.matlab import mat_struct


def all_entries(x: Any, name: str = "") -> dict[str, Any]:
    """All entries of a file by name: a struct under its own name, and each thing in it as "struct.name".

    x: content of the file, or of the entry `name` of it; "" for the whole file. Structs in "units" and
    "provenance", which name other things, are not taken apart.
    """
    if isinstance(x, mat_struct):
        x = {key: getattr(x, key) for key in x._fieldnames}
    result = {name: x} if name else {}
    inner = dict[str, Any]()
    if isinstance(x, Mapping) and name not in ("units", "provenance"):
        inner = {f"{name}.{key}" if name else key: y for key, y in x.items()}
    # of a list the first element shows whether it holds numbers or other things (dtype object)
    elif np.asarray(x[:1] if isinstance(x, list) else x).dtype == object:
        # a cell or an array of structs, counted from 1
        cells = np.ndenumerate(np.array(x, dtype=object))
        inner = {f"{name}({','.join(str(i + 1) for i in place)})": y for place, y in cells}
    for key, y in inner.items():
        result |= all_entries(y, key)
    return result


def entry(found: Mapping[str, Any], name: str) -> Any:
    """The entry or element of this name, as MATLAB writes it. found: all entries by name, of `all_entries`.

    Raises KeyError or IndexError where the file has none.
    """
    # cells {} are read as (), without blanks; row: (1,k) and (k,1) as (k), as `read_mat` drops such dimensions
    name = name.translate(str.maketrans("{}", "()", " "))
    row = re.sub(r"\((?:1,([\d:]+)|([\d:]+),1)\)", r"(\1\2)", name)
    # the last form leaves out a (1) before a dot or a bracket, since a single struct is no array
    for known in (name, row, re.sub(r"\(1\)(?=[.(])", "", row)):
        element = re.fullmatch(r"(.+)\(([\d,:]+)\)", known)
        if known in found:
            return found[known]
        # an index of 0 does not exist in MATLAB
        if element and element[1] in found and "0" not in (index := element[2].split(",")):
            a = np.asarray(found[element[1]])
            places = tuple(_place(*i.split(":")) for i in index)
            if len(places) == 1:
                return a.ravel(order="F")[places]
            if len(places) == a.ndim:  # else a dimension was dropped, and `row` finds it
                return a[places]
    raise KeyError(name)


def _place(first: str, last: str | None = None) -> int | slice:
    """Index from 0, or slice, for MATLAB's index, divided at its colon: 3 is ("3",), 2:5 is ("2", "5"), the
    whole range ":" is ("", "").
    """
    if last is None:
        return int(first) - 1
    return slice(int(first) - 1 if first else None, int(last) if last else None)


def frost_steps(found: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Entries t, q and v (None where it is missing) of the steps of FROST, by the name of their struct; empty
    if the file has no such step. found: all entries by name, of `all_entries`.
    """
    steps = dict[str, dict[str, Any]]()
    for key, x in found.items():
        # place[1]: the struct's name with its dot; place[2]: "(k)" where states are an array of structs
        place = re.fullmatch(r"(.*?)states(\([\d,]+\))?\.x", key)
        t: Any = found.get(f"{place[1]}tspan{place[2] or ''}", ()) if place else ()
        # an impact has no row of times as long as its states
        if place and np.ndim(t) == 1 and np.shape(x)[1:] == np.shape(t):
            states = key.removesuffix(".x")
            name = states if place[2] else place[1].rstrip(".")
            steps[name] = {"t": t, "q": x, "v": found.get(f"{states}.dx")}
    return steps
