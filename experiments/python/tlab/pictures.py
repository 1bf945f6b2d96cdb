"""Pictures: the sequential renderer, and files."""

import os

from tlab import _native
from tlab.errors import BadInput
from tlab.spelling import plain, whole


def render(scene, size=(100, 100), *, threads=1, linear=False, **options):
    """Renders a scene with the sequential renderer, as `tlab render` does.

    scene: the path of a file, .nff or .obj, or "spheres:N", "hills:N" (triangles), "room:L" (lights)
    size: width and height in pixels
    threads: of the host; the picture does not depend on them
    linear: give sums of light as float64, where 1 is white and there may be more, in place of 8 bits
    options: those of render_options(), such as depth, min_influence, feelers, pixel_samples

    Gives an array (height, width, 3) of uint8, equal to the PNG that the command writes.
    """
    try:
        width, height = size
    except TypeError:
        raise BadInput(f"size: found {size!r}, expected (width, height)") from None
    if unknown := [name for name in ("width", "height") if name in options]:
        raise BadInput(f"{unknown[0]}: expected it in size=(width, height)")
    options = {name: plain(value) for name, value in options.items()}
    options |= {"width": whole(width, "width"), "height": whole(height, "height")}
    return _native.render(os.fspath(scene), options, whole(threads, "threads"), bool(linear))


def render_options():
    """What render() can be told: for each option its unit, meaning, kind, range, choices and default."""
    return {option["name"]: option for option in _native.render_options() if option["name"] not in ("width", "height")}


def read_image(path):
    """A PNG file of any kind as an array (height, width, 3) of uint8, on white where it is transparent."""
    return _native.load_picture(os.fspath(path))
