#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Flies PX4 and ArduCopter, as programs of their own in their own simulations, with
`flyball run --executor realtime --autopilot`, and prints as a table what happened where everything
goes well and where something goes wrong: Ctrl-C, a pilot who takes over, a Flyball that is killed or
that freezes. Nothing here builds an autopilot: name what you have built with --px4 (the build's
folder, such as build/px4_sitl_default, which flies its own vehicle, sihsim_quadx) and --arducopter
(the program build/sitl/bin/arducopter).

This script speaks MAVLink of its own, as a second ground station: it sees whether the vehicle is
armed, in which mode and where, so that not only Flyball says how a flight ended.

Exits with 1 where a case did not end as expected. It takes about 8 minutes for each autopilot.
"""

import argparse
import json
import os
import pathlib
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time

HEARTBEAT, LOCAL_POSITION, COMMAND = 0, 32, 76
SET_MODE, MESSAGE_INTERVAL = 176, 511
COMMAND_SEED = 152  # Of its checksum (the message's CRC_EXTRA).
ARMED = 0x80
# A field that is known to be free, so that the vehicle may be as far off its path as GPS lets it.
FIELD = ["delivery_open", "--set", "world.goal_distance_m=60", "--set", "world.clear_m=3", "--set",
         "world.clear_height_m=4"]
IN_FLIGHT_S = 12.0  # After the vehicle has left the ground.


def checksum(data):
    """X.25, as MAVLink has it."""
    crc = 0xFFFF
    for byte in data:
        byte ^= crc & 0xFF
        byte ^= (byte << 4) & 0xFF
        crc = (crc >> 8) ^ (byte << 8) ^ (byte << 3) ^ (byte >> 4)
    return crc


def command(number, *parameters):
    payload = struct.pack("<7fHBBB", *(list(parameters) + [0.0] * 7)[:7], number, 1, 1, 0)
    body = struct.pack("<BBBBBB", len(payload), 0, 0, 0, 255, 190) + COMMAND.to_bytes(3, "little")
    body += payload
    return b"\xfd" + body + struct.pack("<H", checksum(body + bytes([COMMAND_SEED])))


class Station:
    """What a ground station sees of the vehicle."""

    def __init__(self):
        self.mode, self.armed, self.place, self.speed = None, False, None, 0.0

    def hear(self, data):
        at = 0
        while at + 12 <= len(data):
            if data[at] != 0xFD:
                at += 1
                continue
            length, kind = data[at + 1], int.from_bytes(data[at + 7:at + 10], "little")
            payload = data[at + 10:at + 10 + length].ljust(28, b"\0")
            if kind == HEARTBEAT and data[at + 6] == 1:
                self.mode, self.armed = struct.unpack_from("<I", payload)[0], bool(payload[6] & ARMED)
            elif kind == LOCAL_POSITION:
                north, east, down, *speed = struct.unpack_from("<6f", payload, 4)
                self.place, self.speed = (north, east, down), sum(v * v for v in speed) ** 0.5
            at += 12 + length


class Autopilot:
    def __init__(self, folder):
        self.folder = folder
        folder.mkdir(parents=True, exist_ok=True)
        self.station, self.program, self.link = Station(), None, None

    def start(self, words, environment=None):
        log = (self.folder / "said").open("w")
        self.program = subprocess.Popen(words, cwd=self.folder, stdout=log, stderr=log,
                                        stdin=subprocess.DEVNULL, env=environment)

    def stop(self):
        self.program.kill()
        self.program.wait()
        self.link.close()

    def listen(self, for_s):
        until = time.monotonic() + for_s
        while time.monotonic() < until:
            self.link.settimeout(max(0.01, until - time.monotonic()))
            try:
                self.hear()
            except OSError:
                pass

    def await_that(self, happened, within_s):
        until = time.monotonic() + within_s
        while not happened() and time.monotonic() < until:
            self.listen(0.05)
        return happened()

    def is_up(self):
        place = self.station.place
        return self.station.armed and place is not None and place[2] < self.ground_down - 1.0


class Px4(Autopilot):
    name, address, tracking_error_m = "PX4", "udp:127.0.0.1:14540", 0.6
    commanded, taken = 6 << 16, (4 << 16) | (3 << 24)  # Off-board, hold.
    after_kill = "leaves off-board by itself"

    def __init__(self, build, folder):
        super().__init__(folder)
        etc = build / "etc"
        self.start([build / "bin/px4", "-d", etc, "-s", etc / "init.d-posix/rcS", "-w", folder],
                   dict(os.environ, PX4_SIM_MODEL="sihsim_quadx", PX4_SIMULATOR="sihsim",
                        PATH=f"{build}/bin:{os.environ['PATH']}"))
        self.link = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.link.bind(("127.0.0.1", 14550))
        self.ground_down = 0.0

    def hear(self):
        data, self.sender = self.link.recvfrom(65536)
        self.station.hear(data)

    def say(self, data):
        self.link.sendto(data, self.sender)


class ArduCopter(Autopilot):
    name, address, tracking_error_m = "ArduCopter", "udp:127.0.0.1:14540", 0.3
    commanded, taken = 4, 5  # GUIDED, LOITER.
    after_kill = "stops by itself, in GUIDED"

    def __init__(self, program, folder):
        super().__init__(folder)
        # As apps/vehicles/README.md wants them, by the names before and after 4.7: ArduPilot skips those
        # that it does not know.
        (folder / "flyball.parm").write_text("GUID_TIMEOUT 0.5\nWPNAV_ACCEL 300\nWP_ACC 3\nPSC_JERK_XY 20\n"
                                             "PSC_JERK_NE 20\nPSC_NE_JERK 20\n")
        defaults = program.parents[3] / "Tools/autotest/default_params/copter.parm"
        self.start([program, "--model", "quad", "--wipe", "--defaults",
                    f"{defaults},{folder}/flyball.parm", "--serial0", "udpclient:127.0.0.1:14540"])
        for _ in range(100):  # Its second line waits for nobody.
            try:
                self.link = socket.create_connection(("127.0.0.1", 5762), 1.0)
                break
            except OSError:
                time.sleep(0.2)
        self.ground_down = 0.0

    def hear(self):
        self.station.hear(self.link.recv(65536))

    def say(self, data):
        self.link.sendall(data)


def heed_interrupts():
    """A shell that starts this script in the background has it, and its children, ignore Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class Flight:
    def __init__(self, flyball, autopilot, folder, words):
        self.folder, self.autopilot = folder, autopilot
        folder.mkdir(parents=True, exist_ok=True)
        self.errors = folder / "errors"
        self.program = subprocess.Popen(
            [flyball, "run", *words, "--executor", "realtime", "--autopilot", autopilot.address,
             "--out", folder / "record", "--json"],
            stdout=(folder / "summary").open("w"), stderr=self.errors.open("w"),
            preexec_fn=heed_interrupts)

    def until_up(self):
        if not self.autopilot.await_that(self.autopilot.is_up, 150.0):
            raise TimeoutError("the vehicle did not take off: " + self.errors.read_text())
        self.autopilot.listen(IN_FLIGHT_S)
        self.autopilot.await_that(lambda: self.autopilot.station.speed > 1.0, 30.0)

    def end(self, within_s):
        self.autopilot.await_that(lambda: self.program.poll() is not None, within_s)
        if self.program.poll() is None:
            self.program.kill()
            return "did not end"
        return self.program.returncode

    def summary(self):
        return json.loads((self.folder / "summary").read_text())

    def says(self, words):
        return words in self.errors.read_text()


def deliver(flight, autopilot):
    code = flight.end(400.0)
    home = autopilot.station
    if code != 0:
        return False, f"exit {code}: {flight.errors.read_text().strip()[-200:]}"
    s = flight.summary()
    off = (home.place[0] ** 2 + home.place[1] ** 2) ** 0.5
    return (not home.armed and off < 1.5), (
        f"{s['mission_time_s']:.0f} s, up to {s['max_speed_m_s']:.1f} m/s, 95 % within "
        f"{s['quality']['off_path_m_p95']:.2f} m of the path, home within {off:.2f} m")


def interrupt(flight, autopilot):
    flight.until_up()
    flight.program.send_signal(signal.SIGINT)
    code = flight.end(90.0)
    autopilot.listen(1.5)
    return (code == 130 and not autopilot.station.armed), (
        f"exit {code}, {'armed' if autopilot.station.armed else 'on the ground, disarmed'}")


def take_over(flight, autopilot):
    flight.until_up()
    mode = autopilot.taken
    asked = time.monotonic()
    autopilot.say(command(SET_MODE, 1.0, mode if mode < 256 else (mode >> 16) & 0xFF,
                          (mode >> 24) & 0xFF))
    code = flight.end(30.0)
    took = time.monotonic() - asked
    autopilot.listen(3.0)
    still = autopilot.station.mode == mode and autopilot.station.armed
    return (code == 1 and still and flight.says("somebody took over")), (
        f"exit {code} after {took:.1f} s, {'still' if still else 'no longer'} armed in that mode")


def kill(flight, autopilot):
    flight.until_up()
    begun, speed = autopilot.station.place, autopilot.station.speed
    flight.program.kill()
    flight.program.wait()
    stopped = autopilot.await_that(lambda: autopilot.station.speed < 0.5, 10.0)
    autopilot.listen(3.0)
    far = sum((a - b) ** 2 for a, b in zip(begun, autopilot.station.place)) ** 0.5
    kept = autopilot.station.mode == autopilot.commanded
    return (stopped and autopilot.station.armed), (
        f"at {speed:.1f} m/s; stands {far:.1f} m farther on, "
        f"{'in the commanded mode' if kept else 'in a mode of its own'}")


def freeze(flight, autopilot):
    flight.until_up()
    flight.program.send_signal(signal.SIGSTOP)
    autopilot.listen(8.0)
    speed = autopilot.station.speed
    flight.program.send_signal(signal.SIGCONT)
    code = flight.end(90.0)
    autopilot.listen(1.5)
    said = "somebody took over" if flight.says("somebody took over") else (
        "it lands" if flight.says("has not moved on") else "nothing")
    return (speed < 0.6 and code == 1 and said != "nothing"), (
        f"meanwhile {speed:.1f} m/s; then exit {code}, it says: {said}")


CASES = {
    "delivery": ("both legs, home, disarmed", deliver),
    "Ctrl-C in flight": ("lands, exit 130", interrupt),
    "a pilot takes over": ("Flyball lets go, the mode stays", take_over),
    "Flyball is killed": ("the autopilot stops and holds", kill),
    "Flyball freezes for 8 s": ("the autopilot stops; the flight is over", freeze),
}


def fly_case(args, kind, where, case, folder):
    autopilot = kind(where, folder / "autopilot")
    try:
        autopilot.await_that(lambda: autopilot.station.mode is not None, 30.0)
        autopilot.say(command(MESSAGE_INTERVAL, float(LOCAL_POSITION), 50e3))
        words = [*FIELD, "--set", f"vehicle.tracking_error_m={autopilot.tracking_error_m}"]
        flight = Flight(args.flyball, autopilot, folder / "flight", words)
        try:
            return CASES[case][1](flight, autopilot)
        except TimeoutError as late:
            return False, str(late).replace("\n", " ")
        finally:
            if flight.program.poll() is None:
                flight.program.kill()
    finally:
        autopilot.stop()


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--flyball", default="flyball")
    parser.add_argument("--px4", type=pathlib.Path, metavar="BUILD")
    parser.add_argument("--arducopter", type=pathlib.Path, metavar="PROGRAM")
    parser.add_argument("--case", choices=CASES, action="append", help="default: all")
    parser.add_argument("--out", type=pathlib.Path, default=None, help="default: a new folder")
    args = parser.parse_args()
    kinds = [(kind, where.resolve()) for kind, where in ((Px4, args.px4), (ArduCopter, args.arducopter))
             if where]
    if not kinds:
        parser.error("name an autopilot that you have built: --px4 BUILD, --arducopter PROGRAM")
    out = args.out or pathlib.Path(tempfile.mkdtemp(prefix="autopilots-"))
    rows = ["| autopilot | case | expected | what happened | as expected |", "|---|---|---|---|---|"]
    passed = True
    for kind, where in kinds:
        for case in args.case or CASES:
            if sys.stderr.isatty():
                print(f"{kind.name}: {case}", file=sys.stderr)
            good, what = fly_case(args, kind, where, case, out.resolve() / kind.name / case.replace(" ", "_"))
            rows.append(f"| {kind.name} | {case} | {CASES[case][0]} | {what} | {'yes' if good else 'NO'} |")
            passed &= good
    print("\n".join(rows))
    return 0 if passed else 1


if __name__ == "__main__":
    sys.exit(main())
