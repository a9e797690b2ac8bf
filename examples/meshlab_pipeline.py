"""A pymeshlab pipeline with the filter in it: clean, decimate, map, colour by distortion, save.

python examples/meshlab_pipeline.py scan.obj result.ply
python examples/meshlab_pipeline.py                        # makes a surface, leaves meshlab_pipeline.ply
"""

import sys
import tempfile
from pathlib import Path

import pymeshlab

import meshlab_filter
from conformal_uv.samples import mask

TARGET_FACES = 5000


def load(path):
    """A MeshSet with the mesh of a file, or with a generated surface and some dirt."""
    ms = pymeshlab.MeshSet()
    if path is not None:
        ms.load_new_mesh(str(path))
        return ms
    V, F = mask(6000)
    ms.add_mesh(pymeshlab.Mesh(V, [*F.tolist(), F[0].tolist()]), "mask")  # one face stands twice
    return ms


def pipeline(source, target):
    """Write `target` and return the numbers of the map."""
    meshlab_filter.register()
    ms = load(source)

    # Clean: what the map would refuse with the reason.
    ms.meshing_remove_duplicate_faces()
    ms.meshing_remove_duplicate_vertices()
    ms.meshing_remove_unreferenced_vertices()
    ms.meshing_repair_non_manifold_edges()

    # Decimate; the boundary becomes the circle, so it is kept.
    if ms.current_mesh().face_number() > TARGET_FACES:
        ms.meshing_decimation_quadric_edge_collapse(
            targetfacenum=TARGET_FACES, preserveboundary=True, preservetopology=True, preservenormal=True
        )

    # Map, link a checker, and put the angle error of every face where MeshLab colours it.
    with tempfile.TemporaryDirectory() as folder:
        checker = Path(folder) / f"{target.stem}_checker.png"
        meshlab_filter.write_checker(checker)
        numbers = ms.compute_texcoord_parametrization_conformal_disk(quality="angle", texture=checker)
        ms.compute_color_from_scalar_per_face(minval=0.0, maxval=10.0, colormap="Viridis")
        meshlab_filter.save_textured_mesh(ms, target)
    return numbers


def main():
    """Run it from the shell."""
    source = Path(sys.argv[1]) if len(sys.argv) > 1 else None
    target = Path(sys.argv[2]) if len(sys.argv) > 2 else Path("meshlab_pipeline.ply")
    for name, value in pipeline(source, target).items():
        print(f"{name:>24} {value:.6g}")


if __name__ == "__main__":
    main()
