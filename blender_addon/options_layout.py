"""The options of an unwrap as rows, wherever they are shown: redo panel, sidebar, dialog."""

from conformal_uv.options import MarginMethod

from .properties import SHOWN, SHOWN_FOR_ALL


def draw_options(layout, chosen, *, with_shape=True):
    """Draw those options that mean something for the shape; `chosen` has them as properties."""
    layout.use_property_split = True
    layout.use_property_decorate = False
    first = ("shape", *SHOWN[chosen.shape]) if with_shape else SHOWN[chosen.shape]
    for names in (first, *SHOWN_FOR_ALL):
        column = layout.column()
        for name in names:
            if means_something(name, chosen):
                column.prop(chosen, name)
        layout.separator(factor=0.5)


def means_something(name, chosen):
    """Whether an option counts beside the others: an image's size where the margin is counted on one."""
    return name != "image_size" or chosen.margin_method == MarginMethod.PIXELS.name
