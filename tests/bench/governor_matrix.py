#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Flies mission_energy and its opponents in every cell of a matrix {world} x {price of the map} x
{RGB-D noise} and prints, cell by cell, what mission_energy takes over the best opponent: the median
ratio over the seeds where both succeed with its 95 % interval, successes and collisions. Below stand
the geometric mean over all cells and the cells that miss a bar. Energy is that of the mission; of a
photography it is energy per second in which the person was tracked.

The best opponent of a cell is the one with the most successes, and among those the one that
mission_energy comes off worst against. fixed_best, the best single setting in hindsight, is one of them
unless --no-hindsight. A cell has no ratio where there is no seed with which both succeed.

With --floor, both fly again on a computer whose kernels cost a fiftieth, and the better of the two is
held against the best opponent at the real price: what no governor can be much better than. A cell
has no floor where fixed_best is the best.

Each cell is a `flyball tournament` in a folder of its own, so the same command goes on where it was
stopped, and a subset first makes the whole go faster later. Seeds from 9000 on are not for development.
The table is written to OUT/matrix.md, too. policies/MATRIX.md is one, whose cells were flown on many days:
--update puts what was flown now into such a page, in place of the same cells, and judges the whole again.

Exits with 1 where a cell misses a bar, with 2 where one could not be flown.
"""

import argparse
import datetime
import json
import math
import pathlib
import random
import re
import sqlite3
import statistics
import subprocess
import sys
import time

GOVERNOR = "mission_energy"
BAR_OF_A_CELL = 1.03
BAR_OF_ALL = 0.95
# Chosen: far below the price, at which the longest jobs take about half a second.
FREE = 0.02

WORLDS = {
    "office_as_built": ("delivery_office_as_built", []),
    "building_079": ("delivery_building_079", []),
    # One of each thing: by the seed there would be more than fits.
    "mixed_260": ("delivery_mixed", ["world.length_m=260", "world.buildings=1", "world.crowds=1",
                                     "world.slits=1"]),
    "mixed_600": ("delivery_mixed", ["world.length_m=600"]),
    "mixed_900": ("delivery_mixed", ["world.length_m=900"]),
    "congestion": ("delivery_congestion", []),
    "outdoor_to_indoor": ("delivery_outdoor_to_indoor", []),
    "city": ("delivery_city", []),
    "forest": ("delivery_forest", []),
    "mapping": ("mapping_office", []),
    "search": ("search_collapsed_building", []),
    "photography": ("photography_park", []),
    "scanning": ("scanning_farm", []),
}
MAPS = {
    "stock": ["kernels.mapper=octomap"],
    "lattice": ["kernels.mapper=flyball", "kernels.mapper_parameters.cost_of=octomap"],
    "own": ["kernels.mapper=flyball", "kernels.mapper_parameters.cost_of=flyball"],
}
NOISE = {"clean": ["camera.rgbd_noise=false"], "noisy": ["camera.rgbd_noise=true"]}
CELLS = [f"{world} {mapper} {noise}" for world in WORLDS for mapper in MAPS for noise in NOISE]
STEP = "vehicle.physics_step_s=0.004"
# What a mission makes progress in, where flights that succeed do not all make as much of it.
PROGRESS = {"photography": "tracked_s"}


# The setting that never changes and is tuned for such worlds; fixed_tuned_mixed for all others.
TUNED = {"congestion": "fixed_tuned", "mapping": "fixed_tuned_mapping",
         "search": "fixed_tuned_mapping"}


def opponents(world, mapper, noise):
    """Without fixed_best. two_level has cells of .8 m, which a lattice has not."""
    names = ["gap_switch", "two_level_lattice", "two_level_tuned",
             TUNED.get(world, "fixed_tuned_mixed")]
    names += ["gap_switch_rgbd"] if noise == "noisy" else []  # In forests, the longer range is better.
    return names + (["two_level"] if mapper == "stock" else [])


class Cell:
    """One world with one map and one camera."""

    def __init__(self, options, world, mapper, noise):
        self.name = f"{world} {mapper} {noise}"
        self.world, self.noise = world, noise
        self.scenario, settings = WORLDS[world]
        self.settings = [*settings, *MAPS[mapper], *NOISE[noise], STEP, *options.set]
        self.rivals = options.against or opponents(world, mapper, noise)
        self.folder = options.out / self.name.replace(" ", "-")

    def command(self, options):
        command = self.tournament(options, self.rivals, self.settings, self.folder)
        return command + (["--hindsight"] if options.hindsight else [])

    def tournament(self, options, rivals, settings, folder):
        command = [options.flyball, "tournament", "--worlds", self.scenario, "--seeds",
                   options.seeds, "--policies", ",".join([GOVERNOR, *rivals]), "--jobs",
                   str(options.jobs), "--json", "--out", folder]
        return command + [word for setting in settings for word in ("--set", setting)]

    def fly(self, options):
        """The tournament's table, or None, with the reason on standard error. Progress goes there,
        too, where somebody watches it."""
        return self.flown(self.command(options))

    def floor(self, options, seeds, best):
        """By seed, the energy of the better of both on a computer whose kernels are nearly free."""
        settings = [*self.settings, f"platform.name={options.out / 'free.toml'}"]
        folder = self.folder.with_name(self.folder.name + "-free")
        if self.flown(self.tournament(options, [best], settings, folder)) is None:
            return {}
        both = [self.flights(policy, seeds, folder) for policy in (GOVERNOR, best)]
        return {seed: min(flights[seed][2] for flights in both if flights[seed][0])
                for seed in seeds if any(flights[seed][0] for flights in both)}

    def flown(self, command):
        ended = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True,
                               check=False)
        if ended.returncode == 130:
            raise KeyboardInterrupt
        if ended.returncode != 0:
            print(f"{self.name}: could not be flown", file=sys.stderr)
            return None
        return json.loads(ended.stdout)[0]

    def flights(self, policy, seeds, folder=None):
        """The flights of a policy by seed, as the tournament's store keeps them: whether it
        succeeded, its failure, and its energy over its progress."""
        database = sqlite3.connect((folder or self.folder) / "tournament.db")
        rows = database.execute(
            "SELECT f.seed, f.status, f.failure, f.energy_total_j, q.value FROM flights f LEFT JOIN "
            "quality q ON q.world = f.world AND q.policy = f.policy AND q.seed = f.seed AND "
            "q.settings = f.settings AND q.name = ? WHERE f.policy = ? AND f.settings = ''",
            (PROGRESS.get(self.world, ""), policy)).fetchall()
        database.close()
        return {seed: (status == "succeeded", failure, energy / (progress or 1.0))
                for seed, status, failure, energy, progress in rows if seed in seeds}


def interval(values):
    """Of the median: percentile bootstrap with a fixed seed; the whole range below six values."""
    if len(values) < 6:
        return min(values), max(values)
    draws = random.Random(1)
    medians = sorted(statistics.median(draws.choices(values, k=len(values))) for _ in range(2000))
    return medians[50], medians[-51]


def successes(flights):
    return sum(flight[0] for flight in flights.values())


def collisions(flights):
    return sum(flight[1] == "collision" for flight in flights.values())


def ratios(mine, other):
    return [mine[seed][2] / other[seed][2] for seed in sorted(mine)
            if seed in other and mine[seed][0] and other[seed][0]]


def write_free_platform(options):
    """The scenarios' platform, but for the scale of its kernels."""
    source = pathlib.Path(__file__).resolve().parents[2] / "sim/platforms/jetson_tx2.toml"
    text = re.sub(r'(?m)^name = .*', 'name = "free"', source.read_text(), count=1)
    (options.out / "free.toml").write_text(re.sub(
        r"(?m)^scale = ([0-9.e-]+)", lambda found: f"scale = {FREE * float(found[1]):g}", text))


def judged(cell, table, options):
    """What is said of a cell."""
    seeds = set(table["seeds"])
    mine = cell.flights(GOVERNOR, seeds)
    rivals = {name: cell.flights(name, seeds) for name in cell.rivals}
    if "fixed_best" in table:
        rivals["fixed_best"] = cell.flights(table["fixed_best"]["preset"], seeds)
    by_rival = {name: ratios(mine, flights) for name, flights in rivals.items()}
    medians = {name: statistics.median(values) if values else -math.inf
               for name, values in by_rival.items()}
    best = max(rivals, key=lambda name: (successes(rivals[name]), medians[name]))
    values = by_rival[best]
    told = {"cell": cell.name, "n": len(mine), "pairs": len(values), "best": best,
            "ratio": medians[best] if values else None,
            "interval": interval(values) if values else None,
            "successes": successes(mine), "best_successes": successes(rivals[best]),
            "collisions": collisions(mine),
            "rivals": {name: {"ratio": medians[name] if by_rival[name] else None,
                              "successes": successes(rivals[name]),
                              "collisions": collisions(rivals[name])} for name in rivals},
            "fixed_best": table.get("fixed_best")}
    if options.floor and best != "fixed_best":
        free = cell.floor(options, seeds, best)
        flown = rivals[best]
        shares = [free[seed] / flown[seed][2] for seed in sorted(free) if flown[seed][0]]
        told["floor"] = statistics.median(shares) if shares else None
    told["missed"] = [bar for bar, is_missed in (
        ("energy", bool(values) and medians[best] > BAR_OF_A_CELL),
        ("success", told["successes"] < told["best_successes"]),
        ("collision", told["collisions"] > 0)) if is_missed]
    return told


HEADS = ["cell", "pairs", "over the best", "95 %", "floor", "best opponent", "success", "its",
         "collisions", "misses", "flown"]


def row(told, day):
    has = told["ratio"] is not None
    best = told["best"]
    if best == "fixed_best":
        best += f" ({told['fixed_best']['setting']})"
    return [told["cell"], str(told["pairs"]), f"{told['ratio']:.3f}" if has else "-",
            "[{:.3f}, {:.3f}]".format(*told["interval"]) if has else "-",
            f"{told['floor']:.3f}" if told.get("floor") else "-", best,
            f"{told['successes']}/{told['n']}", f"{told['best_successes']}/{told['n']}",
            str(told["collisions"]), ", ".join(told["missed"]) or "-", day]


def report(rows):
    """The table, and what is said of all of it."""
    lines = ["| " + " | ".join(HEADS) + " |", "|" + "---|" * len(HEADS)]
    lines += ["| " + " | ".join(cells) + " |" for cells in rows]
    told = [dict(zip(HEADS, cells)) for cells in rows]
    # Fewer pairs say little, and one of them alone may be five times as much.
    known = [float(cell["over the best"]) for cell in told if cell["over the best"] != "-"
             and 2 * int(cell["pairs"]) >= int(cell["success"].partition("/")[2])]
    if known:
        mean = math.exp(sum(map(math.log, known)) / len(known))
        missed = [cell["cell"] for cell in told if cell["misses"] != "-"]
        lines += ["", f"geometric mean over the {len(known)} cells where both succeed with half of the "
                  f"seeds: {mean:.3f} (bar {BAR_OF_ALL})",
                  f"cells that miss a bar (energy over {BAR_OF_A_CELL}, success, collision): "
                  f"{len(missed)} of {len(told)}" + (": " + "; ".join(missed) if missed else "")]
    return "\n".join(lines) + "\n"


def updated(page, rows):
    """A page with these rows in its first table, in place of those of the same cells."""
    head = "| " + " | ".join(HEADS) + " |\n"
    before, found, rest = page.partition(head)
    if not found:
        sys.exit(f"--update: the page has no table that begins with {head.strip()}; name one that this "
                 "command wrote")
    table, found, after = rest.partition("\n## ")
    by_cell = {line.split("|")[1].strip(): [cell.strip() for cell in line.split("|")[1:-1]]
               for line in table.splitlines()[1:] if line.startswith("| ")}
    by_cell.update((cells[0], cells) for cells in rows)
    return before + report(sorted(by_cell.values(), key=lambda cells: CELLS.index(cells[0]))) + found + after


def document(rows, options):
    """The table as a page of its own, with how it was made."""
    asked = ["governor_matrix.py", "--seeds", options.seeds, "--worlds", ",".join(options.worlds)]
    asked += ["--maps", ",".join(options.maps)] if options.maps != list(MAPS) else []
    asked += ["--noise", ",".join(options.noise)] if options.noise != list(NOISE) else []
    asked += ["--against", ",".join(options.against)] if options.against else []
    asked += [] if options.hindsight else ["--no-hindsight"]
    asked += ["--floor"] if options.floor else []
    asked += [word for setting in options.set for word in ("--set", setting)]
    return (f"# {GOVERNOR} against the best opponent of each cell\n\n"
            f"Written by `{' '.join(asked)}` (`tests/bench`). Each cell is a world, the price of its map (stock "
            "OctoMap; a lattice at stock's price; our own map's) and a camera with or without RGB-D noise. The ratio "
            f"is the median of {GOVERNOR}'s energy over the best opponent's, with its 95 % interval, over the seeds "
            "where both succeed; below 1 it takes less. The best opponent is the one with the most successes, and "
            f"among those the one that {GOVERNOR} comes off worst against.\n\n" + report(rows))


def names(known):
    def read(text):
        chosen = text.split(",")
        for name in chosen:
            if name not in known:
                raise argparse.ArgumentTypeError(f"{name} is none of {', '.join(known)}")
        return chosen
    return read


def parsed():
    source = pathlib.Path(__file__).resolve().parents[2]
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--flyball", type=pathlib.Path, default=source / "build/ci/bin/flyball")
    parser.add_argument("--seeds", default="9101..9108", help="as flyball's")
    for option, known in (("worlds", WORLDS), ("maps", MAPS), ("noise", NOISE)):
        parser.add_argument(f"--{option}", type=names(known), default=list(known),
                            metavar="A,B", help=f"of {', '.join(known)} (default: all)")
    parser.add_argument("--against", type=lambda text: text.split(","), metavar="A,B",
                        help="other opponents than those that this file lists")
    parser.add_argument("--no-hindsight", dest="hindsight", action="store_false",
                        help="without fixed_best, which takes most of the time")
    parser.add_argument("--floor", action="store_true",
                        help="also flies on a computer whose kernels are nearly free")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE",
                        help="as flyball's, in every cell (vehicle.airframe=spark, vehicle.payload_kg=0)")
    parser.add_argument("--jobs", type=int, default=1, help="flights at a time")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("flights/matrix"))
    parser.add_argument("--update", type=pathlib.Path, metavar="FILE",
                        help="puts the cells into this page (policies/MATRIX.md), too")
    parser.add_argument("--list", action="store_true", help="prints the cells' commands and ends")
    return parser.parse_args()


def time_left(took_s, cells_left):
    """From the cells that were flown now; a cell that is known from before takes a moment."""
    flown = [seconds for seconds in took_s if seconds > 5.0]
    if not flown or cells_left == 0:
        return ""
    return f", at most {statistics.mean(flown) * cells_left / 3600.0:.1f} h left"


def fly_all(options, cells):
    """By cell what is told of it, and its row."""
    done, rows, took_s = [], [], []
    for number, cell in enumerate(cells, 1):
        print(f"cell {number} of {len(cells)}: {cell.name}"
              + time_left(took_s, len(cells) - number + 1), file=sys.stderr, flush=True)
        begin = time.monotonic()
        table = cell.fly(options)
        if table is not None:
            done.append(judged(cell, table, options))
            rows.append(row(done[-1], datetime.date.today().isoformat()))
            print(" | ".join(rows[-1]), file=sys.stderr, flush=True)
            if options.update:
                options.update.write_text(updated(options.update.read_text(), rows[-1:]))
        took_s.append(time.monotonic() - begin)
    return done, rows


def main():
    options = parsed()
    if not options.flyball.exists():
        sys.exit(f"no program {options.flyball}; build it, or name it with --flyball")
    options.flyball = options.flyball.resolve()
    if options.floor and any(setting.startswith("platform.name=") for setting in options.set):
        sys.exit("--floor flies on jetson_tx2 with cheap kernels, so it takes no platform.name; "
                 "leave one of them out")
    cells = [Cell(options, world, mapper, noise) for world in options.worlds
             for mapper in options.maps for noise in options.noise]
    if options.update:
        updated(options.update.read_text(), [])  # So that a page of another kind is refused now.
    if options.list:
        for cell in cells:
            print(" ".join(map(str, cell.command(options))))
        return 0
    options.out = options.out.resolve()
    options.out.mkdir(parents=True, exist_ok=True)
    if options.floor:
        write_free_platform(options)
    try:
        done, rows = fly_all(options, cells)
    except KeyboardInterrupt:
        print("interrupted; the same command goes on from here", file=sys.stderr)
        return 130
    (options.out / "matrix.json").write_text(json.dumps(done, indent=2) + "\n")
    (options.out / "matrix.md").write_text(document(rows, options))
    print(report(rows), end="")
    if len(done) < len(cells):
        return 2
    return 1 if any(told["missed"] for told in done) else 0


if __name__ == "__main__":
    sys.exit(main())
