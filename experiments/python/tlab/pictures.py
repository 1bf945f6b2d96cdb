"""Pictures: from the sequential renderer and from files."""

import os

from tlab import _native
from tlab.errors import BadInput
from tlab.spelling import plain, whole


def render(scene, size=(100, 100), *, threads=1, linear=False, **options):
    """Renders a scene with the sequential renderer, as `tlab render` does.

    scene: the path of a file, .nff or .obj, or "spheres:N", "hills:N" (triangles), "room:L" (lights)
    size: width and height in pixels
    threads: number of host threads; the picture does not depend on it
    linear: return linear light as float64 in place of 8 bits; 1 is white, and values may exceed it
    options: the options of render_options(), such as depth, min_influence, feelers, pixel_samples

    Returns an array (height, width, 3) of uint8, equal to the PNG that the command writes.
    """
    try:
        width, height = size
    except (TypeError, ValueError):
        raise BadInput(f"size: found {size!r}, expected (width, height)") from None
    if unknown := [name for name in ("width", "height") if name in options]:
        raise BadInput(f"{unknown[0]}: expected it in size=(width, height)")
    options = {name: plain(value) for name, value in options.items()}
    options |= {"width": whole(width, "width"), "height": whole(height, "height")}
    return _native.render(os.fspath(scene), options, whole(threads, "threads"), bool(linear))


def render_options():
    """The options of render(): for each one its unit, meaning, kind, range, choices and default."""
    return {option["name"]: option for option in _native.render_options() if option["name"] not in ("width", "height")}


def read_image(path):
    """Reads any PNG file as an array (height, width, 3) of uint8; transparent pixels are blended with white."""
    return _native.load_picture(os.fspath(path))
