#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the example scenes, the same bytes every time.

    make_scenes.py            writes every scene beside this script
    make_scenes.py --check    writes nothing; fails when a file differs from what it would write

Random scenes draw from a fixed seed. Before a scene is written, every disk is compared with its
neighbours and with every wall, in exact rational arithmetic wherever doubles leave a doubt, so no
scene starts with an overlap.
"""

import argparse
import itertools
import json
import math
import pathlib
import random
import sys
from fractions import Fraction

HERE = pathlib.Path(__file__).resolve().parent

# A clearance (m) above which double arithmetic has no doubt at these scenes' scales.
CLEAR = 1e-9


class Scene:
    """Disks, walls and zones in the order of their ids, which count up from 1."""

    def __init__(self, name, period=(0, 0)):
        self.name = name
        self.period = period  # m; 0: open
        self.effects = {}  # as in scene.proto
        self.seed = 0
        self.disks = []
        self.walls = []
        self.zones = []

    def disk(self, x, y, radius, vx=0.0, vy=0.0, mass=1.0, name="", kind="DYNAMIC"):
        self.disks.append(dict(x=float(x), y=float(y), radius=float(radius), vx=float(vx),
                               vy=float(vy), mass=float(mass), name=name, kind=kind))

    def wall(self, x1, y1, x2, y2, name="", velocity=(0, 0)):
        self.walls.append(dict(start=(float(x1), float(y1)), end=(float(x2), float(y2)), name=name,
                               velocity=velocity))

    def chain(self, points, name=""):
        """Walls from point to point."""
        for (x1, y1), (x2, y2) in zip(points, points[1:]):
            self.wall(x1, y1, x2, y2, name)

    def zone(self, x, y, radius, name=""):
        self.zones.append(dict(center=(float(x), float(y)), radius=float(radius), name=name))

    def box(self, left, bottom, right, top):
        """Four walls around a room."""
        self.wall(left, bottom, right, bottom, "south")
        self.wall(right, bottom, right, top, "east")
        self.wall(right, top, left, top, "north")
        self.wall(left, top, left, bottom, "west")


# Geometry -----------------------------------------------------------------------------------------


def wall_distance_squared(x, y, wall):
    """The squared distance of a point from a segment, in the arithmetic of the arguments."""
    (x1, y1), (x2, y2) = wall
    ex, ey, px, py = x2 - x1, y2 - y1, x - x1, y - y1
    s = min(max((px * ex + py * ey) / (ex * ex + ey * ey), 0), 1)
    dx, dy = px - s * ex, py - s * ey
    return dx * dx + dy * dy


def disks_apart(a, b):
    gap = math.hypot(a["x"] - b["x"], a["y"] - b["y"]) - (a["radius"] + b["radius"])
    if abs(gap) > CLEAR:
        return gap > 0
    dx = Fraction(a["x"]) - Fraction(b["x"])
    dy = Fraction(a["y"]) - Fraction(b["y"])
    reach = Fraction(a["radius"]) + Fraction(b["radius"])
    return dx * dx + dy * dy >= reach * reach


def wall_apart(disk, wall):
    segment = (wall["start"], wall["end"])
    gap = math.sqrt(wall_distance_squared(disk["x"], disk["y"], segment)) - disk["radius"]
    if abs(gap) > CLEAR:
        return gap > 0
    exact = tuple(tuple(Fraction(c) for c in end) for end in segment)
    squared = wall_distance_squared(Fraction(disk["x"]), Fraction(disk["y"]), exact)
    return squared >= Fraction(disk["radius"]) ** 2


class Grid:
    """Finds the disks that may touch a given one. One layer of cells per size class, so that a few
    large disks do not make every cell large."""

    def __init__(self):
        self.layers = {}

    @staticmethod
    def _layer(radius):
        return math.ceil(math.log2(radius))

    def add(self, disk):
        layer = self._layer(disk["radius"])
        size = 2.0**layer
        key = (math.floor(disk["x"] / size), math.floor(disk["y"] / size))
        self.layers.setdefault(layer, {}).setdefault(key, []).append(disk)

    def near(self, disk):
        for layer, cells in self.layers.items():
            size = 2.0**layer
            reach = disk["radius"] + size + CLEAR
            columns = range(math.floor((disk["x"] - reach) / size),
                            math.floor((disk["x"] + reach) / size) + 1)
            rows = range(math.floor((disk["y"] - reach) / size),
                         math.floor((disk["y"] + reach) / size) + 1)
            for column in columns:
                for row in rows:
                    yield from cells.get((column, row), ())


def verify(scene):
    """Fails when two bodies of the scene, or images of them, overlap."""
    grid = Grid()
    across, up = ((-length, 0, length) if length else (0,) for length in scene.period)
    for index, disk in enumerate(scene.disks):
        for x, y in itertools.product(across, up):
            image = dict(disk, x=disk["x"] + x, y=disk["y"] + y)
            for other in grid.near(image):
                if not disks_apart(image, other):
                    raise ValueError(f"{scene.name}: disk {index + 1} overlaps {other}")
            for wall in scene.walls:
                if not wall_apart(image, wall):
                    raise ValueError(f"{scene.name}: disk {index + 1} overlaps wall {wall}")
        grid.add(disk)


# Random numbers: only random(), whose sequence Python promises to keep ----------------------------


def normal(rng):
    """A standard normal number (Box and Muller, Ann. Math. Stat. 29 (1958) 610)."""
    return math.sqrt(-2.0 * math.log(1.0 - rng.random())) * math.cos(2.0 * math.pi * rng.random())


def place(scene, grid, rng, radius, room, clearance, **properties):
    """Adds a disk at the first random place in the room where it is clear of everything."""
    left, bottom, right, top = room
    for _ in range(100000):
        x = round(left + radius + (right - left - 2 * radius) * rng.random(), 6)
        y = round(bottom + radius + (top - bottom - 2 * radius) * rng.random(), 6)
        grown = dict(x=x, y=y, radius=radius + clearance)
        if (all(disks_apart(grown, other) for other in grid.near(grown)) and
                all(wall_apart(grown, wall) for wall in scene.walls)):
            scene.disk(x, y, radius, **properties)
            grid.add(scene.disks[-1])
            return
    raise ValueError(f"{scene.name}: no room for a disk of radius {radius}")


def thermal(rng, temperature, mass):
    """A velocity of Maxwell's distribution, k_B = 1, to six decimals."""
    spread = math.sqrt(temperature / mass)
    return dict(vx=round(spread * normal(rng), 6), vy=round(spread * normal(rng), 6), mass=mass)


# The scenes ---------------------------------------------------------------------------------------


def tutorial():
    # The bullet meets the wall after 19 microseconds, and on its way back the ball. The masses are
    # equal, so the two exchange their velocities and the bullet strolls back to the wall.
    scene = Scene("tutorial")
    scene.disk(0, 0, 0.5, vx=1, name="ball")
    scene.disk(2, 0, 0.1, vx=100000, name="bullet")
    scene.wall(4, -1, 4, 1, name="wall")
    return scene


def newtons_cradle():
    # All numbers are dyadic and all masses equal, so every contact is exact. Equal disks in a line
    # only exchange velocities, so the order of simultaneous contacts does not matter.
    scene = Scene("newtons-cradle")
    scene.disk(0, 0, 0.5, vx=1, name="striker")
    for i in range(5):
        scene.disk(3 + i, 0, 0.5, name=f"ball {i + 1}")
    scene.wall(-1, -1, -1, 1, name="left")
    scene.wall(11, -1, 11, 1, name="right")
    return scene


def rack(scene, gap):
    """Fifteen balls of 57.15 mm and 170 g, so far apart, at the foot of a nine-foot table."""
    radius, mass = 0.028575, 0.17
    pitch = 2 * radius + gap
    number = 1
    for row in range(5):
        for place_in_row in range(row + 1):
            x = 1.905 + row * pitch * math.sqrt(3) / 2
            y = 0.635 + (place_in_row - row / 2) * pitch
            # Nanometre decimals keep at least 0.998 of the gap.
            scene.disk(round(x, 9), round(y, 9), radius, mass=mass, name=f"{number}")
            number += 1


def pool_break():
    # A nine-foot table without pockets. The rack leaves a micrometre between balls: a perfect
    # touching triangle has no representation in doubles. The cue ball comes a little off the centre
    # line, so nothing is symmetric.
    scene = Scene("pool-break")
    scene.disk(0.635, 0.6372, 0.028575, vx=10, vy=0, mass=0.17, name="cue")
    rack(scene, 1e-6)
    scene.box(0, 0, 2.54, 1.27)
    return scene


def billiards():
    # The same table with its pockets: the rails are one closed chain that bulges around each of
    # them, and a zone in each bulge tells which ball is in. Friction of the cloth as of a rolling
    # ball, 0.01 g; cushions that give back three quarters of the speed.
    scene = Scene("billiards")
    scene.effects = {"floor_friction": {"deceleration": 0.0981},
                     "restitution": {"coefficient": 0.95, "wall_coefficient": 0.75}}
    scene.disk(0.635, 0.6372, 0.028575, vx=7, vy=0, mass=0.17, name="cue")
    rack(scene, 1e-6)
    length, width, middle = 2.54, 1.27, 1.27
    mouth, throat, depth = 0.085, 0.055, 0.09  # of a corner: along the rail, further out, behind it
    side, narrow, back = 0.065, 0.05, 0.08  # of the middle pockets, likewise
    # From the south-west corner's mouth along the south rail, and so on all the way round.
    half = [(mouth, 0), (middle - side, 0), (middle - narrow, -back), (middle + narrow, -back),
            (middle + side, 0), (length - mouth, 0), (length - throat, -depth),
            (length + depth, -depth), (length + depth, throat), (length, mouth),
            (length, width - mouth)]
    other = [(round(length - x, 6), round(width - y, 6)) for x, y in half]
    corner = [(length + depth, width - throat), (length + depth, width + depth),
              (length - throat, width + depth)]
    far_corner = [(round(length - x, 6), round(width - y, 6)) for x, y in corner]
    scene.chain(half + corner + other + far_corner + half[:1], "rail")
    for i, (x, y) in enumerate([(0, 0), (length, 0), (length, width), (0, width)]):
        scene.zone(x + math.copysign(0.03, x - 1), y + math.copysign(0.03, y - 1), 0.06,
                   f"corner pocket {i + 1}")
    scene.zone(middle, -0.04, 0.045, "middle pocket 1")
    scene.zone(middle, width + 0.04, 0.045, "middle pocket 2")
    return scene


def bullets():
    # A fence of walls without thickness, and behind it a second one that stands askew. The gaps let
    # a bullet through, the room lets none out. Bullets cover up to 1.7 km per tick at 60 Hz.
    scene = Scene("bullets")
    for i in range(10):
        speed = round(1000 * 100 ** (i / 9), 3)
        angle = 0.02 + 0.013 * i
        scene.disk(-18 + 0.1 * i, -9 + 2 * i, 0.01, vx=round(speed * math.cos(angle), 3),
                   vy=round(speed * math.sin(angle), 3), mass=0.01, name=f"bullet {i + 1}")
    for i in range(10):
        scene.disk(9 + 3 * (i % 4), -8 + 1.75 * i, 0.5, vx=round(0.5 - 0.1 * i, 1),
                   vy=round(0.1 * (i % 3), 1), mass=1000, name=f"heavy {i + 1}")
    scene.box(-20, -10, 20, 10)
    for i in range(20):
        bottom = round(-9.95 + i, 2)
        scene.wall(0, bottom, 0, round(bottom + 0.9, 2), name=f"picket {i + 1}")
    for i in range(19):
        y = -9.25 + i
        scene.wall(4, y, 4.75, y + 0.5, name=f"slat {i + 1}")
    return scene


def pi_digits(k):
    # Galperin, "Playing pool with pi", Regul. Chaotic Dyn. 8 (2003) 375: with masses in the ratio
    # 100^k the number of collisions is the first k + 1 digits of pi.
    scene = Scene(f"pi-{k}")
    scene.disk(2, 0, 0.5, mass=1, name="small")
    scene.disk(8, 0, 0.5, vx=-1, mass=100**k, name="big")
    scene.wall(0, -1, 0, 1, name="wall")
    return scene


def gas():
    # Area fraction 10,000 pi r^2 / L^2 = 0.2003. In a gas of hard disks each one collides
    # 2 n d sqrt(pi T / m) g times a second, with n = N / L^2, d = 2 r and the contact value
    # g = (1 - 7 eta / 16) / (1 - eta)^2 (Henderson, Mol. Phys. 30 (1975) 971): here
    # 1.29 sqrt(T), so T = 0.6 makes one collision a second.
    scene = Scene("gas-10000")
    rng = random.Random(10000)
    side = 198
    scene.box(0, 0, side, side)
    grid = Grid()
    for _ in range(10000):
        place(scene, grid, rng, 0.5, (0, 0, side, side), 1e-3, **thermal(rng, 0.6, 1.0))
    return scene


def periodic_gas():
    # No walls: a fifth of the area, whose equation of state is that of the bulk but for one part in
    # the number of disks.
    scene = Scene("periodic-gas", period=(64, 64))
    rng = random.Random(1024)
    for i in range(1024):
        scene.disk(2 * (i % 32), 2 * (i // 32), 0.5, **thermal(rng, 1.0, 1.0))
    return scene


def channel():
    # A gas that streams around the world between a floor and a ceiling without end, past pillars
    # and a plate across the border.
    scene = Scene("channel", period=(24, 0))
    rng = random.Random(24)
    scene.wall(0, 0, 24, 0, name="floor")
    scene.wall(24, 12, 0, 12, name="ceiling")
    scene.wall(22, 5, 26, 7, name="plate")
    for i, y in enumerate((3, 9, 6)):
        scene.disk(5 + 6 * i, y, 1, kind="STATIC", name=f"pillar {i + 1}")
    grid = Grid()
    for disk in scene.disks:
        grid.add(disk)
    for _ in range(60):
        flow = thermal(rng, 0.25, 1.0)
        flow["vx"] = round(flow["vx"] + 1, 6)
        place(scene, grid, rng, 0.3, (2.4, 0, 21.6, 12), 1e-3, **flow)
    return scene


def polydisperse():
    # Radii from 0.05 m to 5 m, masses as the area, one temperature for all. Obstacles: pillars,
    # pins, a free wall, a funnel and a bent chain of walls.
    scene = Scene("polydisperse")
    rng = random.Random(100)
    side = 60
    room = (0, 0, side, side)
    scene.box(0, 0, side, side)
    scene.wall(8, 30, 20, 36, name="free wall")
    scene.wall(30, 12, 38, 20, name="funnel left")
    scene.wall(48, 12, 40, 20, name="funnel right")
    chain = [(6, 50), (12, 46), (18, 50), (24, 46), (30, 50)]
    for i in range(4):
        scene.wall(*chain[i], *chain[i + 1], name=f"chain {i + 1}")
    grid = Grid()

    def add(radius, **properties):
        place(scene, grid, rng, radius, room, 1e-3, **properties)

    def mass(radius):
        return round((radius / 0.05) ** 2, 6)

    for i in range(3):
        add(5.0, name=f"large {i + 1}", **thermal(rng, 1.0, mass(5.0)))
    for i in range(5):
        add(1.5, name=f"pillar {i + 1}", kind="STATIC")
    for i in range(40):
        radius = round(0.3 * 5 ** rng.random(), 3)
        add(radius, **thermal(rng, 1.0, mass(radius)))
    for i in range(20):
        add(0.05, name=f"pin {i + 1}", kind="STATIC")
    for _ in range(2000):
        radius = round(0.05 * 4 ** rng.random(), 3)
        add(radius, **thermal(rng, 1.0, mass(radius)))
    return scene


def packing():
    # A hundred disks of two sizes grow until they jam (Lubachevsky, Stillinger, J. Stat. Phys. 60
    # (1990) 561). Restitution takes out what the growth puts in.
    scene = Scene("packing")
    rng = random.Random(101)
    scene.box(0, 0, 10, 10)
    for i in range(100):
        scene.disk(i % 10 + 0.5, i // 10 + 0.5, 0.15 if i % 2 else 0.05,
                   vx=round(0.4 * rng.random() - 0.2, 6), vy=round(0.4 * rng.random() - 0.2, 6))
    scene.effects = {"restitution": {"coefficient": 0.9}, "growth": {"rate": 0.3}}
    return scene


def sinking():
    # Disks sink through a medium past pegs and shelves, at 2 m/s where nothing is in their way, and
    # slide off the shelves.
    scene = Scene("sinking")
    rng = random.Random(7)
    scene.wall(0, 0, 0, 40, name="left")
    scene.wall(20, 0, 20, 40, name="right")
    scene.wall(0, 12, 8, 8, name="left shelf")
    scene.wall(20, 12, 12, 8, name="right shelf")
    grid = Grid()
    for row in range(4):
        for column in range(5 - row % 2):
            scene.disk(2 + 4 * column + 2 * (row % 2), 24 - 3 * row, 0.4, kind="STATIC",
                       name=f"peg {row + 1}.{column + 1}")
            grid.add(scene.disks[-1])
    for _ in range(60):
        place(scene, grid, rng, 0.3, (0, 26, 20, 40), 1e-3, vx=round(normal(rng), 6),
              vy=round(normal(rng), 6))
    scene.effects = {"gravity": {"acceleration": {"y": -10}}, "drag": {"rate": 5},
                     "restitution": {"coefficient": 0.5, "contact_duration": 0.001,
                                     "rest_speed": 0.01}}
    return scene


# Writing: the canonical Protobuf JSON mapping, a body a line --------------------------------------


def number(value):
    """The shortest decimal that reads back to the same double."""
    return str(int(value)) if value == int(value) and abs(value) < 2**53 else repr(value)


def vector(x, y):
    return f'{{"x": {number(x)}, "y": {number(y)}}}'


def disk_line(index, disk):
    parts = [f'"id": {index}']
    if disk["name"]:
        parts.append(f'"name": "{disk["name"]}"')
    if disk["kind"] != "DYNAMIC":
        parts.append(f'"kind": "{disk["kind"]}"')
    parts.append(f'"position": {vector(disk["x"], disk["y"])}')
    if disk["vx"] or disk["vy"]:
        parts.append(f'"velocity": {vector(disk["vx"], disk["vy"])}')
    parts.append(f'"radius": {number(disk["radius"])}')
    if disk["mass"] != 1:
        parts.append(f'"mass": {number(disk["mass"])}')
    return "    {" + ", ".join(parts) + "}"


def wall_line(index, wall):
    parts = [f'"id": {index}']
    if wall["name"]:
        parts.append(f'"name": "{wall["name"]}"')
    parts.append(f'"start": {vector(*wall["start"])}, "end": {vector(*wall["end"])}')
    if any(wall["velocity"]):
        parts.append(f'"velocity": {vector(*wall["velocity"])}')
    return "    {" + ", ".join(parts) + "}"


def zone_line(index, zone):
    parts = [f'"id": {index}', f'"name": "{zone["name"]}"',
             f'"center": {vector(*zone["center"])}', f'"radius": {number(zone["radius"])}']
    return "    {" + ", ".join(parts) + "}"


def to_json(scene):
    disks = ",\n".join(disk_line(i, d) for i, d in enumerate(scene.disks, 1))
    first = len(scene.disks) + 1
    walls = ",\n".join(wall_line(i, w) for i, w in enumerate(scene.walls, first))
    period = f'  "period": {vector(*scene.period)},\n' if any(scene.period) else ""
    effects = f'  "effects": {json.dumps(scene.effects)},\n' if scene.effects else ""
    seed = f'  "seed": "{scene.seed}",\n' if scene.seed else ""
    first += len(scene.walls)
    lines = ",\n".join(zone_line(i, z) for i, z in enumerate(scene.zones, first))
    zones = f',\n  "zones": [\n{lines}\n  ]' if scene.zones else ""
    return (f'{{\n  "name": "{scene.name}",\n{period}{effects}{seed}  "disks": [\n{disks}\n  ],\n'
            f'  "walls": [\n{walls}\n  ]{zones}\n}}\n')


def main():
    from effect_scenes import effect_scenes  # which takes what is above from this file

    parser = argparse.ArgumentParser(description="Makes the example scenes.")
    parser.add_argument("--check", action="store_true", help="compare, write nothing")
    arguments = parser.parse_args()
    scenes = [tutorial(), newtons_cradle(), pool_break(), bullets(), gas(), polydisperse(),
              periodic_gas(), channel(), packing(), sinking(), billiards()]
    scenes += [pi_digits(k) for k in range(5)]
    scenes += effect_scenes()
    stale = []
    for scene in scenes:
        verify(scene)
        path = HERE / f"{scene.name}.json"
        text = to_json(scene)
        if not arguments.check:
            path.write_text(text, encoding="utf-8", newline="\n")
        elif not path.exists() or path.read_bytes() != text.encode():
            stale.append(path.name)
    extra = {p.name for p in HERE.glob("*.json")} - {f"{scene.name}.json" for scene in scenes}
    if arguments.check and extra:
        print(f"no generator for: {', '.join(sorted(extra))}", file=sys.stderr)
    if stale:
        print(f"differs from what make_scenes.py writes: {', '.join(stale)}", file=sys.stderr)
    return 1 if stale or (arguments.check and extra) else 0


if __name__ == "__main__":
    sys.exit(main())
