#!/usr/bin/env python3
"""Writes small seed corpora of the fuzz targets, made from config/ and models/.

    seeds.py FOLDER      writes FOLDER/cell, FOLDER/job, FOLDER/robot, FOLDER/http, FOLDER/store
"""

import json
import pathlib
import re
import sys

TOP = pathlib.Path(__file__).resolve().parents[2]

# Two links, a revolute and a mimic joint, every kind of shape: small, so that mutations reach everything quickly.
SMALL_URDF = """<robot name="s"><link name="l0"><collision><geometry><box size="0.1 0.2 0.3"/></geometry></collision>
</link><link name="l1"><collision><origin xyz="0 0 0.1" rpy="0 1 0"/><geometry><cylinder radius="0.05" length="0.3"/>
</geometry></collision></link><link name="l2"><collision><geometry><sphere radius="0.1"/></geometry></collision>
<visual><geometry><mesh filename="package://meshes/a.stl" scale="1 1 1"/></geometry></visual></link>
<joint name="j1" type="revolute"><parent link="l0"/><child link="l1"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="1" velocity="2"/></joint>
<joint name="j2" type="prismatic"><parent link="l1"/><child link="l2"/><origin xyz="0 0 1"/><axis xyz="1 0 0"/>
<limit lower="0" upper="0.1" effort="1" velocity="2"/><mimic joint="j1" multiplier="0.5" offset="0.1"/></joint></robot>"""
SMALL_SRDF = """<robot name="s"><group name="g"><chain base_link="l0" tip_link="l1"/></group>
<group name="h"><group name="g"/><joint name="j2"/><link name="l2"/></group>
<group_state name="up" group="g"><joint name="j1" value="0.5"/></group_state>
<virtual_joint name="v" type="fixed" parent_frame="world" child_link="l0"/>
<end_effector name="e" parent_link="l1" group="h"/>
<disable_collisions link1="l0" link2="l2" reason="Never"/><disable_default_collisions link="l1"/>
<enable_collisions link1="l0" link2="l1"/></robot>"""

SMALL_LIMITS = """joint_limits:
  j1: {has_velocity_limits: true, max_velocity: 1.5, has_acceleration_limits: true, max_acceleration: 2}
  j2:
    has_position_limits: true
    min_position: -1
    max_position: 1
    has_jerk_limits: false
default_velocity_scaling_factor: 0.1
"""


def uncommented(text):
    return re.sub(r"(?m)^\s*//.*$|\s//\s.*$", "", re.sub(r"/\*.*?\*/", "", text, flags=re.S))


def minified_xml(text):
    return re.sub(r">\s+<", "><", re.sub(r"<!--.*?-->|<\?.*?\?>", "", text, flags=re.S)).strip()


def job_seeds():
    timed = json.loads((TOP / "config/two_pandas_jobs.json").read_text())[0]
    job = timed["job"]
    points = job["trajectory"]["points"]
    job["trajectory"]["points"] = [points[0], points[-1]]
    yield job
    cubic = json.loads(json.dumps(job))
    cubic |= {"id": "pick-7", "name": "pick 7", "priority": -3, "backlog_timeout_s": 5.5,
              "after": ["place-6"], "on_timeout": "abort", "retime": False}
    for i, point in enumerate(cubic["trajectory"]["points"]):
        point.pop("accelerations", None)
        point["time_from_start"] = {"secs": 9 * i, "nsecs": 5}
    yield cubic
    yield {"trajectory": {"joint_trajectory": job["trajectory"], "multi_dof_joint_trajectory": {"points": []}}}
    yield [timed, {"at": 1.5, "job": cubic}]
    yield {"jobs": [job, cubic], "atomic": False}
    yield {"arm": "left", "kind": "late_start", "at_s": 1, "for_s": 2.5, "value": 0.5}
    yield {"steps": [{"wait_s": 1}, {"attach": {"object": "rod", "link": "left_panda_hand"}}]}


def cell_seeds():
    for file in sorted((TOP / "config").glob("*.json")):
        if not file.name.endswith(("_jobs.json", ".schema.json")):
            yield uncommented(file.read_text())
            yield file.read_text()
    yield json.dumps({"name": "rod", "cylinder": [0.015, 0.5], "xyz": [0, 0.9, 0.4], "rpy": [0, 0, 1]})
    yield json.dumps({"name": "c", "clearance_m": 0.02, "self_clearance_m": 0.005,
                      "robots": [{"name": "r", "urdf": "r.urdf", "srdf": "../r.srdf", "prefix": "r_",
                                  "base": {"xyz": [0, 0, 1], "rpy": [0, 0, 1.5]}, "packages": {"p": "../p"},
                                  "joint_limits": "joint_limits.yaml", "fixed": {"torso": 0.1},
                                  "arms": [{"name": "a", "group": "g", "home": [0],
                                            "limits": {"j": {"acceleration_rad_s2": 3, "jerk_rad_s3": 5,
                                                             "brake_rad_s2": 7}}}],
                                  "controller": {"type": "sim", "lag_s": 0.02, "noise_rad": 0}}],
                      "objects": [{"name": "b", "box": [1, 1, 1], "xyz": [0, 0, 0]}, {"name": "c", "cylinder": [0.1, 1]},
                                  {"name": "s", "sphere": [0.1]}, {"name": "m", "mesh": "m.stl"}],
                      "allowed_collisions": [["b", "r_l0"]],
                      "checking": {"time_step_s": 0.05, "tracking_error_rad": 0.001, "delay_s": 0.1,
                                   "limit_tolerance": 0.05},
                      "scheduling": {"policy": "sequential", "backlog_timeout_s": 60, "aging_s": 30,
                                     "on_idle_blocker": "park"},
                      "monitor": {"rate_hz": 100, "reaction_s": 0.02, "stop_clearance_m": 0.01},
                      "execution": {"start_tolerance_rad": 0.01, "duration_scaling": 1.1, "duration_margin_s": 0.5}})


def robot_seeds():
    yield "\n".join(["g", SMALL_URDF, "=== SRDF", SMALL_SRDF])
    yield "\n".join(["g", SMALL_URDF, "=== SRDF", SMALL_SRDF, "=== LIMITS", SMALL_LIMITS])
    yield "\n".join(["g", SMALL_URDF])
    for model, group in (("ur5e", "manipulator"), ("panda", "panda_arm")):
        files = [minified_xml((TOP / f"models/{model}{end}").read_text()) for end in (".urdf", ".srdf")]
        yield "\n".join([group, files[0], "=== SRDF", files[1]])


def http_seeds():
    ask = "GET /api/v1/jobs?state=running&limit=7 HTTP/1.1\r\nHost: localhost:8080\r\n"
    yield " " + ask + "If-None-Match: W/\"a\", \"b\"\r\nCookie: x=1; armloom_token=armloom_0\r\nX-Request-Id: a-1\r\n\r\n"
    yield " POST /api/v1/jobs HTTP/1.1\r\nHost: [::1]\r\nContent-Type: application/json\r\nContent-Length: 2\r\n\r\n{}" + ask + "\r\n"
    yield (" POST /api/v1/stop HTTP/1.1\r\nHost: cell7.example\r\nOrigin: https://station.example\r\n"
           "Transfer-Encoding: chunked\r\nTrailer: T\r\n\r\n2;e=\"f\"\r\n{}\r\n0\r\nT: 1\r\n\r\n")
    yield " OPTIONS * HTTP/1.2\r\nHost: a\r\n\r\nGET http://b/%41%2f?a=b+c&a=d HTTP/1.0\r\nExpect: 100-continue\r\n\r\n"
    yield (" " + ask + "Connection: keep-alive, Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
           "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n")
    # Frames masked with zeros: a text in two parts with a ping in between, a close with a reason.
    mask = "\0\0\0\0"
    yield "!\x01\x82" + mask + "he\x89\x80" + mask + "\x80\x83" + mask + "llo\x88\x84" + mask + "\x03\xe8by"
    yield "!\x81\xfe\x01\x00" + mask + 256 * "a" + "\x82\xff" + 7 * "\0" + "\x05" + mask + "12345"


def store_seeds():
    yield ""
    for place in (0, 18, 24, 40, 60, 100, 105, 4096, 4104, 8192, 12288, 16390):
        yield "".join(map(chr, (place & 255, place >> 8, 0, 0, 255)))
    yield "".join(map(chr, (0, 16, 0, 63, 0)))  # cut off after the first page


def main():
    for target, seeds in (("cell", cell_seeds()), ("job", map(json.dumps, job_seeds())), ("robot", robot_seeds()),
                          ("http", http_seeds()), ("store", store_seeds())):
        folder = pathlib.Path(sys.argv[1]) / target
        folder.mkdir(parents=True, exist_ok=True)
        for i, seed in enumerate(seeds):
            encoding = "latin-1" if target in ("http", "store") else "utf-8"
            (folder / f"seed-{i}").write_bytes(seed.encode(encoding))


if __name__ == "__main__":
    main()
