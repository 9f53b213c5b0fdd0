#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Flies deliveries twice: first where nothing is known, then with the map that the first flight
made. A known map must not make a delivery worse: success with it at least as often, and a mean
ratio of times (known over unknown, geometric, of the pairs in which both arrive) of at most 1.

The pairs are building 079's shipped ones, rooms of an office, and rooms of a mesh that is made here.
Exits with 1 where a known map is worse, with 2 where a flight could not be flown.
"""

import argparse
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

WALL_M = 0.15
HEIGHT_M = 2.8


class MeshOfRooms:
    """A storey of rooms in a grid, each with a door to the next one eastwards or northwards such
    that every room can be reached, as an OBJ file."""

    columns, rows = 6, 5
    room_x_m, room_y_m = 9.8, 9.2

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.corners, self.faces = [], []
        opened = self._opened()
        for column in range(self.columns + 1):
            for row in range(self.rows):
                self._wall(True, column, row, ((column - 1, row), (column, row)) in opened)
        for row in range(self.rows + 1):
            for column in range(self.columns):
                self._wall(False, column, row, ((column, row - 1), (column, row)) in opened)

    def _opened(self):
        """Pairs of rooms with a door between them: a random tree, and a few doors more."""
        rooms = [(column, row) for column in range(self.columns) for row in range(self.rows)]
        walls = [((c, r), (c + 1, r)) for c, r in rooms if c + 1 < self.columns]
        walls += [((c, r), (c, r + 1)) for c, r in rooms if r + 1 < self.rows]
        self.random.shuffle(walls)
        joined = {room: {room} for room in rooms}
        opened = set()
        for one, other in walls:
            if joined[one] is not joined[other] or self.random.random() < 0.2:
                opened.add((one, other))
                joined[one] |= joined[other]
                for room in joined[one]:
                    joined[room] = joined[one]
        return opened

    def _wall(self, is_along_y, column, row, has_door):
        at = (column * self.room_x_m, row * self.room_y_m)
        length = self.room_y_m if is_along_y else self.room_x_m
        stretches = [(0.0, length, 0.0)]
        if has_door:
            width = self.random.uniform(1.2, 1.6)
            left = self.random.uniform(1.0, length - 1.0 - width)
            stretches = [(0.0, left, 0.0), (left + width, length, 0.0), (left, left + width, 2.1)]
        for low, high, bottom in stretches:
            along, across = (low, high), (-WALL_M / 2, WALL_M / 2)
            x, y = (across, along) if is_along_y else (along, across)
            self._box((at[0] + x[0], at[1] + y[0], bottom), (at[0] + x[1], at[1] + y[1], HEIGHT_M))

    def _box(self, low, high):
        first = len(self.corners)
        self.corners += [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1])
                         for z in (low[2], high[2])]
        self.faces += [[first + i for i in face] for face in (
            (0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))]

    def text(self):
        return "".join([f"v {x:.4f} {y:.4f} {z:.4f}\n" for x, y, z in self.corners] +
                       ["f " + " ".join(str(i + 1) for i in face) + "\n" for face in self.faces])

    def middle(self, column, row):
        return (column + 0.5) * self.room_x_m, (row + 0.5) * self.room_y_m


def pairs_of_079():
    return {f"building 079, pair {pair}": ["delivery_building_079", "--set", f"world.pair={pair}"]
            for pair in range(1, 6)}


def settings(**values):
    return [word for key, value in values.items()
            for word in ("--set", key.replace("__", ".") + f"={value}")]


def pairs_in_office():
    return {f"office, room {room}": ["delivery_building_079", *settings(
        world__generator="office", world__goal_room=room)] for room in (2, 5, 6)}


def pairs_in_mesh(folder, seed):
    mesh = MeshOfRooms(seed)
    file = folder / "rooms.obj"
    file.write_text(mesh.text())
    pairs = {}
    for start, goal in (((0, 0), (3, 2)), ((5, 4), (2, 1))):
        (start_x, start_y), (goal_x, goal_y) = mesh.middle(*start), mesh.middle(*goal)
        pairs[f"mesh, {start} to {goal}"] = ["delivery_building_079", *settings(
            world__generator="mesh_file", world__file=file, world__start_x_m=start_x,
            world__start_y_m=start_y, world__goal_x_m=goal_x, world__goal_y_m=goal_y)]
    return pairs


def flown(options, arguments, folder, *more):
    """Whether the flight arrived, how it ended, and its time [s]."""
    command = [options.flyball, "run", *arguments, "--seed", str(options.seed), *more, "--json",
               "--out", folder]
    if options.policy:
        command += ["--policy", options.policy]
    for choice in options.set:
        command += ["--set", choice]
    ended = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                           check=False)
    if ended.returncode not in (0, 1):
        print(f"{' '.join(map(str, command))}\n{ended.stderr}", file=sys.stderr)
        sys.exit(2)
    summary = json.loads(ended.stdout)
    how = summary["failure"] if summary["status"] == "failed" else summary["status"]
    return ended.returncode == 0, how, summary["mission_time_s"]


def fly_pair(options, name, arguments, scratch):
    folder = scratch / "".join(letter if letter.isalnum() else "_" for letter in name)
    folder.mkdir()
    map_file = folder / "flown.bt"
    first = flown(options, arguments, folder / "unknown", "--map", map_file)
    known = flown(options, arguments, folder / "known", "--start-map", map_file)
    ratio = f"{known[2] / first[2]:.3f}" if first[0] and known[0] else "-"
    print(f"{name:<28}{first[1]:>14}{first[2]:>9.1f}{known[1]:>14}{known[2]:>9.1f}{ratio:>8}",
          flush=True)
    return first, known


def parsed():
    source = pathlib.Path(__file__).resolve().parents[2]
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--flyball", type=pathlib.Path, default=source / "build/ci/bin/flyball")
    parser.add_argument("--seed", type=int, default=1, help="of sensors, planner, office and mesh")
    parser.add_argument("--policy", help="default: the scenario's")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE",
                        help="as flyball's, for both flights")
    parser.add_argument("--only", default="", help="pairs whose name has this in it")
    return parser.parse_args()


def main():
    options = parsed()
    if not options.flyball.exists():
        sys.exit(f"no program {options.flyball}; build it, or name it with --flyball")
    options.flyball = options.flyball.resolve()
    print(f"{'PAIR':<28}{'UNKNOWN':>14}{'TIME S':>9}{'KNOWN':>14}{'TIME S':>9}{'RATIO':>8}")
    with tempfile.TemporaryDirectory(prefix="flyball_known_map_") as folder:
        scratch = pathlib.Path(folder)
        pairs = {**pairs_of_079(), **pairs_in_office(), **pairs_in_mesh(scratch, options.seed)}
        flights = [fly_pair(options, name, arguments, scratch)
                   for name, arguments in pairs.items() if options.only in name]
    ratios = [known[2] / first[2] for first, known in flights if first[0] and known[0]]
    mean = math.exp(sum(map(math.log, ratios)) / len(ratios)) if ratios else math.nan
    arrived = [sum(flight[i][0] for flight in flights) for i in range(2)]
    print(f"{len(flights)} pairs: {arrived[0]} arrive unknown, {arrived[1]} known; "
          f"mean ratio {mean:.3f}")
    return 1 if arrived[1] < arrived[0] or not mean <= 1.0 else 0


if __name__ == "__main__":
    sys.exit(main())
