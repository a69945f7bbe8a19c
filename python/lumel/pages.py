"""Pages of a lightmap."""

import numpy as np
from numpy.typing import NDArray


def cut_page(map: NDArray[np.float32], page: tuple[int, int, int]) -> NDArray[np.float32]:
    """One of Baked.pages: a view (side, side, 4) of the map (height, width, 4), without a copy.

    Coordinates in it: (lightmap × width - (left, top)) / side. Raises ValueError if the page is not inside the map.
    """
    if np.ndim(map) != 3 or np.shape(page) != (3,):
        raise ValueError("cut_page takes a map (height, width, 4) and one of Baked.pages")
    left, top, side = page
    if left < 0 or top < 0 or side < 1 or left + side > map.shape[1] or top + side > map.shape[0]:
        raise ValueError(f"page {page} is not inside a map of the shape {map.shape}")
    return map[top:top + side, left:left + side]
