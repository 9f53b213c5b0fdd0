#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Flies MAVBench's five missions on the real-time executor of this computer, and simulated with the platform
file that `flyball calibrate` wrote here, and prints how far the two are apart: means over the seeds.
Nothing else should run: the five take as long as their missions do, some ten minutes for each seed.

One core is left to the simulator, so both have one core less than there are. Frames come at 19.9 Hz:
at 20 Hz they keep step with guidance, which ticks every 20 ms, half of the maps then wait for one tick
and half for two, and the median falls on either of them by chance.

Real-time priorities are asked for, because a job of the modeled computer never waits for one that is
less urgent. As Linux comes it stops threads with them for 50 ms of each second in which their core does
not rest, and the core of a photography never does: set kernel.sched_rt_runtime_us to -1 first.

In real time the simulator computes what cameras see, a depth image in 2 ms and a colour picture in 20
to 50, which is no latency of the computer's: both kinds of flights have cameras that deliver after 5
and 60 ms.

A flight that is in the folder already is not flown again. Exits with 1 where a flight fails or a bar is
missed, with 2 where one could not be flown. A photography ends when the person is lost, by chance
behind one tree or another, so its losses are told and are no fault; it needs some ten seeds.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tomllib

WORKLOADS = ["scanning_farm", "photography_park", "delivery_forest", "mapping_office",
             "search_collapsed_building"]
MAY_LOSE = "photography_park"
# A folder, and options beside those that both kinds have. Only the first kind needs the quiet.
KINDS = {"in real time": ("real", ["--executor", "realtime", "--fifo", "50"]),
         "simulated": ("simulated", [])}
# What is compared, its unit, and how far the simulated one may be off.
FIGURES = {
    "mission time": ("s", 0.10, lambda flight: flight["mission_time_s"]),
    "energy": ("kJ", 0.10, lambda flight: flight["energy_j"]["total"] / 1e3),
    "latency, median": ("ms", 0.15, lambda flight: flight["latency_s"]["p50"] * 1e3),
    "latency, 95 %": ("ms", 0.15, lambda flight: flight["latency_s"]["p95"] * 1e3),
}


def mean(figure, flights):
    return sum(figure(flight) for flight in flights) / len(flights)


def settings(platform):
    """Of both flights. The cost that stands for a localizer in simulated flights is none here."""
    platform = str(pathlib.Path(platform).resolve())  # Records are replayed from elsewhere, too.
    with open(platform, "rb") as file:
        described = tomllib.load(file)
    cores = max(1, min(described["max_cores"], len(os.sched_getaffinity(0))) - 1)
    values = {"platform.name": platform, "platform.cores": cores,
              "platform.frequency_hz": max(described["frequencies_hz"]),
              "kernels.slam_load": "false", "camera.rate_hz": 19.9,
              "camera.delay_s": 0.005, "colour_camera.delay_s": 0.06}
    return [part for key, value in values.items() for part in ("--set", f"{key}={value}")]


def tell_of_throttle():
    setting = pathlib.Path("/proc/sys/kernel/sched_rt_runtime_us")
    runtime_us = int(setting.read_text()) if setting.exists() else -1
    if runtime_us >= 0:
        print(f"kernel.sched_rt_runtime_us is {runtime_us}, so a busy core stands still for a part of "
              "each second in real time only; set it to -1", file=sys.stderr)


def fly(command, folder):
    """The flight's summary; None where it cannot be flown."""
    summary = folder / "summary.json"
    if not summary.exists():
        done = subprocess.run([*command, "--out", str(folder)], capture_output=True, text=True,
                              check=False)
        if not summary.exists():
            print(done.stderr.strip(), file=sys.stderr)
            return None
    return json.loads(summary.read_text())


def compare(scenario, real, virtual):
    """Prints a line for each figure. Whether all of them are within their bars."""
    are_near = True
    for name, (unit, bar, figure) in FIGURES.items():
        measured, simulated = mean(figure, real), mean(figure, virtual)
        if measured == 0.0:  # A workload without a map has no latency.
            continue
        off = simulated / measured - 1.0
        are_near &= abs(off) <= bar
        print(f"{scenario:26} {name:16} {measured:9.1f} {simulated:9.1f} {unit:3} {100 * off:+6.1f} %"
              f"{'' if abs(off) <= bar else f'  over {100 * bar:.0f} %'}", flush=True)
    return are_near


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--flyball", default="build/ci/bin/flyball")
    parser.add_argument("--platform", required=True, help="the file that flyball calibrate wrote")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="a folder for the flights")
    parser.add_argument("--only", choices=WORKLOADS, action="append")
    parser.add_argument("--seeds", type=int, default=1, help="1 to this one")
    given = parser.parse_args()
    both = settings(given.platform)
    tell_of_throttle()
    print(f"{'':26} {'':16} {'real time':>9} {'simulated':>9}")
    are_near = True
    for scenario in given.only or WORKLOADS:
        flights = {kind: [] for kind in KINDS}
        for kind, (folder, options) in KINDS.items():
            for seed in range(1, given.seeds + 1):
                command = [given.flyball, "run", scenario, "--seed", str(seed), *both, *options]
                flights[kind].append(fly(command, given.out / folder / f"{scenario}-{seed}"))
        if None in flights["simulated"] + flights["in real time"]:
            return 2
        for kind, flown in flights.items():
            for flight in flown:
                if flight["status"] != "succeeded":
                    print(f"{scenario}, {kind}, seed {flight['seed']}: {flight['failure']}")
                    are_near &= scenario == MAY_LOSE and flight["failure"] == "target_lost"
        are_near &= compare(scenario, flights["in real time"], flights["simulated"])
    return 0 if are_near else 1


if __name__ == "__main__":
    sys.exit(main())
