# SPDX-License-Identifier: Apache-2.0
"""The picture: cost of a collision against the number of disks, for all engines."""

import subprocess

import study_pictures

# colour (Okabe and Ito), point type, dash type: no colour need be seen to tell them apart
STYLES = {
    "stoss 0.1": ("#56B4E9", 6, "solid"),
    "stoss 0.3": ("#0072B2", 7, "solid"),
    "stoss 0.5": ("#009E73", 9, "solid"),
    "stoss 0.7": ("#000000", 5, "solid"),
    "Box2D 0.3": ("#E69F00", 4, "'-'"),
    "Box2D-bullet 0.3": ("#D55E00", 8, "'_'"),
    "Chipmunk 0.3": ("#CC79A7", 12, "'.'"),
}


def curves_of(worlds):
    curves = []
    for title, (colour, marker, dash) in STYLES.items():
        engine, fraction = title.split()
        points = sorted((row["disks"], row["ns_per_collision"]) for row in worlds
                        if row["scene"] == "gas" and row["engine"] == engine and
                        row["area_fraction"] == float(fraction))
        if points:
            look = f"lc rgb '{colour}' lw 1.8 dt {dash} pt {marker} ps 0.9"
            curves.append((title, look, "linespoints", points))
    return curves


def draw(results, path):
    curves = curves_of(results["worlds"])
    if not curves:
        return
    room = ["set logscale xy", "set format y '10^{%L}'", "set format x '10^{%L}'",
            study_pictures.log_range("x", curves), study_pictures.log_range("y", curves),
            "set key title 'engine, area fraction'", "set xlabel 'equal disks in a box'",
            "set ylabel 'processor time a collision (ns)'"]
    text = study_pictures.script(path, room, curves)
    subprocess.run(["gnuplot", "-"], input=text, text=True, check=True)
