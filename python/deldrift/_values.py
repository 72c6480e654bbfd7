"""Values by vertex id: given, entered for new vertices, and kept through a compaction."""

from __future__ import annotations

from typing import Any, Callable, Mapping, Optional, Sequence, Union

import numpy as np

from ._errors import InvalidShape, WrongCount

Values = Union[np.ndarray, dict[str, np.ndarray], None]


def given_values(values: Any, taken: Callable[[str, Any], np.ndarray]) -> dict[str, np.ndarray]:
    """An array, or several by name, by what messages call them."""
    if values is None:
        return {}
    is_one = not isinstance(values, Mapping)
    named = {"values": values} if is_one else {f"values[{name!r}]": one for name, one in values.items()}
    given = {name: taken(name, one) for name, one in named.items()}
    for name, array in given.items():
        if array.ndim == 0:
            raise InvalidShape(f"{name} is a single number, and must have an entry for each id", name)
    return given


def as_given(values: Any, arrays: Sequence[np.ndarray]) -> Values:
    """Arrays in the form in which values were given."""
    if values is None:
        return None
    return dict(zip(values, arrays)) if isinstance(values, Mapping) else arrays[0]


def expect(argument: str, array: Optional[np.ndarray], count: int, entries: str) -> None:
    """Whether an array has so many entries."""
    if array is not None and len(array) != count:
        raise WrongCount(
            f"{argument} has {len(array)} entries, and there are {count} {entries}", argument, None, len(array)
        )


def entered(values: np.ndarray, ids: np.ndarray, new: np.ndarray) -> np.ndarray:
    """Values by id with those of new vertices, whose ids ascend; those that are not below the others follow them."""
    n_more = max(int(ids[-1]) + 1 - len(values), 0) if len(ids) else 0
    all_values = np.concatenate([values, np.zeros((n_more, *new.shape[1:]), new.dtype)])
    all_values[ids] = new
    return all_values
