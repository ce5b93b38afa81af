#!/usr/bin/env python3
"""Holds the direction of dependence between the folders of src/ and the single home of each third-party library.

    scripts/check_layers.py [SRC]

Reads the #include lines alone. Prints one line for each offence; exit code 1 if there is one.
"""

import pathlib
import re
import sys

# What each folder may include; "" is src/ itself, the commands.
MAY_INCLUDE = {
    "spectral": {"spectral"},
    "core": {"spectral", "core"},
    "integrator": {"spectral", "core", "integrator"},
    "optimize": {"spectral", "optimize"},
    "": {"spectral", "core", "integrator", "optimize", ""},
}
FOR_EVERYBODY = {"atomic_file.h", "error.h", "file_ending.h", "input_file.h"}

# Third-party headers and the files (relative to src/) that may include them, both as patterns.
HOMES = {
    r"embree[34]/.*": r"core/accel(_tree|_crossings)?\..*",
    r"OpenImageIO/.*": r"core/(image_io|texture)\..*",
    r"tiny_gltf\.h": r"core/gltf/.*",
    r"nlopt\.h(pp)?": r"optimize/descent\..*",
    r"CLI/.*": r"(main\.cpp|command_line(_[a-z]+)?\..*)",
    r"(tbb|oneapi)/.*": r"((optimize|core|integrator)/.*|main\.cpp)",
    r"nlohmann/.*": r"(spectral/.*\.cpp|core/gltf/.*|[^/]*)",
    r"pugixml\.hpp": r"spectral/.*\.cpp",
    r"fmt/.*": r".*\.cpp",
}
STANDARD = re.compile(r"^[a-z_0-9]+$|^(unistd|fcntl|malloc|immintrin|xmmintrin|pmmintrin)\.h$|^sys/[a-z]+\.h$")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def folder_of(path):
    return path.parts[0] if len(path.parts) > 1 else ""


def check_own(source, header, root):
    """An #include "…" of ours: relative to src/, there, and not against the direction."""
    if not (root / header).is_file():
        return f'"{header}" is not in src/'
    if header in FOR_EVERYBODY:
        return None
    here, there = folder_of(source), folder_of(pathlib.PurePath(header))
    if here not in MAY_INCLUDE:
        return f"the folder {here}/ is not known"
    if there not in MAY_INCLUDE[here]:
        return f'{here}/ may not include "{header}"'
    return None


def check_foreign(source, header):
    """An #include <…>: of the standard, or of a library that is at home in this file."""
    if STANDARD.match(header):
        return None
    for library, home in HOMES.items():
        if re.fullmatch(library, header):
            return None if re.fullmatch(home, str(source)) else f"<{header}> is at home in {home} only"
    return f"<{header}> has no home yet: give it one in check_layers.py"


def check(root):
    offences = []
    sources = sorted(p for p in root.rglob("*") if p.suffix in {".h", ".cpp"})
    for path in sources:
        source = path.relative_to(root)
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if not (match := INCLUDE.match(line)):
                continue
            quote, header = match.groups()
            problem = check_own(source, header, root) if quote == '"' else check_foreign(source, header)
            if problem:
                offences.append(f"src/{source}:{number}: {problem}")
    return sources, offences


def main():
    default = pathlib.Path(__file__).resolve().parent.parent / "src"
    sources, offences = check(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default)
    print("\n".join(offences) or f"{len(sources)} files keep their layers")
    return 1 if offences or not sources else 0


if __name__ == "__main__":
    sys.exit(main())
