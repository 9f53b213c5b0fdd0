#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs libFuzzer's targets one after the other, each for so many minutes of processor time, on seeds
that it makes of the shipped inputs. What breaks is kept in a folder; give it to the target again to
see it.
"""

import argparse
import math
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

import made_inputs
from kinds import Seeds

BETWEEN = b"----\n"
# libFuzzer's clock goes on while others have the processor. A map of the most cells that are allowed
# takes half a minute of processor time with the sanitizers.
TIMEOUT_S = 900


def seeds_of(target, seeds):
    """Good inputs, by name."""
    if target in ("map", "scan"):
        return {**seeds.small_map(".bt"), **seeds.small_map(".ot")}
    if target == "png":
        return {name: content for recording in seeds.recordings
                for name, content in recording.items() if name.endswith(".png")}
    if target == "recording":
        tum, euroc = seeds.recordings
        tum_files = ["rgb.txt", "depth.txt", "groundtruth.txt", "accelerometer.txt", "gyroscope.txt"]
        euroc_files = ["mav0/cam0/data.csv", "mav0/cam0/sensor.yaml",
                       "mav0/state_groundtruth_estimate0/data.csv", "mav0/imu0/data.csv"]
        image = re.compile(rb"(rgb/|depth/)?[0-9.]+\.png")  # The target has one, 1.png.
        return {"tum": image.sub(b"1.png", BETWEEN.join(tum[name] for name in tum_files)),
                "euroc": image.sub(b"1.png", BETWEEN.join(euroc[name] for name in euroc_files))}
    if target == "record":
        files = seeds.flown_record()
        trace = b"".join(files["trace.jsonl"].splitlines(True)[:60])
        return {"record": BETWEEN.join([trace, files["mission.toml"], files["summary.json"]])}
    if target == "packet":
        return {str(kind): bytes([kind]) + b"\0" * 1800 for kind in range(3)}
    if target == "mavlink":
        return {"px4": made_inputs.autopilot_flight(12, 6 << 16, (4 << 16) | (6 << 24)),
                "ardupilot": made_inputs.autopilot_flight(3, 4, 9)}
    if target == "script":
        return seeds.scripts()
    if target == "format":
        return {"format": b"%s %5.1f %d %s %q %-3s %+i %g"}
    return seeds.shipped(target + "s", ".toml")


def main():
    source = pathlib.Path(__file__).resolve().parents[2]
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=10.0,
                        help="processor time of each target (%(default)s)")
    parser.add_argument("--targets", help="some of them, by name: map,scan")
    parser.add_argument("--programs", type=pathlib.Path, default=source / "build/fuzz/bin")
    parser.add_argument("--flyball", default=str(source / "build/release/bin/flyball"),
                        help="makes the seeds")
    parser.add_argument("--found", type=pathlib.Path, help="a folder with further inputs as seeds")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("fuzz_findings"))
    options = parser.parse_args()
    built = {file.name[:-len("_fuzzer")]: file for file in sorted(options.programs.glob("*_fuzzer"))}
    chosen = options.targets.split(",") if options.targets else list(built)
    missing = [target for target in chosen if target not in built]
    if missing or not chosen:
        parser.error(f"no target {' '.join(missing)} in {options.programs}; build it: "
                     "cmake --preset fuzz && cmake --build --preset fuzz")
    options.out.mkdir(parents=True, exist_ok=True)
    bad = 0
    print(f"{'TARGET':<12}{'RUNS':>12}{'SECONDS':>12}{'RESULT':>10}", flush=True)
    with tempfile.TemporaryDirectory(prefix="flyball_fuzz_seeds_") as scratch:
        seeds = Seeds(options.flyball, None, options.found, pathlib.Path(scratch))
        for target in chosen:
            runs, used_s, trouble = run(target, built[target], seeds, options)
            bad += trouble is not None
            print(f"{target:<12}{runs:>12}{used_s:>12.0f}"
                  f"{'ok' if trouble is None else 'FOUND':>10}", flush=True)
            if trouble is not None:
                (options.out / f"{target}.log").write_text(trouble)
    return 1 if bad else 0


def processor_s():
    """Of all programs that this one has started and that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run(target, program, seeds, options):
    """Returns how many inputs were tried, the seconds that this took, and what was said of an input
    that broke the target (None: nothing did).

    libFuzzer counts seconds of the clock. On a busy machine it gets few of them, so it is started
    again, on the inputs that it has found, until it has had its time.
    """
    corpus = seeds.scratch / ("corpus_" + target)
    corpus.mkdir()
    for name, content in seeds_of(target, seeds).items():
        (corpus / name.replace("/", "_")).write_bytes(content)
    begun_s, runs = processor_s(), 0
    for round_ in range(100):
        left_s = 60 * options.minutes - (processor_s() - begun_s)
        if left_s < 1:
            break
        command = [program.resolve(), corpus, f"-max_total_time={math.ceil(left_s)}",
                   f"-seed={options.seed + round_}", f"-timeout={TIMEOUT_S}", "-rss_limit_mb=6000",
                   "-max_len=65536", "-print_final_stats=0",
                   f"-artifact_prefix={options.out.resolve()}/{target}-"]
        ended = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True, errors="replace", check=False)
        counts = re.findall(r"^#(\d+)\s", ended.stderr, re.MULTILINE)
        runs += int(counts[-1]) if counts else 0
        if ended.returncode != 0:
            return runs, processor_s() - begun_s, ended.stderr
    return runs, processor_s() - begun_s, None


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
