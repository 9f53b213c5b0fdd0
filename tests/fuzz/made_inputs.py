# SPDX-License-Identifier: BSD-3-Clause
"""Small good files of formats that the project reads and does not ship: meshes, pictures, videos,
recordings. All are made here, byte by byte, so that nothing needs to be installed."""

import base64
import math
import random
import struct
import zlib

CORNERS = [(x, y, z) for x in (0.0, 4.0) for y in (0.0, 3.0) for z in (0.0, 2.0)]
FACES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6),
         (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]

def jpeg():
    """A grey JPEG image of 16 x 16 pixels, whose four blocks are plain."""
    def segment(marker, content):
        return struct.pack(">BBH", 255, marker, 2 + len(content)) + content
    dc = b"\0" + bytes([0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]) + b"\7"  # Code 00: 7 bits.
    ac = b"\x10" + bytes([1] + 15 * [0]) + b"\0"  # Code 0: no more in this block.
    steps = [100, 27, 27, 100]  # Below 64 the difference is step - 127.
    bits = "".join("00" + format(step, "07b") + "0" for step in steps)
    bits += "1" * (-len(bits) % 8)
    scan = int(bits, 2).to_bytes(len(bits) // 8, "big").replace(b"\xff", b"\xff\0")
    return (b"\xff\xd8" + segment(0xe0, b"JFIF\0\1\1\0\0\1\0\1\0\0") +
            segment(0xdb, b"\0" + 64 * b"\x08") +
            segment(0xc0, struct.pack(">BHHB3B", 8, 16, 16, 1, 1, 0x11, 0)) + segment(0xc4, dc) +
            segment(0xc4, ac) + segment(0xda, b"\1\1\0\0\x3f\0") + scan + b"\xff\xd9")


def meshes():
    """A box in each of the common formats, by file name."""
    vertices = "".join(f"v {x} {y} {z}\n" for x, y, z in CORNERS)
    obj = "mtllib box.mtl\no box\n" + vertices + "".join(
        f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in FACES)
    off = f"OFF\n8 12 0\n" + "".join(f"{x} {y} {z}\n" for x, y, z in CORNERS) + "".join(
        f"3 {a} {b} {c}\n" for a, b, c in FACES)
    head = ("ply\nformat {} 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
            "property float z\nelement face 12\nproperty list uchar int vertex_indices\nend_header\n")
    ply = head.format("ascii") + off.split("\n", 2)[2]
    binary_ply = head.format("binary_little_endian").encode() + b"".join(
        struct.pack("<3f", *p) for p in CORNERS) + b"".join(
            struct.pack("<B3i", 3, *face) for face in FACES)
    stl = "solid box\n" + "".join(
        "facet normal 0 0 1\nouter loop\n" +
        "".join("vertex {} {} {}\n".format(*CORNERS[i]) for i in face) + "endloop\nendfacet\n"
        for face in FACES) + "endsolid box\n"
    binary_stl = b"\0" * 80 + struct.pack("<I", 12) + b"".join(
        struct.pack("<3f", 0, 0, 1) + b"".join(struct.pack("<3f", *CORNERS[i]) for i in face) +
        b"\0\0" for face in FACES)
    return {"box.obj": obj.encode(), "box.off": off.encode(), "text.ply": ply.encode(),
            "binary.ply": binary_ply, "text.stl": stl.encode(), "binary.stl": binary_stl,
            "box.dae": _collada().encode(), "box.gltf": _gltf().encode()}


def _collada():
    numbers = " ".join(str(v) for p in CORNERS for v in p)
    indices = " ".join(str(i) for face in FACES for i in face)
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1" name="meter"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="box"><mesh>
<source id="p"><float_array id="a" count="24">{numbers}</float_array><technique_common>
<accessor source="#a" count="8" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/><p>{indices}</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#box"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
"""


def _gltf():
    points = b"".join(struct.pack("<3f", *p) for p in CORNERS)
    indices = b"".join(struct.pack("<3H", *face) for face in FACES)
    packed = base64.b64encode(points + indices).decode()
    return f"""{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}],
"nodes": [{{"mesh": 0}}],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1}}]}}],
"buffers": [{{"uri": "data:application/octet-stream;base64,{packed}", "byteLength": {len(points) + len(indices)}}}],
"bufferViews": [{{"buffer": 0, "byteOffset": 0, "byteLength": {len(points)}}},
{{"buffer": 0, "byteOffset": {len(points)}, "byteLength": {len(indices)}}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3",
"min": [0, 0, 0], "max": [4, 3, 2]}},
{{"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}}]}}
"""


def png(width, height, rows, bits=8, colour=0):
    """`colour` as in the format: 0 grey, 2 red-green-blue."""
    def chunk(name, content):
        return (struct.pack(">I", len(content)) + name + content +
                struct.pack(">I", zlib.crc32(name + content)))
    header = struct.pack(">IIBBBBB", width, height, bits, colour, 0, 0, 0)
    packed = zlib.compress(b"".join(b"\0" + row for row in rows), 6)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", packed) +
            chunk(b"IEND", b""))


def repaired_png(content):
    """With check sums that fit again: else a reader looks no further than the first wrong one."""
    out, at = bytearray(content[:8]), 8
    while at + 12 <= len(content):
        size = int.from_bytes(content[at:at + 4], "big")
        end = at + 12 + size
        if end > len(content):
            break
        out += content[at:end - 4] + struct.pack(">I", zlib.crc32(content[at + 4:end - 4]))
        at = end
    return bytes(out) + content[at:]


def _noise(width, height, channels=1, seed=1):
    rng = random.Random(seed)
    return [rng.randbytes(width * channels) for _ in range(height)]


def pictures():
    """By file name, as detect reads them."""
    rows = _noise(80, 160, 3)
    flat = b"".join(rows)
    bmp = struct.pack("<2sIHHI", b"BM", 54 + len(flat), 0, 0, 54) + struct.pack(
        "<IiiHHIIiiII", 40, 80, 160, 1, 24, 0, len(flat), 2835, 2835, 0, 0) + flat
    tags = [(256, 4, 1, 80), (257, 4, 1, 160), (258, 3, 1, 8), (259, 3, 1, 1), (262, 3, 1, 1),
            (273, 4, 1, 8), (277, 3, 1, 1), (278, 4, 1, 160), (279, 4, 1, 12800)]
    tiff = struct.pack("<2sHI", b"II", 42, 8 + 12800) + flat[:12800] + struct.pack(
        "<H", len(tags)) + b"".join(struct.pack("<HHII", *tag) for tag in tags) + b"\0" * 4
    yuv = b"YUV4MPEG2 W32 H32 F25:1 Ip A0:0 C420jpeg\n" + 3 * (b"FRAME\n" + flat[:32 * 32 * 3 // 2])
    return {"rgb.png": png(80, 160, rows, 8, 2), "grey.png": png(80, 160, _noise(80, 160)),
            "grey.jpg": jpeg(), "rgb.ppm": b"P6\n80 160\n255\n" + flat, "rgb.bmp": bmp,
            "grey.tif": tiff, "video.y4m": yuv, "video.avi": _avi()}


def _avi():
    def chunk(name, content):
        return name + struct.pack("<I", len(content)) + content + b"\0" * (len(content) % 2)
    def group(kind, name, content):
        return chunk(kind, name + content)
    main = struct.pack("<14I", 40000, 100000, 0, 16, 3, 0, 1, 4096, 16, 16, 0, 0, 0, 0)
    stream = struct.pack("<4s4sIHHIIIIIIII4H", b"vids", b"MJPG", 0, 0, 0, 0, 1, 25, 0, 3, 4096,
                         0xffffffff, 0, 0, 0, 16, 16)
    picture = struct.pack("<IiiHHIIiiII", 40, 16, 16, 1, 24, int.from_bytes(b"MJPG", "little"), 768,
                          0, 0, 0, 0)
    head = group(b"LIST", b"hdrl", chunk(b"avih", main) + group(
        b"LIST", b"strl", chunk(b"strh", stream) + chunk(b"strf", picture)))
    return group(b"RIFF", b"AVI ", head + group(b"LIST", b"movi", 3 * chunk(b"00dc", jpeg())))


def _frames(folder, stamps):
    """Grey images of a textured wall that moves by a pixel a frame, 96 x 72 pixels."""
    wide = _noise(96 + len(stamps), 72)
    return {f"{folder}/{stamp}.png": png(96, 72, [row[i:i + 96] for row in wide])
            for i, stamp in enumerate(stamps)}


def tum_recording():
    """Files of a recording in TUM's layout, by name."""
    stamps = [f"{1 + i / 20:.6f}" for i in range(5)]
    depth_row = struct.pack(">96H", *[8000 + 20 * x for x in range(96)])
    files = _frames("rgb", stamps)
    files.update({f"depth/{s}.png": png(96, 72, [depth_row] * 72, 16) for s in stamps})
    for kind in ("rgb", "depth"):
        files[f"{kind}.txt"] = "".join(f"{s} {kind}/{s}.png\n" for s in stamps).encode()
    files["groundtruth.txt"] = ("# timestamp tx ty tz qx qy qz qw\n" + "".join(
        f"{s} {0.01 * i} 0 1 0 0 0 1\n" for i, s in enumerate(stamps))).encode()
    times = [f"{0.9 + i / 200:.4f}" for i in range(80)]
    files["accelerometer.txt"] = "".join(f"{t} 0 0 9.81\n" for t in times).encode()
    files["gyroscope.txt"] = "".join(f"{t} 0 0 {0.01 * math.sin(i)}\n"
                                     for i, t in enumerate(times)).encode()
    return files


def euroc_recording():
    """Files of a recording in EuRoC's layout, by name."""
    stamps = [str(1_000_000_000 + 50_000_000 * i) for i in range(5)]
    files = _frames("mav0/cam0/data", stamps)
    files["mav0/cam0/data.csv"] = ("#timestamp [ns],filename\n" + "".join(
        f"{s},{s}.png\n" for s in stamps)).encode()
    files["mav0/cam0/sensor.yaml"] = (
        b"sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n"
        b"  data: [0.0, 0.0, 1.0, 0.0,\n -1.0, 0.0, 0.0, 0.0,\n 0.0, -1.0, 0.0, 0.0,\n"
        b" 0.0, 0.0, 0.0, 1.0]\nrate_hz: 20\nresolution: [96, 72]\ncamera_model: pinhole\n"
        b"intrinsics: [80.0, 80.0, 48.0, 36.0]\ndistortion_model: radial-tangential\n"
        b"distortion_coefficients: [-0.28, 0.07, 0.0002, 0.00002]\n")
    files["mav0/imu0/data.csv"] = ("#timestamp [ns],w,w,w,a,a,a\n" + "".join(
        f"{900_000_000 + 5_000_000 * i},0,0,{0.01 * math.sin(i)},0,0,9.81\n"
        for i in range(80))).encode()
    files["mav0/state_groundtruth_estimate0/data.csv"] = ("#timestamp,p,p,p,q,q,q,q\n" + "".join(
        f"{s},{0.01 * i},0,1,1,0,0,0\n" for i, s in enumerate(stamps))).encode()
    return files


def board_tree():
    """What a board of two cores shows below /sys, as far as `flyball board` looks at it, and the
    journal of a session that was killed there."""
    cpu = "sys/devices/system/cpu"
    clocks = {"scaling_available_frequencies": "345600 960000 2035200 ", "related_cpus": "0 1",
              "affected_cpus": "0 1", "cpuinfo_min_freq": "345600", "cpuinfo_max_freq": "2035200",
              "scaling_min_freq": "345600", "scaling_max_freq": "2035200",
              "scaling_cur_freq": "960000", "scaling_driver": "tegra_cpufreq",
              "scaling_governor": "userspace", "scaling_setspeed": "960000",
              "scaling_available_governors": "schedutil userspace performance "}
    zone, rail = "sys/class/thermal/thermal_zone0", "sys/bus/i2c/drivers/ina3221x/0-0041"
    governor = f"/{cpu}/cpufreq/policy0/scaling_governor"
    files = {f"{cpu}/cpufreq/policy0/{name}": text + "\n" for name, text in clocks.items()}
    files.update({
        f"{cpu}/cpu0/topology/core_id": "0\n", f"{cpu}/cpu1/topology/core_id": "1\n",
        f"{cpu}/cpu1/online": "1\n", f"{cpu}/present": "0-1\n", f"{cpu}/online": "0-1\n",
        f"{zone}/type": "MCPU-therm\n", f"{zone}/temp": "43000\n",
        f"{zone}/trip_point_0_type": "passive\n", f"{zone}/trip_point_0_temp": "95500\n",
        f"{rail}/rail_name_0": "VDD_IN\n", f"{rail}/in_power0_input": "5100\n",
        "proc/device-tree/model": "NVIDIA Jetson TX2 Developer Kit\0",
        "proc/cmdline": "root=/dev/mmcblk0p1 isolcpus= \n", "proc/12/comm": "nvpmodel\n",
        "run/board.journal": f"{len(governor)}\n{governor}\n10\nschedutil\n\n"})
    return {name: text.encode() for name, text in files.items()}


def autopilot_flight(maker, commanded, landing):
    """What targets/mavlink_fuzzer.cpp takes: messages of an autopilot and commands to it, from the
    first heartbeat to the landing. `commanded` and `landing` are its modes."""
    heard, parameter, attitude, position, answer, landed = range(6)  # As kinds_from_autopilot has them.
    hold, follow, take_off, land = 10, 11, 12, 13

    def record(which, content=b"", milliseconds=20):
        return bytes([which, milliseconds // 4]) + content

    def beat(mode, is_armed):
        return record(heard, struct.pack("<IBBBBB", mode, 2, maker, 128 if is_armed else 0, 4, 3))

    def yes_to(command):
        return record(answer, struct.pack("<HBBiBB", command, 0, 0, 0, 1, 191))

    def pose(time_ms, down_m):
        return (record(position, struct.pack("<I6f", time_ms, 1.0, 2.0, down_m, 0.0, 0.0, 0.0)) +
                record(attitude, struct.pack("<I11f", time_ms, 1.0, *[0.0] * 10)))

    on_ground, in_air = record(landed, bytes([0, 1])), record(landed, bytes([0, 2]))
    guided_timeout = record(parameter, struct.pack("<fHH16sB", 0.5, 1, 0, b"GUID_TIMEOUT", 9))
    connected = beat(0, False) + yes_to(511) * 5 + guided_timeout + on_ground + pose(1000, 0.0) * 2
    up = (record(take_off) + record(15, bytes(24), 1000) * 2 + yes_to(176) + beat(commanded, False) +
          yes_to(400) + beat(commanded, True) + yes_to(22) + in_air + pose(4000, -2.0))
    flown = record(follow) * 3 + record(hold) + record(follow) + pose(4200, -2.0)
    down = record(land) + yes_to(21) + beat(landing, True) + on_ground + beat(landing, False)
    return connected + up + flown + down
