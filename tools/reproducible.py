"""Archives that are the same, byte for byte, whenever and by whomever they are made of the same files."""

from __future__ import annotations

import gzip
import io
import os
import subprocess
import tarfile
import time
import zipfile
from collections.abc import Mapping
from pathlib import Path

__all__ = ["rewritten_sdist", "rewritten_wheel", "source_date", "write_zip"]

FIRST = 315532800  # 1980: no zip knows an earlier time
PACKED = (".whl", ".gz", ".png", ".webp")


def source_date(repository: Path) -> int:
    """Seconds since 1970 that stand in the archives: SOURCE_DATE_EPOCH, else the last commit's, else those of 1980."""
    given = os.environ.get("SOURCE_DATE_EPOCH")
    if not given:
        command = ["git", "-C", str(repository), "log", "-1", "--format=%ct"]
        try:
            given = subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip()
        except OSError:
            given = ""
    return max(FIRST, int(given or FIRST))


def write_zip(path: Path, files: Mapping[str, bytes], date: int) -> None:
    """A zip of these files, in the order of their names; what is packed already is stored."""
    when = time.gmtime(date)[:6]
    with zipfile.ZipFile(path, "w") as archive:
        for name in sorted(files):
            entry = zipfile.ZipInfo(name, when)
            entry.create_system, entry.external_attr = 3, 0o100644 << 16
            entry.compress_type = zipfile.ZIP_STORED if name.endswith(PACKED) else zipfile.ZIP_DEFLATED
            archive.writestr(entry, files[name], compresslevel=9)


def rewritten_wheel(path: Path, date: int) -> None:
    """The same wheel of ours as another build of the same files would give."""
    with zipfile.ZipFile(path) as archive:
        files = {name: archive.read(name) for name in archive.namelist() if not name.endswith("/")}
    write_zip(path, files, date)


def rewritten_sdist(path: Path, date: int) -> None:
    """The same source distribution as another build of the same files would give: no owner, no time, sorted."""
    with tarfile.open(path) as archive:
        members = sorted((member for member in archive if member.isfile()), key=lambda member: member.name)
        files = [(member.name, archive.extractfile(member).read()) for member in members]
    raw = io.BytesIO()
    with tarfile.open(fileobj=raw, mode="w", format=tarfile.PAX_FORMAT) as archive:
        for name, data in files:
            entry = tarfile.TarInfo(name)
            entry.size, entry.mtime, entry.mode = len(data), date, 0o644
            archive.addfile(entry, io.BytesIO(data))
    path.write_bytes(gzip.compress(raw.getvalue(), mtime=date))
