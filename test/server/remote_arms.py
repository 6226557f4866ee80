#!/usr/bin/env python3
"""Runs jobs on arms in other processes, and breaks these processes and their connections.

    test/server/remote_arms.py ARMLOOM [--only CASE ...] [--cuts 12] [--seed 1]

Each robot of config/two_pandas_remote.json is an `armloom arm` process behind a proxy, which delays messages, cuts the
connection, and reads all messages. In every case
- no arm passes the authority that it has acknowledged,
- an arm whose process or connection broke comes to rest, and does not move before it is resumed,
- the other arm goes on,
- `armloom replay` reproduces the session from its log.
"""
import argparse
import json
import pathlib
import random
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

from remote_cell import ENDED, Cell, Proxy, wait_for


# ---- Cases ----

def case_runs_jobs(cell, options):
    cell.await_up()
    cell.submit(3)
    for arm in cell.proxies:
        cell.await_end(arm)
        assert all(job["state"] == "succeeded" for job in cell.jobs(arm)), cell.jobs(arm)


def case_runs_jobs_over_a_slow_line(cell, options):
    cell.await_up()
    for delay_s in (0.01, 0.1, 0.25):  # each way
        for proxy in cell.proxies.values():
            proxy.delay_s = delay_s
        cell.submit(1)
        for arm in cell.proxies:
            wait_for(lambda arm=arm: cell.is_stopped(arm) or
                     all(job["state"] == "succeeded" for job in cell.jobs(arm)), f"an end of {arm}")
            if cell.is_stopped(arm):  # because of the change of the delay
                cell.stays_until_resumed(arm)
                cell.resume(arm)
                cell.await_end(arm)


def case_waits_for_its_arms(cell, options):
    wait_for(lambda: cell.arm("left")["link"] == "connecting", "a link that connects")
    assert cell.arm("left")["link_detail"], "the arm does not say why it waits"
    cell.submit(1)
    job = wait_for(lambda: next((job for job in cell.jobs("left") if job["waits_on"]), None), "a waiting job")
    assert job["state"] in ("queued", "backlogged"), job
    for arm in cell.proxies:
        cell.start_arm(arm)
    cell.await_up()
    for arm in cell.proxies:
        if cell.is_stopped(arm):
            cell.resume(arm)
        cell.await_end(arm)


def case_says_why_a_robot_does_not_fit(cell, options):
    """Answers the server's hello for the left robot with other lines; no arm is commanded."""
    joints = [f"left_panda_joint{i}" for i in range(1, 8)] + ["left_panda_finger_joint1"]
    fits = {"type": "welcome", "protocol": 1, "robot": "left", "arms": [{"name": "left", "joints": joints}],
            "reaction_s": 0.001, "feedback_period_s": 0.004}
    report = {"type": "feedback", "arm": "left", "sequence": 1, "time_ns": 1, "acknowledged": 0, "rejected": 0,
              "phase": "idle", "commanded_ns": 0, "measured_ns": 0, "authority_ns": 0, "positions": [0.0],
              "drives_on": True, "at_rest": True}
    answers = [({**fits, "robot": "right"}, 'robot "right" answers at unix:'),
               ({**fits, "protocol": 2}, "speaks version 2 of the protocol, this server version 1"),
               ({**fits, "feedback_period_s": 0.5}, "promises a feedback_period_s of 0.5 s, but the cell file relies on "
                "0.004 s: raise controller.feedback_period_s in the cell file, or send reports more often"),
               (fits, ": connected, but no report for "),
               ({**fits, "arms": [{"name": "left", "joints": joints[1:]}]}, "the joints of arm"),
               ({**fits, "arms": []}, "has 0 arms"),
               ({**fits, "speed": 1}, "/speed: "),
               ({"type": "error", "pointer": "/session", "detail": "in use"}, "refused the connection: /session: in use"),
               (report, "before its welcome"),
               ([fits, report], 'reports 1 positions of arm "left", which has 8 joints'),
               ("nonsense", "sent a bad message: line 1, column 2: this is not JSON")]
    answer, said = answers[0]
    listening = socket.socket(socket.AF_UNIX)
    listening.bind(cell.proxies["left"].target)
    listening.listen()

    def serve():
        while True:
            peer = listening.accept()[0]
            peer.recv(1 << 20)
            for line in answer if isinstance(answer, list) else [answer]:
                peer.sendall((line if isinstance(line, str) else json.dumps(line)).encode() + b"\n")

    threading.Thread(target=serve, daemon=True).start()
    cell.submit(1)
    for answer, said in answers:
        wait_for(lambda: said in (cell.arm("left")["link_detail"] or ""), said)
        assert cell.arm("left")["state"] == "stopped" and cell.proxies["left"].moves == 0
    wait_for(lambda: "right.sock: " in cell.arm("right")["link_detail"], "a reason for the robot that is not there")


def case_refuses_bad_input(cell, options):
    cell.await_up()
    arm = ["arm", "--cell", str(cell.file), "--robot", "left", "--listen"]
    for arguments, said in [
            (["serve", "--cell", str(cell.file), "--listen", "127.0.0.1:0", "--speed", "2"], "--speed: robot left has a remote"),
            ([*arm, "left.sock"], "--listen: not an endpoint: expected unix:PATH or tcp:HOST:PORT"),
            ([*arm, f"unix:{cell.folder}/left-robot.sock"], "another process listens there"),
            ([*arm, f"unix:{cell.file}"], "the file exists and is no socket of an arm"),
            ([*arm, f"unix:{cell.folder}/none/left.sock"], "No such file or directory"),
            (["arm", "--cell", str(cell.file), "--robot", "middle", "--listen", "tcp:127.0.0.1:0"],
             "--robot: the cell has no such robot; it has: left, right (found \"middle\")"),
            (["arm", "--cell", str(cell.file), "--robot", "left"], "--listen is required")]:
        ended = subprocess.run([cell.program, *arguments], capture_output=True, text=True, timeout=60)
        assert ended.returncode == 2 and said in ended.stderr + ended.stdout, f"{arguments}: {ended}"
    answer = cell.call("PUT", "/sim/speed", {"speed": 2.0})
    assert "real time" in json.dumps(answer), answer


def other_goes_on(cell, breaks, mends):
    """Breaks the left arm in motion; the right one must finish its jobs."""
    cell.await_up()
    cell.submit(2, 2.0)
    cell.await_motion("left")
    breaks()
    cell.await_stop("left")
    mends()
    cell.stays_until_resumed("left")
    for job in cell.jobs("right"):
        assert job["state"] != "failed", job
    cell.resume("left")
    for arm in ("right", "left"):
        cell.await_end(arm)
    assert all(job["state"] == "succeeded" for job in cell.jobs("right")), cell.jobs("right")


def case_process_is_frozen(cell, options):
    other_goes_on(cell, lambda: cell.arms["left"].send_signal(signal.SIGSTOP),
                  lambda: cell.arms["left"].send_signal(signal.SIGCONT))


def case_process_is_killed(cell, options):
    def kill():
        cell.arms["left"].kill()
        cell.arms["left"].wait()

    other_goes_on(cell, kill, lambda: cell.start_arm("left"))


def case_connection_is_cut(cell, options):
    other_goes_on(cell, lambda: Proxy.cut(cell.proxies["left"].open), lambda: None)


def case_connection_is_cut_at_each_message(cell, options):
    cell.await_up()
    rng, reached = random.Random(options.seed), 0
    for number in range(1, options.cuts + 1):
        arm = rng.choice(list(cell.proxies))
        proxy = cell.proxies[arm]
        proxy.count, proxy.cut_at, connections = 0, number, proxy.connections
        cell.submit(1)
        wait_for(lambda: proxy.cut_at is None or not cell.open_jobs(arm), f"message {number}")
        reached += proxy.cut_at is None
        if proxy.cut_at is None:
            wait_for(lambda: proxy.connections > connections, "the next connection")
            wait_for(lambda: cell.is_stopped(arm), f"a stop of {arm}")
            cell.stays_until_resumed(arm)
        proxy.cut_at = None
        for name in filter(cell.is_stopped, cell.proxies):
            cell.resume(name)
        for name in cell.proxies:
            cell.await_end(name)
    assert reached >= 2, f"only {reached} cuts came where they were to"


def case_server_is_killed(cell, options):
    cell.await_up()
    cell.submit(2, 3.0)
    for arm in cell.proxies:
        cell.await_motion(arm)
    cell.server.kill()
    cell.server.wait()
    cell.start_server()
    cell.await_up()
    for arm, proxy in cell.proxies.items():
        wait_for(lambda proxy=proxy: proxy.last["phase"] == "idle", f"the end of the motion of another session of {arm}")
        assert cell.is_stopped(arm), f"{arm} may move before it is resumed"
        cell.stays_until_resumed(arm)
    cell.call("POST", "/resume")
    for arm in cell.proxies:
        cell.await_end(arm)


def case_server_is_frozen(cell, options):
    cell.await_up()
    cell.submit(1, 6.0)
    for arm in cell.proxies:
        cell.await_motion(arm)
    cell.server.send_signal(signal.SIGSTOP)
    for arm, proxy in cell.proxies.items():
        wait_for(lambda proxy=proxy: proxy.last["phase"] == "stopped", f"a brake of {arm}")
        assert proxy.last["commanded_ns"] < 6_000_000_000, "did not brake"
    cell.server.send_signal(signal.SIGCONT)
    for arm, proxy in cell.proxies.items():
        wait_for(lambda arm=arm: cell.arm(arm)["link"] == "up", f"the link of {arm}")
        wait_for(lambda arm=arm: cell.arm(arm)["state"] == "stopped", f"a stop of {arm}")
        assert proxy.last["phase"] == "stopped", f"{arm} moved on without a resume"


CASES = {name[5:]: case for name, case in list(globals().items()) if name.startswith("case_")}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--only", nargs="+", choices=list(CASES), default=list(CASES))
    parser.add_argument("--cuts", type=int, default=12)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    for name in options.only:
        began = time.monotonic()
        with tempfile.TemporaryDirectory(prefix="armloom-remote-") as folder:
            cell = Cell(options.program, pathlib.Path(folder),
                        start_arms=name not in ("waits_for_its_arms", "says_why_a_robot_does_not_fit"))
            try:
                CASES[name](cell, options)
                cell.close()
            except BaseException:
                print(cell.waits(), file=sys.stderr)
                for process in [cell.server, *cell.arms.values()]:
                    process.kill()
                print((pathlib.Path(folder) / "log").read_text(), file=sys.stderr)
                raise
        print(f"{name}: passed in {time.monotonic() - began:.1f} s", flush=True)


if __name__ == "__main__":
    main()
