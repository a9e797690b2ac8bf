"""Which file each input becomes."""

from __future__ import annotations

from pathlib import Path

from conformal_uv import FileFormatError, OptionError

from .formats import UV_FORMATS, check_target

__all__ = ["output_files"]


def output_files(sources: list[Path], target: Path, suffix: str | None) -> list[Path]:
    """A file for each of the sources.

    A folder gets files of the inputs' names, with `suffix`, or else .ply for .ply and .obj for all others.

    Raises
    ------
    OptionError
        Several inputs for one file, or for files of one name.
    FileFormatError
        A file can not be written, or would lose texture coordinates.
    """
    if suffix is not None and (suffix := "." + suffix.lower().removeprefix(".")) not in UV_FORMATS:
        raise FileFormatError(f"--format {suffix}: would lose texture coordinates; use {', '.join(UV_FORMATS)}")
    if not target.is_dir():
        if len(sources) > 1:
            raise OptionError(f"{len(sources)} inputs need an existing folder as OUT; {target} is none.")
        if suffix is not None:
            raise OptionError(f"--format is for a folder as OUT; {target} has its own suffix.")
        return [check_target(target)]
    files: dict[Path, Path] = {}
    for source in sources:
        own = ".ply" if source.suffix.lower() == ".ply" else ".obj"
        file = check_target(target / (source.stem + (suffix or own)))
        if file in files:
            raise OptionError(f"{files[file]} and {source} would both become {file}; map them one by one.")
        files[file] = source
    return list(files)
