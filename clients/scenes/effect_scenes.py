#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The example scenes with effects; make_scenes.py writes them with the others."""

import math
import random

from make_scenes import Grid, Scene, place, thermal


def gravity(y):
    return {"acceleration": {"x": 0, "y": y}}


def cooling_gas():
    # A granular gas on its own: it cools as Haff says, T = T0 / (1 + t / tau)^2, until clusters
    # form. The contact duration keeps collapses from stopping the world.
    scene = Scene("cooling-gas")
    scene.effects = {"restitution": {"coefficient": 0.85, "contact_duration": 1e-5}}
    rng = random.Random(85)
    side = 50
    scene.box(0, 0, side, side)
    grid = Grid()
    for _ in range(1000):
        place(scene, grid, rng, 0.4, (0, 0, side, side), 1e-3, **thermal(rng, 1.0, 1.0))
    return scene


def thermostat_gas():
    # The same loss, and a bath that gives it back: a steady state below the bath's temperature.
    scene = Scene("thermostat-gas")
    scene.effects = {"restitution": {"coefficient": 0.9, "contact_duration": 1e-5},
                     "thermostat": {"temperature": 1, "rate": 0.5}}
    scene.seed = 1980
    rng = random.Random(1980)
    side = 30
    scene.box(0, 0, side, side)
    grid = Grid()
    for i in range(300):
        mass = 1.0 if i % 3 else 4.0
        place(scene, grid, rng, 0.3 * math.sqrt(mass), (0, 0, side, side), 1e-3,
              **thermal(rng, 1.0, mass))
    return scene


def galton_board():
    # Twelve rows of pins, thirteen chutes. Every ball falls from its own height, a little off the
    # middle. The chutes are open below: a pile on moving disks has no exact rest.
    scene = Scene("galton-board")
    scene.effects = {"gravity": gravity(-9.81),
                     "restitution": {"coefficient": 0.4, "contact_duration": 1e-4,
                                     "rest_speed": 0.02}}
    rng = random.Random(1889)
    pitch, pin, ball, rows = 0.1, 0.01, 0.015, 12
    for row in range(rows):
        y = round(-row * pitch * 0.9, 6)
        for i in range(row + 3):
            scene.disk(round((i - (row + 2) / 2) * pitch, 6), y, pin, kind="STATIC")
    bottom = round(-rows * pitch * 0.9, 6)
    for i in range(rows + 2):
        x = round((i - (rows + 1) / 2) * pitch, 6)
        scene.wall(x, bottom, x, round(bottom - 0.5, 6), name=f"chute {i + 1}")
    for side in (-1, 1):
        top = side * 0.11
        wide = round(side * (rows + 3) / 2 * pitch + side * 0.01, 6)
        scene.wall(top, 0.2, top, 20, name="shaft")
        scene.wall(top, 0.2, wide, bottom, name="flank")
        scene.wall(wide, bottom, wide, round(bottom - 0.5, 6), name="edge")
    for i in range(100):
        scene.disk(round(0.02 * (2 * rng.random() - 1), 6), round(0.5 + 0.15 * i, 6), ball,
                   mass=0.01, name=f"ball {i + 1}")
    return scene


def hourglass():
    # Two chambers and a neck. Sand that piles up would rest on sand, which has no exact treatment;
    # a warm bath keeps the grains hopping, so they flow, and fill the lower chamber as a dense gas.
    scene = Scene("hourglass")
    scene.effects = {"gravity": gravity(-9.81),
                     "restitution": {"coefficient": 0.8, "contact_duration": 1e-4,
                                     "rest_speed": 0.05},
                     "thermostat": {"temperature": 0.05, "rate": 20}}
    scene.seed = 3600
    half, neck = 2.0, 0.35
    for side, left in ((-1, True), (1, False)):
        name = "left" if left else "right"
        scene.wall(side * half, 4, side * half, 2.2, name=f"upper {name}")
        scene.wall(side * half, 2.2, side * neck, 0.2, name=f"funnel {name}")
        scene.wall(side * neck, 0.2, side * neck, -0.2, name=f"neck {name}")
        scene.wall(side * neck, -0.2, side * half, -2.2, name=f"skirt {name}")
        scene.wall(side * half, -2.2, side * half, -4, name=f"lower {name}")
    scene.wall(-half, 4, half, 4, name="lid")
    scene.wall(-half, -4, half, -4, name="floor")
    for i in range(60):
        scene.disk(round(-1.7 + 0.37 * (i % 10) + 0.05 * (i // 10 % 2), 6),
                   round(2.3 + 0.26 * (i // 10), 6), 0.1)
    return scene


def pistons():
    # A gas between two pistons: one comes in, one goes out, both slower than sound; disks that are
    # moved, as a stirrer, in between. Stop them, or turn them round, with `stoss set-velocity`.
    scene = Scene("pistons")
    rng = random.Random(1824)
    scene.wall(-2, 0, 60, 0, name="cylinder below")
    scene.wall(60, 10, -2, 10, name="cylinder above")
    scene.wall(0, 0, 0, 10, name="piston in", velocity=(0.2, 0))
    scene.wall(30, 0, 30, 10, name="piston out", velocity=(0.15, 0))
    scene.disk(5, 5, 1, vx=0.2, kind="KINEMATIC", name="stirrer 1")
    scene.disk(12, 3, 0.7, vx=0.18, kind="KINEMATIC", name="stirrer 2")
    grid = Grid()
    for disk in scene.disks:
        grid.add(disk)
    for _ in range(200):
        place(scene, grid, rng, 0.25, (0, 0, 30, 10), 1e-3, **thermal(rng, 1.0, 1.0))
    return scene


def swarm():
    # A building of 25 by 20 rooms with a door in every partition: a thousand walls and more. A
    # robot stands in every fourth room and takes velocity commands; light crates drift about.
    scene = Scene("swarm")
    scene.effects = {"restitution": {"coefficient": 0.6, "wall_coefficient": 0.5,
                                     "contact_duration": 1e-4}}
    rng = random.Random(25)
    room, door = 4.0, 1.6
    columns, rows = 25, 20
    first, last = (room - door) / 2, (room + door) / 2
    scene.box(0, 0, columns * room, rows * room)
    for row in range(rows):
        for column in range(columns):
            x, y = column * room, row * room
            # Every second partition has only its upper half, which is a corridor.
            if column > 0:
                scene.wall(x, y + last, x, y + room)
                if (row + column) % 4:
                    scene.wall(x, y, x, y + first)
            if row > 0 and (row + column) % 3:
                scene.wall(x, y, x + first, y)
    grid = Grid()
    for row in range(rows):
        for column in range(columns):
            x, y = column * room, row * room
            if (row + 2 * column) % 4 == 0:
                scene.disk(x + 1, y + 1, 0.25, kind="KINEMATIC",
                           name=f"robot {sum(d['kind'] == 'KINEMATIC' for d in scene.disks) + 1}")
                grid.add(scene.disks[-1])
            place(scene, grid, rng, 0.3, (x + 0.5, y + 0.5, x + room - 0.5, y + room - 0.5), 1e-3,
                  **thermal(rng, 0.25, 2.0))
    return scene


def effect_scenes():
    return [cooling_gas(), thermostat_gas(), galton_board(), hourglass(), pistons(), swarm()]
