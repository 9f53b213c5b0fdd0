#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Damages every kind of input that `flyball` reads, and looks how it takes it.

A command must end by itself within 20 s, with exit code 0, 1 or 2, and say why when it is not 0.
The seconds are the processor's, so that a busy machine makes no findings; six times as many may pass.
What does otherwise is a finding: its input and command are kept in a folder. A case is made anew
from its kind and number alone: `--only KIND:NUMBER` repeats it.
"""

import argparse
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from kinds import KINDS, Seeds

MOST_BYTES = 12 << 30  # Of memory: a case must not take the machine with it.
# The libraries' words, where a sentence should stand.
NO_SENTENCE = re.compile(r"^flyball: (std::|basic_|vector|map::|stod|stoi|stol|bad |_M_|$)", re.M)


class Interrupted(Exception):
    """Somebody wants the table now."""


def interrupt(number, _frame):
    raise Interrupted(number)


def limit_memory():
    resource.setrlimit(resource.RLIMIT_DATA, (MOST_BYTES, MOST_BYTES))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def verdict(code, said):
    """What is wrong with how a command ended; empty: nothing."""
    if code < 0:
        return f"signal {signal.Signals(-code).name}"
    if code not in (0, 1, 2):
        return f"exit code {code}"
    if code == 2 and not said.strip():
        return "no word"
    return "no sentence" if NO_SENTENCE.search(said) else ""


def processor_s(session):
    """What all processes of a session have used that still live, or whose parent does."""
    ticks = 0
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text(errors="replace").rpartition(")")[2].split()
        except OSError:  # It has ended meanwhile.
            continue
        if int(fields[3]) == session:
            ticks += sum(int(field) for field in fields[11:15])
    return ticks / os.sysconf("SC_CLK_TCK")


def ends_in_time(child, limit_s):
    """Whether it ends within so many seconds of processor time, or six times as many."""
    begun = time.monotonic()
    wait_s = limit_s
    while True:
        try:
            child.wait(wait_s)
            return True
        except subprocess.TimeoutExpired:
            passed_s = time.monotonic() - begun
            if passed_s > 6 * limit_s or processor_s(child.pid) >= limit_s:
                return False
            wait_s = 1.0


def run_one(command, place, limit_s):
    """Returns what is wrong (empty: nothing), what was said, and the seconds that it took."""
    begun = time.monotonic()
    with open(place / "said.txt", "wb") as said:
        child = subprocess.Popen(command, cwd=place, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                 stderr=said, start_new_session=True, preexec_fn=limit_memory)
        try:
            wrong = "" if ends_in_time(child, limit_s) else f"no end in {limit_s:g} s"
        finally:  # Its own children too.
            try:
                os.killpg(child.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
            child.wait()
    words = (place / "said.txt").read_bytes()[-20000:].decode("utf-8", "replace")
    return wrong or verdict(child.returncode, words), words, time.monotonic() - begun


class Tally:
    """What came of the cases of one kind."""

    def __init__(self):
        self.cases = self.commands = self.findings = 0
        self.slowest_s = 0.0
        self.codes = {0: 0, 1: 0, 2: 0}


class Driver:
    def __init__(self, options, seeds):
        self.options = options
        self.seeds = seeds
        self.tallies = {kind: Tally() for kind in options.kinds}

    def case(self, kind, number):
        """Makes and runs one case."""
        rng = random.Random(f"{self.options.seed}/{kind}/{number}")
        tally = self.tallies[kind]
        with tempfile.TemporaryDirectory(prefix="flyball_fuzz_") as folder:
            place = pathlib.Path(folder)
            commands = KINDS[kind](rng, place, self.seeds)
            if commands is None:
                return
            tally.cases += 1
            for arguments in commands:
                command = [self.options.flyball, *arguments]
                wrong, said, took_s = run_one(command, place, self.options.limit)
                tally.commands += 1
                tally.slowest_s = max(tally.slowest_s, took_s)
                if wrong:
                    tally.findings += 1
                    self.keep(kind, number, place, arguments, wrong, said)
                    break

    def keep(self, kind, number, place, arguments, wrong, said):
        kept = pathlib.Path(self.options.out) / f"{kind}-{number}"
        shutil.rmtree(kept, ignore_errors=True)
        shutil.copytree(place, kept, symlinks=True)
        line = "flyball " + " ".join(arguments)
        (kept / "finding.txt").write_text(f"{kind}:{number} of seed {self.options.seed}: {wrong}\n"
                                          f"{line}\n{said}\n")
        print(f"{kind}:{number}: {wrong}: {line}: kept in {kept}", flush=True)

    def progress(self, left_s):
        if sys.stderr.isatty():
            cases = sum(t.cases for t in self.tallies.values())
            found = sum(t.findings for t in self.tallies.values())
            left = "" if left_s is None else f", {left_s:.0f} s left"
            print(f"\r{cases} cases, {found} findings{left}    ", end="", file=sys.stderr)

    def run(self):
        options = self.options
        end = time.monotonic() + 60 * options.minutes if options.minutes else None
        number = options.first
        while options.count is None or number < options.first + options.count:
            for kind in options.kinds:
                if end is not None and time.monotonic() > end:
                    return
                self.case(kind, number)
                self.progress(None if end is None else end - time.monotonic())
            number += 1

    def table(self):
        lines = [("KIND", "CASES", "COMMANDS", "SLOWEST S", "FINDINGS")]
        lines += [(kind, t.cases, t.commands, f"{t.slowest_s:.1f}", t.findings)
                  for kind, t in self.tallies.items()]
        total = self.tallies.values()
        lines.append(("all", sum(t.cases for t in total), sum(t.commands for t in total),
                      f"{max(t.slowest_s for t in total):.1f}", sum(t.findings for t in total)))
        return "\n".join(f"{a:<10}{b:>8}{c:>10}{d:>11}{e:>10}" for a, b, c, d, e in lines)


def parsed():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    source = pathlib.Path(__file__).resolve().parents[2]
    parser.add_argument("--flyball", default=str(source / "build/release/bin/flyball"))
    parser.add_argument("--packets", help="fuzz/packets.so of the same build, for kind library")
    parser.add_argument("--minutes", type=float, help="stops after so long")
    parser.add_argument("--count", type=int, help="stops after so many cases of each kind")
    parser.add_argument("--first", type=int, default=0, help="number of the first case")
    parser.add_argument("--only", metavar="KIND:NUMBER", help="one case")
    parser.add_argument("--kinds", default=",".join(KINDS), help="some of: %(default)s")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--found", type=pathlib.Path, help="a folder with further inputs to damage")
    parser.add_argument("--limit", type=float, default=20.0, help="processor seconds of a command")
    parser.add_argument("--out", default="fuzz_findings", help="folder for findings")
    options = parser.parse_args()
    if options.only:
        options.kinds, number = options.only.split(":")
        options.first, options.count = int(number), 1
    options.kinds = options.kinds.split(",")
    unknown = [kind for kind in options.kinds if kind not in KINDS]
    if unknown:
        parser.error(f"no kind {unknown[0]}; there are: {', '.join(KINDS)}")
    if not options.minutes and options.count is None:
        parser.error("say how long: --minutes N or --count N")
    options.flyball = os.path.abspath(options.flyball)
    if not os.access(options.flyball, os.X_OK):
        parser.error(f"no program {options.flyball}; build it, or name it with --flyball")
    packets = pathlib.Path(options.flyball).parent.parent / "fuzz/packets.so"
    options.packets = options.packets or (str(packets) if packets.exists() else None)
    return options


def main():
    options = parsed()
    if options.packets is None and "library" in options.kinds:
        print("kind library is left out: no fuzz/packets.so; build target fuzz_packets")
        options.kinds.remove("library")
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, interrupt)
    with tempfile.TemporaryDirectory(prefix="flyball_fuzz_seeds_") as scratch:
        driver = Driver(options, Seeds(options.flyball, options.packets, options.found,
                                       pathlib.Path(scratch)))
        interrupted = False
        try:
            driver.run()
        except Interrupted:
            interrupted = True
        print(("interrupted\n" if interrupted else "") + driver.table())
    if interrupted:
        return 130
    return 1 if any(t.findings for t in driver.tallies.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
