# SPDX-License-Identifier: BSD-3-Clause
"""The kinds of input that the program reads: for each, how a case is made, and what is run on it.

A maker writes damaged files into the current case's folder and returns the commands to run there,
each a list of arguments of `flyball`. To add a kind, write a maker and name it in KINDS.
"""

import json
import pathlib
import subprocess

import made_inputs
from mutations import damaged

# Long enough that the policy decides some times, short enough that a case takes a second.
SHORT = ["--set", "mission.time_limit_s=1"]
TINY = SHORT + ["--set", "camera.width_px=32", "--set", "camera.height_px=18"]


class Seeds:
    """The good inputs that are damaged: the shipped ones, made ones, and those of a folder."""

    def __init__(self, flyball, packets, found, scratch):
        self.flyball = flyball
        self.share = pathlib.Path(flyball).resolve().parent.parent / "share" / "flyball"
        self.source = pathlib.Path(__file__).resolve().parents[2]
        self.found = found
        self.scratch = scratch
        self.packets = pathlib.Path(packets).read_bytes() if packets else None
        self.made = {**made_inputs.meshes(), **made_inputs.pictures()}
        self.recordings = [made_inputs.tum_recording(), made_inputs.euroc_recording()]
        self.record = self.store = None

    def shipped(self, folder, *endings):
        """Contents by file name, in the order of names; with those that were found."""
        places = [self.share / folder, self.source / folder] + ([self.found] if self.found else [])
        return {file.name: file.read_bytes() for place in places if place.is_dir()
                for file in sorted(place.iterdir()) if file.suffix in endings}

    def made_of(self, *endings):
        files = {name: content for name, content in self.made.items()
                 if name.endswith(endings)}
        return {**files, **self.shipped("", *endings)}

    def run(self, arguments):
        subprocess.run([self.flyball, *arguments], cwd=self.scratch, check=True,
                       stdout=subprocess.DEVNULL, stdin=subprocess.DEVNULL)

    def flown_record(self):
        """A run's folder, without what differs from host to host."""
        if self.record is None:
            try:
                self.run(["run", "delivery_open", *TINY, "--set", "mission.time_limit_s=5",
                          "--out", "record"])
            except subprocess.CalledProcessError as ended:
                if ended.returncode != 1:  # The mission ran out of time, as it should.
                    raise
            folder = self.scratch / "record"
            summary = json.loads((folder / "summary.json").read_text())
            summary.update(host_s=1.0, real_time_factor=1.0)
            summary["decision_host_us"] = {"p50": 1.0, "p99": 2.0}
            for kernel in summary["kernels"].values():
                kernel["host_ms_mean"] = 1.0
            (folder / "summary.json").write_text(json.dumps(summary, indent=2))
            self.record = {name: (folder / name).read_bytes()
                           for name in ("trace.jsonl", "mission.toml", "summary.json")}
        return self.record

    def flown_store(self):
        """The results of a tournament of two short flights."""
        if self.store is None:
            self.run(tournament("tournament"))
            stores = [file for file in sorted((self.scratch / "tournament").rglob("*"))
                      if file.is_file() and file.read_bytes()[:6] == b"SQLite"]
            self.store = stores[0].name, stores[0].read_bytes()
        return self.store

    def small_map(self, ending):
        """A map that the program wrote itself, and those that were found."""
        name = "small" + ending
        if not (self.scratch / name).exists():
            for file, content in self.recordings[0].items():
                _write(self.scratch / "tum", file, content)
            self.run(["map", "from", "tum", "--out", name, "--range", "4"])
        return {name: (self.scratch / name).read_bytes(), **self.shipped("", ending)}

    def scripts(self):
        return {**self.shipped("tests/closed_loop", ".lua"),
                **self.shipped("examples/policies", ".lua")}


def tournament(folder):
    return ["tournament", "--worlds", "delivery_open", "--policies", "fixed_fine,fixed_coarse",
            "--seeds", "1..1", "--jobs", "1", *TINY, "--out", folder]


def _write(place, name, content):
    file = place / name
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(content)
    return name


def _damaged_one(rng, place, files, is_text, name=None):
    """Damages one of the files and writes it; returns its name, with its own ending."""
    names = sorted(files)
    chosen, other = rng.choice(names), rng.choice(names)
    ending = pathlib.PurePath(chosen).suffix
    return _write(place, (name or "input") + ending,
                  damaged(rng, files[chosen], files[other], is_text))


def scenario(rng, place, seeds):
    name = _damaged_one(rng, place, seeds.shipped("scenarios", ".toml"), True)
    return [["config", name], ["run", name, *TINY, "--out", "out"]]


def preset(rng, place, seeds):
    name = _damaged_one(rng, place, seeds.shipped("presets", ".toml"), True)
    return [["policy", "check", name],
            ["run", "delivery_open", *TINY, "--policy", name, "--out", "out"]]


def platform(rng, place, seeds):
    files = seeds.shipped("platforms", ".toml")
    for other, content in files.items():  # A platform may be like another one beside it.
        _write(place, other, content)
    name = _damaged_one(rng, place, files, True)
    return [["config", "delivery_open", "--set", "platform.name=" + name],
            ["run", "delivery_open", *TINY, "--set", "platform.name=" + name, "--out", "out"]]


def airframe(rng, place, seeds):
    name = _damaged_one(rng, place, seeds.shipped("airframes", ".toml"), True)
    return [["run", "delivery_open", *TINY, "--set", "vehicle.airframe=" + name, "--out", "out"]]


def _map_commands(name):
    in_map = ["--set", "world.generator=octomap_file", "--set", "world.file=" + name]
    return [["world", name, "--picture", "plan.png"], ["map", "info", name],
            ["map", "export", name, "again.bt"],
            ["run", "delivery_building_079", *TINY, *in_map, "--out", "out"],
            ["run", "delivery_open", *TINY, "--start-map", name, "--map", "new.ot", "--out", "out2"]]


def bt(rng, place, seeds):
    return _map_commands(_damaged_one(rng, place, seeds.small_map(".bt"), False))


def ot(rng, place, seeds):
    return _map_commands(_damaged_one(rng, place, seeds.small_map(".ot"), False))


def mesh(rng, place, seeds):
    files = seeds.made_of(".obj", ".off", ".ply", ".stl", ".dae", ".gltf")
    name = _damaged_one(rng, place, files, rng.random() < 0.5)
    flown = ["--set", "world.generator=mesh_file", "--set", "world.file=" + name,
             "--set", "world.goal_x_m=2"]
    return [["world", name, "--picture", "plan.png"],
            ["run", "delivery_open", *TINY, *flown, "--out", "out"]]


def picture(rng, place, seeds):
    files = seeds.made_of(".png", ".jpg", ".ppm", ".bmp", ".tif", ".y4m", ".avi")
    name = _damaged_one(rng, place, files, False)
    if name.endswith(".png") and rng.random() < 0.7:
        _write(place, name, made_inputs.repaired_png((place / name).read_bytes()))
    return [["detect", name, "--out", "boxes"], ["detect", "."]]


def recording(rng, place, seeds):
    files = dict(rng.choice(seeds.recordings))
    texts = [name for name in sorted(files) if not name.endswith(".png")]
    name = rng.choice(texts if rng.random() < 0.8 else sorted(files))
    files[name] = damaged(rng, files[name], b"", name in texts)
    if name.endswith(".png") and rng.random() < 0.7:
        files[name] = made_inputs.repaired_png(files[name])
    for file, content in files.items():
        _write(place, file, content)
    poses = _damaged_one(rng, place, {"groundtruth.txt": seeds.recordings[0]["groundtruth.txt"]},
                         True, "poses")
    return [["localize", ".", "--localizer", "visual_slam", "--out", "path.txt"],
            ["localize", ".", "--localizer", "visual_inertial"],
            ["map", "from", ".", "--out", "map.bt"],
            ["map", "from", ".", "--poses", poses, "--out", "posed.bt"]]


def board(rng, place, seeds):
    name = _damaged_one(rng, place, seeds.shipped("boards", ".toml"), True)
    files = made_inputs.board_tree()
    for file in rng.sample(sorted(files), rng.choice([0, 1, 4])):
        files[file] = damaged(rng, files[file], b"", True)
    for file, content in files.items():
        _write(place / "tree", file, content)
    return [["board", "--root", "tree", "--board", "./" + name], ["board", "--root", "tree"],
            ["board", "--root", "tree", "restore", "--run-folder", "tree/run"]]


def record(rng, place, seeds):
    files = dict(seeds.flown_record())
    name = rng.choice(sorted(files))
    files[name] = damaged(rng, files[name], b"", True)
    for file, content in files.items():
        _write(place / "flight", file, content)
    return [["replay", "flight"], ["replay", "flight", "--policy", "two_level"],
            ["explain", "flight", "--at", "1"]]


def store(rng, place, seeds):
    name, content = seeds.flown_store()
    _write(place / "tournament", name, damaged(rng, content, b"", rng.random() < 0.5))
    return [tournament("tournament")]


def lua(rng, place, seeds):
    name = _damaged_one(rng, place, seeds.scripts(), True)
    return [["policy", "check", name],
            ["run", "delivery_open", *TINY, "--policy", name, "--out", "out"]]


def library(rng, place, seeds):
    if seeds.packets is None:
        return None
    content = bytearray(seeds.packets)
    if rng.random() < 0.3:  # The file itself is damaged.
        content = bytearray(damaged(rng, bytes(content)))
    else:
        at = content.index(b"FLYBALL PACKETS' NOISE:") + 24
        content[at:at + 4] = bytes([rng.randrange(3), rng.choice([0, 0, 0, 0, 1, 200]),
                                    rng.choice([0, 0, 0, 3]), rng.randrange(2)])
        for _ in range(rng.choice([0, 1, 2, 8, 200])):
            content[at + 4 + rng.randrange(rng.choice([64, 600, 2200]))] = rng.randrange(256)
    _write(place, "input.so", bytes(content))
    return [["policy", "check", "./input.so"],
            ["run", "delivery_open", *TINY, "--policy", "./input.so", "--out", "out"]]


KINDS = {maker.__name__: maker for maker in (
    scenario, preset, platform, airframe, bt, ot, mesh, picture, recording, board, record,
    store, lua, library)}
