#!/usr/bin/env python3
"""Writes src/spectral/tables/*.inc from a folder of reference CSV files (cie1931_2deg_1nm.csv, cie1964_10deg_1nm.csv,
illuminants/NAME.csv; conductors/NAME.eta.spd and NAME.k.spd; wavelength in nm first). Numbers are copied as they stand.

usage: make_spectral_tables.py REFERENCE_FOLDER"""

import csv
import pathlib
import sys
import textwrap

TABLES = pathlib.Path(__file__).resolve().parent.parent / "src" / "spectral" / "tables"
OBSERVERS = {
    "cie1931": ("cie1931_2deg_1nm.csv", "CIE 1931 standard observer (2 degrees), CIE 018:2019, table 6"),
    "cie1964": ("cie1964_10deg_1nm.csv", "CIE 1964 standard observer (10 degrees), CIE 015:2018"),
}
ILLUMINANTS = (
    ["A", "C", "D50", "D55", "D65", "D75"]
    + [f"FL{i}" for i in range(1, 13)]
    + [f"FL3.{i}" for i in range(1, 16)]
    + [f"HP{i}" for i in range(1, 6)]
    + [f"LED-B{i}" for i in range(1, 6)]
    + ["LED-BH1", "LED-RGB1", "LED-V1", "LED-V2", "ID50", "ID65"]
)
CONDUCTORS = ["Ag", "Al", "Au", "Cr", "Cu"]


def rows(path):
    with open(path, newline="") as file:
        return list(csv.reader(file))[1:]


def write_observer(reference, name, file, source):
    data = rows(reference / file)
    assert [int(row[0]) for row in data] == list(range(360, 831))
    lines = [f"// {source}: x, y, z from 360 to 830 nm, every nm."]
    lines += ["// Written by scripts/make_spectral_tables.py."]
    lines += [f"{{{{{row[1]}, {row[2]}, {row[3]}}}}}," for row in data]
    (TABLES / f"{name}.inc").write_text("\n".join(lines) + "\n")


def write_illuminants(reference):
    lines = ["// CIE 015:2018, illuminants: relative power every 5 nm; name, first wavelength [nm], values."]
    lines += ["// Written by scripts/make_spectral_tables.py."]
    for name in ILLUMINANTS:
        data = rows(reference / "illuminants" / f"{name}.csv")
        first = int(data[0][0])
        assert [int(row[0]) for row in data] == [first + 5 * i for i in range(len(data))]
        values = textwrap.wrap(", ".join(row[1] for row in data), 106, initial_indent="  ", subsequent_indent="  ")
        lines += [f'{{"{name}", {first}.0, {{'] + values + ["}},"]
    (TABLES / "illuminants.inc").write_text("\n".join(lines) + "\n")


def pairs(path):
    return [line.split() for line in path.read_text().splitlines() if line and not line.startswith("#")]


def write_conductors(reference):
    lines = ["// Optical constants of metals as collected by luxpop.com (Palik, Handbook of Optical Constants of Solids, and"]
    lines += ["// others): name, wavelengths [nm], n, k."]
    lines += ["// Written by scripts/make_spectral_tables.py."]
    for name in CONDUCTORS:
        n, k = (pairs(reference / "conductors" / f"{name}.{part}.spd") for part in ("eta", "k"))
        assert [row[0] for row in n] == [row[0] for row in k]
        lines.append(f'{{"{name}",')
        for column in ([row[0] for row in n], [row[1] for row in n], [row[1] for row in k]):
            lines.append(" {")
            lines += textwrap.wrap(", ".join(column), 106, initial_indent="  ", subsequent_indent="  ")
            lines.append(" },")
        lines.append("},")
    (TABLES / "conductors.inc").write_text("\n".join(lines) + "\n")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    reference = pathlib.Path(sys.argv[1])
    TABLES.mkdir(exist_ok=True)
    for name, (file, source) in OBSERVERS.items():
        write_observer(reference, name, file, source)
    write_illuminants(reference)
    write_conductors(reference)


main()
