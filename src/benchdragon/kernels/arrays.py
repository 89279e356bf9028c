"""Types of the arrays that entries take, which their signatures in C are made from."""

from typing import Annotated

import numpy as np
import numpy.typing as npt

from benchdragon.hosts.signature import Layout

Vector = Annotated[npt.NDArray[np.float64], Layout("d", 1)]
Table = Annotated[npt.NDArray[np.float64], Layout("d", 2)]
Stack = Annotated[npt.NDArray[np.float64], Layout("d", 3)]
IntVector = Annotated[npt.NDArray[np.int64], Layout("q", 1)]
IntTable = Annotated[npt.NDArray[np.int64], Layout("q", 2)]
